//! Integrals of Hamilton's equations in separable coordinates.
//!
//! If H separates, an integral is Σ (c_a + d_a H + …) xᵃ in one coordinate, its momentum, and their functions
//! alone: in these few variables the degree may be higher than in all of them.

use crate::echelon::nonzero;
use liouville::formula::Formula;
use liouville::mechanics::{BracketBlock, System};
use liouville::order::StableOrder;

use super::super::ansatz::coefficients::{NullVector, Ratio};
use super::super::ansatz::note_unwritten;
use super::super::ansatz::subspace::complement;
use super::super::ansatz::system::{Column, LinearSystem};
use super::super::ask::proved_energy;
use super::super::integrals::tell;
use super::super::terms::one;
use super::super::{SearchError, SearchReport};
use super::claims::{self, OrbitStatement};
use super::images;
use super::known::IndependentIntegrals;
use super::monomials;
use super::setting::{ExtendedCase, OrbitSetting};
use super::sparse::sparse;
use super::{parsed, signed_terms};

/// Highest degree in the variables of one coordinate.
const DEGREE: u32 = 6;
/// Largest number of unknowns.
const UNKNOWNS: usize = 600;
/// Largest number of known integrals that coefficients may contain.
const MOST_KNOWN: usize = 3;

/// Searches for such integrals of a Hamiltonian system, coordinate by coordinate, until there are no more.
pub fn search(
    setting: &OrbitSetting<'_>,
    known: &mut IndependentIntegrals,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let Some(origin) = setting.origin else { return Ok(()) };
    let sets = coordinates(origin);
    let energy = match sets.len() {
        0 | 1 => None,
        _ => proved_energy(origin.case, setting.effort)?,
    };
    let (Some(energy), Some(read)) = (energy, origin.extension.first_known()) else {
        return Ok(());
    };
    // Each in the names of the case, and in those of the extension.
    let mut given = vec![[energy, read.clone()]];
    while given.len() <= MOST_KNOWN && known.algebraic_within(&every(setting)) < sets.len() {
        let mut found = Vec::new();
        for variables in &sets {
            let search = CoordinateSearch { setting, origin, variables };
            found.extend(search.integrals(&given, report)?);
        }
        // One of them, as the coordinates give it in several forms.
        found.order_by_key(|[own, _]| own.text().chars().count());
        let mut is_new = false;
        for own in found {
            if tell_if_proved(setting, origin, &own, known, report)? {
                given.push(own);
                is_new = true;
                break;
            }
        }
        if !is_new {
            break;
        }
    }
    Ok(())
}

/// Reports an integral if it is proved, and independent of others; returns whether it was added.
fn tell_if_proved(
    setting: &OrbitSetting<'_>,
    origin: ExtendedCase<'_>,
    [formula, extended]: &[Formula; 2],
    known: &mut IndependentIntegrals,
    report: &mut SearchReport,
) -> Result<bool, SearchError> {
    setting.effort.halt.check()?;
    let statement = OrbitStatement::Integral(formula.clone());
    let Some(found) = claims::judged_here(setting, &statement)? else { return Ok(false) };
    let before = report.found.len();
    tell(origin.case, formula, found, setting.effort, report)?;
    if report.found.len() == before {
        return Ok(false);
    }
    known.add(extended.clone(), None, &every(setting));
    Ok(true)
}

fn every(setting: &OrbitSetting<'_>) -> Vec<usize> {
    (0..setting.dimension()).collect()
}

/// Variables of the extended state that depend on one coordinate and its momentum alone, with the components
/// that no motion changes.
fn coordinates(origin: ExtendedCase<'_>) -> Vec<Vec<usize>> {
    let System::Hamiltonian(system) = &origin.case.model.system else { return Vec::new() };
    let axes = &origin.extension.axes;
    let starts: Vec<usize> = (origin.case.model.state.iter())
        .scan(0, |next, variable| Some(std::mem::replace(next, *next + variable.len())))
        .collect();
    let depends = |variable: usize, axis: usize| {
        axes[axis].get(variable).is_some_and(|slope| slope.constant().is_none_or(|c| !c.is_zero()))
    };
    let mut sets = Vec::new();
    for (row, blocks) in system.blocks.iter().enumerate() {
        for (column, block) in blocks.iter().enumerate() {
            if !matches!(block, Some(BracketBlock::Unit)) {
                continue;
            }
            for k in 0..origin.case.model.state[row].len() {
                let own = [starts[row] + k, starts[column] + k];
                let variables = axes.first().map_or(0, Vec::len);
                let is_inside = |variable: &usize| {
                    (0..axes.len()).all(|axis| own.contains(&axis) || !depends(*variable, axis))
                };
                sets.push((0..variables).filter(is_inside).collect());
            }
        }
    }
    sets
}

/// The search in the variables of one coordinate.
struct CoordinateSearch<'s, 'c> {
    setting: &'s OrbitSetting<'c>,
    origin: ExtendedCase<'c>,
    variables: &'s [usize],
}

impl CoordinateSearch<'_, '_> {
    /// Candidates, each in the names of the case and in those of the extension.
    fn integrals(
        &self,
        given: &[[Formula; 2]],
        report: &mut SearchReport,
    ) -> Result<Vec<[Formula; 2]>, SearchError> {
        let (setting, effort) = (self.setting, self.setting.effort);
        let factors: Vec<Formula> =
            std::iter::once(one()).chain(given.iter().map(|[_, own]| own.clone())).collect();
        let all = self.monomials(factors.len());
        let mut outputs = Vec::new();
        let mut system = LinearSystem::record(setting.case, effort, |jet, recording| {
            recording.derive(jet.along_field(), &setting.terms, &factors);
            outputs = given.iter().map(|[_, own]| recording.give(jet.phase.scalar(own))).collect();
        })?;
        let places: Vec<(usize, &Vec<u32>)> = (0..factors.len())
            .flat_map(|factor| all.iter().map(move |own| (factor, own)))
            .collect();
        let product = |(factor, own): &(usize, &Vec<u32>)| Column::Product {
            derivation: 0,
            factor: *factor,
            exponents: (*own).clone(),
        };
        system.columns = places.iter().map(product).collect();
        let Some(at) = system.at(0, 0) else { return Ok(Vec::new()) };
        let columns: Vec<usize> = (0..places.len()).collect();
        let Some(distinct) = system.distinct(&at, &columns)? else { return Ok(Vec::new()) };
        // Without the constant, and the known integrals themselves.
        let is_constant = |k: &usize| places[*k].1.iter().all(|power| *power == 0);
        let columns: Vec<usize> = distinct.into_iter().filter(|k| !is_constant(k)).collect();
        let Some(vectors) = system.null_space(&at, &columns)? else { return Ok(Vec::new()) };
        let spread = |own: Vec<u64>| {
            let mut full = vec![0; places.len()];
            columns.iter().zip(own).for_each(|(column, entry)| full[*column] = entry);
            full
        };
        let vectors: Vec<Vec<u64>> = sparse(&at.modulus, vectors).into_iter().map(spread).collect();
        let products: Vec<Vec<usize>> = outputs.iter().map(|output| vec![*output]).collect();
        let new = complement(&system, &at, &vectors, &products)?.unwrap_or_default();
        let mut found = Vec::new();
        for vector in new {
            effort.halt.check()?;
            let support = nonzero(&vector);
            let read = images::coefficients(&NullVector { system: &system, columns: &support })?;
            let Some(coefficients) = read else {
                let what = format!("an integral with {} terms in one coordinate", support.len());
                note_unwritten(setting.case, &what, report);
                continue;
            };
            let functions = setting.functions(support.iter().map(|k| places[*k].1))?;
            let part = |factor: usize| {
                let own = (0..support.len()).filter(|k| places[support[*k]].0 == factor);
                let own: Vec<usize> = own.collect();
                let functions: Vec<Ratio> = own.iter().map(|k| functions[*k].clone()).collect();
                coefficients.sum(&own, &functions)
            };
            let mut parts = Vec::new();
            for factor in 0..factors.len() {
                parts.push(part(factor)?);
            }
            found.extend(self.written(&parts, given)?);
        }
        Ok(found)
    }

    /// The monomials of the highest degree for which the unknowns are few.
    fn monomials(&self, factors: usize) -> Vec<Vec<u32>> {
        let of_degree = |degree: u32| {
            let all = monomials::up_to(self.variables, self.setting.dimension(), degree);
            self.setting.standard(all)
        };
        let mut degrees = (1..=DEGREE).rev().map(of_degree);
        degrees.find(|all| all.len() * factors <= UNKNOWNS).unwrap_or_default()
    }

    /// Writes Σ F_k parts_k, F_0 = 1 and the others the given integrals.
    fn written(
        &self,
        parts: &[Option<Formula>],
        given: &[[Formula; 2]],
    ) -> Result<Option<[Formula; 2]>, SearchError> {
        let case = self.origin.case;
        let mut sums: [Vec<Formula>; 2] = Default::default();
        let factors = std::iter::once(None).chain(given.iter().map(Some));
        for (part, factor) in parts.iter().zip(factors) {
            let Some(part) = part else { continue };
            let Ok(back) = case.formula(&self.origin.extension.back(part)) else { return Ok(None) };
            for (sum, (place, own)) in sums.iter_mut().zip([(0, &back), (1, part)]) {
                sum.push(match factor {
                    None => own.clone(),
                    Some(factor) if signed_terms(own.text()).len() == 1 => {
                        // A name needs no brackets.
                        let is_name = parsed::is_name(factor[place].text());
                        let factor =
                            if is_name { factor[place].clone() } else { factor[place].bracketed() };
                        (own * &factor)?
                    }
                    Some(factor) => (&factor[place].bracketed() * &own.bracketed())?,
                });
            }
        }
        let mut texts = Vec::new();
        for sum in &sums {
            let mut parts = sum.iter();
            let Some(first) = parts.next().cloned() else { return Ok(None) };
            texts.push(parts.try_fold(first, |sum, own| &sum + own)?);
        }
        Ok(texts.try_into().ok())
    }
}
