//! Requests for closed orbits.

use super::Obstacle;
use super::enclosure::Enclosure;
use super::functions::{Functions, norm};
use super::laws::Laws;
use crate::motion::recorded::Loose;
use crate::motion::start::Start;
use liouville::formula::Formula;
use liouville::mechanics::Model;
use liouville::number::rational::Rational;

/// Request for a closed orbit.
pub struct Request<'r> {
    /// Model of the case.
    pub model: &'r Model,
    /// State near the orbit, with the values of the free parameters.
    pub start: &'r Start,
    /// Approximate period.
    pub period: f64,
    /// Whether the energy is proved to be conserved.
    pub keeps_energy: bool,
    /// Exact value of the energy; that of the start where none is given.
    pub energy: Option<&'r Rational>,
    /// Further functions proved to be conserved.
    pub integrals: &'r [&'r Formula],
    /// Free parameters that vary within ranges, about the values of the start.
    pub loose: &'r [Loose],
    /// Whether the sum of two multipliers is to be enclosed.
    pub wants_multipliers: bool,
}

impl<'r> Request<'r> {
    /// Equations of the motion.
    pub(super) fn laws(&self) -> Laws<'r> {
        Laws {
            model: self.model,
            parameters: &self.start.parameters,
            loose: self.loose,
            energy: self.keeps_energy,
            integrals: self.integrals,
        }
    }

    /// State near the orbit in f64.
    pub(super) fn state(&self) -> Vec<f64> {
        self.start.state.iter().map(|x| x.hi).collect()
    }

    /// Exact values of the functions in use on the orbit: 0 for those of the level, the energy given,
    /// and otherwise these.
    pub(super) fn values(
        &self,
        functions: &Functions,
        others: &[f64],
    ) -> Result<Vec<Rational>, Obstacle> {
        let known = others.iter().map(|x| Rational::from_f64(*x).ok_or(Obstacle::NoOrbit));
        let mut values = known.collect::<Result<Vec<Rational>, _>>()?;
        values[..functions.of_level].fill(Rational::from(0));
        let place = functions.of_level;
        if self.keeps_energy
            && let Some(energy) = self.energy
            && functions.uses(place)
        {
            values[place] = energy.clone();
        }
        Ok(values)
    }
}

/// Part of its size that a component covers along an orbit, below which it counts as a constant.
const CONSTANT: f64 = 1e-6;
/// Part of the state's size below which that of a component is rounding.
const ROUNDED: f64 = 1e-10;

/// Largest distance of a component of a point from that of a state, relative to what the component covers
/// along an orbit through these nodes: a large constant among them makes no orbit near. Of one that does
/// not vary its size counts.
pub(super) fn moved<'n>(
    point: &[Enclosure],
    state: &[f64],
    nodes: impl Iterator<Item = &'n Vec<f64>> + Clone,
) -> f64 {
    let size = norm(state);
    let apart = point.iter().zip(state).enumerate().map(|(index, (x, y))| {
        let values = || nodes.clone().filter_map(|node| node.get(index)).chain([y]);
        let (low, high) = values()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(*x), high.max(*x)));
        let largest = low.abs().max(high.abs());
        let scale = if high - low > CONSTANT * largest { high - low } else { largest };
        (x.mid - y).abs() / scale.max(ROUNDED * size)
    });
    apart.fold(0.0, |a: f64, b| if b.is_nan() { b } else { a.max(b) })
}
