//! Values as rational functions of t = tan φ/2 in place of angles φ, and of u = e^(r x) in place of x.

use super::exponentials::{logarithm, rates, without_logarithms};
use crate::SearchError;
use liouville::graph::{Expr, Fault, Graph, Step, record};
use liouville::mechanics::Draw;
use liouville::number::UnaryFunction;
use liouville::proof::{angle_arguments, without_arctangents};
use liouville::scalar::Scalar;

/// The angle φ with tan φ/2 = t.
pub fn twice_the_arctangent<T: Scalar>(t: T) -> T {
    t.atan() * T::from(2.0)
}

/// Records values anew in which angles are twice an arctangent, and exponents multiples of logarithms: without
/// their sines, cosines and exponentials.
pub fn rational(graph: &Graph, values: &[Expr]) -> Result<(Graph, Vec<Expr>), Fault> {
    let (graph, values) = without_arctangents(graph, values)?;
    without_logarithms(&graph, &values)
}

/// Lists the inputs on which the arguments of sines and cosines depend that some values need.
pub fn angles(graph: &Graph, values: &[Expr]) -> Vec<usize> {
    let arguments = angle_arguments(graph, values);
    let mut found: Vec<usize> =
        arguments.iter().flat_map(|place| graph.inputs_of(graph.at(*place))).collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// Values in which some inputs are no angles or exponents any more.
pub struct Unwound {
    /// The recording.
    pub graph: Graph,
    /// Its values.
    pub outputs: Vec<Expr>,
    /// Inputs that are others than before.
    pub replaced: Vec<usize>,
}

/// Replaces angles and exponents among inputs, of which the first are parameters; `None` if there are none, or
/// if sines, cosines, arctangents, exponentials or logarithms remain.
pub fn of(
    graph: &Graph,
    outputs: &[Expr],
    (draws, parameters): (&[Draw], usize),
) -> Result<Option<Unwound>, SearchError> {
    let is_free = |input: &usize| matches!(draws.get(*input), Some(Draw::Within(_) | Draw::Of(..)));
    let angles: Vec<usize> = angles(graph, outputs).into_iter().filter(is_free).collect();
    let mut exponents =
        rates(graph, outputs, &|input| input < parameters && !angles.contains(&input));
    exponents.retain(|input, _| is_free(input) && !angles.contains(input));
    if angles.is_empty() && exponents.is_empty() {
        return Ok(None);
    }
    let reached = graph.reached(outputs.iter().copied());
    let (turned, values) = record(graph.inputs(), |inputs| {
        let mut inputs = inputs.to_vec();
        angles.iter().for_each(|angle| inputs[*angle] = twice_the_arctangent(inputs[*angle]));
        for (input, rate) in &exponents {
            let letter = rate.letter.map(|letter| inputs[letter]);
            inputs[*input] = logarithm(inputs[*input], &rate.number, letter);
        }
        let values = graph.repeated(&reached, &inputs);
        outputs.iter().map(|output| values[graph.place(*output)]).collect::<Option<Vec<_>>>()
    })?;
    let Some(values) = values else { return Ok(None) };
    let (graph, outputs) = rational(&turned, &values)?;
    let reached = graph.reached(outputs.iter().copied());
    let remains = |step: Step<'_>| {
        matches!(
            step,
            Step::Unary(
                UnaryFunction::Sin
                    | UnaryFunction::Cos
                    | UnaryFunction::Atan
                    | UnaryFunction::Exp
                    | UnaryFunction::Ln,
                _
            )
        )
    };
    let is_rational = !graph.steps().zip(reached).any(|(step, reached)| reached && remains(step));
    let replaced = angles.into_iter().chain(exponents.into_keys()).collect();
    Ok(is_rational.then_some(Unwound { graph, outputs, replaced }))
}
