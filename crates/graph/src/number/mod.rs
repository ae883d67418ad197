//! Number domains: the arithmetics in which a tape is run.
//!
//! A domain works on *blocks*, one value for each lane, so that it may vectorise, or share work
//! between lanes (such as one inversion for a whole block). A further domain is one more
//! implementation of [`Domain`]; the tape and the evaluator do not depend on the domain they run
//! in.

pub mod arb;
pub mod ball;
pub mod complex;
pub mod double_double;
pub mod double_double_ball;
pub mod exact;
pub mod float;
pub mod mixed;
pub mod prime;
pub mod quadratic;
pub mod rational;
mod scramble;

use rational::Rational;
pub use scramble::{GOLDEN, scrambled};

/// A function of one argument that a tape may contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UnaryFunction {
    /// `-x`
    Neg,
    /// `1/x`
    Recip,
    /// `√x`, undefined below 0
    Sqrt,
    /// `|x|`
    Abs,
    /// `e^x`
    Exp,
    /// natural logarithm, undefined for x ≤ 0
    Ln,
    /// sine
    Sin,
    /// cosine
    Cos,
    /// arctangent
    Atan,
}

/// A function of two arguments that a tape may contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BinaryOperation {
    /// `x + y`
    Add,
    /// `x - y`
    Sub,
    /// `x y`
    Mul,
    /// `x^y` for x > 0
    Pow,
}

/// An arithmetic over blocks of values.
///
/// An operation that has no result in some lane (a root of a negative number, 1/0) marks that lane
/// as undefined in the form of its domain; the mark then spreads through every later operation.
pub trait Domain {
    /// One value for each lane.
    type Block: Clone;

    /// Returns the image of an exact constant, in every lane.
    fn constant(&self, value: &Rational) -> Self::Block;

    /// Returns the image of one exact value for each lane. There are at most as many values as
    /// lanes; the remaining lanes repeat the last value.
    fn values(&self, values: &[Rational]) -> Self::Block;

    /// Computes `out = f(x)`.
    fn unary(&self, function: UnaryFunction, x: &Self::Block, out: &mut Self::Block);

    /// Computes `out = x op y`.
    fn binary(
        &self,
        operation: BinaryOperation,
        x: &Self::Block,
        y: &Self::Block,
        out: &mut Self::Block,
    );

    /// Computes `out = x^exponent`; x > 0 unless the exponent is an integer.
    fn power(&self, x: &Self::Block, exponent: &Rational, out: &mut Self::Block);
}

/// A domain whose values enclose the true ones, so that a value away from 0 is a refutation.
pub trait Enclosing: Domain {
    /// Number of lanes in a block.
    const LANES: usize;

    /// Returns midpoint and radius of a lane in f64, the radius covering both roundings; `None`
    /// where the lane is undefined or unbounded.
    fn enclosure(block: &Self::Block, lane: usize) -> Option<(f64, f64)>;

    /// Whether 0 is outside the enclosure; never where the lane is undefined.
    fn excludes_zero(block: &Self::Block, lane: usize) -> bool;

    /// Whether every number of a lane is positive, also of numbers that are 0 when they are rounded to f64.
    fn is_positive(block: &Self::Block, lane: usize) -> bool {
        Self::excludes_zero(block, lane)
            && Self::enclosure(block, lane).is_some_and(|(mid, _)| mid > 0.0)
    }

    /// Prints a few digits of a nonzero number that the f64 enclosure cannot separate from 0.
    fn beyond_f64(_: &Self::Block, _: usize) -> Option<String> {
        None
    }
}
