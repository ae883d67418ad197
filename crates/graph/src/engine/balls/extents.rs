//! Extents of all results of a program, from those of its inputs.
//!
//! Each step is monotonic in each of its arguments, and so is rounding: a result computed from
//! arguments between two numbers each lies between the results computed at the ends. Nothing is
//! rounded outwards here, since the results in question are themselves rounded.

use super::super::program::{PairOperation, ProgramStep, StepProgram, Sum, Value};
use crate::number::{BinaryOperation, UnaryFunction};

/// Knowledge of a result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Extent {
    /// A number between two finite ones.
    Within([f64; 2]),
    /// All bits or none.
    Mask,
    /// No bits.
    Clear,
}

/// Finds the extents of all results of a program whose inputs lie between these ends; `None` where one
/// of them may be infinite or have no value.
pub(super) fn found(program: &StepProgram, inputs: &[[f64; 2]]) -> Option<Vec<Extent>> {
    let constants: Vec<[f64; 2]> = program.constants.iter().map(|value| [*value; 2]).collect();
    if !inputs.iter().chain(&constants).flatten().all(|end| end.is_finite()) {
        return None;
    }
    let mut found: Vec<Extent> = Vec::with_capacity(program.steps.len());
    for step in &program.steps {
        let at = |value: Value| match value {
            Value::Input(input) => Extent::Within(inputs[input as usize]),
            Value::Constant(constant) => Extent::Within(constants[constant as usize]),
            Value::Step(step) => found[step as usize],
        };
        let extent = extent(step, at)?;
        if let Extent::Within(ends) = extent
            && !ends.iter().all(|end| end.is_finite())
        {
            return None;
        }
        found.push(extent);
    }
    Some(found)
}

/// Finds the extent of a step's result; `None` where it may have no value.
fn extent(step: &ProgramStep, at: impl Fn(Value) -> Extent) -> Option<Extent> {
    let number = |value: Value| match at(value) {
        Extent::Within(ends) => Some(ends),
        Extent::Mask | Extent::Clear => None,
    };
    let ends = match *step {
        ProgramStep::Unary(function, a) => {
            let [low, high] = number(a)?;
            match function {
                UnaryFunction::Neg => [-high, -low],
                UnaryFunction::Abs if low <= 0.0 && high >= 0.0 => [0.0, high.max(-low)],
                UnaryFunction::Abs => hull([low.abs(), high.abs()]),
                UnaryFunction::Recip if low > 0.0 || high < 0.0 => [1.0 / high, 1.0 / low],
                UnaryFunction::Sqrt if low >= 0.0 => [low.sqrt(), high.sqrt()],
                _ => return None,
            }
        }
        ProgramStep::Binary(operation, a, b) => {
            let ([a_low, a_high], [b_low, b_high]) = (number(a)?, number(b)?);
            match operation {
                BinaryOperation::Add => [a_low + b_low, a_high + b_high],
                BinaryOperation::Sub => [a_low - b_high, a_high - b_low],
                BinaryOperation::Mul => {
                    let ends = corners([a_low, a_high], [b_low, b_high], |x, y| x * y);
                    // The square of a number is not negative.
                    if a == b { [ends[0].max(0.0), ends[1]] } else { ends }
                }
                BinaryOperation::Pow => return None,
            }
        }
        ProgramStep::Pair(operation, a, b) => match operation {
            PairOperation::Quotient => match (number(a)?, number(b)?) {
                (a, [low, high]) if low > 0.0 || high < 0.0 => {
                    corners(a, [low, high], |x, y| x / y)
                }
                _ => return None,
            },
            PairOperation::Greater => return Some(Extent::Mask),
            PairOperation::NotGreater => {
                return (number(a)?[0] > number(b)?[1]).then_some(Extent::Clear);
            }
            PairOperation::NotAtLeast => {
                return (number(a)?[0] >= number(b)?[1]).then_some(Extent::Clear);
            }
            PairOperation::Or => match (at(a), at(b)) {
                (Extent::Within(ends), Extent::Clear) => ends,
                _ => return None,
            },
            PairOperation::And => match (at(a), at(b)) {
                (Extent::Within([low, high]), Extent::Mask) => [low.min(0.0), high.max(0.0)],
                _ => return None,
            },
        },
        ProgramStep::Fused(sum, [a, b, c]) => {
            // a b − c and c − a b are sums with one sign changed.
            let opposite = |[low, high]: [f64; 2]| [-high, -low];
            let (a, b, c) = (number(a)?, number(b)?, number(c)?);
            let a = if sum == Sum::From { opposite(a) } else { a };
            let [low, high] = if sum == Sum::Minus { opposite(c) } else { c };
            [
                corners(a, b, |x, y| x.mul_add(y, low))[0],
                corners(a, b, |x, y| x.mul_add(y, high))[1],
            ]
        }
    };
    Some(Extent::Within(ends))
}

/// Least and greatest result at the ends.
fn corners(a: [f64; 2], b: [f64; 2], result: impl Fn(f64, f64) -> f64) -> [f64; 2] {
    let at = |k: usize| hull(b.map(|b| result(a[k], b)));
    let (first, second) = (at(0), at(1));
    [first[0].min(second[0]), first[1].max(second[1])]
}

fn hull([a, b]: [f64; 2]) -> [f64; 2] {
    [a.min(b), a.max(b)]
}
