//! Coefficients as numbers or functions of the parameters.
//!
//! A null vector is known modulo a prime for each choice of the parameters. If all parameters are
//! numbers, so are the coefficients: rational numbers, by the Chinese remainder theorem from enough
//! primes. Otherwise each coefficient is a fraction N/D of polynomials in the parameters'
//! components: N(θ) − c(θ) D(θ) = 0 is linear in the coefficients of N and D.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, Zero};

use super::super::SearchError;
use super::super::echelon::Echelon;
use super::super::series::exponents;
use super::super::terms::{TermSum, combined, is_one};
use super::monomials::power_product;
use super::system::{LinearSystem, PrimePoint};
use super::{Coordinates, TENSOR};
use fitted::{Fitted, PointPowers};
use liouville::formula::{Formula, FormulaError, FormulaResult};
use liouville::order::StableOrder;
use liouville::proof::reconstruct;
pub use numbers::has_products;
use numbers::{Number, Roots, numbers};
pub use vectors::{NullVector, Vectors};

/// Number of primes after which rational coefficients are given up.
const PRIMES: u64 = 8;
/// Largest number of coefficients of a numerator and denominator together.
const MOST_COEFFICIENTS: usize = 640;
/// Number of samples beyond the number of unknowns.
const SPARE_SAMPLES: usize = 8;
/// Number of choices of parameters beyond those wanted, since some have no value.
const BARREN: u64 = 64;
/// Largest number of elementary steps for the coefficients of one vector.
const STEPS: f64 = 4e9;
/// Elementary steps for a power modulo the prime.
const POWER: usize = 8;

/// A polynomial in the coordinates of the parameters, by exponents.
pub type Polynomial = Vec<(Vec<u32>, BigInt)>;

/// A function that a coefficient multiplies.
#[derive(Clone, Debug)]
pub struct Ratio {
    /// Numerator.
    pub above: Formula,
    /// Denominator, unless it is 1.
    pub below: Option<Formula>,
}

impl Ratio {
    /// Function without a denominator.
    pub fn of(above: Formula) -> Self {
        Self { above, below: None }
    }
}

/// Coefficients of a vector: one polynomial for each column, without common factor.
#[derive(Clone, Debug)]
pub struct PrimitiveVector {
    /// Coordinates in which they are polynomials.
    names: Vec<Formula>,
    /// Polynomials by column.
    pub polynomials: Vec<Polynomial>,
}

impl PrimitiveVector {
    /// Finds the vector on some columns that is 1 at the last of them, for all values of the
    /// parameters; `None` if its coefficients are not fractions of low degree.
    pub fn of(system: &LinearSystem, columns: &[usize]) -> Result<Option<Self>, SearchError> {
        Self::through(&NullVector { system, columns })
    }

    /// Finds a vector for all values of the parameters from its images; `None` if its coefficients
    /// are not fractions of low degree.
    pub fn through(source: &dyn Vectors) -> Result<Option<Self>, SearchError> {
        let found = Self::fitted(source);
        // A stopped search says nothing about the coefficients.
        source.halt().check()?;
        Ok(found)
    }

    fn fitted(source: &dyn Vectors) -> Option<Self> {
        let mut samples = VectorSamples { source, next: 0, known: Vec::new(), left: STEPS };
        let varying = samples.varying()?;
        if varying.is_empty() {
            return numbers(source);
        }
        // Few coordinates are tried first: often J replaces I, m and R.
        let names = source.names();
        let tensor = |k: &usize| TENSOR.contains(&names[*k].text());
        let instead = |k: usize| {
            let entry = names[k].text().strip_prefix('I').map(|entry| format!("J{entry}"));
            entry.and_then(|entry| names.iter().position(|name| name.text() == entry)).unwrap_or(k)
        };
        let plain: Vec<usize> = varying.iter().copied().filter(|k| !tensor(k)).collect();
        let mixed = plain.iter().map(|k| instead(*k)).collect();
        let tensors: Vec<usize> = varying.iter().copied().filter(tensor).collect();
        // A parameter of the case may have the name of an entry of J.
        let all = if tensors.is_empty() { Vec::new() } else { varying };
        [tensors, mixed, plain, all].into_iter().find_map(|kept| samples.fitted(&kept))
    }

    /// Coefficient of a column; `None` where it is 0.
    fn coefficient(&self, column: usize) -> Result<Option<Formula>, FormulaError> {
        let own = &self.polynomials[column];
        let terms: Vec<Formula> =
            own.iter().map(|(a, _)| power_product(&self.names, a)).collect::<Result<_, _>>()?;
        let multiples: Vec<BigInt> = own.iter().map(|(_, multiple)| multiple.clone()).collect();
        combined(&multiples, &terms)
    }

    /// Coefficient of a column as a formula.
    pub fn formula(&self, column: usize) -> FormulaResult {
        Ok(self.coefficient(column)?.unwrap_or_else(|| Formula::number(0)))
    }

    /// Σ coefficient · function over the columns `own`; `None` where all are 0.
    pub fn sum(&self, own: &[usize], functions: &[Ratio]) -> Result<Option<Formula>, FormulaError> {
        let mut sum = TermSum::default();
        for (column, function) in own.iter().zip(functions) {
            let polynomial = &self.polynomials[*column];
            let is_negative = match polynomial.as_slice() {
                [] => continue,
                [(_, multiple)] => multiple.is_negative(),
                _ => false,
            };
            let Some(coefficient) = self.coefficient(*column)? else { continue };
            let coefficient = match (polynomial.len(), is_negative) {
                (1, false) => coefficient,
                (1, true) => self.magnitude(*column)?,
                _ => coefficient.bracketed(),
            };
            let above = match (is_one(&function.above), is_one(&coefficient)) {
                (true, _) => coefficient,
                (_, true) => function.above.clone(),
                _ => (&coefficient * &function.above)?,
            };
            let term = match &function.below {
                None => above,
                Some(below) => (&above / below)?,
            };
            sum.add(is_negative, &term)?;
        }
        Ok(sum.total())
    }

    /// The same sum, or its negative where that begins with a plus; and whether it is the negative.
    pub fn sum_with_plus(
        &self,
        own: &[usize],
        functions: &[Ratio],
    ) -> Result<Option<(Formula, bool)>, FormulaError> {
        let Some(sum) = self.sum(own, functions)? else { return Ok(None) };
        match sum.text().starts_with(['−', '-']) {
            true => Ok(self.negative().sum(own, functions)?.map(|negative| (negative, true))),
            false => Ok(Some((sum, false))),
        }
    }

    /// The same vector with the other sign.
    fn negative(&self) -> Self {
        let mut other = self.clone();
        let all = other.polynomials.iter_mut().flatten();
        all.for_each(|(_, multiple)| *multiple = -multiple.clone());
        other
    }

    /// Negative of the coefficient of a column that is a single term.
    fn magnitude(&self, column: usize) -> FormulaResult {
        let mut other = self.clone();
        other.polynomials[column]
            .iter_mut()
            .for_each(|(_, multiple)| *multiple = -multiple.clone());
        other.formula(column)
    }

    /// Divides by the common divisor of all numbers and makes the last column positive.
    fn reduced(mut self) -> Self {
        let all = || self.polynomials.iter().flatten();
        let common = all().fold(BigInt::ZERO, |gcd, (_, a)| gcd.gcd(a));
        let last = self.polynomials.iter().rev().find_map(|own| own.first());
        let sign = last.is_some_and(|(_, a)| a.is_negative());
        if !common.is_zero() {
            let divisor = if sign { -common } else { common };
            self.polynomials.iter_mut().flatten().for_each(|(_, a)| *a /= &divisor);
        }
        self
    }
}

/// Values of the vector for choices of the parameters, computed on demand.
struct VectorSamples<'s> {
    source: &'s dyn Vectors,
    next: u64,
    /// Choices of the parameters with the vector there.
    known: Vec<(PrimePoint, Vec<u64>)>,
    /// Number of elementary steps that may still be taken.
    left: f64,
}

impl VectorSamples<'_> {
    /// Takes elementary steps; `None` if there are none left.
    fn takes(&mut self, steps: f64) -> Option<()> {
        self.left -= steps;
        (self.source.takes(steps) && self.left > 0.0).then_some(())
    }

    fn extend(&mut self, count: usize) -> Option<()> {
        let last = self.next + count as u64 + BARREN;
        while self.known.len() < count {
            if self.next > last || self.source.halt().check().is_err() {
                return None;
            }
            let found = self.source.image(0, self.next);
            self.next += 1;
            self.known.extend(found);
        }
        Some(())
    }

    /// Returns the coordinates that differ between choices, and from those before them and their
    /// negatives.
    fn varying(&mut self) -> Option<Vec<usize>> {
        self.extend(4)?;
        let m = self.known.first()?.0.modulus;
        let column =
            |k: usize| -> Vec<u64> { self.known.iter().map(|(at, _)| at.coordinates[k]).collect() };
        let is_new = |k: &usize| {
            let own = column(*k);
            let minus: Vec<u64> = own.iter().map(|x| m.sub(0, *x)).collect();
            let is_same = |j| [&own, &minus].contains(&&column(j));
            own.iter().any(|x| *x != own[0]) && !(0..*k).any(is_same)
        };
        Some((0..self.source.names().len()).filter(is_new).collect())
    }

    /// Fits coefficients as polynomials in some of the coordinates, over a common denominator.
    fn fitted(&mut self, kept: &[usize]) -> Option<PrimitiveVector> {
        if kept.is_empty() {
            return None;
        }
        let modulus = self.known.first()?.0.modulus;
        let m = &modulus;
        let mut denominators: Vec<Fitted> = Vec::new();
        // By column, what was found without denominators.
        let mut alone: Vec<Option<(Fitted, Fitted)>> = vec![None; self.source.width()];
        'again: loop {
            let mut found = Vec::new();
            for (column, alone) in alone.iter_mut().enumerate() {
                if alone.is_none() {
                    *alone = self.fraction(kept, column, &[]);
                }
                // A polynomial has a lower degree without the denominators.
                if !denominators.is_empty()
                    && let Some((above, below)) = &*alone
                    && below.degree == 0
                {
                    let own = above.clone().scaled(m, m.inverse(below.images[0].1));
                    found.push(denominators.iter().fold(own, |all, one| all.times(m, one)));
                    continue;
                }
                let (above, below) = match denominators.is_empty() {
                    true => alone.clone()?,
                    false => self.fraction(kept, column, &denominators)?,
                };
                if below.degree > 0 {
                    denominators.push(below);
                    continue 'again;
                }
                found.push(above.scaled(m, m.inverse(below.images[0].1)));
            }
            let roots = Roots::of(self.source.names(), self.source.multiplies_roots());
            let at = &self.known.first()?.0;
            let numbers = |fitted: &Fitted| {
                let part = |(a, image): &(Vec<u32>, u64)| {
                    let own = match reconstruct(*image, m) {
                        Some(value) => {
                            let (above, below) = value.parts();
                            Number::fraction(above, below)
                        }
                        None => roots.number(&[(at, *image)])?,
                    };
                    Some((a.clone(), own))
                };
                fitted.images.iter().map(part).collect::<Option<Vec<_>>>()
            };
            let numbers: Vec<Vec<_>> = found.iter().map(numbers).collect::<Option<_>>()?;
            let names = kept.iter().map(|k| self.source.names()[*k].clone()).collect();
            return Some(roots.coefficients(names, &numbers).reduced());
        }
    }

    /// Finds numerator and denominator of least degree for a column, times denominators of others.
    fn fraction(
        &mut self,
        kept: &[usize],
        column: usize,
        denominators: &[Fitted],
    ) -> Option<(Fitted, Fitted)> {
        // A root is linear in a numerator, and can be removed from a denominator.
        let is_root: Vec<bool> =
            kept.iter().map(|k| Coordinates::is_root(&self.source.names()[*k])).collect();
        let roots = is_root.iter().filter(|own| **own).count();
        let plain = kept.len() - roots;
        let monomials = |degree: u32, power: u32| -> Vec<Vec<u32>> {
            let all = (0..=degree).flat_map(|total| exponents(kept.len(), total));
            let fits =
                |own: &Vec<u32>| own.iter().zip(&is_root).all(|(a, root)| !root || *a <= power);
            all.filter(fits).collect()
        };
        let mut trials: Vec<(usize, u32, u32)> = (0..=8u32)
            .flat_map(|above| (0..=6u32).map(move |below| (above, below)))
            .map(|(above, below)| (linear(plain, roots, above) + count(plain, below), above, below))
            .filter(|(unknowns, ..)| *unknowns <= MOST_COEFFICIENTS)
            .collect();
        trials.order();
        for (unknowns, above, below) in trials {
            self.extend(unknowns + SPARE_SAMPLES)?;
            let m = self.known[0].0.modulus;
            let (upper, lower) = (monomials(above, 1), monomials(below, 0));
            let terms = unknowns + denominators.iter().map(|own| own.images.len()).sum::<usize>();
            let rows = unknowns + SPARE_SAMPLES;
            let given = denominators.iter().map(|own| own.degree).max().unwrap_or(0);
            let highest = above.max(below).max(given);
            self.takes((rows * (terms * kept.len() * POWER + unknowns * unknowns / 2)) as f64)?;
            let mut echelon = Echelon::new(unknowns, m);
            for (at, vector) in &self.known[..unknowns + SPARE_SAMPLES] {
                self.source.halt().check().ok()?;
                let point: Vec<u64> = kept.iter().map(|k| at.coordinates[*k]).collect();
                let point = PointPowers::of(&m, &point, highest);
                let value = denominators
                    .iter()
                    .fold(vector[column], |value, own| m.mul(value, own.evaluate(&m, &point)));
                let minus = m.sub(0, value);
                let row = upper.iter().map(|a| point.monomial(&m, a));
                let row = row.chain(lower.iter().map(|a| m.mul(minus, point.monomial(&m, a))));
                echelon.push(row.collect());
            }
            if let Some(vector) = echelon.null_space().first() {
                let (n, d) = vector.split_at(upper.len());
                // N = 0 or 0 = c D at all points: the coordinates are dependent.
                if [n, d].iter().any(|part| part.iter().all(|image| *image == 0)) {
                    return None;
                }
                return Some((Fitted::new(&upper, n), Fitted::new(&lower, d)));
            }
        }
        None
    }
}

/// Number of monomials of at most this degree.
fn count(variables: usize, degree: u32) -> usize {
    (1..=variables).fold(1, |product, i| product * (degree as usize + i) / i)
}

/// Number of monomials of at most this degree that are linear in each of some roots.
fn linear(plain: usize, roots: usize, degree: u32) -> usize {
    (0..=roots.min(degree as usize))
        .map(|own| {
            let chosen = (1..=own).fold(1, |product, i| product * (roots + 1 - i) / i);
            chosen * count(plain, degree - own as u32)
        })
        .sum()
}

mod fitted;
mod numbers;
mod ratio;
#[cfg(test)]
mod tests;
mod vectors;
