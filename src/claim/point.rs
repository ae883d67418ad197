//! Points of phase space that a claim gives by their variables.

use super::Reader;
use crate::formula::Formula;
use crate::mechanics::{Meaning, Phase};
use crate::scalar::Scalar;

/// A point given by parameters.
#[derive(Clone, Debug)]
pub struct Point {
    /// One entry a state variable; 0 where none is given.
    variables: Vec<Option<Formula>>,
    /// As it is typed.
    pub text: String,
}

impl Point {
    /// The components of the point, with the parameters of `phase`.
    pub fn components<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let mut components = Vec::new();
        for (formula, variable) in self.variables.iter().zip(&phase.model().state) {
            match formula {
                Some(formula) => components.extend(phase.evaluate(formula).components()),
                None => components.extend(vec![T::zero(); variable.len()]),
            }
        }
        components
    }
}

/// Reads a table of state variables, each a formula in the parameters.
pub fn read_point<R: Reader>(from: &R, key: &'static str) -> Result<Option<Point>, R::Error> {
    let model = from.model();
    let Some(given) = from.table_in(key, &model.vocabulary.only_parameters())? else {
        return Ok(None);
    };
    let mut variables = vec![None; model.state.len()];
    let mut texts = Vec::new();
    for (name, formula) in given {
        let entry = model.vocabulary.find(&name);
        let Some(Meaning::State(index)) = entry.map(|entry| entry.meaning) else {
            let message = format!("`{name}` is no state variable");
            return Err(from.complaint(key, message, "name state variables"));
        };
        if model.state[index].kind != formula.value_type() {
            return Err(from.unlike(key, model.state[index].kind, formula.value_type()));
        }
        if model.has_antiderivative(&formula) {
            let message = "a point has no ∫ in it: its constant is open".to_string();
            return Err(from.complaint(key, message, "write the antiderivative out"));
        }
        texts.push(format!("{name} = {}", formula.text().trim()));
        variables[index] = Some(formula);
    }
    Ok(Some(Point { variables, text: texts.join(", ") }))
}
