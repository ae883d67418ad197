//! Why values do not exist: numbers beyond the range of f64, or operations without a value.

use crate::graph::{Expr, Graph, Step};
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
