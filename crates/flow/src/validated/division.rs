//! Divisions of a motion into steps, the coarsest first.

use super::Obstacle;
use super::guess::Nodes;
use super::motion::EnclosedMotion;
use crate::motion::start::Start;
use liouville::mechanics::Model;

/// Rule for the length of the steps.
#[derive(Clone, Copy, Debug)]
pub enum Division {
    /// As the coefficients suggest, with this constant of the step size; a larger one makes shorter
    /// steps.
    Smooth(f64),
    /// The longest ones, halved where needed, for which the series is proved: where the terms of the
    /// field cancel, its tails are much larger than its coefficients.
    Short,
}

/// Divisions tried, one after another.
pub const DIVISIONS: [Division; 4] =
    [Division::Smooth(3.0), Division::Smooth(3.5), Division::Smooth(4.2), Division::Short];

impl Division {
    /// Divides the motion from a start over a time into at most so many steps.
    pub fn nodes(
        self,
        motion: &EnclosedMotion,
        model: &Model,
        start: &Start,
        time: f64,
        most: usize,
    ) -> Result<Option<Nodes>, Obstacle> {
        match self {
            Self::Smooth(kappa) => Ok(Nodes::along(model, start, time, kappa, most)?),
            Self::Short => {
                let longest = |state: &[f64], step: f64| motion.longest(state, step);
                // In any case shorter than those that failed.
                Nodes::shortened(model, start, time, 3.0, most, &longest)
            }
        }
    }
}
