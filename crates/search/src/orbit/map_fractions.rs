//! Densities of maps that are fractions P/Q of polynomials.
//!
//! With w ↦ w/det DΦ beside Φ, ρ = P/Q is a density if wQ/P is an integral: along each orbit wQ − cP
//! vanishes, with the value c of the integral there. So Q and P are read off the relations between the
//! monomials and their multiples by w, in the lowest degree in which there is one alone.

use liouville::formula::Formula;
use liouville::graph::Tape;

use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::super::{FoundKind, SearchError, SearchReport};
use super::claims::{self, OrbitStatement};
use super::images::{self, Images};
use super::monomials::{self, value};
use super::setting::{OrbitSetting, SPARE_ORDERS, run};

/// Largest number of monomials of P and Q together.
const MONOMIALS: usize = 240;
/// Largest degree of P and Q.
const DEGREE: u32 = 8;

/// Searches for a density; `tape` has the images and the factor of expansion.
pub fn density(
    setting: &OrbitSetting<'_>,
    tape: &Tape,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<bool, SearchError> {
    let variables: Vec<usize> = (0..setting.dimension()).collect();
    for degree in 1..=DEGREE {
        if 2 * monomials::count(setting.dimension(), degree) > MONOMIALS {
            break;
        }
        progress(&format!("densities of the map, fractions of degree {degree}"));
        let all = monomials::up_to(&variables, setting.dimension(), degree);
        for is_negative in [false, true] {
            setting.effort.halt.check()?;
            let search = FractionSearch { setting, tape, is_negative };
            if let Some([above, below]) = search.supports(&all)? {
                return search.tell(&above, &below, report);
            }
        }
    }
    Ok(false)
}

struct FractionSearch<'s, 'c> {
    setting: &'s OrbitSetting<'c>,
    tape: &'s Tape,
    /// Whether the density changes its sign.
    is_negative: bool,
}

type Monomials = Vec<Vec<u32>>;

impl FractionSearch<'_, '_> {
    /// The relations w Q − c P along the orbit of a number, as coefficients of P and then of Q.
    fn relations(
        &self,
        at: &PrimePoint,
        number: u64,
        above: &[Vec<u32>],
        below: &[Vec<u32>],
    ) -> Result<Option<Vec<Vec<u64>>>, SearchError> {
        let m = at.modulus;
        let Some(mut point) = self.setting.point(at, number) else { return Ok(None) };
        let width = above.len() + below.len();
        let (mut echelon, mut factor) = (Echelon::new(width, m), m.one());
        for _ in 0..width + SPARE_ORDERS {
            self.setting.effort.halt.check()?;
            let upper = above.iter().map(|own| value(&m, &point.state, own));
            let lower = below.iter().map(|own| m.mul(factor, value(&m, &point.state, own)));
            echelon.push(upper.chain(lower).collect());
            let inputs = [point.parameters.as_slice(), &point.state].concat();
            let Some(mut image) = run(self.tape, m, &inputs) else { return Ok(None) };
            let Some(growth) = image.pop().filter(|own| *own != 0) else { return Ok(None) };
            let growth = if self.is_negative { m.sub(0, growth) } else { growth };
            factor = m.mul(factor, m.inverse(growth));
            point.state = image;
        }
        Ok(Some(echelon.null_space()))
    }

    /// Coefficients of P, and of Q, each with 1 as the last that is not 0.
    fn fraction(
        &self,
        at: &PrimePoint,
        above: &[Vec<u32>],
        below: &[Vec<u32>],
    ) -> Result<Option<Vec<u64>>, SearchError> {
        let m = at.modulus;
        let Some(mut found) = self.relations(at, 0, above, below)? else { return Ok(None) };
        let Some(vector) = found.pop().filter(|_| found.is_empty()) else { return Ok(None) };
        let (upper, lower) = vector.split_at(above.len());
        let scaled = |own: &[u64]| -> Option<Vec<u64>> {
            let last = own.iter().rev().find(|entry| **entry != 0)?;
            let inverse = m.inverse(*last);
            Some(own.iter().map(|entry| m.mul(*entry, inverse)).collect())
        };
        Ok(scaled(upper).zip(scaled(lower)).map(|(upper, lower)| [upper, lower].concat()))
    }

    /// Monomials of P and Q, if they are unique.
    fn supports(&self, all: &[Vec<u32>]) -> Result<Option<[Monomials; 2]>, SearchError> {
        let Some(at) = self.setting.at(0, 0) else { return Ok(None) };
        let Some(vector) = self.fraction(&at, all, all)? else { return Ok(None) };
        let used = |own: &[u64]| -> Monomials {
            let own = all.iter().zip(own).filter(|(_, entry)| **entry != 0);
            own.map(|(monomial, _)| monomial.clone()).collect()
        };
        let (upper, lower) = vector.split_at(all.len());
        Ok(Some([used(upper), used(lower)]))
    }

    fn tell(
        &self,
        above: &[Vec<u32>],
        below: &[Vec<u32>],
        report: &mut SearchReport,
    ) -> Result<bool, SearchError> {
        let setting = self.setting;
        let part = |monomials: &[Vec<u32>], first: usize| -> Result<Option<Formula>, SearchError> {
            let make = |at: &PrimePoint| {
                let mut vector = self.fraction(at, above, below).ok()??;
                Some(vector.drain(first..first + monomials.len()).collect())
            };
            let images = Images { setting, width: monomials.len(), is_split: false, make };
            let Some(coefficients) = images::coefficients(&images)? else { return Ok(None) };
            let functions = setting.functions(monomials)?;
            Ok(coefficients.sum(&(0..monomials.len()).collect::<Vec<_>>(), &functions)?)
        };
        let Some(upper) = part(above, 0)? else { return Ok(false) };
        let Some(lower) = part(below, above.len())? else { return Ok(false) };
        let density = (upper.bracketed() / &lower.bracketed())?;
        let statement = OrbitStatement::Density(density.clone());
        claims::other(setting, FoundKind::Density, &density, &statement, None, report)
    }
}
