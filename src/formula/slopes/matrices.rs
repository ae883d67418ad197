//! Rules of matrices: inverse, determinant, adjugate, solution of equations, powers.

use super::super::arena::{NodeId, NodeOperation};
use super::super::kind::Type;
use super::super::typing::Infix;
use super::{Slope, Slopes};

impl Slopes<'_, '_> {
    /// (A⁻¹)' = −A⁻¹ A' A⁻¹.
    pub(super) fn inverse(&mut self, node: NodeId, a: NodeId) -> Slope {
        let Some(slope) = self.of(a)? else { return Ok(None) };
        let right = self.times(slope, node)?;
        let product = self.times(node, right)?;
        Ok(Some(self.negative(product)))
    }

    /// (det A)' = tr(adj A · A').
    pub(super) fn determinant(&mut self, a: NodeId) -> Slope {
        let Some(slope) = self.of(a)? else { return Ok(None) };
        let adjugate = self.push(NodeOperation::Adjugate(a), self.at(a).value_type);
        let product = self.times(adjugate, slope)?;
        Ok(Some(self.push(NodeOperation::Trace(product), Type::Scalar)))
    }

    /// (A⁻¹b)' = A⁻¹(b' − A' A⁻¹b).
    pub(super) fn solution(&mut self, node: NodeId, a: NodeId, b: NodeId) -> Slope {
        let (of_a, of_b) = (self.of(a)?, self.of(b)?);
        let pulled = match of_a {
            Some(slope) => Some(self.times(slope, node)?),
            None => None,
        };
        let pulled = pulled.map(|pulled| self.negative(pulled));
        let right = self.sum(of_b, pulled)?;
        let kind = self.at(node).value_type;
        Ok(right.map(|right| self.push(NodeOperation::Solve(a, right), kind)))
    }

    /// (Aⁿ)' = Σ Aᵏ A' Aⁿ⁻¹⁻ᵏ.
    pub(super) fn matrix_power(&mut self, a: NodeId, n: u32) -> Slope {
        let Some(slope) = self.of(a)? else { return Ok(None) };
        let kind = self.at(a).value_type;
        let mut total = None;
        for before in 0..n {
            let mut term = slope;
            for (power, is_left) in [(before, true), (n - 1 - before, false)] {
                if power > 0 {
                    let factor = self.push(NodeOperation::MatrixPower(a, power), kind);
                    let (left, right) = if is_left { (factor, term) } else { (term, factor) };
                    term = self.times(left, right)?;
                }
            }
            total = self.sum(total, Some(term))?;
        }
        Ok(total)
    }

    /// The derivative of adj A = A² − (tr A) A + ½((tr A)² − tr A²) E in three dimensions, and of
    /// (tr A) E − A in two.
    pub(super) fn adjugate(&mut self, a: NodeId, kind: Type) -> Slope {
        let Some(slope) = self.of(a)? else { return Ok(None) };
        let Type::Matrix(rows @ 1..=3, _) = kind else {
            let what = "the adjugate of more than three rows has no derivative here";
            return Err(self.refused(what, "write `det(A)*A⁻¹`"));
        };
        if rows == 1 {
            return Ok(None);
        }
        let unit = self.push(NodeOperation::Identity, kind);
        let trace = |own: &mut Self, node| own.push(NodeOperation::Trace(node), Type::Scalar);
        let trace_of_slope = trace(self, slope);
        if rows == 2 {
            let unit = self.times(trace_of_slope, unit)?;
            return self.infix(Infix::Subtract, unit, slope).map(Some);
        }
        let trace_of_a = trace(self, a);
        let [left, right] = [(a, slope), (slope, a)].map(|(a, b)| self.times(a, b));
        let squares = self.infix(Infix::Add, left?, right?)?;
        let first = self.times(trace_of_slope, a)?;
        let second = self.times(trace_of_a, slope)?;
        let product = self.times(a, slope)?;
        let of_product = trace(self, product);
        let both = self.times(trace_of_a, trace_of_slope)?;
        let factor = self.infix(Infix::Subtract, both, of_product)?;
        let last = self.times(factor, unit)?;
        let mut total = self.infix(Infix::Subtract, squares, first)?;
        total = self.infix(Infix::Subtract, total, second)?;
        self.infix(Infix::Add, total, last).map(Some)
    }
}
