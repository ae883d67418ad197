//! Symmetry fields, tangent to the level: [u,v] = (u·∇)v - (v·∇)u vanishes, or is a multiple of v.

use super::{Reader, Statement};
use crate::formula::{Formula, Type};
use crate::mechanics::Meaning;
use crate::mechanics::calculus::{Jet, dot};
use crate::scalar::Scalar;

/// `[u,v] = c v`; c = 0 unless a weight is given.
#[derive(Clone, Debug)]
pub struct SymmetryField {
    /// One entry a state variable; 0 where none is given.
    components: Vec<Option<Formula>>,
    weight: Option<Formula>,
}

impl Statement for SymmetryField {
    const NAME: &'static str = "symmetry-field";
    const COMPANIONS: &'static [&'static str] = &["weight"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let model = from.model();
        let mut components = vec![None; model.state.len()];
        for (name, formula) in from.table(Self::NAME)? {
            let entry = model.vocabulary.find(&name);
            let Some(Meaning::State(index)) = entry.map(|entry| entry.meaning) else {
                let message = format!("`{name}` is no state variable");
                return Err(from.complaint(Self::NAME, message, "name state variables"));
            };
            if model.state[index].kind != formula.value_type() {
                return Err(from.unlike(Self::NAME, model.state[index].kind, formula.value_type()));
            }
            components[index] = Some(formula);
        }
        Ok(Self { components, weight: from.formula("weight", Some(Type::Scalar))? })
    }

    fn formulas(&self) -> Vec<&Formula> {
        self.components.iter().flatten().chain(&self.weight).collect()
    }

    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, kept: &[bool]) -> Vec<T> {
        let moved = jet.along_field();
        let (mut field, mut rate) = (Vec::new(), Vec::new());
        for (formula, variable) in self.components.iter().zip(&jet.phase.model().state) {
            match formula {
                Some(formula) => {
                    let values = moved.evaluate(formula).components();
                    field.extend(values.iter().map(|x| x.re));
                    rate.extend(values.iter().map(|x| x.eps));
                }
                None => {
                    field.extend(vec![T::zero(); variable.len()]);
                    rate.extend(vec![T::zero(); variable.len()]);
                }
            }
        }
        let weight = self.weight.as_ref().map_or_else(T::zero, |c| jet.phase.scalar(c));
        let beside = jet.phase.lift(&field);
        let commutator = beside.field().iter().zip(rate);
        let mut residual: Vec<T> =
            commutator.map(|(along, rate)| along.eps - rate - weight * along.re).collect();
        // u is tangent to the level.
        residual.extend(jet.level_gradients(kept).iter().map(|gradient| dot(gradient, &field)));
        residual
    }
}
