//! Formulas of a case as programs of single steps, from which SymPy makes expressions.

use liouville::formula::Formula;
use liouville::graph::{Step, record};
use liouville::mechanics::{Phase, components};
use liouville::number::{BinaryOperation, UnaryFunction};
use pyo3::prelude::*;
use serde_json::{Value, json};

use super::case::Case;
use super::errors;
use super::function::formula;

/// Writes formulas of a case, or its field if there are none, as JSON: names of the inputs, steps
/// whose arguments are places of earlier steps, and the places of the values of each formula.
/// `abbreviations` are further names, each with its formula.
#[pyfunction]
pub fn program(
    py: Python<'_>,
    case: &Case,
    formulas: Option<Vec<String>>,
    abbreviations: Vec<(String, String)>,
) -> PyResult<String> {
    let mut inner = (*case.inner).clone();
    for (name, text) in &abbreviations {
        let formula = inner.formula(text);
        let formula = formula.map_err(|error| errors::of_formula(py, text, &error))?;
        inner
            .define(name, &formula)
            .map_err(|error| pyo3::exceptions::PyValueError::new_err(error.to_string()))?;
    }
    let formulas = formulas.map(|texts| {
        texts.iter().map(|text| formula(py, &inner, text)).collect::<PyResult<Vec<Formula>>>()
    });
    let formulas = formulas.transpose()?;
    let model = &inner.model;
    let free = model.free_components();
    let recorded = record(free + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(free);
        let phase = Phase::new(model, parameters, state);
        match &formulas {
            None => vec![phase.field().to_vec()],
            Some(formulas) => formulas.iter().map(|own| phase.evaluate(own).components()).collect(),
        }
    });
    let (graph, values) =
        recorded.map_err(|fault| errors::of_flow(py, &liouville_flow::FlowError::from(fault)))?;
    let mut names: Vec<String> = Vec::new();
    for own in model.free_parameters() {
        names.extend((0..components(own.kind)).map(|place| own.kind.component(&own.name, place)));
    }
    names.extend((0..model.dimension()).map(|place| model.component_name(place)));
    names.extend((names.len()..graph.inputs()).map(|k| format!("integral_{}", k + 1)));
    let reached = graph.reached(values.concat());
    let step =
        |(place, step): (usize, Step<'_>)| if reached[place] { written(step) } else { Value::Null };
    let steps: Vec<Value> = graph.steps().enumerate().map(step).collect();
    let places: Vec<Vec<usize>> = values
        .iter()
        .map(|values| values.iter().map(|value| graph.place(*value)).collect())
        .collect();
    Ok(json!({ "inputs": names, "steps": steps, "values": places }).to_string())
}

/// A step as a list: its name, then its arguments.
fn written(step: Step<'_>) -> Value {
    match step {
        Step::Constant(value) => json!(["constant", value.to_string()]),
        Step::Input(index) => json!(["input", index]),
        Step::Unary(function, a) => json!([named(function), a]),
        Step::Binary(operation, a, b) => json!([joined(operation), a, b]),
        Step::Power(a, exponent) => json!(["power", a, exponent.to_string()]),
    }
}

fn named(function: UnaryFunction) -> &'static str {
    match function {
        UnaryFunction::Neg => "neg",
        UnaryFunction::Recip => "recip",
        UnaryFunction::Sqrt => "sqrt",
        UnaryFunction::Abs => "abs",
        UnaryFunction::Exp => "exp",
        UnaryFunction::Ln => "log",
        UnaryFunction::Sin => "sin",
        UnaryFunction::Cos => "cos",
        UnaryFunction::Atan => "atan",
    }
}

fn joined(operation: BinaryOperation) -> &'static str {
    match operation {
        BinaryOperation::Add => "add",
        BinaryOperation::Sub => "sub",
        BinaryOperation::Mul => "mul",
        BinaryOperation::Pow => "pow",
    }
}
