//! Monomials in the components of the state, and their series along an orbit.

use rustc_hash::FxHashMap;

use liouville::formula::FormulaError;
use liouville::number::prime::Modulus;

use super::super::ansatz::coefficients::Ratio;
use super::super::ansatz::monomials::power_product;
use super::super::series::exponents;
use super::super::{Halt, SearchError};
use super::setting::OrbitSetting;

impl OrbitSetting<'_> {
    /// Monomials in the variables as formulas.
    pub fn functions<'m>(
        &self,
        monomials: impl IntoIterator<Item = &'m Vec<u32>>,
    ) -> Result<Vec<Ratio>, FormulaError> {
        monomials.into_iter().map(|own| power_product(&self.terms, own).map(Ratio::of)).collect()
    }
}

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

/// Number of monomials up to a degree, or the largest number there is in place of a larger one.
pub fn count(variables: usize, degree: u32) -> usize {
    let product = (1..=variables as u128)
        .fold(1u128, |product, i| product.saturating_mul(u128::from(degree) + i) / i);
    usize::try_from(product).unwrap_or(usize::MAX)
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

/// The products by which the series of monomials along an orbit are made, each from that of a lower monomial.
pub struct MonomialSeries {
    factors: Vec<SeriesFactors>,
    /// Place of each monomial among these.
    columns: Vec<usize>,
}

/// Factors of a series.
#[derive(Clone, Copy)]
enum SeriesFactors {
    /// None: the series of 1.
    One,
    /// That of a variable.
    Variable(usize),
    /// An earlier series, and that of a variable.
    Product(usize, usize),
}

impl MonomialSeries {
    /// Plans the series of some monomials.
    pub fn of(monomials: &[Vec<u32>]) -> Self {
        let (mut factors, mut known) = (Vec::new(), FxHashMap::default());
        let columns = monomials.iter().map(|own| place(own, &mut factors, &mut known)).collect();
        Self { factors, columns }
    }

    /// Number of the monomials.
    pub fn count(&self) -> usize {
        self.columns.len()
    }

    /// Returns the matrix of the coefficients along an orbit: one row for each order, one column for each
    /// monomial.
    pub fn rows(
        &self,
        m: &Modulus,
        orbit: &[Vec<u64>],
        halt: &Halt,
    ) -> Result<Vec<Vec<u64>>, SearchError> {
        let orders = orbit.first().map_or(0, Vec::len);
        let mut series = vec![0; self.factors.len() * orders];
        for (place, own) in self.factors.iter().enumerate().filter(|_| orders > 0) {
            if place % 16 == 15 {
                halt.check()?;
                halt.meter().set(place, self.factors.len());
            }
            let (before, rest) = series.split_at_mut(place * orders);
            match *own {
                SeriesFactors::One => rest[0] = m.one(),
                SeriesFactors::Variable(variable) => {
                    rest[..orders].copy_from_slice(&orbit[variable]);
                }
                SeriesFactors::Product(lower, variable) => {
                    let (lower, other) = (&before[lower * orders..], &orbit[variable]);
                    for (k, entry) in rest[..orders].iter_mut().enumerate() {
                        *entry = m.convolved(&lower[..=k], &other[..=k]);
                    }
                }
            }
        }
        let row = |k: usize| self.columns.iter().map(|place| series[place * orders + k]).collect();
        Ok((0..orders).map(row).collect())
    }
}

/// Place of the series of a monomial, which is added with those it needs if it is not there.
fn place(
    exponents: &[u32],
    factors: &mut Vec<SeriesFactors>,
    known: &mut FxHashMap<Vec<u32>, usize>,
) -> usize {
    if let Some(place) = known.get(exponents) {
        return *place;
    }
    let made = match exponents.iter().rposition(|power| *power > 0) {
        None => SeriesFactors::One,
        Some(variable) => {
            let mut lower = exponents.to_vec();
            lower[variable] -= 1;
            match lower.iter().all(|power| *power == 0) {
                true => SeriesFactors::Variable(variable),
                false => SeriesFactors::Product(place(&lower, factors, known), variable),
            }
        }
    };
    factors.push(made);
    known.insert(exponents.to_vec(), factors.len() - 1);
    factors.len() - 1
}

/// Value of a monomial at a point.
pub fn value(m: &Modulus, point: &[u64], exponents: &[u32]) -> u64 {
    let powers = point.iter().zip(exponents).filter(|(_, power)| **power > 0);
    powers.fold(m.one(), |product, (x, power)| m.mul(product, m.power(*x, u64::from(*power))))
}
