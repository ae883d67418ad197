//! Search for integrals that are sums of terms offered by the system.

use num_dual::Dual;

use super::ask::{holds, independent, judged, quoted};
use super::library;
use super::linear::Functions;
use super::second_opinion::second_opinion;
use super::terms::{Term, read, recorded, sum};
use super::{Effort, Found, Report, SearchError};
use liouville::case::Case;
use liouville::claim::Place;
use liouville::graph::Expr;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use liouville::verdict::{ClaimReport, Independence};

/// Searches for integrals; proved ones go into the report.
pub fn integrals(case: &Case, effort: &Effort, report: &mut Report) -> Result<(), SearchError> {
    let terms = terms(case, effort, report)?;
    let candidates = over_denominators(case, &terms, &Rational::from(0), effort, report)?;
    let statements: Vec<String> =
        candidates.iter().map(|formula| format!("integral = {}", quoted(formula))).collect();
    let reports = judged(case, &statements, effort)?;
    let mut proved: Vec<(String, ClaimReport)> = candidates
        .into_iter()
        .zip(reports)
        .filter(|(_, found)| {
            let new = matches!(found.evidence.independence, Some(Independence::Independent));
            new && holds(found)
        })
        .collect();
    // Of functions that depend on each other, the shortest is reported.
    proved.sort_by_key(|(formula, _)| formula.chars().count());
    for (formula, found) in proved {
        effort.halt.check()?;
        tell(case, &formula, found, effort, report)?;
    }
    Ok(())
}

/// Adds an integral to the report, unless it depends on those already there.
pub fn tell(
    case: &Case,
    formula: &str,
    found: ClaimReport,
    effort: &Effort,
    report: &mut Report,
) -> Result<(), SearchError> {
    let told: Vec<String> = report.formulas("integral").map(str::to_string).collect();
    if independent(case, &told, formula, effort)?.is_none() {
        return Ok(());
    }
    let mut known = None;
    for own in &report.claimed {
        let formulas = std::slice::from_ref(&own.formula);
        if independent(case, formulas, formula, effort)?.is_none() {
            known = Some(own.name.clone());
            break;
        }
    }
    report.found.push(Found::new("integral", formula, known, found, &case.model));
    Ok(())
}

/// Lists the terms given by the user and offered by the system, without those that depend on
/// others.
pub fn terms(case: &Case, effort: &Effort, report: &mut Report) -> Result<Vec<Term>, SearchError> {
    let model = &case.model;
    let vocabulary = &model.vocabulary;
    let own = read(effort.terms.clone(), vocabulary);
    if own.len() < effort.terms.len() {
        let unread = |text: &&String| !own.iter().any(|term| &term.text == *text);
        let text = effort.terms.iter().find(unread).cloned().unwrap_or_default();
        return Err(SearchError::NoTerm(text));
    }
    let offered = read(library::integrals(model), vocabulary);
    distinct(case, [own, offered].concat(), effort, report)
}

/// Finds sums P of terms, over the possible denominators, with L_vP + α div v P = 0 at random
/// points; α, the weight, is 0 for integrals.
pub fn over_denominators(
    case: &Case,
    terms: &[Term],
    weight: &Rational,
    effort: &Effort,
    report: &mut Report,
) -> Result<Vec<String>, SearchError> {
    let model = &case.model;
    let kept = Place::level(model).kept;
    let mut candidates = Vec::new();
    if terms.is_empty() {
        return Ok(candidates);
    }
    for denominator in read(library::denominators(model), &model.vocabulary) {
        effort.halt.check()?;
        let (graph, rates) = recorded(case, |jet| {
            let moved = jet.along_field();
            let below: Dual<Expr> = moved.scalar(&denominator.formula);
            let growth = (!weight.is_zero())
                .then(|| Expr::rational(weight) * (jet.divergence() - jet.level_cofactor(&kept)));
            let rate = |term: &Term| {
                let value: Dual<Expr> = moved.scalar(&term.formula) / below;
                growth.map_or(value.eps, |growth| value.eps + growth * value.re)
            };
            terms.iter().map(|term| vec![rate(term)]).collect::<Vec<_>>()
        })?;
        let seed = effort.options.seed;
        let mut functions = Functions::new(case, &graph, &rates, seed)?;
        let (vectors, irrational) = functions.relations()?.rational();
        let dimension = vectors.len() + irrational;
        report.opinions.extend(second_opinion(&functions, &denominator.text, dimension, seed));
        if irrational > 0 {
            let many = format!("{irrational} relations have no small rational coefficients");
            report.remark(many);
        }
        let texts: Vec<&str> = terms.iter().map(|term| term.text.as_str()).collect();
        candidates.extend(vectors.iter().map(|vector| match denominator.text.as_str() {
            "1" => sum(vector, &texts),
            below => format!("({})/{below}", sum(vector, &texts)),
        }));
    }
    Ok(candidates)
}

/// Keeps the terms that do not depend on earlier ones on the level.
fn distinct(
    case: &Case,
    terms: Vec<Term>,
    effort: &Effort,
    report: &mut Report,
) -> Result<Vec<Term>, SearchError> {
    let (graph, values) = recorded(case, |jet| {
        terms.iter().map(|term| vec![jet.phase.scalar(&term.formula)]).collect::<Vec<_>>()
    })?;
    let mut functions = Functions::new(case, &graph, &values, effort.options.seed)?;
    let defined = functions.defined();
    functions.restrict(&defined);
    let kept = match functions.relations() {
        Ok(relations) => relations.independent(),
        Err(SearchError::NoPoints) => {
            report.remark(SearchError::NoPoints.to_string());
            return Ok(Vec::new());
        }
        Err(error) => return Err(error),
    };
    Ok(kept.into_iter().map(|index| terms[defined[index]].clone()).collect())
}
