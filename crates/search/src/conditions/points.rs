//! Points modulo a prime where some equations between the parameters hold.
//!
//! A value modulo a prime at one of them is the image of a value at the algebraic numbers that it reduces: no
//! denominator is 0 there. Over the rational numbers the points of a set that is not divided are conjugate, so
//! that a field has values at all of them or at none.

use liouville::number::prime::{Modulus, PrimePolynomials};
use liouville::proof::ProofRng;

use super::bounded_ideal::BoundedIdeal;
use super::hypersurface::{Hypersurface, PrimeTerms};
use super::ideal::{degree, highest, used};
use crate::{Halt, SearchError};

/// Number of random values that are tried for a variable.
const TRIALS: usize = 6;

/// Largest number of points.
const MOST: usize = 32;
/// Number of primes from which points are taken, and the largest number that is tried.
const PRIMES: (usize, u64) = (4, 16);

/// Finds the points where equations hold, one for each value of variables that are free.
fn points(
    equations: &[Hypersurface],
    variables: usize,
    (m, rng): (&Modulus, &mut ProofRng),
    halt: &Halt,
) -> Result<Vec<Vec<u64>>, SearchError> {
    let images: Option<Vec<PrimeTerms>> = equations.iter().map(|own| own.images(m)).collect();
    let Some(images) = images else { return Ok(Vec::new()) };
    let mut search = PointSearch { variables, m: *m, rng, halt, found: Vec::new() };
    search.with(images, &mut Vec::new())?;
    Ok(search.found)
}

/// Makes the prime with a number, what belongs to it, and random numbers; `None` if there is none.
type NextPrime<'p, P> =
    &'p mut dyn FnMut(u64) -> Result<Option<(P, Modulus, ProofRng)>, SearchError>;
/// Tells whether something holds at a point modulo a prime.
type AtPoint<'p, P> = &'p mut dyn FnMut(&mut P, &[u64]) -> Result<Option<bool>, SearchError>;

/// Asks whether something holds at the points of some primes where equations hold; `None` if no point is found,
/// if that is not known of one, or if it holds at some of them only.
///
/// `prime` makes a prime with random numbers, and `holds` is asked at a point modulo it.
pub fn at_points<P>(
    equations: &[Hypersurface],
    variables: usize,
    prime: NextPrime<'_, P>,
    holds: AtPoint<'_, P>,
    halt: &Halt,
) -> Result<Option<bool>, SearchError> {
    let (mut all, mut primes) = (Vec::new(), 0);
    for number in 1..=PRIMES.1 {
        if primes == PRIMES.0 {
            break;
        }
        let Some((mut own, m, mut rng)) = prime(number)? else { continue };
        let found = points(equations, variables, (&m, &mut rng), halt)?;
        primes += usize::from(!found.is_empty());
        for point in found {
            all.push(holds(&mut own, &point)?);
        }
    }
    let first = all.first().copied().flatten();
    Ok(first.filter(|_| all.iter().all(|own| *own == first)))
}

struct PointSearch<'p> {
    variables: usize,
    m: Modulus,
    rng: &'p mut ProofRng,
    halt: &'p Halt,
    found: Vec<Vec<u64>>,
}

impl PointSearch<'_> {
    /// Extends the values of the first variables.
    fn with(
        &mut self,
        generators: Vec<PrimeTerms>,
        known: &mut Vec<u64>,
    ) -> Result<(), SearchError> {
        self.halt.check()?;
        let place = known.len();
        if generators.iter().any(|own| !own.is_empty() && degree(own) == 0) {
            return Ok(());
        }
        if place == self.variables {
            self.found.push(known.clone());
            return Ok(());
        }
        let (values, is_free) = match self.univariate(&generators, place)? {
            Some(Some(own)) => (PrimePolynomials(self.m).roots(&own), false),
            Some(None) => ((0..TRIALS).map(|_| self.rng.element(&self.m)).collect(), true),
            None => return Ok(()),
        };
        let before = self.found.len();
        for value in values {
            let own = generators.iter().map(|own| self.put_in(own, place, value)).collect();
            known.push(value);
            self.with(own, known)?;
            known.pop();
            if self.found.len() >= MOST || is_free && self.found.len() > before {
                break;
            }
        }
        Ok(())
    }

    /// The polynomial in one variable alone; the outer `None` if there are no zeros.
    fn univariate(
        &self,
        generators: &[PrimeTerms],
        place: usize,
    ) -> Result<Option<Option<Vec<u64>>>, SearchError> {
        let own = generators.iter().map(degree).max().unwrap_or(0);
        let largest = highest(self.variables).unwrap_or(own);
        for most in [(2 * own).max(own + 2).min(largest), largest] {
            let ideal = BoundedIdeal::of(generators, self.variables, most, self.m, self.halt)?;
            let Some(ideal) = ideal else { return Ok(Some(None)) };
            if ideal.is_everything() {
                return Ok(None);
            }
            let found = ideal.univariate(place);
            // Powers up to a higher degree are needed where there are many points.
            if found.is_some() || !ideal.is_finite(&used(generators, self.variables)) {
                return Ok(Some(found));
            }
        }
        Ok(Some(None))
    }

    /// A polynomial with a value in place of a variable.
    fn put_in(&self, own: &PrimeTerms, place: usize, value: u64) -> PrimeTerms {
        let m = &self.m;
        let mut all = PrimeTerms::new();
        for (exponents, image) in own {
            let mut rest = exponents.clone();
            let power = std::mem::take(&mut rest[place]);
            let image = m.mul(*image, m.power(value, u64::from(power)));
            match all.iter_mut().find(|(known, _)| *known == rest) {
                Some((_, sum)) => *sum = m.add(*sum, image),
                None => all.push((rest, image)),
            }
        }
        all.retain(|(_, image)| *image != 0);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::number::rational::Rational;

    #[test]
    fn points_satisfy_the_equations() {
        let mut rng = ProofRng::new(5, 0);
        let m = rng.prime(&[], &[]);
        let of = |terms: &[(&[u32], i64)]| {
            let terms = terms.iter().map(|(own, value)| (own.to_vec(), Rational::from(*value)));
            Hypersurface::from_terms(terms.collect()).expect("not constant")
        };
        let mut found = |own: &[Hypersurface]| {
            points(own, 2, (&m, &mut rng), &Halt::default()).expect("not stopped")
        };
        let values =
            |own: [i64; 2]| own.map(|x| m.rational(&x.into()).expect("an integer")).to_vec();
        let line = of(&[(&[1, 0], 1), (&[0, 1], -1)]);
        assert_eq!(found(&[of(&[(&[1, 0], 1), (&[0, 0], 3)]), line.clone()]), [values([-3, -3])]);
        let on_line = found(std::slice::from_ref(&line));
        assert!(on_line.len() == 1 && on_line[0][0] == on_line[0][1], "{on_line:?}");
        // b³ = a and a b = 16: b = ±2 modulo the prime, and no other root if −1 is no square.
        let curve = of(&[(&[0, 3], 1), (&[1, 0], -1)]);
        let other = of(&[(&[1, 1], 1), (&[0, 0], -16)]);
        let own = found(&[curve, other]);
        assert!(own.contains(&values([8, 2])) && own.contains(&values([-8, -2])), "{own:?}");
        assert_eq!(own.len(), 2);
        let nowhere = [of(&[(&[1, 0], 1)]), of(&[(&[1, 0], 1), (&[0, 0], 1)])];
        assert!(found(&nowhere).is_empty());
    }
}
