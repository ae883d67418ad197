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

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::{Evaluator, Tape};
    use crate::number::float::Float;
    use crate::number::prime::Modulus;
    use crate::proof::ProofRng;

    fn number(text: &str) -> Expr {
        Expr::rational(&text.parse().expect("a number"))
    }

    /// The sign of a value over ranges, by slopes.
    fn sign(ends: &[(&str, &str)], build: impl FnOnce(&[Expr]) -> Expr) -> Option<bool> {
        let (graph, value) = record(ends.len(), build).expect("records");
        let end = |text: &str| text.parse().expect("a number");
        let inputs: Vec<Extent> =
            ends.iter().map(|(low, high)| Extent::between(&end(low), &end(high))).collect();
        let classes = Classes::default();
        let region = Region { graph: &graph, inputs: &inputs, facts: &[], classes: &classes };
        region.sign_by_slopes(graph.place(value))
    }

    #[test]
    fn growth_from_zero_gives_a_sign() {
        let one = [("-1", "1")];
        assert_eq!(sign(&one, |x| x[0] * (x[0] - x[0].sin())), Some(true));
        assert_eq!(sign(&one, |x| x[0] * (x[0] - x[0].sin() * number("6/5"))), None, "falls at 0");
        assert_eq!(sign(&one, |x| x[0] * (x[0] - x[0].sin() + number("0.1"))), None, "0.1 at 0");
        assert_eq!(sign(&one, |x| -x[0] * (x[0].exp() - 1.0 + x[0])), Some(false));
        let tanh = |x: Expr| (x.exp() - (-x).exp()) / (x.exp() + (-x).exp());
        assert_eq!(sign(&one, |x| tanh(x[0]) * (x[0] + x[0].atan())), Some(true), "no factor is x");
        let all = [("-1", "1"), ("1/2", "1")];
        assert_eq!(sign(&all, |x| x[0] * ((x[0] * x[1]).exp() - 1.0) * x[1]), Some(true));
        let all = [("-1", "1"), ("-1/2", "1")];
        assert_eq!(sign(&all, |x| x[0] * ((x[0] * x[1]).exp() - 1.0)), None, "of both signs");
    }

    #[test]
    fn differences_have_the_sign_of_growth() {
        let both = [("-2", "2"), ("1/2", "3")];
        let cube = |x: Expr| x * x * x + x * number("2") - x.sin();
        assert_eq!(sign(&both, |x| (x[0] - x[1]) * (cube(x[0]) - cube(x[1]))), Some(true));
        assert_eq!(sign(&both, |x| (x[1] - x[0]) * (cube(x[0]) - cube(x[1]))), Some(false));
        let falls = |x: Expr| x * x * x - x;
        assert_eq!(sign(&both, |x| (x[0] - x[1]) * (falls(x[0]) - falls(x[1]))), None);
        // x³ − 3x grows for x > 1, but not on the way there from 0.
        let range = [("6/5", "3/2")];
        let wrong = |x: &[Expr]| x[0] * (x[0] * x[0] * x[0] - x[0] * number("3"));
        assert_ne!(sign(&range, wrong), Some(true));
    }

    #[test]
    fn a_pole_on_the_way_says_nothing() {
        // 1 + 1/(x − 1) falls wherever it exists, is 0 at 0, and is positive for x > 1.
        let falls = |x: &[Expr]| x[0] * ((x[0] - 1.0).recip() + 1.0);
        assert_eq!(sign(&[("-1", "1/2")], falls), Some(false));
        assert_eq!(sign(&[("-1", "3")], falls), None);
        // The root has no value between −1 and 1.
        let root = |x: &[Expr]| x[0] * (x[0] + (x[0] * x[0] - 1.0).sqrt() * 0.0 + x[0].modulus());
        assert_eq!(sign(&[("-2", "2")], root), None);
    }

    #[test]
    fn no_random_product_has_another_sign() {
        let (mut rng, modulus) = (ProofRng::new(7, 0), Modulus::new((1 << 61) - 1));
        let mut draw = |n: usize| (rng.element(&modulus) % n as u64) as usize;
        let mut known = 0;
        for round in 0..1000 {
            let operations: Vec<[usize; 3]> =
                (0..5).map(|k| [draw(10), draw(6 + k), draw(6 + k)]).collect();
            let value = |x: &[Expr]| {
                let numbers = ["1", "2", "1/2"].map(number);
                let mut own: Vec<Expr> = x.iter().copied().chain(numbers).collect();
                for [operation, a, b] in &operations {
                    let (a, b) = (own[*a], own[*b]);
                    own.push(match operation {
                        0 | 1 => a + b,
                        2 | 3 => a - b,
                        4 => a * b,
                        5 => a.exp(),
                        6 => a.sin(),
                        7 => a.recip(),
                        8 => (a + number("3")).ln(),
                        _ => a.modulus(),
                    });
                }
                own[own.len() - 1]
            };
            let (line, is_difference) = (draw(3), draw(2) == 0);
            let (graph, value) = record(3, |x| {
                let begin = if is_difference { x[(line + 1) % 3] } else { number("0") };
                let mut moved = x.to_vec();
                moved[line] = begin;
                (x[line] - begin) * (value(x) - value(&moved))
            })
            .expect("records");
            let ends = [("-1", "1"), ("1/2", "3/2"), ("-1/2", "2")];
            let end = |text: &str| text.parse().expect("a number");
            let inputs = ends.map(|(low, high)| Extent::between(&end(low), &end(high)));
            let classes = Classes::default();
            let region = Region { graph: &graph, inputs: &inputs, facts: &[], classes: &classes };
            let Some(sign) = region.sign_by_slopes(graph.place(value)) else { continue };
            known += 1;
            let tape = Tape::new(&graph, &[value]);
            let mut evaluator = Evaluator::new(&tape, Float::<1>);
            for _ in 0..40 {
                let at = inputs.map(|own| {
                    let [low, high] = own.ends().expect("finite");
                    [low + (high - low) * draw(1 << 20) as f64 / (1 << 20) as f64]
                });
                evaluator.run(&at);
                let found = evaluator.output(0)[0];
                let is_right = if sign { found > -1e-9 } else { found < 1e-9 };
                assert!(is_right || found.is_nan(), "round {round}: {found} at {at:?}");
            }
        }
        assert!(known > 100, "{known} signs");
    }
}
