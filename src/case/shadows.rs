//! Names that mean something without being declared, and that a file declares all the same.

use crate::formula::{Formula, Scope};
use crate::mechanics::{Meaning, Vocabulary};

/// The quantities of the system that are hidden, and the declared names that would else be components
/// (γ3 beside γ) or the unit matrix; each once.
pub fn all(vocabulary: &Vocabulary, quantities: Vec<String>) -> Vec<String> {
    let mut hidden = quantities;
    let is_declared = |meaning| matches!(meaning, Meaning::Parameter(_) | Meaning::Abbreviation(_));
    for (symbol, entry) in vocabulary.iter().filter(|(_, entry)| is_declared(entry.meaning)) {
        let is_found = vocabulary.lookup(&entry.name).is_some_and(|(found, _)| found == symbol);
        if is_found && !hidden.contains(&entry.name) && has_meaning_of_its_own(vocabulary, &entry.name)
        {
            hidden.push(entry.name.clone());
        }
    }
    hidden
}

/// Would the name mean something, were it not declared?
fn has_meaning_of_its_own(vocabulary: &Vocabulary, name: &str) -> bool {
    let may_be_component = name == "E" || name.ends_with(|c: char| c.is_ascii_digit());
    may_be_component
        && Formula::parse(name, &vocabulary.only(|entry| entry.name != name)).is_ok()
}

/// What to say of a name that is hidden.
pub fn warning(name: &str) -> String {
    format!("`{name}` has a meaning of its own here, and this file gives it another")
}
