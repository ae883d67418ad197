//! Velocities that satisfy linear constraints a w + b = 0, by independent ones: w = S u + s, a S = 0.

use liouville::number::rational::Rational;

use super::matrices::Rows;
use super::polynomial::RingPolynomial;
use super::reduction::{Reduction, substituted};
use super::ring::AdjoinedRing;

/// Velocities on constraints.
pub struct ConstrainedVelocities {
    /// Places of the velocities for which the constraints are solved.
    dependent: Vec<usize>,
    /// Places of the others.
    pub independent: Vec<usize>,
    /// Whether the constraints are solved for at all positions.
    pub is_whole: bool,
    /// Relations of the ring.
    pub reduction: Reduction,
    /// Adjugate of the slopes of the dependent velocities, and the inverse of their determinant.
    adjugate: Rows,
    inverse: RingPolynomial,
    /// By independent velocity, the dependent velocities.
    images: Rows,
    /// Variables of dependent velocities, and what they are on the level.
    replaced: Vec<(usize, RingPolynomial)>,
}

impl ConstrainedVelocities {
    /// Solves constraints with slopes a; `velocities` are the variables of the velocities.
    pub fn of(
        slopes: &Rows,
        constraints: &[RingPolynomial],
        velocities: &[usize],
        ring: &mut AdjoinedRing,
    ) -> Option<Self> {
        let is_velocity = |own: &RingPolynomial| {
            own.variables().iter().any(|variable| velocities.contains(variable))
        };
        if slopes.iter().flatten().any(is_velocity) {
            return None;
        }
        let reduction = Reduction::of(&ring.atoms, false);
        let (dependent, determinant) = pivots(slopes, velocities.len(), &reduction)?;
        let independent = (0..velocities.len()).filter(|i| !dependent.contains(i)).collect();
        let inverse = ring.inverse(&determinant)?;
        // The inverse is a further variable.
        let reduction = Reduction::of(&ring.atoms, false);
        let columns: Rows =
            slopes.iter().map(|row| dependent.iter().map(|i| row[*i].clone()).collect()).collect();
        let adjugate = reduction.adjugate(&columns)?;
        let is_whole = determinant.value().is_some();
        let (images, replaced) = (Vec::new(), Vec::new());
        let mut made = Self {
            dependent,
            independent,
            is_whole,
            reduction,
            adjugate,
            inverse,
            images,
            replaced,
        };
        made.images = made
            .independent
            .iter()
            .map(|i| made.given(&slopes.iter().map(|row| row[*i].clone()).collect::<Vec<_>>()))
            .collect::<Option<_>>()?;
        made.replaced = made.on_constraints(constraints, velocities)?;
        Some(made)
    }

    /// The dependent velocities, as functions of the others.
    fn on_constraints(
        &self,
        constraints: &[RingPolynomial],
        velocities: &[usize],
    ) -> Option<Vec<(usize, RingPolynomial)>> {
        let at_rest: Vec<(usize, RingPolynomial)> =
            velocities.iter().map(|w| (*w, RingPolynomial::default())).collect();
        let rest: Option<Vec<_>> =
            constraints.iter().map(|own| substituted(own, &at_rest)).collect();
        let shift = self.given(&rest?)?;
        let mut replaced = Vec::new();
        for (k, place) in self.dependent.iter().enumerate() {
            let mut sum = shift[k].clone();
            for (i, image) in self.independent.iter().zip(&self.images) {
                let own = RingPolynomial::variable(velocities[*i], 1);
                sum = sum.plus(&image[k].times(&own)?, &Rational::from(1))?;
            }
            replaced.push((velocities[*place], self.reduction.reduced(&sum)?));
        }
        Some(replaced)
    }

    /// −a_D⁻¹ times a vector.
    pub fn given(&self, side: &[RingPolynomial]) -> Option<Vec<RingPolynomial>> {
        let entry = |row: &Vec<RingPolynomial>| {
            let own = self.reduction.product(&self.reduction.dot(row, side)?, &self.inverse)?;
            Some(own.times_number(&Rational::from(-1)))
        };
        self.adjugate.iter().map(entry).collect()
    }

    /// A polynomial where the constraints hold.
    pub fn on_level(&self, own: &RingPolynomial) -> Option<RingPolynomial> {
        self.reduction.reduced(&substituted(own, &self.replaced)?)
    }

    /// Polynomials where the constraints hold.
    pub fn all_on_level(&self, own: &[RingPolynomial]) -> Option<Vec<RingPolynomial>> {
        own.iter().map(|own| self.on_level(own)).collect()
    }

    /// The vector of all velocities with given dependent ones, 1 at an independent one, and 0 at others.
    pub fn spread(&self, own: Option<usize>, given: &[RingPolynomial]) -> Vec<RingPolynomial> {
        let count = self.dependent.len() + self.independent.len();
        let mut all = vec![RingPolynomial::default(); count];
        if let Some(i) = own {
            all[i] = RingPolynomial::constant(Rational::from(1));
        }
        self.dependent.iter().zip(given).for_each(|(place, own)| all[*place] = own.clone());
        all
    }

    /// Columns of S.
    pub fn directions(&self) -> Rows {
        let pairs = self.independent.iter().zip(&self.images);
        pairs.map(|(i, own)| self.spread(Some(*i), own)).collect()
    }
}

/// Velocities for which the constraints are solved, with the determinant of their slopes: a number if
/// possible, otherwise that with fewest terms.
fn pivots(
    slopes: &Rows,
    velocities: usize,
    reduction: &Reduction,
) -> Option<(Vec<usize>, RingPolynomial)> {
    let count = slopes.len();
    let mut best: Option<(Vec<usize>, RingPolynomial)> = None;
    let mut chosen: Vec<usize> = (0..count).collect();
    loop {
        let rows = slopes.iter();
        let square: Rows =
            rows.map(|row| chosen.iter().map(|i| row[*i].clone()).collect()).collect();
        let determinant = reduction.determinant(&square)?;
        if determinant.value().is_some_and(|value| !value.is_zero()) {
            return Some((chosen, determinant));
        }
        let terms = determinant.terms().count();
        if terms > 0 && best.as_ref().is_none_or(|(_, own)| terms < own.terms().count()) {
            best = Some((chosen.clone(), determinant));
        }
        // The next combination, the last places first.
        let Some(place) = (0..count).rev().find(|k| chosen[*k] < velocities - count + k) else {
            return best;
        };
        chosen[place] += 1;
        (place + 1..count).for_each(|k| chosen[k] = chosen[k - 1] + 1);
    }
}
