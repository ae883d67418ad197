//! Steps of a rolling body's field that are proportional on the level set are one step.
//!
//! On the level (γ,γ) is 1, and a ball's r' is -Rγ': such relations are seen modulo a prime at a few
//! states of the level, and their factors computed exactly at one of them. The level itself stays an
//! integral near it, whatever is put for r, Ĩ and the torques: γ' is across γ, and the multiplier keeps
//! (ω,γ).

use rustc_hash::FxHashMap;

use super::error::FlowError;
use crate::graph::{Evaluator, Expr, Graph, Step, Tape, record};
use crate::mechanics::{Chart, Model};
use crate::number::exact::{Exact, square_root};
use crate::number::prime::Modulus;
use crate::number::rational::Rational;
use crate::number::{Domain, Function, Operation};
use crate::scalar::Scalar;

/// At how many states relations are seen.
const STATES: usize = 5;
/// 2⁶¹ - 1: steps that are not proportional look so once in 10¹⁸ pairs.
const PRIME: u64 = (1 << 61) - 1;
/// Exact values larger than that are not looked at.
const MAX_BITS: u64 = 4096;
/// Factors larger than that are coincidences of constants, and bring nothing.
const MAX_FACTOR_BITS: u64 = 256;

/// The same values over a graph in which steps that are proportional on the level are one.
pub fn merged(
    model: &Model,
    graph: &Graph,
    wanted: &[Expr],
) -> Result<(Graph, Vec<Expr>), FlowError> {
    let reached = graph.reached(wanted.iter().copied());
    let states: Vec<Vec<Rational>> =
        (0..STATES).map(|index| state(model, graph.inputs(), index)).collect::<Result<_, _>>()?;
    let replacements = Relations::new(graph, &states).find(&reached);
    let inputs = graph.inputs();
    let (simpler, values) = record(inputs, |inputs| {
        let values = graph.replay(&reached, inputs, |place, step, values| {
            if matches!(step, Step::Input(_)) {
                return None;
            }
            let (factor, other) = replacements[place].as_ref()?;
            let factor = Expr::rational(factor);
            Some(match other {
                Some(other) => factor * values[*other]?,
                None => factor,
            })
        });
        wanted.iter().map(|expr| values[graph.place(*expr)]).collect::<Option<Vec<Expr>>>()
    })?;
    Ok((simpler, values.ok_or(FlowError::Antiderivative)?))
}

/// What a step is on the level: a factor, times another step unless it is constant.
type Replacement = Option<(Rational, Option<usize>)>;

/// The values of steps at states of the level, from which relations are read.
struct Relations<'g> {
    graph: &'g Graph,
    states: &'g [Vec<Rational>],
    field: Modulus,
    /// Modulo the prime at all states; `None` where one is undefined, or no number of the field.
    values: Vec<Option<[u64; STATES]>>,
    /// Exactly at the first state, where they were asked for; `None` where one is irrational, undefined or
    /// too large.
    exact: Vec<Option<Option<Rational>>>,
}

impl<'g> Relations<'g> {
    fn new(graph: &'g Graph, states: &'g [Vec<Rational>]) -> Self {
        let exact = vec![None; graph.len()];
        Self { graph, states, field: Modulus::new(PRIME), values: Vec::new(), exact }
    }

    fn find(mut self, reached: &[bool]) -> Vec<Replacement> {
        let mut first: FxHashMap<[u64; STATES - 1], usize> = FxHashMap::default();
        let mut replacements: Vec<Replacement> = vec![None; self.graph.len()];
        for (place, step) in self.graph.steps().enumerate() {
            let own = match reached[place] {
                true => self.residues(step, &replacements),
                false => None,
            };
            self.values.push(own);
            let Some(own) = own.filter(|_| !matches!(step, Step::Constant(_))) else { continue };
            if own.iter().all(|value| *value == own[0]) {
                let constant = self.exact(place);
                replacements[place] = constant.and_then(|value| self.related(value, own, None));
                continue;
            }
            if own[0] == 0 {
                continue;
            }
            let unit = self.field.inverse(own[0]);
            let direction = std::array::from_fn(|k| self.field.mul(own[k + 1], unit));
            let earlier = *first.entry(direction).or_insert(place);
            if earlier != place {
                let factor = self.exact(place).zip(self.exact(earlier).and_then(|x| x.recip()));
                replacements[place] =
                    factor.and_then(|(x, by)| self.related(&x * &by, own, Some(earlier)));
            }
        }
        replacements
    }

    /// A factor that is small enough and right at all states.
    fn related(&self, factor: Rational, own: [u64; STATES], other: Option<usize>) -> Replacement {
        let image = self.field.rational(&factor)?;
        let values = match other {
            Some(other) => self.values[other]?,
            None => [self.field.one(); STATES],
        };
        let holds = (0..STATES).all(|k| self.field.mul(image, values[k]) == own[k]);
        (holds && factor.bits() <= MAX_FACTOR_BITS).then_some((factor, other))
    }

    /// The values of a step modulo the prime. A root is one of a constant: others are not looked at.
    fn residues(&self, step: Step<'_>, replacements: &[Replacement]) -> Option<[u64; STATES]> {
        let field = &self.field;
        let constant = |value: &Rational| Some([field.rational(value)?; STATES]);
        match step {
            Step::Constant(value) => constant(value),
            Step::Input(input) => {
                let mut values = [0; STATES];
                for (value, state) in values.iter_mut().zip(self.states) {
                    *value = field.rational(state.get(input)?)?;
                }
                Some(values)
            }
            Step::Unary(Function::Neg, a) => Some(self.values[a]?.map(|x| field.sub(0, x))),
            Step::Unary(Function::Recip, a) => {
                let x = self.values[a].filter(|x| x.iter().all(|x| *x != 0))?;
                Some(x.map(|x| field.inverse(x)))
            }
            Step::Unary(Function::Sqrt, a) => match (self.graph.step(a), &replacements[a]) {
                (Step::Constant(square), _) => constant(&square_root(square)?),
                (_, Some((square, None))) => constant(&square_root(square)?),
                _ => None,
            },
            Step::Binary(operation, a, b) => {
                let (x, y) = (self.values[a]?, self.values[b]?);
                let combine: fn(&Modulus, u64, u64) -> u64 = match operation {
                    Operation::Add => Modulus::add,
                    Operation::Sub => Modulus::sub,
                    Operation::Mul => Modulus::mul,
                    Operation::Pow => return None,
                };
                Some(std::array::from_fn(|k| combine(field, x[k], y[k])))
            }
            Step::Unary(..) | Step::Power(..) => None,
        }
    }

    /// The exact value of a step at the first state, and of what it needs.
    fn exact(&mut self, place: usize) -> Option<Rational> {
        let mut needed = vec![false; place + 1];
        needed[place] = true;
        for index in (0..=place).rev().filter(|index| self.exact[*index].is_none()) {
            if needed[index] {
                self.graph.step(index).arguments().for_each(|argument| needed[argument] = true);
            }
        }
        for index in (0..=place).filter(|index| needed[*index]) {
            if self.exact[index].is_none() {
                self.exact[index] = Some(self.exact_step(self.graph.step(index)));
            }
        }
        self.exact[place].clone().flatten()
    }

    fn exact_step(&self, step: Step<'_>) -> Option<Rational> {
        let argument = |place: usize| self.exact[place].clone().flatten();
        let mut out = None;
        match step {
            Step::Constant(value) => out = Some(value.clone()),
            Step::Input(input) => out = self.states[0].get(input).cloned(),
            // What is not rational is not looked at.
            Step::Unary(function @ (Function::Neg | Function::Recip | Function::Sqrt), a) => {
                Exact.unary(function, &argument(a), &mut out);
            }
            Step::Unary(..) | Step::Power(..) => {}
            Step::Binary(operation, a, b) => {
                Exact.binary(operation, &Some(argument(a)?), &Some(argument(b)?), &mut out);
            }
        }
        out.filter(|value| value.bits() <= MAX_BITS)
    }
}

/// A state of the level in general position, and numbers for further inputs.
fn state(model: &Model, inputs: usize, index: usize) -> Result<Vec<Rational>, FlowError> {
    // Fractions without pattern: powers of a primitive root modulo a prime.
    let mut power = 5 + 7 * index as i64;
    let mut next = || {
        power = power * 14 % 2003;
        Rational::new(power - 1001, 499)
    };
    let draws: Vec<Rational> = (0..inputs).map(|_| next()).collect();
    let kept = vec![true; model.level.len()];
    let count = model.dimension();
    let (graph, made) = record(draws.len(), |draws| {
        let mut state = Chart::Rolling.point(model, &kept, &[], draws);
        state.truncate(count);
        state
    })?;
    let tape = Tape::new(&graph, &made);
    let mut evaluator = Evaluator::new(&tape, Exact);
    evaluator.run(&draws.iter().cloned().map(Some).collect::<Vec<_>>());
    let mut state: Vec<Rational> =
        evaluator.outputs().cloned().collect::<Option<_>>().ok_or(FlowError::NoStart)?;
    state.extend((state.len()..inputs).map(|_| next()));
    Ok(state)
}
