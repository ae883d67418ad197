//! Requests for sections and for planes of motions as a user chooses them, completed from the case.

use crate::error::FlowError;
use crate::section::andoyer::{applies, spread};
use crate::section::coordinate::{ChartAxis, Coordinate, Launch};
use crate::section::rolling::SectionRequest;
use liouville::case::{Angle, Case, Direction};
use liouville::mechanics::System;
use liouville::number::rational::Rational;

/// Default numbers of orbits and of crossings.
const ORBITS: usize = 40;
const CROSSINGS: usize = 500;

/// Choices for a section; those that are left open come from the case's `[section]`.
#[derive(Clone, Debug, Default)]
pub struct SectionChoice {
    /// Angle g₀ of the section.
    pub g0: Option<Angle>,
    /// Energy of the orbits.
    pub energy: Option<Rational>,
    /// Direction of the crossings that count.
    pub direction: Option<Direction>,
    /// Number of orbits with starts spread over the sphere.
    pub orbits: Option<usize>,
    /// Number of crossings to collect for each orbit.
    pub crossings: Option<usize>,
    /// Number of crossings left out at the beginning.
    pub skip: Option<usize>,
    /// Starts (l, L/G), in place of those of the case.
    pub starts: Vec<[f64; 2]>,
    /// Whether to follow the orbits backwards in time.
    pub backwards: bool,
    /// Seed of the free parameters.
    pub seed: u64,
}

/// Reason why a choice does not determine a section.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChoiceError {
    /// Neither the choice nor the case gives the angle or the energy.
    #[error("the case has no [section], so the {0} is unknown")]
    Unknown(&'static str),
    /// Neither the choice, nor the case, nor the axes of a plane give the start.
    #[error("where the motions start is not known")]
    NoStart,
    /// A whole state is given, and an axis of a plane varies the start.
    #[error("a state says where the motions start, and an axis too")]
    TwoStarts,
    /// The system has no such sections.
    #[error(transparent)]
    Flow(#[from] FlowError),
}

impl SectionChoice {
    /// Returns the angle and the energy of the section.
    pub fn place(&self, case: &Case) -> Result<(Angle, Rational), ChoiceError> {
        let plan = case.section.as_ref();
        if plan.is_none() && !matches!(case.model.system, System::Rubber(_)) {
            return Err(FlowError::NoAndoyer.into());
        }
        let g0 = self.g0.clone().or(plan.map(|plan| plan.g0.clone()));
        let energy = self.energy.clone().or(plan.map(|plan| plan.energy.clone()));
        let (g0, energy) =
            (g0.ok_or(ChoiceError::Unknown("angle")), energy.ok_or(ChoiceError::Unknown("energy")));
        Ok((g0?, energy?))
    }

    /// Completes the choice from the case.
    pub fn request(&self, case: &Case) -> Result<SectionRequest, ChoiceError> {
        if !applies(&case.model) {
            return Err(FlowError::NoAndoyer.into());
        }
        let plan = case.section.as_ref();
        let (g0, energy) = self.place(case)?;
        let count = match (self.orbits, plan) {
            (Some(count), _) => count,
            (None, _) if !self.starts.is_empty() => 0,
            (None, Some(plan)) => {
                plan.orbits.unwrap_or(if plan.starts.is_empty() { ORBITS } else { 0 })
            }
            (None, None) => ORBITS,
        };
        let mut starts = match plan {
            Some(plan) if self.starts.is_empty() => plan.starts.clone(),
            _ => self.starts.clone(),
        };
        starts.extend(spread(count));
        let planned = plan.and_then(|plan| plan.crossings);
        Ok(SectionRequest {
            g0,
            energy,
            direction: self.direction.or(plan.map(|plan| plan.direction)).unwrap_or_default(),
            crossings: self.crossings.or(planned).unwrap_or(CROSSINGS),
            skip: self.skip.or(plan.map(|plan| plan.skip)).unwrap_or(0),
            starts,
            backwards: self.backwards || plan.is_some_and(|plan| plan.backwards),
            seed: self.seed,
            index: 0,
        })
    }

    /// Returns the launch of the motions of a plane: on the section, if the case or the choice
    /// defines one, or else at a state, given or drawn.
    pub fn launch(
        &self,
        case: &Case,
        axes: &[ChartAxis; 2],
        state: Option<Vec<Rational>>,
    ) -> Result<Launch, ChoiceError> {
        let is_start = |axis: &ChartAxis| !matches!(axis.coordinate, Coordinate::Parameter { .. });
        let plan = case.section.as_ref();
        let on_section = !self.starts.is_empty() || axes.iter().any(is_start);
        if state.is_some() && axes.iter().any(is_start) {
            return Err(ChoiceError::TwoStarts);
        }
        if state.is_some() || !(on_section || plan.is_some()) {
            return Ok(Launch::State(state));
        }
        let (g0, energy) = self.place(case)?;
        let planned = plan.and_then(|plan| plan.starts.first());
        let both =
            axes.iter().filter(|axis| matches!(axis.coordinate, Coordinate::L | Coordinate::Z));
        let at = match self.starts.first().or(planned) {
            Some(at) => *at,
            None if both.count() == 2 => [0.0, 0.0],
            None => return Err(ChoiceError::NoStart),
        };
        Ok(Launch::Section { g0, energy, at })
    }
}
