//! Why values do not exist: numbers beyond the range of f64, or operations without a value.

use crate::graph::{Expr, Graph, Step};
use crate::number::arb::{Approximation, ArbBall};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

/// Whether values that do not exist at a point are too large for f64, at the first step that goes
/// wrong; not so where a division by 0, or a root or logarithm of a negative number is the cause.
pub fn is_cause(graph: &Graph, outputs: &[Expr], point: &[f64]) -> bool {
    let reached = graph.reached(outputs.iter().copied());
    let mut values = vec![0.0; reached.len()];
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        let (value, exists) = match step {
            Step::Constant(value) => (value.to_f64().0, true),
            Step::Input(input) => (point.get(input).copied().unwrap_or(f64::NAN), true),
            Step::Unary(function, a) => unary(function, values[a]),
            Step::Binary(operation, a, b) => binary(operation, values[a], values[b]),
            Step::Power(a, exponent) => {
                binary(BinaryOperation::Pow, values[a], exponent.to_f64().0)
            }
        };
        if !value.is_finite() {
            return exists;
        }
        values[place] = value;
    }
    false
}

/// Whether a value that does not exist at a point is beyond the range of balls of many digits, or
/// formed of numbers that are, and no operation on the way to it is without a value.
pub fn is_beyond(graph: &Graph, output: Expr, point: &[Rational], balls: &ArbBall) -> bool {
    let reached = graph.reached([output]);
    let mut values: Vec<Option<Approximation>> = vec![None; reached.len()];
    let mut is_beyond = false;
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        let (value, exists) = match step {
            Step::Constant(value) => (Some(balls.rational(value)), true),
            Step::Input(input) => (point.get(input).map(|x| balls.rational(x)), false),
            Step::Unary(function, a) => match &values[a] {
                None => continue,
                Some(x) => (balls.function(function, x), is_unary_defined(function, x)),
            },
            Step::Binary(operation, a, b) => match (&values[a], &values[b]) {
                (Some(x), Some(y)) => operated(balls, operation, x, y),
                _ => continue,
            },
            Step::Power(a, exponent) => match &values[a] {
                None => continue,
                // Of a negative number a power of a very large exponent has no value.
                Some(x) => (balls.rational_power(x, exponent), x.is_positive()),
            },
        };
        values[place] = value.and_then(Approximation::in_range);
        if values[place].is_none() {
            if !exists {
                return false;
            }
            is_beyond = true;
        }
    }
    is_beyond
}

/// Whether a function has a value at all numbers of an interval.
fn is_unary_defined(function: UnaryFunction, x: &Approximation) -> bool {
    match function {
        UnaryFunction::Neg
        | UnaryFunction::Abs
        | UnaryFunction::Exp
        | UnaryFunction::Sin
        | UnaryFunction::Cos
        | UnaryFunction::Atan => true,
        UnaryFunction::Recip => x.excludes_zero(),
        UnaryFunction::Sqrt => x.is_positive() || x.is_zero(),
        UnaryFunction::Ln => x.is_positive(),
    }
}

/// Value of an operation on intervals, and whether it has one for all their numbers.
fn operated(
    balls: &ArbBall,
    operation: BinaryOperation,
    x: &Approximation,
    y: &Approximation,
) -> (Option<Approximation>, bool) {
    let bits = balls.bits();
    match operation {
        BinaryOperation::Add => (Some(x.add(y, bits)), true),
        BinaryOperation::Sub => (Some(x.add(&y.neg(), bits)), true),
        BinaryOperation::Mul => (Some(x.mul(y, bits)), true),
        BinaryOperation::Pow => (balls.power_of(x, y), x.is_positive()),
    }
}

/// Value of a function in f64, and whether it exists among the real numbers.
fn unary(function: UnaryFunction, x: f64) -> (f64, bool) {
    match function {
        UnaryFunction::Neg => (-x, true),
        UnaryFunction::Recip => (1.0 / x, x != 0.0),
        UnaryFunction::Sqrt => (x.sqrt(), x >= 0.0),
        UnaryFunction::Abs => (x.abs(), true),
        UnaryFunction::Exp => (libm::exp(x), true),
        UnaryFunction::Ln => (libm::log(x), x > 0.0),
        UnaryFunction::Sin => (libm::sin(x), true),
        UnaryFunction::Cos => (libm::cos(x), true),
        UnaryFunction::Atan => (libm::atan(x), true),
    }
}

/// Value of an operation in f64, and whether it exists among the real numbers.
fn binary(operation: BinaryOperation, a: f64, b: f64) -> (f64, bool) {
    match operation {
        BinaryOperation::Add => (a + b, true),
        BinaryOperation::Sub => (a - b, true),
        BinaryOperation::Mul => (a * b, true),
        BinaryOperation::Pow => {
            let value = libm::pow(a, b);
            (value, !value.is_nan() && (a != 0.0 || b >= 0.0))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::record;

    fn cause(formula: impl Fn(Expr) -> Expr, x: f64) -> bool {
        let (graph, value) = record(1, |inputs| formula(inputs[0])).expect("recorded");
        is_cause(&graph, &[value], &[x])
    }

    #[test]
    fn numbers_beyond_all_ranges_are_told_from_what_has_no_value() {
        use num_dual::DualNum;
        let beyond = |formula: &dyn Fn(Expr) -> Expr, x: i64| {
            let (graph, value) = record(1, |inputs| formula(inputs[0])).expect("recorded");
            is_beyond(&graph, value, &[Rational::from(x)], &ArbBall::new(160))
        };
        let twice = |x: Expr| x.exp().exp();
        assert!(beyond(&twice, 100), "e^(e^100)");
        assert!(beyond(&|x| twice(x) * x, 100), "and what is formed of it");
        assert!(!beyond(&|x| x.exp(), 1000), "a number, if not of f64");
        assert!(!beyond(&|x| (x - x * x).recip(), 1), "1/0");
        assert!(!beyond(&|x| twice(x) + (x - 100.0).recip(), 100), "1/0 beside it");
        assert!(!beyond(&|x| (-x).ln(), 3), "the logarithm of a negative number");
    }

    #[test]
    fn overflow_is_told_from_what_has_no_value() {
        use num_dual::DualNum;
        let squared = |x: Expr| (0..12).fold(x, |x, _| x * x);
        assert!(cause(squared, 3.0), "3^4096");
        assert!(cause(|x| x.exp(), 1000.0), "e^1000");
        assert!(!cause(|x| x.recip(), 0.0), "1/0");
        assert!(!cause(|x| x.sqrt(), -1.0), "a root of a negative number");
        assert!(!cause(|x| x.ln(), 0.0), "ln 0");
        assert!(!cause(squared, 1.0), "a number");
    }
}
