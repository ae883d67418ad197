//! Listed values of parameters: their choices, and those for which nothing moves.
//!
//! For a mass that is 0 a Lagrangian determines no accelerations. A state with such a value is no
//! state of a motion, and does not count: the requirement of every claim contains a value that does
//! not exist there.

use num_traits::Zero;

use super::Phase;
use super::chart::Chart;
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
        match self.system.is_given_by_formulas() {
            true => Vec::new(),
            false => self.choices_without_motion(),
        }
    }

    /// Lists the choices of listed values for which the equations of motion have no solution, or no value.
    pub fn choices_without_motion(&self) -> Vec<ListedValues> {
        let listed: Vec<usize> =
            (0..self.parameters.len()).filter(|index| self.list_of(*index).is_some()).collect();
        let choices = match listed.is_empty() {
            true => None,
            false => combinations(&self.draws_of_lists()),
        };
        let choices = choices.filter(|all| all.len() > 1).unwrap_or_default();
        let choices = choices.into_iter().filter(|choice| self.has_no_motion(choice));
        // Scalars take one draw each, and these alone are fixed by a choice, in their order.
        choices
            .map(|choice| listed.iter().copied().zip(choice.into_iter().flatten()).collect())
            .collect()
    }

    /// Whether nothing moves for a choice of listed values, by draw of the parameters.
    pub fn has_no_motion_for(&self, fixed: &[Option<Rational>]) -> bool {
        let mut place = 0;
        let places: Vec<usize> = self
            .parameters
            .iter()
            .map(|own| {
                let first = place;
                if let ParameterOrigin::Free(recipe) = &own.origin {
                    place += recipe.draws().len();
                }
                first
            })
            .collect();
        let is_chosen = |(index, value): &(usize, Rational)| {
            fixed.get(places[*index]).is_some_and(|own| own.as_ref() == Some(value))
        };
        self.undetermined.iter().any(|choice| choice.iter().all(is_chosen))
    }

    /// Returns the draws of the free parameters; those of vectors and matrices count as free, with a list or not.
    fn draws_of_lists(&self) -> Vec<Draw> {
        let of_one = |recipe: &SamplerSpec| match recipe {
            SamplerSpec::Scalar(draw) => vec![draw.clone()],
            other => vec![Draw::Sign; other.draws().len()],
        };
        let free = self.parameters.iter().filter_map(|own| match &own.origin {
            ParameterOrigin::Free(recipe) => Some(of_one(recipe)),
            _ => None,
        });
        free.flatten().collect()
    }

    /// Takes each listed value for which there is no motion, whatever the other parameters are, out of its list.
    /// Returns these values by the index of the parameter; of lists of which none is left nothing is taken.
    pub fn leave_out_values_without_motion(&mut self) -> ListedValues {
        let mut left_out = ListedValues::new();
        let choices = self.choices_without_motion();
        let all = match choices.is_empty() {
            true => None,
            false => combinations(&self.draws_of_lists()),
        };
        let all = all.map_or(0, |all| all.len());
        for index in 0..self.parameters.len() {
            let Some(values) = self.list_of(index) else { continue };
            let others = all / values.len().max(1);
            let is_still = |value: &Rational| {
                let with = |own: &&ListedValues| own.contains(&(index, value.clone()));
                others > 0 && choices.iter().filter(with).count() == others
            };
            let (still, moving): (Vec<_>, Vec<_>) = values.iter().cloned().partition(is_still);
            if !still.is_empty() && !moving.is_empty() {
                let kept = SamplerSpec::Scalar(Draw::OneOf(moving));
                self.parameters[index].origin = ParameterOrigin::Free(kept);
                left_out.extend(still.into_iter().map(|value| (index, value)));
            }
        }
        if !left_out.is_empty() {
            self.undetermined = self.find_undetermined();
        }
        left_out
    }

    /// The list of a scalar parameter.
    fn list_of(&self, index: usize) -> Option<&[Rational]> {
        match &self.parameters[index].origin {
            ParameterOrigin::Free(SamplerSpec::Scalar(Draw::OneOf(values))) => Some(values),
            _ => None,
        }
    }

    /// Whether the equations of motion have no solution for a choice of listed values: where what they are divided by is
    /// 0 at every state, the determinant of masses and constraints for a Lagrangian, whatever it is solved by; or where
    /// the rates have no value by their form.
    fn has_no_motion(&self, choice: &[Option<Rational>]) -> bool {
        let chart = self.system.chart();
        let recorded = record(choice.len() + self.dimension(), |inputs| {
            let fixed = choice.iter().chain(std::iter::repeat(&None));
            let at = |(input, value): (&Expr, &Option<Rational>)| {
                value.as_ref().map_or(*input, Expr::rational)
            };
            let inputs: Vec<Expr> = inputs.iter().zip(fixed).map(at).collect();
            let (parameters, draws) = self.make_parameters(&inputs);
            let state = match &chart {
                // γ and ω take five numbers where |γ| = 1 (and ω is normal to γ): what is divided by may be 0 there alone.
                Chart::Rolling | Chart::Sphere => {
                    let draws = draws.split_last().map_or(draws, |(_, others)| others);
                    chart.point(self, &vec![true; self.level.len()], &parameters, draws)
                }
                Chart::Free | Chart::Given(_) | Chart::Equations => draws.to_vec(),
            };
            let phase = Phase::new(self, &parameters, &state);
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
