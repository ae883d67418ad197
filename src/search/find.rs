//! Integrals and densities from relations between terms.

use num_dual::Dual;

use super::library;
use super::linear::Functions;
use super::{Effort, Found, Report, SearchError};
use crate::case::{Case, Claim, Expect};
use crate::claim::{Density, Integral, Kind, Place};
use crate::formula::Formula;
use crate::graph::{Expr, Graph, record};
use crate::mechanics::calculus::Jet;
use crate::mechanics::{Phase, Vocabulary};
use crate::number::rational::Rational;
use crate::verdict::{ClaimReport, Independence, Verdict, judge};

/// A term that can be read in the names of a case.
struct Term {
    text: String,
    formula: Formula,
}

fn read(texts: Vec<String>, vocabulary: &Vocabulary) -> Vec<Term> {
    let scalar = |formula: &Formula| formula.value_type() == crate::formula::Type::Scalar;
    texts
        .into_iter()
        .filter_map(|text| {
            let formula = Formula::parse(&text, vocabulary).ok().filter(scalar)?;
            Some(Term { text, formula })
        })
        .collect()
}

/// Records something at a point of phase space.
fn recorded<R>(
    case: &Case,
    make: impl FnOnce(&Jet<'_, Expr>) -> R,
) -> Result<(Graph, R), SearchError> {
    let model = &case.model;
    let inputs = model.free_components() + model.dimension();
    Ok(record(inputs, |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        make(&Jet::new(Phase::new(model, parameters, state)))
    })?)
}

/// Looks for integrals that are sums of the library's terms.
pub fn integrals(case: &Case, effort: &Effort, report: &mut Report) -> Result<(), SearchError> {
    let model = &case.model;
    let terms = read(library::integrals(model), &model.vocabulary);
    if terms.is_empty() {
        return Ok(());
    }
    let seed = effort.options.seed;
    // Terms that depend on those before them on the level say nothing new.
    let (graph, values) = recorded(case, |jet| {
        terms.iter().map(|term| vec![jet.phase.scalar(&term.formula)]).collect::<Vec<_>>()
    })?;
    let kept = match Functions::new(case, &graph, &values, seed)?.relations() {
        Ok(relations) => relations.independent(terms.len()),
        Err(SearchError::NoPoints) => {
            report.remarks.push(SearchError::NoPoints.to_string());
            return Ok(());
        }
        Err(error) => return Err(error),
    };
    let terms: Vec<&Term> = kept.into_iter().map(|index| &terms[index]).collect();
    let mut candidates = Vec::new();
    for denominator in read(library::denominators(model), &model.vocabulary) {
        let (graph, rates) = recorded(case, |jet| {
            let moved = jet.along_field();
            let below: Dual<Expr> = moved.scalar(&denominator.formula);
            terms
                .iter()
                .map(|term| vec![(moved.scalar(&term.formula) / below).eps])
                .collect::<Vec<_>>()
        })?;
        let relations = Functions::new(case, &graph, &rates, seed)?.relations()?;
        let (vectors, irrational) = relations.rational();
        if irrational > 0 {
            report
                .remarks
                .push(format!("{irrational} relations have no small rational coefficients"));
        }
        for vector in vectors {
            let sum = sum(&vector, &terms);
            candidates.push(match denominator.text.as_str() {
                "1" => sum,
                below => format!("({sum})/{below}"),
            });
        }
    }
    let reports = judged(case, &candidates, effort, |formula| Kind::Integral(Integral(formula)))?;
    // Of functions that depend on each other, the shortest is told.
    let mut order: Vec<usize> = (0..reports.len()).collect();
    order.sort_by_key(|index| candidates[*index].chars().count());
    let mut told: Vec<String> = Vec::new();
    for index in order {
        let (formula, found) = (&candidates[index], &reports[index]);
        let general = !matches!(found.evidence.independence, Some(Independence::Independent));
        if general || !holds(found) {
            continue;
        }
        if depends(case, &told, formula, effort)? {
            continue;
        }
        told.push(formula.clone());
        let known = claimed(case, formula, effort)?;
        report.found.push(find("integral", formula, known, found));
    }
    Ok(())
}

/// Looks for densities that are products of powers of the library's factors, and for integrals that
/// are such products with a factor linear in the velocities.
pub fn densities(case: &Case, effort: &Effort, report: &mut Report) -> Result<(), SearchError> {
    let model = &case.model;
    let factors = read(library::factors(model), &model.vocabulary);
    let exponents = read(library::exponents(model), &model.vocabulary);
    let forms = read(library::linear_factors(model), &model.vocabulary);
    let kept = Place::level(model).kept;
    let (graph, (divergence, rates, moving)) = recorded(case, |jet| {
        let moved = jet.along_field();
        let growth =
            |term: &Term| term.formula.logarithmic_derivative(&mut |symbol| moved.value(symbol));
        let mut rates = Vec::new();
        for factor in &factors {
            let rate = growth(factor);
            rates.extend(exponents.iter().map(|t| vec![rate * jet.phase.scalar(&t.formula)]));
        }
        let moving: Vec<Vec<Expr>> = forms.iter().map(|form| vec![growth(form)]).collect();
        (vec![jet.divergence() - jet.level_cofactor(&kept)], rates, moving)
    })?;
    let seed = effort.options.seed;
    let mut candidates: Vec<(bool, String)> = Vec::new();
    let mut solve = |target: Vec<Expr>, head: &str, is_density: bool| -> Result<(), SearchError> {
        let mut columns = rates.clone();
        columns.push(target);
        let relations = match Functions::new(case, &graph, &columns, seed)?.relations() {
            Err(SearchError::NoPoints) => return Ok(()),
            other => other?,
        };
        // The target is the last column: it depends on the others if it has no pivot.
        for vector in relations.rational().0 {
            if vector.last().is_some_and(|last| last == &Rational::from(1)) {
                let text = powers(&vector[..vector.len() - 1], &factors, &exponents, head);
                candidates.push((is_density, text));
            }
        }
        Ok(())
    };
    solve(divergence, "", true)?;
    for (form, rate) in forms.iter().zip(moving) {
        // L_v ln P + Σ α L_v ln f = 0
        solve(rate, &form.text, false)?;
    }
    for (is_density, formula) in candidates {
        let texts = [formula.clone()];
        let make = |formula| match is_density {
            true => Kind::Density(Density(formula)),
            false => Kind::Integral(Integral(formula)),
        };
        let reports = judged(case, &texts, effort, make)?;
        let known: Vec<String> = report.found.iter().map(|found| found.formula.clone()).collect();
        if let Some(found) = reports.first().filter(|found| holds(found)) {
            if !is_density && depends(case, &known, &formula, effort)? {
                continue;
            }
            let kind = if is_density { "density" } else { "integral" };
            let known = if is_density { None } else { claimed(case, &formula, effort)? };
            report.found.push(find(kind, &formula, known, found));
        }
    }
    Ok(())
}

fn holds(report: &ClaimReport) -> bool {
    matches!(report.verdict, Verdict::Proved | Verdict::Confirmed)
}

fn find(kind: &'static str, formula: &str, known: Option<String>, report: &ClaimReport) -> Found {
    Found {
        kind,
        formula: formula.to_string(),
        trivial: false,
        known,
        verdict: report.verdict,
        evidence: report.evidence.clone(),
    }
}

/// The integral among the claims of the case that a find depends on.
fn claimed(case: &Case, formula: &str, effort: &Effort) -> Result<Option<String>, SearchError> {
    if effort.blind {
        return Ok(None);
    }
    for claim in case.claims.iter().filter(|claim| claim.expect == Expect::Holds) {
        let Kind::Integral(Integral(own)) = &claim.kind else { continue };
        // An integral that is itself a function of the energy explains nothing.
        let text = own.text().to_string();
        if own.value_type() == crate::formula::Type::Scalar
            && !depends(case, &[], &text, effort)?
            && depends(case, &[text], formula, effort)?
        {
            return Ok(Some(claim.name.clone()));
        }
    }
    Ok(None)
}

/// Σ a_j T_j as one writes it.
fn sum(coefficients: &[Rational], terms: &[&Term]) -> String {
    let mut text = String::new();
    // The largest denominator is cleared by nobody: coefficients are small.
    for (coefficient, term) in coefficients.iter().zip(terms).filter(|(c, _)| !c.is_zero()) {
        let magnitude = if coefficient.is_negative() { -coefficient } else { coefficient.clone() };
        let sign = match (text.is_empty(), coefficient.is_negative()) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        };
        let factor = match magnitude == Rational::from(1) {
            true => String::new(),
            false => format!("{magnitude}*"),
        };
        text.push_str(&format!("{sign}{factor}{}", term.text));
    }
    text
}

/// head Π f^α, each α a sum of multiples of the exponents.
fn powers(coefficients: &[Rational], factors: &[Term], exponents: &[Term], head: &str) -> String {
    let mut parts: Vec<String> = if head.is_empty() { Vec::new() } else { vec![head.to_string()] };
    let exponents: Vec<&Term> = exponents.iter().collect();
    for (factor, own) in factors.iter().zip(coefficients.chunks(exponents.len().max(1))) {
        if own.iter().all(Rational::is_zero) {
            continue;
        }
        let exponent = sum(own, &exponents);
        parts.push(match exponent.as_str() {
            "1" => factor.text.clone(),
            _ => format!("{}^({exponent})", factor.text),
        });
    }
    if parts.is_empty() { "1".to_string() } else { parts.join("*") }
}

/// The case with claims about these formulas in the place of its own, judged.
fn judged(
    case: &Case,
    formulas: &[String],
    effort: &Effort,
    kind: impl Fn(Formula) -> Kind,
) -> Result<Vec<ClaimReport>, SearchError> {
    let mut asked = case.clone();
    asked.claims.clear();
    for (number, text) in formulas.iter().enumerate() {
        // Texts are sums and products of what was read before.
        let Ok(formula) = Formula::parse(text, &case.model.vocabulary) else { continue };
        asked.claims.push(claim(case, format!("find {number}"), kind(formula)));
    }
    Ok(judge(&asked, &effort.options)?.claims)
}

fn claim(case: &Case, name: String, kind: Kind) -> Claim {
    Claim {
        name,
        kind,
        source: "found by search".to_string(),
        place: Place::level(&case.model),
        only_there: false,
        expect: Expect::Holds,
        cell: None,
        note: None,
    }
}

/// Is a formula a function of others, the energy and the level functions?
fn depends(
    case: &Case,
    known: &[String],
    formula: &str,
    effort: &Effort,
) -> Result<bool, SearchError> {
    use crate::claim::Independent;
    let energy = case.model.vocabulary.find("energy").map(|_| "energy".to_string());
    let texts: Vec<&String> = known.iter().chain(&energy).collect();
    let mut formulas = Vec::new();
    for text in texts {
        formulas.extend(Formula::parse(text, &case.model.vocabulary).ok());
    }
    formulas.extend(Formula::parse(formula, &case.model.vocabulary).ok());
    let mut asked = case.clone();
    let kind = Kind::Independent(Independent::of(formulas));
    asked.claims = vec![claim(case, "independent".to_string(), kind)];
    let report = judge(&asked, &effort.options)?;
    Ok(report.claims.first().is_some_and(|found| found.verdict != Verdict::Proved))
}
