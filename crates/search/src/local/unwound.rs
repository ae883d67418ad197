//! Values as rational functions of t = tan φ/2 in place of angles φ, and of u = e^(r x) in place of x.

use std::collections::BTreeMap;

use super::exponentials::{Rate, logarithm, rates, without_logarithms};
use super::functions::{AdjoinedFunction, InputRole, adjoined};
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

/// Inputs that occur in angles or exponents alone.
pub struct Replaceable {
    /// Inputs on which the arguments of sines and cosines depend.
    pub angles: Vec<usize>,
    /// Inputs of which whole multiples are exponents.
    pub exponents: BTreeMap<usize, Rate>,
}

impl Replaceable {
    /// Finds those among some inputs, and replaces them. What occurs both in a sine and outside of it, or is
    /// added there to what does, is left as it is.
    ///
    /// # Errors
    ///
    /// Recording failed.
    pub fn of(
        graph: &Graph,
        outputs: &[Expr],
        is_free: &dyn Fn(usize) -> bool,
        is_letter: &dyn Fn(usize) -> bool,
    ) -> Result<(Self, Graph, Vec<Expr>), Fault> {
        let mut angles: Vec<usize> =
            angles(graph, outputs).into_iter().filter(|input| is_free(*input)).collect();
        let mut excluded: Vec<usize> = Vec::new();
        loop {
            // What occurs in both has no values modulo primes.
            let is_other = |input: usize| is_letter(input) && !angles.contains(&input);
            let mut exponents = rates(graph, outputs, &is_other);
            exponents.retain(|input, _| {
                is_free(*input) && !angles.contains(input) && !excluded.contains(input)
            });
            let own = Self { angles, exponents };
            let (made, values) = own.replaced(graph, outputs)?;
            let left = remaining(&made, &values);
            let before = own.angles.len() + own.exponents.len();
            angles = own.angles.clone();
            angles.retain(|input| !left.contains(input));
            let kept = own.exponents.keys().filter(|input| !left.contains(input)).count();
            if angles.len() + kept == before {
                return Ok((own, made, values));
            }
            excluded.extend(left);
        }
    }

    /// Records values anew in terms of the tangents of half angles and of exponentials.
    fn replaced(&self, graph: &Graph, outputs: &[Expr]) -> Result<(Graph, Vec<Expr>), Fault> {
        let reached = graph.reached(outputs.iter().copied());
        let (turned, values) = record(graph.inputs(), |inputs| {
            let mut inputs = inputs.to_vec();
            for angle in &self.angles {
                inputs[*angle] = twice_the_arctangent(inputs[*angle]);
            }
            for (input, rate) in &self.exponents {
                let letter = rate.letter.map(|letter| inputs[letter]);
                inputs[*input] = logarithm(inputs[*input], &rate.number, letter);
            }
            let values = graph.repeated(&reached, &inputs);
            let value = |own: &Expr| values[graph.place(*own)].unwrap_or_else(Expr::undefined);
            outputs.iter().map(value).collect::<Vec<Expr>>()
        })?;
        rational(&turned, &values)
    }
}

/// Lists the inputs of which an arctangent or a logarithm is needed.
fn remaining(graph: &Graph, values: &[Expr]) -> Vec<usize> {
    let reached = graph.reached(values.iter().copied());
    let input = |(step, reached): (Step<'_>, bool)| match step {
        Step::Unary(UnaryFunction::Atan | UnaryFunction::Ln, a) if reached => match graph.step(a) {
            Step::Input(input) => Some(input),
            _ => None,
        },
        _ => None,
    };
    graph.steps().zip(reached).filter_map(input).collect()
}

/// Lists the inputs on which the arguments of sines and cosines depend that some values need.
fn angles(graph: &Graph, values: &[Expr]) -> Vec<usize> {
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

/// Replaces angles and exponents among inputs, of which the first are parameters, and functions of what is left;
/// `None` if there are none, or if sines, cosines, arctangents, exponentials or logarithms remain.
pub fn of(
    graph: &Graph,
    outputs: &[Expr],
    (draws, parameters): (&[Draw], usize),
) -> Result<Option<Unwound>, SearchError> {
    let is_free = |input: usize| matches!(draws.get(input), Some(Draw::Within(_) | Draw::Of(..)));
    let (own, graph, mut outputs) =
        Replaceable::of(graph, outputs, &is_free, &|input| input < parameters)?;
    let replaced: Vec<usize> = own.angles.into_iter().chain(own.exponents.into_keys()).collect();
    let role = |input: usize| match input < parameters {
        true => InputRole::Parameter,
        false => InputRole::Position,
    };
    let (graph, has_functions) = match adjoined(&graph, &outputs, graph.inputs(), &role)? {
        None => (graph, false),
        Some(own) => {
            // Roots in their arguments have branches as well.
            let arguments = own.functions.iter().flat_map(AdjoinedFunction::arguments);
            outputs = own.outputs.iter().copied().chain(arguments).collect();
            (own.graph, true)
        }
    };
    if replaced.is_empty() && !has_functions {
        return Ok(None);
    }
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
    Ok(is_rational.then_some(Unwound { graph, outputs, replaced }))
}
