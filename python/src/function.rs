//! Functions of the state in floating point: the field of a case, and formulas.

use liouville::case::Case as Inner;
use liouville::formula::{Formula, Type};
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::Phase;
use liouville::number::float::Float;
use liouville::scalar::Scalar;
use liouville_flow::{FlowError, fixed_parameters};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyByteArray;

use super::case::Case;
use super::errors;

/// Number of states that are evaluated at once.
const LANES: usize = 8;

/// Bytes of a number.
const BYTES: usize = size_of::<f64>();

/// A function of the state with several values, at fixed parameters.
#[pyclass(frozen, module = "liouville._liouville")]
pub struct Function {
    tape: Tape,
    dimension: usize,
    /// Type of each formula.
    kinds: Vec<Type>,
}

#[pymethods]
impl Function {
    /// Sizes of the formulas: nothing for a scalar, a length, or rows and columns.
    #[getter]
    fn shapes(&self) -> Vec<Vec<usize>> {
        let shape = |kind: &Type| match *kind {
            Type::Scalar => Vec::new(),
            Type::Vector(length) => vec![length],
            Type::Matrix(rows, columns) => vec![rows, columns],
        };
        self.kinds.iter().map(shape).collect()
    }

    /// Evaluates the function at states, row by row, in the order of bytes of the machine.
    fn __call__<'py>(&self, py: Python<'py>, states: &[u8]) -> PyResult<Bound<'py, PyByteArray>> {
        let row = self.dimension * BYTES;
        if row == 0 || !states.len().is_multiple_of(row) {
            let message = format!("a state has {} components", self.dimension);
            return Err(PyValueError::new_err(message));
        }
        let values = py.detach(|| self.values(states, row));
        Ok(PyByteArray::new(py, &values))
    }
}

impl Function {
    fn values(&self, states: &[u8], row: usize) -> Vec<u8> {
        let mut values = Vec::new();
        let blocks = states.chunks_exact(row * LANES);
        let rest = blocks.remainder();
        if blocks.len() > 0 {
            let mut evaluator = Evaluator::new(&self.tape, Float::<LANES>);
            blocks.for_each(|block| self.evaluate(&mut evaluator, block, &mut values));
        }
        let mut evaluator = Evaluator::new(&self.tape, Float::<1>);
        rest.chunks_exact(row).for_each(|one| self.evaluate(&mut evaluator, one, &mut values));
        values
    }

    /// Evaluates the function at as many states as the evaluator has lanes.
    fn evaluate<const N: usize>(
        &self,
        evaluator: &mut Evaluator<'_, Float<N>>,
        states: &[u8],
        values: &mut Vec<u8>,
    ) {
        let mut inputs = vec![[0.0; N]; self.dimension];
        for (place, bytes) in states.as_chunks::<BYTES>().0.iter().enumerate() {
            inputs[place % self.dimension][place / self.dimension] = f64::from_ne_bytes(*bytes);
        }
        evaluator.run(&inputs);
        for lane in 0..N {
            values.extend(evaluator.outputs().flat_map(|block| block[lane].to_ne_bytes()));
        }
    }
}

/// Formula by its text, or by the name of a claim.
pub fn formula(py: Python<'_>, case: &Inner, text: &str) -> PyResult<Formula> {
    match case.claim(text).and_then(|claim| claim.kind.formula()) {
        Some(formula) => Ok(formula.clone()),
        None => case.formula(text).map_err(|error| errors::of_formula(py, text, &error)),
    }
}

/// Makes a function of formulas, or of the field if there are none, with the free parameters at an
/// index of the seed.
#[pyfunction]
pub fn function(
    py: Python<'_>,
    case: &Case,
    formulas: Option<Vec<String>>,
    seed: u64,
    index: u64,
) -> PyResult<Function> {
    let case = &case.inner;
    let wrong = |error: FlowError| errors::of_flow(py, &error);
    if case.model.system.has_arbitrary_function() {
        return Err(wrong(FlowError::Arbitrary));
    }
    let dimension = case.model.dimension();
    let formulas = formulas.map(|texts| {
        texts.iter().map(|text| formula(py, case, text)).collect::<PyResult<Vec<Formula>>>()
    });
    let formulas = formulas.transpose()?;
    let parameters = fixed_parameters(case, seed, index).map_err(wrong)?;
    let recorded = record(dimension, |state| {
        let parameters: Vec<Expr> = parameters.iter().map(Expr::rational).collect();
        let phase = Phase::new(&case.model, &parameters, state);
        match &formulas {
            None => phase.field().to_vec(),
            Some(formulas) => {
                formulas.iter().flat_map(|own| phase.evaluate(own).components()).collect()
            }
        }
    });
    let (graph, values) = recorded.map_err(|fault| wrong(fault.into()))?;
    if graph.inputs() > dimension {
        return Err(wrong(FlowError::Antiderivative));
    }
    let kinds = match &formulas {
        None => vec![Type::Vector(dimension)],
        Some(formulas) => formulas.iter().map(Formula::value_type).collect(),
    };
    Ok(Function { tape: Tape::new(&graph, &values), dimension, kinds })
}

/// Values of the free parameters at an index of the seed, component by component.
#[pyfunction]
pub fn parameter_values(
    py: Python<'_>,
    case: &Case,
    seed: u64,
    index: u64,
) -> PyResult<Vec<(String, Vec<usize>, Vec<String>)>> {
    let case = &case.inner;
    let values =
        fixed_parameters(case, seed, index).map_err(|error| errors::of_flow(py, &error))?;
    let mut rest = values.as_slice();
    let one = |own: &liouville::mechanics::Parameter| {
        let (shape, count) = match own.kind {
            Type::Scalar => (Vec::new(), 1),
            Type::Vector(length) => (vec![length], length),
            Type::Matrix(rows, columns) => (vec![rows, columns], rows * columns),
        };
        let (own_values, others) = rest.split_at(count);
        rest = others;
        (own.name.clone(), shape, own_values.iter().map(ToString::to_string).collect())
    };
    Ok(case.model.free_parameters().map(one).collect())
}
