//! Polynomial integrals written by inner products of the vectors of a case.
//!
//! The values of an integral at random states modulo a prime are compared with those of products of the
//! inner products. A formula that is shorter is proved to be equal, up to a factor, and to be an integral.

use super::ansatz::coefficients::{PrimitiveVector, Ratio};
use super::ansatz::system::{Column, LinearSystem, PrimePoint};
use super::ask::{judged_alone, proved_energy};
use super::echelon::{Echelon, nonzero};
use super::integrals::claimed_by;
use super::local::Coordinates;
use super::lower::Degrees;
use super::products::degree_in;
use super::{Effort, Found, FoundKind, SearchError, SearchReport};
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError, Type};
use liouville::mechanics::{Dependence, Meaning};
use liouville::order::StableOrder;
use liouville::verdict::{ClaimReport, Verdict};

/// Length in letters of a formula that is left as it is.
const SHORT: usize = 20;
/// Largest number of inner products.
const MOST_PRODUCTS: usize = 40;
/// Largest number of terms.
const MOST_TERMS: usize = 160;
/// Highest degree in the state of an integral that is rewritten.
const MOST_DEGREE: u32 = 4;

/// Rewrites the integrals of a report where that makes them shorter.
pub fn rewrite(case: &Case, effort: &Effort, report: &mut SearchReport) -> Result<(), SearchError> {
    let is_long = |found: &Found| {
        found.kind == FoundKind::Integral
            && found.with.is_empty()
            && found.verdict == Verdict::Proved
            && found.text().chars().count() > SHORT
    };
    let places: Vec<usize> =
        (0..report.found.len()).filter(|k| is_long(&report.found[*k])).collect();
    if places.is_empty() {
        return Ok(());
    }
    let products = inner_products(case, effort)?;
    if products.is_empty() {
        return Ok(());
    }
    for place in places {
        effort.halt.check()?;
        let Some(function) = report.found[place].function().cloned() else { continue };
        let shorter = match shorter(case, effort, &products, &function) {
            Err(SearchError::NoChart) => return Ok(()),
            other => other?,
        };
        if let Some(found) = shorter {
            let known = report.found[place].known.take();
            for own in &mut report.excluded {
                own.theorem = own.theorem.replace(function.text(), found.text());
            }
            report.found[place] = Found { known, ..found };
        }
    }
    match exchange(case, effort, &products, report) {
        Err(SearchError::NoChart) => Ok(()),
        other => other,
    }
}

/// Integrals that are combinations of products of inner products, short ones first, and the gradients of
/// these, of others, and of what is known anyway, at a random state of the level.
struct Sums {
    formulas: Vec<Formula>,
    system: LinearSystem,
    at: PrimePoint,
    dimension: usize,
}

impl Sums {
    /// Those shorter than the longest integral that is told.
    fn of(
        case: &Case,
        effort: &Effort,
        terms: &[Formula],
        others: &[Formula],
        longest: usize,
    ) -> Result<Option<Self>, SearchError> {
        let mut rates = LinearSystem::record(case, effort, |jet, recording| {
            let moved = jet.along_field();
            for term in terms {
                let value = moved.scalar(term);
                recording.give(value.eps);
                recording.give(value.re);
            }
        })?;
        rates.columns = (0..2 * terms.len()).map(Column::Given).collect();
        let Some(at) = rates.at(0, 0) else { return Ok(None) };
        // Terms that depend on others on the level are left out.
        let values: Vec<usize> = (0..terms.len()).map(|k| 2 * k + 1).collect();
        let Some(relations) = rates.null_space(&at, &values)? else { return Ok(None) };
        let last = |own: &Vec<u64>| own.iter().rposition(|entry| *entry != 0);
        let dependent: Vec<usize> = relations.iter().filter_map(last).collect();
        let kept: Vec<usize> = (0..terms.len()).filter(|k| !dependent.contains(k)).collect();
        let columns: Vec<usize> = kept.iter().map(|k| 2 * k).collect();
        let Some(vectors) = rates.null_space(&at, &columns)? else { return Ok(None) };
        let mut formulas = Vec::new();
        for vector in vectors {
            let own = nonzero(&vector);
            if length(own.iter().map(|k| &terms[kept[*k]])) >= longest {
                continue;
            }
            let support: Vec<usize> = own.iter().map(|k| columns[*k]).collect();
            let Some(coefficients) = PrimitiveVector::of(&rates, &support)? else { continue };
            let functions: Vec<Ratio> =
                own.iter().map(|k| Ratio::of(terms[kept[*k]].clone())).collect();
            let places: Vec<usize> = (0..own.len()).collect();
            let sum = coefficients.sum_with_plus(&places, &functions)?;
            formulas.extend(sum.map(|(sum, _)| sum));
        }
        formulas.order_by_key(|formula| formula.text().chars().count());
        let all: Vec<&Formula> = formulas.iter().chain(others).collect();
        let dimension = case.model.dimension();
        let mut system = LinearSystem::record(case, effort, |jet, recording| {
            for formula in &all {
                for axis in jet.gradients(formula) {
                    axis.into_iter().for_each(|slope| _ = recording.give(slope));
                }
            }
            for own in &case.model.level {
                for moved in jet.along_axes() {
                    recording.give(moved.level_function(&own.function).eps);
                }
            }
        })?;
        let count = (all.len() + case.model.level.len()) * dimension;
        system.columns = (0..count).map(Column::Given).collect();
        Ok(system.at(0, 0).map(|at| Self { formulas, system, at, dimension }))
    }

    /// Gradients of all formulas, and of the functions of the level.
    fn gradients(&self) -> Option<Vec<Vec<u64>>> {
        let columns: Vec<usize> = (0..self.system.columns.len()).collect();
        let row = self.system.rows(&self.at, 1, &columns, 1)?.pop()?;
        Some(row.chunks(self.dimension).map(<[u64]>::to_vec).collect())
    }

    fn rank(&self, rows: &[&Vec<u64>]) -> usize {
        let mut echelon = Echelon::new(self.dimension, self.at.modulus);
        rows.iter().filter(|row| echelon.push(row.to_vec())).count()
    }
}

/// Least length of a sum of multiples of formulas.
fn length<'f>(formulas: impl Iterator<Item = &'f Formula>) -> usize {
    formulas.map(|own| own.text().chars().count()).sum()
}

/// Takes short sums of products in place of long integrals, where all integrals together remain functions
/// of those that are told.
fn exchange(
    case: &Case,
    effort: &Effort,
    products: &[(Formula, u32)],
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let is_told = |found: &Found| found.is_integral() && found.verdict == Verdict::Proved;
    let mut places = Vec::new();
    let mut others: Vec<Formula> = Vec::new();
    for (place, found) in report.found.iter().enumerate().filter(|(_, found)| is_told(found)) {
        if let Some(function) = found.function() {
            places.push(place);
            others.push(function.clone());
        }
    }
    let count = others.len();
    others.extend(proved_energy(case, effort)?);
    let told = |report: &SearchReport, place: usize| report.found[place].text().chars().count();
    let Some(longest) = places.iter().map(|place| told(report, *place)).max() else {
        return Ok(());
    };
    if longest <= SHORT {
        return Ok(());
    }
    let terms = terms(products, MOST_DEGREE)?;
    let Some(sums) = Sums::of(case, effort, &terms, &others, longest)? else { return Ok(()) };
    let Some(gradients) = sums.gradients() else { return Ok(()) };
    let first = sums.formulas.len();
    let mut own: Vec<&Vec<u64>> = gradients[first..first + count].iter().collect();
    let fixed: Vec<&Vec<u64>> = gradients[first + count..].iter().collect();
    let rank = sums.rank(&[&fixed[..], &own[..]].concat());
    let mut is_new = vec![false; count];
    let degrees = Degrees::of(case, effort);
    for (formula, gradient) in sums.formulas.iter().zip(&gradients) {
        effort.halt.check()?;
        let size = formula.text().chars().count();
        let degree = |own: &Formula| match &degrees {
            Some(degrees) => degrees.of_formula(own),
            None => Ok(None),
        };
        let new_degree = degree(formula)?;
        let mut order: Vec<usize> = (0..count)
            .filter(|k| !is_new[*k] && told(report, places[*k]) > size.max(SHORT))
            .filter(|k| {
                let text = report.found[places[*k]].text();
                report.excluded.iter().all(|own| !own.theorem.contains(text))
            })
            .collect();
        order.order_by_key(|k| std::cmp::Reverse(told(report, places[*k])));
        // One of lower degree in the velocities says more.
        let mut kept = Vec::new();
        for k in order {
            if degree(&others[k])?.is_none_or(|own| new_degree.is_none_or(|new| new <= own)) {
                kept.push(k);
            }
        }
        let takes_place = kept.into_iter().find(|k| {
            let mut changed = own.clone();
            changed[*k] = gradient;
            let all = [&fixed[..], &changed[..]].concat();
            let with_both = [&all[..], &[own[*k]]].concat();
            sums.rank(&all) == rank && sums.rank(&with_both) == rank
        });
        let Some(k) = takes_place else { continue };
        let verdict = judged_alone(case, Claim::integral(formula), effort)?;
        let Some(verdict) = verdict.filter(|report| report.verdict == Verdict::Proved) else {
            continue;
        };
        let known = claimed_by(case, formula, effort, report)?;
        let found = Found::new(FoundKind::Integral, formula, known, verdict, &case.model);
        report.found[places[k]] = found;
        (own[k], is_new[k]) = (gradient, true);
    }
    Ok(())
}

/// Inner products of the vectors that depend on the state and those of the parameters, with or without
/// matrices of the parameters, by their degrees in the state; short ones first.
fn inner_products(case: &Case, effort: &Effort) -> Result<Vec<(Formula, u32)>, SearchError> {
    let vocabulary = &case.model.vocabulary;
    // Names with their lengths, and whether they are constant.
    let mut vectors: Vec<(Formula, usize, bool)> = Vec::new();
    let mut matrices: Vec<(Formula, usize)> = Vec::new();
    for (symbol, entry) in vocabulary.iter() {
        let is_named = matches!(
            entry.meaning,
            Meaning::State(_) | Meaning::Parameter(_) | Meaning::Abbreviation(_)
        );
        if !is_named || vocabulary.find(&entry.name).is_none() {
            continue;
        }
        let is_constant = entry.reach == Dependence::Parameters;
        let own = Formula::symbol(&entry.name, symbol, entry.kind);
        match entry.kind {
            Type::Vector(length) if length > 1 => {
                vectors.push((own, length, is_constant));
            }
            Type::Matrix(rows, columns) if rows == columns && is_constant => {
                matrices.push((own, rows));
            }
            _ => {}
        }
    }
    let mut factors: Vec<(Formula, usize, bool)> = Vec::new();
    for (vector, length, is_constant) in &vectors {
        factors.push((vector.clone(), *length, *is_constant));
        for (matrix, _) in matrices.iter().filter(|(_, rows)| rows == length && !is_constant) {
            for form in [matrix * vector, matrix.raised(-1)? * vector] {
                factors.push((form?, *length, false));
            }
        }
    }
    let mut products = Vec::new();
    for (k, (first, length, is_constant)) in factors.iter().enumerate() {
        for (second, other, is_other_constant) in &factors[k..] {
            if length == other && !(*is_constant && *is_other_constant) {
                products.push(first.dot(second)?);
            }
        }
    }
    products.order_by_key(|own: &Formula| own.text().chars().count());
    let everything = Coordinates::all_moving(case);
    let mut found = Vec::new();
    for formula in products.into_iter().take(MOST_PRODUCTS) {
        if let Some(degree) = degree_in(case, &formula, &everything, effort.options.seed)? {
            found.push((formula, degree));
        }
    }
    found.retain(|(_, degree)| *degree > 0);
    Ok(found)
}

/// Products of inner products of at most a degree.
fn terms(products: &[(Formula, u32)], degree: u32) -> Result<Vec<Formula>, FormulaError> {
    let own = products.iter().filter(|(_, own)| *own <= degree);
    let mut all: Vec<Formula> = own.map(|(formula, _)| formula.clone()).collect();
    for (k, (first, own)) in products.iter().enumerate() {
        for (place, (second, other)) in products.iter().enumerate().skip(k) {
            if own + other <= degree {
                let square = place == k;
                all.push(if square { first.raised(2)? } else { (first * second)? });
            }
        }
    }
    all.truncate(MOST_TERMS);
    Ok(all)
}

/// A shorter formula for an integral, proved.
fn shorter(
    case: &Case,
    effort: &Effort,
    products: &[(Formula, u32)],
    function: &Formula,
) -> Result<Option<Found>, SearchError> {
    let everything = Coordinates::all_moving(case);
    let degree = degree_in(case, function, &everything, effort.options.seed)?;
    let Some(degree) = degree.filter(|degree| *degree <= MOST_DEGREE) else { return Ok(None) };
    let terms = terms(products, degree)?;
    let mut system = LinearSystem::record(case, effort, |jet, recording| {
        for term in terms.iter().chain([function]) {
            recording.give(jet.phase.scalar(term));
        }
    })?;
    system.columns = (0..=terms.len()).map(Column::Given).collect();
    let Some(at) = system.at(0, 0) else { return Ok(None) };
    let columns: Vec<usize> = (0..=terms.len()).collect();
    let Some(vectors) = system.null_space(&at, &columns)? else { return Ok(None) };
    let Some(vector) = vectors.last().filter(|own| own.last() != Some(&0)) else {
        return Ok(None);
    };
    let support = nonzero(vector);
    let used = support.iter().filter(|k| **k < terms.len()).map(|k| &terms[*k]);
    if length(used) >= function.text().chars().count() {
        return Ok(None);
    }
    let Some(coefficients) = PrimitiveVector::of(&system, &support)? else { return Ok(None) };
    let (own, last): (Vec<usize>, usize) = ((0..support.len() - 1).collect(), support.len() - 1);
    let functions: Vec<Ratio> = own.iter().map(|k| Ratio::of(terms[support[*k]].clone())).collect();
    // F times its coefficient is minus the sum; an integral may have either sign.
    let Some((sum, is_negative)) = coefficients.sum_with_plus(&own, &functions)? else {
        return Ok(None);
    };
    let equal = if is_negative { sum.clone() } else { -&sum.bracketed() };
    if sum.text().chars().count() >= function.text().chars().count() {
        return Ok(None);
    }
    let scaled = (coefficients.formula(last)?.bracketed() * &function.bracketed())?;
    let is_proved = |claim: Claim| -> Result<Option<ClaimReport>, SearchError> {
        let report = judged_alone(case, claim, effort)?;
        Ok(report.filter(|report| report.verdict == Verdict::Proved))
    };
    if is_proved(Claim::identity(&scaled, &equal))?.is_none() {
        return Ok(None);
    }
    let proved = is_proved(Claim::integral(&sum))?;
    Ok(proved.map(|report| Found::new(FoundKind::Integral, &sum, None, report, &case.model)))
}
