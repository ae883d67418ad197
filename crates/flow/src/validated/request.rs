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

/// Distance of a point from a state, relative to the state.
pub(super) fn moved(point: &[Enclosure], state: &[f64]) -> f64 {
    let gap: Vec<f64> = point.iter().zip(state).map(|(x, y)| x.mid - y).collect();
    norm(&gap) / norm(state)
}
