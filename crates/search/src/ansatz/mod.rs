//! Search in a linear ansatz with thousands of unknowns, modulo a prime.
//!
//! ```text
//! monomials     a basis of polynomials in velocities and positions on the level
//! characters    sign changes that preserve the motion, and split the system into blocks
//! recording     the functions and derivatives that a row needs
//! system        one row for each random state, one column for each function; the null space
//!               consists of the integrals
//! subspace      the complement of functions of known integrals
//! coefficients  numbers, or functions of the parameters, by interpolation
//! surd          numbers a + b √n + c √m + …
//! theorem       what an ansatz shows, in words
//! verdict       each find is judged as a claim like any other
//! ```
//!
//! [`potentials`] and [`gyrostats`] start from the leading form of an integral: then a potential,
//! or a rotor or gyroscopic term, enters linearly together with the terms added to the integral.
//! [`poisson`] starts from a Hamiltonian: then the entries of a bracket enter linearly, and so do the
//! exponents of functions by which it is multiplied.

mod at_random;
mod bracket_absence;
mod bracket_family;
mod bracket_system;
mod brackets;
mod characters;
pub mod coefficients;
mod dependent;
mod force_family;
mod force_split;
mod force_text;
mod forces;
mod gyro_family;
mod gyro_free;
mod gyro_quotient;
mod gyro_second;
mod gyro_slots;
mod gyro_split;
mod gyrostats;
mod hamiltonians;
mod integrals;
pub mod monomials;
mod poisson;
mod potentials;
mod powers;
pub mod recording;
mod scales;
mod size;
mod states;
pub mod subspace;
mod surd;
pub mod system;
mod theorem;

use super::conditions::components;
use super::orbit::roots;
use super::streams::SearchStream;
use super::terms::{is_one, one, read, recorded};
use super::{Effort, SearchError, SearchReport, lists};
use crate::origin::{Remark, RemarkOrigin};
use coefficients::Ratio;
pub use force_split::positions;
use liouville::case::Case;
use liouville::formula::{Formula, FormulaError};
use liouville::mechanics::Draw;
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::proof::root_numbers;
use monomials::AnsatzVariables;
pub use poisson::{Hamiltonians, brackets};
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
    /// Whether to search for rotors and gyroscopic terms that preserve an integral.
    pub gyrostats: bool,
    /// Largest size of a matrix in megabytes.
    pub megabytes: u64,
}

impl Default for Ansatz {
    fn default() -> Self {
        Self { wanted: false, positions: 8, potentials: false, gyrostats: false, megabytes: 500 }
    }
}

/// Searches for integrals in an ansatz, and for rotors that the known ones survive.
pub fn search(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    lists::by_values(case, effort, report, progress, &mut integrals::integrals)?;
    if effort.ansatz.gyrostats && !gyro_family::GyroFamily::is_own(&case.model) {
        lists::name_first(case, effort, report, progress, &mut gyrostats::gyrostats)?;
    }
    Ok(())
}

/// Searches for potentials, forces and gyroscopic terms that the known integrals survive.
pub fn forces(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    if effort.ansatz.potentials {
        potentials::potentials(case, effort, report, progress)?;
    }
    // Integrals of these are known only after the search along orbits.
    if effort.ansatz.gyrostats && gyro_family::GyroFamily::is_own(&case.model) {
        gyrostats::gyrostats(case, effort, report, progress)?;
    }
    Ok(())
}

/// Components of J = I + mR²E, in which coefficients are often short.
pub const TENSOR: [&str; 6] = ["J1", "J2", "J3", "J12", "J13", "J23"];

/// Functions of the parameters in which coefficients are written.
pub struct Coordinates {
    /// Components of the parameters, of J if there is one, and square roots in the field.
    pub names: Vec<Formula>,
    /// Numbers under these roots.
    pub radicands: Vec<Rational>,
}

impl Coordinates {
    /// Lists the coordinates of a case.
    pub fn of(case: &Case) -> Result<Self, SearchError> {
        let tensor = read(TENSOR, &case.model.vocabulary);
        let (graph, _) = recorded(case, |jet| jet.phase.field().to_vec())?;
        let radicands = root_numbers(&graph);
        let mut own = Self { names: [components(case), tensor].concat(), radicands };
        for (root, number) in roots(case)? {
            own.names.push(root);
            own.radicands.extend(number);
        }
        Ok(own)
    }

    /// Whether a coordinate is a root, whose square is a function of others.
    pub fn is_root(name: &Formula) -> bool {
        name.text().starts_with('√')
    }

    /// Draws a prime modulo which the numbers under roots are squares, and roots keep their ratios.
    pub fn prime(radicands: &[Rational], seed: u64, number: u64) -> Modulus {
        let mut rng = SearchStream::Moduli.numbered(seed, number);
        loop {
            let modulus = rng.prime_for(radicands);
            if Self::has_roots(radicands, &modulus) {
                return modulus;
            }
        }
    }

    /// Whether all numbers are squares modulo a prime.
    pub fn has_roots(numbers: &[Rational], modulus: &Modulus) -> bool {
        let has_root = |own: &Rational| modulus.rational(own).is_some_and(|x| modulus.is_square(x));
        numbers.iter().all(has_root)
    }
}

/// Notes that a find cannot be written, once for all finds.
pub fn note_unwritten(case: &Case, what: &str, report: &mut SearchReport) {
    note(case, (what, RemarkOrigin::Unwritten), report);
}

/// Notes that a density of a map cannot be written, if no other find is noted.
pub fn note_unwritten_density(case: &Case, what: &str, report: &mut SearchReport) {
    note(case, (what, RemarkOrigin::UnwrittenDensity), report);
}

fn note(case: &Case, (what, origin): (&str, RemarkOrigin), report: &mut SearchReport) {
    let is_fixed = |draw: &Draw| matches!(draw, Draw::OneOf(_));
    let reason = match case.model.parameter_draws().iter().all(is_fixed) {
        true => {
            "has coefficients that are neither fractions nor sums of multiples of roots in the field"
        }
        false => {
            "has coefficients that are not fractions of low degree in the parameters; give values with \
             --set"
        }
    };
    let is_noted = |own: &Remark| {
        matches!(own.origin, RemarkOrigin::Unwritten | RemarkOrigin::UnwrittenDensity)
    };
    if !report.remarks.iter().any(is_noted) {
        report.remark_of(origin, format!("{what} {reason}"));
    }
}

/// Lists the factors 1/d for the denominators d.
fn factors(below: &[Formula]) -> Result<Vec<Formula>, FormulaError> {
    below.iter().map(|term| one() / &term.bracketed()).collect()
}

/// Function that a column differentiates.
fn written(
    variables: &AnsatzVariables,
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
