//! Values on a line of parameters for which a field has more polynomial integrals.
//!
//! Each is a root of every maximal minor of the equations for the coefficients. Two minors, of
//! different states and of different combinations of columns, have no other roots in common.

use liouville::number::prime::{Modulus, Polynomial, PrimePolynomials};
use liouville::proof::ProofRng;

use super::equations::ParametricEquations;
use super::pencil::{self, SquareMatrix};
use crate::SearchError;
use crate::ansatz::system::PrimePoint;
use crate::budget::STEPS;
use crate::streams::SearchStream;

/// Number of minors that are compared.
const MINORS: usize = 2;
/// Numbers of values along a line from which the entries are read, one after the other.
const VALUES: [usize; 3] = [6, 14, 30];
/// First stream of states for minors on lines.
const STREAM: u64 = 5000;
/// Steps of one multiplication modulo a prime and what belongs to it.
const STEP: f64 = 3.0;
/// Steps for one entry of the equations at one state.
pub const ENTRY: f64 = 60.0;

/// Lines in the space of some draws of the parameters, modulo one prime.
pub struct ParameterLines<'l, 'e> {
    equations: &'l ParametricEquations<'e>,
    /// Draws that vary.
    draws: Vec<usize>,
    base: PrimePoint,
    columns: Vec<usize>,
    /// Number of independent integrals in general.
    pub general: usize,
    /// Random numbers of these lines.
    pub rng: ProofRng,
    /// Number of minors so far: each has states of its own.
    number: u64,
    /// Largest degree of an entry so far.
    degree: usize,
}

impl<'l, 'e> ParameterLines<'l, 'e> {
    /// Prepares lines modulo the prime with a number; `None` if the field has no values there.
    pub fn new(
        equations: &'l ParametricEquations<'e>,
        draws: Vec<usize>,
        prime: u64,
    ) -> Result<Option<Self>, SearchError> {
        let Some(base) = equations.system.at(prime, prime) else { return Ok(None) };
        let Some(columns) = equations.columns(&base)? else { return Ok(None) };
        let Some(general) = equations.nullity(&base)? else { return Ok(None) };
        let seed = equations.effort.options.seed.wrapping_add(200 + prime);
        let rng = SearchStream::Minors.under(seed);
        Ok(Some(Self { equations, draws, base, columns, general, rng, number: 0, degree: 1 }))
    }

    /// Fails once the search is to stop.
    pub fn check(&self) -> Result<(), SearchError> {
        self.equations.effort.halt.check()
    }

    /// Returns the prime modulus.
    pub fn modulus(&self) -> Modulus {
        self.base.modulus
    }

    /// Number of parameters that vary.
    pub fn dimension(&self) -> usize {
        self.draws.len()
    }

    /// Draws a random point or direction.
    pub fn random(&mut self) -> Vec<u64> {
        let m = self.modulus();
        self.draws.iter().map(|_| self.rng.element(&m)).collect()
    }

    /// Number of elementary steps for one line.
    pub fn steps(&self) -> f64 {
        let size = ((self.columns.len() - self.general) * self.degree) as f64;
        let columns = self.columns.len() as f64;
        // C⁻¹B and Hessenberg's form take 4/3 + 10/3 + 1/6 multiplications of a size cubed.
        let entries = VALUES[0] as f64 * columns * columns;
        MINORS as f64 * (STEP * 5.0 * size * size * size + ENTRY * entries)
    }

    /// Whether one line takes less than the time of a count.
    fn is_affordable(&self) -> bool {
        self.steps() <= self.equations.effort.seconds * STEPS
    }

    /// Number of independent integrals at a point; `None` where the field has no states.
    pub fn nullity(&self, point: &[u64]) -> Result<Option<usize>, SearchError> {
        self.equations.nullity(&self.at(point))
    }

    fn at(&self, point: &[u64]) -> PrimePoint {
        let mut at = self.base.clone();
        for (draw, value) in self.draws.iter().zip(point) {
            at.parameters[*draw] = *value;
        }
        at
    }

    /// Finds a monic polynomial without repeated factors whose roots t are the points origin + t slope
    /// with more integrals; `None` if the equations are not fractions of low degree, or take too long.
    pub fn special(
        &mut self,
        origin: &[u64],
        slope: &[u64],
    ) -> Result<Option<Polynomial>, SearchError> {
        let ring = PrimePolynomials(self.modulus());
        let mut common: Polynomial = Vec::new();
        let mut poles: Polynomial = Vec::new();
        for _ in 0..MINORS {
            let Some((minor, own)) = self.minor(origin, slope)? else { return Ok(None) };
            common = ring.common(&common, &minor);
            poles = ring.common(&poles, &own);
        }
        // Where all equations have a pole the field has no values.
        loop {
            let shared = ring.common(&common, &poles);
            if shared.len() < 2 {
                break;
            }
            common = ring.divided(&common, &shared).0;
        }
        Ok(Some(ring.monic(&ring.square_free(&common))))
    }

    /// Finds a maximal minor at other states, and the common denominator of its rows.
    fn minor(
        &mut self,
        origin: &[u64],
        slope: &[u64],
    ) -> Result<Option<(Polynomial, Polynomial)>, SearchError> {
        let m = self.modulus();
        let rank = self.columns.len() - self.general;
        self.number += 1;
        let stream = STREAM + self.number;
        let mut order = self.columns.clone();
        for k in (1..order.len()).rev() {
            order.swap(k, (m.to_integer(self.rng.element(&m)) % (k as u64 + 1)) as usize);
        }
        // Each column is one of the monomials and a combination of those that are left over.
        let mixed: Vec<Vec<u64>> = (0..rank)
            .map(|_| (rank..order.len()).map(|_| self.rng.element(&m)).collect())
            .collect();
        let weights: Vec<u64> = (0..rank).map(|_| self.rng.element(&m)).collect();
        let mut samples: Vec<SquareMatrix> = Vec::new();
        for count in VALUES {
            while samples.len() < count {
                self.equations.effort.halt.check()?;
                let t = m.integer(samples.len() as u64);
                let point = m.along(origin, slope, t);
                let at = self.at(&point);
                let Some(rows) = self.equations.system.rows(&at, stream, &order, rank) else {
                    return Ok(None);
                };
                let mix = |row: Vec<u64>| -> Vec<u64> {
                    let (own, others) = row.split_at(rank);
                    let sum = |mixed: &Vec<u64>| {
                        mixed.iter().zip(others).fold(0, |sum, (a, x)| m.add(sum, m.mul(*a, *x)))
                    };
                    own.iter().zip(&mixed).map(|(x, mixed)| m.add(*x, sum(mixed))).collect()
                };
                samples.push(rows.into_iter().map(mix).collect());
            }
            if let Some((matrices, poles)) = self.coefficients(&samples, &weights) {
                self.degree = self.degree.max(matrices.len() - 1);
                if !self.is_affordable() {
                    return Ok(None);
                }
                let halt = &self.equations.effort.halt;
                let minor = pencil::determinant(&m, &matrices, halt)?;
                return Ok(minor.map(|minor| (minor, poles)));
            }
        }
        Ok(None)
    }

    /// Reads matrices off their values at t = 0, 1, …: the coefficients of the numerators of all rows
    /// by powers of t, and the common divisor of the denominators. `None` if the rows are not fractions
    /// of low degree.
    fn coefficients(
        &self,
        samples: &[SquareMatrix],
        weights: &[u64],
    ) -> Option<(Vec<SquareMatrix>, Polynomial)> {
        let m = self.modulus();
        let ring = PrimePolynomials(m);
        let size = weights.len();
        let mut poles: Polynomial = Vec::new();
        let mut below: Vec<Polynomial> = Vec::new();
        let mut degree = 0;
        for row in 0..size {
            // A random combination of the entries has the denominators of all.
            let value = |(t, own): (usize, &SquareMatrix)| {
                let terms = own[row].iter().zip(weights);
                (m.integer(t as u64), terms.fold(0, |sum, (x, w)| m.add(sum, m.mul(*x, *w))))
            };
            let values: Vec<(u64, u64)> = samples.iter().enumerate().map(value).collect();
            let (above, own) = ring.fraction(&values)?;
            degree = degree.max(above.len().saturating_sub(1));
            poles = ring.common(&poles, &own);
            below.push(own);
        }
        let nodes: Vec<u64> = (0..=degree as u64).map(|t| m.integer(t)).collect();
        // Coefficients of the polynomial that is 1 at one node and 0 at the others.
        let basis: Vec<Polynomial> = (0..nodes.len())
            .map(|j| {
                let values = nodes.iter().enumerate();
                let values = values.map(|(k, t)| (*t, if k == j { m.one() } else { 0 }));
                let mut own = ring.through(&values.collect::<Vec<_>>()).0;
                own.resize(nodes.len(), 0);
                own
            })
            .collect();
        let mut found = vec![vec![vec![0; size]; size]; nodes.len()];
        for (row, below) in below.iter().enumerate() {
            for (j, node) in nodes.iter().enumerate() {
                let scale = ring.evaluate(below, *node);
                for (power, matrix) in found.iter_mut().enumerate() {
                    let factor = m.mul(basis[j][power], scale);
                    for (entry, value) in matrix[row].iter_mut().zip(&samples[j][row]) {
                        *entry = m.add(*entry, m.mul(factor, *value));
                    }
                }
            }
        }
        Some((found, poles))
    }
}
