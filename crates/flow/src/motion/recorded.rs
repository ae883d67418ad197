//! The motion of a case with fixed parameters: its field as a Taylor program.

use std::sync::Arc;

use crate::error::FlowError;
use crate::motion::start::LevelFunctions;
use crate::taylor::merge::merged;
use crate::taylor::program::TaylorProgram;
use crate::taylor::quotients::jumps;
use crate::taylor::watch::{Presence, Written, written};
use liouville::graph::{Expr, Graph, record};
use liouville::mechanics::{Model, Phase};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Point over recorded scalars whose parameters are exact constants.
pub(crate) fn point<'m>(
    model: &'m Model,
    parameters: &[Rational],
    state: &[Expr],
) -> Phase<'m, Expr> {
    Phase::new(model, &filled(parameters, &[], &[]), state)
}

/// Component of the free parameters that differs from motion to motion: centre + half x, with x
/// between -1 and 1.
#[derive(Clone, Debug)]
pub struct Loose {
    /// Index of the component.
    pub component: usize,
    /// Midpoint of its range.
    pub centre: Rational,
    /// Half the length of its range.
    pub half: Rational,
    /// Components that are the same quantity, or its negative.
    pub tied: Vec<(usize, bool)>,
}

impl Loose {
    /// Component of a parameter of the case that varies between two values, together with those
    /// that are the same quantity; `place` is that of the parameter among the free ones.
    pub(crate) fn within(
        model: &Model,
        [index, component]: [usize; 2],
        place: usize,
        [from, to]: [&Rational; 2],
    ) -> Self {
        let half = Rational::new(1, 2);
        // An entry that cannot vary is refused by its name, before.
        let tied = model.tied(index, component).unwrap_or_default();
        Self {
            component: place + component,
            centre: &(from + to) * &half,
            half: &(to - from) * &half,
            tied: tied.iter().map(|one| (place + one.component, one.is_negative)).collect(),
        }
    }
}

/// Returns the parameters, with loose ones replaced by functions of their inputs x.
pub(crate) fn filled<T: Scalar>(parameters: &[Rational], loose: &[Loose], inputs: &[T]) -> Vec<T> {
    let mut filled: Vec<T> = parameters.iter().map(T::rational).collect();
    for (one, x) in loose.iter().zip(inputs) {
        let value = T::rational(&one.centre) + T::rational(&one.half) * *x;
        filled[one.component] = value;
        for (component, is_negative) in &one.tied {
            filled[*component] = if *is_negative { -value } else { value };
        }
    }
    filled
}

/// Compiles a case's field with these values of its free parameters, and further functions of the
/// state.
pub fn program(
    model: &Model,
    parameters: &[Rational],
    further: impl FnOnce(&Phase<'_, Expr>) -> Vec<Expr>,
) -> Result<TaylorProgram, FlowError> {
    extended_program(model, parameters, &[], 0, |phase, _| (phase.field().to_vec(), further(phase)))
}

/// Compiles a field in the state and `more` further variables, the first of which are the inputs of
/// loose parameters. `build` receives a point and those variables, and returns the rates of all, and
/// further functions.
pub(crate) fn extended_program(
    model: &Model,
    parameters: &[Rational],
    loose: &[Loose],
    more: usize,
    build: impl FnOnce(&Phase<'_, Expr>, &[Expr]) -> (Vec<Expr>, Vec<Expr>),
) -> Result<TaylorProgram, FlowError> {
    if model.system.is_map() {
        return Err(FlowError::Discrete);
    }
    let dimension = model.dimension();
    let (graph, (rates, outputs, written)) = record(dimension + more, |inputs| {
        let (state, more) = inputs.split_at(dimension);
        let phase = Phase::new(model, &filled(parameters, loose, more), state);
        let (rates, outputs) = build(&phase, more);
        (rates, outputs, written(&phase))
    })?;
    compiled(model, parameters, loose, more, &graph, (rates, outputs, written))
}

/// Compiles what `extended_program` recorded: rates, further functions, and what presence is judged by.
fn compiled(
    model: &Model,
    parameters: &[Rational],
    loose: &[Loose],
    more: usize,
    graph: &Graph,
    (rates, mut outputs, written): (Vec<Expr>, Vec<Expr>, Written),
) -> Result<TaylorProgram, FlowError> {
    let dimension = model.dimension();
    if graph.inputs() > dimension + more {
        return Err(FlowError::Antiderivative);
    }
    let jumps = jumps(graph, &rates[..dimension]);
    if jumps && more > loose.len() {
        return Err(FlowError::Jumps);
    }
    let field = [rates.as_slice(), &outputs].concat();
    let (presence, arguments) = Presence::new(model, graph, &field, written);
    outputs.extend(arguments);
    let mut program = match model.system.conserves_level() {
        false => TaylorProgram::compile(graph, &rates, &outputs)?,
        true => {
            let wanted = [rates.as_slice(), &outputs].concat();
            let (simpler, mut values) = merged(model, graph, &wanted)?;
            let outputs = values.split_off(rates.len());
            TaylorProgram::compile(&simpler, &values, &outputs)?
        }
    };
    (program.presence, program.jumps) = (Some(presence), jumps);
    if !model.system.conserves_level() && !model.level.is_empty() {
        let level = LevelFunctions::new(model, parameters, loose)?.level(dimension);
        program.level = level.map(Arc::new);
    }
    Ok(program)
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::case::Case;

    #[test]
    fn equal_entries_vary_together() {
        let text = "title = 'a'\n[parameters]\nJ = 'symmetric(2, 1..2)'\nK = 'skew(2, 1..2)'\n\
             [state]\nx = 'vector(2, -1..1)'\n[field]\n\"x'\" = 'J*K*x'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let [low, high] = [0, 4].map(Rational::from);
        let range = [&low, &high];
        let loose = [
            Loose::within(&case.model, [0, 1], 0, range),
            Loose::within(&case.model, [1, 2], 4, range),
        ];
        let values: Vec<Rational> = (1..=8).map(Rational::from).collect();
        let found = filled::<f64>(&values, &loose, &[0.5, -0.5]);
        assert_eq!(found, [1.0, 3.0, 3.0, 4.0, 5.0, -1.0, 1.0, 8.0], "J12 = J21, K12 = −K21");
    }
}
