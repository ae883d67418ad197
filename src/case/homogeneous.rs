//! Homogeneity of typed support functions; others are meant on the unit sphere.

use num_traits::One;

use crate::formula::Formula;
use crate::graph::{Evaluator, Expr, Graph, Step, Tape, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::dot;
use crate::mechanics::{Chart, Draw, DrawSource, Model, NORMAL, Phase, Shape};
use crate::number::ball::Ball;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, Domain, UnaryFunction};
use crate::proof::{Extent, Group, GroupOutcome, Prover};

/// Number of states at which Euler's relation is tested.
const STATES: u64 = 4;

/// Replacement for `shape`: its extension off the sphere; `None` if h is homogeneous of degree 1.
///
/// Unless Euler's relation (γ,∇h) = h is seen by the form of h, or proved in prime fields, the body's support
/// function is |γ| h(γ/|γ|); for a homogeneous h that is the same function. Balls at a few states on the unit sphere
/// and off it save the proof where h is not homogeneous, or not defined off the sphere.
pub fn extension(model: &Model, shape: &Shape) -> Option<Shape> {
    let Shape::Support(formula) = shape else { return None };
    let mut draws = model.parameter_draws();
    draws.extend(Chart::Rolling.draws(&[], &[false, false]));
    let (graph, defects) = record(draws.len(), |inputs| {
        let (free, state) = model.make_parameters(inputs);
        let defect = |kept: [bool; 2]| {
            let mut point = Chart::Rolling.point(model, &kept, &free, state);
            point.resize(model.dimension(), Expr::one());
            let jet = DualPoint::new(Phase::new(model, &free, &point));
            let slope = jet.gradient(|at| at.scalar(formula));
            let gamma = 3 * NORMAL..3 * NORMAL + 3;
            dot(&slope[gamma.clone()], &point[gamma]) - jet.phase.scalar(formula)
        };
        [defect([true, true]), defect([false, true])]
    })
    .ok()?;
    let tape = Tape::new(&graph, &defects);
    let mut evaluator = Evaluator::new(&tape, Ball::<1>);
    let numbers = DrawSource::new(&draws);
    let homogeneous = (0..STATES).all(|index| {
        let values = numbers.state(0, index);
        let inputs: Vec<_> = values.into_iter().map(|value| Ball::<1>.values(&[value])).collect();
        evaluator.run(&inputs);
        evaluator.outputs().all(|ball| ball.is_defined(0) && !ball.excludes_zero(0))
    });
    let extents: Vec<Extent> = draws.iter().map(Draw::extent).collect();
    let prover = Prover { sources: &[], extents: &extents, seed: 0 };
    let is_proved = || {
        let found = prover.prove(&graph, &[Group::of(defects.to_vec())]);
        matches!(found.as_deref(), Ok([GroupOutcome::Zero(_)]))
    };
    let homogeneous = homogeneous && (is_evident(model, formula) || is_proved());
    (!homogeneous).then(|| Shape::SupportOnSphere(formula.clone()))
}

/// Whether the form of a support function shows that it is homogeneous of degree 1 in γ.
fn is_evident(model: &Model, formula: &Formula) -> bool {
    let free = model.free_components();
    let count = free + model.dimension();
    let recorded = record(count, |inputs| {
        let (free, state) = inputs.split_at(free);
        Phase::new(model, free, state).scalar(formula)
    });
    let normal = free + 3 * NORMAL..free + 3 * NORMAL + 3;
    recorded.is_ok_and(|(graph, value)| {
        // A further input stands for an antiderivative, which may depend on γ.
        let degree =
            |input| (input < count).then(|| Rational::from(normal.contains(&input) as i64));
        degree_of(&graph, value, degree) == Some(Degree::Of(Rational::from(1)))
    })
}

/// Degree d of a homogeneous value f: f(λx) = λ^d f(x) for λ > 0 wherever f has a value.
#[derive(Clone, Debug, PartialEq)]
enum Degree {
    /// That of 0, which is homogeneous of every degree.
    Any,
    Of(Rational),
}

/// Degree of a value in inputs of these degrees, as far as its form shows one.
fn degree_of(
    graph: &Graph,
    value: Expr,
    of_input: impl Fn(usize) -> Option<Rational>,
) -> Option<Degree> {
    let reached = graph.reached([value]);
    let mut degrees: Vec<Option<Degree>> = Vec::with_capacity(graph.len());
    for (step, reached) in graph.steps().zip(reached) {
        let degree = if reached { degree_of_step(step, &degrees, &of_input) } else { None };
        degrees.push(degree);
    }
    degrees.swap_remove(graph.place(value))
}

fn degree_of_step(
    step: Step<'_>,
    degrees: &[Option<Degree>],
    of_input: impl Fn(usize) -> Option<Rational>,
) -> Option<Degree> {
    let zero = || Rational::from(0);
    let times = |place: usize, factor: &Rational| match degrees[place].as_ref()? {
        Degree::Of(degree) => Some(Degree::Of(degree * factor)),
        Degree::Any => None,
    };
    let is_constant = |place: usize| degrees[place] == Some(Degree::Of(zero()));
    match step {
        Step::Constant(value) if value.is_zero() => Some(Degree::Any),
        Step::Constant(_) => Some(Degree::Of(zero())),
        Step::Input(input) => of_input(input).map(Degree::Of),
        Step::Unary(UnaryFunction::Neg | UnaryFunction::Abs, a) => degrees[a].clone(),
        Step::Unary(UnaryFunction::Recip, a) => times(a, &Rational::from(-1)),
        Step::Unary(UnaryFunction::Sqrt, a) => times(a, &Rational::new(1, 2)),
        Step::Unary(_, a) => is_constant(a).then(|| Degree::Of(zero())),
        Step::Power(a, exponent) => times(a, exponent),
        Step::Binary(BinaryOperation::Add | BinaryOperation::Sub, a, b) => {
            match (degrees[a].clone()?, degrees[b].clone()?) {
                (Degree::Any, other) | (other, Degree::Any) => Some(other),
                (a, b) => (a == b).then_some(a),
            }
        }
        Step::Binary(BinaryOperation::Mul, a, b) => {
            match (degrees[a].as_ref()?, degrees[b].as_ref()?) {
                (Degree::Of(a), Degree::Of(b)) => Some(Degree::Of(a + b)),
                _ => Some(Degree::Any),
            }
        }
        Step::Binary(BinaryOperation::Pow, a, b) => {
            (is_constant(a) && is_constant(b)).then(|| Degree::Of(zero()))
        }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::scalar::Scalar;

    /// Degree in the first two of three inputs.
    fn degree(build: impl FnOnce(&[Expr]) -> Expr) -> Option<Degree> {
        let (graph, value) = record(3, build).expect("records");
        degree_of(&graph, value, |input| (input < 3).then(|| Rational::from((input < 2) as i64)))
    }

    #[test]
    fn degrees_are_those_of_the_form() {
        let of = |above: i64, below: i64| Some(Degree::Of(Rational::new(above, below)));
        assert_eq!(degree(|x| x[0] * x[2] - x[1]), of(1, 1), "a linear function");
        assert_eq!(degree(|x| (x[0] * x[0] * x[2] + x[1] * x[1]).sqrt()), of(1, 1), "a length");
        assert_eq!(degree(|x| x[0].modulus() + x[1] * x[1] / x[0]), of(1, 1), "a quotient");
        assert_eq!(degree(|x| (x[0] / x[1]).sin() * x[2].exp() * x[0]), of(1, 1), "of a ratio");
        let third = Rational::new(1, 3);
        assert_eq!(degree(|x| (x[0] * x[2]).power(&third)), of(1, 3), "a power");
        let nowhere = |x: &[Expr]| x[0] + literally_nothing(x[1]);
        assert_eq!(degree(nowhere), of(1, 1), "0 has every degree");
        assert_eq!(degree(|x| x[0] + x[2]), None, "terms of unequal degree");
        assert_eq!(degree(|x| x[0] + 1.0), None, "and a number");
        assert_eq!(degree(|x| x[0].exp()), None, "a function of what has a degree");
        assert_eq!(degree(|x| x[2].power_of(x[0])), None, "an exponent that has one");
        assert_eq!(degree(|x| x[0].power_of(x[2])), None, "an exponent that varies");
        assert_eq!(degree(|x| x[0] * Expr::input()), None, "an input of unknown degree");
    }

    /// 0 where √y has a value.
    fn literally_nothing(y: Expr) -> Expr {
        crate::graph::literally(|| y.sqrt() * Expr::rational(&Rational::from(0)))
    }
}
