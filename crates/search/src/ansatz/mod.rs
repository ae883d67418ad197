//! Search in a linear ansatz with thousands of unknowns, modulo a prime.
//!
//! ```text
//! monomials     a basis of polynomials in velocities and positions on the level
//! characters    sign changes that preserve the motion, and split the system into blocks
//! system        one row for each random state, one column for each function; the null space
//!               consists of the integrals
//! subspace      the complement of functions of known integrals
//! coefficients  numbers, or functions of the parameters, by interpolation
//! verdict       each find is judged as a claim like any other
//! ```
//!
//! [`potentials`] and [`gyrostats`] start from the leading form of an integral: then a potential,
//! or the direction of a rotor, enters linearly together with the terms added to the integral.
//! [`poisson`] starts from a Hamiltonian: then the entries of a bracket enter linearly.

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
use super::terms::{is_one, one, read};
use super::{Effort, Report, SearchError};
use coefficients::Ratio;
use liouville::case::Case;
use liouville::formula::{Formula, FormulaError};
use monomials::Variables;
pub use poisson::Hamiltonians;
use system::Column;

/// Scope and limits of the linear ansatz.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ansatz {
    /// Whether to search for integrals even where the counts leave none.
    pub wanted: bool,
    /// Highest degree in the positions.
    pub positions: u32,
    /// Whether to search for potentials that preserve an integral.
    pub potentials: bool,
    /// Whether to search for rotors that preserve an integral.
    pub gyrostats: bool,
    /// Largest size of a matrix in megabytes.
    pub megabytes: u64,
}

impl Default for Ansatz {
    fn default() -> Self {
        Self { wanted: false, positions: 8, potentials: false, gyrostats: false, megabytes: 500 }
    }
}

/// Runs all searches within the effort.
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

/// Lists the parameters' components in which coefficients are written, including those of J if
/// there is one.
pub fn coordinates(case: &Case) -> Vec<Formula> {
    let tensor = read(["J1", "J2", "J3", "J12", "J13", "J23"], &case.model.vocabulary);
    [components(case), tensor].concat()
}

/// Lists the factors 1/d for the denominators d.
fn factors(below: &[Formula]) -> Result<Vec<Formula>, FormulaError> {
    below.iter().map(|term| one() / &term.bracketed()).collect()
}

/// Function that a column differentiates.
fn written(
    variables: &Variables,
    below: &[Formula],
    column: &Column,
) -> Result<Ratio, FormulaError> {
    match column {
        Column::Given(_) => Ok(Ratio::of(one())),
        Column::Product { factor, exponents, .. } => {
            let below = Some(below[*factor].clone()).filter(|below| !is_one(below));
            Ok(Ratio { above: variables.monomial(exponents)?, below })
        }
    }
}
