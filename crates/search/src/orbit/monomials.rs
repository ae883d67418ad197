//! Monomials in the components of the state, and their series along an orbit.

use rustc_hash::FxHashMap;

use liouville::number::prime::Modulus;

use super::super::series::exponents;
use super::super::{Halt, SearchError};
use super::taylor::convolved;

/// Exponents of all monomials up to a degree in some of the variables, low degrees first; the
/// constant is the first.
pub fn up_to(variables: &[usize], dimension: usize, degree: u32) -> Vec<Vec<u32>> {
    let spread = |own: Vec<u32>| {
        let mut all = vec![0; dimension];
        variables.iter().zip(own).for_each(|(variable, power)| all[*variable] = power);
        all
    };
    (0..=degree).flat_map(|total| exponents(variables.len(), total)).map(spread).collect()
}

/// Number of monomials up to a degree.
pub fn count(variables: usize, degree: u32) -> usize {
    (1..=variables).fold(1usize, |product, i| product.saturating_mul(degree as usize + i) / i)
}

/// Number of steps of the eliminations on a line, for monomials up to a degree along a field of
/// degree `field`.
pub fn steps(variables: usize, degree: u32, field: usize) -> f64 {
    steps_of(count(variables, degree), degree, field)
}

/// The same for this number of monomials.
pub fn steps_of(count: usize, degree: u32, field: usize) -> f64 {
    let count = count as f64;
    let places = f64::from(degree) * count + field.saturating_sub(1) as f64 * count * count / 2.0;
    places * count * count * (count / 3.0 + 4.0)
}

/// Returns the values of monomials at the points of an orbit: one row for each point, one column for
/// each monomial.
pub fn at_points(
    m: &Modulus,
    orbit: &[Vec<u64>],
    monomials: &[Vec<u32>],
    halt: &Halt,
) -> Result<Vec<Vec<u64>>, SearchError> {
    let mut rows = Vec::new();
    for place in 0..orbit.first().map_or(0, Vec::len) {
        if place % 16 == 15 {
            halt.check()?;
            halt.meter().set(place, orbit[0].len());
        }
        let point: Vec<u64> = orbit.iter().map(|variable| variable[place]).collect();
        rows.push(monomials.iter().map(|own| value(m, &point, own)).collect());
    }
    Ok(rows)
}

/// Series of monomials along an orbit, made on demand.
pub struct MonomialSeries<'o> {
    modulus: Modulus,
    orbit: &'o [Vec<u64>],
    known: FxHashMap<Vec<u32>, Vec<u64>>,
}

impl<'o> MonomialSeries<'o> {
    /// Takes the series of the variables.
    pub fn new(modulus: Modulus, orbit: &'o [Vec<u64>]) -> Self {
        Self { modulus, orbit, known: FxHashMap::default() }
    }

    fn orders(&self) -> usize {
        self.orbit.first().map_or(0, Vec::len)
    }

    /// Computes the series of a monomial.
    fn series(&mut self, exponents: &[u32]) -> Vec<u64> {
        if let Some(known) = self.known.get(exponents) {
            return known.clone();
        }
        let m = self.modulus;
        let made = match exponents.iter().rposition(|power| *power > 0) {
            None => {
                let mut one = vec![0; self.orders()];
                one[..1].fill(m.one());
                one
            }
            Some(variable) => {
                let mut lower = exponents.to_vec();
                lower[variable] -= 1;
                let (rest, orbit) = (self.series(&lower), &self.orbit[variable]);
                match lower.iter().all(|power| *power == 0) {
                    true => orbit.clone(),
                    false => {
                        let orders = 0..self.orders();
                        orders.map(|k| convolved(&m, &rest[..=k], &orbit[..=k])).collect()
                    }
                }
            }
        };
        self.known.insert(exponents.to_vec(), made.clone());
        made
    }

    /// Returns the matrix of the coefficients: one row for each order, one column for each
    /// monomial.
    pub fn rows(
        &mut self,
        monomials: &[Vec<u32>],
        halt: &Halt,
    ) -> Result<Vec<Vec<u64>>, SearchError> {
        let mut columns = Vec::with_capacity(monomials.len());
        for (place, own) in monomials.iter().enumerate() {
            if place % 16 == 15 {
                halt.check()?;
                halt.meter().set(place, monomials.len());
            }
            columns.push(self.series(own));
        }
        let row = |k: usize| columns.iter().map(|column| column[k]).collect();
        Ok((0..self.orders()).map(row).collect())
    }
}

/// Value of a monomial at a point.
pub fn value(m: &Modulus, point: &[u64], exponents: &[u32]) -> u64 {
    let powers = point.iter().zip(exponents).filter(|(_, power)| **power > 0);
    powers.fold(m.one(), |product, (x, power)| m.mul(product, m.power(*x, u64::from(*power))))
}
