//! Counts of integrals that are polynomial in the velocities, with arbitrary smooth coefficients in
//! the positions, from Taylor coefficients at one random point and without any ansatz.
//!
//! F = Σ C_a(q) w^a is an integral when the coefficients of every w^c in L_vF vanish: linear
//! equations of first order for the C_a. They are expanded in Taylor coefficients up to order N,
//! modulo a prime, at a random point and for random parameters. The number of coefficients up to
//! order n that they leave free bounds the number of integrals of degree n from above. A rank
//! modulo p is never above the rank in characteristic 0, so that an empty answer is a theorem about
//! generic parameters.

use crate::streams::SearchStream;
use rustc_hash::FxHashMap;

use super::budget::Budget;
use super::echelon::Echelon;
use super::expansion::{FieldExpansion, Taylor};
use super::local::Local;
use super::series::exponents;
use super::{Effort, Halt, SearchError};
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;

/// Largest number of points drawn until the field has a Taylor series at one.
const MOST_POINTS: usize = 4096;

/// Exponents of the velocities, and the index of a monomial in the positions.
pub type RowKey = (Vec<u32>, usize);

/// Columns and values of a sparse row.
type Entries = Vec<(usize, u64)>;

/// The space of polynomials in the velocities to be counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VelocityPolynomials {
    /// Degree in the velocities.
    pub degree: u32,
    /// Whether all degrees up to it are counted together, as needed with a gyrostat or a potential.
    pub mixed: bool,
}

/// A dimension as an upper bound for generic parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DimensionCount {
    /// Dimension of the space.
    pub dimension: usize,
    /// Numbers of unknowns and equations.
    pub size: (usize, usize),
}

/// Counts the polynomials P with L_vP + α div v P = 0, of which at least `least` are known;
/// integrals for α = 0. The order of the Taylor coefficients rises until the count is stable.
pub fn count(
    local: &Local,
    asked: VelocityPolynomials,
    weight: &Rational,
    least: usize,
    effort: &Effort,
) -> Result<DimensionCount, SearchError> {
    let mut last = None;
    let lowest = 2 * asked.degree + 2;
    for order in [lowest, lowest + 1, lowest + 3, lowest + 5] {
        let found = count_to_order(local, asked, weight, order, effort)?;
        if found.dimension <= least || last == Some(found.dimension) {
            return Ok(found);
        }
        last = Some(found.dimension);
    }
    Err(SearchError::Unsettled(asked.degree))
}

fn count_to_order(
    local: &Local,
    asked: VelocityPolynomials,
    weight: &Rational,
    order: u32,
    effort: &Effort,
) -> Result<DimensionCount, SearchError> {
    let mut rng = SearchStream::Jets.under(effort.options.seed);
    let modulus = rng.prime(&[], &[]);
    let weight = modulus.rational(weight).ok_or(SearchError::NoSeries)?;
    let mut taylor = Taylor::new(local, modulus, order);
    for _ in 0..MOST_POINTS {
        let parameters = local.parameters(&modulus, &mut rng);
        let positions = taylor.positions(&mut rng);
        if let Some(expansion) = taylor.at(&parameters, &positions, &mut rng)? {
            let budget = Budget::of(effort);
            let (unknowns, entries) = extent(&expansion, &taylor, asked);
            budget.admits(unknowns, entries)?;
            let system = Equations::of(&expansion, &taylor, asked, weight, &effort.halt)?;
            let dimension = system.dimension(&system.solved(&budget)?.0);
            let size = (system.columns.len(), system.rows.len());
            return Ok(DimensionCount { dimension, size });
        }
    }
    Err(SearchError::NoSeries)
}

/// Number of unknowns of the equations, and an estimate of the number of their entries, by the degrees
/// of the terms that are not 0.
fn extent(
    expansion: &FieldExpansion,
    taylor: &Taylor<'_>,
    asked: VelocityPolynomials,
) -> (usize, f64) {
    let order = taylor.order as usize;
    let monomials = taylor.series.monomials();
    let degrees: Vec<usize> = monomials.iter().map(|m| m.iter().sum::<u32>() as usize).collect();
    // Terms of the rates by degree: one may lower the degree of what it is multiplied by.
    let mut terms = vec![0.0; order + 1];
    let rates = expansion.positions.iter().chain(&expansion.velocities).flatten();
    for (_, coefficients) in rates {
        let present = degrees.iter().zip(coefficients).filter(|(_, value)| **value != 0);
        present.for_each(|(degree, _)| terms[(*degree).min(order)] += 1.0);
    }
    let met = |degree: usize| terms.iter().take((order + 1).saturating_sub(degree)).sum::<f64>();
    let velocities = taylor.local.coordinates.velocities;
    let lowest = if asked.mixed { 0 } else { asked.degree };
    let powers: usize = (lowest..=asked.degree).map(|n| exponents(velocities, n).len()).sum();
    let entries: f64 = degrees.iter().map(|degree| met(*degree)).sum();
    (powers * monomials.len(), powers as f64 * entries)
}

/// Linear equations for the Taylor coefficients of the C_a.
pub struct Equations {
    /// Order of the coefficient of each column, from high to low, so that the free columns are of
    /// low order.
    columns: Vec<u32>,
    degree: u32,
    /// Rows, each with the velocity exponents and the position monomial of its coefficient.
    rows: Vec<(RowKey, Entries)>,
    modulus: Modulus,
}

impl Equations {
    /// Iterates over the rows in dense form, with their keys.
    pub fn rows(&self) -> impl Iterator<Item = (&RowKey, Vec<u64>)> {
        self.rows.iter().map(|(key, entries)| {
            let mut row = vec![0; self.columns.len()];
            for (column, value) in entries {
                row[*column] = self.modulus.add(row[*column], *value);
            }
            (key, row)
        })
    }

    /// Brings all equations into echelon form; returns it with the keys of the independent rows.
    pub fn solved(&self, budget: &Budget<'_>) -> Result<(Echelon, Vec<RowKey>), SearchError> {
        let mut echelon = Echelon::new(self.columns.len(), self.modulus);
        let mut keys = Vec::new();
        for (key, row) in self.rows() {
            budget.check(&echelon)?;
            if echelon.push(row) {
                keys.push(key.clone());
            }
        }
        Ok((echelon, keys))
    }

    /// Number of integrals that the equations leave, as determined by coefficients of low order.
    pub fn dimension(&self, echelon: &Echelon) -> usize {
        let free =
            |column: &usize| self.columns[*column] <= self.degree && !echelon.has_pivot(*column);
        (0..self.columns.len()).filter(free).count()
    }

    /// Sets up the equations for L_vP + α div v P = 0 at a point, where α is the weight.
    pub fn of(
        expansion: &FieldExpansion,
        taylor: &Taylor<'_>,
        asked: VelocityPolynomials,
        weight: u64,
        halt: &Halt,
    ) -> Result<Self, SearchError> {
        let (modulus, order) = (taylor.modulus, taylor.order);
        let VelocityPolynomials { degree, mixed } = asked;
        let divergence = match weight {
            0 => Vec::new(),
            _ => expansion.divergence(&taylor.series),
        };
        let velocities = taylor.local.coordinates.velocities;
        let m = &modulus;
        let lowest = if mixed { 0 } else { degree };
        let powers: Vec<Vec<u32>> =
            (lowest..=degree).flat_map(|n| exponents(velocities, n)).collect();
        let monomials = taylor.series.monomials();
        let total = |monomial: &[u32]| monomial.iter().sum::<u32>();
        let place: FxHashMap<&[u32], usize> =
            monomials.iter().enumerate().map(|(k, monomial)| (monomial.as_slice(), k)).collect();
        // Columns from high order to low, so that the free ones are of low order.
        let mut columns: Vec<(usize, usize)> =
            (0..powers.len()).flat_map(|a| (0..monomials.len()).map(move |k| (a, k))).collect();
        columns.sort_by_key(|(a, k)| (std::cmp::Reverse(total(&monomials[*k])), *a, *k));
        let mut rows: FxHashMap<RowKey, Entries> = FxHashMap::default();
        for (column, (a, k)) in columns.iter().enumerate() {
            halt.check()?;
            let mut add = |power: Vec<u32>, monomial: &[u32], coefficient: &[u64], factor: u64| {
                for (other, value) in monomials.iter().zip(coefficient) {
                    if *value == 0 {
                        continue;
                    }
                    let sum: Vec<u32> = monomial.iter().zip(other).map(|(x, y)| x + y).collect();
                    if total(&sum) < order {
                        let row = rows.entry((power.clone(), place[sum.as_slice()])).or_default();
                        row.push((column, m.mul(factor, *value)));
                    }
                }
            };
            let (power, monomial) = (&powers[*a], &monomials[*k]);
            // ∂C/∂q_i q_i'
            for (i, rate) in
                expansion.positions.iter().enumerate().filter(|(i, _)| monomial[*i] > 0)
            {
                let mut lower = monomial.clone();
                lower[i] -= 1;
                let factor = m.integer(u64::from(monomial[i]));
                for (w, coefficient) in rate {
                    let raised = power.iter().zip(w).map(|(x, y)| x + y).collect();
                    add(raised, &lower, coefficient, factor);
                }
            }
            // C ∂w^a/∂w_i w_i'
            for (i, rate) in expansion.velocities.iter().enumerate().filter(|(i, _)| power[*i] > 0)
            {
                let factor = m.integer(u64::from(power[i]));
                for (w, coefficient) in rate {
                    let mut raised: Vec<u32> = power.iter().zip(w).map(|(x, y)| x + y).collect();
                    raised[i] -= 1;
                    add(raised, monomial, coefficient, factor);
                }
            }
            for (w, coefficient) in &divergence {
                let raised = power.iter().zip(w).map(|(x, y)| x + y).collect();
                add(raised, monomial, coefficient, weight);
            }
        }
        let mut rows: Vec<_> = rows.into_iter().collect();
        rows.sort_by(|(a, _), (b, _)| a.cmp(b));
        let columns = columns.into_iter().map(|(_, k)| total(&monomials[k])).collect();
        Ok(Self { columns, degree, rows, modulus })
    }
}
