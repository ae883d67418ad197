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

/// The scalar integrals that a case claims and that hold, by name, less functions of the energy.
pub fn claimed(case: &Case, effort: &Effort) -> Result<Vec<(String, String)>, SearchError> {
    if effort.blind {
        return Ok(Vec::new());
    }
    let expected = case.claims.iter().filter(|claim| claim.expect == Expect::Holds);
    let (mut names, mut texts) = (Vec::new(), Vec::new());
    for claim in expected {
        if let Kind::Integral(Integral(own)) = &claim.kind
            && own.value_type() == Type::Scalar
        {
            names.push(claim.name.clone());
            texts.push(own.text().to_string());
        }
    }
    let statements: Vec<String> =
        texts.iter().map(|text| format!("integral = {}", quoted(text))).collect();
    let mut found = Vec::new();
    for ((name, text), report) in
        names.into_iter().zip(texts).zip(judged(case, &statements, effort)?)
    {
        if holds(&report) && independent(case, &[], &text, effort)?.is_some() {
            found.push((name, text));
        }
    }
    Ok(found)
}
