//! Merging of the steps of a rolling body's field that are proportional on the level set.
//!
//! On the level (γ,γ) is 1, and a ball's r' is -Rγ': such relations are found modulo a prime at a
//! few states of the level, and their factors computed exactly at one of them. The level functions
//! stay integrals near the level for any values of r, Ĩ and the torques: γ' is orthogonal to γ, and
//! the multiplier preserves (ω,γ).

use std::cell::RefCell;

use crate::error::FlowError;
use liouville::graph::{Choice, Evaluator, Expr, Graph, Step, Tape, record};
use liouville::mechanics::Model;
use liouville::number::exact::{Exact, square_root};
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, Domain, UnaryFunction};

/// Number of states at which relations are tested.
const STATES: usize = 5;
/// 2⁶¹ - 1: steps that are not proportional appear so once in 10¹⁸ pairs.
const PRIME: u64 = (1 << 61) - 1;
/// Size above which exact values are dropped, in bits.
const MAX_BITS: u64 = 4096;
/// Size above which factors are coincidences of constants and useless, in bits.
const MAX_FACTOR_BITS: u64 = 256;

/// Rewrites values over a graph in which steps that are proportional on the level are one.
pub fn merged(
    model: &Model,
    graph: &Graph,
    wanted: &[Expr],
) -> Result<(Graph, Vec<Expr>), FlowError> {
    let reached = graph.reached(wanted.iter().copied());
    let states: Vec<Vec<Rational>> =
        (0..STATES).map(|index| state(model, graph.inputs(), index)).collect::<Result<_, _>>()?;
    let field = Modulus::new(PRIME);
    let mut exact = FirstState { graph, state: &states[0], values: vec![None; graph.len()] };
    let mut values = Vec::with_capacity(graph.len());
    for (place, step) in graph.steps().enumerate() {
        let is_looked_at = reached[place] || matches!(step, Step::Constant(_));
        let residues =
            if is_looked_at { residues(step, &values, &field, &states, &mut exact) } else { None };
        values.push(residues.map(|residues| StepValues { place, residues }));
    }
    let exact = RefCell::new(exact);
    let direction = |own: &StepValues| -> Option<[u64; STATES - 1]> {
        let [first, others @ ..] = own.residues;
        match own.is_zero() {
            // A multiple of 1.
            true => Some([field.one(); STATES - 1]),
            false if first == 0 => None,
            false => {
                let by_first = field.inverse(first);
                Some(others.map(|value| field.mul(value, by_first)))
            }
        }
    };
    let factor = |own: &StepValues, other: &StepValues| -> Option<Rational> {
        let mut exact = exact.borrow_mut();
        let factor = &exact.at(own.place)? * &exact.at(other.place)?.recip()?;
        let image = field.rational(&factor)?;
        let holds = (0..STATES).all(|k| field.mul(image, other.residues[k]) == own.residues[k]);
        (holds && factor.bits() <= MAX_FACTOR_BITS).then_some(factor)
    };
    let members = graph.members(&values, direction, factor);
    Ok(graph.rebuilt(wanted, &members, Choice::First)?)
}

/// Step with its values modulo the prime at all states.
struct StepValues {
    place: usize,
    residues: [u64; STATES],
}

impl StepValues {
    fn is_zero(&self) -> bool {
        self.residues == [0; STATES]
    }

    fn is_constant(&self) -> bool {
        self.residues.iter().all(|value| *value == self.residues[0])
    }
}

/// Values of a step modulo the prime. `None` where one is undefined or not in the field. Only roots
/// of constants are handled.
fn residues(
    step: Step<'_>,
    earlier: &[Option<StepValues>],
    field: &Modulus,
    states: &[Vec<Rational>],
    exact: &mut FirstState<'_>,
) -> Option<[u64; STATES]> {
    let constant = |value: &Rational| Some([field.rational(value)?; STATES]);
    let seen = |place: usize| earlier[place].as_ref();
    match step {
        Step::Constant(value) => constant(value),
        Step::Input(input) => {
            let mut values = [0; STATES];
            for (value, state) in values.iter_mut().zip(states) {
                *value = field.rational(state.get(input)?)?;
            }
            Some(values)
        }
        Step::Unary(UnaryFunction::Neg, a) => Some(seen(a)?.residues.map(|x| field.sub(0, x))),
        Step::Unary(UnaryFunction::Recip, a) => {
            let x = seen(a).filter(|x| x.residues.iter().all(|x| *x != 0))?;
            let mut inverses = [0; STATES];
            field.inverses(&x.residues, &mut inverses);
            Some(inverses)
        }
        Step::Unary(UnaryFunction::Sqrt, a) => {
            let square = seen(a).filter(|x| x.is_constant())?;
            constant(&square_root(&exact.at(square.place)?)?)
        }
        Step::Binary(operation, a, b) => {
            let (x, y) = (seen(a)?.residues, seen(b)?.residues);
            let combine: fn(&Modulus, u64, u64) -> u64 = match operation {
                BinaryOperation::Add => Modulus::add,
                BinaryOperation::Sub => Modulus::sub,
                BinaryOperation::Mul => Modulus::mul,
                BinaryOperation::Pow => return None,
            };
            Some(std::array::from_fn(|k| combine(field, x[k], y[k])))
        }
        Step::Unary(..) | Step::Power(..) => None,
    }
}

/// Exact values of steps at the first state, computed on demand.
struct FirstState<'g> {
    graph: &'g Graph,
    state: &'g [Rational],
    /// `Some(None)` where a value is irrational, undefined or too large.
    values: Vec<Option<Option<Rational>>>,
}

impl FirstState<'_> {
    /// Computes the value of a step, with all that it needs.
    fn at(&mut self, place: usize) -> Option<Rational> {
        let mut needed = vec![false; place + 1];
        needed[place] = true;
        for index in (0..=place).rev().filter(|index| self.values[*index].is_none()) {
            if needed[index] {
                self.graph.step(index).arguments().for_each(|argument| needed[argument] = true);
            }
        }
        for index in (0..=place).filter(|index| needed[*index]) {
            if self.values[index].is_none() {
                self.values[index] = Some(self.computed(self.graph.step(index)));
            }
        }
        self.values[place].clone().flatten()
    }

    fn computed(&self, step: Step<'_>) -> Option<Rational> {
        let argument = |place: usize| self.values[place].clone().flatten();
        let mut out = None;
        match step {
            Step::Constant(value) => out = Some(value.clone()),
            Step::Input(input) => out = self.state.get(input).cloned(),
            // Irrational values are dropped.
            Step::Unary(
                function @ (UnaryFunction::Neg | UnaryFunction::Recip | UnaryFunction::Sqrt),
                a,
            ) => {
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
        let mut state = model.system.chart().point(model, &kept, &[], draws);
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
