//! Products of two values that have the same sign: (p − q)(F(p) − F(q)) for an increasing F, and p sin p for |p| ≤ π.
//! Rule S6 of docs/soundness.md. Sums X − 1 − ln X: rule S12.

use crate::graph::{Graph, Step};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

use super::monotone::{is_sum_of_functions, sign_by_terms, terms};

/// Depth to which a value is looked at for its sign.
const MOST_STEPS: usize = 6;

/// Relation of the signs of two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Likeness {
    /// Their product is not negative wherever it exists, or not positive.
    Signed(bool),
    /// The same where the value at this place is between −π and π.
    WithinHalfTurns(usize, bool),
}

impl Likeness {
    /// Replaces the place by the number of its value.
    pub fn numbered(self, numbers: &[usize]) -> Self {
        match self {
            Likeness::WithinHalfTurns(place, is_positive) => {
                Likeness::WithinHalfTurns(numbers[place], is_positive)
            }
            Likeness::Signed(_) => self,
        }
    }
}

/// A value or a number.
#[derive(Clone, Debug, PartialEq)]
pub enum Side {
    /// The value at a place.
    Place(usize),
    /// A number.
    Number(Rational),
}

/// Finds what is known of the signs of the values at two places.
pub fn likeness(graph: &Graph, a: usize, b: usize) -> Option<Likeness> {
    let (a, b) = (without_factor(graph, a), without_factor(graph, b));
    one_way(graph, a, b).or_else(|| one_way(graph, b, a)).or_else(|| {
        let ((plain, sign), (place, other)) = (a, b);
        let is_alike =
            sign_by_terms(graph, plain, place).or_else(|| sign_by_terms(graph, place, plain))?;
        Some(Likeness::Signed((sign == other) == is_alike))
    })
}

/// The same where the second value is the one with functions.
fn one_way(
    graph: &Graph,
    (plain, sign): (usize, bool),
    (place, other): (usize, bool),
) -> Option<Likeness> {
    if let Step::Unary(UnaryFunction::Sin, p) = graph.step(place) {
        let (p, own) = without_factor(graph, p);
        let is_positive = (sign == other) == own;
        return (p == plain)
            .then_some(Likeness::WithinHalfTurns(argument(graph, place), is_positive));
    }
    let wholes = [difference(graph, place), (Side::Place(place), Side::Number(Rational::from(0)))];
    wholes.into_iter().find_map(|(above, below)| {
        let (p, q) = arguments(graph, &above, &below)?;
        let is_zero = |side: &Side| matches!(side, Side::Number(value) if value.is_zero());
        // The sign of p itself, where the other argument is 0.
        let whole = |side: &Side, rest: &Side| match side {
            Side::Place(place) if is_zero(rest) => {
                let (own, is_positive) = without_factor(graph, *place);
                (own == plain).then_some(is_positive)
            }
            _ => None,
        };
        // The sign of p − q is that of p, where q = −c p.
        let turns = |side: &Side, rest: &Side| match (side, rest) {
            (Side::Place(p), Side::Place(q)) => {
                let ((p, is_positive), (q, other)) =
                    (without_factor(graph, *p), without_factor(graph, *q));
                (p == q && p == plain && is_positive != other).then_some(is_positive)
            }
            _ => None,
        };
        let own = difference(graph, plain);
        let straight = (own == (p.clone(), q.clone())).then_some(true);
        let straight = straight.or_else(|| whole(&p, &q)).or_else(|| turns(&p, &q));
        let turned = (own == (q.clone(), p.clone())).then_some(true).or_else(|| whole(&q, &p));
        let is_straight = straight.or_else(|| turned.map(|own| !own))?;
        Some(Likeness::Signed((sign == other) == is_straight))
    })
}

/// Whether a value may be a difference of values of increasing functions, or the sine of an angle.
pub fn contains_increasing(graph: &Graph, place: usize) -> bool {
    let (place, _) = without_factor(graph, place);
    let (above, below) = difference(graph, place);
    let is_value = |side: &Side| match side {
        Side::Place(own) => increasing(graph.step(*own)).is_some(),
        Side::Number(_) => false,
    };
    let is_sine = matches!(graph.step(place), Step::Unary(UnaryFunction::Sin, _));
    is_sine || is_value(&above) || is_value(&below) || is_sum_of_functions(graph, place)
}

fn argument(graph: &Graph, place: usize) -> usize {
    match graph.step(place) {
        Step::Unary(_, a) => a,
        _ => place,
    }
}

/// The value without a minus, numbers and positive values as its factors, and whether these are positive.
fn without_factor(graph: &Graph, mut place: usize) -> (usize, bool) {
    let mut is_positive = true;
    loop {
        let factor = |k: usize| match graph.step(k) {
            Step::Constant(value) if !value.is_zero() => Some(!value.is_negative()),
            _ => None,
        };
        let (next, own) = match graph.step(place) {
            Step::Unary(UnaryFunction::Neg, a) => (a, false),
            Step::Binary(BinaryOperation::Mul, a, b) => match (factor(a), factor(b)) {
                (Some(own), None) => (b, own),
                (None, Some(own)) => (a, own),
                _ if is_positive_by_form(graph, b, MOST_STEPS) => (a, true),
                _ if is_positive_by_form(graph, a, MOST_STEPS) => (b, true),
                _ => return (place, is_positive),
            },
            _ => return (place, is_positive),
        };
        place = next;
        is_positive = is_positive == own;
    }
}

/// The sign of a sum c(X − 1 − ln X) + b with numbers c and b, where b is 0 or has the sign of c.
/// Rule S12 of docs/soundness.md.
pub fn sign_above_logarithm(graph: &Graph, place: usize) -> Option<bool> {
    let all = terms(graph, place, 3)?;
    let (slope, argument) = all.iter().find_map(|(factor, at)| match graph.step(*at) {
        Step::Unary(UnaryFunction::Ln, argument) => Some((-factor, argument)),
        _ => None,
    })?;
    let [(share, own)] = <[(Rational, usize); 1]>::try_from(terms(graph, argument, 1)?).ok()?;
    let (mut excess, mut is_met) = (slope.clone(), false);
    for (factor, at) in &all {
        match graph.step(*at) {
            Step::Unary(UnaryFunction::Ln, other) if other == argument => {}
            Step::Constant(value) => excess = &excess + &(factor * value),
            _ if *at == own && *factor == &slope * &share && !is_met => is_met = true,
            _ => return None,
        }
    }
    let is_met = is_met && (excess.is_zero() || excess.is_negative() == slope.is_negative());
    is_met.then(|| !slope.is_negative())
}

/// Whether the form shows that a value is positive wherever it exists.
pub(super) fn is_positive_by_form(graph: &Graph, place: usize, depth: usize) -> bool {
    let is_positive = |place: usize| depth > 0 && is_positive_by_form(graph, place, depth - 1);
    match graph.step(place) {
        Step::Constant(value) => !value.is_negative() && !value.is_zero(),
        Step::Unary(UnaryFunction::Exp, _) | Step::Binary(BinaryOperation::Pow, ..) => true,
        Step::Unary(UnaryFunction::Recip | UnaryFunction::Sqrt, a) | Step::Power(a, _) => {
            is_positive(a)
        }
        Step::Binary(BinaryOperation::Add | BinaryOperation::Mul, a, b) => {
            is_positive(a) && is_positive(b)
        }
        _ => false,
    }
}

/// Splits a value p − q.
fn difference(graph: &Graph, place: usize) -> (Side, Side) {
    let side = |k: usize| match graph.step(k) {
        Step::Constant(value) => Side::Number(value.clone()),
        _ => Side::Place(k),
    };
    let opposite = |k: usize| match graph.step(k) {
        Step::Constant(value) => Some(Side::Number(-value)),
        Step::Unary(UnaryFunction::Neg, a) => Some(side(a)),
        _ => None,
    };
    match graph.step(place) {
        Step::Binary(BinaryOperation::Sub, a, b) => (side(a), side(b)),
        Step::Binary(BinaryOperation::Add, a, b) => match (opposite(a), opposite(b)) {
            (_, Some(other)) => (side(a), other),
            (Some(other), _) => (side(b), other),
            _ => (Side::Place(place), Side::Number(Rational::from(0))),
        },
        _ => (Side::Place(place), Side::Number(Rational::from(0))),
    }
}

/// An increasing function.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Increasing {
    Unary(UnaryFunction),
    Power(Rational),
}

/// p and q with F(p) and F(q) for values, of which one at least is not a number.
pub fn arguments(graph: &Graph, above: &Side, below: &Side) -> Option<(Side, Side)> {
    let function = [above, below].into_iter().find_map(|side| match side {
        Side::Place(place) => increasing(graph.step(*place)),
        Side::Number(_) => None,
    });
    let (function, _) = function?;
    let of = |side: &Side| match side {
        Side::Place(place) => {
            let (own, argument) = increasing(graph.step(*place))?;
            (own == function).then_some(Side::Place(argument))
        }
        Side::Number(value) => Some(Side::Number(preimage(&function, value)?)),
    };
    Some((of(above)?, of(below)?))
}

/// The function of a step that increases wherever it has a value, and the place of its argument.
pub(super) fn increasing(step: Step<'_>) -> Option<(Increasing, usize)> {
    use UnaryFunction::{Atan, Exp, Ln, Sqrt};
    match step {
        Step::Unary(function @ (Atan | Exp | Ln | Sqrt), a) => {
            Some((Increasing::Unary(function), a))
        }
        Step::Power(a, exponent) if !exponent.is_negative() && !exponent.is_zero() => {
            let is_even = exponent.to_integer().is_some_and(|power| power % 2 == 0);
            (!is_even).then(|| (Increasing::Power(exponent.clone()), a))
        }
        _ => None,
    }
}

/// The number at which an increasing function has a value, if both are short.
fn preimage(function: &Increasing, value: &Rational) -> Option<Rational> {
    let number = |own: i64| Some(Rational::from(own));
    match function {
        Increasing::Unary(UnaryFunction::Exp) if value.is_one() => number(0),
        Increasing::Unary(UnaryFunction::Ln) if value.is_zero() => number(1),
        Increasing::Unary(UnaryFunction::Exp | UnaryFunction::Ln) => None,
        _ if value.is_zero() => number(0),
        Increasing::Unary(UnaryFunction::Sqrt) | Increasing::Power(_) if value.is_one() => {
            number(1)
        }
        _ => None,
    }
}
