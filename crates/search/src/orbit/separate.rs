//! Darboux polynomials whose coefficients depend on the parameters, told apart from others with the same
//! monomials.
//!
//! For small whole numbers as parameters the coefficients of x + a y are small fractions, and those of
//! polynomials with roots are not. Each parameter has a range of its own, so that the order of the
//! fractions is the same for all values: x − a y comes before x + a y.

use liouville::formula::Formula;
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::proof::reconstruct;

use super::super::ansatz::coefficients::Vectors;
use super::super::ansatz::system::PrimePoint;
use super::super::{Halt, SearchError};
use super::darboux::{DarbouxSearch, Terms};
use super::factor::RatedPolynomial;
use super::images;

/// Largest number of bits of numerators and denominators of coefficients.
const BITS: u64 = 24;

impl DarbouxSearch<'_, '_> {
    /// Writes the polynomials, of a number with this support, whose coefficients are fractions of the
    /// parameters.
    pub fn separate(
        &self,
        support: &[Vec<u32>],
        count: usize,
        factors: &[RatedPolynomial],
    ) -> Result<Vec<Formula>, SearchError> {
        let setting = self.setting;
        if count < 2 || setting.case.model.free_components() == 0 {
            return Ok(Vec::new());
        }
        let found = |at: &PrimePoint| -> Result<Vec<Vec<u64>>, SearchError> {
            Ok(ordered(at, support, self.candidates(at, support, factors)?.0))
        };
        let Some(at) = setting.small(0, 0) else { return Ok(Vec::new()) };
        let known = found(&at)?.len();
        let functions = setting.functions(support)?;
        let mut made = Vec::new();
        for place in 0..known {
            let make = |at: &PrimePoint| {
                let own = found(at).ok().filter(|own| own.len() == known)?;
                own.into_iter().nth(place)
            };
            let images = SmallImages { search: self, width: support.len(), make };
            let Some(coefficients) = images::coefficients(&images)? else { continue };
            made.extend(coefficients.sum(&(0..support.len()).collect::<Vec<_>>(), &functions)?);
        }
        Ok(made)
    }
}

/// Coefficients of the candidates with a support that are small fractions, by these fractions.
fn ordered(at: &PrimePoint, support: &[Vec<u32>], candidates: Vec<Terms>) -> Vec<Vec<u64>> {
    let is_small = |value: &Rational| {
        let (above, below) = value.parts();
        above.bits().max(below.bits()) <= BITS
    };
    let fractions = |own: &Terms| -> Option<Vec<Rational>> {
        let all = own.iter().map(|(_, image)| reconstruct(*image, &at.modulus).filter(is_small));
        all.collect()
    };
    let has_support = |own: &Terms| own.iter().map(|(own, _)| own).eq(support.iter());
    let own = candidates.into_iter().filter(has_support);
    let mut all: Vec<(Vec<Rational>, Vec<u64>)> = own
        .filter_map(|own| {
            Some((fractions(&own)?, own.into_iter().map(|(_, entry)| entry).collect()))
        })
        .collect();
    all.order_by(|(a, _), (b, _)| a.cmp(b));
    all.into_iter().map(|(_, own)| own).collect()
}

/// A vector by a function of parameters that are small whole numbers; an entry 1 is added at its end.
struct SmallImages<'s, 'd, 'c, F> {
    search: &'s DarbouxSearch<'d, 'c>,
    width: usize,
    make: F,
}

impl<F: Fn(&PrimePoint) -> Option<Vec<u64>>> Vectors for SmallImages<'_, '_, '_, F> {
    fn names(&self) -> &[Formula] {
        self.search.setting.coordinates()
    }

    fn halt(&self) -> &Halt {
        &self.search.setting.effort.halt
    }

    fn width(&self) -> usize {
        self.width + 1
    }

    fn takes(&self, steps: f64) -> bool {
        self.search.setting.steps.takes(steps)
    }

    fn taken(&self) -> f64 {
        self.search.setting.steps.taken()
    }

    fn image(&self, prime: u64, index: u64) -> Option<(PrimePoint, Vec<u64>)> {
        let at = self.search.setting.small(prime, index)?;
        let mut vector = (self.make)(&at)?;
        vector.push(at.modulus.one());
        Some((at, vector))
    }
}
