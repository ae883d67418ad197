//! Solution of the equations of motion for the accelerations, by elimination or by minors of the masses ∂²L/∂w².
//!
//! Elimination divides by leading minors, of the masses and of the matrix a M⁻¹ aᵀ of the reactions. Where they are 0 on no open set, it has a value at almost every state at
//! which the determinant is not 0; and at all of them where the matrix is definite, as its determinant then vanishes
//! with a leading minor. Others need minors, as [[0, 1], [1, 0]].

use super::Lagrangian;
use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, divisors_of, record};
use crate::mechanics::dynamics::Dynamics;
use crate::mechanics::elimination::{is_indefinite, solve_by_minors, solve_positive};
use crate::mechanics::{Chart, Configuration, Draw, DrawSource, Model, Phase, combinations};
use crate::number::UnaryFunction;
use crate::number::ball::{Ball, Balls};
use crate::number::float::Float;
use crate::number::rational::Rational;
use crate::proof::{Extent, InputDistribution, Prover, is_nowhere_zero};
use crate::scalar::Scalar;

/// Number of states at which the signs are looked at.
const STATES: usize = 16;
/// Largest number of velocities of which the signs are looked at.
const MOST_VELOCITIES: usize = 32;
/// Largest number of velocities and constraints that are solved for by minors because nothing is known of a pivot: more
/// lose digits.
const MOST_BY_MINORS: usize = 6;
/// Seed of the proofs that leading minors are not 0.
const SEED: u64 = 1;

/// Masses of a Lagrangian as functions of the draws, with all that elimination divides by.
struct DrawnMasses {
    graph: Graph,
    masses: Vec<Expr>,
    pivots: Vec<Expr>,
}

impl Lagrangian {
    /// Whether the equations of motion are to be solved by minors: what elimination divides by is not known to be 0 on
    /// no open set of states, on the level and in all of space, or the matrix has eigenvalues of both signs at some of the first drawn states, with one choice of
    /// listed values or another. `false` where there are no velocities.
    pub fn needs_minors(&self, model: &Model, chart: &Chart, free: &[Draw]) -> bool {
        let velocities = self.velocities(&model.state);
        if velocities.is_empty() || velocities.len() > MOST_VELOCITIES {
            return false;
        }
        let are_few = velocities.len() + self.constraints.len() <= MOST_BY_MINORS;
        let level = vec![true; model.level.len()];
        let mut places = vec![level.clone()];
        if !level.is_empty() {
            places.push(vec![false; level.len()]);
        }
        for kept in &places {
            let place = (model, chart, &kept[..]);
            let draws = [model.parameter_draws(), chart.draws(free, kept)].concat();
            let Some(choices) = combinations(&draws) else { return true };
            // Nothing has a value for a mass without one.
            let drawn =
                |choice: &Vec<Option<Rational>>| self.drawn_masses(place, &velocities, choice).ok();
            let is_regular = |choice: &Vec<Option<Rational>>| {
                drawn(choice).is_none_or(|own| own.has_pivots(&draws).unwrap_or(false))
            };
            if are_few && !choices.iter().all(is_regular) {
                return true;
            }
            if *kept == level {
                let any = vec![None; draws.len()];
                let own = drawn(if let [only] = &choices[..] { only } else { &any });
                let Some(own) = own else { return false };
                if own.is_indefinite_somewhere(velocities.len(), &draws, &choices) {
                    return true;
                }
            }
        }
        false
    }

    fn drawn_masses(
        &self,
        (model, chart, kept): (&Model, &Chart, &[bool]),
        velocities: &[usize],
        choice: &[Option<Rational>],
    ) -> Result<DrawnMasses, Fault> {
        let (graph, (masses, pivots)) = record(choice.len(), |inputs| {
            let fixed = inputs.iter().zip(choice);
            let inputs: Vec<Expr> =
                fixed.map(|(own, value)| value.as_ref().map_or(*own, Expr::rational)).collect();
            let (parameters, state) = model.make_parameters(&inputs);
            let state = chart.point(model, kept, &parameters, state);
            let phase = Phase::new(model, &parameters, &state);
            let pivots = divisors_of(|| {
                self.field(&phase);
            });
            (self.masses(&phase.configuration, velocities).concat(), pivots)
        })?;
        Ok(DrawnMasses { graph, masses, pivots })
    }

    fn masses(&self, at: &Configuration<'_, Expr>, velocities: &[usize]) -> Vec<Vec<Expr>> {
        let drift = self.drift(at);
        let none = |_: usize| <Expr as num_traits::Zero>::zero();
        let terms = self
            .swept_terms(at, velocities, &drift, none)
            .unwrap_or_else(|| self.lifted_terms(at, velocities, &drift, none));
        terms.mass
    }

    /// Solves M x = b with the masses M.
    pub(super) fn solved<T: Scalar>(&self, mass: &[Vec<T>], sides: Vec<Vec<T>>) -> Vec<Vec<T>> {
        match self.may_be_eliminated(mass) {
            true => eliminated(mass, sides),
            false => solve_by_minors(mass, &sides),
        }
    }

    /// Whether these masses may be eliminated: an entry of the diagonal that is 0 by its form excludes it.
    pub(super) fn may_be_eliminated<T: Scalar>(&self, mass: &[Vec<T>]) -> bool {
        let is_present =
            |(i, row): (usize, &Vec<T>)| row.get(i).is_some_and(|own| !own.is_absent());
        !self.needs_minors && mass.iter().enumerate().all(is_present)
    }
}

/// Solves A x = b by elimination.
pub(super) fn eliminated<T: Scalar>(matrix: &[Vec<T>], sides: Vec<Vec<T>>) -> Vec<Vec<T>> {
    sides.into_iter().map(|side| solve_positive(matrix.to_vec(), side)).collect()
}

impl DrawnMasses {
    /// Whether each divisor is seen to be 0 on no open set of states: in a ball at one of them, where it is one analytic
    /// function, or by a proof on each cell of signs of its moduli and roots.
    fn has_pivots(&self, draws: &[Draw]) -> Result<bool, Fault> {
        let extents: Vec<Extent> = draws.iter().map(Draw::extent).collect();
        // √l with l in 1..2 is analytic.
        let may_vanish =
            |place: usize| !is_nowhere_zero(&self.graph, &extents, &[], &[self.graph.at(place)]);
        let has_kinks = self.graph.has_step(&self.pivots, |step| match step {
            Step::Unary(UnaryFunction::Abs | UnaryFunction::Sqrt, a) => may_vanish(a),
            Step::Power(a, exponent) => exponent.to_integer().is_none() && may_vanish(a),
            _ => false,
        });
        if !has_kinks {
            let tape = Tape::new(&self.graph, &self.pivots);
            let mut evaluator = Evaluator::new(&tape, Ball::<STATES>);
            let numbers = drawn_numbers(draws, self.graph.inputs());
            let exact = |x: &[f64; STATES]| Balls::new(*x, [0.0; STATES]);
            evaluator.run(&numbers.iter().map(exact).collect::<Vec<_>>());
            // Where nothing has a value nothing is known.
            let is_seen = |value: &Balls<STATES>| {
                let known = || (0..STATES).filter(|lane| value.is_defined(*lane));
                known().next().is_none() || known().any(|lane| value.excludes_zero(lane))
            };
            return Ok(evaluator.outputs().all(is_seen));
        }
        let source = |draw: &Draw| match draw {
            Draw::Sign => InputDistribution::Sign,
            _ => InputDistribution::Uniform,
        };
        let sources: Vec<InputDistribution> = draws.iter().map(source).collect();
        let prover = Prover { sources: &sources, extents: &extents, seed: SEED };
        for pivot in &self.pivots {
            let is_known = match self.graph.constant_value(*pivot) {
                Some(value) => !value.is_zero(),
                None => prover.is_nonzero_on_all_cells(&self.graph, *pivot)?,
            };
            if !is_known {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether f64 shows eigenvalues of both signs at one of the first states, for one of some choices of listed
    /// values.
    fn is_indefinite_somewhere(
        &self,
        count: usize,
        draws: &[Draw],
        choices: &[Vec<Option<Rational>>],
    ) -> bool {
        // Values of arbitrary functions are further inputs, of which nothing is known.
        if self.graph.inputs() > draws.len() {
            return false;
        }
        let states = drawn_numbers(draws, draws.len());
        let tape = Tape::new(&self.graph, &self.masses);
        let mut evaluator = Evaluator::new(&tape, Float::<STATES>);
        // Few of the states may have the values of one choice.
        choices.iter().any(|choice| {
            let input = |(drawn, value): (&[f64; STATES], &Option<Rational>)| {
                value.as_ref().map_or(*drawn, |value| [value.to_f64().0; STATES])
            };
            let inputs: Vec<[f64; STATES]> = states.iter().zip(choice).map(input).collect();
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
}

/// The first states as numbers, draw by draw; values of arbitrary functions are further inputs, and are 1.
fn drawn_numbers(draws: &[Draw], inputs: usize) -> Vec<[f64; STATES]> {
    let source = DrawSource::new(draws);
    let states: Vec<Vec<(f64, bool)>> =
        (0..STATES as u64).map(|index| source.nearest(0, index, 0)).collect();
    let of = |draw: usize| std::array::from_fn(|lane| states[lane].get(draw).map_or(1.0, |x| x.0));
    (0..inputs).map(of).collect()
}
