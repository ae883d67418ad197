//! Definitions of names in formulas: their use, their merging, and their renaming.

use serde::Serialize;

use super::question::TestedClaim;
use liouville::case::Case;

/// Definition of a name in formulas.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Definition {
    /// Defined name.
    pub name: String,
    /// Formula of the name.
    pub formula: String,
}

/// Returns the case with these definitions, each in the names of those before it; `None` if one has
/// no meaning there.
pub fn defined(case: &Case, definitions: &[Definition]) -> Option<Case> {
    let mut named = case.clone();
    for definition in definitions {
        let formula = named.formula(&definition.formula).ok()?;
        named.define(&definition.name, &formula).ok()?;
    }
    Some(named)
}

/// Makes a definition.
pub fn define(name: &str, formula: &str) -> Definition {
    Definition { name: name.to_string(), formula: formula.to_string() }
}

/// Merges the definitions and formulas of several findings; names with different meanings are
/// renamed.
pub fn merged(bindings: &[Definition], tested: &[&TestedClaim]) -> (Vec<Definition>, Vec<String>) {
    let mut all = bindings.to_vec();
    let mut formulas = Vec::new();
    for (number, tested) in tested.iter().enumerate() {
        let mut own = tested.definitions.clone();
        let mut formula = tested.formula().to_string();
        for index in 0..own.len() {
            let clash = all.iter().any(|one| one.name == own[index].name && *one != own[index]);
            if clash {
                let (old, new) = (
                    own[index].name.clone(),
                    format!("{}{}", "x".repeat(number + 1), own[index].name),
                );
                own[index].name = new.clone();
                for later in &mut own[index + 1..] {
                    later.formula = renamed(&later.formula, &old, &new);
                }
                formula = renamed(&formula, &old, &new);
            }
        }
        for definition in own {
            if !all.contains(&definition) {
                all.push(definition);
            }
        }
        formulas.push(formula);
    }
    (all, formulas)
}

/// Keeps the last definition of each name: a family's own hides a binding.
pub fn distinct(definitions: impl Iterator<Item = Definition>) -> Vec<Definition> {
    let mut kept: Vec<Definition> = Vec::new();
    for definition in definitions {
        kept.retain(|earlier| earlier.name != definition.name);
        kept.push(definition);
    }
    kept
}

/// Selects the definitions that formulas use, directly or through others, in order.
pub fn used_by(formulas: &[&str], definitions: &[Definition]) -> Vec<Definition> {
    let mut texts = formulas.to_vec();
    let mut used = vec![false; definitions.len()];
    for (index, definition) in definitions.iter().enumerate().rev() {
        // Where g1 is defined, it is a name rather than a component of g.
        let own = |token: &str| {
            token == definition.name || definitions.iter().all(|other| other.name != token)
        };
        if texts.iter().any(|text| mentions(text, &definition.name, &own)) {
            used[index] = true;
            texts.push(&definition.formula);
        }
    }
    let pairs = definitions.iter().zip(used);
    pairs.filter(|(_, used)| *used).map(|(definition, _)| definition.clone()).collect()
}

/// Whether the name occurs in the formula, without an index or with one that does not make it
/// another name.
fn mentions(formula: &str, name: &str, own: &dyn Fn(&str) -> bool) -> bool {
    places(formula, name).any(|start| {
        let after = &formula[start + name.len()..];
        let digits = after.chars().take_while(char::is_ascii_digit).count();
        own(&formula[start..start + name.len() + digits])
    })
}

/// Replaces a name in the formula by another.
fn renamed(formula: &str, name: &str, other: &str) -> String {
    let mut text = String::new();
    let mut done = 0;
    for start in places(formula, name) {
        text.push_str(&formula[done..start]);
        text.push_str(other);
        done = start + name.len();
    }
    text + &formula[done..]
}

/// Finds the places of the name in the formula, with or without an index.
fn places<'t>(formula: &'t str, name: &'t str) -> impl Iterator<Item = usize> + 't {
    let letter = |c: char| c.is_alphanumeric() && !c.is_numeric() || c == '_';
    let stands = move |start: usize| {
        let before = formula[..start].chars().next_back();
        let after = &formula[start + name.len()..];
        let rest = after.trim_start_matches(|c: char| c.is_ascii_digit());
        let own_digits = name.ends_with(|c: char| c.is_ascii_digit());
        let unchanged = !own_digits || rest.len() == after.len();
        !before.is_some_and(|c| letter(c) || c.is_numeric())
            && !rest.starts_with(letter)
            && !rest.starts_with('\'')
            && unchanged
    };
    formula.match_indices(name).map(|(start, _)| start).filter(move |start| stands(*start))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_used_is_shown() {
        let all =
            [define("m", "2*M"), define("J", "I + m*E"), define("g1", "I1"), define("g", "3")];
        let names = |formula: &str| {
            used_by(&[formula], &all).into_iter().map(|d| d.name).collect::<Vec<_>>()
        };
        assert_eq!(names("|J*ω|²"), ["m", "J"], "J, and the m in it");
        assert_eq!(names("√g1*ω3"), ["g1"], "g1 is a name, and no component of g");
        assert_eq!(names("J3"), ["m", "J"], "a component of J");
        assert!(names("gamma*mu").is_empty(), "letters inside a name are no name");
    }

    #[test]
    fn a_name_is_changed_where_it_stands_alone() {
        let text = renamed("J1*(J*ω,J⁻¹*Js) − J'", "J", "xJ");
        assert_eq!(text, "xJ1*(xJ*ω,xJ⁻¹*Js) − J'", "not in Js, nor in J'");
    }
}
