//! Formulas from outside a case file: in its names, and in those of its claims.

use std::ops::Range;

use liouville::case::Case;
use liouville::formula::{Formula, FormulaError, Type, canonical_name};
use liouville::mechanics::{Dependence, Meaning, Model};

/// Names of a case, with the formulas of its claims by the names of the claims.
pub struct Lexicon {
    model: Model,
    /// Formulas of claims whose names are several words.
    phrases: Vec<(String, Formula)>,
}

/// Mistake in a formula that a user has given for a motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct FormulaMistake {
    /// Description of the mistake.
    pub message: String,
    /// Place in the text, in bytes.
    pub span: Range<usize>,
    /// Correction.
    pub help: Option<String>,
}

impl FormulaMistake {
    fn of(error: &FormulaError, from: usize) -> Self {
        let span = error.span();
        Self {
            message: error.message().to_string(),
            span: span.start + from..span.end + from,
            help: error.help().map(str::to_string),
        }
    }

    pub(crate) fn new(message: String, span: Range<usize>, help: &str) -> Self {
        Self { message, span, help: Some(help.to_string()) }
    }
}

impl Lexicon {
    /// Gathers the names of a case. A claim whose name is taken by something else is left out.
    pub fn new(case: &Case) -> Self {
        let mut model = case.model.clone();
        let mut phrases = Vec::new();
        for claim in &case.claims {
            let (formula, name) = (claim.kind.formula(), canonical_name(&claim.name));
            let Some(formula) = formula else { continue };
            let Some(name) = name else {
                if Formula::parse(&claim.name, &model.vocabulary).is_err()
                    && !model.has_antiderivative(formula)
                {
                    phrases.push((claim.name.clone(), formula.clone()));
                }
                continue;
            };
            let is_matrix = |read: Formula| matches!(read.value_type(), Type::Matrix(..));
            let is_taken = Formula::parse(&name, &model.vocabulary).is_ok_and(|x| !is_matrix(x));
            let is_known = model.vocabulary.find(&name).is_some() || is_taken;
            if is_known || model.has_antiderivative(formula) {
                continue;
            }
            let meaning = Meaning::Abbreviation(model.abbreviations.len());
            model.vocabulary.add(&name, meaning, formula.value_type(), Dependence::Phase);
            model.abbreviations.push(formula.clone());
        }
        Self { model, phrases }
    }

    /// Model in whose names the formulas are.
    pub(crate) fn model(&self) -> &Model {
        &self.model
    }

    /// Reads a formula that stands at `from` in a longer text.
    pub(crate) fn formula(&self, text: &str, from: usize) -> Result<Formula, FormulaMistake> {
        if let Some((_, formula)) = self.phrases.iter().find(|(name, _)| name == text.trim()) {
            return Ok(formula.clone());
        }
        let read = Formula::parse(text, &self.model.vocabulary);
        let read = read.map_err(|error| FormulaMistake::of(&error, from))?;
        match self.model.has_antiderivative(&read) {
            false => Ok(read),
            true => Err(FormulaMistake::new(
                "the value of an ∫ is not determined".to_string(),
                from..from + text.len(),
                "write the function itself",
            )),
        }
    }

    /// Whether the value of a formula depends on the state.
    pub(crate) fn varies(&self, formula: &Formula) -> bool {
        self.model
            .vocabulary
            .reach(formula)
            .is_some_and(|entry| entry.reach > Dependence::Parameters)
    }

    /// Whether something has this name.
    pub(crate) fn knows(&self, name: &str) -> bool {
        self.model.vocabulary.find(name).is_some()
    }
}

/// Splits a list at the commas outside brackets: each part trimmed, with its place.
pub(crate) fn listed(text: &str) -> Vec<(Range<usize>, &str)> {
    let (mut depth, mut begin) = (0i64, 0);
    let mut ends = Vec::new();
    for (place, letter) in text.char_indices() {
        match letter {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            ',' if depth <= 0 => {
                ends.push((begin, place));
                begin = place + 1;
            }
            _ => {}
        }
    }
    ends.push((begin, text.len()));
    let part = |(begin, end): (usize, usize)| {
        let inner = text[begin..end].trim();
        let start = begin + text[begin..end].len() - text[begin..end].trim_start().len();
        (start..start + inner.len(), inner)
    };
    ends.into_iter().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_split_outside_brackets() {
        let parts: Vec<_> = listed("t, (γ,c) , [1,2]").into_iter().map(|(_, part)| part).collect();
        assert_eq!(parts, ["t", "(γ,c)", "[1,2]"]);
        let (place, part) = &listed("t,  x")[1];
        assert_eq!((place.clone(), *part), (4..5, "x"), "the place without the spaces");
        assert_eq!(listed("").len(), 1, "one empty part");
    }
}
