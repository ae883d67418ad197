//! Number domains: the arithmetics in which one and the same tape is run.
//!
//! A domain works on *blocks*, one value a lane, so that a domain may vectorise, or share work
//! between lanes (one inversion for a whole block, say). A further domain is one more
//! implementation of [`Domain`]; neither the tape nor the evaluator knows which one it runs in.

pub mod ball;
pub mod complex;
pub mod exact;
pub mod float;
pub mod mixed;
pub mod pair;
pub mod precise;
pub mod prime;
pub mod quadratic;
pub mod rational;
pub mod twofold;

use rational::Rational;

/// A function of one argument that a tape may contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
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
    /// natural logarithm, undefined at and below 0
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
pub enum Operation {
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
/// An operation that has no result at some lane (a root of a negative number, 1/0) marks that lane
/// as undefined in the way of its domain; the mark then spreads through every later operation.
pub trait Domain {
    /// One value a lane.
    type Block: Clone;

    /// The image of an exact constant, in every lane.
    fn constant(&self, value: &Rational) -> Self::Block;

    /// The image of one exact value a lane; there are at most as many values as lanes, and the
    /// lanes that are left repeat the last one.
    fn values(&self, values: &[Rational]) -> Self::Block;

    /// `out = f(x)`
    fn unary(&self, function: Function, x: &Self::Block, out: &mut Self::Block);

    /// `out = x op y`
    fn binary(&self, operation: Operation, x: &Self::Block, y: &Self::Block, out: &mut Self::Block);

    /// `out = x^exponent`; x > 0 unless the exponent is an integer.
    fn power(&self, x: &Self::Block, exponent: &Rational, out: &mut Self::Block);
}

/// A domain whose values enclose the true ones, so that a value away from 0 refutes.
pub trait Enclosing: Domain {
    /// How many lanes a block has.
    const LANES: usize;

    /// Midpoint and radius of a lane in f64, the radius wide enough for both roundings; `None`
    /// where the lane is undefined or unbounded.
    fn enclosure(block: &Self::Block, lane: usize) -> Option<(f64, f64)>;

    /// Is 0 outside the enclosure? Never where the lane is undefined.
    fn excludes_zero(block: &Self::Block, lane: usize) -> bool;

    /// A number away from 0 in a few digits, where the enclosure in f64 does not tell it from 0.
    fn beyond_f64(_: &Self::Block, _: usize) -> Option<String> {
        None
    }
}
