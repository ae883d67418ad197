//! Signs of the masses ∂²L/∂w² at drawn states.
//!
//! A definite matrix, of either sign, may be eliminated without pivots wherever it is regular: with a
//! leading minor its determinant vanishes. Others need not have this property, as [[0, 1], [1, 0]].

use super::Lagrangian;
use crate::graph::{Evaluator, Expr, Tape, record};
use crate::mechanics::elimination::{is_indefinite, solve_by_minors, solve_positive};
use crate::mechanics::{Chart, Configuration, Draw, DrawSource, Model, Phase, combinations};
use crate::number::float::Float;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Number of states at which the signs are looked at.
const STATES: usize = 16;
/// Largest number of velocities of which the signs are looked at.
const MOST_VELOCITIES: usize = 32;

impl Lagrangian {
    /// Whether ∂²L/∂w² has eigenvalues of both signs at some of the first drawn states, with one choice
    /// of listed values or another. `false` where
    /// there are no velocities, or very many, or no value.
    pub fn has_indefinite_masses(&self, model: &Model, chart: &Chart, free: &[Draw]) -> bool {
        let velocities = self.velocities(&model.state);
        let count = velocities.len();
        if count == 0 || count > MOST_VELOCITIES {
            return false;
        }
        let kept = vec![true; model.level.len()];
        let draws = [model.parameter_draws(), chart.draws(free, &kept)].concat();
        let recorded = record(draws.len(), |inputs| {
            let (parameters, state) = model.make_parameters(inputs);
            let state = chart.point(model, &kept, &parameters, state);
            let at = Phase::new(model, &parameters, &state).configuration;
            self.masses(&at, &velocities).concat()
        });
        let Ok((graph, masses)) = recorded else { return false };
        // Values of arbitrary functions are further inputs, of which nothing is known.
        if graph.inputs() > draws.len() {
            return false;
        }
        let choices = combinations(&draws).unwrap_or_else(|| vec![vec![None; draws.len()]]);
        let source = DrawSource::new(&draws);
        let states: Vec<Vec<(f64, bool)>> =
            (0..STATES as u64).map(|index| source.nearest(0, index, 0)).collect();
        let tape = Tape::new(&graph, &masses);
        let mut evaluator = Evaluator::new(&tape, Float::<STATES>);
        // Few of the states may have the values of one choice.
        choices.iter().any(|choice| {
            let input = |(draw, value): (usize, &Option<Rational>)| {
                let value = value.as_ref().map(|value| value.to_f64().0);
                std::array::from_fn(|lane| value.unwrap_or(states[lane][draw].0))
            };
            let inputs: Vec<[f64; STATES]> = choice.iter().enumerate().map(input).collect();
            evaluator.run(&inputs);
            let entries: Vec<[f64; STATES]> = evaluator.outputs().copied().collect();
            (0..STATES).any(|lane| {
                let matrix: Vec<Vec<f64>> = entries
                    .chunks(count)
                    .map(|row| row.iter().map(|own| own[lane]).collect())
                    .collect();
                is_indefinite(&matrix)
            })
        })
    }

    fn masses(&self, at: &Configuration<'_, Expr>, velocities: &[usize]) -> Vec<Vec<Expr>> {
        let drift = self.drift(at);
        let none = |_: usize| <Expr as num_traits::Zero>::zero();
        let terms = self
            .swept_terms(at, velocities, &drift, none)
            .unwrap_or_else(|| self.lifted_terms(at, velocities, &drift, none));
        terms.mass
    }

    /// Solves M x = b with the masses M, or with a matrix a M⁻¹ aᵀ of slopes by the velocities.
    pub(super) fn solved<T: Scalar>(
        &self,
        is_definite: bool,
        matrix: &[Vec<T>],
        sides: Vec<Vec<T>>,
    ) -> Vec<Vec<T>> {
        match is_definite {
            true => sides.into_iter().map(|side| solve_positive(matrix.to_vec(), side)).collect(),
            false => solve_by_minors(matrix, &sides),
        }
    }

    /// Whether nothing is known that keeps these masses from being definite: an entry of the diagonal
    /// that is 0 by its form does.
    pub(super) fn may_be_definite<T: Scalar>(&self, mass: &[Vec<T>]) -> bool {
        let is_present =
            |(i, row): (usize, &Vec<T>)| row.get(i).is_some_and(|own| !own.is_absent());
        !self.is_indefinite && mass.iter().enumerate().all(is_present)
    }
}
