//! Fractions of polynomials in lowest terms.

use liouville::number::rational::Rational;
use liouville::proof::{MOST_POLYNOMIAL_WORK, Polynomial};

/// Largest number of terms.
const MOST_TERMS: usize = 400;
/// Largest exponent.
const MOST_POWER: u32 = 32;

/// A fraction P/Q, Q not 0.
#[derive(Clone, Debug)]
pub struct Fraction {
    pub above: Polynomial,
    pub below: Polynomial,
}

fn times(a: &Polynomial, b: &Polynomial) -> Option<Polynomial> {
    a.times(b, &mut { MOST_POLYNOMIAL_WORK }).filter(|own| own.size() <= MOST_TERMS)
}

impl Fraction {
    pub fn whole(above: Polynomial) -> Self {
        Self { above, below: Polynomial::constant(&Rational::from(1)) }
    }

    pub fn number(value: &Rational) -> Self {
        Self::whole(Polynomial::constant(value))
    }

    pub fn one() -> Self {
        Self::number(&Rational::from(1))
    }

    pub fn variable(token: u32) -> Self {
        Self::whole(Polynomial::variable(token))
    }

    /// Whether the denominator is a number.
    pub fn is_polynomial(&self) -> bool {
        self.below.number().is_some()
    }

    /// Adds a fraction, or subtracts it.
    pub fn plus(&self, other: &Self, is_negative: bool) -> Option<Self> {
        let sign = Rational::from(if is_negative { -1 } else { 1 });
        let other = Self { above: other.above.scaled(&sign), below: other.below.clone() };
        let work = &mut { MOST_POLYNOMIAL_WORK };
        let common = self.below.common_divisor(&other.below, work)?;
        let rest = other.below.over(&common, work)?;
        let own = self.below.over(&common, work)?;
        let above = times(&self.above, &rest)?.plus(&times(&other.above, &own)?);
        Self { above, below: times(&self.below, &rest)? }.reduced()
    }

    pub fn times(&self, other: &Self) -> Option<Self> {
        let above = times(&self.above, &other.above)?;
        Self { above, below: times(&self.below, &other.below)? }.reduced()
    }

    /// The quotient; `None` where the divisor is 0.
    pub fn over(&self, other: &Self) -> Option<Self> {
        let inverse = Self { above: other.below.clone(), below: other.above.clone() };
        (!other.above.is_zero()).then(|| self.times(&inverse))?
    }

    pub fn power(&self, exponent: i64) -> Option<Self> {
        let count = u32::try_from(exponent.unsigned_abs()).ok().filter(|own| *own <= MOST_POWER)?;
        let mut power = Self::one();
        for _ in 0..count {
            power = power.times(self)?;
        }
        if exponent < 0 { Self::one().over(&power) } else { Some(power) }
    }

    /// In lowest terms.
    pub fn reduced(self) -> Option<Self> {
        if self.above.is_zero() || self.is_polynomial() {
            let below = self.below.number().and_then(|own| own.recip());
            let above = below.map_or_else(|| self.above.clone(), |own| self.above.scaled(&own));
            return Some(Self::whole(above));
        }
        let work = &mut { MOST_POLYNOMIAL_WORK };
        let common = self.above.common_divisor(&self.below, work)?;
        Some(Self {
            above: self.above.over(&common, work)?,
            below: self.below.over(&common, work)?,
        })
    }

    /// With even powers of roots written out; a constant root below the line goes above it.
    pub fn without_squares(
        mut self,
        roots: &[(u32, Polynomial)],
        is_constant: impl Fn(u32) -> bool,
    ) -> Option<Self> {
        for (root, square) in roots {
            let variable = Polynomial::variable(*root);
            if is_constant(*root) && self.below.over_term(&variable).is_some() {
                self.above = times(&self.above, &variable)?;
                self.below = times(&self.below, &variable)?;
            }
            for part in [&mut self.above, &mut self.below] {
                *part = without_square(part, *root, square)?;
            }
        }
        self.reduced()
    }
}

/// A polynomial with the even powers of a root written out.
fn without_square(own: &Polynomial, root: u32, square: &Polynomial) -> Option<Polynomial> {
    let mut sum = Polynomial::default();
    for (power, part) in own.by_powers(root) {
        let mut part = part;
        for _ in 0..power / 2 {
            part = times(&part, square)?;
        }
        if power % 2 == 1 {
            part = times(&part, &Polynomial::variable(root))?;
        }
        sum = sum.plus(&part);
    }
    (sum.size() <= MOST_TERMS).then_some(sum)
}
