//! Formulas from a linear ansatz with thousands of unknowns, modulo a prime.
//!
//! ```text
//! monomials     a basis of polynomials in velocities and positions on the level
//! characters    sign changes that keep the motion split it into blocks
//! system        a row a random state, a column a function: its null space are the integrals
//! subspace      less the functions of what is known
//! coefficients  numbers, or functions of the parameters, by interpolation
//! verdict       what is found climbs the ladder like any claim
//! ```
//!
//! [`potentials`] and [`gyrostats`] have the leading form of an integral given: then a potential, or the
//! direction of a rotor, enters linearly beside what the integral gains. [`poisson`] has a Hamiltonian
//! given: then the entries of a bracket enter linearly.

mod brackets;
mod characters;
pub mod coefficients;
mod forces;
mod gyrostats;
mod integrals;
pub mod monomials;
mod poisson;
mod potentials;
mod size;
pub mod subspace;
pub mod system;

use super::conditions::components;
use super::terms::{Term, read};
use super::{Effort, Report, SearchError};
use crate::case::Case;
use monomials::Variables;
pub use poisson::Hamiltonians;
use system::Column;

/// What is looked for in a linear ansatz, and how far.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ansatz {
    /// Look for integrals even where the counts leave none.
    pub wanted: bool,
    /// The highest degree in the positions.
    pub positions: u32,
    /// Which potentials keep an integral?
    pub potentials: bool,
    /// Which rotors keep an integral?
    pub gyrostats: bool,
    /// No matrix is larger.
    pub megabytes: u64,
}

impl Default for Ansatz {
    fn default() -> Self {
        Self { wanted: false, positions: 8, potentials: false, gyrostats: false, megabytes: 500 }
    }
}

/// Searches as far as the effort goes.
pub fn search(
    case: &Case,
    effort: &Effort,
    report: &mut Report,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    integrals::integrals(case, effort, report, progress)?;
    if effort.ansatz.potentials {
        potentials::potentials(case, effort, report, progress)?;
    }
    if effort.ansatz.gyrostats {
        gyrostats::gyrostats(case, effort, report, progress)?;
    }
    if let Some(wanted) = &effort.poisson {
        poisson::brackets(case, wanted, effort, report, progress)?;
    }
    Ok(())
}

/// The parameters' components in which coefficients are written, and those of J where there is one.
pub fn coordinates(case: &Case) -> Vec<Term> {
    let entries = ["J1", "J2", "J3", "J12", "J13", "J23"].map(str::to_string);
    let tensor = read(entries.to_vec(), &case.model.vocabulary);
    [components(case), tensor].concat()
}

/// What a polynomial is divided by; `1` for nothing.
fn factors(below: &[Term], case: &Case) -> Vec<Term> {
    let over = |term: &Term| format!("1/({})", term.text);
    read(below.iter().map(over).collect(), &case.model.vocabulary)
}

/// The function that a column differentiates, as one writes it.
fn written(variables: &Variables, below: &[Term], column: &Column) -> String {
    match column {
        Column::Given(_) => "1".to_string(),
        Column::Product { factor, exponents, .. } => {
            match (variables.text(exponents), below[*factor].text.as_str()) {
                (above, "1") => above,
                (above, below) => format!("{above}/{below}"),
            }
        }
    }
}
