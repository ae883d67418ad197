//! Names that mean something without being declared, and that a file declares all the same.

use crate::formula::{Formula, Scope};
use crate::mechanics::{Meaning, Vocabulary};

/// The quantities of the system that are hidden, and the parameters that would else be the unit matrix
/// or components of what the system itself names (γ3); each once.
pub fn all(vocabulary: &Vocabulary, quantities: Vec<String>) -> Vec<String> {
    let mut hidden = quantities;
    for (symbol, entry) in vocabulary.iter() {
        let is_found = vocabulary.lookup(&entry.name).is_some_and(|(found, _)| found == symbol);
        let is_parameter = matches!(entry.meaning, Meaning::Parameter(_));
        if is_parameter && is_found && is_known_without_it(vocabulary, &entry.name) {
            hidden.push(entry.name.clone());
        }
    }
    hidden
}

/// Would the name mean something, were it not declared?
fn is_known_without_it(vocabulary: &Vocabulary, name: &str) -> bool {
    let may_be = name == "E" || name.ends_with(|c: char| c.is_ascii_digit());
    let of_system = || {
        vocabulary.only(|entry| matches!(entry.meaning, Meaning::State(_) | Meaning::Quantity(_)))
    };
    may_be && Formula::parse(name, &of_system()).is_ok()
}

/// What to say of a name that is hidden.
pub fn warning(name: &str) -> String {
    format!("`{name}` has a meaning of its own here, and this file gives it another")
}
