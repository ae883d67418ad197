//! Reasons why nothing is proved about a motion.

use super::motion::EnclosedMotion;
use super::{MOST_UNKNOWNS, forward};
use crate::error::FlowError;

/// Reason why a motion is not enclosed, or no closed orbit proved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Obstacle {
    /// The motion cannot be computed.
    #[error(transparent)]
    Motion(#[from] FlowError),
    /// The level equations are dependent at the start.
    #[error("the level equations are not independent at the start")]
    Level,
    /// The orbit is too long.
    #[error("the orbit takes more than {MOST_UNKNOWNS} unknowns")]
    TooLong,
    /// The motion is too long.
    #[error("the motion takes more than {} steps", forward::MOST_STEPS)]
    TooManySteps,
    /// The state is not enclosed well enough.
    #[error("the enclosure of the state grows too wide near t = {0:.3}")]
    Wide(f64),
    /// The equations are singular.
    #[error(
        "the equations for the orbit are singular: it is degenerate, or there is none, or it is one of a \
         family of closed orbits, from which `integrals` of the claim single one out if they vary along the \
         family; images of one orbit under a symmetry, as rotations, keep them: use coordinates without it"
    )]
    Degenerate,
    /// Newton's method does not converge.
    #[error("no closed orbit is found near the start: Newton's method does not converge")]
    NoOrbit,
    /// Newton's method leads to where a step is not proved.
    #[error(
        "no closed orbit is found near the start: Newton's method leads away from it, to where no step \
         of the series is proved; start nearer to the orbit, or state its period better"
    )]
    Strays,
    /// A step is not proved.
    #[error(
        "no step of the series is proved near t = {0:.3}: the field varies too much there, as near a pole \
         or a branch"
    )]
    NoStep(f64),
    /// A step of an entire field is not proved.
    #[error(
        "no step of the series is proved near t = {0:.3}: the terms of the field are large there and \
         cancel; write it in coordinates in which the motion is near 0, or with brackets, as (x - 3)^2"
    )]
    Cancels(f64),
    /// The boxes are not mapped into themselves.
    #[error(
        "the boxes are not contracted (norm {0:.1e}): the orbit is degenerate or nearly so, or one of a \
         family of closed orbits, from which `integrals` of the claim single one out if they vary along the \
         family; images of one orbit under a symmetry, as rotations, keep them: use coordinates without it"
    )]
    NoContraction(f64),
    /// The boxes are not mapped into themselves for all values of the parameters.
    #[error(
        "the boxes are not contracted for all values of the parameters (norm {0:.1e}): make their \
         ranges smaller"
    )]
    TooWide(f64),
    /// The data of a proof do not fit the equations.
    #[error("the data do not fit the equations: {0}")]
    Data(&'static str),
    /// A part of a certificate does not hold what it has to.
    #[error("`{place}` {problem}")]
    Part {
        /// Path of the part.
        place: String,
        /// Description of the fault.
        problem: &'static str,
    },
    /// The gradients of the conserved functions are not proved independent.
    #[error("the gradients of the functions kept are not proved independent along the orbit")]
    Gradients,
    /// The level of the conserved functions has another dimension than 3.
    #[error("horseshoes are proved where all conserved functions leave 3 dimensions, not {0}")]
    Dimension(usize),
    /// The multipliers of the closed orbit are not real, or near 1.
    #[error(
        "the closed orbit near the start is no saddle with multipliers well off the unit circle"
    )]
    NoSaddle,
    /// No surface across the motion is known.
    #[error("no surface across the motion is known")]
    Surface,
    /// No homoclinic orbit is found.
    #[error("no motion is found that leaves the saddle and returns to it")]
    NoHomoclinic,
    /// The covering relations are not proved.
    #[error("the covering relations along a homoclinic orbit are not proved: {0}")]
    NoCovering(&'static str),
}

impl Obstacle {
    /// The same for a field, which has no poles and no branches if it is entire.
    pub(super) fn of_field(self, motion: &EnclosedMotion) -> Self {
        match self {
            Self::NoStep(time) if motion.is_entire() => Self::Cancels(time),
            other => other,
        }
    }
}
