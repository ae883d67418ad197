//! Divisors of the elimination of accelerations, as functions of what is drawn.

use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, record};
use crate::mechanics::elimination::is_indefinite;
use crate::mechanics::{Chart, Draw, DrawSource, Model, combinations};
use crate::number::ball::{Ball, Balls};
use crate::number::float::Float;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::{Extent, InputDistribution, Prover, is_nowhere_zero, sign};
use crate::scalar::Scalar;

/// Number of states at which the signs are looked at.
const STATES: usize = 16;
/// Largest number of velocities of which the signs are looked at.
const MOST_VELOCITIES: usize = 32;
/// Largest number of operations of divisors that are bounded everywhere.
const MOST_OPERATIONS: usize = 1 << 11;
/// Seed of the proofs that leading minors are not 0.
const SEED: u64 = 1;

/// Masses of a Lagrangian as functions of the symbols of the case, or of the draws of a place, with all that elimination
/// divides by.
pub struct RecordedMasses {
    pub graph: Graph,
    pub masses: Vec<Expr>,
    /// Pivots of the elimination of the masses alone.
    pub pivots: Vec<Expr>,
    pub divisors: Vec<Expr>,
    /// Level functions and their opposites.
    pub level: Vec<Expr>,
    /// Size of the largest block of masses and constraints without entries outside, by their form.
    pub largest_block: usize,
}

impl RecordedMasses {
    /// Whether bounds of the divisors take little time.
    pub fn is_small(&self) -> bool {
        self.graph.operations(&self.divisors) <= MOST_OPERATIONS
    }

    /// Whether all divisors are known to be 0 on no open set of states of a place, for each choice of listed values.
    pub fn are_regular_at(&self, place: (&Model, &Chart, &[bool]), free: &[Draw]) -> bool {
        let (model, chart, kept) = place;
        let draws = [model.parameter_draws(), chart.draws(free, kept)].concat();
        let Some(choices) = combinations(&draws) else { return false };
        choices.iter().all(|choice| {
            let drawn = self.drawn(place, choice);
            drawn.and_then(|drawn| drawn.has_divisors(&draws)).unwrap_or(false)
        })
    }

    /// Whether each divisor is known to be 0 at no state of a place whose equations are solved, by intervals, for each
    /// choice of listed values.
    pub fn are_nowhere_zero(&self, place: (&Model, &Chart, &[bool]), free: &[Draw]) -> bool {
        self.all_choices(place, free, |drawn, extents, facts| {
            let is_nonzero = |divisor: &Expr| match drawn.graph.constant_value(*divisor) {
                Some(value) => !value.is_zero(),
                None => is_nowhere_zero(&drawn.graph, extents, facts, &[*divisor]),
            };
            drawn.divisors.iter().all(is_nonzero)
        })
    }

    /// Whether the masses are known to be positive definite at all states of such a place: where what else elimination
    /// divides by, the leading minors of a M⁻¹ aᵀ, vanishes, the determinant does.
    pub fn are_definite(&self, place: (&Model, &Chart, &[bool]), free: &[Draw]) -> bool {
        self.all_choices(place, free, |drawn, extents, facts| {
            let is_positive = |pivot: &Expr| match drawn.graph.constant_value(*pivot) {
                Some(value) => !value.is_zero() && !value.is_negative(),
                None => sign(&drawn.graph, extents, &[], facts, *pivot)
                    .is_some_and(|known| known.is_positive && !known.may_vanish),
            };
            drawn.pivots.iter().all(is_positive)
        })
    }

    /// Whether something holds of them, of the extents of the draws and of the level functions of a place with their
    /// opposites, which are not negative there, for each choice of listed values.
    fn all_choices(
        &self,
        place: (&Model, &Chart, &[bool]),
        free: &[Draw],
        holds: impl Fn(&Self, &[Extent], &[Expr]) -> bool,
    ) -> bool {
        let (model, chart, kept) = place;
        let draws = [model.parameter_draws(), chart.draws(free, kept)].concat();
        let Some(choices) = combinations(&draws) else { return false };
        choices.iter().all(|choice| {
            let Ok(drawn) = self.drawn(place, choice) else { return false };
            let fixed = draws.iter().zip(choice).map(|(draw, value)| draw.fixed(value.as_ref()));
            let extents: Vec<Extent> = fixed.map(|draw| draw.extent()).collect();
            let facts = drawn.level.chunks(2).zip(kept).filter(|(_, kept)| **kept);
            let facts: Vec<Expr> = facts.flat_map(|(own, _)| own.iter().copied()).collect();
            holds(&drawn, &extents, &facts)
        })
    }

    /// Whether f64 shows masses of both signs at one of the first states of a place, for this number of velocities.
    pub fn are_indefinite(
        &self,
        place: (&Model, &Chart, &[bool]),
        free: &[Draw],
        count: usize,
    ) -> bool {
        if count > MOST_VELOCITIES {
            return false;
        }
        let (model, chart, kept) = place;
        let draws = [model.parameter_draws(), chart.draws(free, kept)].concat();
        let any = vec![None; draws.len()];
        let Ok(drawn) = self.drawn(place, &any) else { return false };
        let choices = combinations(&draws).unwrap_or_else(|| vec![any]);
        drawn.is_indefinite_somewhere(count, &draws, &choices)
    }

    /// Writes them as functions of the draws of a place, with a choice of listed values inserted; values of arbitrary
    /// functions are further inputs.
    fn drawn(
        &self,
        (model, chart, kept): (&Model, &Chart, &[bool]),
        choice: &[Option<Rational>],
    ) -> Result<Self, Fault> {
        let all = [&self.masses[..], &self.pivots, &self.divisors, &self.level].concat();
        let reached = self.graph.reached(all.iter().copied());
        let symbols = model.free_components() + model.dimension();
        let further = self.graph.inputs() - symbols;
        let (graph, made) = record(choice.len() + further, |inputs| {
            let (draws, further) = inputs.split_at(choice.len());
            let fixed = draws.iter().zip(choice);
            let draws: Vec<Expr> =
                fixed.map(|(own, value)| value.as_ref().map_or(*own, Expr::rational)).collect();
            let (parameters, state) = model.make_parameters(&draws);
            let state = chart.point(model, kept, &parameters, state);
            let inputs = [&parameters[..], &state, further].concat();
            let values = self.graph.repeated(&reached, &inputs);
            all.iter().map(|own| values[self.graph.place(*own)]).collect::<Option<Vec<Expr>>>()
        })?;
        let mut masses = made.ok_or(Fault::ForeignValue)?;
        let mut pivots = masses.split_off(self.masses.len());
        let mut divisors = pivots.split_off(self.pivots.len());
        let level = divisors.split_off(self.divisors.len());
        Ok(Self { graph, masses, pivots, divisors, level, largest_block: self.largest_block })
    }

    /// Whether each divisor is known to be 0 on no open set of states: by a ball at one of them, where it is one
    /// analytic function, or by a proof on each cell of signs of its moduli and roots.
    fn has_divisors(&self, draws: &[Draw]) -> Result<bool, Fault> {
        let extents: Vec<Extent> = draws.iter().map(Draw::extent).collect();
        if self.is_analytic(draws, &extents) && self.are_seen(draws) {
            return Ok(true);
        }
        let source = |draw: &Draw| match draw {
            Draw::Sign => InputDistribution::Sign,
            _ => InputDistribution::Uniform,
        };
        let sources: Vec<InputDistribution> = draws.iter().map(source).collect();
        let prover = Prover { sources: &sources, extents: &extents, seed: SEED };
        for divisor in &self.divisors {
            let is_known = match self.graph.constant_value(*divisor) {
                Some(value) => !value.is_zero(),
                None => {
                    is_nowhere_zero(&self.graph, &extents, &[], &[*divisor])
                        || prover.is_nonzero_on_all_cells(&self.graph, *divisor)?
                }
            };
            if !is_known {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether balls exclude 0 from each divisor at one of the first states.
    fn are_seen(&self, draws: &[Draw]) -> bool {
        let tape = Tape::new(&self.graph, &self.divisors);
        let mut evaluator = Evaluator::new(&tape, Ball::<STATES>);
        let numbers = drawn_numbers(draws, self.graph.inputs());
        let exact = |x: &[f64; STATES]| Balls::new(*x, [0.0; STATES]);
        evaluator.run(&numbers.iter().map(exact).collect::<Vec<_>>());
        let is_seen = |value: &Balls<STATES>| {
            (0..STATES).any(|lane| value.is_defined(lane) && value.excludes_zero(lane))
        };
        evaluator.outputs().all(is_seen)
    }

    /// Whether each divisor is one analytic function on the box of the draws, but for poles.
    ///
    /// What is under a root, a modulus or a logarithm has no pole and no zero on the box, and what is in an arctangent
    /// no pole. These are then analytic around the box in complex space, on a connected set, and the rest is analytic
    /// there without the zeros of divisors, which do not divide it: a function that is not 0 at one state is 0 on no
    /// open set. (Not so: e^(½ ln k²) + k, which is 0 for k < 0.)
    fn is_analytic(&self, draws: &[Draw], extents: &[Extent]) -> bool {
        use UnaryFunction::{Abs, Atan, Ln, Recip, Sqrt};
        let graph = &self.graph;
        let reached = graph.reached(self.divisors.iter().copied());
        let is_single_valued = |(place, step): (usize, Step<'_>)| match step {
            Step::Input(input) => !reached[place] || !matches!(draws.get(input), Some(Draw::Sign)),
            Step::Unary(Abs | Sqrt | Ln | Atan, _) | Step::Binary(BinaryOperation::Pow, ..) => {
                !reached[place]
            }
            Step::Power(_, exponent) => !reached[place] || exponent.to_integer().is_some(),
            _ => true,
        };
        if graph.steps().enumerate().all(is_single_valued) {
            return true;
        }
        let is_nowhere_zero =
            |place: usize| is_nowhere_zero(graph, extents, &[], &[graph.at(place)]);
        let mut has_no_pole = vec![true; reached.len()];
        for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
            let of_arguments = step.arguments().all(|argument| has_no_pole[argument]);
            let (is_analytic, has_value) = match step {
                Step::Input(input) => (!matches!(draws.get(input), Some(Draw::Sign)), true),
                Step::Unary(Recip, a) => (true, of_arguments && is_nowhere_zero(a)),
                Step::Unary(Abs | Sqrt | Ln, a) | Step::Binary(BinaryOperation::Pow, a, _) => {
                    (of_arguments && is_nowhere_zero(a), true)
                }
                Step::Power(a, exponent) if exponent.to_integer().is_none() => {
                    (of_arguments && is_nowhere_zero(a), true)
                }
                Step::Power(a, exponent) if *exponent < Rational::from(0) => {
                    (true, of_arguments && is_nowhere_zero(a))
                }
                Step::Unary(Atan, _) => (of_arguments, true),
                _ => (true, of_arguments),
            };
            if !is_analytic {
                return false;
            }
            has_no_pole[place] = has_value;
        }
        true
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
