//! Midpoints with lower bounds of radii, at a third of the price of balls.
//!
//! Most states of a claim that holds are passed for one reason: the ratio of midpoint and radius is
//! below one that was seen before. A lower bound of the radius shows that, too. In units of the
//! roundoff u, with the midpoints a, b and the result z,
//!
//! ```text
//! a ± b   ρ = ρa + ρb + |z|
//! a b     ρ = |a| ρb + |b| ρa + |z|
//! 1/a     ρ = |z| (|z| ρa + 1)
//! √a      ρ = |z|
//! ```
//!
//! and ρ = 0 for inputs and constants. u ρ, as computed, is at most the radius that a program over
//! balls computes, which widens each by 32 u (docs/soundness.md, "Refutation"). All results must be
//! known to be finite: then zeros are left out, and midpoints are the same but for the sign of 0.

use super::super::program::{ProgramStep, StepProgram, Sum, Value};
use super::builder::{Builder, TapeSteps};
use crate::graph::Tape;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

/// Makes the program of some outputs of the second of two tapes: for each its midpoint and the
/// bound.
pub(super) fn program(
    first: &Tape,
    further: &[Rational],
    second: &Tape,
    tested: &[usize],
) -> Option<StepProgram> {
    let mut lower = LowerBuilder::default();
    let input = |input| LowerBall { mid: Value::Input(2 * input), known: None, bound: None };
    let mut made = lower.tape(first, (0..first.inputs() as u32).map(input).collect())?;
    made.extend(further.iter().map(|value| lower.enclosed(value)));
    let results = lower.tape(second, made)?;
    let zero = lower.0.constant(0.0);
    let tested = tested.iter().map(|index| results.get(*index).copied());
    let tested: Vec<LowerBall> = tested.collect::<Option<_>>()?;
    let outputs = tested.iter().flat_map(|ball| [ball.mid, ball.bound.unwrap_or(zero)]).collect();
    let Builder { steps, constants, .. } = lower.0;
    Some(StepProgram { inputs: 2 * first.inputs(), constants, steps, outputs }.without_unread())
}

/// A midpoint with a lower bound of its radius; `None` for 0.
#[derive(Clone, Copy, Debug)]
struct LowerBall {
    mid: Value,
    /// Value of a constant.
    known: Option<f64>,
    bound: Option<Value>,
}

#[derive(Default)]
struct LowerBuilder(Builder);

impl TapeSteps for LowerBuilder {
    type Number = LowerBall;

    fn enclosed(&mut self, value: &Rational) -> LowerBall {
        self.constant(value.to_f64().0)
    }

    fn unary(&mut self, function: UnaryFunction, x: LowerBall) -> Option<LowerBall> {
        let mid = self.0.step(ProgramStep::Unary(function, x.mid));
        let bound = match function {
            UnaryFunction::Neg | UnaryFunction::Abs => x.bound,
            UnaryFunction::Sqrt => Some(mid),
            UnaryFunction::Recip => {
                let size = self.0.size(mid);
                Some(match x.bound {
                    Some(bound) => {
                        let ratio = self.0.product(size, bound);
                        self.fused(size, ratio, size)
                    }
                    None => size,
                })
            }
            _ => return None,
        };
        Some(LowerBall { mid, known: None, bound })
    }

    fn binary(
        &mut self,
        operation: BinaryOperation,
        x: LowerBall,
        y: LowerBall,
    ) -> Option<LowerBall> {
        let [is_zero, y_is_zero] = [x, y].map(|ball| ball.known == Some(0.0));
        let mid = match operation {
            BinaryOperation::Pow => return None,
            BinaryOperation::Mul if is_zero || y_is_zero => return Some(self.constant(0.0)),
            BinaryOperation::Add if is_zero => y.mid,
            BinaryOperation::Add | BinaryOperation::Sub if y_is_zero => x.mid,
            BinaryOperation::Sub if is_zero => {
                self.0.step(ProgramStep::Unary(UnaryFunction::Neg, y.mid))
            }
            _ => self.0.step(ProgramStep::Binary(operation, x.mid, y.mid)),
        };
        if is_zero && y_is_zero {
            return Some(self.constant(0.0));
        }
        // Also the sum with 0 is widened.
        let mut bound = self.0.size(mid);
        for (own, other) in [(x, y), (y, x)] {
            let Some(part) = own.bound else { continue };
            bound = match operation {
                BinaryOperation::Mul => {
                    let size = self.0.size(other.mid);
                    self.fused(size, part, bound)
                }
                _ => self.0.sum(BinaryOperation::Add, part, bound),
            };
        }
        Some(LowerBall { mid, known: None, bound: Some(bound) })
    }
}

impl LowerBuilder {
    /// Adds the step a b + c.
    fn fused(&mut self, a: Value, b: Value, c: Value) -> Value {
        self.0.step(ProgramStep::Fused(Sum::Plus, [a, b, c]))
    }

    fn constant(&mut self, value: f64) -> LowerBall {
        LowerBall { mid: self.0.constant(value), known: Some(value), bound: None }
    }
}
