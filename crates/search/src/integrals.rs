//! Search for integrals that are sums of terms offered by the system.

use num_dual::Dual;

use super::ask::{Claimed, are_comparable, compared, holds, independent, judged, judged_alone};
use super::budget::Budget;
use super::effort::primitive;
use super::library;
use super::linear::SampledFunctions;
use super::lists::{ListedCase, combinations};
use super::lower::{Degrees, prefer};
use super::momenta;
use super::origin::RemarkOrigin;
use super::second_opinion::{self, second_opinion};
use super::terms::{is_one, recorded, sum};
use super::{Effort, Found, FoundKind, SearchError, SearchReport};
use liouville::case::Case;
use liouville::claim::{Claim, LevelSubset};
use liouville::formula::{Formula, FormulaError};
use liouville::graph::Expr;
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::scalar::Scalar;
use liouville::verdict::{ClaimReport, Independence, Verdict};

/// Largest number of integrals that are kept although they are functions of others.
const MOST_DEPENDENT: usize = 12;

/// Searches for integrals; proved ones go into the report.
pub fn integrals(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let terms = terms(case, effort, report)?;
    let candidates = over_denominators(case, &terms, &Rational::from(0), effort, report)?;
    let candidates: Vec<Formula> =
        candidates.into_iter().map(|own| root_of_square(case, &own).unwrap_or(own)).collect();
    let claims: Vec<Claim> = candidates.iter().map(Claim::integral).collect();
    let reports = judged(case, &claims, effort)?;
    let mut proved: Vec<(Formula, ClaimReport)> = candidates
        .into_iter()
        .zip(reports)
        .filter(|(_, found)| {
            let new = matches!(found.evidence.independence, Some(Independence::Independent));
            new && holds(found)
        })
        .collect();
    // Of functions that depend on each other, the shortest is reported; those linear in the velocities first.
    proved.order_by_key(|(formula, _)| formula.text().chars().count());
    let (linear, proved) = split(case, proved, effort)?;
    for (formula, found) in linear {
        effort.halt.check()?;
        tell(case, &formula, found, effort, report)?;
    }
    momenta::integrals(case, effort, report)?;
    for (formula, found) in proved {
        effort.halt.check()?;
        tell(case, &formula, found, effort, report)?;
        // Others may be no polynomials in those that are told.
        let is_told = report.found.iter().any(|own| own.text() == formula.text());
        if !is_told && report.dependent.len() < MOST_DEPENDENT {
            report.dependent.push(formula);
        }
    }
    Ok(())
}

/// The function G of an integral that is G² as written, which is an integral too.
fn root_of_square(case: &Case, formula: &Formula) -> Option<Formula> {
    let root = case.formula(formula.text().trim().strip_suffix('²')?).ok()?;
    (root.raised(2).ok()?.text() == formula.text().trim()).then_some(root)
}

/// Proved integrals with their reports.
type Proved = Vec<(Formula, ClaimReport)>;

/// Separates the integrals of degree at most 1 in the velocities of a Lagrangian system.
fn split(case: &Case, proved: Proved, effort: &Effort) -> Result<(Proved, Proved), SearchError> {
    let Some(degrees) = Degrees::of(case, effort) else { return Ok((Vec::new(), proved)) };
    let (mut linear, mut others) = (Vec::new(), Vec::new());
    for own in proved {
        match degrees.of_formula(&own.0)?.is_some_and(|degree| degree <= 1) {
            true => linear.push(own),
            false => others.push(own),
        }
    }
    Ok((linear, others))
}

/// Adds an integral to the report, unless it depends on those already there.
pub fn tell(
    case: &Case,
    formula: &Formula,
    found: ClaimReport,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    // What is constant says nothing.
    if found.evidence.independence == Some(Independence::Constant) {
        return Ok(());
    }
    let told: Vec<Formula> = report.functions(FoundKind::Integral).cloned().collect();
    if !are_comparable(case, &told) {
        let count = told.len();
        report.remark(format!(
            "an integral is not listed, since it cannot be compared with the {count} that are: {formula}"
        ));
        return Ok(());
    }
    if independent(case, &told, formula, effort)?.is_none() {
        return prefer(case, formula, found, effort, report);
    }
    let known = claimed_by(case, formula, effort, report)?;
    report.found.push(Found::new(FoundKind::Integral, formula, known, found, &case.model));
    Ok(())
}

/// Judges whether a function is an integral, and adds it to the report if it is proved to be one.
pub fn tell_if_proved(
    case: &Case,
    formula: &Formula,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let judged = judged_alone(case, Claim::integral(formula), effort)?;
    match judged.filter(|own| own.verdict == Verdict::Proved) {
        Some(found) => tell(case, formula, found, effort, report),
        None => Ok(()),
    }
}

/// Names of the claims of the case of which an integral is a function, for each combination of listed
/// values: of one, where that is enough.
pub fn claimed_by(
    case: &Case,
    formula: &Formula,
    effort: &Effort,
    report: &SearchReport,
) -> Result<Option<String>, SearchError> {
    if report.claimed.is_empty() {
        return Ok(None);
    }
    let Some(all) = combinations(case) else { return Ok(None) };
    let is_function = |of: &[Formula]| -> Result<bool, SearchError> {
        for ListedCase { case, .. } in &all {
            let found = compared(case, of, formula, effort)?;
            if found.is_none_or(|found| found.verdict != Verdict::Refuted) {
                return Ok(false);
            }
        }
        Ok(true)
    };
    for own in &report.claimed {
        if is_function(std::slice::from_ref(&own.formula))? {
            return Ok(Some(own.name.clone()));
        }
    }
    // Claims that are independent, in every case.
    let mut kept: Vec<&Claimed> = Vec::new();
    let formulas = |kept: &[&Claimed]| -> Vec<Formula> {
        kept.iter().map(|own| own.formula.clone()).collect()
    };
    for own in &report.claimed {
        let mut is_further = true;
        for ListedCase { case, .. } in &all {
            is_further &= independent(case, &formulas(&kept), &own.formula, effort)?.is_some();
        }
        if is_further {
            kept.push(own);
        }
    }
    if kept.len() < 2 || !is_function(&formulas(&kept))? {
        return Ok(None);
    }
    for own in kept.clone() {
        let others: Vec<&Claimed> =
            kept.iter().copied().filter(|other| !std::ptr::eq(*other, own)).collect();
        if is_function(&formulas(&others))? {
            kept = others;
        }
    }
    let mut names: Vec<&str> = kept.iter().map(|own| own.name.as_str()).collect();
    names.dedup();
    Ok(Some(names.join(", ")))
}

/// Lists the terms given by the user and offered by the system, without those that depend on
/// others.
pub fn terms(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<Vec<Formula>, SearchError> {
    let model = &case.model;
    let own: Result<Vec<Formula>, SearchError> =
        effort.terms.iter().map(|term| Ok(primitive(term.read(model)?, model))).collect();
    if let Some(count) = library::without_squares(model) {
        report.remark(format!("products of the {count} variables are not among the terms"));
    }
    let (own, offered) = (own?, library::integrals(model));
    distinct(case, [own, offered].concat(), effort, report)
}

/// Finds sums P of terms, over the possible denominators, with L_vP + α div v P = 0 at random
/// points; α, the weight, is 0 for integrals.
pub fn over_denominators(
    case: &Case,
    terms: &[Formula],
    weight: &Rational,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<Vec<Formula>, SearchError> {
    let model = &case.model;
    let kept = LevelSubset::level(model).kept;
    let mut candidates = Vec::new();
    if terms.is_empty() {
        return Ok(candidates);
    }
    for denominator in library::denominators(model) {
        effort.halt.check()?;
        let (graph, rates) = recorded(case, |jet| {
            let moved = jet.along_field();
            let below: Dual<Expr> = moved.scalar(&denominator);
            let growth = (!weight.is_zero())
                .then(|| Expr::rational(weight) * (jet.divergence() - jet.level_cofactor(&kept)));
            let rate = |term: &Formula| {
                let value: Dual<Expr> = moved.scalar(term) / below;
                growth.map_or(value.eps, |growth| value.eps + growth * value.re)
            };
            terms.iter().map(|term| vec![rate(term)]).collect::<Vec<_>>()
        })?;
        let seed = effort.options.seed;
        let mut functions = SampledFunctions::with_symbols(case, &graph, &rates, effort)?;
        let budget = Budget::of(effort);
        let relations = match functions.relations_within(&budget) {
            Err(error @ (SearchError::Long { .. } | SearchError::Large { .. })) => {
                report.remark(format!("terms over {denominator} are left out: {error}"));
                continue;
            }
            other => other?,
        };
        let (vectors, irrational) = relations.rational()?;
        let dimension = vectors.len() + irrational;
        let count = functions.count();
        match !functions.has_symbols && budget.allows(second_opinion::steps(count)) {
            true => {
                let opinion = second_opinion(&functions, denominator.text(), dimension, seed);
                report.opinions.extend(opinion);
            }
            false if functions.has_symbols => {}
            false => report.remark(format!(
                "no cross-check of {count} terms over {denominator}: their singular values take too long"
            )),
        }
        if irrational > 0 {
            let text = match irrational {
                1 => "1 relation does not have small rational coefficients".to_string(),
                more => format!("{more} relations do not have small rational coefficients"),
            };
            report.remark_of(RemarkOrigin::Irrational, text);
        }
        let written = |vector: &Vec<Rational>| {
            let above = sum(vector, terms)?;
            if is_one(&denominator) { Ok(above) } else { above.bracketed() / &denominator }
        };
        let written: Result<Vec<Formula>, FormulaError> = vectors.iter().map(written).collect();
        candidates.extend(written?);
    }
    Ok(candidates)
}

/// Keeps the terms that do not depend on earlier ones on the level.
fn distinct(
    case: &Case,
    terms: Vec<Formula>,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<Vec<Formula>, SearchError> {
    let (graph, values) = recorded(case, |jet| {
        terms.iter().map(|term| vec![jet.phase.scalar(term)]).collect::<Vec<_>>()
    })?;
    let mut functions = SampledFunctions::with_symbols(case, &graph, &values, effort)?;
    let defined = functions.defined();
    functions.restrict(&defined);
    let kept = match functions.relations_within(&Budget::of(effort)) {
        Ok(relations) => relations.independent(),
        Err(error @ (SearchError::Long { .. } | SearchError::Large { .. })) => {
            report.remark(format!("integrals among the terms are not sought: {error}"));
            return Ok(Vec::new());
        }
        Err(SearchError::NoPoints) => {
            report.remark(SearchError::NoPoints.to_string());
            return Ok(Vec::new());
        }
        Err(error) => return Err(error),
    };
    Ok(kept.into_iter().map(|index| terms[defined[index]].clone()).collect())
}
