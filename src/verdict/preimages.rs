//! States that a map takes to one image: ρ dx is invariant only where the map is one-to-one.
//!
//! If Φ takes n states to one, near which (ρ∘Φ) |det DΦ| = ρ holds, the image of ρ dx has the density nρ.
//!
//! On a level {F = 0} the equation Φ(y) + c Σ n_j F_j(y) = z is solved, with the transversals n_j of the
//! level at z: it is regular where Φ is regular along the level, whatever Φ does across it, but for
//! few c. Its solution lies on the level if the F_j vanish there, which is asked of their enclosures.

use super::judging::Judging;
use super::recorded::RecordedClaim;
use super::sampler::{Sampler, TAPE_LANES, inside};
use super::witness::briefly;
use crate::graph::{Evaluator, Expr, Fault, Tape, record};
use crate::level::Newton;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::transversals;
use crate::mechanics::{Chart, Model, Phase};
use crate::number::ball::{Ball, Balls};

/// Number of parameter sets that are tried.
const PARAMETER_SETS: usize = 4;
/// Number of states from which Newton's method starts, for each state.
const STARTS: usize = 4;
/// Multiples of these states from which it starts as well, where any second state will do.
const MULTIPLES: [f64; 5] = [1.0, -1.0, 4.0, -0.25, 0.25];
/// Largest power of 2^10 by which a state is scaled, up and down, where any second state will do: near a
/// pole it may be very small.
const SCALES: i32 = 12;
/// Number of states that are scaled so.
const SCALED: usize = 8;
/// Factor c of the level functions, which no map is likely to have across a level.
const ACROSS: f64 = 2.5;

/// States that count as a second one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum SecondState {
    /// Those in the declared ranges.
    InRanges,
    /// Any: the measure of a set is that of all states whose images lie in it.
    Anywhere,
}

impl Judging<'_> {
    /// Encloses a second state with the image of a drawn one, and writes both; the claim's formulas have
    /// values at both.
    ///
    /// `None` if none is found.
    pub(super) fn second_preimage(
        &self,
        sampler: &Sampler,
        item: &RecordedClaim<'_>,
        second: SecondState,
    ) -> Result<Option<String>, Fault> {
        let model = &self.case.model;
        let (free, dimension) = (model.free_components(), model.dimension());
        if self.graph.inputs() > self.inputs {
            return Ok(None);
        }
        let kept = sampler.kept();
        let newton = equation(model, kept)?;
        let mut outputs = self.common.field.clone();
        let on_level = self.common.level.iter().zip(kept).filter(|(_, kept)| **kept);
        outputs.extend(on_level.map(|(function, _)| *function));
        let level = dimension..outputs.len();
        outputs.extend(self.common.required_at(kept));
        outputs.extend(&item.requirement);
        let tape = Tape::new(self.graph, &outputs);
        let images = |state: &[Balls<1>]| -> Option<Vec<Balls<1>>> {
            let mut evaluator = Evaluator::new(&tape, Ball::<1>);
            evaluator.run(state);
            let all: Vec<Balls<1>> = evaluator.outputs().cloned().collect();
            let exist = all.iter().all(|value| value.is_defined(0));
            let is_on_level = |value: &Balls<1>| value.mid[0].abs() <= value.rad[0];
            (exist && all[level.clone()].iter().all(is_on_level)).then(|| all[..dimension].to_vec())
        };
        // States with other parameters, too, are places to start from.
        let drawn = match sampler.is_numerical() {
            true => sampler.balls(0),
            false => sampler.states_sharing_parameters(&Ball::<TAPE_LANES>, 0, PARAMETER_SETS),
        };
        let lane = |k: usize| -> Vec<Balls<1>> {
            drawn.iter().map(|block| Balls::new([block.mid[k]], [block.rad[k]])).collect()
        };
        // The second state may lie on another part of the level.
        let parts: Vec<Vec<Balls<TAPE_LANES>>> = match self.pieces.borrow().get(kept) {
            Some(Some(pieces)) => pieces.iter().flatten().map(|part| part.balls(0)).collect(),
            _ => Vec::new(),
        };
        // Ranges of [state] do not restrict the states of the file's own chart, or of a sphere.
        let is_charted = !matches!(self.case.chart, Chart::Free | Chart::Equations);
        let is_free = second == SecondState::Anywhere || is_charted && kept.contains(&true);
        let set = TAPE_LANES / PARAMETER_SETS;
        for k in 0..TAPE_LANES {
            let here = lane(k);
            let Some(image) = images(&here) else { continue };
            let target = [&here[..free], &image].concat();
            let multiples = match second {
                SecondState::InRanges => &MULTIPLES[..1],
                SecondState::Anywhere => &MULTIPLES[..],
            };
            let others = (1..=STARTS).map(|step| k - k % set + (k + step) % set);
            let drawn = others.map(lane);
            let of_parts = parts.iter().map(|part| {
                part.iter().map(|block| Balls::new([block.mid[k]], [block.rad[k]])).collect()
            });
            let starts: Vec<Vec<Balls<1>>> = drawn.chain(of_parts).collect();
            let near = starts.iter().flat_map(|other| multiples.iter().map(move |by| (other, *by)));
            let is_scaled = second == SecondState::Anywhere && k < SCALED;
            let scales = (1..=SCALES).flat_map(|n| [-10 * n, 10 * n]).map(|n| 2f64.powi(n));
            let far = starts
                .iter()
                .take(usize::from(is_scaled))
                .flat_map(|other| scales.clone().flat_map(move |by| [(other, by), (other, -by)]));
            for (other, by) in near.chain(far) {
                let start: Vec<f64> = other[free..].iter().map(|x| by * x.mid[0]).collect();
                let Some(there) = newton.enclose(&target, &start) else { continue };
                let is_other = here[free..]
                    .iter()
                    .zip(&there)
                    .any(|(a, b)| (a.mid[0] - b.mid[0]).abs() > 2.0 * (a.rad[0] + b.rad[0]));
                let is_inside = is_free
                    || there.iter().zip(&self.case.free_draws).all(|(x, draw)| {
                        let (low, high) =
                            inside(draw).unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
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

/// Records the equation for a state y on the level with the image z; its parameters are those of the model
/// and z.
fn equation(model: &Model, kept: &[bool]) -> Result<Newton, Fault> {
    let (free, dimension) = (model.free_components(), model.dimension());
    let (graph, (values, slopes)) = record(free + 2 * dimension, |inputs| {
        let (parameters, rest) = inputs.split_at(free);
        let (image, state) = rest.split_at(dimension);
        let jet = DualPoint::new(Phase::new(model, parameters, state));
        let there = DualPoint::new(Phase::new(model, parameters, image));
        let across = transversals(&there.level_gradients(kept));
        let functions = model.level.iter().zip(kept).filter(|(_, kept)| **kept);
        let functions: Vec<Expr> =
            functions.map(|(own, _)| jet.phase.level_function(&own.function)).collect();
        let (columns, gradients) = (jet.derivative(), jet.level_gradients(kept));
        let moved = |of: &dyn Fn(usize) -> Expr, i: usize| -> Expr {
            (0..across.len()).map(|j| Expr::from(ACROSS) * across[j][i] * of(j)).sum()
        };
        let value = |i: usize| jet.phase.field()[i] - image[i] + moved(&|j| functions[j], i);
        let slope = |i: usize, k: usize| columns[k][i] + moved(&|j| gradients[j][k], i);
        let values: Vec<Expr> = (0..dimension).map(value).collect();
        let slopes: Vec<Expr> = (0..dimension)
            .flat_map(|i| (0..dimension).map(move |k| (i, k)))
            .map(|(i, k)| slope(i, k))
            .collect();
        (values, slopes)
    })?;
    Ok(Newton::of(&graph, &values, &slopes, free + dimension))
}
