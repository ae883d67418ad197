//! Verdicts from residuals: sampling on level sets, the ladder, evidence.
//!
//! A residual is judged against the rounding error that its computation can make at the state: a
//! ball that excludes 0 refutes, with the state as witness; a claim is confirmed when the balls of
//! all states contain 0 and are narrow against the terms that were added. There is no fixed
//! tolerance.

mod around;
mod ascent;
mod branches;
mod cell_rank;
mod circles;
mod claim_state;
mod cofactors;
mod combined;
mod conclude;
mod conditions;
mod conjugates;
mod coverage;
mod dissipation;
mod each_choice;
mod ends;
mod equations;
mod evidence;
mod examine;
mod existence;
mod field;
mod filled;
mod further;
mod further_witness;
mod ground;
mod judge;
mod judging;
mod jumps;
mod kept_levels;
mod ladder;
mod level_slopes;
mod listed_levels;
mod listed_powers;
mod local_form;
mod lone_states;
mod missing;
mod moduli;
mod mutants;
mod novelty;
mod one_to_one;
mod open_constants;
mod overflow;
mod parts;
mod pass;
mod physics;
mod pieces;
mod pivot_space;
mod point;
mod poles;
mod preimages;
mod quadratures;
mod recorded;
mod restriction;
mod reversed;
mod run;
mod sampler;
mod second_opinion;
mod signs;
mod slopes_of_constraints;
mod squares_of_rates;
mod state;
mod statement;
mod sum_of_squares;
mod values;
mod voids;
mod wider_domain;
mod witness;
mod zero_sets;

pub use equations::{EquationsSize, equations_size};
pub use evidence::{
    ClaimReport, DensitySign, Evidence, Independence, Measurement, Method, Proof, Rung, Verdict,
    Witness,
};
pub use filled::is_filled;
pub use judge::{
    CaseReport, JudgeError, Options, RecordedSize, Trust, judge, judge_telling, recorded_size,
};
pub use mutants::{MutantReport, MutationReport};
pub(crate) use point::named;
pub use point::{
    Digits, Enclosed, MOST_DIGITS, NamedValue, OVERFLOW, PointReport, evaluate, evaluate_digits,
};
pub use restriction::Flaw;
pub use sampler::{Sampler, TAPE_LANES};
pub use state::{StateError, read_state};
pub use statement::{Composed, Residuals, statements};
pub use values::ClaimsError;

use crate::number::rational::Rational;

/// Returns the value given to an antiderivative at a state, whose constant is free.
///
/// A fixed value makes residuals reproducible; 0 would hide terms in which it is a factor.
pub fn antiderivative_value(number: usize) -> Rational {
    Rational::new(37 + 11 * number as i64, 100)
}
