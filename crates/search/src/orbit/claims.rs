//! Judgement of what is found along orbits. All claims of this folder are made here.

use liouville::formula::Formula;
use liouville::verdict::{ClaimReport, Verdict};

use super::super::ask::{judged, quoted};
use super::super::integrals::tell;
use super::super::{Effort, Found, Report, SearchError};
use liouville::case::Case;

/// A statement about the case.
#[derive(Clone, Debug)]
pub enum Statement {
    /// L_vF = 0.
    Integral(String),
    /// ρ is the density of an invariant measure.
    Density(String),
    /// L_vF = G.
    Rate {
        /// Function F.
        function: String,
        /// Its rate G.
        rate: String,
    },
}

impl Statement {
    fn body(&self) -> String {
        match self {
            Statement::Integral(formula) => format!("integral = {}", quoted(formula)),
            Statement::Density(formula) => format!("density = {}", quoted(formula)),
            Statement::Rate { function, rate } => {
                format!("rate = {}\nequals = {}", quoted(function), quoted(rate))
            }
        }
    }

    fn formulas(&self) -> Vec<&str> {
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
    // A formula of a find may be too long or too deep for the reader: it is then not told.
    let reads = |formula: &&str| Formula::parse(formula, &case.model.vocabulary).is_ok();
    if !statement.formulas().iter().all(reads) {
        return Ok(None);
    }
    let reports = judged(case, &[statement.body()], effort)?;
    Ok(reports.into_iter().find(|report| report.verdict == Verdict::Proved))
}

/// Adds an integral to the report if it is proved, and independent of those there; tells whether it
/// was added.
pub fn integral(
    case: &Case,
    formula: &str,
    effort: &Effort,
    report: &mut Report,
) -> Result<bool, SearchError> {
    let statement = Statement::Integral(formula.to_string());
    let Some(found) = proved(case, &statement, effort)? else { return Ok(false) };
    let before = report.found.len();
    tell(case, formula, found, effort, report)?;
    Ok(report.found.len() > before)
}

/// Adds another find to the report if it is proved.
pub fn other(
    case: &Case,
    kind: &'static str,
    formula: &str,
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
