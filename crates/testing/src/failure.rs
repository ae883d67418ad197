//! Failures of assertions, and proofs.

use std::fmt;

use liouville::graph::Fault;
use liouville::proof::Certificate;

/// The reason why an assertion failed. Inside `proptest!` the operator `?` turns it into a failed
/// case.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AssertionFailure {
    /// The claim is false at this state: an enclosure of the residual excludes 0.
    #[error("refuted: {0}")]
    Refuted(Box<FieldWitness>),
    /// A premise of every claim is false at this state: the field leaves the level, the chart's
    /// point is not on it, or a condition of the field is violated.
    #[error("the claim has no meaning here: {0}")]
    Premise(Box<FieldWitness>),
    /// The residual does not vanish in prime fields, but no enclosure near this state excludes 0.
    #[error(
        "refuted in prime fields: {what} does not vanish identically, but it is below every \
         precision tried near the state; draw states farther from it"
    )]
    RefutedInFields {
        /// Value that should vanish.
        what: &'static str,
    },
    /// A value is undefined at this state.
    #[error(
        "{what} has no value at {at}: a division by 0, or a root of a negative number; keep such \
         states out of the strategy, or leave them with `prop_assume!`"
    )]
    Undefined {
        /// Value that should vanish.
        what: &'static str,
        /// State at which it is undefined.
        at: DrawnState,
    },
    /// The chart covers too little of its level near this state for a proof on the level.
    #[error(
        "the chart does not fill its level at {0}, or the level functions depend on each other"
    )]
    Chart(DrawnState),
    /// Neither a counterexample nor a proof was found.
    #[error("{what} could not be proved to vanish: {why}")]
    Unproved {
        /// Value that should vanish.
        what: &'static str,
        /// Reason why the prime fields are silent.
        why: String,
    },
    /// The computation cannot be recorded.
    #[error(transparent)]
    Recording(#[from] Fault),
}

impl AssertionFailure {
    /// Whether the failure refutes the claim itself.
    pub fn is_refutation(&self) -> bool {
        matches!(self, Self::Refuted(_) | Self::RefutedInFields { .. })
    }
}

/// A state at which a value that should vanish does not.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldWitness {
    /// Value that should vanish.
    pub what: &'static str,
    /// Index of the component.
    pub component: usize,
    /// Midpoint and radius of a ball that contains the component and excludes 0.
    pub enclosure: (f64, f64),
    /// State of the refutation.
    pub at: DrawnState,
}

impl fmt::Display for FieldWitness {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (mid, rad) = self.enclosure;
        let Self { what, component, at, .. } = self;
        write!(
            out,
            "{what} (component {component}) is {mid:e} ± {rad:e}, which excludes 0, at {at}"
        )
    }
}

/// A drawn state.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnState {
    /// Numbers from which it is made, exact as given.
    pub coordinates: Vec<f64>,
    /// Rounded point of ℝᴺ.
    pub point: Vec<f64>,
}

impl fmt::Display for DrawnState {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "x = {:?}", self.point)?;
        if self.coordinates != self.point {
            write!(out, ", which the chart makes from {:?}", self.coordinates)?;
        }
        Ok(())
    }
}

/// A proof that a claim holds on the whole of a chart: wherever all its terms are defined, and on
/// the side of each root and modulus on which the state lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChartProof(pub Certificate);

impl fmt::Display for ChartProof {
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
