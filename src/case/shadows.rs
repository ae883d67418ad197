//! Names that a reader may confuse: declared ones that hide a predefined meaning, and ones that
//! look alike.

use std::cell::LazyCell;
use std::collections::BTreeMap;

use crate::formula::{Formula, Scope, Type, is_function, skeleton};
use crate::mechanics::{Meaning, Vocabulary, VocabularyEntry};

/// Hidden names, each once: the hidden quantities of the system, and the declared names that would
/// otherwise be functions, the unit matrix, π, e, or components of the system's own names (γ3).
pub fn all(vocabulary: &Vocabulary, quantities: Vec<String>) -> Vec<String> {
    // One vocabulary for all names: there may be thousands.
    let of_state = LazyCell::new(|| vocabulary.only(is_of_state));
    let of_system = LazyCell::new(|| {
        vocabulary.only(|entry| is_of_state(entry) || matches!(entry.meaning, Meaning::Quantity(_)))
    });
    let has_meaning = |name: &str, among: &Vocabulary| Formula::parse(name, among).is_ok();
    // Whether the name would have a meaning if it were not declared.
    let is_known_without_it = |entry: &VocabularyEntry| {
        let name = entry.name.as_str();
        let is_number = entry.kind == Type::Scalar && matches!(name, "e" | "π");
        match entry.meaning {
            Meaning::Quantity(_) => false,
            // the definition of an abbreviation stands next to its name
            Meaning::Abbreviation(_) => {
                is_function(name) || (ends_with_digit(name) && has_meaning(name, &of_state))
            }
            Meaning::State(_) => is_number || is_function(name) || is_component(vocabulary, name),
            Meaning::Parameter(_) if is_number || is_function(name) => true,
            Meaning::Parameter(_) => {
                (name == "E" || ends_with_digit(name)) && has_meaning(name, &of_system)
            }
        }
    };
    let mut hidden = quantities;
    for (symbol, entry) in vocabulary.iter() {
        let is_found = vocabulary.lookup(&entry.name).is_some_and(|(found, _)| found == symbol);
        if is_found && is_known_without_it(entry) && !hidden.contains(&entry.name) {
            hidden.push(entry.name.clone());
        }
    }
    hidden
}

fn is_of_state(entry: &VocabularyEntry) -> bool {
    matches!(entry.meaning, Meaning::State(_))
}

fn ends_with_digit(name: &str) -> bool {
    name.ends_with(|c: char| c.is_ascii_digit())
}

/// Whether a name would be the component of a variable, as x2 is of a vector x.
fn is_component(vocabulary: &Vocabulary, name: &str) -> bool {
    let is_other = |entry: &VocabularyEntry| is_of_state(entry) && entry.name != name;
    ends_with_digit(name) && Formula::parse(name, &vocabulary.only(is_other)).is_ok()
}

/// Warning about a hidden name.
pub fn warning(vocabulary: &Vocabulary, name: &str) -> String {
    let meaning = match name {
        "e" => " (Euler's number)",
        "π" => " (the number π)",
        "E" => " (the unit matrix)",
        _ if is_function(name) => " (a function)",
        _ => "",
    };
    let hidden =
        format!("`{name}` already has a meaning here{meaning}, and this file gives it another");
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    match vocabulary.find(name).is_some() && is_component(vocabulary, name) {
        true => {
            // x_2 is read as x2.
            let is_known = vocabulary.find(stem).is_some();
            let variable = if is_known { stem } else { stem.trim_end_matches('_') };
            format!("{hidden}: write {variable}[{}] for the component", &name[stem.len()..])
        }
        false => hidden,
    }
}

/// Warnings about names that look alike.
pub fn look_alikes(vocabulary: &Vocabulary) -> Vec<String> {
    let mut seen: BTreeMap<String, &str> = BTreeMap::new();
    let mut warnings = Vec::new();
    for (_, entry) in vocabulary.iter() {
        let first = *seen.entry(skeleton(&entry.name)).or_insert(&entry.name);
        if first != entry.name {
            warnings.push(format!(
                "`{first}` and `{}` look alike, but are different names",
                entry.name
            ));
        }
    }
    warnings
}
