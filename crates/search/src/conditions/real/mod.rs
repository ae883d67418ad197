//! Real zeros of polynomials in the parameters.
//!
//! ```text
//! sturm       real roots in one variable
//! signature   signs of the squares of a quadratic form
//! arithmetic  sums, products and values of polynomials
//! signs       signs that a polynomial takes
//! finite      number of real zeros of a finite set
//! ```
//!
//! A polynomial that takes both signs has as many real zeros as a hypersurface. One that does not has an
//! extremum at each of its real zeros, so that all its derivatives vanish there: with these the dimension
//! drops.

mod arithmetic;
mod finite;
mod signature;
mod signs;
mod sturm;

use std::cell::Cell;

use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::proof::ProofRng;

use super::hypersurface::{Hypersurface, PrimeTerms};
use super::ideal::{self, CommonZeros};
use super::quotient::without_common;
use crate::{Halt, SearchError};
pub use arithmetic::Terms;
use arithmetic::{contains, degree, derivative, substituted};
pub use sturm::has_real_root;

/// Largest number of times that the dimension of a set drops.
const DEPTH: usize = 6;
/// Numbers that are put in for variables to find real points of a curve.
const NUMBERS: [i64; 5] = [0, 1, -1, 2, -3];

/// Sets of equations by what is known of their real zeros; those without any are left out.
#[derive(Default)]
pub struct RealSets {
    /// Sets that have real zeros.
    pub real: Vec<Vec<Hypersurface>>,
    /// Sets of which that is not known.
    pub open: Vec<Vec<Hypersurface>>,
    /// Sets without short coefficients, by their images.
    pub unwritten: Vec<Vec<PrimeTerms>>,
}

impl RealSets {
    /// Number of sets of which it is not known whether they have real zeros.
    pub fn unknown(&self) -> usize {
        self.open.len() + self.unwritten.len()
    }
}

/// A search for real zeros of polynomials modulo a prime and their lifts.
pub struct RealSearch<'r> {
    /// Number of variables.
    pub variables: usize,
    /// Prime modulo which ideals are computed.
    pub m: Modulus,
    /// Random numbers.
    pub rng: &'r mut ProofRng,
    /// Number of elementary steps that may still be taken.
    pub left: &'r Cell<f64>,
    /// End of the search.
    pub halt: &'r Halt,
}

/// Knowledge of the real zeros of some equations.
enum Zeros {
    None,
    Some,
    /// Those where further polynomials vanish.
    Where(Vec<Terms>),
    Unknown,
}

impl RealSearch<'_> {
    /// Finds the real zeros of some equations.
    pub fn zeros(&mut self, own: &[Hypersurface]) -> Result<RealSets, SearchError> {
        let mut found = RealSets::default();
        self.divide(own, DEPTH, &mut found)?;
        Ok(found)
    }

    fn divide(
        &mut self,
        own: &[Hypersurface],
        depth: usize,
        found: &mut RealSets,
    ) -> Result<(), SearchError> {
        self.halt.check()?;
        match self.known(own)? {
            Zeros::None => {}
            Zeros::Some => found.real.push(own.to_vec()),
            Zeros::Where(further) if depth > 0 => {
                let further: Option<Vec<Hypersurface>> =
                    further.into_iter().map(Hypersurface::from_terms).collect();
                let all = own.iter().chain(further.iter().flatten());
                let images: Option<Vec<PrimeTerms>> = all.map(|own| own.images(&self.m)).collect();
                let zeros = match (images, &further) {
                    (Some(images), Some(_)) => self.common(&images)?,
                    // A constant is among the derivatives.
                    (_, None) => return Ok(()),
                    (None, _) => None,
                };
                let Some(CommonZeros { written, unwritten }) = zeros else {
                    found.open.push(own.to_vec());
                    return Ok(());
                };
                found.unwritten.extend(unwritten);
                for own in written {
                    self.divide(&own, depth - 1, found)?;
                }
            }
            Zeros::Where(_) | Zeros::Unknown => found.open.push(own.to_vec()),
        }
        Ok(())
    }

    fn common(&mut self, generators: &[PrimeTerms]) -> Result<Option<CommonZeros>, SearchError> {
        // The polynomials have a common factor where one of them has repeated ones.
        let Some((rest, common)) = without_common(generators, &self.m, self.rng) else {
            return Ok(None);
        };
        let mut all = CommonZeros::default();
        if ideal::degree(&common) > 0 {
            match Hypersurface::of(&common, &self.m) {
                Some(own) => all.written.push(vec![own]),
                None => all.unwritten.push(vec![common]),
            }
        }
        let found = ideal::zeros(&rest, self.variables, (&self.m, self.rng), self.left, self.halt)?;
        let Some(found) = found else { return Ok(None) };
        all.written.extend(found.written);
        all.unwritten.extend(found.unwritten);
        Ok(Some(all))
    }

    fn known(&mut self, own: &[Hypersurface]) -> Result<Zeros, SearchError> {
        let is_empty = |own: &Hypersurface| {
            own.univariate().is_some_and(|(_, coefficients)| !has_real_root(&coefficients))
        };
        if own.iter().any(is_empty) {
            return Ok(Zeros::None);
        }
        let all: Vec<Terms> = own.iter().map(|own| own.terms().clone()).collect();
        match finite::real_zeros(&all) {
            Some(0) => return Ok(Zeros::None),
            Some(_) => return Ok(Zeros::Some),
            None => {}
        }
        let Some(rest) = eliminated(all) else { return Ok(Zeros::None) };
        let (mut changing, mut further) = (0, Vec::new());
        for own in &rest {
            let simple = self.without_repeated(own);
            match signs::signs(&simple) {
                Some(signs) if signs.are_both() => changing += 1,
                Some(_) => {
                    further.extend((0..self.variables).map(|place| derivative(&simple, place)));
                    further.push(simple);
                }
                None => {}
            }
        }
        further.retain(|own| !own.is_empty());
        Ok(match rest.len() {
            0 => Zeros::Some,
            1 if changing == 1 => Zeros::Some,
            _ if further.iter().any(|own| degree(own) == 0) => Zeros::None,
            _ if !further.is_empty() => Zeros::Where(further),
            _ if self.has_point(own)? => Zeros::Some,
            _ => Zeros::Unknown,
        })
    }

    /// The polynomial without repeated factors, as far as these are found.
    fn without_repeated(&mut self, own: &Terms) -> Terms {
        let mut lifted = || -> Option<Hypersurface> {
            let slopes = (0..self.variables).map(|place| derivative(own, place));
            let all = [own.clone()].into_iter().chain(slopes).filter(|own| !own.is_empty());
            let all: Vec<PrimeTerms> = all
                .map(|own| own.into_iter().map(|(e, x)| Some((e, self.m.rational(&x)?))).collect())
                .collect::<Option<_>>()?;
            let (quotients, common) = without_common(&all, &self.m, self.rng)?;
            if ideal::degree(&common) == 0 {
                return None;
            }
            Hypersurface::of(quotients.first()?, &self.m)
        };
        lifted().map_or_else(|| own.clone(), |own| own.terms().clone())
    }

    /// Whether a real zero is found where some variables are numbers and finitely many zeros are left.
    fn has_point(&mut self, own: &[Hypersurface]) -> Result<bool, SearchError> {
        for shift in 0..NUMBERS.len() {
            let mut all = own.to_vec();
            for place in (0..self.variables).rev() {
                if !own.iter().any(|own| own.contains(place)) {
                    continue;
                }
                let number = NUMBERS[(shift + place) % NUMBERS.len()];
                let Some(plane) = Hypersurface::from_terms(self.plane(place, number)) else {
                    continue;
                };
                all.push(plane);
                let images: Option<Vec<PrimeTerms>> =
                    all.iter().map(|own| own.images(&self.m)).collect();
                let Some(images) = images else { return Ok(false) };
                let most = (&self.m, &mut *self.rng);
                let zeros = ideal::zeros(&images, self.variables, most, self.left, self.halt)?;
                let Some(zeros) = zeros else { return Ok(false) };
                let terms = |own: &Vec<Hypersurface>| -> Vec<Terms> {
                    own.iter().map(|own| own.terms().clone()).collect()
                };
                let count = |own: &Vec<Hypersurface>| finite::real_zeros(&terms(own));
                if zeros.written.iter().any(|own| count(own).is_some_and(|count| count > 0)) {
                    return Ok(true);
                }
                if zeros.written.is_empty() && zeros.unwritten.is_empty() {
                    // This plane misses all zeros.
                    all.pop();
                }
            }
        }
        Ok(false)
    }

    /// x − n.
    fn plane(&self, place: usize, number: i64) -> Terms {
        let unit = (0..self.variables).map(|k| u32::from(k == place)).collect();
        let all = [(unit, Rational::from(1)), (vec![0; self.variables], Rational::from(-number))];
        all.into_iter().filter(|(_, value)| !value.is_zero()).collect()
    }
}

/// Puts in variables that equations give as polynomials of the others; `None` if a constant other than 0
/// remains, so that there are no zeros.
fn eliminated(mut all: Vec<Terms>) -> Option<Vec<Terms>> {
    loop {
        all.retain(|own| !own.is_empty());
        if all.iter().any(|own| degree(own) == 0) {
            return None;
        }
        let solved = all.iter().enumerate().find_map(|(row, own)| {
            let count = own.first()?.0.len();
            let place = (0..count).find(|place| {
                let mut with = own.iter().filter(|(exponents, _)| exponents[*place] > 0);
                with.next().is_some_and(|(own, _)| own.iter().sum::<u32>() == 1)
                    && with.next().is_none()
            })?;
            Some((row, place))
        });
        let Some((row, place)) = solved else { return Some(all) };
        let own = all.remove(row);
        let (with, without): (Terms, Terms) =
            own.into_iter().partition(|(exponents, _)| exponents[place] > 0);
        let scale = with.first().and_then(|(_, value)| value.recip())?;
        let value: Terms = without.into_iter().map(|(own, x)| (own, -&(&x * &scale))).collect();
        for own in all.iter_mut().filter(|own| contains(own, place)) {
            *own = substituted(own, place, &value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::ideal::zeros;
    use super::super::relation::ScalarParameter;
    use super::*;

    type Given<'t> = &'t [(&'t [u32], i64)];

    /// Sets with real zeros among the common zeros of polynomials in a, b, c, and the number of unknown ones.
    fn of(all: &[Given<'_>]) -> (Vec<String>, usize) {
        let mut rng = ProofRng::new(3, 0);
        let m = rng.prime(&[], &[]);
        let (left, halt) = (Cell::new(1e9), Halt::default());
        let surface = |own: &Given<'_>| {
            let terms = own.iter().map(|(e, value)| (e.to_vec(), Rational::from(*value)));
            Hypersurface::from_terms(terms.collect()).expect("not constant")
        };
        let images: Vec<PrimeTerms> =
            all.iter().map(|own| surface(own).images(&m).expect("images")).collect();
        let sets = zeros(&images, 3, (&m, &mut rng), &left, &halt).expect("not stopped");
        let (mut texts, mut unknown) = (Vec::new(), 0);
        let names: Vec<ScalarParameter> = ["a", "b", "c"]
            .iter()
            .enumerate()
            .map(|(draw, name)| ScalarParameter { name: name.to_string(), draw })
            .collect();
        for own in sets.expect("low degrees").written {
            let mut search =
                RealSearch { variables: 3, m, rng: &mut rng, left: &left, halt: &halt };
            let found = search.zeros(&own).expect("not stopped");
            unknown += found.unknown();
            for set in found.real {
                let equations: Vec<String> = set.iter().map(|own| own.equation(&names)).collect();
                texts.push(equations.join(" and "));
            }
        }
        texts.sort();
        (texts, unknown)
    }

    #[test]
    fn dimensions_drop_where_a_polynomial_has_an_extremum() {
        // (a − c)² + (b − c)², alone and with (c − 1)(c − 2).
        let squares: Given<'_> = &[
            (&[2, 0, 0], 1),
            (&[1, 0, 1], -2),
            (&[0, 2, 0], 1),
            (&[0, 1, 1], -2),
            (&[0, 0, 2], 2),
        ];
        assert_eq!(of(&[squares]), (vec!["a = c and b = c".to_string()], 0));
        let planes: Given<'_> = &[(&[0, 0, 2], 1), (&[0, 0, 1], -3), (&[0, 0, 0], 2)];
        let points = ["a = 1 and b = 1 and c = 1", "a = 2 and b = 2 and c = 2"];
        assert_eq!(of(&[squares, planes]), (points.map(str::to_string).to_vec(), 0));
        // A curve without real points, and one with some.
        let curve = |last: i64| {
            let own: Vec<(Vec<u32>, i64)> = vec![
                (vec![2, 0, 0], 1),
                (vec![0, 2, 0], 1),
                (vec![0, 0, 2], 1),
                (vec![0, 0, 0], last),
            ];
            let own: Vec<(&[u32], i64)> = own.iter().map(|(e, x)| (e.as_slice(), *x)).collect();
            let cone: Given<'_> = &[(&[1, 1, 0], 1), (&[0, 0, 2], -1)];
            of(&[&own, cone])
        };
        assert_eq!(curve(1), (Vec::new(), 0));
        assert_eq!((curve(-3).0.len(), curve(-3).1), (1, 0));
    }
}
