//! Norms of the parts of products beyond the order, which do not depend on the tails.

#![allow(clippy::needless_range_loop, reason = "loops over lanes become vectors")]

use super::super::coefficients::{BOXES, Lane};
use super::super::plan::RowRule;
use super::{Tails, above};
use crate::taylor::form::Row;

impl Tails<'_, '_> {
    /// Bounds ‖[a_N b_N]‖, given the sums of b or those of θb.
    #[inline(always)]
    fn crossed(&self, a: Row, b: Row, sums: &[Lane]) -> Lane {
        let stride = self.order + 1;
        let (a, b) = (a * stride, b * stride);
        let mut total = [0.0; BOXES];
        for k in 1..self.order {
            let (term, sum) = (&self.terms[a + k], &sums[b + self.order - k]);
            for lane in 0..BOXES {
                total[lane] += term[lane] * sum[lane];
            }
        }
        total.map(above)
    }

    /// Bounds ‖[x_N y_N]‖ and ‖[x_N θy_N]‖ of all operations, in order: they do not depend on the tails.
    #[inline(always)]
    pub(super) fn crosses(&self) -> Vec<Lane> {
        let mut crosses = Vec::new();
        for (out, operation) in &self.coefficients.plan.operations {
            let mut plain = |a: &Row, b: &Row| crosses.push(self.crossed(*a, *b, &self.sums));
            match operation {
                RowRule::Sum(sum) => sum.products.iter().for_each(|(_, x, y)| plain(x, y)),
                RowRule::Recip(x) => plain(out, x),
                RowRule::Power { x, inverse, .. } | RowRule::Ln { x, inverse } => plain(inverse, x),
                RowRule::Atan { x, square, inverse } => {
                    plain(x, x);
                    plain(inverse, square);
                }
                RowRule::Theta(_)
                | RowRule::Exp(_)
                | RowRule::Sin { .. }
                | RowRule::Cos { .. }
                | RowRule::Near(..)
                | RowRule::Choice { .. }
                | RowRule::Bounded { .. } => {}
            }
            let mut weighted =
                |a: &Row, b: &Row| crosses.push(self.crossed(*a, *b, &self.weighted_sums));
            match operation {
                RowRule::Power { x, .. } => {
                    weighted(out, x);
                    weighted(x, out);
                }
                RowRule::Exp(x) => weighted(out, x),
                RowRule::Ln { x, .. } => weighted(x, out),
                RowRule::Sin { x, cosine: other } | RowRule::Cos { x, sine: other } => {
                    weighted(out, x);
                    weighted(other, x);
                }
                RowRule::Atan { square, .. } => weighted(square, out),
                RowRule::Sum(_)
                | RowRule::Theta(_)
                | RowRule::Recip(_)
                | RowRule::Near(..)
                | RowRule::Choice { .. }
                | RowRule::Bounded { .. } => {}
            }
        }
        crosses
    }

    /// Number of bounds that `crosses` lists for an operation.
    pub(super) fn cross_count(operation: &RowRule) -> usize {
        match operation {
            RowRule::Sum(sum) => sum.products.len(),
            RowRule::Theta(_)
            | RowRule::Near(..)
            | RowRule::Choice { .. }
            | RowRule::Bounded { .. } => 0,
            RowRule::Recip(_) | RowRule::Exp(_) => 1,
            RowRule::Ln { .. } | RowRule::Sin { .. } | RowRule::Cos { .. } => 2,
            RowRule::Power { .. } | RowRule::Atan { .. } => 3,
        }
    }
}
