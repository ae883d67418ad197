//! Integrals of degree at most 1 in the velocities of a Lagrangian system, and functions of constant rate.
//!
//! Coefficients may be any fractions of the parameters: x' − By of a charge, momenta with the weight of
//! their positions, sums of coordinates that a constraint keeps. They come before integrals of degree 2,
//! which may be functions of them and of the energy.

use crate::echelon::nonzero;
use std::collections::BTreeSet;

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError, FormulaResult, Type};
use liouville::graph::Step;
use liouville::mechanics::{Lagrangian, System, VariableRole};
use liouville::number::UnaryFunction;
use liouville::order::StableOrder;
use liouville::verdict::Verdict;

use super::ansatz::coefficients::{NullVector, PrimitiveVector, Ratio};
use super::ansatz::monomials::power_product;
use super::ansatz::subspace::complement;
use super::ansatz::system::{Column, LinearSystem, PrimePoint};
use super::ask::{judged_alone, proved_energy};
use super::integrals::tell_if_proved;
use super::orbit::{coefficients, with_few_entries};
use super::terms::{is_one, one, recorded};
use super::{Effort, Found, FoundKind, Given, SearchError, SearchReport};

/// Largest number of monomials.
const MOST_COLUMNS: usize = 260;
/// Largest number of new integrals, and of known ones that may be rates.
const MOST_INTEGRALS: usize = 12;
/// Largest number of functions of constant rate.
const MOST_RATES: usize = 4;
/// Largest number of terms of one.
const MOST_TERMS: usize = 24;

/// Searches for integrals; proved ones go into the report.
pub fn integrals(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let Some(forms) = LinearForms::of(case, effort, report)? else { return Ok(()) };
    let Some(at) = forms.system.at(0, 0) else { return Ok(()) };
    let Some(columns) = forms.distinct(&at)? else { return Ok(()) };
    let Some(vectors) = forms.system.null_space(&at, &columns)? else { return Ok(()) };
    let vectors = with_few_entries(&at.modulus, vectors);
    let all = forms.spread(&columns, vectors);
    let known: Vec<usize> = forms.known.iter().map(|(_, output)| *output).collect();
    let Some(mut new) = complement(&forms.system, &at, &all, &products(&known))? else {
        return Ok(());
    };
    new.order_by_key(|vector| forms.degree(vector));
    for vector in new.into_iter().take(MOST_INTEGRALS) {
        effort.halt.check()?;
        let support = nonzero(&vector);
        if support.len() > MOST_TERMS {
            continue;
        }
        let source = NullVector { system: &forms.system, columns: &support };
        let Some(found) = coefficients(&source)? else { continue };
        let places: Vec<usize> = (0..support.len()).collect();
        let Some((formula, _)) = found.sum_with_plus(&places, &forms.functions(&support)?)? else {
            continue;
        };
        tell_if_proved(case, &formula, effort, report)?;
    }
    Ok(())
}

/// Searches for functions whose rate is constant along each motion: a number, or a combination of integrals;
/// proved ones that the report does not have go into it.
pub fn rates(case: &Case, effort: &Effort, report: &mut SearchReport) -> Result<(), SearchError> {
    let Some(forms) = LinearForms::of(case, effort, report)? else { return Ok(()) };
    let Some(at) = forms.system.at(0, 0) else { return Ok(()) };
    let Some(mut columns) = forms.distinct(&at)? else { return Ok(()) };
    let first = columns.len();
    // The columns of values: 1, and the integrals.
    columns.extend(forms.monomials.len()..forms.system.columns.len());
    let Some(vectors) = forms.system.null_space(&at, &columns)? else { return Ok(()) };
    let is_driven = |own: &Vec<u64>| {
        own[first..].iter().any(|entry| *entry != 0) && own[..first].iter().any(|entry| *entry != 0)
    };
    let vectors: Vec<Vec<u64>> = vectors.into_iter().filter(is_driven).collect();
    let vectors = with_few_entries(&at.modulus, vectors);
    // What the functions are without their rates.
    let alone = |own: &Vec<u64>| {
        let rest = own.iter().enumerate();
        rest.map(|(k, entry)| if k < first { *entry } else { 0 }).collect::<Vec<u64>>()
    };
    let told: Vec<usize> = forms.known.iter().chain(&forms.driven).map(|(_, at)| *at).collect();
    let mut count = 0;
    let mut before = products(&told);
    before.push(vec![forms.one]);
    let all = forms.spread(&columns, vectors.clone());
    let functions = forms.spread(&columns, vectors.iter().map(alone).collect());
    let Some(new) = complement(&forms.system, &at, &functions, &before)? else { return Ok(()) };
    for (vector, function) in all.into_iter().zip(functions) {
        effort.halt.check()?;
        if count == MOST_RATES {
            break;
        }
        let support = nonzero(&vector);
        if support.len() > MOST_TERMS || !new.contains(&function) {
            continue;
        }
        let source = NullVector { system: &forms.system, columns: &support };
        let Some(found) = coefficients(&source)? else { continue };
        let split = support.iter().take_while(|k| **k < forms.monomials.len()).count();
        let Some((function, rate)) = forms.pair(&support, split, &found)? else { continue };
        // The time.
        if is_one(&rate) && split == 1 {
            continue;
        }
        let judged = judged_alone(case, Claim::rate(&function, &rate), effort)?;
        let Some(judged) = judged.filter(|own| own.verdict == Verdict::Proved) else { continue };
        let with = vec![Given::Rate(rate.clone())];
        let found = Found::new(FoundKind::ConstantRate, &function, None, judged, &case.model);
        report.found.push(Found { with, ..found });
        count += 1;
    }
    Ok(())
}

/// Products of at most two outputs.
fn products(of: &[usize]) -> Vec<Vec<usize>> {
    let own = of.iter().map(|a| vec![*a]);
    let pairs = of.iter().enumerate().flat_map(|(k, a)| of[k..].iter().map(|b| vec![*a, *b]));
    own.chain(pairs).collect()
}

/// Monomials of degree at most 1 in the velocities, with what is known.
struct LinearForms {
    /// Variables in the order of the state, followed by sines, cosines and components of products.
    terms: Vec<Formula>,
    /// Their places among the positions, sines and cosines of them, components of products, and velocities.
    order: Vec<usize>,
    /// Number of variables before the velocities.
    positions: usize,
    monomials: Vec<Vec<u32>>,
    system: LinearSystem,
    /// Known integrals, the energy among them, with their outputs.
    known: Vec<(Formula, usize)>,
    /// Known functions of constant rate with their outputs.
    driven: Vec<(Formula, usize)>,
    /// Output of the number 1.
    one: usize,
}

impl LinearForms {
    /// Sets up the equations; `None` for another system, and where they are too many.
    fn of(
        case: &Case,
        effort: &Effort,
        report: &SearchReport,
    ) -> Result<Option<Self>, SearchError> {
        let System::Lagrangian(lagrangian) = &case.model.system else { return Ok(None) };
        if !case.model.extension.is_empty() {
            return Ok(None);
        }
        let (mut terms, velocities) = variables(case, lagrangian)?;
        terms.extend(circular(case, &terms)?);
        let (plain, mut factors) = (terms.len(), terms.clone());
        factors.extend(crosses(case, lagrangian)?);
        let positions = factors.len();
        let all = [factors, velocities].concat();
        let monomials = monomials(plain, positions, all.len());
        if monomials.len() > MOST_COLUMNS {
            return Ok(None);
        }
        let integrals: Vec<Formula> = proved_energy(case, effort)?
            .into_iter()
            .chain(report.functions(FoundKind::Integral).cloned())
            .take(MOST_INTEGRALS)
            .collect();
        let of_rate = report.found.iter().filter(|own| own.kind == FoundKind::ConstantRate);
        let of_rate: Vec<Formula> = of_rate.filter_map(|own| own.function().cloned()).collect();
        let (mut known, mut driven, mut unit) = (Vec::new(), Vec::new(), 0);
        let made = LinearSystem::record_with_symbols(case, effort, |jet, recording| {
            recording.derive(jet.along_field(), &all, &[one()]);
            unit = recording.give(jet.phase.scalar(&one()));
            let mut give = |own: &Formula| (own.clone(), recording.give(jet.phase.scalar(own)));
            known = integrals.iter().map(&mut give).collect();
            driven = of_rate.iter().map(&mut give).collect();
        });
        let mut system = match made {
            Err(SearchError::NoChart) => return Ok(None),
            made => made?,
        };
        let product =
            |own: &Vec<u32>| Column::Product { derivation: 0, factor: 0, exponents: own.clone() };
        system.columns = monomials.iter().map(product).collect();
        system.columns.push(Column::Given(unit));
        system.columns.extend(known.iter().map(|(_, output)| Column::Given(*output)));
        // Products are written in the order of the state.
        let names = case.model.state_names();
        let place = |own: &Formula| names.iter().position(|name| name == own.text());
        let mut order: Vec<usize> = (0..all.len()).collect();
        order.order_by_key(|k| place(&all[*k]).unwrap_or(names.len()));
        let terms = order.iter().map(|k| all[*k].clone()).collect();
        Ok(Some(Self { terms, order, positions, monomials, system, known, driven, one: unit }))
    }

    /// Columns of monomials that do not depend on others on the level, without the first, 1.
    fn distinct(&self, at: &PrimePoint) -> Result<Option<Vec<usize>>, SearchError> {
        let all: Vec<usize> = (0..self.monomials.len()).collect();
        let kept = self.system.distinct(at, &all)?;
        Ok(kept.map(|own| own.into_iter().filter(|k| *k > 0).collect()))
    }

    /// Vectors on some columns as vectors on all of them.
    fn spread(&self, columns: &[usize], vectors: Vec<Vec<u64>>) -> Vec<Vec<u64>> {
        let full = |own: Vec<u64>| {
            let mut full = vec![0; self.system.columns.len()];
            columns.iter().zip(own).for_each(|(column, entry)| full[*column] = entry);
            full
        };
        vectors.into_iter().map(full).collect()
    }

    /// Degree of a combination in the velocities, and its number of terms.
    fn degree(&self, vector: &[u64]) -> (u32, usize) {
        let used = || (0..self.monomials.len()).filter(|k| vector[*k] != 0);
        let own = |k: usize| self.monomials[k][self.positions..].iter().sum::<u32>();
        (used().map(own).max().unwrap_or(0), used().count())
    }

    /// Functions of some columns.
    fn functions(&self, support: &[usize]) -> Result<Vec<Ratio>, SearchError> {
        let known = |k: usize| self.known.get(k - self.monomials.len() - 1);
        let function = |k: &usize| -> FormulaResult {
            match self.monomials.get(*k) {
                Some(own) => {
                    let ordered: Vec<u32> = self.order.iter().map(|place| own[*place]).collect();
                    power_product(&self.terms, &ordered)
                }
                None if *k == self.monomials.len() => Ok(one()),
                None => Ok(known(*k).map_or_else(one, |(own, _)| own.bracketed())),
            }
        };
        Ok(support.iter().map(|k| function(k).map(Ratio::of)).collect::<Result<_, _>>()?)
    }

    /// A function and its rate, from a vector with the rate's columns from place `split` on.
    fn pair(
        &self,
        support: &[usize],
        split: usize,
        found: &PrimitiveVector,
    ) -> Result<Option<(Formula, Formula)>, SearchError> {
        let functions = self.functions(support)?;
        let (own, rest) = functions.split_at(split);
        let first: Vec<usize> = (0..split).collect();
        let last: Vec<usize> = (split..support.len()).collect();
        let Some((function, is_negative)) = found.sum_with_plus(&first, own)? else {
            return Ok(None);
        };
        // F' + G = 0.
        let Some(sum) = found.sum(&last, rest)? else { return Ok(None) };
        let rate = match is_negative {
            true => sum,
            false => match found.sum_with_plus(&last, rest)? {
                Some((negative, true)) => negative,
                _ if rest.len() == 1 && found.polynomials[split].len() == 1 => -&sum,
                _ => -&sum.bracketed(),
            },
        };
        Ok(Some((function, rate)))
    }
}

/// Positions and velocities of a system.
fn variables(
    case: &Case,
    lagrangian: &Lagrangian,
) -> Result<(Vec<Formula>, Vec<Formula>), FormulaError> {
    let (mut positions, mut velocities) = (Vec::new(), Vec::new());
    let mut components = case.model.state_formulas()?.into_iter();
    for (role, variable) in lagrangian.roles.iter().zip(&case.model.state) {
        let own = components.by_ref().take(variable.len());
        match role {
            VariableRole::Velocity | VariableRole::Multiplier(_) => velocities.extend(own),
            _ => positions.extend(own),
        }
    }
    Ok((positions, velocities))
}

/// Sines and cosines in the field of positions.
fn circular(case: &Case, positions: &[Formula]) -> Result<Vec<Formula>, SearchError> {
    let (graph, (field, given)) = recorded(case, |jet| {
        let given: Vec<_> = positions.iter().map(|own| jet.phase.scalar(own)).collect();
        (jet.phase.field().to_vec(), given)
    })?;
    let reached = graph.reached(field);
    let mut angles = BTreeSet::new();
    for place in (0..graph.len()).filter(|place| reached[*place]) {
        if let Step::Unary(UnaryFunction::Sin | UnaryFunction::Cos, argument) = graph.step(place) {
            angles.extend(given.iter().position(|own| graph.place(*own) == argument));
        }
    }
    let both = |k: &usize| ["sin", "cos"].map(|name| Formula::call(name, &[&positions[*k]]));
    Ok(angles.iter().flat_map(both).collect::<Result<_, _>>()?)
}

/// Components of a × b for two vectors that the motion carries along.
fn crosses(case: &Case, lagrangian: &Lagrangian) -> Result<Vec<Formula>, SearchError> {
    let roles = lagrangian.roles.iter().zip(case.model.state_variables());
    let carried = roles.filter(|(role, variable)| {
        matches!(role, VariableRole::Carried(_)) && variable.value_type() == Type::VECTOR
    });
    let [a, b] = &carried.map(|(_, own)| own).collect::<Vec<_>>()[..] else {
        return Ok(Vec::new());
    };
    let product = (a.cross(b)?).bracketed();
    Ok((1..=3).map(|k| product.component(&[k])).collect::<Result<_, _>>()?)
}

/// Exponents of 1, the positions and their products, and each velocity times 1 or a position; of `all`
/// variables the first `plain` are positions, and the velocities begin at `positions`.
fn monomials(plain: usize, positions: usize, all: usize) -> Vec<Vec<u32>> {
    let with = |places: &[usize]| {
        let mut own = vec![0; all];
        places.iter().for_each(|k| own[*k] += 1);
        own
    };
    let mut found = vec![with(&[])];
    found.extend((0..plain).map(|k| with(&[k])));
    for k in 0..plain {
        found.extend((k..plain).map(|other| with(&[k, other])));
    }
    found.extend((positions..all).map(|w| with(&[w])));
    for w in positions..all {
        found.extend((0..positions).map(|k| with(&[k, w])));
    }
    found
}
