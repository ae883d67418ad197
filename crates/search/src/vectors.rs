//! Vectors whose components are integrals that were found.
//!
//! An integral that is Σ c (a × b)ᵢ + Σ c aᵢ with one index i, for vectors a, b of the state, is compared
//! with the other two components: the vector Σ c a × b + Σ c a is judged as a whole.

use super::ansatz::coefficients::{PrimitiveVector, Ratio};
use super::ansatz::positions;
use super::ansatz::system::{Column, LinearSystem};
use super::ask::judged_alone;
use super::{Effort, Found, FoundKind, Given, SearchError, SearchReport};
use crate::echelon::nonzero;
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, Type};
use liouville::mechanics::System;
use liouville::verdict::Verdict;

/// Largest number of vectors.
const MOST_VECTORS: usize = 8;
/// Smallest number of components among the integrals found.
const COMPONENTS: usize = 2;

/// Adds the vectors to a report of which at least two components were found.
pub fn gather(case: &Case, effort: &Effort, report: &mut SearchReport) -> Result<(), SearchError> {
    let vectors = vectors(case, effort)?;
    let is_scalar = |found: &&Found| found.is_integral() && found.verdict == Verdict::Proved;
    let own: Vec<Formula> = report
        .found
        .iter()
        .filter(is_scalar)
        .filter_map(|found| found.function().cloned())
        .collect();
    if vectors.is_empty() || own.len() < COMPONENTS {
        return Ok(());
    }
    let mut terms = vectors.clone();
    for (k, first) in vectors.iter().enumerate() {
        for second in &vectors[k + 1..] {
            terms.push(first.cross(second)?);
        }
    }
    let mut found: Vec<(Formula, Vec<Formula>)> = Vec::new();
    for integral in own {
        effort.halt.check()?;
        let vector = match vector(case, effort, &terms, &integral) {
            Err(SearchError::NoChart) => return Ok(()),
            other => other?,
        };
        let Some(vector) = vector else { continue };
        match found.iter_mut().find(|(own, _)| own.text() == vector.text()) {
            Some((_, components)) => components.push(integral),
            None => found.push((vector, vec![integral])),
        }
    }
    for (vector, components) in found {
        if components.len() < COMPONENTS {
            continue;
        }
        let verdict = judged_alone(case, Claim::integral(&vector), effort)?;
        let Some(verdict) = verdict.filter(|report| report.verdict == Verdict::Proved) else {
            continue;
        };
        let text = vector.to_string();
        let mut one =
            Found::of_several(FoundKind::VectorIntegral, text, &[&vector], verdict, &case.model);
        one.with = components.into_iter().map(Given::Component).collect();
        report.found.push(one);
    }
    Ok(())
}

/// Vectors of the state in space: its variables, or three scalar positions and the three others.
fn vectors(case: &Case, effort: &Effort) -> Result<Vec<Formula>, SearchError> {
    let model = &case.model;
    let mut own = model.state_variables();
    own.retain(|variable| variable.value_type() == Type::VECTOR);
    let is_own = model.system.is_field() || matches!(model.system, System::Lagrangian(_));
    let has_six = own.is_empty() && is_own && model.dimension() == 6 && model.level.is_empty();
    if has_six
        && let Ok(places) = positions(case, effort)?
        && places.len() == 3
    {
        let state = model.state_formulas()?;
        for is_position in [true, false] {
            let kept = (0..6).filter(|place| places.contains(place) == is_position);
            let kept: Vec<&Formula> = kept.map(|place| &state[place]).collect();
            own.push(Formula::vector(&kept)?);
        }
    }
    if own.len() > MOST_VECTORS {
        own.clear();
    }
    Ok(own)
}

/// The vector of which an integral is a component, up to a factor.
fn vector(
    case: &Case,
    effort: &Effort,
    terms: &[Formula],
    integral: &Formula,
) -> Result<Option<Formula>, SearchError> {
    let mut system = LinearSystem::record(case, effort, |jet, recording| {
        for term in terms {
            jet.phase.evaluate(term).components().into_iter().for_each(|own| {
                recording.give(own);
            });
        }
        recording.give(jet.phase.scalar(integral));
    })?;
    let count = 3 * terms.len();
    system.columns = (0..=count).map(Column::Given).collect();
    let Some(at) = system.at(0, 0) else { return Ok(None) };
    for axis in 0..3 {
        let columns: Vec<usize> = (0..terms.len()).map(|k| 3 * k + axis).chain([count]).collect();
        let Some(vectors) = system.null_space(&at, &columns)? else { return Ok(None) };
        let Some(own) = vectors.last().filter(|own| own.last() != Some(&0)) else { continue };
        let kept = nonzero(own);
        let support: Vec<usize> = kept.iter().map(|k| columns[*k]).collect();
        let Some(coefficients) = PrimitiveVector::of(&system, &support)? else { continue };
        let places: Vec<usize> = (0..kept.len() - 1).collect();
        let functions: Vec<Ratio> =
            places.iter().map(|k| Ratio::of(terms[kept[*k]].clone())).collect();
        // The sign of the integral is free: the first term has a plus.
        return Ok(coefficients.sum_with_plus(&places, &functions)?.map(|(sum, _)| sum));
    }
    Ok(None)
}
