//! Values that are 0 for a = b and grow with a, which have the sign of a − b. Rule S11 of docs/soundness.md.

use rustc_hash::FxHashMap;

use crate::graph::{Expr, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::classes::Classes;
use crate::proof::extent::Extent;
use crate::scalar::Scalar;

use super::{MOST_PARTS, Region};

/// Largest number of operations of a value whose slope is taken.
const MOST_OPERATIONS: usize = 160;
/// Largest number of inputs along which slopes are taken.
const MOST_INPUTS: usize = 4;
/// Largest number of slopes of one question.
const MOST_SLOPES: usize = 48;

/// An input a and the place of a value b without it; `None` is the number 0.
type Line = (usize, Option<usize>);

/// Slopes of values over the extents of the inputs.
pub(super) struct Slopes<'r> {
    graph: &'r Graph,
    inputs: &'r [Extent],
    /// Whether values grow along lines, and whether they are 0 at a = b.
    known: FxHashMap<(usize, Line), Option<bool>>,
    are_known: bool,
}

impl<'r> Slopes<'r> {
    pub fn new(graph: &'r Graph, inputs: &'r [Extent]) -> Self {
        Self { graph, inputs, known: FxHashMap::default(), are_known: false }
    }

    /// Whether the product of the values at two places is never negative, or never positive.
    pub fn likeness(&mut self, first: usize, second: usize) -> Option<bool> {
        let lines = self.lines(first, second);
        let found = lines.into_iter().find_map(|line| {
            let own = self.growth(first, line)?;
            Some(own == self.growth(second, line)?)
        });
        self.are_known |= found.is_some();
        found
    }

    /// Whether some likeness is known.
    pub fn are_known(&self) -> bool {
        self.are_known
    }

    /// Lists the lines on which two values may be 0 together.
    fn lines(&self, first: usize, second: usize) -> Vec<Line> {
        let graph = self.graph;
        let linear: Vec<Line> =
            [first, second].iter().flat_map(|place| self.linear(*place)).collect();
        if !linear.is_empty() {
            return linear;
        }
        let [own, other] = [first, second].map(|place| graph.inputs_of(graph.at(place)));
        let common = own.into_iter().filter(|input| other.contains(input));
        common.take(MOST_INPUTS).map(|input| (input, None)).collect()
    }

    /// Reads a − b, for inputs a or b.
    fn linear(&self, place: usize) -> Vec<Line> {
        let input = |place: usize| match self.graph.step(place) {
            Step::Input(input) => Some(input),
            _ => None,
        };
        let lines = match self.graph.step(place) {
            Step::Input(input) => vec![(input, None)],
            Step::Binary(BinaryOperation::Sub, a, b) => {
                let lines = [(a, b), (b, a)].map(|(a, b)| Some((input(a)?, Some(b))));
                lines.into_iter().flatten().collect()
            }
            _ => Vec::new(),
        };
        let is_apart = |(input, at): &Line| {
            at.is_none_or(|at| !self.graph.depends_on(self.graph.at(at), *input))
        };
        lines.into_iter().filter(is_apart).collect()
    }

    /// Whether the value F at a place is 0 for a = b and grows with a, or falls, over all extents.
    fn growth(&mut self, place: usize, line: Line) -> Option<bool> {
        if let Some(known) = self.known.get(&(place, line)) {
            return *known;
        }
        if self.known.len() >= MOST_SLOPES {
            return None;
        }
        let found = self.found_growth(place, line);
        self.known.insert((place, line), found);
        found
    }

    fn found_growth(&self, place: usize, (input, at): Line) -> Option<bool> {
        let graph = self.graph;
        let value = graph.at(place);
        if graph.operations(&[value]) > MOST_OPERATIONS {
            return None;
        }
        let reached = graph.reached_from(&[Some(place), at].map(|place| place.unwrap_or_default()));
        let (own, recorded) = record(graph.inputs(), |inputs| {
            let values = graph.repeated(&reached, inputs);
            let begin = match at {
                Some(at) => values[at]?,
                None => Expr::rational(&Rational::from(0)),
            };
            let mut moved = inputs.to_vec();
            *moved.get_mut(input)? = begin;
            let zero = graph.repeated(&reached, &moved)[place]?;
            let (value, one) = (values[place]?, Expr::rational(&Rational::from(1)));
            let slope = Expr::derivatives_along(&[value], &[inputs[input]], &[one])?.pop()?;
            Some((value, begin, zero, slope))
        })
        .ok()?;
        let (value, begin, zero, slope) = recorded?;
        if !own.constant_value(zero).is_some_and(Rational::is_zero) {
            return None;
        }
        let mut inputs = self.inputs.to_vec();
        inputs.resize(own.inputs().max(inputs.len()), Extent::ALL);
        let classes = Classes::default();
        let whole = Region { graph: &own, inputs: &inputs, facts: &[], classes: &classes };
        let begin = own.place(begin);
        let ends = {
            let mut reach = whole.reached(&[begin]);
            let number = reach.number(begin);
            reach.bounds_of_inputs(&inputs)[number]
        };
        if ends.is_empty() {
            return None;
        }
        // The line from b to a.
        inputs[input] = inputs[input].hull(ends);
        let region = Region { graph: &own, inputs: &inputs, facts: &[], classes: &classes };
        region.smooth_sign(own.place(value), own.place(slope))
    }
}

impl Region<'_> {
    /// Finds the sign of a slope over all of the region, if the slope and its value exist everywhere on it.
    fn smooth_sign(&self, value: usize, slope: usize) -> Option<bool> {
        let mut reach = self.reached(&[value, slope]);
        let number = reach.number(slope);
        let needs: Vec<(usize, Need)> = reach
            .places()
            .iter()
            .filter_map(|place| {
                let (argument, need) = Need::of(self.graph.step(*place))?;
                Some((reach.number(argument), need))
            })
            .collect();
        let mut known = None;
        let mut parts = vec![(self.whole(), 0)];
        let mut looked = 0;
        while let Some((part, depth)) = parts.pop() {
            looked += 1;
            let bounds = reach.bounds_of_inputs(&part);
            let is_smooth = needs.iter().all(|(number, need)| need.is_met(bounds[*number]));
            match (bounds[number].sign().filter(|_| is_smooth), known) {
                (Some(sign), Some(before)) if sign != before => return None,
                (Some(sign), _) => known = Some(sign),
                (None, _) => match self.cut(&reach, part, depth) {
                    Some(halves) if looked + parts.len() + 2 <= MOST_PARTS => parts.extend(halves),
                    _ => return None,
                },
            }
        }
        known
    }
}

/// What an operation needs of its argument to be analytic there.
#[derive(Clone, Copy)]
enum Need {
    Positive,
    NotZero,
}

impl Need {
    /// The argument of a step and what is needed of it.
    fn of(step: Step<'_>) -> Option<(usize, Self)> {
        match step {
            Step::Unary(UnaryFunction::Recip | UnaryFunction::Abs, a) => Some((a, Need::NotZero)),
            Step::Unary(UnaryFunction::Sqrt | UnaryFunction::Ln, a)
            | Step::Binary(BinaryOperation::Pow, a, _) => Some((a, Need::Positive)),
            Step::Power(a, exponent) => match exponent.to_integer() {
                Some(0..) => None,
                Some(_) => Some((a, Need::NotZero)),
                None => Some((a, Need::Positive)),
            },
            _ => None,
        }
    }

    fn is_met(self, bound: Extent) -> bool {
        let is_nonzero = bound.excludes_zero() && !bound.is_empty();
        match self {
            Need::NotZero => is_nonzero,
            Need::Positive => is_nonzero && bound.sign() == Some(true),
        }
    }
}
