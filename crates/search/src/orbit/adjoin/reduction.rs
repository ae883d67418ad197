//! Normal form of polynomials on circles, and where 1/x is the inverse of x.

use liouville::number::rational::Rational;

use super::atom::Atom;
use super::polynomial::{Monomial, RingPolynomial};

/// Polynomials modulo the relations of sines, cosines and inverses of single variables.
pub struct Reduction {
    /// Variable whose square is replaced, and the other one of the circle.
    circles: Vec<(usize, usize)>,
    /// Variable x and the variable 1/x.
    inverses: Vec<(usize, usize)>,
}

impl Reduction {
    /// Takes the relations of the variables of a ring: sin² becomes 1 − cos² if `of_sines`, and cos² 1 − sin² otherwise.
    pub fn of(atoms: &[Atom], of_sines: bool) -> Self {
        let (mut circles, mut inverses) = (Vec::new(), Vec::new());
        for (place, atom) in atoms.iter().enumerate() {
            match atom {
                Atom::Sine(_) if of_sines => circles.push((place, place + 1)),
                Atom::Sine(_) => circles.push((place + 1, place)),
                Atom::Inverse(base, 1) => {
                    if let Some((monomial, value)) = base.single()
                        && let [(variable, 1)] = monomial[..]
                        && value.is_one()
                    {
                        inverses.push((variable, place));
                    }
                }
                _ => {}
            }
        }
        Self { circles, inverses }
    }

    /// The normal form of a polynomial; `None` if it is too long.
    pub fn reduced(&self, own: &RingPolynomial) -> Option<RingPolynomial> {
        let one = Rational::from(1);
        let mut rest = own.clone();
        loop {
            let found = rest.terms().find_map(|(monomial, value)| {
                Some((monomial.clone(), value.clone(), self.replacement(monomial)?))
            });
            let Some((monomial, value, replaced)) = found else { return Some(rest) };
            let removed = RingPolynomial::term(monomial, &Rational::from(0) - &value);
            rest = rest.plus(&removed, &one)?.plus(&replaced?, &value)?;
        }
    }

    /// The polynomial in place of a monomial that is not in normal form; inside, `None` if it cannot be written.
    fn replacement(&self, monomial: &Monomial) -> Option<Option<RingPolynomial>> {
        let power = |variable: usize| {
            monomial.iter().find(|(own, _)| *own == variable).map_or(0, |(_, power)| *power)
        };
        let less = |removed: &[(usize, u32)]| -> RingPolynomial {
            let lower = |(variable, power): &(usize, u32)| {
                let taken = removed.iter().find(|(own, _)| own == variable);
                (*variable, power - taken.map_or(0, |(_, taken)| *taken))
            };
            let own = monomial.iter().map(lower).filter(|(_, power)| *power > 0).collect();
            RingPolynomial::term(own, Rational::from(1))
        };
        if let Some((x, inverse)) =
            self.inverses.iter().find(|(x, inverse)| power(*x).min(power(*inverse)) > 0)
        {
            let common = power(*x).min(power(*inverse));
            return Some(Some(less(&[(*x, common), (*inverse, common)])));
        }
        let (square, other) = self.circles.iter().find(|(square, _)| power(*square) > 1)?;
        let one = RingPolynomial::constant(Rational::from(1));
        let made = one
            .plus(&RingPolynomial::variable(*other, 2), &Rational::from(-1))
            .and_then(|own| own.times(&less(&[(*square, 2)])));
        Some(made)
    }

    /// The normal form of a product.
    pub fn product(&self, a: &RingPolynomial, b: &RingPolynomial) -> Option<RingPolynomial> {
        self.reduced(&a.times(b)?)
    }

    /// The normal form of Σ a_k b_k.
    pub fn dot<'a>(
        &self,
        a: impl IntoIterator<Item = &'a RingPolynomial>,
        b: impl IntoIterator<Item = &'a RingPolynomial>,
    ) -> Option<RingPolynomial> {
        let one = Rational::from(1);
        let pairs = a.into_iter().zip(b).filter(|(a, b)| !a.is_zero() && !b.is_zero());
        let mut sum = RingPolynomial::default();
        for (a, b) in pairs {
            sum = sum.plus(&self.product(a, b)?, &one)?;
        }
        Some(sum)
    }
}

/// A polynomial with others in place of some variables.
pub fn substituted(
    own: &RingPolynomial,
    given: &[(usize, RingPolynomial)],
) -> Option<RingPolynomial> {
    let mut sum = RingPolynomial::default();
    for (monomial, value) in own.terms() {
        let mut made = RingPolynomial::constant(value.clone());
        for (variable, power) in monomial {
            let factor = match given.iter().find(|(place, _)| place == variable) {
                Some((_, other)) => other.raised(*power)?,
                None => RingPolynomial::variable(*variable, *power),
            };
            made = made.times(&factor)?;
        }
        sum = sum.plus(&made, &Rational::from(1))?;
    }
    Some(sum)
}
