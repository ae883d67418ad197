//! Exponents of a field that is a polynomial in the state.

use liouville::case::Case;
use liouville::formula::Formula;
use liouville::graph::Expr;
use liouville::number::rational::Rational;

use super::super::super::SearchError;
use super::super::super::terms::recorded;
use super::super::cleared::input_names;
use super::functions;
use super::polynomial::{Monomial, RingPolynomial};
use super::read::StepReader;
use super::ring::AdjoinedRing;
use super::write;

/// Exponents of the terms of a polynomial field by the components of the state.
pub struct PolynomialField {
    /// Terms of each rate.
    pub rates: Vec<Vec<Vec<i64>>>,
    /// Terms of each equation of the level.
    pub level: Vec<Vec<Vec<i64>>>,
}

/// Reads a field, and the equations of its level, as polynomials in the state; `None` if they are none.
pub fn polynomial_field(case: &Case) -> Result<Option<PolynomialField>, SearchError> {
    let model = &case.model;
    let (parameters, dimension) = (model.free_components(), model.dimension());
    let (graph, (field, level)) = recorded(case, |jet| {
        let level = model.level.iter().map(|own| jet.phase.level_function(&own.function));
        (jet.phase.field().to_vec(), level.collect::<Vec<_>>())
    })?;
    if graph.inputs() > parameters + dimension {
        return Ok(None);
    }
    let mut ring = AdjoinedRing::new(parameters, dimension, Vec::new());
    let mut reader = StepReader::new(&graph);
    let mut all = |own: &[Expr]| -> Option<Vec<RingPolynomial>> {
        own.iter().map(|own| reader.read(graph.place(*own), &mut ring)).collect()
    };
    let (Some(field), Some(level)) = (all(&field), all(&level)) else { return Ok(None) };
    if functions(&ring) > 0 {
        return Ok(None);
    }
    let state = parameters..parameters + dimension;
    let exponents = |own: &RingPolynomial| -> Vec<Vec<i64>> {
        let term = |(monomial, _): (&Monomial, &Rational)| {
            let mut all = vec![0; dimension];
            let own = monomial.iter().filter(|(variable, _)| state.contains(variable));
            own.for_each(|(variable, power)| all[variable - parameters] = i64::from(*power));
            all
        };
        own.terms().map(term).collect()
    };
    let table = |own: &[RingPolynomial]| own.iter().map(exponents).collect();
    Ok(Some(PolynomialField { rates: table(&field), level: table(&level) }))
}

/// Divides a polynomial by others as often as this is possible, and takes the root of a square; `None` if
/// none of this is possible, or the formulas are no polynomials.
pub fn reduced(
    case: &Case,
    formula: &Formula,
    others: &[Formula],
) -> Result<Option<Formula>, SearchError> {
    let all: Vec<Formula> = std::iter::once(formula).chain(others).cloned().collect();
    let Some(read) = polynomials(case, &all)? else { return Ok(None) };
    let Some((Some(first), others)) = read.split_first() else { return Ok(None) };
    let others: Vec<&RingPolynomial> = others.iter().flatten().collect();
    let mut own = first.clone();
    for other in others.iter().filter(|other| other.value().is_none()) {
        while let Some(quotient) = own.over(other) {
            own = quotient;
        }
    }
    while own.value().is_none()
        && let Some(root) = own.square_root()
    {
        own = root;
    }
    if own == *first {
        return Ok(None);
    }
    Ok(case.formula(&write::written(&own, &input_names(case))).ok())
}

/// Reads formulas as polynomials in the free parameters and the state: each as `None` if it is none, and all if
/// the system contains an ∫.
pub(super) fn polynomials(
    case: &Case,
    formulas: &[Formula],
) -> Result<Option<Vec<Option<RingPolynomial>>>, SearchError> {
    let (parameters, dimension) = (case.model.free_components(), case.model.dimension());
    let (graph, values) =
        recorded(case, |jet| formulas.iter().map(|own| jet.phase.scalar(own)).collect::<Vec<_>>())?;
    if graph.inputs() > parameters + dimension {
        return Ok(None);
    }
    let mut ring = AdjoinedRing::new(parameters, dimension, Vec::new());
    let mut reader = StepReader::new(&graph);
    let mut read = |own: &Expr| {
        let made = reader.read(graph.place(*own), &mut ring)?;
        made.variables().iter().all(|k| *k < parameters + dimension).then_some(made)
    };
    Ok(Some(values.iter().map(&mut read).collect()))
}
