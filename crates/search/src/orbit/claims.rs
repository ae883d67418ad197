//! Judgement of the finds along orbits. All claims of this folder are made here.

use liouville::claim::Claim;
use liouville::formula::Formula;
use liouville::verdict::{ClaimReport, Verdict};

use super::super::ask::judged_alone;
use super::super::integrals::tell;
use super::super::{Effort, Found, Report, SearchError};
use liouville::case::Case;

/// A statement about the case.
#[derive(Clone, Debug)]
pub enum Statement {
    /// L_vF = 0.
    Integral(Formula),
    /// ρ is the density of an invariant measure.
    Density(Formula),
    /// L_vF = G.
    Rate {
        /// Function F.
        function: Formula,
        /// Its rate G.
        rate: Formula,
    },
}

impl Statement {
    fn claim(&self) -> Claim {
        match self {
            Statement::Integral(formula) => Claim::integral(formula),
            Statement::Density(formula) => Claim::density(formula),
            Statement::Rate { function, rate } => Claim::rate(function, rate),
        }
    }

    fn formulas(&self) -> Vec<&Formula> {
        match self {
            Statement::Integral(formula) | Statement::Density(formula) => vec![formula],
            Statement::Rate { function, rate } => vec![function, rate],
        }
    }
}

/// Judges a statement; returns the report of one that is proved.
pub fn proved(
    case: &Case,
    statement: &Statement,
    effort: &Effort,
) -> Result<Option<ClaimReport>, SearchError> {
    // A find that is too long or too deep for the reader of formulas is not reported.
    let reads = |formula: &&Formula| case.formula(formula.text()).is_ok();
    if !statement.formulas().iter().all(reads) {
        return Ok(None);
    }
    let report = judged_alone(case, statement.claim(), effort)?;
    Ok(report.filter(|report| report.verdict == Verdict::Proved))
}

/// Adds an integral to the report if it is proved, and independent of those there; returns whether
/// it was added.
pub fn integral(
    case: &Case,
    formula: &Formula,
    effort: &Effort,
    report: &mut Report,
) -> Result<bool, SearchError> {
    let statement = Statement::Integral(formula.clone());
    let Some(found) = proved(case, &statement, effort)? else { return Ok(false) };
    let before = report.found.len();
    tell(case, formula, found, effort, report)?;
    Ok(report.found.len() > before)
}

/// Adds another find to the report if it is proved.
pub fn other(
    case: &Case,
    kind: &'static str,
    formula: &Formula,
    statement: &Statement,
    with: Vec<(&'static str, String)>,
    effort: &Effort,
    report: &mut Report,
) -> Result<bool, SearchError> {
    let Some(found) = proved(case, statement, effort)? else { return Ok(false) };
    let found = Found { with, ..Found::new(kind, formula, None, found, &case.model) };
    report.found.push(found);
    Ok(true)
}
