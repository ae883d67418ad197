//! Sums Σ (F_i(p) − F_i(q)) of increasing functions F_i, as x³ + x − y³ − y, which have the sign of p − q; and Σ (F_i(p) +
//! F_i(q)) of odd ones, which have the sign of p + q.
//! Rule S8 of docs/soundness.md.

use crate::graph::{Graph, Step};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

use super::alike::{Increasing, increasing, is_positive_by_form};

/// Largest number of terms of a sum.
const MOST_TERMS: usize = 8;
/// Largest number of steps from a term to p.
const MOST_STEPS: usize = 12;
/// Largest power of a number that is compared.
const MOST_POWER: u32 = 64;
/// Largest depth of products that are read as a power.
const MOST_FACTORS: usize = 24;

/// A multiple of the value at a place.
type Term = (Rational, usize);

/// Comparison of F(p) with F(q).
#[derive(Clone, Copy, PartialEq)]
enum Growth {
    /// The values are equal.
    None,
    /// F increases, or decreases, wherever it has a value.
    Strict { is_increasing: bool, is_odd: bool },
}

/// Whether the value at a place has the sign of a sum or difference of two values, or the opposite one; both are 0
/// together. `None` where that is not known.
pub(super) fn sign_by_terms(graph: &Graph, plain: usize, place: usize) -> Option<bool> {
    let [(c, p), (d, q)] = <[Term; 2]>::try_from(terms(graph, plain, 2)?).ok()?;
    let mut open = terms(graph, place, MOST_TERMS)?;
    let pair = Pair { graph, slopes: [&c, &d], values: [p, q] };
    let mut known = None;
    while let Some(term) = open.pop() {
        let found = open.iter().enumerate().find_map(|(index, other)| {
            let sign = pair.sign(&term, other).or_else(|| pair.sign(other, &term))?;
            (known.is_none() || known == Some(sign)).then_some((index, sign))
        });
        let (index, sign) = found?;
        open.remove(index);
        known = Some(sign);
    }
    known
}

/// Whether a value is a sum with a term that is a value of an increasing function.
pub(super) fn is_sum_of_functions(graph: &Graph, place: usize) -> bool {
    let is_function = |own: &Term| {
        odd_power(graph, own.1).1 > 1
            || increasing(graph.step(own.1)).is_some()
            || matches!(graph.step(own.1), Step::Unary(UnaryFunction::Recip, _))
    };
    terms(graph, place, MOST_TERMS).is_some_and(|all| all.len() > 1 && all.iter().any(is_function))
}

/// Two values c p and d q, whose sum has a sign.
struct Pair<'g> {
    graph: &'g Graph,
    slopes: [&'g Rational; 2],
    values: [usize; 2],
}

impl Pair<'_> {
    /// The sign of s a + t b, if a belongs to p and b to q, as against that of c p + d q.
    fn sign(&self, (s, a): &Term, (t, b): &Term) -> Option<bool> {
        let [c, d] = self.slopes;
        let ((one, n), (two, m)) = (odd_power(self.graph, *a), odd_power(self.graph, *b));
        if [one, two] == self.values && n == m && n % 2 == 1 && n <= MOST_POWER {
            // k (c p)ⁿ + k (d q)ⁿ
            let slope = |own: &Rational| own.powi(-i32::try_from(n).ok()?);
            let (k, l) = (s * &slope(c)?, t * &slope(d)?);
            if k == l {
                return Some(!k.is_negative());
            }
        }
        let Growth::Strict { is_increasing, is_odd } = self.growth(*a, *b, MOST_STEPS)? else {
            return None;
        };
        let is_difference = *c == -d && *s == -t;
        let is_sum = c == d && s == t && is_odd;
        let is_alike = s.is_negative() == c.is_negative();
        (is_difference || is_sum).then_some(is_alike == is_increasing)
    }

    /// Compares a = F(p) with b = F(q).
    fn growth(&self, a: usize, b: usize, depth: usize) -> Option<Growth> {
        if [a, b] == self.values {
            return Some(Growth::Strict { is_increasing: true, is_odd: true });
        }
        if a == b {
            return Some(Growth::None);
        }
        let below = depth.checked_sub(1)?;
        let inner = |a: usize, b: usize| self.growth(a, b, below);
        let ((one, n), (two, m)) = (odd_power(self.graph, a), odd_power(self.graph, b));
        if n > 1 && n == m && n % 2 == 1 {
            return inner(one, two);
        }
        match (self.graph.step(a), self.graph.step(b)) {
            (Step::Binary(operation, a1, a2), Step::Binary(other, b1, b2))
                if operation == other =>
            {
                let straight = self.of_both(operation, [a1, a2], [b1, b2], below);
                // The arguments of sums and products are in no order.
                let turned = || match operation {
                    BinaryOperation::Add | BinaryOperation::Mul => {
                        self.of_both(operation, [a1, a2], [b2, b1], below)
                    }
                    BinaryOperation::Sub | BinaryOperation::Pow => None,
                };
                straight.or_else(turned)
            }
            (Step::Unary(UnaryFunction::Neg, a), Step::Unary(UnaryFunction::Neg, b)) => {
                Some(inner(a, b)?.turned())
            }
            (Step::Unary(UnaryFunction::Recip, a), Step::Unary(UnaryFunction::Recip, b)) => {
                let is_positive = |place| is_positive_by_form(self.graph, place, MOST_STEPS);
                let is_one_sided = is_positive(a) && is_positive(b);
                is_one_sided.then(|| Some(inner(a, b)?.turned().not_odd())).flatten()
            }
            (one, two) => {
                let ((function, a), (other, b)) = (increasing(one)?, increasing(two)?);
                let found = (function == other).then(|| inner(a, b)).flatten()?;
                let is_odd = function == Increasing::Unary(UnaryFunction::Atan);
                Some(if is_odd { found } else { found.not_odd() })
            }
        }
    }

    fn of_both(
        &self,
        operation: BinaryOperation,
        [a1, a2]: [usize; 2],
        [b1, b2]: [usize; 2],
        depth: usize,
    ) -> Option<Growth> {
        match operation {
            BinaryOperation::Add => self.growth(a1, b1, depth)?.with(self.growth(a2, b2, depth)?),
            BinaryOperation::Sub => {
                self.growth(a1, b1, depth)?.with(self.growth(a2, b2, depth)?.turned())
            }
            BinaryOperation::Mul => {
                let sign = |place: usize| match self.graph.step(place) {
                    Step::Constant(value) => (!value.is_zero()).then(|| !value.is_negative()),
                    _ => is_positive_by_form(self.graph, place, MOST_STEPS).then_some(true),
                };
                let (factor, [a, b]) = match (a1 == b1, a2 == b2) {
                    (true, false) => (a1, [a2, b2]),
                    (false, true) => (a2, [a1, b1]),
                    _ => return None,
                };
                let is_positive = sign(factor)?;
                let found = self.growth(a, b, depth)?;
                Some(if is_positive { found } else { found.turned() })
            }
            BinaryOperation::Pow => None,
        }
    }
}

impl Growth {
    fn turned(self) -> Self {
        match self {
            Growth::None => Growth::None,
            Growth::Strict { is_increasing, is_odd } => {
                Growth::Strict { is_increasing: !is_increasing, is_odd }
            }
        }
    }

    fn not_odd(self) -> Self {
        match self {
            Growth::None => Growth::None,
            Growth::Strict { is_increasing, .. } => Growth::Strict { is_increasing, is_odd: false },
        }
    }

    /// The growth of a sum; `None` where the parts are against each other.
    fn with(self, other: Self) -> Option<Self> {
        match (self, other) {
            (Growth::None, own) | (own, Growth::None) => Some(own.not_odd()),
            (
                Growth::Strict { is_increasing, is_odd },
                Growth::Strict { is_increasing: second, is_odd: other },
            ) => (is_increasing == second)
                .then_some(Growth::Strict { is_increasing, is_odd: is_odd && other }),
        }
    }
}

/// Lists the terms of a sum, each a multiple of a value that is no sum; `None` if there are more than `most`.
pub(super) fn terms(graph: &Graph, place: usize, most: usize) -> Option<Vec<Term>> {
    let number = |place: usize| match graph.step(place) {
        Step::Constant(value) if !value.is_zero() => Some(value),
        _ => None,
    };
    let (mut open, mut found) = (vec![(Rational::from(1), place)], Vec::new());
    while let Some((factor, at)) = open.pop() {
        match graph.step(at) {
            Step::Binary(BinaryOperation::Add, a, b) => {
                open.extend([(factor.clone(), b), (factor, a)]);
            }
            Step::Binary(BinaryOperation::Sub, a, b) => {
                open.extend([(-&factor, b), (factor, a)]);
            }
            Step::Unary(UnaryFunction::Neg, a) => open.push((-&factor, a)),
            Step::Binary(BinaryOperation::Mul, a, b) => match (number(a), number(b)) {
                (Some(number), None) => open.push((&factor * number, b)),
                (None, Some(number)) => open.push((&factor * number, a)),
                _ => found.push((factor, at)),
            },
            _ => found.push((factor, at)),
        }
        if found.len() + open.len() > most {
            return None;
        }
    }
    Some(found)
}

/// The base and the exponent of a product of equal values; a value itself is its first power.
fn odd_power(graph: &Graph, place: usize) -> (usize, u32) {
    fn read(graph: &Graph, place: usize, depth: usize) -> Option<(usize, u32)> {
        let Step::Binary(BinaryOperation::Mul, a, b) = graph.step(place) else {
            return Some((place, 1));
        };
        let depth = depth.checked_sub(1)?;
        let (base, n) = read(graph, a, depth)?;
        let (other, m) = if a == b { (base, n) } else { read(graph, b, depth)? };
        (base == other).then(|| Some((base, n.checked_add(m)?))).flatten()
    }
    read(graph, place, MOST_FACTORS).unwrap_or((place, 1))
}
