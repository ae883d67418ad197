//! Listed values of parameters: their choices, and those for which nothing moves.
//!
//! For a mass that is 0 a Lagrangian determines no accelerations. A state with such a value is no
//! state of a motion, and does not count: the requirement of every claim contains a value that does
//! not exist there.

use num_traits::Zero;

use super::Phase;
use super::model::{Model, ParameterOrigin};
use super::recipe::{Draw, SamplerSpec};
use super::system::System;
use super::vanishing::vanishes;
use crate::formula::Value;
use crate::graph::{Expr, literally, record};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Largest number of choices of listed values that are looked at one by one.
const MOST_CHOICES: usize = 64;

/// Lists all choices of listed values, by draw; `None` if there are too many.
pub fn combinations(recipes: &[Draw]) -> Option<Vec<Vec<Option<Rational>>>> {
    let mut all: Vec<Vec<Option<Rational>>> = vec![Vec::with_capacity(recipes.len())];
    for recipe in recipes {
        let values = match recipe {
            Draw::Within(_) | Draw::Of(..) | Draw::Sign => {
                all.iter_mut().for_each(|chosen| chosen.push(None));
                continue;
            }
            Draw::OneOf(values) => values,
        };
        let with = |chosen: &[Option<Rational>], value: &Rational| {
            let mut more = Vec::with_capacity(recipes.len());
            more.extend_from_slice(chosen);
            more.push(Some(value.clone()));
            more
        };
        let of_one = |chosen: &Vec<_>| values.iter().map(|value| with(chosen, value)).collect();
        all = all.iter().flat_map(|chosen| -> Vec<Vec<_>> { of_one(chosen) }).collect();
        if all.len() > MOST_CHOICES {
            return None;
        }
    }
    Some(all)
}

/// A choice of listed values, by the index of the parameter.
pub type ListedValues = Vec<(usize, Rational)>;

impl Model {
    /// Finds the choices of listed values for which the equations of motion have no solution, as accelerations are 0/0
    /// or 1/0 where a mass is 0. Fields that formulas give are left out, as these formulas are
    /// required anyway.
    pub fn find_undetermined(&self) -> Vec<ListedValues> {
        if self.system.is_given_by_formulas() {
            return Vec::new();
        }
        let is_listed = |origin: &ParameterOrigin| {
            matches!(origin, ParameterOrigin::Free(SamplerSpec::Scalar(Draw::OneOf(_))))
        };
        let listed: Vec<usize> = (0..self.parameters.len())
            .filter(|index| is_listed(&self.parameters[*index].origin))
            .collect();
        let draws = self.parameter_draws();
        let choices = match listed.is_empty() {
            true => None,
            false => combinations(&draws),
        };
        let choices = choices.filter(|all| all.len() > 1).unwrap_or_default();
        let choices = choices.into_iter().filter(|choice| self.has_no_motion(choice));
        // Scalars take one draw each, and those of lists are fixed by a choice in their order.
        choices
            .map(|choice| listed.iter().copied().zip(choice.into_iter().flatten()).collect())
            .collect()
    }

    /// Whether the equations of motion have no solution for a choice of listed values: where what they are divided by is
    /// 0 at every state, the determinant of masses and constraints for a Lagrangian, whatever it is solved by; or where
    /// the rates have no value by their form.
    fn has_no_motion(&self, choice: &[Option<Rational>]) -> bool {
        let recorded = record(choice.len() + self.dimension(), |inputs| {
            let fixed = choice.iter().chain(std::iter::repeat(&None));
            let at = |(input, value): (&Expr, &Option<Rational>)| {
                value.as_ref().map_or(*input, Expr::rational)
            };
            let inputs: Vec<Expr> = inputs.iter().zip(fixed).map(at).collect();
            let (parameters, state) = self.make_parameters(&inputs);
            let phase = Phase::new(self, &parameters, state);
            match &self.system {
                System::Lagrangian(own) => (own.determinants(&phase), Vec::new()),
                body => (body.divisors(&phase), phase.field().to_vec()),
            }
        });
        recorded.is_ok_and(|(graph, (divisors, rates))| {
            divisors.into_iter().any(|own| graph.is_nowhere_defined(own) || vanishes(&graph, own))
                || rates.into_iter().any(|rate| graph.is_nowhere_defined(rate))
        })
    }
}

impl Phase<'_, Expr> {
    /// Records values that exist where there are equations of motion: one for each choice of listed values
    /// for which nothing moves, and what the slopes and masses in the rates have no value without.
    pub fn existence_of_motion(&self) -> Vec<Expr> {
        let distance = |choice: &ListedValues| {
            choice.iter().fold(Expr::zero(), |sum, (index, value)| {
                match self.configuration.parameter(*index) {
                    Value::Scalar(own) => {
                        let off = own - Expr::rational(value);
                        sum + off * off
                    }
                    _ => Expr::undefined(),
                }
            })
        };
        let choices = self.model().undetermined.iter();
        let mut values: Vec<Expr> =
            choices.map(|own| literally(|| distance(own).apply(UnaryFunction::Recip))).collect();
        let formulas = self.model().equations_of_motion().into_iter();
        let written = formulas.flat_map(|formula| self.evaluate_literally(formula).components());
        let written: Vec<Expr> = written.collect();
        values.extend(self.hidden_in_motion(&written));
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_are_in_the_order_of_the_lists() {
        let list =
            |values: &[i64]| Draw::OneOf(values.iter().copied().map(Rational::from).collect());
        let draws = [Draw::Sign, list(&[1, 2]), Draw::Sign, list(&[3]), list(&[4, 5, 6])];
        let all = combinations(&draws).expect("few choices");
        let expected: Vec<Vec<Option<Rational>>> = [[1, 3, 4], [1, 3, 5], [1, 3, 6]]
            .into_iter()
            .chain([[2, 3, 4], [2, 3, 5], [2, 3, 6]])
            .map(|own| {
                let [a, b, c] = own.map(|value| Some(Rational::from(value)));
                vec![None, a, None, b, c]
            })
            .collect();
        assert_eq!(all, expected);
        assert_eq!(combinations(&[]), Some(vec![Vec::new()]));
        assert_eq!(combinations(&[list(&[]), Draw::Sign]), Some(Vec::new()));
        let many: Vec<i64> = (0..=MOST_CHOICES as i64).collect();
        assert_eq!(combinations(&[list(&many)]), None);
        assert_eq!(combinations(&[list(&many), list(&[])]), None, "too many before there are none");
    }
}
