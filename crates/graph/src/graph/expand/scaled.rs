//! Expansions times an exponential e^E, where E tends to ±∞ like a power of 1/δ.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use num_dual::DualNum;
use num_traits::{One, Zero};

use super::series::{Arithmetic, EXACT, Failure, LARGEST, Series};
use crate::graph::Expr;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// Sum of terms c δ^i (ln δ)^j with i < 0.
type Pole = BTreeMap<(i32, i32), Expr>;

/// e^E S with a pole E.
#[derive(Clone, Debug)]
pub struct Scaled {
    exponent: Pole,
    series: Series,
}

impl From<Series> for Scaled {
    fn from(series: Series) -> Self {
        Self { exponent: Pole::new(), series }
    }
}

/// Smaller than every power of δ.
fn vanishing() -> Series {
    Series { terms: BTreeMap::new(), end: LARGEST }
}

/// Between two numbers, as a sine.
fn bounded() -> Series {
    Series { terms: BTreeMap::new(), end: 0 }
}

/// ±π/2.
pub fn quarter_turn(sign: Expr) -> Series {
    Series::constant(Expr::one().atan() * Expr::rational(&Rational::from(2)) * sign)
}

/// Value of what does not depend on δ by its form.
fn as_value(series: &Series) -> Option<Expr> {
    match (series.end, series.terms.len()) {
        (EXACT, 0) => Some(Expr::zero()),
        (EXACT, 1) => series.terms.get(&(0, 0)).copied(),
        _ => None,
    }
}

fn times(pole: &Pole, by: Expr) -> Pole {
    let all = pole.iter().map(|(order, value)| (*order, *value * by));
    all.filter(|(_, value)| !value.is_zero()).collect()
}

fn sum_of(a: &Pole, b: &Pole) -> Pole {
    let mut sum = a.clone();
    for (order, value) in b {
        *sum.entry(*order).or_insert_with(Expr::zero) += *value;
    }
    sum.retain(|_, value| !value.is_zero());
    sum
}

fn minus_one() -> Expr {
    Expr::rational(&Rational::from(-1))
}

impl Arithmetic {
    /// Growth of e^E with δ → 0: beyond all powers of 1/δ, none where it is 1, or below all powers of δ.
    fn growth(&mut self, exponent: &Pole) -> Result<Ordering, Failure> {
        if exponent.is_empty() {
            return Ok(Ordering::Equal);
        }
        let ((_, logs), value) = Series { terms: exponent.clone(), end: EXACT }.leading()?;
        let is_positive = match value.folded() {
            Some(value) => !value.is_negative(),
            None => {
                let Some(known) = self.supposed.iter().find(|(own, _)| *own == value) else {
                    self.open = Some(value);
                    return Err(Failure::Sign);
                };
                known.1
            }
        };
        // ln δ is negative.
        Ok(match is_positive == (logs.rem_euclid(2) == 0) {
            true => Ordering::Greater,
            false => Ordering::Less,
        })
    }

    /// Returns what does not grow as an expansion alone.
    fn plain(&mut self, a: &Scaled) -> Result<Series, Failure> {
        if a.series.is_exactly_zero() {
            return Ok(a.series.clone());
        }
        match self.growth(&a.exponent)? {
            Ordering::Less => Ok(vanishing()),
            Ordering::Equal => Ok(a.series.clone()),
            Ordering::Greater => Err(Failure::Form),
        }
    }

    /// Returns an expansion that decides a limit: what grows has terms before order 0, as many as are known not to
    /// be 0.
    pub fn decisive(&mut self, a: &Scaled) -> Result<Series, Failure> {
        if a.series.is_exactly_zero() || self.growth(&a.exponent)? != Ordering::Greater {
            return self.plain(a);
        }
        let moved =
            |((order, logs), value): (&(i32, i32), &Expr)| ((order - LARGEST, *logs), *value);
        let is_known = |value: &Expr| value.folded().is_some_and(|value| !value.is_zero());
        let all = a.series.terms.iter().filter(|(order, _)| order.0 < LARGEST);
        let terms: BTreeMap<(i32, i32), Expr> = match a.series.end {
            EXACT => all.map(moved).collect(),
            _ => all.take(1).filter(|(_, value)| is_known(value)).map(moved).collect(),
        };
        match terms.is_empty() {
            true => Err(Failure::Terms),
            false => Ok(Series { terms, end: EXACT }),
        }
    }

    /// Applies an operation of two values.
    pub fn binary(
        &mut self,
        operation: BinaryOperation,
        a: &Scaled,
        b: &Scaled,
    ) -> Result<Scaled, Failure> {
        match operation {
            BinaryOperation::Add => self.sum(a, b),
            BinaryOperation::Sub => self.sum(a, &b.negated()),
            BinaryOperation::Mul => Ok(Scaled {
                exponent: sum_of(&a.exponent, &b.exponent),
                series: self.product(&a.series, &b.series)?,
            }),
            BinaryOperation::Pow => self.power_to(a, b),
        }
    }

    fn sum(&mut self, a: &Scaled, b: &Scaled) -> Result<Scaled, Failure> {
        if a.series.is_exactly_zero() || b.series.is_exactly_zero() {
            return Ok(if a.series.is_exactly_zero() { b.clone() } else { a.clone() });
        }
        let between = sum_of(&a.exponent, &times(&b.exponent, minus_one()));
        let mut larger = match self.growth(&between)? {
            Ordering::Equal => {
                let series = a.series.plus(&b.series);
                return Ok(Scaled { exponent: a.exponent.clone(), series });
            }
            Ordering::Greater => a.clone(),
            Ordering::Less => b.clone(),
        };
        // The other one is smaller by more than every power of δ.
        larger.series.end = larger.series.end.min(LARGEST);
        Ok(larger)
    }

    /// Applies a function of one value.
    pub fn unary(&mut self, function: UnaryFunction, a: &Scaled) -> Result<Scaled, Failure> {
        let own = |exponent: Pole, series: Series| Scaled { exponent, series };
        Ok(match function {
            UnaryFunction::Neg => a.negated(),
            UnaryFunction::Abs => own(a.exponent.clone(), self.modulus(&a.series)?),
            UnaryFunction::Recip => own(times(&a.exponent, minus_one()), self.inverse(&a.series)?),
            UnaryFunction::Sqrt => self.power_by(a, &Rational::new(1, 2))?,
            UnaryFunction::Exp => self.exponential_of(a)?,
            UnaryFunction::Ln => self.logarithm_of(a)?,
            UnaryFunction::Sin => self.wave(a, 0)?,
            UnaryFunction::Cos => self.wave(a, 1)?,
            UnaryFunction::Atan => self.arctangent_of(a)?,
        })
    }

    /// Computes a^q for a that is not negative.
    pub fn power_by(&mut self, a: &Scaled, exponent: &Rational) -> Result<Scaled, Failure> {
        let series = self.power(&a.series, exponent)?;
        Ok(Scaled { exponent: times(&a.exponent, Expr::rational(exponent)), series })
    }

    /// Computes a^y for a > 0.
    fn power_to(&mut self, a: &Scaled, y: &Scaled) -> Result<Scaled, Failure> {
        let y = self.plain(y)?;
        match as_value(&y) {
            Some(value) if a.exponent.is_empty() => Ok(self.power_of(&a.series, value)?.into()),
            Some(_) => Err(Failure::Form),
            None => {
                let logarithm = self.logarithm_of(a)?;
                let logarithm = self.plain(&logarithm)?;
                let product = self.product(&y, &logarithm)?;
                self.exponential_of(&product.into())
            }
        }
    }

    fn exponential_of(&mut self, a: &Scaled) -> Result<Scaled, Failure> {
        let a = self.plain(a)?;
        if a.low() >= 0 || a.end <= 0 {
            return Ok(self.exponential(&a)?.into());
        }
        let (exponent, terms): (Pole, _) = a.terms.iter().partition(|((order, _), _)| *order < 0);
        let rest = Series { terms, end: a.end };
        match self.exponential(&rest) {
            Ok(series) => Ok(Scaled { exponent, series }),
            // What tends to −∞ needs no more terms.
            Err(failure) => self.exponential(&a).map(Scaled::from).map_err(|_| failure),
        }
    }

    /// ln (e^E S) = E + ln S.
    fn logarithm_of(&mut self, a: &Scaled) -> Result<Scaled, Failure> {
        let logarithm = self.logarithm(&a.series)?;
        let pole = Series { terms: a.exponent.clone(), end: EXACT };
        Ok(pole.plus(&logarithm).into())
    }

    /// Computes the sine, or the cosine: where the argument has no limit they are bounded.
    fn wave(&mut self, a: &Scaled, place: usize) -> Result<Scaled, Failure> {
        if !a.series.is_exactly_zero() && self.growth(&a.exponent)? == Ordering::Greater {
            return Ok(bounded().into());
        }
        let a = self.plain(a)?;
        match self.sine_and_cosine(&a) {
            Err(Failure::Form) => Ok(bounded().into()),
            both => Ok(both?[place].clone().into()),
        }
    }

    fn arctangent_of(&mut self, a: &Scaled) -> Result<Scaled, Failure> {
        if a.series.is_exactly_zero() || self.growth(&a.exponent)? != Ordering::Greater {
            let a = self.plain(a)?;
            return Ok(self.arctangent(&a)?.into());
        }
        // ±π/2 − atan(1/a), and the second is smaller than every power of δ.
        let ((_, logs), value) = a.series.leading()?;
        let sign = self.sign(value, logs);
        Ok(vanishing().plus(&quarter_turn(sign)).into())
    }
}

impl Scaled {
    fn negated(&self) -> Self {
        Self { exponent: self.exponent.clone(), series: self.series.negated() }
    }
}
