//! Expansions in powers of δ and of ln δ, for δ > 0 that tends to 0.

use std::collections::BTreeMap;

use num_dual::DualNum;
use num_traits::{One, Zero};

use crate::graph::Expr;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::scaled::quarter_turn;

/// Order of a remainder that is 0.
pub(super) const EXACT: i32 = i32::MAX;
/// Largest order of a term, in either direction, and of a power of the logarithm.
pub(super) const LARGEST: i32 = 1 << 16;
/// Largest number of terms.
const MOST_TERMS: usize = 96;

/// The reason why there is no expansion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure {
    /// The value does not exist for small δ > 0.
    NoValue,
    /// A root of δ that is finer than those of the expansion.
    Root,
    /// Too few terms are known.
    Terms,
    /// A sign that decides which of two exponentials is the larger one.
    Sign,
    /// A form that is not expanded, such as exp(1/δ).
    Form,
}

/// Σ c δ^i (ln δ)^j + o(δ^end), where every c is a value that was not folded to 0.
#[derive(Clone, Debug)]
pub struct Series {
    pub(super) terms: BTreeMap<(i32, i32), Expr>,
    /// Order before which all terms are known.
    pub(super) end: i32,
}

/// The arithmetic of expansions with a number of known orders.
pub struct Arithmetic {
    /// Number of orders kept from the first on.
    pub orders: i32,
    /// Values without which what is expanded has none for small δ.
    pub guards: Vec<Expr>,
    /// Values that are supposed to be positive, or negative.
    pub supposed: Vec<(Expr, bool)>,
    /// Value whose sign is needed, and not supposed.
    pub open: Option<Expr>,
}

fn whole(value: i64) -> Expr {
    Expr::rational(&Rational::from(value))
}

impl Series {
    /// Makes a value that does not depend on δ.
    pub fn constant(value: Expr) -> Self {
        Self::term(value, (0, 0))
    }

    /// Makes c δ^i (ln δ)^j.
    pub fn term(value: Expr, order: (i32, i32)) -> Self {
        let terms = if value.is_zero() { BTreeMap::new() } else { [(order, value)].into() };
        Self { terms, end: EXACT }
    }

    /// Returns the order of the first term, or that of the remainder if there is none.
    pub fn low(&self) -> i32 {
        self.terms.keys().next().map_or(self.end, |(order, _)| *order)
    }

    /// Returns the terms before some order; `None` if not all of them are known.
    pub fn before(&self, order: i32) -> Option<Vec<((i32, i32), Expr)>> {
        let known = self.terms.iter().filter(|((own, _), _)| *own < order);
        (self.end >= order).then(|| known.map(|(at, value)| (*at, *value)).collect())
    }

    pub(super) fn is_exactly_zero(&self) -> bool {
        self.terms.is_empty() && self.end == EXACT
    }

    /// Returns the first term, which has to be alone at its order.
    pub(super) fn leading(&self) -> Result<((i32, i32), Expr), Failure> {
        let mut terms = self.terms.iter();
        let Some((order, value)) = terms.next() else {
            return Err(if self.end == EXACT { Failure::NoValue } else { Failure::Terms });
        };
        match terms.next() {
            Some(((next, _), _)) if *next == order.0 => Err(Failure::Form),
            _ => Ok((*order, *value)),
        }
    }

    /// Whether the form shows that the value tends to −∞ like a power of 1/δ.
    fn tends_below_all(&self) -> bool {
        let Ok(((order, logs), value)) = self.leading() else { return false };
        // ln δ is negative.
        let is_even = logs.rem_euclid(2) == 0;
        order < 0 && value.folded().is_some_and(|c| !c.is_zero() && c.is_negative() == is_even)
    }

    pub(super) fn scaled(&self, by: Expr) -> Self {
        self.shifted(by, (0, 0))
    }

    /// Multiplies by c δ^i (ln δ)^j.
    fn shifted(&self, by: Expr, (order, logs): (i32, i32)) -> Self {
        let moved = |((i, j), value): (&(i32, i32), &Expr)| ((i + order, j + logs), *value * by);
        let terms = self.terms.iter().map(moved).filter(|(_, value)| !value.is_zero()).collect();
        let end = if self.end == EXACT { EXACT } else { self.end.saturating_add(order) };
        Self { terms, end }
    }

    /// Computes the sum.
    pub fn plus(&self, other: &Self) -> Self {
        let end = self.end.min(other.end);
        let mut sum = Self { terms: self.terms.clone(), end };
        for (order, value) in &other.terms {
            let own = sum.terms.entry(*order).or_insert_with(Expr::zero);
            *own += *value;
        }
        sum.terms.retain(|(order, _), value| *order < end && !value.is_zero());
        sum
    }

    /// Computes the negative.
    pub fn negated(&self) -> Self {
        self.scaled(whole(-1))
    }

    /// Splits into the terms of order 0 and the rest; none may come before.
    fn around_zero(&self) -> Result<(BTreeMap<i32, Expr>, Self), Failure> {
        if self.low() < 0 {
            return Err(Failure::Form);
        }
        if self.end <= 0 {
            return Err(Failure::Terms);
        }
        let of_zero = self.terms.iter().filter(|((order, _), _)| *order == 0);
        let first = of_zero.map(|((_, logs), value)| (*logs, *value)).collect();
        let mut rest = self.clone();
        rest.terms.retain(|(order, _), _| *order > 0);
        Ok((first, rest))
    }

    /// Splits into a value and the rest, without a logarithm at order 0.
    fn about_a_value(&self) -> Result<(Expr, Self), Failure> {
        let (first, rest) = self.around_zero()?;
        match first.keys().all(|logs| *logs == 0) {
            true => Ok((first.get(&0).copied().unwrap_or_else(Expr::zero), rest)),
            false => Err(Failure::Form),
        }
    }
}

impl Arithmetic {
    pub(super) fn guard(&mut self, value: Expr) {
        if !value.is_always_defined() {
            self.guards.push(value);
        }
    }

    /// Leaves out the orders that are not kept.
    fn cut(&self, mut series: Series) -> Result<Series, Failure> {
        let end = series.low().saturating_add(self.orders);
        if series.terms.keys().any(|(order, _)| *order >= end) {
            series.end = series.end.min(end);
            series.terms.retain(|(order, _), _| *order < end);
        }
        let is_large = |(order, logs): &(i32, i32)| order.abs().max(logs.abs()) > LARGEST;
        match series.terms.len() > MOST_TERMS || series.terms.keys().any(is_large) {
            true => Err(Failure::Form),
            false => Ok(series),
        }
    }

    /// Computes the product.
    pub fn product(&self, a: &Series, b: &Series) -> Result<Series, Failure> {
        if a.is_exactly_zero() || b.is_exactly_zero() {
            return Ok(Series::constant(Expr::zero()));
        }
        let end_by = |own: &Series, other: &Series| match own.end {
            EXACT => EXACT,
            end => end.saturating_add(other.low()),
        };
        let end = end_by(a, b).min(end_by(b, a));
        let most = end.min(a.low().saturating_add(b.low()).saturating_add(self.orders));
        let mut product = Series { terms: BTreeMap::new(), end };
        for ((i, j), x) in &a.terms {
            for ((k, l), y) in &b.terms {
                if i + k < most {
                    let own = product.terms.entry((i + k, j + l)).or_insert_with(Expr::zero);
                    *own += *x * *y;
                } else {
                    product.end = product.end.min(most);
                }
            }
        }
        product.terms.retain(|_, value| !value.is_zero());
        self.cut(product)
    }

    /// Computes Σ c_k u^k for u without terms of order 0; `next` makes c_k.
    fn composed(&self, u: &Series, mut next: impl FnMut(i64) -> Expr) -> Result<Series, Failure> {
        let mut sum = Series::constant(next(0));
        let mut power = Series::constant(Expr::one());
        for k in 1..=i64::from(self.orders) {
            power = self.product(&power, u)?;
            if power.is_exactly_zero() {
                return Ok(sum);
            }
            sum = sum.plus(&power.scaled(next(k)));
        }
        // u^k begins at order k at the latest.
        sum.end = sum.end.min(self.orders + 1);
        sum.terms.retain(|(order, _), _| *order < sum.end);
        self.cut(sum)
    }

    /// Divides by the first term c δ^i (ln δ)^j: returns i and j, c, and what remains less 1.
    fn normal(&mut self, a: &Series) -> Result<((i32, i32), Expr, Series), Failure> {
        let (order, value) = a.leading()?;
        let mut rest = a.clone();
        rest.terms.remove(&order);
        if rest.terms.is_empty() && rest.end == EXACT {
            return Ok((order, value, rest));
        }
        let inverse = value.recip();
        self.guard(inverse);
        Ok((order, value, rest.shifted(inverse, (-order.0, -order.1))))
    }

    /// Computes 1/a.
    pub fn inverse(&mut self, a: &Series) -> Result<Series, Failure> {
        let ((order, logs), value, rest) = self.normal(a)?;
        let inverse = value.recip();
        self.guard(inverse);
        let one = |k: i64| whole(if k % 2 == 0 { 1 } else { -1 });
        let all = self.composed(&rest, one)?;
        self.cut(all.shifted(inverse, (-order, -logs)))
    }

    /// Computes a^q for a that is not negative.
    pub fn power(&mut self, a: &Series, exponent: &Rational) -> Result<Series, Failure> {
        let is_root = (exponent * &Rational::from(2)).to_integer().is_some();
        if a.is_exactly_zero() && !exponent.is_negative() {
            // √0 is 0, and other powers of 0 have no value.
            return if is_root { Ok(a.clone()) } else { Err(Failure::NoValue) };
        }
        let ((order, logs), value, rest) = self.normal(a)?;
        if logs != 0 {
            return Err(Failure::Form);
        }
        let moved = (exponent * &Rational::from(i64::from(order))).to_integer();
        let moved = moved.ok_or(Failure::Root)?;
        let power = value.power(exponent);
        if power.is_never_defined() {
            return Err(Failure::NoValue);
        }
        self.guard(power);
        let all = self.binomial(&rest, Expr::rational(exponent))?;
        let moved = i32::try_from(moved).map_err(|_| Failure::Form)?;
        self.cut(all.shifted(power, (moved, 0)))
    }

    /// Computes (1 + u)^e.
    fn binomial(&self, u: &Series, exponent: Expr) -> Result<Series, Failure> {
        let mut coefficient = Expr::one();
        self.composed(u, |k| {
            if k > 0 {
                coefficient *= (exponent - whole(k - 1)) * Expr::rational(&Rational::new(1, k));
            }
            coefficient
        })
    }

    /// Computes a^y for a > 0 and a value y.
    pub fn power_of(&mut self, a: &Series, exponent: Expr) -> Result<Series, Failure> {
        let (order, value, rest) = self.normal(a)?;
        if order != (0, 0) {
            return Err(Failure::Form);
        }
        let power = value.power_of(exponent);
        self.guard(power);
        Ok(self.binomial(&rest, exponent)?.scaled(power))
    }

    /// Computes e^a.
    pub fn exponential(&mut self, a: &Series) -> Result<Series, Failure> {
        if a.tends_below_all() {
            // Smaller than every power of δ.
            return Ok(Series { terms: BTreeMap::new(), end: LARGEST });
        }
        let (first, rest) = a.around_zero()?;
        if first.keys().any(|logs| !(0..=1).contains(logs)) {
            return Err(Failure::Form);
        }
        // e^(m ln δ) is δ^m.
        let moved = match first.get(&1) {
            None => 0,
            Some(multiple) => {
                let multiple = multiple.folded().ok_or(Failure::Form)?;
                let moved = multiple.to_integer().ok_or(Failure::Root)?;
                i32::try_from(moved).map_err(|_| Failure::Form)?
            }
        };
        let value = first.get(&0).map_or_else(Expr::one, |value| value.exp());
        let mut coefficient = Expr::one();
        let all = self.composed(&rest, |k| {
            if k > 0 {
                coefficient *= Expr::rational(&Rational::new(1, k));
            }
            coefficient
        })?;
        self.cut(all.shifted(value, (moved, 0)))
    }

    /// Computes ln a.
    pub fn logarithm(&mut self, a: &Series) -> Result<Series, Failure> {
        let ((order, logs), value, rest) = self.normal(a)?;
        if logs != 0 {
            return Err(Failure::Form);
        }
        let logarithm = value.ln();
        if logarithm.is_never_defined() {
            return Err(Failure::NoValue);
        }
        self.guard(logarithm);
        let all = self.composed(&rest, |k| match k {
            0 => logarithm,
            k => Expr::rational(&Rational::new(if k % 2 == 0 { -1 } else { 1 }, k)),
        })?;
        self.cut(all.plus(&Series::term(whole(i64::from(order)), (0, 1))))
    }

    /// Computes sine and cosine.
    pub fn sine_and_cosine(&self, a: &Series) -> Result<[Series; 2], Failure> {
        let (value, rest) = a.about_a_value()?;
        let (sine, cosine) = (value.sin(), value.cos());
        // The k-th derivative of the sine, and of the cosine, over k!.
        let of = |cycle: [Expr; 4]| {
            let mut factor = Expr::one();
            self.composed(&rest, |k| {
                if k > 0 {
                    factor *= Expr::rational(&Rational::new(1, k));
                }
                cycle[(k % 4) as usize] * factor
            })
        };
        Ok([of([sine, cosine, -sine, -cosine])?, of([cosine, -sine, -cosine, sine])?])
    }

    /// Computes the arctangent.
    pub fn arctangent(&mut self, a: &Series) -> Result<Series, Failure> {
        if a.low() < 0 {
            // ±π/2 - atan(1/a)
            let inverse = self.inverse(a)?;
            let rest = self.arctangent(&inverse)?.negated();
            let ((_, logs), value) = a.leading()?;
            let sign = self.sign(value, logs);
            return Ok(rest.plus(&quarter_turn(sign)));
        }
        // atan(c + u) = atan c + atan(u/(1 + c² + c u))
        let (value, rest) = a.about_a_value()?;
        let below = rest.scaled(value).plus(&Series::constant(Expr::one() + value * value));
        let below = self.inverse(&below)?;
        let inner = self.product(&rest, &below)?;
        let odd = |k: i64| match k % 4 {
            1 => Expr::rational(&Rational::new(1, k)),
            3 => Expr::rational(&Rational::new(-1, k)),
            _ => Expr::zero(),
        };
        Ok(self.composed(&inner, odd)?.plus(&Series::constant(value.atan())))
    }

    /// Computes the modulus: the first term decides the sign.
    pub fn modulus(&mut self, a: &Series) -> Result<Series, Failure> {
        if a.terms.is_empty() {
            return Ok(a.clone());
        }
        let ((_, logs), value) = a.leading()?;
        let sign = self.sign(value, logs);
        Ok(a.scaled(sign))
    }

    /// Returns the sign of c (ln δ)^j, where ln δ is negative.
    pub(super) fn sign(&mut self, value: Expr, logs: i32) -> Expr {
        let inverse = value.recip();
        self.guard(inverse);
        let sign = value.modulus() * inverse;
        if logs % 2 == 0 { sign } else { -sign }
    }
}
