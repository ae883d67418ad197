//! Exact rationals while numbers stay rational and short, arbitrary-precision balls beyond: the
//! domain that knows √0 to exist.
//!
//! A value is exact, enclosed, known not to exist (√-1), or in doubt (the root of a ball that
//! contains 0 and negative numbers).

use super::arb::{Approximation, ArbBall};
use super::exact::square_root;
use super::rational::Rational;
use super::{BinaryOperation, Domain, Enclosing, UnaryFunction};

/// Size in bits beyond which a number is enclosed: exact arithmetic on longer ones takes too long.
const MAX_BITS: u64 = 1 << 14;

/// The mixed domain, with balls of a given precision; one lane.
#[derive(Clone, Copy, Debug)]
pub struct Mixed {
    balls: ArbBall,
    /// Whether the root of a ball about 0 is supposed to exist.
    supposes_roots: bool,
}

/// A number, or the reason why there is none.
#[derive(Clone, Debug, PartialEq)]
pub enum Number {
    /// An exact number.
    Exact(Rational),
    /// An enclosed number.
    Ball(Approximation),
    /// No value: 1/0, √-1, ln 0.
    Nothing,
    /// A value that may not exist.
    Doubtful,
}

impl Mixed {
    /// Makes a domain of balls with midpoints of `bits` bits.
    pub fn new(bits: u32) -> Self {
        Self { balls: ArbBall::new(bits), supposes_roots: false }
    }

    /// Makes the same domain, except that roots of balls about 0 are supposed to exist: what is
    /// computed holds if they do.
    pub fn supposing_roots(bits: u32) -> Self {
        Self { supposes_roots: true, ..Self::new(bits) }
    }

    fn ball(&self, x: &Number) -> Option<Approximation> {
        match x {
            Number::Exact(value) => Some(self.balls.rational(value)),
            Number::Ball(ball) => Some(ball.clone()),
            Number::Nothing | Number::Doubtful => None,
        }
    }

    /// Applies a function to a ball. Without an enclosure, the sign of the argument decides whether
    /// a value exists.
    fn of_ball(&self, function: UnaryFunction, x: &Number) -> Number {
        let Some(ball) = self.ball(x) else { return x.clone() };
        let value = match function {
            UnaryFunction::Sqrt if self.supposes_roots => {
                ball.sqrt_where_real(self.balls.bits()).and_then(Approximation::in_range)
            }
            _ => self.balls.function(function, &ball),
        };
        match value {
            Some(value) => Number::Ball(value),
            None => {
                let is_negative = ball.excludes_zero() && !ball.is_positive();
                match function {
                    UnaryFunction::Sqrt | UnaryFunction::Ln if is_negative => Number::Nothing,
                    _ => Number::Doubtful,
                }
            }
        }
    }

    fn exact(&self, function: UnaryFunction, x: &Rational) -> Option<Number> {
        let value = match function {
            UnaryFunction::Neg => Some(-x),
            UnaryFunction::Abs => Some(x.abs()),
            UnaryFunction::Recip => return Some(x.recip().map_or(Number::Nothing, Number::Exact)),
            UnaryFunction::Sqrt if x.is_negative() => return Some(Number::Nothing),
            UnaryFunction::Sqrt => square_root(x),
            UnaryFunction::Ln if x.is_zero() || x.is_negative() => return Some(Number::Nothing),
            UnaryFunction::Ln => x.is_one().then(|| Rational::from(0)),
            UnaryFunction::Exp | UnaryFunction::Cos => x.is_zero().then(|| Rational::from(1)),
            UnaryFunction::Sin | UnaryFunction::Atan => x.is_zero().then(|| Rational::from(0)),
        };
        value.map(Number::Exact)
    }

    /// Computes x^y for x > 0, and integer powers.
    fn raised(&self, x: &Number, exponent: &Number) -> Number {
        match (x, exponent) {
            (Number::Nothing, _) | (_, Number::Nothing) => return Number::Nothing,
            (Number::Doubtful, _) | (_, Number::Doubtful) => return Number::Doubtful,
            _ => {}
        }
        let Some(ball) = self.ball(x) else { return Number::Doubtful };
        if !ball.is_positive() {
            let is_known = ball.is_zero() || ball.excludes_zero();
            return if is_known { Number::Nothing } else { Number::Doubtful };
        }
        let value = match exponent {
            Number::Exact(exponent) => self.balls.rational_power(&ball, exponent),
            _ => self.ball(exponent).and_then(|y| self.balls.power_of(&ball, &y)),
        };
        value.map_or(Number::Doubtful, Number::Ball)
    }
}

impl Domain for Mixed {
    type Block = Number;

    fn constant(&self, value: &Rational) -> Number {
        Number::Exact(value.clone())
    }

    fn values(&self, values: &[Rational]) -> Number {
        values.first().map_or(Number::Doubtful, |value| Number::Exact(value.clone()))
    }

    fn unary(&self, function: UnaryFunction, x: &Number, out: &mut Number) {
        *out = match x {
            Number::Exact(value) => {
                self.exact(function, value).unwrap_or_else(|| self.of_ball(function, x))
            }
            _ => self.of_ball(function, x),
        };
    }

    fn binary(&self, operation: BinaryOperation, x: &Number, y: &Number, out: &mut Number) {
        *out = match (x, y) {
            _ if operation == BinaryOperation::Pow => self.raised(x, y),
            (Number::Nothing, _) | (_, Number::Nothing) => Number::Nothing,
            (Number::Exact(a), Number::Exact(b))
                if a.bits().saturating_add(b.bits()) <= MAX_BITS =>
            {
                Number::Exact(match operation {
                    BinaryOperation::Add => a + b,
                    BinaryOperation::Sub => a - b,
                    BinaryOperation::Mul | BinaryOperation::Pow => a * b,
                })
            }
            // A product with 0 is 0, however large the other factor.
            (Number::Exact(zero), Number::Ball(_)) | (Number::Ball(_), Number::Exact(zero))
                if operation == BinaryOperation::Mul && zero.is_zero() =>
            {
                Number::Exact(zero.clone())
            }
            _ => {
                let mut result = None;
                let balls = (self.ball(x), self.ball(y));
                self.balls.binary(operation, &balls.0, &balls.1, &mut result);
                result.map_or(Number::Doubtful, Number::Ball)
            }
        };
    }

    fn power(&self, x: &Number, exponent: &Rational, out: &mut Number) {
        let integer = exponent.to_integer().and_then(|n| i32::try_from(n).ok());
        *out = match (x, integer) {
            (Number::Exact(value), Some(n))
                if value.bits().saturating_mul(u64::from(n.unsigned_abs())) <= MAX_BITS =>
            {
                value.powi(n).map_or(Number::Nothing, Number::Exact)
            }
            (Number::Nothing | Number::Doubtful, _) => x.clone(),
            (_, Some(_)) => self
                .ball(x)
                .and_then(|ball| self.balls.rational_power(&ball, exponent))
                .map_or(Number::Doubtful, Number::Ball),
            (_, None) => self.raised(x, &Number::Exact(exponent.clone())),
        };
    }
}

impl Enclosing for Mixed {
    const LANES: usize = 1;

    fn enclosure(block: &Number, _: usize) -> Option<(f64, f64)> {
        match block {
            Number::Exact(value) => {
                let (mid, is_exact) = value.to_f64();
                let rounding = mid.abs() * f64::EPSILON + f64::MIN_POSITIVE;
                Some((mid, if is_exact { 0.0 } else { rounding }))
            }
            Number::Ball(ball) => Some(ball.enclosure()),
            Number::Nothing | Number::Doubtful => None,
        }
    }

    fn is_positive(block: &Number, _: usize) -> bool {
        match block {
            Number::Exact(value) => !value.is_negative() && !value.is_zero(),
            Number::Ball(ball) => ball.is_positive(),
            Number::Nothing | Number::Doubtful => false,
        }
    }

    fn excludes_zero(block: &Number, _: usize) -> bool {
        match block {
            Number::Exact(value) => !value.is_zero(),
            Number::Ball(ball) => ball.excludes_zero(),
            Number::Nothing | Number::Doubtful => false,
        }
    }

    fn beyond_f64(block: &Number, lane: usize) -> Option<String> {
        match block {
            Number::Exact(value) => {
                let (mid, rad) = Self::enclosure(block, lane)?;
                let hidden = !value.is_zero() && mid.abs() <= rad;
                hidden.then(|| ArbBall::new(64).rational(value).rough())
            }
            Number::Ball(ball) => ArbBall::beyond_f64(&Some(ball.clone()), lane),
            Number::Nothing | Number::Doubtful => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::{Evaluator, Expr, Tape, literally, record};
    use crate::scalar::Scalar;

    fn at(x: &str, build: impl FnOnce(Expr) -> Expr) -> Number {
        let (graph, value) = record(1, |inputs| literally(|| build(inputs[0]))).expect("records");
        let tape = Tape::new(&graph, &[value]);
        let domain = Mixed::new(128);
        let mut run = Evaluator::new(&tape, domain);
        run.run(&[domain.values(&[x.parse().expect("a number")])]);
        run.output(0).clone()
    }

    #[test]
    fn existence_is_known_where_numbers_are() {
        let zero = Number::Exact(Rational::from(0));
        assert_eq!(at("-3/7", |x| (x + x.modulus()).sqrt()), zero, "√0 exists");
        assert_eq!(at("-3/7", |x| x.sqrt()), Number::Nothing, "√-3/7 does not");
        assert_eq!(at("2", |x| (x.sqrt() - 2.0).sqrt()), Number::Nothing, "nor √(√2 − 2)");
        let doubt = at("2", |x| (x.sqrt() * x.sqrt() - 2.0).sqrt());
        assert_eq!(doubt, Number::Doubtful, "√(√2 √2 − 2) is not told from √-0.000…");
        assert_eq!(at("2", |x| (x - 2.0).recip()), Number::Nothing, "1/0");
        assert_eq!(at("2", |x| (x - 2.0).recip() * 0.0), Number::Nothing, "not even times 0");
        assert!(matches!(at("2", |x| x.sqrt().exp()), Number::Ball(_)), "an enclosure");
        assert_eq!(at("-1", |x| x.power(&Rational::new(1, 3))), Number::Nothing, "(-1)^(1/3)");
        assert_eq!(at("4", |x| x.sqrt() - 2.0), zero, "√4 is 2");
    }

    #[test]
    fn a_root_that_is_supposed_to_exist_is_enclosed() {
        let domain = Mixed::supposing_roots(128);
        let at = |x: i64, build: fn(Expr) -> Expr| {
            let (graph, value) = record(1, |inputs| build(inputs[0])).expect("records");
            let tape = Tape::new(&graph, &[value]);
            let mut run = Evaluator::new(&tape, domain);
            run.run(&[Number::Exact(Rational::from(x))]);
            Mixed::enclosure(run.output(0), 0)
        };
        let near = |x: i64, build| at(x, build).is_some_and(|(mid, rad)| mid == 0.0 && rad < 1e-18);
        assert!(near(2, |x| (x.sqrt().powi(2) * 3.0 - x.sqrt() * x.sqrt() * 3.0).sqrt()), "√0");
        assert_eq!(at(2, |x| (x.sqrt() - 2.0).sqrt()), None, "√(√2 − 2) is none");
        assert!(at(2, |x| x.sqrt().sqrt()).is_some_and(|(mid, _)| mid > 1.18), "√√2");
    }
}
