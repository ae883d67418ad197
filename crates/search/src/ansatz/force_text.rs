//! Forces that preserve an integral, written with free constants and arbitrary functions.
//!
//! If potentials h₁, h₂, … survive with gains G = c hₖ with one constant c, then f(h₁, h₂, …) survives
//! with c f for each smooth f: A(∇f) = Σ ∂f/∂hₖ A(∇hₖ) and L_v f = Σ ∂f/∂hₖ L_v hₖ. If a force Q has no
//! gain, then f Q survives for each function f of the positions.

use super::at_random::values_at_random;
use super::force_family::{ForceEntry, ForceFamily};
use super::forces::{free_names, with_constants, with_numbers, with_potential, with_rates};
use crate::echelon::Echelon;
use crate::streams::SearchStream;
use crate::terms::recorded;
use crate::{Effort, SearchError};
use liouville::case::Case;
use liouville::formula::{Formula, FormulaError};
use liouville::graph::Expr;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// A force under which an integral survives.
#[derive(Clone, Debug)]
pub struct SurvivingForce {
    /// The potential, or the terms of the rates of all components that a force acts on.
    pub parts: Vec<Option<Formula>>,
    /// Term G that is added to the integral, if any.
    pub gain: Option<Formula>,
    /// Constant c with G = c U, where there is one; 0 without a gain.
    pub ratio: Option<Formula>,
}

/// Forces of which any function survives, too.
struct Family<'f> {
    /// Constant c with G = c U for each of them; `None` for a force without a gain.
    ratio: Option<&'f Formula>,
    heads: Vec<&'f SurvivingForce>,
}

/// Forces divided into families with arbitrary functions, and those with a constant.
struct Division<'f> {
    families: Vec<Family<'f>>,
    plain: Vec<&'f SurvivingForce>,
}

/// An integral with forces that it survives.
pub struct ForcedIntegral {
    /// Case with all forces, each with a free number.
    pub case: Case,
    /// Integral in the names of this case.
    pub judged: Formula,
    /// Text of the integral, with arbitrary functions.
    pub integral: String,
    /// Text of the forces, with arbitrary functions.
    pub force: String,
    /// Whether each potential survives.
    pub is_whole: bool,
}

impl ForcedIntegral {
    /// Makes the integral of forces that all survive; `None` if the system does not take them.
    pub fn of(
        case: &Case,
        family: &ForceFamily,
        integral: &Formula,
        all: &[SurvivingForce],
        effort: &Effort,
    ) -> Result<Option<Self>, SearchError> {
        let division = Division::of(case, family, all, effort)?;
        let Some(changed) = division.judged(case, family, integral)? else { return Ok(None) };
        let (case_with, judged) = changed;
        let is_potential = matches!(family.entry, ForceEntry::Potential(_));
        let positions = family.variables.positions().len();
        let mut are_whole = Vec::new();
        for own in &division.families {
            let rank = rank(case, family, &own.heads, effort)?;
            are_whole.push(is_potential && rank.is_some_and(|rank| rank.all == positions));
        }
        let is_whole = are_whole.contains(&true);
        let (integral, force) = division.shown(case, family, integral, &are_whole)?;
        Ok(Some(Self { case: case_with, judged, integral, force, is_whole }))
    }
}

impl<'f> Division<'f> {
    fn of(
        case: &Case,
        family: &ForceFamily,
        all: &'f [SurvivingForce],
        effort: &Effort,
    ) -> Result<Self, SearchError> {
        let mut own = Self { families: Vec::new(), plain: Vec::new() };
        let is_potential = matches!(family.entry, ForceEntry::Potential(_));
        for force in all {
            let (is_member, ratio) = match is_potential {
                true => (force.ratio.is_some(), force.ratio.as_ref()),
                false => (force.gain.is_none(), None),
            };
            if !is_member {
                own.plain.push(force);
                continue;
            }
            let same = |family: &&mut Family<'f>| {
                family.ratio.map(Formula::text) == ratio.map(Formula::text)
            };
            match own.families.iter_mut().find(same) {
                None => own.families.push(Family { ratio, heads: vec![force] }),
                Some(before) => {
                    before.heads.push(force);
                    let rank = rank(case, family, &before.heads, effort)?;
                    if rank.is_none_or(|rank| rank.all < before.heads.len() + rank.level) {
                        before.heads.pop();
                    }
                }
            }
        }
        Ok(own)
    }

    /// All forces, one for each free number.
    fn forces(&self) -> Vec<&'f SurvivingForce> {
        let heads = self.families.iter().flat_map(|family| family.heads.iter().copied());
        heads.chain(self.plain.iter().copied()).collect()
    }

    /// The case with all forces, and the integral; `None` if the system does not take them.
    fn judged(
        &self,
        case: &Case,
        family: &ForceFamily,
        integral: &Formula,
    ) -> Result<Option<(Case, Formula)>, SearchError> {
        let forces = self.forces();
        let (mut changed, constants) = with_constants(case, "ε", forces.len())?;
        let pairs = || constants.iter().zip(&forces);
        let gains = pairs().filter_map(|(constant, own)| Some((constant, own.gain.as_ref()?)));
        let judged = joined(Some(integral), gains)?.unwrap_or_else(|| integral.clone());
        let part = |way: usize| {
            joined(None, pairs().filter_map(|(e, own)| Some((e, own.parts[way].as_ref()?))))
        };
        let model = match &family.entry {
            ForceEntry::Potential(_) => {
                part(0)?.and_then(|potential| with_potential(&changed.model, &potential))
            }
            ForceEntry::Rates(components) => {
                let mut terms = Vec::new();
                for (way, component) in components.iter().enumerate() {
                    terms.extend(part(way)?.map(|term| (*component, term)));
                }
                with_rates(&changed.model, &terms)
            }
        };
        let Some(model) = model else { return Ok(None) };
        changed.model = model;
        Ok(Some((changed, judged)))
    }

    /// Texts of the integral and of the forces, with functions in place of constants.
    fn shown(
        &self,
        case: &Case,
        family: &ForceFamily,
        integral: &Formula,
        are_whole: &[bool],
    ) -> Result<(String, String), SearchError> {
        let is_potential = matches!(family.entry, ForceEntry::Potential(_));
        let one = Formula::number(1);
        // What each letter stands for, with its part of each rate and its gain.
        let mut calls: Vec<String> = Vec::new();
        let mut terms: Vec<(Vec<Option<&Formula>>, Option<&Formula>)> = Vec::new();
        for (own, is_whole) in self.families.iter().zip(are_whole) {
            if is_potential {
                let heads = own.heads.iter().filter_map(|head| head.parts[0].as_ref());
                let heads: Vec<String> = heads.map(ToString::to_string).collect();
                let whole = is_whole.then(|| family.names.clone());
                calls.push(format!("({})", whole.unwrap_or_else(|| heads.join(", "))));
                terms.push((vec![Some(&one)], own.ratio));
            } else {
                for head in &own.heads {
                    calls.push(format!("({})", family.names));
                    terms.push((head.parts.iter().map(Option::as_ref).collect(), None));
                }
            }
        }
        let letters = free_names(case, "f", calls.len());
        for own in &self.plain {
            terms.push((own.parts.iter().map(Option::as_ref).collect(), own.gain.as_ref()));
        }
        let numbers = free_names(case, "ε", self.plain.len());
        let names: Vec<String> = letters.iter().chain(&numbers).cloned().collect();
        let (_, symbols) = with_numbers(case, &names)?;
        let calls: Vec<(String, String)> = (letters.iter().zip(calls))
            .map(|(letter, call)| (letter.clone(), format!("{letter}{call}")))
            .collect();
        let pairs = || symbols.iter().zip(&terms);
        let gains = pairs().filter_map(|(symbol, (_, gain))| Some((symbol, (*gain)?)));
        let text = joined(Some(integral), gains)?.unwrap_or_else(|| integral.clone());
        let mut parts = Vec::new();
        for way in 0..family.ways() {
            let own = pairs().filter_map(|(symbol, (parts, _))| Some((symbol, parts[way]?)));
            let Some(part) = joined(None, own)? else { continue };
            let part = with_calls(part.text(), &calls);
            parts.push(match &family.entry {
                ForceEntry::Potential(_) => part,
                ForceEntry::Rates(components) => {
                    let rate = &family.variables.terms[components[way]];
                    format!("{part} in the rate of {rate}")
                }
            });
        }
        let functions = match letters.as_slice() {
            [] => String::new(),
            [only] => format!(" for any function {only}"),
            several => format!(" for any functions {}", several.join(", ")),
        };
        Ok((with_calls(text.text(), &calls), format!("{}{functions}", parts.join(", "))))
    }
}

/// Writes calls in place of names in a text.
fn with_calls(text: &str, calls: &[(String, String)]) -> String {
    let is_letter = |letter: &char| letter.is_alphanumeric() || *letter == '_';
    let mut written = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|letter: char| is_letter(&letter)) {
        let (before, word_on) = rest.split_at(start);
        let end = word_on.find(|letter: char| !is_letter(&letter)).unwrap_or(word_on.len());
        let (word, after) = word_on.split_at(end);
        let call = calls.iter().find(|(name, _)| name == word);
        written.push_str(before);
        written.push_str(call.map_or(word, |(_, call)| call));
        rest = after;
    }
    written + rest
}

/// A formula plus Σ constant · part; `None` for an empty sum.
fn joined<'t>(
    first: Option<&Formula>,
    parts: impl Iterator<Item = (&'t Formula, &'t Formula)>,
) -> Result<Option<Formula>, FormulaError> {
    let mut sum = first.cloned();
    for (constant, part) in parts {
        let number = part.constant();
        let is_negative = number.as_ref().is_some_and(Rational::is_negative);
        let term = match number {
            Some(number) if number.is_zero() => continue,
            Some(number) => {
                let size = number.abs();
                match size == Rational::from(1) {
                    true => constant.clone(),
                    false => (Formula::number(size) * constant)?,
                }
            }
            None => (constant * part.bracketed())?,
        };
        sum = Some(match (sum, is_negative) {
            (None, false) => term,
            (None, true) => -&term,
            (Some(before), false) => (&before + &term)?,
            (Some(before), true) => (&before - &term)?,
        });
    }
    Ok(sum)
}

/// Ranks of gradients or of forces.
struct Ranks {
    /// Rank together with the functions of the level that depend on the positions alone.
    all: usize,
    /// Rank of these functions of the level.
    level: usize,
}

/// Ranks of the gradients of potentials, or of forces, at a random state modulo a prime; `None` if there
/// is no value.
fn rank(
    case: &Case,
    family: &ForceFamily,
    rows: &[&SurvivingForce],
    effort: &Effort,
) -> Result<Option<Ranks>, SearchError> {
    let zero = Formula::number(0);
    let positions = family.variables.positions();
    let dimension = case.model.dimension();
    let (graph, values) = recorded(case, |jet| match family.entry {
        ForceEntry::Potential(_) => {
            // By level function and force, the derivatives along all components of the state.
            let along = |place: usize| {
                let unit =
                    (0..dimension).map(|k| Expr::rational(&Rational::from(i64::from(k == place))));
                jet.phase.lift(&unit.collect::<Vec<_>>())
            };
            let moved: Vec<_> = (0..dimension).map(along).collect();
            let mut values = Vec::new();
            for own in &case.model.level {
                values.extend(moved.iter().map(|at| at.level_function(&own.function).eps));
            }
            for own in rows {
                let part = own.parts[0].as_ref().unwrap_or(&zero);
                values.extend(moved.iter().map(|at| at.scalar(part).eps));
            }
            values
        }
        ForceEntry::Rates(_) => {
            let parts = rows.iter().flat_map(|own| &own.parts);
            parts.map(|part| jet.phase.scalar(part.as_ref().unwrap_or(&zero))).collect::<Vec<_>>()
        }
    })?;
    let (width, level) = match family.entry {
        ForceEntry::Potential(_) => (dimension, case.model.level.len()),
        ForceEntry::Rates(_) => (family.ways(), 0),
    };
    let found = values_at_random::<1>(&graph, &values, SearchStream::Gradients, effort);
    let Some((modulus, values)) = found else { return Ok(None) };
    let values = values.concat();
    let mut echelon = Echelon::new(width, modulus);
    let mut push = |row: &&[u64]| echelon.push(row.to_vec());
    let all: Vec<&[u64]> = values.chunks(width).collect();
    let is_of_positions =
        |row: &&&[u64]| row.iter().enumerate().all(|(k, x)| *x == 0 || positions.contains(&k));
    let level = all[..level].iter().filter(is_of_positions).filter(|row| push(row)).count();
    let others = all[all.len() - rows.len()..].iter().filter(|row| push(row)).count();
    Ok(Some(Ranks { all: level + others, level }))
}
