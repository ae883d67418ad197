//! Relations along an orbit that known integrals imply.
//!
//! A known integral F = P/Q with polynomials P and Q of the ring gives the relations
//! m (Q(q) P − P(q) Q) along the orbit of q, for all monomials m.

use std::collections::BTreeMap;

use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;

use super::super::super::SearchError;
use super::super::super::ansatz::system::PrimePoint;
use super::super::super::echelon::Echelon;
use super::super::setting::OrbitSetting;
use super::Extension;
use super::polynomial::{Monomial, RingPolynomial};
use super::ring::{AdjoinedRing, Atom, Of};
use crate::orbit::setting::PrimePhasePoint;

/// A known integral as a fraction of polynomials in which sines and roots are linear.
struct Fraction {
    /// Place of the integral among those given.
    place: usize,
    above: RingPolynomial,
    below: RingPolynomial,
}

/// The relations that known integrals imply along one orbit.
pub struct Implied {
    /// Number of independent ones.
    pub rank: usize,
    /// Places of the integrals that imply some, among those given.
    pub by: Vec<usize>,
}

impl Extension {
    /// Counts the combinations of some monomials that vanish along the orbit of a point since known
    /// integrals are constant there.
    pub fn implied(
        &self,
        setting: &OrbitSetting<'_>,
        at: &PrimePoint,
        point: &PrimePhasePoint,
        monomials: &[Vec<u32>],
    ) -> Result<Implied, SearchError> {
        let m = &at.modulus;
        let mut implied = Implied { rank: 0, by: Vec::new() };
        let Some(values) = self.values(m, point) else { return Ok(implied) };
        let places: BTreeMap<&[u32], usize> =
            monomials.iter().enumerate().map(|(k, own)| (own.as_slice(), k)).collect();
        let mut echelon = Echelon::new(monomials.len(), *m);
        for fraction in self.fractions() {
            let at_point = |own: &RingPolynomial| own.residue(m, &values);
            let (Some(above), Some(below)) = (at_point(&fraction.above), at_point(&fraction.below))
            else {
                continue;
            };
            for monomial in monomials {
                setting.effort.halt.check()?;
                let row = || -> Option<Vec<u64>> {
                    let factor = RingPolynomial::term(self.of_ring(monomial), Rational::from(1));
                    let mut row = vec![0; monomials.len()];
                    for (own, value) in
                        [(&fraction.above, below), (&fraction.below, m.sub(0, above))]
                    {
                        let product = self.ring.reduced(&factor.times(own)?)?;
                        for (term, coefficient) in product.terms() {
                            let (constant, own) = self.parted(term);
                            let constant = RingPolynomial::term(constant, coefficient.clone());
                            let entry = &mut row[*places.get(own.as_slice())?];
                            *entry = m.add(*entry, m.mul(value, constant.residue(m, &values)?));
                        }
                    }
                    Some(row)
                };
                let Some(row) = row() else { continue };
                if echelon.push(row) {
                    implied.rank += 1;
                    implied.by.push(fraction.place);
                }
            }
        }
        implied.by.dedup();
        Ok(implied)
    }

    /// Degree of numerator and denominator of a known integral, by its place among those given;
    /// `None` if it is not a fraction of polynomials of the class.
    pub fn degree(&self, place: usize) -> Option<u32> {
        let own = self.fractions().into_iter().find(|own| own.place == place)?;
        let class = self.class.as_ref()?;
        let mut degree = 0;
        for (term, _) in own.above.terms().chain(own.below.terms()) {
            let (_, monomial) = self.parted(term);
            degree = degree.max(monomial.iter().sum());
            class.has(&monomial).then_some(())?;
        }
        Some(degree)
    }

    /// Numerator and denominator of a known integral, by its place among those given.
    pub(super) fn sides(&self, place: usize) -> Option<[RingPolynomial; 2]> {
        let own = self.fractions().into_iter().find(|own| own.place == place)?;
        Some([own.above, own.below])
    }

    fn fractions(&self) -> Vec<Fraction> {
        let fraction = |(place, own): &(usize, RingPolynomial)| {
            let [above, below] = self.ring.cleared(own)?;
            let (above, below) = (self.ring.reduced(&above)?, self.ring.reduced(&below)?);
            Some(Fraction { place: *place, above, below })
        };
        self.read.iter().filter_map(fraction).collect()
    }

    /// Values of all variables of the ring at a point of the extended case.
    fn values(&self, m: &Modulus, point: &PrimePhasePoint) -> Option<Vec<u64>> {
        let (mut parameters, mut state) = (point.parameters.iter(), point.state.iter());
        let mut values = Vec::new();
        for atom in &self.ring.atoms {
            let value = match atom {
                Atom::Parameter | Atom::Constant(Of::Function(..)) => *parameters.next()?,
                Atom::Constant(Of::Inverse(base)) => {
                    let base = base.residue(m, &values).filter(|value| *value != 0)?;
                    m.inverse(base)
                }
                Atom::Constant(Of::Root(base)) => m.root(base.residue(m, &values)?)?,
                _ => *state.next()?,
            };
            values.push(value);
        }
        Some(values)
    }

    /// Places of the variables of the extended state in the ring.
    fn places(&self) -> impl Iterator<Item = usize> {
        (0..self.ring.atoms.len()).filter(|place| !self.ring.is_parameter(*place))
    }

    /// A monomial of the extended state as one of the ring.
    fn of_ring(&self, monomial: &[u32]) -> Monomial {
        let own = self.places().zip(monomial.iter().copied());
        own.filter(|(_, power)| *power > 0).collect()
    }

    /// Splits a monomial of the ring into functions of the parameters and one of the extended state.
    fn parted(&self, monomial: &Monomial) -> (Monomial, Vec<u32>) {
        let power = |place: usize| {
            let own = monomial.iter().find(|(variable, _)| *variable == place);
            own.map_or(0, |(_, power)| *power)
        };
        let constant = monomial.iter().filter(|(variable, _)| self.ring.is_parameter(*variable));
        (constant.copied().collect(), self.places().map(power).collect())
    }
}

impl AdjoinedRing {
    /// Whether a variable is a parameter, or a function of parameters.
    fn is_parameter(&self, place: usize) -> bool {
        matches!(self.atoms[place], Atom::Parameter | Atom::Constant(_))
    }

    /// Square of a sine or a square root, which is a polynomial in other variables.
    fn square(&self, place: usize) -> Option<RingPolynomial> {
        match &self.atoms[place] {
            Atom::Sine(_) => {
                let one = RingPolynomial::constant(Rational::from(1));
                one.plus(&RingPolynomial::variable(place + 1, 2), &Rational::from(-1))
            }
            Atom::Root(base, 2) => Some(base.clone()),
            _ => None,
        }
    }

    /// Writes squares of sines and of square roots in other variables.
    pub(super) fn reduced(&self, own: &RingPolynomial) -> Option<RingPolynomial> {
        let mut made = own.clone();
        for place in own.variables() {
            let Some(square) = self.square(place) else { continue };
            let mut next = RingPolynomial::default();
            for (term, value) in made.terms() {
                let power = term.iter().find(|(variable, _)| *variable == place);
                let power = power.map_or(0, |(_, power)| *power);
                let others = term.iter().filter(|(variable, _)| *variable != place).copied();
                let rest = RingPolynomial::term(others.collect(), value.clone());
                let rest = rest.times(&RingPolynomial::variable(place, power % 2))?;
                next = next.plus(&rest.times(&square.raised(power / 2)?)?, &Rational::from(1))?;
            }
            made = next;
        }
        Some(made)
    }

    /// Numerator and denominator of an inverse or of an exponential with negative powers.
    fn parts(&self, place: usize) -> Option<[RingPolynomial; 2]> {
        let one = RingPolynomial::constant(Rational::from(1));
        match &self.atoms[place] {
            Atom::Inverse(base, 1) => Some([one, base.clone()]),
            Atom::Inverse(..) => Some([one, RingPolynomial::variable(place - 1, 1)]),
            Atom::ExponentialOf(_, powers) => {
                let side = |sign: i64| {
                    let own = powers.iter().filter(|(_, power)| power.signum() == sign);
                    own.map(|(variable, power)| (*variable, power.unsigned_abs() as u32)).collect()
                };
                Some([1, -1].map(|sign| RingPolynomial::term(side(sign), Rational::from(1))))
            }
            _ => None,
        }
    }

    /// Writes a polynomial as a fraction without inverses.
    fn cleared(&self, own: &RingPolynomial) -> Option<[RingPolynomial; 2]> {
        let mut fraction = [own.clone(), RingPolynomial::constant(Rational::from(1))];
        // What an inverse is made of comes before it.
        for place in (0..self.atoms.len()).rev() {
            let Some([above, below]) = self.parts(place) else { continue };
            let power = |term: &Monomial| {
                let own = term.iter().find(|(variable, _)| *variable == place);
                own.map_or(0, |(_, power)| *power)
            };
            let terms = fraction.iter().flat_map(|side| side.terms());
            let highest = terms.map(|(term, _)| power(term)).max().unwrap_or(0);
            if highest == 0 {
                continue;
            }
            for side in &mut fraction {
                let mut next = RingPolynomial::default();
                for (term, value) in side.terms() {
                    let own = power(term);
                    let others = term.iter().filter(|(variable, _)| *variable != place).copied();
                    let rest = RingPolynomial::term(others.collect(), value.clone());
                    let raised = above.raised(own)?.times(&below.raised(highest - own)?)?;
                    next = next.plus(&rest.times(&raised)?, &Rational::from(1))?;
                }
                *side = next;
            }
        }
        Some(fraction)
    }
}
