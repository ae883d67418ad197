//! Quotients of polynomials, and the reading of a graph as one.

use crate::graph::{Expr, Graph, Step};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

use super::{MOST_WORK, Polynomial};

/// Largest power that is multiplied out.
const MOST_POWER: i64 = 32;

/// A quotient p/q of polynomials.
#[derive(Clone, Debug)]
pub struct Fraction {
    /// Numerator p.
    pub above: Polynomial,
    /// Denominator q, not 0.
    pub below: Polynomial,
}

impl Fraction {
    /// Makes a fraction of a polynomial.
    pub fn whole(above: Polynomial) -> Self {
        Self { above, below: Polynomial::constant(&Rational::from(1)) }
    }

    /// Returns c, and p and q such that the fraction is c (p/q)².
    pub fn square(&self) -> Option<(Rational, Self)> {
        let mut work = MOST_WORK;
        let (scale, root) = self.above.times(&self.below, &mut work)?.square()?;
        Some((scale, Self { above: root, below: self.below.clone() }))
    }

    /// Returns the fraction without powers of variables that divide p and q.
    pub fn without_common_terms(&self) -> Option<Self> {
        let (above, below) = (self.above.common_term(), self.below.common_term());
        let both = above.plus(&below.scaled(&Rational::from(2))).common_term();
        Some(Self { above: self.above.over_term(&both)?, below: self.below.over_term(&both)? })
    }

    /// Returns p such that the fraction is p/q².
    pub fn over_square(&self) -> Option<Polynomial> {
        self.above.times(&self.below, &mut { MOST_WORK })
    }

    /// Returns the fraction as a polynomial, if the denominator is a number.
    pub fn polynomial(&self) -> Option<Polynomial> {
        Some(self.above.scaled(&self.below.number()?.recip()?))
    }

    fn times(&self, other: &Self, work: &mut usize) -> Option<Self> {
        Some(Self {
            above: self.above.times(&other.above, work)?,
            below: self.below.times(&other.below, work)?,
        })
    }

    /// Multiplies fractions.
    pub fn product<'f>(mut factors: impl Iterator<Item = &'f Self>) -> Option<Self> {
        let one = Self::whole(Polynomial::constant(&Rational::from(1)));
        let mut work = MOST_WORK;
        factors.try_fold(one, |product, factor| product.times(factor, &mut work))
    }

    fn sum(&self, other: &Self, sign: i64, work: &mut usize) -> Option<Self> {
        let signed = other.above.scaled(&Rational::from(sign));
        if self.below == other.below {
            return Some(Self {
                above: self.above.plus(&signed).checked()?,
                below: self.below.clone(),
            });
        }
        let left = self.above.times(&other.below, work)?;
        let right = signed.times(&self.below, work)?;
        let below = self.below.times(&other.below, work)?;
        Some(Self { above: left.plus(&right).checked()?, below })
    }

    fn inverse(&self) -> Option<Self> {
        (!self.above.is_zero())
            .then(|| Self { above: self.below.clone(), below: self.above.clone() })
    }

    fn power(&self, exponent: i64, work: &mut usize) -> Option<Self> {
        let base = if exponent < 0 { self.inverse()? } else { self.clone() };
        let mut power = Self::whole(Polynomial::constant(&Rational::from(1)));
        for _ in 0..exponent.unsigned_abs().min(MOST_POWER as u64 + 1) {
            power = power.times(&base, work)?;
        }
        (exponent.abs() <= MOST_POWER).then_some(power)
    }

    /// Records the value from the values of the variables.
    pub fn value(&self, of: &impl Fn(u32) -> Option<Expr>) -> Option<Expr> {
        Some(self.above.value(of)? / self.below.value(of)?)
    }
}

/// Reads the value at a place as a fraction; `given` provides the values of places that are not
/// expanded, including all inputs.
pub fn fraction(
    graph: &Graph,
    place: usize,
    given: &impl Fn(usize, Step<'_>) -> Option<Polynomial>,
) -> Option<Fraction> {
    fraction_of(graph, place, &|at, step| given(at, step).map(Fraction::whole))
}

/// Reads the value in the same way from fractions.
pub fn fraction_of(
    graph: &Graph,
    place: usize,
    given: &impl Fn(usize, Step<'_>) -> Option<Fraction>,
) -> Option<Fraction> {
    let reached = graph.reached_from(&[place]);
    let mut work = MOST_WORK;
    let mut values: Vec<Option<Fraction>> = Vec::with_capacity(place + 1);
    for (at, step) in graph.steps().enumerate().take(place + 1) {
        let value = match reached[at] {
            false => None,
            true => match given(at, step) {
                Some(own) => Some(own),
                None => of_step(step, &values, &mut work),
            },
        };
        values.push(value);
    }
    values.pop().flatten()
}

fn of_step(step: Step<'_>, values: &[Option<Fraction>], work: &mut usize) -> Option<Fraction> {
    let of = |place: usize| values[place].as_ref();
    match step {
        Step::Constant(value) => Some(Fraction::whole(Polynomial::constant(value))),
        Step::Input(_) => None,
        Step::Unary(UnaryFunction::Neg, a) => {
            let a = of(a)?;
            Some(Fraction { above: a.above.negated(), below: a.below.clone() })
        }
        Step::Unary(UnaryFunction::Recip, a) => of(a)?.inverse(),
        Step::Unary(..) => None,
        Step::Binary(BinaryOperation::Mul, a, b) => of(a)?.times(of(b)?, work),
        Step::Binary(BinaryOperation::Add, a, b) => of(a)?.sum(of(b)?, 1, work),
        Step::Binary(BinaryOperation::Sub, a, b) => of(a)?.sum(of(b)?, -1, work),
        Step::Binary(BinaryOperation::Pow, ..) => None,
        Step::Power(a, exponent) => of(a)?.power(exponent.to_integer()?, work),
    }
}
