//! States as typed by a user.

use crate::case::{Case, number};
use crate::formula::canonical_name;
use crate::number::rational::{Rational, RationalError};

/// The reason why a state cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StateError {
    /// The text is not of the form `name=value`.
    #[error("`{0}` is not of the form name=value, such as ω=[3/7,0,-1/2] or x=0.5")]
    Malformed(String),
    /// The name is not a state variable.
    #[error("`{name}` is not a state variable; this system has {known}")]
    Unknown {
        /// Name that was given.
        name: String,
        /// Names of the state variables.
        known: String,
    },
    /// The variable has two values.
    #[error("`{0}` is given twice")]
    Twice(String),
    /// The variable has no value.
    #[error("the state has no value for `{0}`")]
    Missing(String),
    /// The list has the wrong length.
    #[error("`{name}` has {expected} components, not {found}")]
    Length {
        /// Name of the variable.
        name: String,
        /// Number of its components.
        expected: usize,
        /// Number of values given.
        found: usize,
    },
    /// The text is not a number.
    #[error("{0}")]
    Number(String),
}

/// Reads `ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]`; matrices row by row, `Q=[[1,0,0],[0,1,0],[0,0,1]]`; or the
/// components of the whole state in order, `1,1/2,0`.
pub fn read_state(case: &Case, text: &str) -> Result<Vec<Rational>, StateError> {
    let variables = &case.model.state;
    if !text.contains('=') {
        let all: Option<Vec<Rational>> = text.split(',').map(number).collect();
        if let Some(all) = all.filter(|all| all.len() == case.model.dimension()) {
            return Ok(all);
        }
    }
    let mut values: Vec<Option<Vec<Rational>>> = vec![None; variables.len()];
    let mut rest = text.trim();
    while !rest.is_empty() {
        let (name, after) =
            rest.split_once('=').ok_or_else(|| StateError::Malformed(rest.to_string()))?;
        let after = after.trim_start();
        let (list, remaining) = match after.starts_with('[') {
            true => bracketed(after).ok_or_else(|| StateError::Malformed(after.to_string()))?,
            false => after.split_once(char::is_whitespace).unwrap_or((after, "")),
        };
        rest = remaining.trim_start_matches(|c: char| c.is_whitespace() || c == ',' || c == ';');
        let name = canonical_name(name.trim()).unwrap_or_else(|| name.trim().to_string());
        let index = variables.iter().position(|v| v.name == name).ok_or_else(|| {
            let known: Vec<&str> = variables.iter().map(|v| v.name.as_str()).collect();
            StateError::Unknown { name: name.clone(), known: known.join(", ") }
        })?;
        // The rows of a matrix may have separate brackets.
        let list = list.replace(['[', ']'], " ");
        let read = |text: &str| {
            let formula = |error: RationalError| {
                number(text).ok_or_else(|| StateError::Number(error.to_string()))
            };
            text.trim().parse().or_else(formula)
        };
        let numbers: Vec<Rational> = list.split(',').map(read).collect::<Result<_, _>>()?;
        let (expected, found) = (variables[index].len(), numbers.len());
        if expected != found {
            return Err(StateError::Length { name, expected, found });
        }
        if values[index].is_some() {
            return Err(StateError::Twice(name));
        }
        values[index] = Some(numbers);
    }
    let mut state = Vec::new();
    for (variable, value) in variables.iter().zip(values) {
        state.extend(value.ok_or_else(|| StateError::Missing(variable.name.clone()))?);
    }
    Ok(state)
}

/// Splits a text after its opening bracket into the bracket's contents and the rest.
fn bracketed(text: &str) -> Option<(&str, &str)> {
    let mut depth = 0;
    for (place, letter) in text.char_indices() {
        match letter {
            '[' => depth += 1,
            ']' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some((&text[..place], &text[place + 1..]));
        }
    }
    None
}
