//! Questions: texts that are asked of a case, and the findings that come back.
//!
//! What is asked is a claim like any other: `Case::ask` reads it, `verdict::judge` decides.

use serde::Serialize;

use super::family::Family;
use crate::case::Case;
use crate::verdict::{ClaimReport, JudgeError, Options, Verdict, judge};

/// A name that formulas use, with its formula.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Definition {
    /// The name.
    pub name: String,
    /// What it stands for.
    pub formula: String,
}

/// Claims to be made about a case, with the names they use.
#[derive(Clone, Debug, Default)]
pub struct Question {
    /// The family that the claims come from.
    pub family: String,
    /// Where they come from.
    pub source: String,
    /// What is known beside them.
    pub note: Option<String>,
    /// The names, in order.
    pub definitions: Vec<Definition>,
    /// The tables `[[claim]]`, and `[variables]` and `[poisson]` where there are any.
    pub body: String,
}

/// A claim that was tried, with its verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The claim and its verdict.
    #[serde(flatten)]
    pub claim: ClaimReport,
    /// The family that it comes from.
    pub family: String,
    /// The names that its formula uses, and those that they use.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub definitions: Vec<Definition>,
    /// The statement, where it is no formula: a map, a field, a Hamiltonian form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub statement: Option<String>,
    /// Of a reversor: the dimension of the set that it leaves in place; `null` where that is empty.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fixed_set: Option<FixedSet>,
    /// What is known beside it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remark: Option<String>,
}

/// The points of the level set that a map leaves in place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct FixedSet {
    /// Its dimension, unless it is empty.
    pub dimension: Option<usize>,
}

impl Finding {
    /// Is it known to hold?
    pub fn holds(&self) -> bool {
        matches!(self.claim.verdict, Verdict::Proved | Verdict::Confirmed)
    }

    /// Its formula, or the statement that stands in place of one.
    pub fn text(&self) -> &str {
        self.statement.as_deref().or(self.claim.formula.as_deref()).unwrap_or(&self.claim.name)
    }
}

impl Question {
    /// The question of a family, with names for what the case calls otherwise.
    pub fn of(family: &Family, bindings: &[Definition]) -> Self {
        let own = family
            .definitions
            .iter()
            .map(|(name, formula)| Definition { name: name.clone(), formula: formula.clone() });
        Self {
            family: family.name.clone(),
            source: family.source.clone(),
            note: family.note.clone(),
            definitions: distinct(bindings.iter().cloned().chain(own)),
            body: family.claims.clone(),
        }
    }

    /// A question of claims alone.
    pub fn plain(family: &str, bindings: &[Definition], body: String) -> Self {
        let family = family.to_string();
        Self { family, definitions: bindings.to_vec(), body, ..Self::default() }
    }

    /// The text that is asked.
    pub fn text(&self) -> String {
        format!("{}{}", definitions_text(&self.definitions), self.body)
    }

    /// Asks, and judges; `None` where the question has no meaning for the case, such as one about a
    /// name that it does not have.
    pub fn ask(&self, case: &Case, options: &Options) -> Result<Option<Vec<Finding>>, JudgeError> {
        let Ok(asked) = case.ask(&self.text()) else { return Ok(None) };
        let report = judge(&asked, options)?;
        Ok(Some(report.claims.into_iter().map(|claim| self.finding(claim)).collect()))
    }

    fn finding(&self, mut claim: ClaimReport) -> Finding {
        if !self.source.is_empty() && !claim.source.contains(&self.source) {
            // The case's own source is the default of a claim; a family has its own.
            let own = claim.source.starts_with('(') || claim.source.starts_with("Theorem");
            claim.source =
                if own { format!("{}, {}", self.source, claim.source) } else { self.source.clone() };
        }
        let used = claim.formula.as_deref().unwrap_or_default();
        Finding {
            definitions: used_by(used, &self.definitions),
            claim,
            family: self.family.clone(),
            statement: None,
            fixed_set: None,
            remark: self.note.clone(),
        }
    }
}

/// `[let]` with these names.
pub fn definitions_text(definitions: &[Definition]) -> String {
    if definitions.is_empty() {
        return String::new();
    }
    let line = |d: &Definition| format!("\"{}\" = \"{}\"\n", d.name, d.formula);
    format!("[let]\n{}\n", definitions.iter().map(line).collect::<String>())
}

/// The last definition of each name: a family's own hides a binding.
fn distinct(definitions: impl Iterator<Item = Definition>) -> Vec<Definition> {
    let mut kept: Vec<Definition> = Vec::new();
    for definition in definitions {
        kept.retain(|earlier| earlier.name != definition.name);
        kept.push(definition);
    }
    kept
}

/// The definitions that a formula uses, and those that they use, in order.
pub fn used_by(formula: &str, definitions: &[Definition]) -> Vec<Definition> {
    let mut texts = vec![formula];
    let mut used = vec![false; definitions.len()];
    for (index, definition) in definitions.iter().enumerate().rev() {
        if texts.iter().any(|text| mentions(text, &definition.name)) {
            used[index] = true;
            texts.push(&definition.formula);
        }
    }
    let pairs = definitions.iter().zip(used);
    pairs.filter(|(_, used)| *used).map(|(definition, _)| definition.clone()).collect()
}

/// Does the name stand in the formula, by itself or with an index?
fn mentions(formula: &str, name: &str) -> bool {
    let letter = |c: char| c.is_alphanumeric() && !c.is_numeric() || c == '_';
    formula.match_indices(name).any(|(start, _)| {
        let before = formula[..start].chars().next_back();
        let after = &formula[start + name.len()..];
        let rest = after.trim_start_matches(|c: char| c.is_ascii_digit());
        let own_digits = name.ends_with(|c: char| c.is_ascii_digit());
        let unchanged = !own_digits || rest.len() == after.len();
        !before.is_some_and(|c| letter(c) || c.is_numeric())
            && !rest.starts_with(letter)
            && !rest.starts_with('\'')
            && unchanged
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn define(name: &str, formula: &str) -> Definition {
        Definition { name: name.to_string(), formula: formula.to_string() }
    }

    #[test]
    fn only_what_is_used_is_shown() {
        let all = [define("m", "2*M"), define("J", "I + m*E"), define("g1", "I1"), define("g", "3")];
        let names = |formula: &str| {
            used_by(formula, &all).into_iter().map(|d| d.name).collect::<Vec<_>>()
        };
        assert_eq!(names("|J*ω|²"), ["m", "J"], "J, and the m in it");
        assert_eq!(names("√g1*ω3"), ["g1"], "g1 is a name, and no component of g");
        assert_eq!(names("J3"), ["m", "J"], "a component of J");
        assert!(names("gamma*mu").is_empty(), "letters inside a name are no name");
    }
}
