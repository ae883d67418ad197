//! Homogeneity of sums: weights in time for the built-in systems, and in the base dimensions that
//! `[dimensions]` declares.

use super::PlacedClaim;
use super::error::{Mistake, Problem};
use super::section::{CaseTable, SpannedStr};
use crate::formula::{Formula, Scope, Symbol, Type, WeightSystem, canonical_name};
use crate::mechanics::{LevelFunction, Meaning, Model, Quantity};
use crate::number::rational::Rational;

/// Checks all formulas of a case in every known base dimension, and notes the mistakes.
pub fn check(
    root: &CaseTable<'_>,
    model: &Model,
    dimensions: Option<&CaseTable<'_>>,
    claims: &[PlacedClaim],
) {
    let mut systems = Vec::new();
    if model.system.has_time_weights() {
        systems.push(time(model));
    }
    if let Some(section) = dimensions {
        systems.extend(root.keep(declared(section, model)).unwrap_or_default());
    }
    for mut weights in systems {
        if root.keep(of_case(root, model, &mut weights)).is_none() {
            continue;
        }
        let start = weights.clone();
        let stated = || claims.iter().flat_map(|claim| claim.kind.formulas());
        if stated().all(|formula| formula.check_weights(&mut weights).is_ok()) {
            continue;
        }
        // a wrong formula says nothing about the others
        let mut weights = start;
        for formula in stated() {
            let mut own = weights.clone();
            if root.keep(checked(root, formula, &mut own)).is_some() {
                weights = own;
            }
        }
    }
}

/// Checks the formulas of a case apart from its claims.
fn of_case(root: &CaseTable<'_>, model: &Model, weights: &mut WeightSystem) -> Result<(), Mistake> {
    for (index, formula) in model.abbreviations.iter().enumerate() {
        let weight = checked(root, formula, weights)?;
        let meaning = Meaning::Abbreviation(index);
        let symbol = model.vocabulary.iter().find(|(_, entry)| entry.meaning == meaning);
        if let (Some((symbol, _)), Some(weight)) = (symbol, weight) {
            weights.set(symbol, weight);
        }
    }
    let level = model.level.iter().filter_map(|equation| match &equation.function {
        LevelFunction::Formula(formula) => Some(formula),
        _ => None,
    });
    for formula in model.system.dimensional().into_iter().chain(level) {
        checked(root, formula, weights)?;
    }
    Ok(())
}

fn checked(
    root: &CaseTable<'_>,
    formula: &Formula,
    weights: &mut WeightSystem,
) -> Result<Option<Rational>, Mistake> {
    formula.check_weights(weights).map_err(|error| {
        let remedy = "if this is meant, set check-weights = false at the top of the file";
        let problem =
            Problem::Sense { message: error.message().to_string(), remedy: remedy.to_string() };
        let span = error.span();
        // the file may hold a part of the formula: the body of a family
        let whole = root.find(formula.text()).map(|start| start + span.start..start + span.end);
        let part = || {
            let text = formula.text().get(span.clone())?;
            root.find(text).map(|start| start..start + text.len())
        };
        Mistake::new(whole.or_else(part), problem)
    })
}

/// Weights under t → λt: ω and S scale as 1/t, energies as 1/t², shapes and masses not at all.
fn time(model: &Model) -> WeightSystem {
    let mut weights = WeightSystem::new("time");
    let curved = model.system.is_curved();
    let own = model.own_variables();
    for (symbol, entry) in model.vocabulary.iter() {
        let weight = match entry.meaning {
            Meaning::Quantity(Quantity::Rate(_)) => None,
            Meaning::Parameter(_) => match entry.name.as_str() {
                "m" | "I" | "R" | "c" | "B" | "μ" => Some(0),
                "k" if curved => Some(0),
                _ => None,
            },
            // Variables added to the state have the weight that their formulas give them.
            Meaning::State(index) if index >= own => None,
            Meaning::State(_) => Some(if entry.name.starts_with('ω') { -1 } else { 0 }),
            Meaning::Abbreviation(_) => None,
            Meaning::Quantity(
                Quantity::ContactRate | Quantity::NormalRate | Quantity::AngularVelocity,
            ) => Some(-1),
            Meaning::Quantity(Quantity::AngularAcceleration) => Some(-2),
            Meaning::Quantity(Quantity::Energy | Quantity::Potential | Quantity::Multiplier) => {
                Some(-2)
            }
            Meaning::Quantity(_) => Some(0),
        };
        if let Some(weight) = weight {
            weights.set(symbol, Rational::from(weight));
        }
    }
    if let Some(gyrostat) = model.system.gyrostat()
        && let Some((symbol, _)) = model.vocabulary.lookup(gyrostat.text())
    {
        weights.set(symbol, Rational::from(-1));
    }
    weights
}

/// Base dimensions: the names that the declarations use.
struct Bases(Vec<String>);

impl Scope for Bases {
    fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
        let index = self.0.iter().position(|base| base == name)?;
        Some((Symbol(index as u32), Type::Scalar))
    }
    fn names(&self) -> Vec<String> {
        self.0.clone()
    }
}

/// Reads one system of weights for each base dimension that `[dimensions]` uses.
fn declared(section: &CaseTable<'_>, model: &Model) -> Result<Vec<WeightSystem>, Mistake> {
    let mut entries = Vec::new();
    let mut bases: Vec<String> = Vec::new();
    for (key, value) in section.entries() {
        let name = canonical_name(key.get_ref()).unwrap_or_default();
        let Some((symbol, _)) = model.vocabulary.lookup(&name) else {
            return Err(Mistake::at(
                key.span(),
                Problem::Other {
                    message: format!("`{name}` has a dimension here, and is not declared"),
                    remedy: "remove it, or declare it in [parameters], [state] or [let]"
                        .to_string(),
                },
            ));
        };
        let text = section.as_text(key.get_ref(), value)?;
        let words = text.value.split(|c: char| !c.is_alphanumeric());
        for word in words.filter(|word| word.starts_with(char::is_alphabetic)) {
            if !bases.iter().any(|base| base == word) {
                bases.push(word.to_string());
            }
        }
        entries.push((symbol, text));
    }
    let scope = Bases(bases);
    let formulas: Vec<(Symbol, Formula, SpannedStr)> = entries
        .into_iter()
        .map(|(symbol, text)| match Formula::parse(&text.value, &scope) {
            Ok(formula) => Ok((symbol, formula, text)),
            Err(error) => Err(Mistake::at(text.locate(error.span()), Problem::Formula(error))),
        })
        .collect::<Result<_, _>>()?;
    let of_base = |base: usize| {
        let mut powers = WeightSystem::new(&scope.0[base]);
        for other in 0..scope.0.len() {
            powers.set(Symbol(other as u32), Rational::from(i64::from(other == base)));
        }
        let mut weights = WeightSystem::new(&scope.0[base]);
        for (symbol, formula, text) in &formulas {
            let weight = formula
                .check_weights(&mut powers)
                .map_err(|error| Mistake::at(text.locate(error.span()), Problem::Formula(error)))?;
            weights.set(*symbol, weight.unwrap_or_else(|| Rational::from(0)));
        }
        Ok(weights)
    };
    (0..scope.0.len()).map(of_base).collect()
}
