//! Names that formulas of a case may use, as text.

use std::fmt::Write;

use liouville::case::Case;
use liouville::formula::{Scope, function_names};
use liouville::mechanics::{Meaning, ParameterOrigin, VocabularyEntry};

/// Lists the names with their kinds and meanings, and the functions.
pub fn text(case: &Case) -> String {
    let mut rows: Vec<[String; 4]> = Vec::new();
    let mut names = case.model.vocabulary.names();
    names.sort();
    for name in names {
        if let Some(entry) = case.model.vocabulary.find(&name) {
            let (group, meaning) = meaning(case, entry);
            rows.push([group.to_string(), name, entry.kind.to_string(), meaning]);
        }
    }
    for claim in &case.claims {
        let is_new = rows.iter().all(|row| row[1] != claim.name);
        if let Some(formula) = claim.kind.formula().filter(|_| is_new) {
            let kind = formula.value_type().to_string();
            let own = formula.text().trim();
            // A claim without a name has that of its formula.
            if own != claim.name {
                rows.push([CLAIMS.to_string(), claim.name.clone(), kind, own.to_string()]);
            }
        }
    }
    let mut text = String::new();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let (first, second) = (width(1).unwrap_or(0), width(2).unwrap_or(0));
    for group in GROUPS {
        let members: Vec<&[String; 4]> = rows.iter().filter(|row| row[0] == group).collect();
        if members.is_empty() {
            continue;
        }
        _ = writeln!(text, "{group}");
        for [_, name, kind, meaning] in members {
            let line = format!("  {name:<first$}  {kind:<second$}  {meaning}");
            _ = writeln!(text, "{}", line.trim_end());
        }
    }
    let mut functions: Vec<&str> = function_names().collect();
    functions.dedup();
    _ = writeln!(text, "constants\n  π, e, E (unit matrix)\nfunctions\n  {}", wrapped(&functions));
    text
}

/// Groups in the order of the output.
const GROUPS: [&str; 5] = ["state variables", "parameters", "abbreviations", "quantities", CLAIMS];
/// Group of the claims, whose names are columns of motions.
const CLAIMS: &str = "claims (as columns of motions)";

/// Returns the group of a name, and what it stands for.
fn meaning(case: &Case, entry: &VocabularyEntry) -> (&'static str, String) {
    match entry.meaning {
        Meaning::State(_) => (GROUPS[0], String::new()),
        Meaning::Parameter(index) => {
            let own = case.model.parameters.get(index);
            let origin = own.map(|parameter| match &parameter.origin {
                ParameterOrigin::Fixed(_) => "fixed".to_string(),
                ParameterOrigin::Free(_) => "drawn for every state".to_string(),
                ParameterOrigin::Formula(formula) => format!("= {}", formula.text()),
            });
            (GROUPS[1], origin.unwrap_or_default())
        }
        Meaning::Abbreviation(index) => {
            let own = case.model.abbreviations.get(index);
            (GROUPS[2], own.map_or(String::new(), |formula| format!("= {}", formula.text())))
        }
        Meaning::Quantity(quantity) => (GROUPS[3], quantity.meaning().to_string()),
    }
}

/// Joins words to lines.
fn wrapped(words: &[&str]) -> String {
    const WIDTH: usize = 76;
    let mut lines = vec![String::new()];
    for word in words {
        let last = lines.last().map_or(0, |line| line.chars().count());
        if last + word.chars().count() + 2 > WIDTH {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            let gap = if line.is_empty() { "" } else { ", " };
            _ = write!(line, "{gap}{word}");
        }
    }
    lines.join(",\n  ")
}
