//! Judgement of found formulas as claims about the case.

use super::{Effort, SearchError};
use liouville::case::{Case, Expect};
use liouville::claim::{Integral, Kind};
use liouville::formula::Type;
use liouville::verdict::{ClaimReport, Evidence, Verdict, judge};

/// Quotes a formula as a TOML string.
pub fn quoted(formula: &str) -> String {
    format!("\"{}\"", formula.replace('\\', "\\\\").replace('"', "\\\""))
}

/// Judges statements about a case, each the body of a claim, and returns the reports.
pub fn judged(
    case: &Case,
    statements: &[String],
    effort: &Effort,
) -> Result<Vec<ClaimReport>, SearchError> {
    let text: String = statements.iter().map(|body| format!("[[claim]]\n{body}\n")).collect();
    Ok(judge(&case.ask(&text)?, &effort.options)?.claims)
}

/// Whether a claim was proved or confirmed.
pub fn holds(report: &ClaimReport) -> bool {
    matches!(report.verdict, Verdict::Proved | Verdict::Confirmed)
}

/// Returns the grounds on which a formula is not a function of others, the energy and the level
/// functions; `None` if it is.
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

/// A component of an integral that a case claims.
#[derive(Clone, Debug)]
pub struct Claimed {
    /// Name of the claim.
    pub name: String,
    /// Scalar formula of the integral, or of a component of it.
    pub formula: String,
}

/// Lists the integrals that a case claims and that are proved, component by component, without functions
/// of the energy.
pub fn claimed(case: &Case, effort: &Effort) -> Result<Vec<Claimed>, SearchError> {
    if effort.blind {
        return Ok(Vec::new());
    }
    let mut all = Vec::new();
    for claim in case.claims.iter().filter(|claim| claim.expect == Expect::Holds) {
        if let Kind::Integral(Integral(own)) = &claim.kind {
            let formulas = components(own.text(), own.value_type()).into_iter();
            all.extend(formulas.map(|formula| Claimed { name: claim.name.clone(), formula }));
        }
    }
    let statements: Vec<String> =
        all.iter().map(|one| format!("integral = {}", quoted(&one.formula))).collect();
    let mut found = Vec::new();
    for (one, report) in all.into_iter().zip(judged(case, &statements, effort)?) {
        // A theorem rests on what is proved.
        if report.verdict == Verdict::Proved
            && independent(case, &[], &one.formula, effort)?.is_some()
        {
            found.push(one);
        }
    }
    Ok(found)
}

/// Splits a formula into its components as separate formulas.
pub fn components(text: &str, kind: Type) -> Vec<String> {
    match kind {
        Type::Scalar => vec![text.to_string()],
        _ => kind.indices().iter().map(|index| format!("({text}){index}")).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_are_known_by_their_components() {
        let text = "title = 'x'\nsystem = 'nonholonomic'\n[state]\nq = 'vector(1..2)'\n\
                    \"q'\" = 'vector(1..2)'\n[lagrangian]\nkinetic = \"(q',q')/2\"\n\
                    potential = '(q,q)²'\n[[claim]]\nname = 'L'\nintegral = \"q × q'\"\n";
        let case = Case::parse(text, &[]).expect("a case");
        let known = claimed(&case, &Effort::default()).expect("judged");
        let formulas: Vec<&str> = known.iter().map(|one| one.formula.as_str()).collect();
        assert_eq!(formulas, ["(q × q')[1]", "(q × q')[2]", "(q × q')[3]"]);
        assert!(known.iter().all(|one| one.name == "L"), "all come from one claim");
    }
}
