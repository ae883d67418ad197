//! Steps of a rolling body's field that are proportional on the level set are one step.
//!
//! On the level (γ,γ) is 1, and a ball's r' is -Rγ': such relations are seen in exact arithmetic at
//! a few states of the level. The level itself stays an integral near it, whatever is put for
//! r, Ĩ and the torques: γ' is across γ, and the multiplier keeps (ω,γ).

use super::error::FlowError;
use crate::graph::{Choice, Evaluator, Expr, Graph, Step, Tape, record};
use crate::mechanics::{Chart, Model};
use crate::number::exact::Exact;
use crate::number::rational::Rational;
use crate::number::{Domain, Function};

/// At how many states relations are seen.
const STATES: usize = 5;
/// Values larger than that are not looked at.
const MAX_BITS: u64 = 4096;
/// Factors larger than that are coincidences of constants, and bring nothing.
const MAX_FACTOR_BITS: u64 = 256;

/// The values of a step at all states; `None` where one is irrational, undefined or too large.
type Values = Option<Vec<Rational>>;

/// The same values over a graph in which steps that are proportional on the level are one.
pub fn merged(
    model: &Model,
    graph: &Graph,
    wanted: &[Expr],
) -> Result<(Graph, Vec<Expr>), FlowError> {
    let reached = graph.reached(wanted.iter().copied());
    let values = values(model, graph, &reached)?;
    let direction = |own: &Vec<Rational>| -> Option<Vec<Rational>> {
        if own.iter().all(Rational::is_zero) {
            // A multiple of 1.
            return Some(vec![Rational::from(1); own.len() - 1]);
        }
        let unit = own[0].recip()?;
        Some(own[1..].iter().map(|value| value * &unit).collect())
    };
    let factor = |own: &Vec<Rational>, other: &Vec<Rational>| {
        let factor = &own[0] * &other[0].recip()?;
        (factor.bits() <= MAX_FACTOR_BITS).then_some(factor)
    };
    let members = graph.members(&values, direction, factor);
    Ok(graph.rebuilt(wanted, &members, Choice::First)?)
}

fn values(model: &Model, graph: &Graph, reached: &[bool]) -> Result<Vec<Values>, FlowError> {
    let states: Vec<Vec<Rational>> =
        (0..STATES).map(|index| state(model, graph.inputs(), index)).collect::<Result<_, _>>()?;
    let mut values: Vec<Values> = Vec::with_capacity(graph.len());
    for (place, step) in graph.steps().enumerate() {
        let at = |index: usize| -> Option<Rational> {
            let argument = |place: usize| Some(values[place].as_ref()?[index].clone());
            let mut out = None;
            match step {
                Step::Constant(value) => out = Some(value.clone()),
                Step::Input(input) => out = states[index].get(input).cloned(),
                // What is not rational is not looked at.
                Step::Unary(Function::Neg | Function::Recip | Function::Sqrt, a) => {
                    let Step::Unary(function, _) = step else { return None };
                    Exact.unary(function, &argument(a), &mut out);
                }
                Step::Unary(..) | Step::Power(..) => {}
                Step::Binary(operation, a, b) => {
                    Exact.binary(operation, &Some(argument(a)?), &Some(argument(b)?), &mut out);
                }
            }
            out.filter(|value| value.bits() <= MAX_BITS)
        };
        let is_looked_at = reached[place] || matches!(step, Step::Constant(_));
        let all = if is_looked_at { (0..STATES).map(at).collect() } else { None };
        values.push(all);
    }
    Ok(values)
}

/// A state of the level in general position, and numbers for further inputs.
fn state(model: &Model, inputs: usize, index: usize) -> Result<Vec<Rational>, FlowError> {
    // Fractions without pattern: powers of a primitive root modulo a prime.
    let mut power = 5 + 7 * index as i64;
    let mut next = || {
        power = power * 14 % 2003;
        Rational::new(power - 1001, 499)
    };
    let draws: Vec<Rational> = (0..inputs).map(|_| next()).collect();
    let kept = vec![true; model.level.len()];
    let count = model.dimension();
    let (graph, made) = record(draws.len(), |draws| {
        let mut state = Chart::Rolling.point(model, &kept, &[], draws);
        state.truncate(count);
        state
    })?;
    let tape = Tape::new(&graph, &made);
    let mut evaluator = Evaluator::new(&tape, Exact);
    evaluator.run(&draws.iter().cloned().map(Some).collect::<Vec<_>>());
    let mut state: Vec<Rational> =
        evaluator.outputs().cloned().collect::<Option<_>>().ok_or(FlowError::NoStart)?;
    state.extend((state.len()..inputs).map(|_| next()));
    Ok(state)
}
