//! Gyroscopic terms up to those that change nothing.
//!
//! A term changes nothing if it adds nothing to the field: the derivative of a function of the positions
//! in a Lagrangian, a Casimir function in a Hamiltonian, a rotor across the face of a flat base. For
//! canonical pairs a change p + ∇φ of the momenta by a gradient adds {φ,H} to H, and a potential of
//! second order.

use super::factors;
use super::gyro_family::GyroFamily;
use super::system::{Column, LinearSystem};
use crate::echelon::Echelon;
use crate::terms::one;
use crate::{Effort, SearchError};
use liouville::case::Case;

/// Number of rows beyond the number of columns.
const SPARE_ROWS: usize = 8;

/// Columns of coefficients of which no combination changes nothing, and that give all others; `None`
/// without values.
pub fn representatives(
    case: &Case,
    effort: &Effort,
    family: &GyroFamily,
) -> Result<Option<Vec<Column>>, SearchError> {
    let all = family.coefficients();
    let dependent = match family.is_canonical {
        true => changed_momenta(case, effort, family, &all)?,
        false => idle(case, effort, family, &all)?,
    };
    Ok(dependent.map(|dependent| {
        let kept = all.into_iter().enumerate().filter(|(k, _)| !dependent.contains(k));
        kept.map(|(_, column)| column).collect()
    }))
}

/// Columns that add to the field what earlier ones add.
fn idle(
    case: &Case,
    effort: &Effort,
    family: &GyroFamily,
    all: &[Column],
) -> Result<Option<Vec<usize>>, SearchError> {
    let dimension = case.model.dimension();
    let mut outcome = Ok(());
    let mut system = LinearSystem::record(case, effort, |jet, recording| {
        let shifts = family.shifts(jet);
        outcome = (0..dimension).try_for_each(|component| {
            family.record(&shifts, jet, recording, &|shift| shift[component])
        });
    })?;
    outcome?;
    let generators = family.count();
    let of_component = |component: usize| {
        all.iter().map(move |column| match column.clone() {
            Column::Product { derivation, factor, exponents } => {
                let derivation = component * generators + derivation;
                Column::Product { derivation, factor, exponents }
            }
            given @ Column::Given(_) => given,
        })
    };
    system.columns = (0..dimension).flat_map(of_component).collect();
    let Some(at) = system.at(0, 0) else { return Ok(None) };
    let count = all.len();
    let mut echelon = Echelon::new(count, at.modulus);
    for component in 0..dimension {
        let columns: Vec<usize> = (component * count..(component + 1) * count).collect();
        let Some(rows) = system.rows(&at, 1, &columns, count + SPARE_ROWS) else {
            return Ok(None);
        };
        for row in rows {
            effort.halt.check()?;
            echelon.push(row);
        }
    }
    Ok(Some(echelon.free()))
}

/// Columns that are sums of earlier ones and of {φ,H} with polynomials φ of the positions.
fn changed_momenta(
    case: &Case,
    effort: &Effort,
    family: &GyroFamily,
    all: &[Column],
) -> Result<Option<Vec<usize>>, SearchError> {
    let over = factors(&[one()])?;
    let terms = &family.variables.terms;
    let mut system = LinearSystem::record(case, effort, |jet, recording| {
        for head in &family.heads {
            recording.multiply(&jet.phase, terms, &over, jet.phase.scalar(head));
        }
        recording.derive(jet.along_field(), terms, &over);
    })?;
    let derivation = family.count();
    let functions = family.variables.monomials(0, 1..=family.degree + 1).into_iter();
    let functions = functions.map(|exponents| Column::Product { derivation, factor: 0, exponents });
    system.columns = functions.collect();
    let first = system.columns.len();
    system.columns.extend_from_slice(all);
    let columns: Vec<usize> = (0..system.columns.len()).collect();
    let Some(at) = system.at(0, 0) else { return Ok(None) };
    let Some(vectors) = system.null_space(&at, &columns)? else { return Ok(None) };
    let last = vectors.iter().filter_map(|own| own.iter().rposition(|entry| *entry != 0));
    Ok(Some(last.filter(|place| *place >= first).map(|place| place - first).collect()))
}
