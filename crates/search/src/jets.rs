//! Counts of integrals that are polynomial in the velocities, with arbitrary smooth coefficients in
//! the positions, from Taylor coefficients at one random point and without any ansatz.
//!
//! F = Σ C_a(q) w^a is an integral when the coefficients of every w^c in L_vF vanish: linear
//! equations of first order for the C_a. They are expanded in Taylor coefficients up to order N,
//! modulo a prime, at a random point and for random parameters. The number of coefficients up to
//! order n that they leave free bounds the number of integrals of degree n from above. A rank
//! modulo p is never above the rank in characteristic 0, so that an empty answer is a theorem about
//! generic parameters.

use super::budget::Budget;
use super::expansion::{FieldExpansion, Taylor};
use super::jet_equations::Equations;
use super::local::Local;
use super::series::exponents;
use super::streams::SearchStream;
use super::{Effort, SearchError};
use liouville::number::rational::Rational;
use liouville::proof::root_numbers;

/// Largest number of points drawn until the field has a Taylor series at one.
const MOST_POINTS: usize = 4096;

/// Orders that are tried, counted from the lowest; brackets of constraints need the higher ones.
const ORDERS: [u32; 7] = [0, 1, 3, 5, 8, 11, 15];

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

/// The motion about one random point, for one choice of the parameters. All counts take the same
/// point, so that its expansion is made again only for a higher order.
pub struct MotionAtPoint<'l> {
    local: &'l Local,
    expanded: Option<(Taylor<'l>, FieldExpansion)>,
    /// Order that will be needed, so that one expansion is enough.
    foreseen: u32,
}

impl<'l> MotionAtPoint<'l> {
    /// Takes up a motion; nothing is expanded yet.
    pub fn new(local: &'l Local) -> Self {
        Self { local, expanded: None, foreseen: 0 }
    }

    /// Foresees a count of this degree.
    pub fn foresee(&mut self, degree: u32) {
        self.foreseen = self.foreseen.max(lowest_order(degree));
    }

    /// Counts the polynomials P with L_vP + α div v P = 0, of which at least `least` are known;
    /// integrals for α = 0. The order of the Taylor coefficients rises until the count is stable.
    pub fn count(
        &mut self,
        asked: VelocityPolynomials,
        weight: &Rational,
        least: usize,
        effort: &Effort,
    ) -> Result<DimensionCount, SearchError> {
        let mut last = None;
        let lowest = lowest_order(asked.degree);
        for order in ORDERS.map(|more| lowest + more) {
            let Some(found) = self.count_to_order(asked, weight, order, effort)? else { continue };
            if found.dimension <= least || last == Some(found.dimension) {
                return Ok(found);
            }
            last = Some(found.dimension);
        }
        Err(SearchError::Unsettled(asked.degree))
    }

    fn count_to_order(
        &mut self,
        asked: VelocityPolynomials,
        weight: &Rational,
        order: u32,
        effort: &Effort,
    ) -> Result<Option<DimensionCount>, SearchError> {
        let (taylor, expansion) = self.expanded_to(order, effort)?;
        let weight = taylor.modulus.rational(weight).ok_or(SearchError::NoSeries)?;
        let budget = Budget::of(effort);
        let (unknowns, entries) = extent(expansion, taylor, order, asked);
        budget.admits(unknowns, entries)?;
        let system = Equations::of(expansion, taylor, order, asked, weight, &effort.halt)?;
        let dimension = system.free_below(&system.ranked(&budget)?);
        Ok(dimension.map(|dimension| DimensionCount { dimension, size: system.size() }))
    }

    /// Expands the field up to an order, or further.
    fn expanded_to(
        &mut self,
        order: u32,
        effort: &Effort,
    ) -> Result<&(Taylor<'l>, FieldExpansion), SearchError> {
        let expanded = match self.expanded.take() {
            Some(expanded) if expanded.0.order >= order => expanded,
            _ => self.expand(order.max(self.foreseen), effort)?,
        };
        Ok(self.expanded.insert(expanded))
    }

    fn expand(
        &self,
        order: u32,
        effort: &Effort,
    ) -> Result<(Taylor<'l>, FieldExpansion), SearchError> {
        let mut rng = SearchStream::Jets.under(effort.options.seed);
        let modulus = rng.prime_for(&root_numbers(&self.local.graph));
        let mut taylor = Taylor::new(self.local, modulus, order);
        for _ in 0..MOST_POINTS {
            let parameters = self.local.parameters(&modulus, &mut rng);
            let positions = taylor.positions(&mut rng);
            if let Some(expansion) = taylor.at(&parameters, &positions, &mut rng)? {
                return Ok((taylor, expansion));
            }
        }
        Err(SearchError::NoSeries)
    }
}

/// Order from which on polynomials of a degree are counted.
fn lowest_order(degree: u32) -> u32 {
    2 * degree + 2
}

/// Number of unknowns of the equations, and an estimate of the number of their entries, by the degrees
/// of the terms that are not 0.
fn extent(
    expansion: &FieldExpansion,
    taylor: &Taylor<'_>,
    order: u32,
    asked: VelocityPolynomials,
) -> (usize, f64) {
    let monomials = &taylor.series.monomials()[..taylor.series.count_below(order + 1)];
    let order = order as usize;
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
