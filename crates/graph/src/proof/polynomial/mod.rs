//! Sparse polynomials with rational coefficients, for square roots of radicands.
//!
//! A graph is read as a quotient of polynomials in its inputs and in further variables (other
//! roots, symbols). Large ones are given up: the aim is to find b in √(x² + 2x + 1) = |x + 1|, not
//! a normal form.

mod binomial;
mod bound;
mod definite;
mod divisors;
mod fraction;
mod irreducible;
mod lifting;
mod linear;
mod modular;
mod monomial;
mod span;
mod whole;

#[cfg(test)]
mod tests;

pub use fraction::{Fraction, fraction, fraction_of};
pub use span::Span;

use std::collections::BTreeMap;

use crate::graph::Expr;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use monomial::Monomial;

/// Largest number of terms of a polynomial.
const MOST_TERMS: usize = 400;
/// Largest number of products of terms in reading one graph.
pub const MOST_WORK: usize = 400_000;
/// Largest size in bits of a coefficient.
const MOST_BITS: u64 = 2048;

/// A polynomial with rational coefficients, none of them 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polynomial {
    terms: BTreeMap<Monomial, Rational>,
}

impl Polynomial {
    /// Makes a constant polynomial.
    pub fn constant(value: &Rational) -> Self {
        let mut polynomial = Self::default();
        polynomial.add_term(Monomial::default(), value);
        polynomial
    }

    /// Makes a variable.
    pub fn variable(number: u32) -> Self {
        Self { terms: [(Monomial(vec![(number, 1)]), Rational::from(1))].into() }
    }

    /// Makes a number times a product of powers of variables.
    pub fn of_term(value: &Rational, exponents: impl IntoIterator<Item = (u32, u32)>) -> Self {
        let mut term = Self::default();
        term.add_term(Monomial(exponents.into_iter().collect()), value);
        term
    }

    /// Returns the product of powers of variables that divides all terms.
    pub fn common_term(&self) -> Self {
        let mut keys = self.terms.keys();
        let mut common = keys.next().cloned().unwrap_or_default();
        keys.for_each(|own| common = common.common(own));
        Self { terms: [(common, Rational::from(1))].into() }
    }

    /// Divides by a product of powers of variables, if it divides all terms.
    pub fn over_term(&self, divisor: &Self) -> Option<Self> {
        let (divisor, _) = divisor.leading()?;
        let terms = self.terms.iter().map(|(own, value)| Some((own.over(divisor)?, value.clone())));
        Some(Self { terms: terms.collect::<Option<_>>()? })
    }

    /// Returns the number and the exponents of a polynomial of one term.
    pub fn as_term(&self) -> Option<(&Rational, &[(u32, u32)])> {
        let ((monomial, value), 1) = (self.leading()?, self.size()) else { return None };
        Some((value, &monomial.0))
    }

    /// Returns the value of a constant polynomial.
    pub fn number(&self) -> Option<Rational> {
        match self.leading() {
            None => Some(Rational::from(0)),
            Some((monomial, value)) => monomial.0.is_empty().then(|| value.clone()),
        }
    }

    /// Returns the terms, each as a number and the exponents of the variables.
    pub fn terms(&self) -> impl DoubleEndedIterator<Item = (&Rational, &[(u32, u32)])> {
        self.terms.iter().map(|(monomial, value)| (value, &monomial.0[..]))
    }

    /// Number of terms.
    pub fn size(&self) -> usize {
        self.terms.len()
    }

    /// Whether the polynomial is 0.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    fn add_term(&mut self, monomial: Monomial, coefficient: &Rational) {
        let sum = match self.terms.get(&monomial) {
            Some(own) => own + coefficient,
            None => coefficient.clone(),
        };
        if sum.is_zero() {
            self.terms.remove(&monomial);
        } else {
            self.terms.insert(monomial, sum);
        }
    }

    /// Computes p + q.
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        other.terms.iter().for_each(|(monomial, value)| sum.add_term(monomial.clone(), value));
        sum
    }

    /// Computes c p.
    pub fn scaled(&self, factor: &Rational) -> Self {
        let scaled = |(monomial, value): (&Monomial, &Rational)| (monomial.clone(), value * factor);
        let terms = self.terms.iter().map(scaled);
        Self { terms: terms.filter(|(_, value)| !value.is_zero()).collect() }
    }

    /// Computes p q; `None` if it is too large.
    pub fn times(&self, other: &Self, work: &mut usize) -> Option<Self> {
        *work = work.checked_sub(self.terms.len() * other.terms.len())?;
        let mut product = Self::default();
        for (a, x) in &self.terms {
            for (b, y) in &other.terms {
                product.add_term(a.times(b), &(x * y));
            }
        }
        product.checked()
    }

    fn checked(self) -> Option<Self> {
        let fits = self.terms.len() <= MOST_TERMS
            && self.terms.values().all(|value| value.bits() <= MOST_BITS);
        fits.then_some(self)
    }

    fn leading(&self) -> Option<(&Monomial, &Rational)> {
        self.terms.last_key_value()
    }

    /// Returns c and a monic b with p = c b².
    pub fn square(&self) -> Option<(Rational, Self)> {
        let (monomial, scale) = self.leading()?;
        let head = monomial.root()?;
        let target = self.scaled(&scale.recip()?);
        let mut root = Self { terms: [(head.clone(), Rational::from(1))].into() };
        let mut rest = target.plus(&root.times(&root, &mut { MOST_WORK })?.negated());
        let half = Rational::new(1, 2);
        // Each step removes the leading term of the rest, with the next term of the root.
        for _ in 0..MOST_TERMS {
            let Some((monomial, value)) = rest.leading() else {
                return Some((scale.clone(), root));
            };
            let next = monomial.over(&head)?;
            if next >= head {
                return None;
            }
            let term = Self { terms: [(next, value * &half)].into() };
            // (b + t)² = b² + (2b + t) t
            let doubled = root.scaled(&Rational::from(2)).plus(&term);
            rest = rest.plus(&doubled.times(&term, &mut { MOST_WORK })?.negated());
            root = root.plus(&term);
        }
        None
    }

    fn negated(&self) -> Self {
        self.scaled(&Rational::from(-1))
    }

    /// Returns p₀ and p₁ with p = p₀ + p₁ y for the variable y, whose square is `square`.
    pub fn split(&self, variable: u32, square: &Self) -> Option<[Self; 2]> {
        let mut parts = [Self::default(), Self::default()];
        let mut work = MOST_WORK;
        for (monomial, value) in &self.terms {
            let exponent = monomial.0.iter().find(|(v, _)| *v == variable).map_or(0, |(_, e)| *e);
            let without = monomial.0.iter().copied().filter(|(v, _)| *v != variable).collect();
            let mut term = Self { terms: [(Monomial(without), value.clone())].into() };
            for _ in 0..exponent / 2 {
                term = term.times(square, &mut work)?;
            }
            let part = &mut parts[exponent as usize % 2];
            *part = part.plus(&term);
        }
        let [even, odd] = parts;
        Some([even.checked()?, odd.checked()?])
    }

    /// Returns the variables that occur.
    pub fn variables(&self) -> Vec<u32> {
        let mut all: Vec<u32> =
            self.terms.keys().flat_map(|monomial| monomial.0.iter().map(|(v, _)| *v)).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Returns the coefficients of the products of powers of some variables.
    pub fn collected(&self, variables: &[u32]) -> BTreeMap<Vec<u32>, Self> {
        let mut all: BTreeMap<Vec<u32>, Self> = BTreeMap::new();
        for (monomial, value) in &self.terms {
            let mut powers = vec![0; variables.len()];
            let mut rest = Vec::new();
            for (variable, exponent) in &monomial.0 {
                match variables.iter().position(|own| own == variable) {
                    Some(place) => powers[place] = *exponent,
                    None => rest.push((*variable, *exponent)),
                }
            }
            all.entry(powers).or_default().add_term(Monomial(rest), value);
        }
        all
    }

    /// Writes the polynomial with names of the variables.
    pub fn text(&self, names: &[String]) -> String {
        let power = |(variable, exponent): &(u32, u32)| {
            let name = &names[*variable as usize];
            if *exponent == 1 { name.clone() } else { format!("{name}^{exponent}") }
        };
        let term = |(monomial, value): (&Monomial, &Rational)| {
            let mut factors: Vec<String> = monomial.0.iter().map(power).collect();
            if factors.is_empty() || !value.abs().is_one() {
                factors.insert(0, value.to_string());
                return factors.join("*");
            }
            let sign = if value.is_negative() { "-" } else { "" };
            format!("{sign}{}", factors.join("*"))
        };
        let terms: Vec<String> = self.terms.iter().rev().map(term).collect();
        if terms.is_empty() { "0".to_string() } else { terms.join(" + ") }
    }

    /// Records the value from the values of the variables.
    pub fn value(&self, of: &impl Fn(u32) -> Option<Expr>) -> Option<Expr> {
        let mut sum = Expr::rational(&Rational::from(0));
        for (monomial, coefficient) in self.terms.iter().rev() {
            let mut term = Expr::rational(coefficient);
            for (variable, exponent) in &monomial.0 {
                term *= of(*variable)?.power(&Rational::from(i64::from(*exponent)));
            }
            sum += term;
        }
        Some(sum)
    }
}
