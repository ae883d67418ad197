//! States that a map takes to one image: ρ dx is invariant only where the map is one-to-one.
//!
//! If Φ takes n states to one, near which (ρ∘Φ) |det DΦ| = ρ holds, the image of ρ dx has the density nρ.

use super::judging::Judging;
use super::recorded::RecordedClaim;
use super::sampler::{Sampler, TAPE_LANES, inside};
use super::witness::briefly;
use crate::graph::{Evaluator, Expr, Fault, Tape, record};
use crate::level::Newton;
use crate::mechanics::Phase;
use crate::mechanics::calculus::DualPoint;
use crate::number::ball::{Ball, Balls};

/// Number of parameter sets that are tried.
const PARAMETER_SETS: usize = 4;
/// Number of starts of Newton's method for each state.
const STARTS: usize = 4;

impl Judging<'_> {
    /// Encloses a second state with the image of a drawn one, and writes both; the claim's formulas have
    /// values at both, and both lie in the declared ranges.
    ///
    /// `None` if none is found, or on a level.
    pub(super) fn second_preimage(
        &self,
        sampler: &Sampler,
        item: &RecordedClaim<'_>,
    ) -> Result<Option<String>, Fault> {
        let model = &self.case.model;
        let (free, dimension) = (model.free_components(), model.dimension());
        if sampler.kept().contains(&true) || self.graph.inputs() > self.inputs {
            return Ok(None);
        }
        let (graph, (values, slopes)) = record(free + 2 * dimension, |inputs| {
            let (parameters, rest) = inputs.split_at(free);
            let (image, state) = rest.split_at(dimension);
            let jet = DualPoint::new(Phase::new(model, parameters, state));
            let values = jet.phase.field().iter().zip(image).map(|(own, there)| *own - *there);
            let columns = jet.derivative();
            let slopes = (0..dimension).flat_map(|i| columns.iter().map(move |column| column[i]));
            (values.collect::<Vec<Expr>>(), slopes.collect::<Vec<Expr>>())
        })?;
        let newton = Newton::of(&graph, &values, &slopes, free + dimension);
        let mut outputs = self.common.field.clone();
        outputs.extend(self.common.required_at(sampler.kept()));
        outputs.extend(&item.requirement);
        let tape = Tape::new(self.graph, &outputs);
        let images = |state: &[Balls<1>]| -> Option<Vec<Balls<1>>> {
            let mut evaluator = Evaluator::new(&tape, Ball::<1>);
            evaluator.run(state);
            let all: Vec<Balls<1>> = evaluator.outputs().cloned().collect();
            let exist = all.iter().all(|value| value.is_defined(0));
            exist.then(|| all[..dimension].to_vec())
        };
        let drawn = sampler.states_sharing_parameters(&Ball::<TAPE_LANES>, 0, PARAMETER_SETS);
        let lane = |k: usize| -> Vec<Balls<1>> {
            drawn.iter().map(|block| Balls::new([block.mid[k]], [block.rad[k]])).collect()
        };
        let set = TAPE_LANES / PARAMETER_SETS;
        for k in 0..TAPE_LANES {
            let here = lane(k);
            let Some(image) = images(&here) else { continue };
            let target = [&here[..free], &image].concat();
            for other in (1..=STARTS).map(|step| k - k % set + (k + step) % set) {
                let start: Vec<f64> = lane(other)[free..].iter().map(|x| x.mid[0]).collect();
                let Some(there) = newton.enclose(&target, &start) else { continue };
                let is_other = here[free..]
                    .iter()
                    .zip(&there)
                    .any(|(a, b)| (a.mid[0] - b.mid[0]).abs() > 2.0 * (a.rad[0] + b.rad[0]));
                let is_inside = there.iter().zip(&self.case.free_draws).all(|(x, draw)| {
                    let (low, high) = inside(draw).unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
                    x.mid[0] - x.rad[0] >= low && x.mid[0] + x.rad[0] <= high
                });
                if is_other && is_inside && images(&[&here[..free], &there].concat()).is_some() {
                    let both = [&here[free..], &there].map(|state| {
                        let middles: Vec<f64> = state.iter().map(|x| x.mid[0]).collect();
                        briefly(model, &middles)
                    });
                    return Ok(Some(both.join(" and ")));
                }
            }
        }
        Ok(None)
    }
}
