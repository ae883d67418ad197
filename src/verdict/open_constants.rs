//! Residuals that contain the value of an ∫, whose constant is open: they vanish for some constant,
//! perhaps, where they do not for those drawn.
//!
//! A residual R = c(x) e^(ks) of the value s, with k a number or a parameter, vanishes for all constants or
//! for none: R(s + δ)/R(s) and R(s + 2δ)/R(s + δ) are one number for all states with the same parameters.

use super::judging::Judging;
use super::recorded::RecordedClaim;
use super::run::Run;
use super::sampler::TAPE_LANES;
use crate::graph::{Expr, Fault, record};
use crate::number::ball::{Ball, Balls};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Number of parameter sets among the states of a block.
const SETS: usize = 4;

impl Judging<'_> {
    /// Whether a claim whose residual does not vanish may hold for other constants of its ∫.
    pub(super) fn depends_on_constants(&self, item: &RecordedClaim<'_>) -> Result<bool, Fault> {
        let is_open = |value: &Expr| self.constants_in(*value).next().is_some();
        if !item.residual.iter().any(is_open) {
            return Ok(false);
        }
        let sampler = self.sampler_at(&item.claim.place)?;
        if sampler.is_numerical() {
            return Ok(true);
        }
        let states = sampler.states_sharing_parameters(&Ball::<TAPE_LANES>, 0, SETS);
        for residual in &item.residual {
            let mut is_multiple = true;
            for constant in self.constants_in(*residual) {
                is_multiple &= self.is_multiple(*residual, constant, &states)?;
            }
            // Without an ∫ it is as it is, and it has to be one that does not vanish.
            let values = self.run(&[*residual]).at(&Ball::<TAPE_LANES>, &states);
            let value = values.output(0);
            if is_multiple && (0..TAPE_LANES).any(|lane| value.excludes_zero(lane)) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Inputs of a value that stand for values of ∫.
    fn constants_in(&self, value: Expr) -> impl Iterator<Item = usize> {
        let inputs = self.inputs;
        self.graph.inputs_of(value).into_iter().filter(move |input| *input >= inputs)
    }

    /// Whether these ratios are seen to be one number for all states with the same parameters.
    fn is_multiple(
        &self,
        residual: Expr,
        constant: usize,
        states: &[Balls<TAPE_LANES>],
    ) -> Result<bool, Fault> {
        let reached = self.graph.reached([residual]);
        let place = self.graph.place(residual);
        let (graph, ratios) = record(self.graph.inputs(), |inputs| {
            let of = |shifts: i64| {
                let mut shifted = inputs.to_vec();
                shifted[constant] += Expr::rational(&Rational::new(29 * shifts, 83));
                self.graph.repeated(&reached, &shifted)[place]
            };
            let values = [of(0)?, of(1)?, of(2)?];
            Some([values[1] / values[0], values[2] / values[1]])
        })?;
        let Some(ratios) = ratios else { return Ok(false) };
        let values = Run::new(&graph, &ratios, self.inputs).at(&Ball::<TAPE_LANES>, states);
        let per_set = TAPE_LANES / SETS;
        let mut compared = 0;
        for set in 0..SETS {
            let both = [values.output(0), values.output(1)].into_iter();
            let ends = both.flat_map(|ratio| {
                let lanes = (set * per_set..(set + 1) * per_set).filter(|k| ratio.is_defined(*k));
                lanes.map(|k| (ratio.mid[k] - ratio.rad[k], ratio.mid[k] + ratio.rad[k]))
            });
            let ends: Vec<(f64, f64)> = ends.collect();
            let highest_low = ends.iter().fold(f64::NEG_INFINITY, |low, own| low.max(own.0));
            let lowest_high = ends.iter().fold(f64::INFINITY, |high, own| high.min(own.1));
            if highest_low > lowest_high {
                return Ok(false);
            }
            compared += ends.len().saturating_sub(2);
        }
        Ok(compared > 0)
    }
}
