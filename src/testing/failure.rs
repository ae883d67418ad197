//! What an assertion says when it does not hold, and what a proof is worth.

use std::fmt;

use crate::graph::Fault;
use crate::proof::Certificate;

/// Why an assertion failed. Inside `proptest!` the operator `?` turns it into a failed case.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Failure {
    /// The claim is false at this state: an enclosure of the residual excludes 0.
    #[error("refuted: {0}")]
    Refuted(Box<Witness>),
    /// What every claim rests on is false at this state: the field leaves the level, the chart's
    /// point is not on it, or a condition of the field is violated.
    #[error("the claim has no meaning here: {0}")]
    Premise(Box<Witness>),
    /// It does not vanish in prime fields, but no enclosure near this state excludes 0.
    #[error(
        "refuted in prime fields: {what} does not vanish identically, but it is below every \
         precision tried near the state; draw states farther from it"
    )]
    RefutedInFields {
        /// What was to vanish.
        what: &'static str,
    },
    /// Something has no value at this state.
    #[error(
        "{what} has no value at {at}: a division by 0, or a root of a negative number; keep such \
         states out of the strategy, or leave them with `prop_assume!`"
    )]
    Undefined {
        /// What was to vanish.
        what: &'static str,
        /// The state.
        at: State,
    },
    /// The chart reaches too little of its level near this state for a proof on the level.
    #[error(
        "the chart does not fill its level at {0}, or the level functions depend on each other"
    )]
    Chart(State),
    /// No counterexample, and no proof.
    #[error("{what} could not be proved to vanish: {why}")]
    Unproved {
        /// What was to vanish.
        what: &'static str,
        /// Why the prime fields are silent.
        why: String,
    },
    /// The computation cannot be recorded.
    #[error(transparent)]
    Recording(#[from] Fault),
}

impl Failure {
    /// Is the claim itself shown to be false?
    pub fn is_refutation(&self) -> bool {
        matches!(self, Self::Refuted(_) | Self::RefutedInFields { .. })
    }
}

/// A state at which something does not vanish that should.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// What was to vanish.
    pub what: &'static str,
    /// Which component of it.
    pub component: usize,
    /// Midpoint and radius of a ball that holds its value, and not 0.
    pub enclosure: (f64, f64),
    /// Where.
    pub at: State,
}

impl fmt::Display for Witness {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (mid, rad) = self.enclosure;
        let Self { what, component, at, .. } = self;
        write!(
            out,
            "{what} (component {component}) is {mid:e} ± {rad:e}, which excludes 0, at {at}"
        )
    }
}

/// A state as it was drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The numbers it is made from, exact as they stand.
    pub coordinates: Vec<f64>,
    /// The point of ℝᴺ, rounded.
    pub point: Vec<f64>,
}

impl fmt::Display for State {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "x = {:?}", self.point)?;
        if self.coordinates != self.point {
            write!(out, ", which the chart makes from {:?}", self.coordinates)?;
        }
        Ok(())
    }
}

/// A proof that a claim holds on the whole of a chart: where everything is defined that occurs in
/// it, and on that side of each root and modulus on which the state lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proof(pub Certificate);

impl fmt::Display for Proof {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Certificate { points, primes, degree, error_log2, .. } = self.0;
        write!(
            out,
            "proved: zero at {points} random points modulo {primes} random primes; of degree at \
             most {degree}, it is something else with probability below 2^{}",
            error_log2.ceil()
        )
    }
}
