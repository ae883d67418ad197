//! Polynomial integrals of maps.
//!
//! P∘Φ = P is linear in the coefficients of P: one row for each random point modulo a prime, one column
//! for the change of each monomial. Solutions are kept where their gradients at a random point are
//! independent of those of the known integrals and of each other.

use liouville::formula::FormulaError;
use liouville::graph::Tape;

use super::super::ansatz::coefficients::Ratio;
use super::super::ansatz::monomials::power_product;
use super::super::ansatz::note_unwritten;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::super::terms::recorded;
use super::super::{SearchError, SearchReport};
use super::claims;
use super::images::{self, Images};
use super::known::IndependentIntegrals;
use super::monomials::value;
use super::relations::combined_gradient;
use super::setting::{OrbitSetting, SPARE_ORDERS, run};
use super::sparse::sparse;

/// Changes of monomials along a map.
#[derive(Clone, Copy)]
struct MonomialChanges<'s, 'c> {
    setting: &'s OrbitSetting<'c>,
    /// Monomials without the constant.
    monomials: &'s [Vec<u32>],
    map: &'s Tape,
}

impl MonomialChanges<'_, '_> {
    /// Changes at random points, reduced; `None` if the map has too few points modulo the prime.
    fn echelon(&self, at: &PrimePoint) -> Result<Option<Echelon>, SearchError> {
        let m = at.modulus;
        let mut echelon = Echelon::new(self.monomials.len(), m);
        let wanted = self.monomials.len() + SPARE_ORDERS;
        let mut rows = 0;
        // A root exists at half of all points.
        for number in 0..4 * wanted as u64 {
            self.setting.effort.halt.check()?;
            let Some(point) = self.setting.point(at, number) else { continue };
            let inputs = [point.parameters.as_slice(), &point.state].concat();
            let Some(image) = run(self.map, m, &inputs) else { continue };
            let change =
                |own: &Vec<u32>| m.sub(value(&m, &image, own), value(&m, &point.state, own));
            echelon.push(self.monomials.iter().map(change).collect());
            rows += 1;
            if rows == wanted {
                return Ok(Some(echelon));
            }
        }
        Ok(None)
    }
}

/// Searches for integrals of a map that are sums of these monomials in some variables; the first
/// monomial is the constant. Returns whether some cannot be written.
pub fn polynomials(
    setting: &OrbitSetting<'_>,
    variables: &[usize],
    all: &[Vec<u32>],
    degree: u32,
    known: &mut IndependentIntegrals,
    report: &mut SearchReport,
) -> Result<bool, SearchError> {
    let Some((_, monomials)) = all.split_first() else { return Ok(false) };
    let (graph, map) = recorded(setting.case, |jet| jet.phase.field().to_vec())?;
    let map = Tape::new(&graph, &map);
    let changes = MonomialChanges { setting, monomials, map: &map };
    let Some(at) = setting.at(0, 0) else { return Ok(false) };
    let Some(echelon) = changes.echelon(&at)? else { return Ok(false) };
    let vectors = sparse(&at.modulus, echelon.null_space());
    if vectors.is_empty() {
        return Ok(false);
    }
    let mut is_unwritten = false;
    let Some((point, mut gradients)) = known.gradients(setting, &at)? else { return Ok(false) };
    for vector in vectors {
        setting.effort.halt.check()?;
        let support: Vec<usize> = (0..vector.len()).filter(|k| vector[*k] != 0).collect();
        let picked: Vec<Vec<u32>> = support.iter().map(|k| monomials[*k].clone()).collect();
        let values: Vec<u64> = support.iter().map(|k| vector[*k]).collect();
        if !gradients.push(&at, combined_gradient(&at, &picked, &values, &point)) {
            continue;
        }
        let make = |at: &PrimePoint| {
            let own = MonomialChanges { monomials: &picked, ..changes };
            let vector = own.echelon(at).ok()??.null_space().pop()?;
            (vector.last() == Some(&at.modulus.one())).then_some(vector)
        };
        let images = Images { setting, width: support.len(), is_split: false, make };
        let Some(coefficients) = images::coefficients(&images)? else {
            let what = format!("an integral of degree {degree} with {} terms", support.len());
            note_unwritten(setting.case, &what, report);
            is_unwritten = true;
            continue;
        };
        let functions: Vec<Ratio> = picked
            .iter()
            .map(|own| power_product(&setting.terms, own).map(Ratio::of))
            .collect::<Result<_, FormulaError>>()?;
        let places: Vec<usize> = (0..support.len()).collect();
        let Some(formula) = coefficients.sum(&places, &functions)? else { continue };
        if claims::integral(setting, &formula, report)? {
            known.add(formula, Some(degree), variables);
        }
    }
    Ok(is_unwritten)
}
