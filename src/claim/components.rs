//! A vector of phase space by its components: one formula a state variable.

use super::Reader;
use crate::formula::Formula;
use crate::mechanics::{Meaning, Phase, Vocabulary};
use crate::scalar::Scalar;

/// One entry a state variable; 0 where none is given.
#[derive(Clone, Debug)]
pub struct Components(Vec<Option<Formula>>);

impl Components {
    /// Reads the table under `key`, its formulas in the names of `scope`.
    pub fn read<R: Reader>(
        from: &R,
        key: &'static str,
        scope: &Vocabulary,
    ) -> Result<Self, R::Error> {
        let model = from.model();
        let mut components = vec![None; model.state.len()];
        let given = from.table_in(key, scope)?.ok_or_else(|| from.missing(key))?;
        for (name, formula) in given {
            let entry = model.vocabulary.find(&name);
            let Some(Meaning::State(index)) = entry.map(|entry| entry.meaning) else {
                let message = format!("`{name}` is no state variable");
                return Err(from.complaint(key, message, "name state variables"));
            };
            if model.state[index].kind != formula.value_type() {
                return Err(from.unlike(key, model.state[index].kind, formula.value_type()));
            }
            components[index] = Some(formula);
        }
        Ok(Self(components))
    }

    /// The formulas that are given.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        self.0.iter().flatten()
    }

    /// The components at a point, one after the other.
    pub fn at<T: Scalar>(&self, point: &Phase<'_, T>) -> Vec<T> {
        let variables = self.0.iter().zip(&point.model().state);
        let values = variables.map(|(formula, variable)| match formula {
            Some(formula) => point.evaluate(formula).components(),
            None => vec![T::zero(); variable.len()],
        });
        values.flatten().collect()
    }
}
