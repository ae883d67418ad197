//! Finds are claims like any other: they are asked about the case, and judged.

use super::{Effort, SearchError};
use crate::case::{Case, Expect};
use crate::claim::{Integral, Kind};
use crate::formula::Type;
use crate::verdict::{ClaimReport, Evidence, Verdict, judge};

/// A formula as a TOML string.
pub fn quoted(formula: &str) -> String {
    format!("\"{}\"", formula.replace('\\', "\\\\").replace('"', "\\\""))
}

/// The reports on statements about a case, each the body of a claim.
pub fn judged(
    case: &Case,
    statements: &[String],
    effort: &Effort,
) -> Result<Vec<ClaimReport>, SearchError> {
    let text: String = statements.iter().map(|body| format!("[[claim]]\n{body}\n")).collect();
    Ok(judge(&case.ask(&text)?, &effort.options)?.claims)
}

/// Does a claim hold?
pub fn holds(report: &ClaimReport) -> bool {
    matches!(report.verdict, Verdict::Proved | Verdict::Confirmed)
}

/// The grounds on which a formula is no function of others, the energy and the level functions;
/// nothing if it is.
pub fn independent(
    case: &Case,
    known: &[String],
    formula: &str,
    effort: &Effort,
) -> Result<Option<Evidence>, SearchError> {
    let energy = case.model.vocabulary.find("energy").map(|_| "energy");
    let texts = known.iter().map(String::as_str).chain(energy).chain([formula]);
    let list: Vec<String> = texts.map(quoted).collect();
    let reports = judged(case, &[format!("independent = [{}]", list.join(", "))], effort)?;
    let proved = |report: &ClaimReport| report.verdict == Verdict::Proved;
    Ok(reports.into_iter().find(proved).map(|report| report.evidence))
}

/// The scalar integrals that a case claims, by name, less those that are functions of the energy.
pub fn claimed(case: &Case, effort: &Effort) -> Result<Vec<(String, String)>, SearchError> {
    let mut found = Vec::new();
    if effort.blind {
        return Ok(found);
    }
    for claim in case.claims.iter().filter(|claim| claim.expect == Expect::Holds) {
        let Kind::Integral(Integral(own)) = &claim.kind else { continue };
        let text = own.text().to_string();
        let is_new = |text| independent(case, &[], text, effort);
        if own.value_type() == Type::Scalar && is_new(&text)?.is_some() {
            found.push((claim.name.clone(), text));
        }
    }
    Ok(found)
}
