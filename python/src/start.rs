//! Starts of motions, as Python gives them.

use liouville::case::Case;
use liouville::number::rational::Rational;
use liouville::verdict;
use liouville_flow::{Begin, FlowError, Launches, Start, section_starts};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::errors;

/// Start of a motion.
#[derive(Clone, FromPyObject)]
pub enum Given {
    /// Values by the names of the variables, in the notation of case files.
    #[pyo3(transparent)]
    Named(String),
    /// Numbers: the components of the state, or values of the axes of a section.
    #[pyo3(transparent)]
    Listed(Vec<String>),
}

/// Reads an exact number.
pub fn number(text: &str) -> PyResult<Rational> {
    text.parse().map_err(|_| PyValueError::new_err(format!("`{text}` is not a number")))
}

/// Reads exact numbers.
pub fn numbers(texts: &[String]) -> PyResult<Vec<Rational>> {
    texts.iter().map(|text| number(text)).collect()
}

/// Reads a point (l, L/G) of a section.
pub fn point(given: &Given) -> PyResult<[f64; 2]> {
    match given {
        Given::Listed(texts) if texts.len() == 2 => {
            Ok([number(&texts[0])?.to_f64().0, number(&texts[1])?.to_f64().0])
        }
        _ => Err(PyValueError::new_err("a start on the section is a pair (l, L/G)")),
    }
}

/// Reads a whole state from its names and values.
pub fn state(case: &Case, text: &str) -> PyResult<Vec<Rational>> {
    verdict::read_state(case, text)
        .map_err(|error| PyValueError::new_err(format!("start: {error}")))
}

/// Finds the start of a motion: a whole state, a point of the case's section, or a drawn state.
pub fn find(
    py: Python<'_>,
    launches: &Launches<'_>,
    given: Option<&Given>,
) -> PyResult<Result<Start, FlowError>> {
    let case = launches.case;
    match given {
        None => Ok(launches.start(&Begin::Drawn(launches.index))),
        Some(Given::Named(text)) => Ok(launches.start(&Begin::State(state(case, text)?))),
        Some(Given::Listed(texts)) if texts.len() == case.model.dimension() => {
            Ok(launches.start(&Begin::State(numbers(texts)?)))
        }
        Some(listed @ Given::Listed(texts)) => match &case.section {
            Some(plan) if texts.len() == 2 => {
                let at = [point(listed)?];
                let found = section_starts(case, &plan.g0, &plan.energy, &at, launches.seed);
                let mut found = found.map_err(|error| errors::of_flow(py, &error))?;
                Ok(found.pop().unwrap_or(Err(FlowError::NoStart)))
            }
            _ => Err(misfit(case, texts.len())),
        },
    }
}

/// Error about a number of values that fits nothing.
pub fn misfit(case: &Case, found: usize) -> PyErr {
    let model = &case.model;
    let names: Vec<String> = (0..model.dimension()).map(|k| model.component_name(k)).collect();
    let names = names.join(", ");
    PyValueError::new_err(format!("a start has {found} values, and the state has {names}"))
}
