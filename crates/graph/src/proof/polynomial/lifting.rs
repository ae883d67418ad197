//! Lifting of a factorisation at a point to one of the polynomial (Hensel).
//!
//! f = g h is sought by the degrees of the distances u = y − a of the other variables from the point: at
//! degree 0 stand the factors of f(x, a). Each further degree is a linear equation for the parts of g and
//! h. The leading coefficient of f is given to both factors, of l f with l for the leading coefficient. Numbers are
//! taken modulo a large prime; who asks divides.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::{One, Zero};

use crate::number::rational::Rational;

use super::modular::{Coefficients, Residues, trimmed};
use super::{Monomial, Polynomial};

/// Largest number of products of coefficients in one lifting.
const MOST_PRODUCTS: usize = 500_000;
/// Largest number of terms of a polynomial about the point.
const MOST_TERMS: usize = 3000;

/// Coefficients by powers of the main variable, of each product of powers of the others.
type Form = BTreeMap<Monomial, Coefficients>;

/// A polynomial about a point, and what is needed to lift its factors.
pub struct Lifting<'p> {
    main: u32,
    point: &'p [(u32, i64)],
    residues: Residues,
    /// Parts of l f and of l, by degree in the other variables.
    whole: Vec<Form>,
    head: Vec<Form>,
    /// Largest degree of a term of l f in all variables.
    degree: usize,
    left: usize,
}

impl<'p> Lifting<'p> {
    /// Writes a polynomial with whole coefficients about a point; `None` if it is too large.
    pub fn of(polynomial: &Polynomial, main: u32, point: &'p [(u32, i64)]) -> Option<Self> {
        let (_, head) = polynomial.by_powers(main).pop()?;
        let mut work = super::MOST_WORK;
        let whole = match head.number() {
            Some(_) => polynomial.scaled(&head.number()?),
            None => polynomial.times(&head, &mut work)?,
        };
        let whole = shifted(&whole, point, 1)?;
        let head = shifted(&head, point, 1)?;
        let bits = whole.terms.values().map(Rational::bits).max()?;
        let residues = Residues::below_power(match bits {
            0..=50 => 127,
            51..=220 => 521,
            _ => return None,
        });
        let sum = |own: &Monomial| own.0.iter().map(|(_, power)| *power as usize).sum();
        let degree: usize = whole.terms.keys().map(sum).max()?;
        let whole = parts(&whole, main, &residues)?;
        let head = parts(&head, main, &residues)?;
        Some(Self { main, point, residues, whole, head, degree, left: MOST_PRODUCTS })
    }

    /// Returns a candidate for the factor that is `first`, but for a number, at the point, where the other factor
    /// is `second`. It has the leading coefficient of the whole.
    pub fn lifted(&mut self, first: &[BigInt], second: &[BigInt]) -> Option<Polynomial> {
        let origin = Monomial::default();
        let head = self.head.first()?.get(&origin)?.first()?.clone();
        let start = |residues: &Residues, own: &[BigInt]| {
            residues.scaled(&residues.monic(&residues.reduced(own)), &head)
        };
        let (g, h) = (start(&self.residues, first), start(&self.residues, second));
        let (of_g, of_h) = (g.len().checked_sub(1)?, h.len().checked_sub(1)?);
        // s h = 1 modulo g
        let monic = [self.residues.monic(&g), self.residues.monic(&h)];
        let inverse = self.residues.inverse_modulo(&h, &monic[0])?;
        let over_head = self.residues.inverse(&head);
        let mut left: Vec<Form> = vec![[(origin.clone(), g.clone())].into()];
        let mut right: Vec<Form> = vec![[(origin, h.clone())].into()];
        for order in 1..self.whole.len() {
            let own = |degree: usize| -> Form {
                let head = self.head.get(order).into_iter().flatten();
                let at =
                    |value: &Coefficients| [vec![BigInt::zero(); degree], value.clone()].concat();
                head.map(|(monomial, value)| (monomial.clone(), at(value))).collect()
            };
            left.push(own(of_g));
            right.push(own(of_h));
            let mut rest = self.whole[order].clone();
            for k in 0..=order {
                self.subtract(&mut rest, &left[k], &right[order - k])?;
            }
            for (monomial, error) in rest {
                let error = self.residues.reduced(&error);
                if error.is_empty() {
                    continue;
                }
                if error.len() > of_g + of_h {
                    return None;
                }
                let product = self.residues.times(&error, &inverse);
                let [_, more] = self.residues.divided(&product, &monic[0]);
                let taken = self.residues.times(&more, &h);
                let [others, _] =
                    self.residues.divided(&self.residues.minus(&error, &taken), &monic[0]);
                let others = self.residues.scaled(&others, &over_head);
                // Degrees of factors add up, and each factor has at least its degree in the main variable.
                if more.len() + order > self.degree + 1 - of_h
                    || others.len() + order > self.degree + 1 - of_g
                {
                    return None;
                }
                add(&mut left[order], &monomial, &more);
                add(&mut right[order], &monomial, &others);
            }
        }
        let mut factor = Polynomial::default();
        for (monomial, coefficients) in left.iter().flatten() {
            for (power, value) in self.residues.symmetric(coefficients).into_iter().enumerate() {
                let power = u32::try_from(power).ok()?;
                let own = if power > 0 { vec![(self.main, power)] } else { Vec::new() };
                let value = Rational::from_parts(value, BigInt::one());
                if !value.is_zero() {
                    factor.add_term(monomial.times(&Monomial(own)), &value);
                }
            }
        }
        shifted(&factor, self.point, -1)
    }

    fn subtract(&mut self, rest: &mut Form, a: &Form, b: &Form) -> Option<()> {
        for (m, x) in a {
            for (n, y) in b {
                self.left = self.left.checked_sub(x.len() * y.len())?;
                let product = self.residues.times(x, y);
                let own = rest.entry(m.times(n)).or_default();
                *own = self.residues.minus(own, &product);
            }
        }
        (rest.len() <= MOST_TERMS).then_some(())
    }
}

fn add(form: &mut Form, monomial: &Monomial, more: &[BigInt]) {
    let own = form.entry(monomial.clone()).or_default();
    if own.len() < more.len() {
        own.resize(more.len(), BigInt::zero());
    }
    own.iter_mut().zip(more).for_each(|(own, more)| *own += more);
}

/// Sorts the terms by degree in all variables but the main one.
fn parts(polynomial: &Polynomial, main: u32, residues: &Residues) -> Option<Vec<Form>> {
    let mut parts: Vec<Form> = Vec::new();
    for (monomial, value) in &polynomial.terms {
        let is_main = |own: &&(u32, u32)| own.0 == main;
        let power = monomial.0.iter().find(is_main).map_or(0, |own| own.1 as usize);
        let others = monomial.0.iter().copied().filter(|own| own.0 != main).collect();
        let others = Monomial(others);
        let degree = others.0.iter().map(|own| own.1 as usize).sum();
        if parts.len() <= degree {
            parts.resize(degree + 1, Form::new());
        }
        let (above, below) = value.parts();
        if !below.is_one() {
            return None;
        }
        let mut term = vec![BigInt::zero(); power];
        term.push(above);
        add(&mut parts[degree], &others, &term);
    }
    for own in parts.iter_mut().flat_map(BTreeMap::values_mut) {
        *own = trimmed(residues.reduced(own));
    }
    Some(parts)
}

/// Writes a polynomial in the distances from a point, or back; `None` if it is too large.
fn shifted(polynomial: &Polynomial, point: &[(u32, i64)], sign: i64) -> Option<Polynomial> {
    let mut all = polynomial.clone();
    for (variable, value) in point.iter().filter(|(_, value)| *value != 0) {
        let step = Rational::from(value * sign);
        let mut next = Polynomial::default();
        for (power, own) in all.by_powers(*variable) {
            // (u + a)^n = Σ binomial(n, k) a^(n − k) u^k
            let mut factor = Rational::from(1);
            for k in (0..=power).rev() {
                let shift = Monomial(if k > 0 { vec![(*variable, k)] } else { Vec::new() });
                for (monomial, value) in &own.terms {
                    next.add_term(monomial.times(&shift), &(value * &factor));
                }
                let ratio = Rational::new(i64::from(k), i64::from(power - k) + 1);
                factor = &(&factor * &ratio) * &step;
            }
        }
        if next.size() > MOST_TERMS {
            return None;
        }
        all = next;
    }
    Some(all)
}
