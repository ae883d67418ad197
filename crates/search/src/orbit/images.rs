//! Vectors that are computed anew for each choice of the parameters, within limits.

use std::cell::Cell;

use liouville::formula::{Composed, Formula};
use liouville::number::rational::Rational;
use num_traits::ToPrimitive;

use super::super::Halt;
use super::super::ansatz::coefficients::{Coefficients, Vectors};
use super::super::ansatz::system::At;
use super::super::terms::{is_one, numeric_exponent};
use super::setting::Setting;

/// Largest number of choices of the parameters for one vector.
const MOST: usize = 96;
/// Number of choices of the parameters tried until one has the vector.
const TRIES: u64 = 8;

/// A vector by a function of the parameters; an entry 1 is added at its end.
pub struct Images<'s, 'c, F> {
    /// Case with its points.
    pub setting: &'s Setting<'c>,
    /// Number of entries without the last.
    pub width: usize,
    /// Whether the fields have the roots of small integers.
    pub is_split: bool,
    /// Computes the vector.
    pub make: F,
}

impl<F: Fn(&At) -> Option<Vec<u64>>> Vectors for Images<'_, '_, F> {
    fn names(&self) -> &[Formula] {
        self.setting.coordinates()
    }

    fn width(&self) -> usize {
        self.width + 1
    }

    fn image(&self, prime: u64, index: u64) -> Option<(At, Vec<u64>)> {
        let at = match self.is_split {
            true => self.setting.split(prime, index)?,
            false => self.setting.at(prime, index)?,
        };
        let mut vector = (self.make)(&at).filter(|own| own.len() == self.width)?;
        vector.push(at.modulus.one());
        Some((at, vector))
    }
}

/// The entries of a vector that are not 0; its images end with the time of the search, or after a
/// number.
struct Limited<'v> {
    source: &'v dyn Vectors,
    support: Vec<usize>,
    halt: &'v Halt,
    left: Cell<usize>,
}

impl Vectors for Limited<'_> {
    fn names(&self) -> &[Formula] {
        self.source.names()
    }

    fn width(&self) -> usize {
        self.support.len()
    }

    fn image(&self, prime: u64, index: u64) -> Option<(At, Vec<u64>)> {
        self.left.set(self.left.get().checked_sub(1)?);
        self.halt.check().ok()?;
        let (at, vector) = self.source.image(prime, index)?;
        Some((at, self.support.iter().map(|k| vector[*k]).collect()))
    }
}

/// Finds the vector for all values of the parameters.
pub fn coefficients(source: &dyn Vectors, halt: &Halt) -> Option<Coefficients> {
    let mut first = (0..TRIES).filter(|_| halt.check().is_ok());
    let (_, vector) = first.find_map(|index| source.image(0, index))?;
    let support: Vec<usize> = (0..vector.len()).filter(|k| vector[*k] != 0).collect();
    let limited = Limited { source, support: support.clone(), halt, left: Cell::new(MOST) };
    let mut found = Coefficients::through(&limited)?;
    let mut own = support.into_iter().zip(std::mem::take(&mut found.polynomials)).peekable();
    let next = |k| own.next_if(|(place, _)| *place == k).map(|(_, one)| one).unwrap_or_default();
    found.polynomials = (0..vector.len()).map(next).collect();
    Some(found)
}

/// A vector found for all values of the parameters, over a common denominator.
pub struct Vector {
    /// Numerators, and the denominator as the last.
    pub coefficients: Coefficients,
    width: usize,
}

/// Finds a vector for all values of the parameters, with its denominator.
pub fn vector<F: Fn(&At) -> Option<Vec<u64>>>(
    source: &Images<'_, '_, F>,
    halt: &Halt,
) -> Option<Vector> {
    Some(Vector { coefficients: coefficients(source, halt)?, width: source.width })
}

impl Vector {
    /// Common denominator.
    pub fn below(&self) -> Composed {
        self.coefficients.formula(self.width)
    }

    /// Entry as an exponent.
    pub fn exponent(&self, place: usize) -> Composed {
        if let Some(value) = self.number(place) {
            return numeric_exponent(value);
        }
        let (above, below) = (self.coefficients.formula(place)?, self.below()?);
        match is_one(&below) {
            true => Ok(above),
            false => above.bracketed() / &below.bracketed(),
        }
    }

    /// Entry with the other sign, without the denominator.
    pub fn minus(&self, place: usize) -> Composed {
        Ok(-self.coefficients.formula(place)?.bracketed())
    }

    /// Whether an entry is a number.
    pub fn is_number(&self, place: usize) -> bool {
        self.number(place).is_some()
    }

    /// Whether an entry is a whole number.
    pub fn is_whole(&self, place: usize) -> bool {
        self.number(place).is_some_and(|value| value.parts().1 == 1.into())
    }

    /// The ratio of two multiples of one polynomial.
    fn number(&self, place: usize) -> Option<Rational> {
        let all = &self.coefficients.polynomials;
        let (above, below) = (&all[place], &all[self.width]);
        let ((_, first), (_, last)) = (above.first()?, below.first()?);
        let same = above.len() == below.len()
            && above.iter().zip(below).all(|((a, x), (b, y))| a == b && x * last == first * y);
        same.then(|| Some(Rational::new(first.to_i64()?, last.to_i64()?)))?
    }
}
