//! The tables `[field]` and `[level]`: rates, and the equations that the motion preserves.

use super::error::{Mistake, Problem};
use super::family::{Key, Rates, Unreadable};
use super::formulas::formula;
use super::section::{CaseTable, SpannedStr};
use crate::formula::{Formula, Type, excerpt, look_alike, skeleton};
use crate::mechanics::{
    Dependence, LevelEquation, LevelFunction, RootEquation, TIME, Variable, Vocabulary,
};

/// Reads the formulas of each variable whose rate is given, under its name with or without a prime.
pub fn given_rates(
    section: &CaseTable<'_>,
    variables: &[Variable],
    vocabulary: &Vocabulary,
    reach: Dependence,
) -> Vec<GivenRate> {
    let mut rates: Vec<Rates> = variables.iter().map(|_| Rates::default()).collect();
    let mut broken = vec![false; variables.len()];
    for (key, value) in section.entries() {
        let (index, read) = match Key::read(key.get_ref(), variables, vocabulary) {
            Ok(found) => found,
            Err(Unreadable::Unknown(name)) if section.mistakes().has_failed(&name) => continue,
            Err(unreadable) => {
                // the rate of a name that looks like this one is not missing too
                if let Unreadable::Unknown(name) = &unreadable {
                    let mut own = variables.iter().map(|own| skeleton(&own.name));
                    let place = own.position(|own| own == skeleton(name));
                    place.into_iter().for_each(|place| broken[place] = true);
                }
                let problem = unknown_rate(key.get_ref(), unreadable, variables);
                section.mistakes().add(Mistake::at(key.span(), problem));
                continue;
            }
        };
        let plain = read.name.clone();
        match section.keep(section.as_text(key.get_ref(), value)) {
            None => broken[index] = true,
            Some(text) => {
                if !rates[index].add(read, key.span(), text) {
                    let reason = format!("the rate of `{plain}` is given twice");
                    let name = key.get_ref().to_string();
                    section
                        .mistakes()
                        .add(Mistake::at(key.span(), Problem::BadName { name, reason }));
                }
            }
        }
    }
    let read = |((variable, rates), broken): ((&Variable, Rates), bool)| match rates.is_empty() {
        true if broken => GivenRate::Broken,
        true => GivenRate::Missing,
        false => match section.keep(rates.formulas(variable, vocabulary, reach)) {
            Some(formulas) => GivenRate::Given(formulas),
            None => GivenRate::Broken,
        },
    };
    variables.iter().zip(rates).zip(broken).map(read).collect()
}

/// Rate of a variable in a file.
pub enum GivenRate {
    /// Formulas whose components, concatenated, are the rate.
    Given(Vec<Formula>),
    /// A rate given with a mistake.
    Broken,
    /// No rate.
    Missing,
}

fn unknown_rate(key: &str, unreadable: Unreadable, variables: &[Variable]) -> Problem {
    let (message, remedy) = match unreadable {
        Unreadable::Message(message, remedy) => (message, remedy.to_string()),
        Unreadable::Unknown(name) => {
            let meant = look_alike(&name, variables.iter().map(|own| own.name.as_str()));
            let names: Vec<&str> = variables.iter().map(|v| v.name.as_str()).collect();
            let remedy = match names.as_slice() {
                _ if meant.is_some() => meant.unwrap_or_default(),
                [] => "declare the variable in [state] first".to_string(),
                _ => format!("[state] has {}; write \"x'\" = \"…\"", names.join(", ")),
            };
            (format!("`{}` is not the rate of a state variable", excerpt(key)), remedy)
        }
    };
    Problem::Other { message, remedy }
}

/// Reads the rates of all variables; `None` if one is missing, or wrong.
pub fn rates(
    section: &CaseTable<'_>,
    variables: &[Variable],
    vocabulary: &Vocabulary,
) -> Option<Vec<Formula>> {
    all_of(section, variables, vocabulary, true)
}

/// Reads the images of all variables under a map; nothing if one is missing, or wrong.
pub fn images(
    section: &CaseTable<'_>,
    variables: &[Variable],
    vocabulary: &Vocabulary,
) -> Option<Vec<Formula>> {
    all_of(section, variables, vocabulary, false)
}

fn all_of(
    section: &CaseTable<'_>,
    variables: &[Variable],
    vocabulary: &Vocabulary,
    are_rates: bool,
) -> Option<Vec<Formula>> {
    let given = given_rates(section, variables, vocabulary, Dependence::Phase);
    let mut all = Some(Vec::new());
    for (variable, rate) in variables.iter().zip(given) {
        let formulas = match rate {
            GivenRate::Given(formulas) => Some(formulas),
            GivenRate::Broken => None,
            GivenRate::Missing
                if are_rates && variable.name == TIME && variable.kind == Type::Scalar =>
            {
                section.keep(one(vocabulary).map(|one| vec![one]))
            }
            GivenRate::Missing => {
                let name = &variable.name;
                let (message, remedy) = match are_rates {
                    true => (
                        format!("[field] has no rate for `{name}`"),
                        format!("add \"{name}'\" = \"…\""),
                    ),
                    false => (
                        format!("[map] has no image of `{name}`"),
                        format!("add \"{name}\" = \"…\"; \"{name}\" where it stays"),
                    ),
                };
                section.mistakes().add(section.complaint(Problem::Other { message, remedy }));
                None
            }
        };
        match (&mut all, formulas) {
            (Some(all), Some(formulas)) => all.extend(formulas),
            _ => all = None,
        }
    }
    all
}

/// Rate of time.
fn one(vocabulary: &Vocabulary) -> Result<Formula, Mistake> {
    Formula::parse("1", vocabulary).map_err(|error| Mistake::whole(Problem::Formula(error)))
}

/// Reads `equations = ["(γ,γ) = 1", …]`; `None` if one is wrong.
pub fn equations(section: &CaseTable<'_>, vocabulary: &Vocabulary) -> Option<Vec<LevelEquation>> {
    let read = equations_in(section, "equations", vocabulary, Dependence::Phase)?.into_iter();
    let equation = |(text, function): (String, Formula)| {
        let sides = both_sides(&text, vocabulary);
        level_equation(text, function, sides)
    };
    Some(read.map(equation).collect())
}

/// Reads the two sides of an equation, each as a formula.
pub fn both_sides(text: &str, vocabulary: &Vocabulary) -> Option<(Formula, Formula)> {
    let (left, right, _) = sides(text)?;
    let read = |side| Formula::parse(side, vocabulary).ok();
    Some((read(left)?, read(right)?))
}

/// Builds an equation of the level from its sides, of which one may be a root.
pub fn level_equation(
    text: String,
    function: Formula,
    sides: Option<(Formula, Formula)>,
) -> LevelEquation {
    let root = sides.and_then(|(left, right)| {
        let ((radicand, is_modulus), other_side) = match (left.radicand(), right.radicand()) {
            (Some(root), _) => (root, right),
            (None, Some(root)) => (root, left),
            (None, None) => return None,
        };
        Some(RootEquation { radicand, is_modulus, other_side })
    });
    LevelEquation { text, function: LevelFunction::Formula(function), root }
}

/// Reads a list of equations as texts and differences of both sides, which may depend on no more
/// than `reach`; `None` if one is wrong.
pub fn equations_in(
    section: &CaseTable<'_>,
    key: &'static str,
    vocabulary: &Vocabulary,
    reach: Dependence,
) -> Option<Vec<(String, Formula)>> {
    let texts = section.keep(section.texts(key))?;
    let read: Vec<Option<(String, Formula)>> =
        texts.iter().map(|text| section.keep(equation(text, key, vocabulary, reach))).collect();
    read.into_iter().collect()
}

/// Both sides of an equation, with the place where the right one begins.
pub fn sides(text: &str) -> Option<(&str, &str, usize)> {
    let mut depth = 0;
    for (place, letter) in text.char_indices() {
        match letter {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            // inside brackets it is a condition on indices
            '=' if depth == 0 => return Some((&text[..place], &text[place + 1..], place + 1)),
            _ => {}
        }
    }
    None
}

fn equation(
    text: &SpannedStr,
    key: &str,
    vocabulary: &Vocabulary,
    reach: Dependence,
) -> Result<(String, Formula), Mistake> {
    let Some((left, right, second)) = sides(&text.value) else {
        let message = format!("each of `{key}` has two sides");
        let remedy = match key {
            "constraints" => "write \"x'*sin(φ) − y'*cos(φ) = 0\"".to_string(),
            _ => format!("write \"{} = 1\", or another value", excerpt(text.value.trim())),
        };
        return Err(Mistake::at(text.span.clone(), Problem::Other { message, remedy }));
    };
    for (side, start) in [(left, 0), (right, second)] {
        Formula::parse(side, vocabulary).map_err(|error| {
            let inner = error.span();
            let place = text.locate(start + inner.start..start + inner.end);
            Mistake::at(place, Problem::Formula(error))
        })?;
    }
    let difference = match right.trim() {
        "0" => left.trim().to_string(),
        _ => format!("({left}) − ({right})"),
    };
    let difference = SpannedStr::made(difference, text.span.clone());
    let scalar = Some(Type::Scalar);
    let function = formula(&difference, vocabulary, "each side", scalar, reach)?;
    Ok((text.value.trim().to_string(), function))
}
