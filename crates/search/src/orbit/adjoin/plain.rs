//! Exponents of a field that is a polynomial in the state.

use liouville::case::Case;
use liouville::graph::Expr;
use liouville::number::rational::Rational;

use super::super::super::SearchError;
use super::super::super::terms::recorded;
use super::functions;
use super::polynomial::{Monomial, RingPolynomial};
use super::read::StepReader;
use super::ring::AdjoinedRing;

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
