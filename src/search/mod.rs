//! Invariants that nobody typed: counted, found, proved; or excluded by a theorem.
//!
//! ```text
//! count      how many integrals polynomial in the velocities there are, with any coefficients
//! integrals  relations between L_vT for terms T that the system offers, at random points mod p
//! densities  relations between div v and L_v ln f for factors f; powers of polynomials, counted
//! verdict    each find is a claim like any other, and climbs the same ladder
//! ```

mod ansatz;
mod ask;
mod branches;
mod conditions;
mod counts;
mod densities;
mod echelon;
mod expansion;
mod halt;
mod integrals;
mod jets;
mod library;
mod linear;
mod local;
mod multipliers;
mod products;
mod second_opinion;
mod series;
mod symmetries;
mod terms;

use serde::Serialize;

use self::ask::{Claimed, quoted};
use crate::case::{Case, CaseError};
use crate::graph::Fault;
use crate::mechanics::Model;
use crate::verdict::{ClaimReport, Evidence, JudgeError, Options, Verdict};

pub use ansatz::{Ansatz, Hamiltonians};
pub use conditions::{Condition, Wanted};
pub use counts::{CountReport, Plan, plan};
pub use halt::Halt;
pub use multipliers::MultiplierReport;
pub use second_opinion::SecondOpinion;

/// Why a search cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum SearchError {
    /// Positions and velocities are not known apart, or the field has no series in them.
    #[error("integrals cannot be counted: {0}")]
    Unsplit(&'static str),
    /// The rates are no polynomials of degree 2 in the velocities.
    #[error("integrals cannot be counted: the rates are not quadratic in the velocities")]
    NotQuadratic,
    /// The equations for the coefficients are not of finite type as for Killing tensors.
    #[error("integrals cannot be counted: the rates of the positions do not take all directions")]
    NotSpanned,
    /// The field has functions that no prime field has, or no value anywhere.
    #[error("the field has no Taylor series modulo a prime: it contains exp, ln, sin, cos or x^y")]
    NoSeries,
    /// A minor is no fraction of low degree in a parameter.
    #[error("the equations are no fractions of low degree in the parameter")]
    NoFraction,
    /// A term of the user's cannot be read.
    #[error("the term `{0}` is no scalar in the names of the case")]
    NoTerm(String),
    /// The case has no such claim.
    #[error("the case has no claim `{0}`")]
    NoClaim(String),
    /// The count did not come to rest.
    #[error("the number of integrals of degree {0} did not settle: there may be infinitely many")]
    Unsettled(u32),
    /// The system is a map.
    #[error("the case is a map, and invariants are searched for of flows")]
    Discrete,
    /// It was time to stop: no fault, and told in the report.
    #[error("the search was stopped")]
    Stopped,
    /// States cannot be made inside a prime field.
    #[error("the level set has no parametrisation")]
    NoChart,
    /// No point at which all terms have a value was found.
    #[error("the terms have no common value modulo a prime: they contain exp, ln, sin, cos or x^y")]
    NoPoints,
    /// Recording failed.
    #[error(transparent)]
    Fault(#[from] Fault),
    /// A find cannot be asked about the case.
    #[error("a find cannot be read in the names of the case: {0}")]
    Unreadable(#[from] CaseError),
    /// Judging failed.
    #[error(transparent)]
    Judge(#[from] JudgeError),
}

impl SearchError {
    /// Does it say that something cannot be counted, and nothing about the rest of a search?
    fn is_of_count(&self) -> bool {
        use SearchError::{NoSeries, NotQuadratic, NotSpanned, Unsettled, Unsplit};
        matches!(self, NoSeries | NotQuadratic | NotSpanned | Unsettled(_) | Unsplit(_))
    }

    /// What to do about it.
    pub fn help(&self) -> &'static str {
        match self {
            SearchError::Judge(error) => error.help(),
            SearchError::NoChart => "give [level.chart], or level equations that can be solved",
            SearchError::NoClaim(_) => "name a claim as `liouville check` prints it",
            SearchError::Unsettled(_) => "ask for a lower --degree",
            SearchError::Discrete => "claim the invariants of a map, and let `check` judge them",
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
    /// Terms of integrals beside those that the system offers.
    pub terms: Vec<String>,
    /// Look for conditions on the parameters too.
    pub conditions: Option<Wanted>,
    /// A count that may take longer is left out.
    pub seconds: f64,
    /// What is looked for in a global ansatz.
    pub ansatz: Ansatz,
    /// Look for brackets, with these Hamiltonians.
    pub poisson: Option<Hamiltonians>,
    /// When to stop before the end.
    pub halt: Halt,
    /// How finds are judged.
    pub options: Options,
}

impl Default for Effort {
    /// Integrals up to degree 4, a minute for each count, and no end before that.
    fn default() -> Self {
        Self {
            degree: 4,
            blind: false,
            terms: Vec::new(),
            conditions: None,
            seconds: 60.0,
            ansatz: Ansatz::default(),
            poisson: None,
            halt: Halt::default(),
            options: Options::default(),
        }
    }
}

/// Something that was found.
#[derive(Clone, Debug, Serialize)]
pub struct Found {
    /// `integral`, `density`, `symmetry-field` or `bracket`.
    pub kind: &'static str,
    /// In the names of the case.
    pub formula: String,
    /// Abbreviations in it that are not the case's, in order.
    #[serde(rename = "let", skip_serializing_if = "Vec::is_empty")]
    pub abbreviations: Vec<(&'static str, &'static str)>,
    /// What it holds with: a `potential` or `gyrostat` that the case has not; a bracket with its
    /// `Hamiltonian`, and each `Casimir` that is known.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub with: Vec<(&'static str, String)>,
    /// Is it a function of the energy and the level? Such finds are not told, so it never is.
    pub trivial: bool,
    /// The claim of the case that it follows from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub known: Option<String>,
    /// What the ladder says.
    pub verdict: Verdict,
    /// On what grounds.
    pub evidence: Evidence,
}

impl Found {
    /// A formula and the grounds for it.
    fn new(
        kind: &'static str,
        formula: &str,
        known: Option<String>,
        report: ClaimReport,
        model: &Model,
    ) -> Self {
        let mut needed = vec![formula];
        let mut abbreviations = library::abbreviations(model);
        abbreviations.reverse();
        abbreviations.retain(|(name, text)| {
            let used = needed.iter().any(|formula| formula.contains(name));
            if used {
                needed.push(text);
            }
            used
        });
        abbreviations.reverse();
        Self {
            kind,
            formula: formula.to_string(),
            abbreviations,
            with: Vec::new(),
            trivial: false,
            known,
            verdict: report.verdict,
            evidence: report.evidence,
        }
    }
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
    /// The numbers of polynomials whose powers are densities.
    pub multipliers: Vec<MultiplierReport>,
    /// What was found.
    pub found: Vec<Found>,
    /// What cannot be.
    pub excluded: Vec<Excluded>,
    /// Singular values of the matrices in which integrals were looked for.
    pub opinions: Vec<SecondOpinion>,
    /// For which parameters claims hold that fail in general.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub conditions: Vec<Condition>,
    /// What could not be done, and why.
    pub remarks: Vec<String>,
    /// What a search that was stopped did not reach; nothing where it came to its end.
    pub unreached: Vec<String>,
    /// The integrals that the case claims, which finds are compared with.
    #[serde(skip)]
    claimed: Vec<Claimed>,
}

impl Report {
    /// The formulas that were found for the case as it is, of one kind.
    pub fn formulas(&self, kind: &str) -> impl Iterator<Item = &str> {
        let own = move |found: &&Found| found.kind == kind && found.with.is_empty();
        let found = self.found.iter().filter(own);
        found.map(|found| found.formula.as_str())
    }

    fn remark(&mut self, remark: String) {
        if !self.remarks.contains(&remark) {
            self.remarks.push(remark);
        }
    }

    /// Runs a part of a search; one that is stopped is noted by its name.
    fn stage(
        &mut self,
        name: &str,
        effort: &Effort,
        run: impl FnOnce(&mut Self) -> Result<(), SearchError>,
    ) -> Result<(), SearchError> {
        match effort.halt.check().and_then(|()| run(self)) {
            Err(SearchError::Stopped) => {
                self.unreached.push(name.to_string());
                Ok(())
            }
            other => other,
        }
    }
}

/// Searches a case for integrals, densities and symmetries.
///
/// `progress` is told what comes next, with its size. A search that is stopped reports what it has
/// reached until then, and what it has not.
pub fn search(
    case: &Case,
    effort: &Effort,
    progress: &mut dyn FnMut(&str),
) -> Result<Report, SearchError> {
    if case.model.system.is_map() {
        return Err(SearchError::Discrete);
    }
    let mut report = Report::default();
    let case = &abbreviated(case)?;
    report.claimed = ask::claimed(case, effort)?;
    report.stage("the number of integrals", effort, |report| {
        counts::count(case, effort, report, progress)
    })?;
    // Integrals of degree 1 come first: those of degree 2 may be functions of them.
    report.stage("products of factors", effort, |report| {
        progress("factors of densities");
        densities::densities(case, effort, report)
    })?;
    report.stage("integrals among the terms", effort, |report| {
        progress("terms of integrals");
        integrals::integrals(case, effort, report)
    })?;
    report.stage("linear symmetry fields", effort, |report| {
        progress("linear symmetry fields");
        symmetries::symmetries(case, effort, report)
    })?;
    report.stage("a global ansatz", effort, |report| {
        ansatz::search(case, effort, report, progress)
    })?;
    counts::conclude(case, effort, &mut report)?;
    report.stage("densities that depend on the velocities", effort, |report| {
        multipliers::multipliers(case, effort, report, progress)
    })?;
    if let Some(wanted) = &effort.conditions {
        report.stage("conditions on the parameters", effort, |report| {
            conditions::conditions(case, wanted, effort, report, progress)
        })?;
    }
    branches::withdraw(case, effort, &mut report)?;
    Ok(report)
}

/// The case with the names that the library's terms use.
fn abbreviated(case: &Case) -> Result<Case, SearchError> {
    let names = library::abbreviations(&case.model);
    let definition = |(name, text): &(&str, &str)| format!("{} = {}\n", quoted(name), quoted(text));
    let entries: String = names.iter().map(definition).collect();
    let mut named = case.ask(&format!("[let]\n{entries}"))?;
    named.claims = case.claims.clone();
    Ok(named)
}
