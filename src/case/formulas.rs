//! Formulas of a file: parsed with the known names, checked for type and dependence.

use super::error::{Mistake, Problem};
use super::section::SpannedStr;
use crate::formula::{Formula, Scope, Symbol, Type};
use crate::mechanics::{Dependence, Meaning, Vocabulary, VocabularyEntry};

/// Reads a formula, and checks its type and the names it depends on.
pub fn formula(
    text: &SpannedStr,
    vocabulary: &Vocabulary,
    what: &str,
    expected: Option<Type>,
    reach: Dependence,
) -> Result<Formula, Mistake> {
    inside(text, ("", ""), vocabulary, what, expected, reach)
}

/// Reads a formula whose beginning and end are supplied, and whose middle stands in the file.
pub fn inside(
    text: &SpannedStr,
    (before, after): (&str, &str),
    vocabulary: &Vocabulary,
    what: &str,
    expected: Option<Type>,
    reach: Dependence,
) -> Result<Formula, Mistake> {
    let whole = || text.locate(0..text.value.len());
    if !before.is_empty() && !is_balanced(&text.value) {
        let message = "the brackets of this formula do not match".to_string();
        let remedy = "give each bracket its partner".to_string();
        return Err(Mistake::at(whole(), Problem::Other { message, remedy }));
    }
    let written = format!("{before}{}{after}", text.value);
    let formula = Formula::parse(&written, vocabulary).map_err(|error| {
        let place = error.span();
        let end = before.len() + text.value.len();
        let is_inside = before.len() <= place.start && place.end <= end;
        let place = match is_inside {
            true => text.locate(place.start - before.len()..place.end - before.len()),
            false => whole(),
        };
        Mistake::at(place, Problem::Formula(error))
    })?;
    if let Some(expected) = expected.filter(|expected| *expected != formula.value_type()) {
        let (what, found) = (what.to_string(), formula.value_type());
        return Err(Mistake::at(whole(), Problem::WrongKind { what, expected, found }));
    }
    match vocabulary.reach(&formula) {
        Some(entry) if entry.reach > reach => {
            let allowed = match reach {
                Dependence::Parameters => "parameters".to_string(),
                _ => format!("{} and parameters", position(vocabulary)),
            };
            let (what, name) = (what.to_string(), entry.name.clone());
            Err(Mistake::at(whole(), Problem::Reach { what, allowed, name }))
        }
        _ => Ok(formula),
    }
}

/// Whether every bracket closes one that precedes it.
fn is_balanced(text: &str) -> bool {
    let mut open = Vec::new();
    for letter in text.chars() {
        match letter {
            '(' | '[' => open.push(letter),
            ')' if open.pop() != Some('(') => return false,
            ']' if open.pop() != Some('[') => return false,
            _ => {}
        }
    }
    open.is_empty()
}

/// Names of the part of the state that shapes and potentials are functions of.
fn position(vocabulary: &Vocabulary) -> String {
    let is_state = |(symbol, entry): &(Symbol, &VocabularyEntry)| {
        let is_found = vocabulary.lookup(&entry.name).is_some_and(|(found, _)| found == *symbol);
        matches!(entry.meaning, Meaning::State(_)) && is_found
    };
    let all: Vec<&VocabularyEntry> =
        vocabulary.iter().filter(is_state).map(|(_, entry)| entry).collect();
    let own = all.iter().filter(|entry| entry.reach == Dependence::Configuration);
    let names: Vec<&str> = own.map(|entry| entry.name.as_str()).collect();
    match names.as_slice() {
        [only] => only.to_string(),
        [first, second] if all.len() > 2 => format!("{first}, {second}"),
        _ => "the state".to_string(),
    }
}
