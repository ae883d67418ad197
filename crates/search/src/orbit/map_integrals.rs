//! Polynomial integrals of maps.
//!
//! P∘Φ = P is linear in the coefficients of P: one row for each random point modulo a prime, one column
//! for the change of each monomial. Solutions are kept where their gradients at a random point are
//! independent of those of the known integrals and of each other.

use crate::echelon::nonzero;
use liouville::graph::Tape;

use super::super::ansatz::note_unwritten;
use super::super::terms::recorded;
use super::super::{SearchError, SearchReport};
use super::claims;
use super::known::IndependentIntegrals;
use super::map_rows::MapRows;
use super::relations::combined_gradient;
use super::setting::OrbitSetting;
use super::sparse::sparse;

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
    let rows = MapRows { setting, tape: &map, has_density: false };
    let Some(at) = setting.at(0, 0) else { return Ok(false) };
    let Some(echelon) = rows.echelon(&at, monomials)? else { return Ok(false) };
    let vectors = sparse(&at.modulus, echelon.null_space());
    if vectors.is_empty() {
        return Ok(false);
    }
    let mut is_unwritten = false;
    let Some((point, mut gradients)) = known.gradients(setting, &at)? else { return Ok(false) };
    for vector in vectors {
        setting.effort.halt.check()?;
        let support = nonzero(&vector);
        let picked: Vec<Vec<u32>> = support.iter().map(|k| monomials[*k].clone()).collect();
        let values: Vec<u64> = support.iter().map(|k| vector[*k]).collect();
        if !gradients.push(&at, combined_gradient(&at, &picked, &values, &point)) {
            continue;
        }
        let Some(formula) = rows.solution(&picked)? else {
            let what = format!("an integral of degree {degree} with {} terms", support.len());
            note_unwritten(setting.case, &what, report);
            is_unwritten = true;
            continue;
        };
        if claims::integral(setting, &formula, report)? {
            known.add(formula, Some(degree), variables);
        }
    }
    Ok(is_unwritten)
}
