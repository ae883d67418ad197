//! Parts of lower dimension that lie in the closure of others, where nothing is to be asked of them.

use super::solving::is_sum_or_product;
use super::{Cover, Known, Part};
use crate::graph::{Expr, Fault, record};

impl Cover<'_> {
    /// Leaves out the parts of lower dimension that lie in the closure of a part of full dimension.
    pub(super) fn without_closures(&self, parts: Vec<Part>) -> Result<Vec<Part>, Fault> {
        let mut is_kept = vec![true; parts.len()];
        for (index, thin) in parts.iter().enumerate().filter(|(_, part)| part.is_thin) {
            for whole in parts.iter().filter(|part| part.is_whole && is_smooth(part)) {
                if self.lies_on(thin, whole)? {
                    is_kept[index] = false;
                    break;
                }
            }
        }
        let mut kept = is_kept.into_iter();
        Ok(parts.into_iter().filter(|_| kept.next().unwrap_or(true)).collect())
    }

    /// Whether the formulas of a part give the points of another one, from their coordinates.
    fn lies_on(&self, thin: &Part, whole: &Part) -> Result<bool, Fault> {
        let first = thin.made.len() - self.model.dimension();
        let (graph, found) = record(thin.graph.inputs(), |inputs| {
            let reached = thin.graph.reached(thin.made.iter().chain(&thin.facts).copied());
            let values = thin.graph.repeated(&reached, inputs);
            let at = |some: &[Expr]| {
                let all = some.iter().map(|value| values[thin.graph.place(*value)]);
                all.collect::<Option<Vec<Expr>>>()
            };
            let (made, facts) = (at(&thin.made)?, at(&thin.facts)?);
            let mut coordinates = inputs.to_vec();
            coordinates.splice(self.parameters.., made[first..].iter().copied());
            let reached = whole.graph.reached(whole.made.iter().chain(&whole.facts).copied());
            let there = whole.graph.repeated(&reached, &coordinates);
            let there = |value: &Expr| there[whole.graph.place(*value)];
            let differences = whole.made.iter().zip(&made);
            let differences =
                differences.map(|(value, own)| there(value).map(|value| value - *own));
            let bounds = whole.facts.iter().map(there).collect::<Option<Vec<Expr>>>()?;
            Some((differences.collect::<Option<Vec<Expr>>>()?, bounds, facts))
        })?;
        let Some((differences, bounds, facts)) = found else { return Ok(false) };
        for difference in differences {
            if !self.is_zero(&graph, difference, &facts)? {
                return Ok(false);
            }
        }
        // At an end of a range there may be no points of the whole nearby.
        for bound in bounds {
            let is_inside = match graph.constant_value(bound) {
                Some(number) => !number.is_zero() && !number.is_negative(),
                None => matches!(self.known(&graph, bound, &[])?, Known::Thin),
            };
            if !is_inside {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// Whether the formulas of a part are polynomials, and nothing but ranges bounds it.
fn is_smooth(part: &Part) -> bool {
    let reached = part.graph.reached(part.made.iter().copied());
    part.is_bounded_by_ranges
        && part
            .graph
            .steps()
            .zip(&reached)
            .all(|(step, reached)| !*reached || is_sum_or_product(step))
}
