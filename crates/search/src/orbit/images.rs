//! Vectors that are computed anew for each choice of the parameters, within limits.

use crate::echelon::nonzero;
use std::cell::RefCell;

use liouville::formula::{Formula, FormulaResult};
use liouville::number::rational::Rational;
use num_traits::ToPrimitive;

use super::super::ansatz::Coordinates;
use super::super::ansatz::coefficients::{PrimitiveVector, Vectors, has_products};
use super::super::ansatz::system::PrimePoint;
use super::super::terms::{is_one, numeric_exponent};
use super::super::{Halt, SearchError};
use super::setting::OrbitSetting;

/// Largest number of choices of the parameters for one vector.
const MOST_CHOICES: usize = 256;
/// Number of choices for one vector, however many steps they take.
const FEW_CHOICES: usize = 32;
/// Largest number of steps for more choices.
const STEPS: f64 = 1e9;
/// Number of entries of a vector that are tried as 1.
const MOST_UNITS: usize = 4;
/// Number of choices of the parameters tried until one has the vector.
const TRIES: u64 = 8;

/// A vector by a function of the parameters; an entry 1 is added at its end.
pub struct Images<'s, 'c, F> {
    /// Case with its points.
    pub setting: &'s OrbitSetting<'c>,
    /// Number of entries without the last.
    pub width: usize,
    /// Whether the fields have the roots of small integers.
    pub is_split: bool,
    /// Computes the vector.
    pub make: F,
}

impl<F: Fn(&PrimePoint) -> Option<Vec<u64>>> Vectors for Images<'_, '_, F> {
    fn names(&self) -> &[Formula] {
        self.setting.coordinates()
    }

    fn halt(&self) -> &Halt {
        &self.setting.effort.halt
    }

    fn width(&self) -> usize {
        self.width + 1
    }

    fn takes(&self, steps: f64) -> bool {
        self.setting.steps.takes(steps)
    }

    fn taken(&self) -> f64 {
        self.setting.steps.taken()
    }

    fn image(&self, prime: u64, index: u64) -> Option<(PrimePoint, Vec<u64>)> {
        let at = match self.is_split {
            true => self.setting.split(prime, index)?,
            false => self.setting.at(prime, index)?,
        };
        let mut vector = (self.make)(&at).filter(|own| own.len() == self.width)?;
        vector.push(at.modulus.one());
        Some((at, vector))
    }
}

/// The entries of a vector that are not 0, one of them 1; its images end with the time of the search,
/// or after a number.
struct Limited<'v> {
    source: &'v dyn Vectors,
    support: Vec<usize>,
    /// Place in the support of the entry that is 1.
    unit: usize,
    multiplies_roots: bool,
    images: &'v RefCell<Vec<Image>>,
    /// Number of steps that had been taken before the first image.
    before: f64,
}

/// Prime and number of a choice of the parameters, and the vector there if there is one.
type Image = ((u64, u64), Option<(PrimePoint, Vec<u64>)>);

impl Limited<'_> {
    /// Computes an image, or takes a known one; `None` after the last.
    fn own(&self, prime: u64, index: u64) -> Option<(PrimePoint, Vec<u64>)> {
        let mut images = self.images.borrow_mut();
        if let Some((_, known)) = images.iter().find(|(own, _)| *own == (prime, index)) {
            return known.clone();
        }
        let is_long = self.source.taken() - self.before > STEPS;
        let most = if is_long { FEW_CHOICES } else { MOST_CHOICES };
        if images.len() >= most || !self.takes(0.0) {
            return None;
        }
        self.halt().check().ok()?;
        let made = self.source.image(prime, index);
        images.push(((prime, index), made.clone()));
        made
    }
}

impl Vectors for Limited<'_> {
    fn names(&self) -> &[Formula] {
        self.source.names()
    }

    fn halt(&self) -> &Halt {
        self.source.halt()
    }

    fn width(&self) -> usize {
        self.support.len()
    }

    fn takes(&self, steps: f64) -> bool {
        self.source.takes(steps)
    }

    fn multiplies_roots(&self) -> bool {
        self.multiplies_roots
    }

    fn image(&self, prime: u64, index: u64) -> Option<(PrimePoint, Vec<u64>)> {
        let (at, vector) = self.own(prime, index)?;
        let m = at.modulus;
        let unit = vector[self.support[self.unit]];
        let scale = (unit != 0).then(|| m.inverse(unit))?;
        let scaled = self.support.iter().map(|k| m.mul(vector[*k], scale)).collect();
        Some((at, scaled))
    }
}

/// Finds the vector for all values of the parameters; `None` if its entries are not fractions of low
/// degree in them, whichever of them is 1.
pub fn coefficients(source: &dyn Vectors) -> Result<Option<PrimitiveVector>, SearchError> {
    let mut first = (0..TRIES).filter(|_| source.halt().check().is_ok());
    let Some((_, vector)) = first.find_map(|index| source.image(0, index)) else {
        source.halt().check()?;
        return Ok(None);
    };
    let support = nonzero(&vector);
    let (images, before) = (RefCell::default(), source.taken());
    let roots = source.names().iter().filter(|name| Coordinates::is_root(name)).count();
    let units = || (0..support.len()).rev().take(MOST_UNITS);
    let with_products = units().filter(|_| has_products(roots)).map(|unit| (unit, true));
    // A common factor with the entry that is 1 lowers the degrees of the others, and numbers without
    // products of roots are shorter.
    for (unit, multiplies_roots) in units().map(|unit| (unit, false)).chain(with_products) {
        let own = support.clone();
        let images = &images;
        let limited = Limited { source, support: own, unit, multiplies_roots, images, before };
        let Some(mut found) = PrimitiveVector::through(&limited)? else { continue };
        let mut own = support.into_iter().zip(std::mem::take(&mut found.polynomials)).peekable();
        let next =
            |k| own.next_if(|(place, _)| *place == k).map(|(_, one)| one).unwrap_or_default();
        found.polynomials = (0..vector.len()).map(next).collect();
        return Ok(Some(found));
    }
    Ok(None)
}

/// A vector found for all values of the parameters, over a common denominator.
pub struct ParametricVector {
    /// Numerators, and the denominator as the last.
    pub coefficients: PrimitiveVector,
    width: usize,
}

/// Finds a vector for all values of the parameters, with its denominator.
pub fn vector<F: Fn(&PrimePoint) -> Option<Vec<u64>>>(
    source: &Images<'_, '_, F>,
) -> Result<Option<ParametricVector>, SearchError> {
    let found = coefficients(source)?;
    Ok(found.map(|coefficients| ParametricVector { coefficients, width: source.width }))
}

impl ParametricVector {
    /// Common denominator.
    pub fn below(&self) -> FormulaResult {
        self.coefficients.formula(self.width)
    }

    /// Entry as an exponent.
    pub fn exponent(&self, place: usize) -> FormulaResult {
        if let Some(value) = self.number(place) {
            return numeric_exponent(value);
        }
        let (above, below) = (self.coefficients.formula(place)?, self.below()?);
        match is_one(&below) {
            true => Ok(above),
            false => above / &below,
        }
    }

    /// Entry with the other sign, without the denominator.
    pub fn minus(&self, place: usize) -> FormulaResult {
        Ok(-self.coefficients.formula(place)?)
    }

    /// Whether an entry is a number.
    pub fn is_number(&self, place: usize) -> bool {
        self.number(place).is_some()
    }

    /// Whether an entry is a whole number.
    pub fn is_whole(&self, place: usize) -> bool {
        self.number(place).is_some_and(|value| value.parts().1 == 1.into())
    }

    /// Entry that is a number, 0 among them.
    pub fn entry(&self, place: usize) -> Option<Rational> {
        match self.coefficients.polynomials[place].is_empty() {
            true => Some(Rational::from(0)),
            false => self.number(place),
        }
    }

    /// Entry that is a number other than 0: the ratio of two multiples of one polynomial.
    pub fn number(&self, place: usize) -> Option<Rational> {
        let all = &self.coefficients.polynomials;
        let (above, below) = (&all[place], &all[self.width]);
        let ((_, first), (_, last)) = (above.first()?, below.first()?);
        let same = above.len() == below.len()
            && above.iter().zip(below).all(|((a, x), (b, y))| a == b && x * last == first * y);
        same.then(|| Some(Rational::new(first.to_i64()?, last.to_i64()?)))?
    }
}
