//! Rational integrals from relations along orbits.
//!
//! An integral P/Q gives the relation P − c Q on each orbit, with c its value there. The reduced
//! relations of the orbit of q have coefficients that are functions of q and integrals themselves.
//! Where the relations that begin with one monomial span a plane, P and Q are a basis of it, and no
//! function of q has to be known. Elsewhere a coefficient c(q) is interpolated: A(q) − c(q) B(q) = 0
//! at random q.

use liouville::order::StableOrder;
use liouville::proof::reduce;

use super::super::ansatz::note_unwritten;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::{Echelon, nonzero};
use super::super::{SearchError, SearchReport};
use super::fraction::MonomialFraction;
use super::images::{self, Images};
use super::known::IndependentIntegrals;
use super::monomials::{self, value};
use super::setting::{OrbitRelations, OrbitSetting, SPARE_ORDERS};

/// Number of orbits whose relations are compared.
const ORBITS: u64 = 4;
/// Largest number of unknowns of an interpolation.
const UNKNOWNS: usize = 120;
/// Largest number of terms of a relation of which a coefficient is interpolated.
const TERMS: usize = 40;

/// The search for rational integrals in some variables.
pub struct RationalSearch<'s, 'c> {
    /// Case with its points.
    pub setting: &'s OrbitSetting<'c>,
    /// Variables of the integrals.
    pub variables: &'s [usize],
    /// Monomials of the relations.
    pub monomials: &'s [Vec<u32>],
    /// Their highest degree.
    pub degree: u32,
}

impl RationalSearch<'_, '_> {
    /// Searches for integrals until the number of independent algebraic integrals is reached; returns
    /// whether one was found.
    pub fn search(
        &self,
        at: &PrimePoint,
        first: &OrbitRelations,
        wanted: usize,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<bool, SearchError> {
        let mut found = false;
        for interpolated in [false, true] {
            for (vector, own) in first.vectors.iter().zip(&first.free) {
                if known.algebraic_within(self.variables) >= wanted {
                    return Ok(found);
                }
                let divides = |k: &usize| {
                    let pairs = self.monomials[*k].iter().zip(&self.monomials[*own]);
                    *k != *own && pairs.into_iter().all(|(a, b)| a <= b)
                };
                // Relations of lower degree, and their multiples, were looked at before.
                let degree = self.monomials[*own].iter().sum::<u32>();
                if degree < self.degree || first.free.iter().any(divides) {
                    continue;
                }
                let support = nonzero(vector);
                let one = LeadingRelations { of: self, support: self.picked(&support) };
                found |= one.search(at, interpolated, known, report)?;
            }
        }
        Ok(found)
    }

    /// Searches in another order of the monomials, on which the reduced relations depend: there may be
    /// shorter ones.
    pub fn search_in_other_order(
        &self,
        at: &PrimePoint,
        wanted: usize,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let mut monomials = self.monomials.to_vec();
        monomials.order_by_key(|own| (own.iter().sum::<u32>(), own.clone()));
        if let Some(relations) = self.setting.relations(at, 0, &monomials)? {
            let other = RationalSearch { monomials: &monomials, ..*self };
            other.search(at, &relations, wanted, known, report)?;
        }
        Ok(())
    }

    fn picked(&self, support: &[usize]) -> Vec<Vec<u32>> {
        support.iter().map(|k| self.monomials[*k].clone()).collect()
    }
}

/// The relations with one leading monomial, the last of their support.
struct LeadingRelations<'r, 's, 'c> {
    of: &'r RationalSearch<'s, 'c>,
    support: Vec<Vec<u32>>,
}

/// Coefficients of a relation, and the state of its point.
type Along = (Vec<u64>, Vec<u64>);
/// Monomials of a numerator and of a denominator.
type Supports = (Vec<Vec<u32>>, Vec<Vec<u32>>);

impl LeadingRelations<'_, '_, '_> {
    /// The relation along the orbit of a number, 1 at its last monomial, with the point.
    fn along(&self, at: &PrimePoint, number: u64) -> Result<Option<Along>, SearchError> {
        let Some(all) = self.of.setting.relations(at, number, &self.support)? else {
            return Ok(None);
        };
        let last = self.support.len() - 1;
        let found = all.vectors.into_iter().zip(all.free).find(|(_, own)| *own == last);
        Ok(found.map(|(vector, _)| (vector, all.point.state)))
    }

    /// The space that the relations of several orbits span, in reduced form.
    fn span(&self, at: &PrimePoint) -> Result<Vec<Vec<u64>>, SearchError> {
        let mut vectors = Vec::new();
        for number in 0..ORBITS {
            self.of.setting.effort.halt.check()?;
            vectors.extend(self.along(at, number)?.map(|(vector, _)| vector));
        }
        Ok(reduce(vectors, self.support.len(), &at.modulus).1)
    }

    fn search(
        &self,
        at: &PrimePoint,
        interpolated: bool,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<bool, SearchError> {
        let span = self.span(at)?;
        match (span.len(), interpolated) {
            (2, false) => self.pencil(&span, known, report),
            (3.., true) if self.support.len() <= TERMS => {
                self.interpolated(at, &span, known, report)
            }
            _ => Ok(false),
        }
    }

    /// P/Q from the plane of the relations.
    fn pencil(
        &self,
        span: &[Vec<u64>],
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<bool, SearchError> {
        let used = |row: &Vec<u64>| nonzero(row);
        // The shorter polynomial is the denominator.
        let (upper, lower) =
            if used(&span[0]).len() < used(&span[1]).len() { (1, 0) } else { (0, 1) };
        let (above, below) = (used(&span[upper]), used(&span[lower]));
        let make = |at: &PrimePoint| {
            let span = self.span(at).ok().filter(|span| span.len() == 2)?;
            let own = above.iter().map(|k| span[upper][*k]);
            Some(own.chain(below.iter().map(|k| span[lower][*k])).collect())
        };
        let width = above.len() + below.len();
        let images = Images { setting: self.of.setting, width, is_split: false, make };
        let picked = |own: &[usize]| own.iter().map(|k| self.support[*k].clone()).collect();
        let fraction = MonomialFraction { above: picked(&above), below: picked(&below) };
        let coefficients = images::coefficients(&images)?;
        if coefficients.is_none() {
            let what = format!("a rational integral of degree {}", self.of.degree);
            note_unwritten(self.of.setting.case, &what, report);
        }
        self.of.tell(&fraction, coefficients, known, report)
    }

    /// A coefficient of the relation as a function of the point.
    fn interpolated(
        &self,
        at: &PrimePoint,
        span: &[Vec<u64>],
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<bool, SearchError> {
        let setting = self.of.setting;
        let last = self.support.len() - 1;
        let constant = |k: &usize| span.iter().filter(|row| row[*k] != 0).count() == 0;
        let mut found = false;
        for place in (0..last).filter(|k| !constant(k)) {
            setting.effort.halt.check()?;
            if !setting.steps.takes(0.0) {
                break;
            }
            // The others have the same degree, or more.
            let Some((above, below)) = self.lowest(at, place)? else { break };
            let make = |at: &PrimePoint| self.fraction(at, place, &above, &below).ok().flatten();
            let width = above.len() + below.len();
            let images = Images { setting, width, is_split: false, make };
            let coefficients = images::coefficients(&images)?;
            let fraction = MonomialFraction { above: above.clone(), below: below.clone() };
            found |= self.of.tell(&fraction, coefficients, known, report)?;
        }
        Ok(found)
    }

    /// Monomials of numerator and denominator of a coefficient, of the lowest degree.
    fn lowest(&self, at: &PrimePoint, place: usize) -> Result<Option<Supports>, SearchError> {
        let dimension = self.of.setting.dimension();
        for degree in 1.. {
            let all = monomials::up_to(self.of.variables, dimension, degree);
            if 2 * all.len() > UNKNOWNS {
                return Ok(None);
            }
            if let Some(vector) = self.fraction(at, place, &all, &all)? {
                let (above, below) = vector.split_at(all.len());
                let used = |part: &[u64]| -> Vec<Vec<u32>> {
                    let own = all.iter().zip(part).filter(|(_, entry)| **entry != 0);
                    own.map(|(monomial, _)| monomial.clone()).collect()
                };
                return Ok(Some((used(above), used(below))));
            }
        }
        Ok(None)
    }

    /// Coefficients of A and B with A(q) − c(q) B(q) = 0, where they are unique up to a factor.
    fn fraction(
        &self,
        at: &PrimePoint,
        place: usize,
        above: &[Vec<u32>],
        below: &[Vec<u32>],
    ) -> Result<Option<Vec<u64>>, SearchError> {
        let m = at.modulus;
        let width = above.len() + below.len();
        let mut echelon = Echelon::new(width, m);
        for number in 0..(width + SPARE_ORDERS) as u64 {
            let Some((vector, point)) = self.along(at, number)? else { continue };
            let minus = m.sub(0, vector[place]);
            let upper = above.iter().map(|own| value(&m, &point, own));
            let lower = below.iter().map(|own| m.mul(minus, value(&m, &point, own)));
            echelon.push(upper.chain(lower).collect());
        }
        let mut vectors = echelon.null_space();
        let is_fraction = |vector: &Vec<u64>| vector[..above.len()].iter().any(|entry| *entry != 0);
        Ok(match vectors.len() {
            1 => vectors.pop().filter(is_fraction),
            _ => None,
        })
    }
}
