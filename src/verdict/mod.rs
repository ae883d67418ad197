//! From residuals to verdicts: sampling on level sets, the ladder, evidence.
//!
//! A residual is judged against the rounding error that this very computation can make at this very
//! state: a ball that excludes 0 refutes, with the state as witness; a claim is confirmed when the
//! balls of all states contain 0 and are narrow against the terms that were added up. Nothing is
//! compared with a fixed tolerance.

mod bench;
mod branches;
mod conclude;
mod conditions;
mod coverage;
mod evidence;
mod examine;
mod existence;
mod field;
mod finding;
mod ground;
mod judge;
mod ladder;
mod mutants;
mod newton;
mod novelty;
mod physics;
mod point;
mod recorded;
mod run;
mod sampler;
mod second_opinion;
mod signs;
mod state;
mod wider;
mod witness;

pub use evidence::{
    ClaimReport, Evidence, Independence, Measurement, Proof, Rung, Sign, Verdict, Witness,
};
pub use judge::{CaseReport, JudgeError, Options, Trust, judge};
pub use mutants::{MutantReport, MutationReport};
pub(crate) use point::named;
pub use point::{Digits, Enclosed, Named, PointReport, evaluate, evaluate_digits};
pub use sampler::{LANES, Sampler};
pub use state::{StateError, read_state};

use crate::number::rational::Rational;

/// The value that an antiderivative is given at a state, its constant being free.
///
/// A fixed one makes residuals reproducible; 0 would hide terms in which it is a factor.
pub fn antiderivative_value(number: usize) -> Rational {
    Rational::new(37 + 11 * number as i64, 100)
}
