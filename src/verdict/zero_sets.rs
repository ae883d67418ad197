//! Zero sets of functions that are affine in a variable each: F = c y + G with a number c, so that y = −G/c on F = 0.

use num_dual::DualNum;
use num_traits::Zero;

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::{Extent, Prover};
use crate::scalar::Scalar;

/// Whether a value is proved to vanish on no open part of the common zeros of some functions, where these can be
/// solved one after another for inputs from `first` on.
pub fn vanishes_nowhere_openly_on(
    graph: &Graph,
    functions: &[Expr],
    value: Expr,
    first: usize,
    seed: u64,
) -> Result<bool, Fault> {
    let mut solved: Vec<usize> = Vec::new();
    let (mut graph, mut values) = restated(graph, &[functions, &[value]].concat(), |_| {})?;
    for index in 0..functions.len() {
        let function = values[index];
        let inputs = graph.inputs_of(function).into_iter();
        let affine = inputs.filter(|input| *input >= first && !solved.contains(input));
        let mut found = affine.filter_map(|input| {
            let slope = slope(&graph, graph.place(function), input)?;
            (!slope.is_zero()).then_some((input, slope))
        });
        let Some((input, slope)) = found.next_back() else { return Ok(false) };
        solved.push(input);
        (graph, values) = restated(&graph, &values, |inputs| {
            inputs[input] = Expr::zero();
            let reached = graph.reached([function]);
            let rest = graph.repeated(&reached, inputs)[graph.place(function)];
            let rest = rest.unwrap_or_else(Expr::undefined);
            inputs[input] = -rest * DualNum::recip(&Expr::rational(&slope));
        })?;
    }
    let value = values[functions.len()];
    if graph.is_nowhere_defined(value) {
        return Ok(false);
    }
    let extents = vec![Extent::ALL; graph.inputs()];
    Prover { sources: &[], extents: &extents, seed }.is_nonzero_on_all_cells(&graph, value)
}

/// Records values anew, from changed inputs.
fn restated(
    graph: &Graph,
    values: &[Expr],
    change: impl FnOnce(&mut Vec<Expr>),
) -> Result<(Graph, Vec<Expr>), Fault> {
    let reached = graph.reached(values.iter().copied());
    record(graph.inputs(), |inputs| {
        let mut inputs = inputs.to_vec();
        change(&mut inputs);
        let made = graph.repeated(&reached, &inputs);
        values.iter().map(|own| made[graph.place(*own)].unwrap_or_else(Expr::undefined)).collect()
    })
}

/// Returns the number c of a value c y + G in which G does not contain the input y; `None` if it is not so written.
fn slope(graph: &Graph, place: usize, input: usize) -> Option<Rational> {
    if !graph.depends_on(graph.at(place), input) {
        return Some(Rational::from(0));
    }
    let of = |place| slope(graph, place, input);
    let number = |place: usize| graph.constant_value(graph.at(place));
    match graph.step(place) {
        Step::Input(_) => Some(Rational::from(1)),
        Step::Unary(UnaryFunction::Neg, a) => Some(-&of(a)?),
        Step::Binary(BinaryOperation::Add, a, b) => Some(&of(a)? + &of(b)?),
        Step::Binary(BinaryOperation::Sub, a, b) => Some(&of(a)? - &of(b)?),
        Step::Binary(BinaryOperation::Mul, a, b) => match (number(a), number(b)) {
            (Some(own), _) => Some(own * &of(b)?),
            (_, Some(own)) => Some(own * &of(a)?),
            _ => None,
        },
        _ => None,
    }
}
