//! Vectors of phase space given by components, one formula for each state variable.

use super::Reader;
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::{Meaning, Model, Phase, Vocabulary};
use crate::scalar::Scalar;

/// One formula for each state variable; 0 where none is given.
#[derive(Clone, Debug)]
pub struct Components {
    variables: Vec<Option<Formula>>,
    /// Text of the table as typed.
    pub text: String,
}

impl Components {
    /// Reads the table of `key`, if there is one, with formulas in the names of `scope`.
    pub fn read<R: Reader>(
        from: &R,
        key: &'static str,
        scope: &Vocabulary,
    ) -> Result<Option<Self>, R::Error> {
        let given = from.table_in(key, scope)?;
        given.map(|given| Self::gather(from, key, given)).transpose()
    }

    /// Reads the table of `inner` inside the table of `key`, which may contain the keys `known`
    /// only.
    pub fn read_inside<R: Reader>(
        from: &R,
        (key, inner): (&'static str, &'static str),
        known: &[&'static str],
        scope: &Vocabulary,
    ) -> Result<Option<Self>, R::Error> {
        let given = from.table_inside(key, inner, known, scope)?;
        given.map(|given| Self::gather(from, key, given)).transpose()
    }

    fn gather<R: Reader>(
        from: &R,
        key: &'static str,
        given: Vec<(String, Formula)>,
    ) -> Result<Self, R::Error> {
        let model = from.model();
        let mut variables = vec![None; model.state.len()];
        let mut texts = Vec::new();
        for (name, formula) in given {
            let entry = model.vocabulary.find(&name);
            let Some(Meaning::State(index)) = entry.map(|entry| entry.meaning) else {
                let names: Vec<&str> = model.state.iter().map(|own| own.name.as_str()).collect();
                let remedy = format!("the state variables are {}", names.join(", "));
                return Err(from.not_a_variable(key, &name, remedy));
            };
            if model.state[index].kind != formula.value_type() {
                return Err(from.unlike(key, model.state[index].kind, formula.value_type()));
            }
            texts.push(format!("{name} = {}", formula.text().trim()));
            variables[index] = Some(formula);
        }
        Ok(Self { variables, text: texts.join(", ") })
    }

    /// Iterates over the given formulas.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        self.variables.iter().flatten()
    }

    /// Iterates over the given formulas with the names of their variables.
    pub fn named<'s>(&'s self, model: &'s Model) -> impl Iterator<Item = (&'s str, &'s Formula)> {
        let pairs = model.state.iter().zip(&self.variables);
        pairs.filter_map(|(own, formula)| Some((own.name.as_str(), formula.as_ref()?)))
    }

    /// Records the components as written.
    pub fn written(&self, phase: &Phase<'_, Expr>) -> Vec<Expr> {
        phase.literal_values(self.formulas())
    }

    /// Evaluates the components at a point, one after another.
    pub fn at<T: Scalar>(&self, point: &Phase<'_, T>) -> Vec<T> {
        let variables = self.variables.iter().zip(&point.model().state);
        let values = variables.map(|(formula, variable)| match formula {
            Some(formula) => point.evaluate(formula).components(),
            None => vec![T::zero(); variable.len()],
        });
        values.flatten().collect()
    }
}
