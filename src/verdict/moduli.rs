//! States on both sides of moduli, for claims that the fields cannot decide: |X|, max and min may hide
//! a small part of the states on which a claim fails.

use super::judging::Judging;
use super::ladder::Open;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::graph::{Expr, Fault, Step, record};
use crate::mechanics::combinations;
use crate::number::UnaryFunction;
use crate::number::rational::Rational;
use crate::proof::InputRegion;

/// Largest number of moduli whose sides are looked at.
const MOST_MODULI: usize = 16;

impl Judging<'_> {
    /// Looks for a state on each side of the moduli in claims that are neither proved nor refuted; a
    /// witness refutes the claim.
    pub(super) fn states_beside_moduli(
        &self,
        sampler: &Sampler,
        open: &mut Open<'_, '_>,
    ) -> Result<(), Fault> {
        let Some(combinations) = combinations(sampler.recipes()) else { return Ok(()) };
        let is_asked = |item: &RecordedClaim<'_>| {
            !item.claim.kind.is_negated() && item.context.quadrature_defects.is_empty()
        };
        for (item, status) in open.iter_mut().filter(|(item, _)| is_asked(item)) {
            for fixed in &combinations {
                if status.settled.is_some() || status.is_zero {
                    break;
                }
                let chosen = sampler.with(fixed);
                for part in self.sides(item, &chosen, fixed)? {
                    if self.state_inside(item, &chosen, &part, status) && status.settled.is_some() {
                        break;
                    }
                }
            }
        }
        Ok(())
    }

    /// Returns the parts of the draws on which the argument of a modulus of a claim has one sign.
    fn sides(
        &self,
        item: &RecordedClaim<'_>,
        sampler: &Sampler,
        fixed: &[Option<Rational>],
    ) -> Result<Vec<InputRegion>, Fault> {
        let (composed, values) =
            sampler.compose(self.graph, std::slice::from_ref(&item.residual), fixed)?;
        let reached = composed.reached(values.concat());
        let arguments: Vec<usize> = composed
            .steps()
            .zip(&reached)
            .filter_map(|(step, reached)| match step {
                Step::Unary(UnaryFunction::Abs, argument) if *reached => Some(argument),
                _ => None,
            })
            .take(MOST_MODULI)
            .collect();
        let mut sides = Vec::new();
        for argument in arguments {
            for is_positive in [true, false] {
                let needed = composed.reached([composed.at(argument)]);
                let (graph, value) = record(composed.inputs(), |inputs| -> Option<Expr> {
                    let value = composed.repeated(&needed, inputs)[argument]?;
                    Some(if is_positive { value } else { -value })
                })?;
                let Some(value) = value else { continue };
                sides.push(InputRegion { graph, positive: vec![value], signs: Vec::new() });
            }
        }
        Ok(sides)
    }
}
