//! Polynomial integrals of one degree, on levels too.
//!
//! A row is one random state modulo a prime, a column the rate of one monomial. Monomials whose
//! values depend on those of others on the level are left out.

use super::super::ansatz::coefficients::NullVector;
use super::super::ansatz::note_unwritten;
use super::super::ansatz::subspace::complement;
use super::super::ansatz::system::{Column, LinearSystem};
use super::super::terms::one;
use super::super::{SearchError, SearchReport};
use super::claims;
use super::images;
use super::known::IndependentIntegrals;
use super::setting::OrbitSetting;
use super::sparse::sparse;
use crate::echelon::nonzero;
use liouville::formula::Formula;

/// Largest degree of integrals that are sought although they are functions of those known.
pub const LOW: u32 = 3;
/// Largest number of terms of an integral that is kept although it is a function of others.
const SHORT: usize = 12;
/// Largest number of these.
const MOST_DEPENDENT: usize = 12;

/// Searches for integrals that are sums of these monomials in some variables, of at most this degree;
/// returns whether some cannot be written.
pub fn polynomials(
    setting: &OrbitSetting<'_>,
    variables: &[usize],
    all: &[Vec<u32>],
    degree: u32,
    known: &mut IndependentIntegrals,
    report: &mut SearchReport,
) -> Result<bool, SearchError> {
    let (case, effort) = (setting.case, setting.effort);
    let given: Vec<Formula> = known.algebraic(variables).cloned().collect();
    let mut outputs = Vec::new();
    let mut system = LinearSystem::record(case, effort, |jet, recording| {
        recording.derive(jet.along_field(), &setting.terms, &[one()]);
        outputs = given.iter().map(|term| recording.give(jet.phase.scalar(term))).collect();
    })?;
    let product = |exponents| Column::Product { derivation: 0, factor: 0, exponents };
    system.columns = all.iter().cloned().map(product).collect();
    let Some(at) = system.at(0, 0) else { return Ok(false) };
    let every: Vec<usize> = (0..all.len()).collect();
    let columns = match setting.is_on_level() {
        false => every,
        true => match system.distinct(&at, &every)? {
            Some(columns) => columns,
            None => return Ok(false),
        },
    };
    // The constant is the first.
    let columns = &columns[1..];
    let Some(vectors) = system.null_space(&at, columns)? else { return Ok(false) };
    let vectors = sparse(&at.modulus, vectors);
    let spread = |own: Vec<u64>| {
        let mut full = vec![0; all.len()];
        columns.iter().zip(own).for_each(|(column, entry)| full[*column] = entry);
        full
    };
    let vectors: Vec<Vec<u64>> = vectors.into_iter().map(spread).collect();
    let products: Vec<Vec<usize>> = known
        .products(degree, variables)
        .into_iter()
        .map(|powers| {
            let own = powers.iter().zip(&outputs);
            own.flat_map(|(power, output)| vec![*output; *power as usize]).collect()
        })
        .collect();
    let Some(new) = complement(&system, &at, &vectors, &products)? else { return Ok(false) };
    let mut is_unwritten = false;
    for vector in new {
        effort.halt.check()?;
        let support = nonzero(&vector);
        let Some(coefficients) =
            images::coefficients(&NullVector { system: &system, columns: &support })?
        else {
            let what = format!("an integral of degree {degree} with {} terms", support.len());
            note_unwritten(case, &what, report);
            is_unwritten = true;
            continue;
        };
        let functions = setting.functions(support.iter().map(|k| &all[*k]))?;
        let sum = coefficients.sum(&(0..support.len()).collect::<Vec<_>>(), &functions)?;
        let Some(formula) = sum else { continue };
        if claims::integral(setting, &formula, report)? {
            known.add(formula, Some(degree), variables);
        } else if degree <= LOW
            && variables.len() == setting.dimension()
            && support.len() <= SHORT
            && report.dependent.len() < MOST_DEPENDENT
        {
            report.dependent.extend(claims::written_integral(setting, &formula));
        }
    }
    Ok(is_unwritten)
}
