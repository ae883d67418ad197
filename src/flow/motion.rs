//! The motion of a case with fixed parameters: its field as a Taylor program.

use super::error::FlowError;
use super::program::Program;
use crate::graph::{Expr, Graph, Step, record};
use crate::mechanics::{LevelEquation, LevelFunction, Model, Phase};
use crate::number::{Function, Operation};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// A point over exprs whose parameters are exact constants.
pub(super) fn point<'m>(
    model: &'m Model,
    parameters: &[Rational],
    state: &[Expr],
) -> Phase<'m, Expr> {
    let parameters: Vec<Expr> = parameters.iter().map(Expr::rational).collect();
    Phase::new(model, &parameters, state)
}

/// The program of a case's field with these values of its free parameters, and of further
/// functions of the state beside it.
pub fn program(
    model: &Model,
    parameters: &[Rational],
    further: impl FnOnce(&Phase<'_, Expr>) -> Vec<Expr>,
) -> Result<Program, FlowError> {
    let (graph, (rates, outputs, unit)) = record(model.dimension(), |state| {
        let phase = point(model, parameters, state);
        (phase.field().to_vec(), further(&phase), unit_normal(&phase))
    })?;
    // On the level (γ,γ) is 1, and what is built on it is constant.
    let square = unit.and_then(|unit| square_of(&graph, graph.place(unit)));
    let Some(square) = square else { return Program::compile(&graph, &rates, &outputs) };
    let count = rates.len();
    let wanted = [rates, outputs].concat();
    let reached = graph.reached(wanted.iter().copied());
    let (simpler, values) = record(model.dimension(), |state| {
        let one = Expr::rational(&Rational::from(1));
        let values =
            graph.replay(&reached, state, |place, _, _| (place == square).then_some(one));
        wanted.iter().map(|expr| values[graph.place(*expr)]).collect::<Option<Vec<Expr>>>()
    })?;
    let mut values = values.ok_or(FlowError::Antiderivative)?;
    let outputs = values.split_off(count);
    Program::compile(&simpler, &values, &outputs)
}

/// F0 = (γ,γ) - 1, for systems that keep the level whatever is put for (γ,γ): γ' is across γ, and
/// a multiplier keeps (ω,γ).
fn unit_normal(phase: &Phase<'_, Expr>) -> Option<Expr> {
    let model = phase.model();
    let unit = |equation: &&LevelEquation| matches!(equation.function, LevelFunction::UnitNormal);
    let equation = model.level.iter().find(unit)?;
    let keeps = model.system.conserves_level();
    keeps.then(|| phase.level_function(&equation.function))
}

/// s, where the step is s - 1, which may be recorded as -(1 - s).
fn square_of(graph: &Graph, place: usize) -> Option<usize> {
    let is_one = |place: usize| matches!(graph.step(place), Step::Constant(one) if one.is_one());
    match graph.step(place) {
        Step::Unary(Function::Neg, inner) => square_of(graph, inner),
        Step::Binary(Operation::Sub, a, b) if is_one(a) => Some(b),
        Step::Binary(Operation::Sub, a, b) if is_one(b) => Some(a),
        _ => None,
    }
}
