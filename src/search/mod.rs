//! Invariants that nobody typed: counted, found, proved; or excluded by a theorem.
//!
//! ```text
//! count      how many integrals polynomial in the velocities there are, with any coefficients
//! integrals  relations between L_vT for terms T that the system offers, at random points mod p
//! densities  relations between div v and L_v ln f for factors f
//! verdict    each find is a claim like any other, and climbs the same ladder
//! ```

mod echelon;
mod find;
mod jets;
mod library;
mod linear;
mod local;
mod series;

use serde::Serialize;

use crate::case::Case;
use crate::graph::Fault;
use crate::verdict::{Evidence, JudgeError, Options, Verdict};

pub use find::{densities, integrals};
pub use jets::Count;
use local::Local;

/// Why a search cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum SearchError {
    /// Positions and velocities are not known apart.
    #[error("integrals cannot be counted: {0}")]
    Unsplit(&'static str),
    /// The rates are no polynomials of degree 2 in the velocities.
    #[error("integrals cannot be counted: the rates are not quadratic in the velocities")]
    NotQuadratic,
    /// The field has functions that no prime field has, or no value anywhere.
    #[error("the field has no Taylor series modulo a prime: it contains exp, ln, sin, cos or x^y")]
    NoSeries,
    /// The count did not come to rest.
    #[error("the number of integrals of degree {0} did not settle: there may be infinitely many")]
    Unsettled(u32),
    /// States cannot be made inside a prime field.
    #[error("the level set has no parametrisation")]
    NoChart,
    /// No point at which all terms have a value was found.
    #[error("the terms have no common value modulo a prime: they contain exp, ln, sin, cos or x^y")]
    NoPoints,
    /// Recording failed.
    #[error(transparent)]
    Fault(#[from] Fault),
    /// Judging failed.
    #[error(transparent)]
    Judge(#[from] JudgeError),
}

impl SearchError {
    /// What to do about it.
    pub fn help(&self) -> &'static str {
        match self {
            SearchError::Judge(error) => error.help(),
            SearchError::NoChart => "give [level.chart], or level equations that can be solved",
            SearchError::Unsettled(_) => "ask for a lower --degree",
            _ => "see docs/writing-a-case.md",
        }
    }
}

/// What to look for, and how far.
#[derive(Clone, Debug)]
pub struct Effort {
    /// Integrals are counted up to this degree in the velocities.
    pub degree: u32,
    /// Ignore what the case claims.
    pub blind: bool,
    /// How finds are judged.
    pub options: Options,
}

/// Something that was found.
#[derive(Clone, Debug, Serialize)]
pub struct Found {
    /// `integral` or `density`.
    pub kind: &'static str,
    /// In the names of the case.
    pub formula: String,
    /// Is it a function of what is known anyway?
    pub trivial: bool,
    /// The claim of the case that it follows from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub known: Option<String>,
    /// What the ladder says.
    pub verdict: Verdict,
    /// On what grounds.
    pub evidence: Evidence,
}

/// What cannot be.
#[derive(Clone, Debug, Serialize)]
pub struct Excluded {
    /// What was asked.
    pub ansatz: String,
    /// The dimension that was found.
    pub dimension: usize,
    /// Of these, how many are functions of what is known.
    pub known: usize,
    /// Log₂ of the probability of an error; absent where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_log2: Option<f64>,
    /// The theorem, with its hypotheses.
    pub theorem: String,
}

/// The outcome of a search.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// The numbers of integrals, degree by degree.
    pub counts: Vec<CountReport>,
    /// What was found.
    pub found: Vec<Found>,
    /// What cannot be.
    pub excluded: Vec<Excluded>,
    /// What could not be done, and why.
    pub remarks: Vec<String>,
}

/// The number of integrals of a degree.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct CountReport {
    /// The degree in the velocities.
    pub degree: u32,
    /// All degrees up to it together?
    pub mixed: bool,
    /// The number of independent ones, an upper bound for generic parameters.
    pub dimension: usize,
    /// Powers of the energy among them, and constants.
    pub known: usize,
    /// Unknowns of the linear system.
    pub unknowns: usize,
    /// Its equations.
    pub equations: usize,
}

/// Searches a case for integrals and densities.
pub fn search(
    case: &Case,
    effort: &Effort,
    progress: &mut dyn FnMut(&str),
) -> Result<Report, SearchError> {
    let mut report = Report::default();
    match Local::of(case, &[]) {
        Ok(local) => count(case, &local, effort, &mut report, progress),
        Err(error @ SearchError::Unsplit(_)) => report.remarks.push(error.to_string()),
        Err(error) => return Err(error),
    }
    progress("terms of integrals");
    find::integrals(case, effort, &mut report)?;
    progress("factors of densities");
    find::densities(case, effort, &mut report)?;
    exclude(case, &mut report);
    Ok(report)
}

/// Counts integrals degree by degree, as far as the effort goes.
fn count(
    case: &Case,
    local: &Local,
    effort: &Effort,
    report: &mut Report,
    progress: &mut dyn FnMut(&str),
) {
    let mixed = case.model.system.energy_is_inhomogeneous();
    let with_energy = case.model.system.has_energy();
    for degree in 1..=effort.degree {
        let velocities = local.coordinates.velocities as u32;
        let size = binomial(degree + velocities - 1, velocities - 1)
            * binomial(
                2 * degree + 3 + local.coordinates.positions as u32,
                local.coordinates.positions as u32,
            );
        progress(&format!("integrals of degree {degree}: some {size} unknowns"));
        match jets::count(local, degree, mixed, effort.options.seed) {
            Ok(Count { dimension, size: (unknowns, equations), .. }) => {
                // 1, E, E², … as far as their degree fits.
                let known = match (mixed, with_energy) {
                    (true, true) => degree as usize / 2 + 1,
                    (true, false) => 1,
                    (false, true) => usize::from(degree % 2 == 0),
                    (false, false) => 0,
                };
                report.counts.push(CountReport {
                    degree,
                    mixed,
                    dimension,
                    known,
                    unknowns,
                    equations,
                });
            }
            Err(error) => {
                report.remarks.push(error.to_string());
                return;
            }
        }
    }
}

fn binomial(n: u32, k: u32) -> u64 {
    (1..=u64::from(k)).fold(1, |product, i| product * (u64::from(n - k) + i) / i)
}

/// States what the counts exclude.
fn exclude(case: &Case, report: &mut Report) {
    let last = report.counts.iter().take_while(|count| count.dimension == count.known).last();
    let Some(last) = last else { return };
    let forces = if last.mixed {
        "with these forces"
    } else if case.model.system.is_free() {
        "and, as the leading form of such an integral is one of the free motion, for every gyrostat \
         and every potential"
    } else {
        "for the free motion"
    };
    report.excluded.push(Excluded {
        ansatz: format!(
            "polynomials in the velocities of degree {} {}, with any smooth coefficients in the positions",
            if report.counts[0].degree == last.degree { "" } else { "up to" },
            last.degree
        )
        .replace("  ", " "),
        dimension: last.dimension,
        known: last.known,
        error_log2: None,
        theorem: format!(
            "For generic values of the free parameters, and the given values of the fixed ones, no integral \
             polynomial in the velocities of degree at most {} is independent of the energy, {forces}.",
            last.degree
        ),
    });
}
