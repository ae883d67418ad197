//! Rates of adjoined functions, and the monomials that their relations make superfluous.

use liouville::number::rational::Rational;

use super::polynomial::{Monomial, RingPolynomial};
use super::ring::{AdjoinedRing, Atom};

impl AdjoinedRing {
    /// Monomials that a relation between functions writes in others of at most its degree; their
    /// variables are counted without parameters and functions of these.
    pub fn leading(&self) -> Vec<Monomial> {
        let is_constant = |atom: &&Atom| matches!(atom, Atom::Parameter | Atom::Constant(_));
        let shifted = |place: usize| place - self.atoms[..place].iter().filter(is_constant).count();
        let pair = |a: usize, b: usize| vec![(shifted(a), 1), (shifted(b), 1)];
        let mut all = Vec::new();
        for (place, atom) in self.atoms.iter().enumerate() {
            match atom {
                Atom::Sine(_) => all.push(vec![(shifted(place), 2)]),
                Atom::Root(base, order) => {
                    let power = |own: &Monomial| own.iter().map(|(_, power)| power).sum::<u32>();
                    if base.terms().all(|(own, _)| power(own) <= *order) {
                        all.push(vec![(shifted(place), *order)]);
                    }
                }
                Atom::Inverse(_, order) if *order > 1 => all.push(pair(place - 1, place)),
                Atom::Inverse(base, _) => {
                    if let Some((own, _)) = base.single()
                        && let [(variable, 1)] = own.as_slice()
                    {
                        all.push(pair(*variable, place));
                    }
                }
                Atom::ExponentialOf(_, powers) => {
                    if let [(variable, -1)] = powers.as_slice() {
                        all.push(pair(*variable, place));
                    }
                }
                _ => {}
            }
        }
        all
    }

    /// Rates of all variables along a motion, `state` those of the state's components.
    pub fn rates(&self, state: &[RingPolynomial]) -> Option<Vec<RingPolynomial>> {
        let mut rates: Vec<RingPolynomial> = Vec::with_capacity(self.atoms.len());
        let mut own = state.iter();
        for (place, atom) in self.atoms.iter().enumerate() {
            let slope = |of: &RingPolynomial| of.rate(|k| rates.get(k).cloned());
            let this = |power| RingPolynomial::variable(place, power);
            let rate = match atom {
                Atom::Parameter | Atom::Constant(_) => RingPolynomial::default(),
                Atom::State => own.next()?.clone(),
                Atom::Exponential(u) | Atom::ExponentialOf(u, _) => slope(u)?.times(&this(1))?,
                Atom::Sine(u) => slope(u)?.times(&RingPolynomial::variable(place + 1, 1))?,
                Atom::Cosine(u) => {
                    let sine = RingPolynomial::variable(place - 1, 1);
                    slope(u)?.times(&sine)?.times_number(&Rational::from(-1))
                }
                Atom::Root(base, order) => slope(base)?
                    .times(&RingPolynomial::variable(place + 1, order - 1))?
                    .times_number(&Rational::new(1, i64::from(*order))),
                Atom::Inverse(base, order) => slope(base)?
                    .times(&this(order + 1))?
                    .times_number(&Rational::new(-1, i64::from(*order))),
                Atom::Logarithm(base, inverse) | Atom::Arctangent(base, inverse) => {
                    slope(base)?.times(inverse)?
                }
                Atom::Power(base, exponent, inverse) => {
                    slope(base)?.times(inverse)?.times(exponent)?.times(&this(1))?
                }
            };
            rates.push(rate);
        }
        Some(rates)
    }
}
