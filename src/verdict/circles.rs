//! Sines and cosines of sums of angles, by points of a circle for each angle.

use std::collections::BTreeMap;

use crate::graph::{Expr, Graph, Step};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// Largest multiple of an angle that is taken apart.
const MOST_MULTIPLE: i64 = 6;
/// Largest number of terms of an argument.
const MOST_TERMS: usize = 12;

/// Multiples of values, by place.
type Terms = Vec<(usize, Rational)>;
/// Whole multiples of angles, by number.
type Sum = Vec<(usize, i64)>;

/// Sines and cosines of some values, whose arguments are whole multiples of angles.
pub(super) struct Circles {
    /// Number of angles.
    count: usize,
    /// Arguments of the sines and cosines, by their places.
    sums: BTreeMap<usize, (bool, Sum)>,
}

impl Circles {
    /// Finds the angles of the sines and cosines at some places.
    pub fn of(graph: &Graph, places: impl Iterator<Item = usize>) -> Self {
        let mut arguments: Vec<(usize, bool, Terms)> = Vec::new();
        for place in places {
            let (is_sine, argument) = match graph.step(place) {
                Step::Unary(UnaryFunction::Sin, a) => (true, a),
                Step::Unary(UnaryFunction::Cos, a) => (false, a),
                _ => continue,
            };
            let whole = || vec![(argument, Rational::from(1))];
            arguments.push((place, is_sine, terms(graph, argument).unwrap_or_else(whole)));
        }
        let mut units: BTreeMap<usize, Option<Rational>> = BTreeMap::new();
        for (angle, multiple) in arguments.iter().flat_map(|(.., sum)| sum) {
            let unit = units.entry(*angle).or_insert_with(|| Some(multiple.abs()));
            *unit = unit.as_ref().and_then(|unit| common(unit, &multiple.abs()));
        }
        let numbers: BTreeMap<usize, usize> =
            units.keys().enumerate().map(|(number, angle)| (*angle, number)).collect();
        let mut own = Self { count: numbers.len(), sums: BTreeMap::new() };
        for (place, is_sine, sum) in arguments {
            let whole = |(angle, multiple): &(usize, Rational)| {
                let unit = units.get(angle)?.as_ref()?;
                let multiple = (multiple * &unit.recip()?).to_integer()?;
                (multiple.abs() <= MOST_MULTIPLE).then_some((*numbers.get(angle)?, multiple))
            };
            match sum.iter().map(whole).collect::<Option<Sum>>() {
                Some(sum) => own.sums.insert(place, (is_sine, sum)),
                // An angle of its own.
                None => {
                    own.count += 1;
                    own.sums.insert(place, (is_sine, vec![(own.count - 1, 1)]))
                }
            };
        }
        own
    }

    /// Number of angles, with a parameter of its circle for each.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether the step at a place is such a sine or cosine.
    pub fn contains(&self, place: usize) -> bool {
        self.sums.contains_key(&place)
    }

    /// Records sine and cosine of each angle from the parameters t: ((1 − t²)/(1 + t²), 2t/(1 + t²)).
    pub fn points(parameters: &[Expr]) -> Vec<[Expr; 2]> {
        let number = |value: i64| Expr::rational(&Rational::from(value));
        let point = |t: &Expr| {
            let square = *t * *t;
            let below = number(1) + square;
            [number(2) * *t / below, (number(1) - square) / below]
        };
        parameters.iter().map(point).collect()
    }

    /// Records the sines and cosines, by their places, from those of the angles.
    pub fn values(&self, points: &[[Expr; 2]]) -> Option<BTreeMap<usize, Expr>> {
        let number = |value: i64| Expr::rational(&Rational::from(value));
        let value = |(place, (is_sine, sum)): (&usize, &(bool, Sum))| {
            let mut whole = [number(0), number(1)];
            for (angle, multiple) in sum {
                let [sine, cosine] = *points.get(*angle)?;
                let own = if *multiple < 0 { [-sine, cosine] } else { [sine, cosine] };
                for _ in 0..multiple.unsigned_abs() {
                    whole = [
                        whole[0] * own[1] + whole[1] * own[0],
                        whole[1] * own[1] - whole[0] * own[0],
                    ];
                }
            }
            Some((*place, whole[usize::from(!*is_sine)]))
        };
        self.sums.iter().map(value).collect()
    }
}

/// The largest number of which two positive ones are whole multiples.
fn common(first: &Rational, second: &Rational) -> Option<Rational> {
    let ((a, b), (c, d)) = (first.small_parts()?, second.small_parts()?);
    let (mut above, mut rest) = (a.checked_mul(d)?, c.checked_mul(b)?);
    while rest != 0 {
        (above, rest) = (rest, above % rest);
    }
    Some(Rational::new(above, b.checked_mul(d)?))
}

/// A value as a sum of multiples of values that are no sums.
fn terms(graph: &Graph, place: usize) -> Option<Terms> {
    let mut found: BTreeMap<usize, Rational> = BTreeMap::new();
    let mut open = vec![(place, Rational::from(1))];
    let number = |place: usize| match graph.step(place) {
        Step::Constant(value) if !value.is_zero() => Some(value),
        _ => None,
    };
    while let Some((at, factor)) = open.pop() {
        match graph.step(at) {
            Step::Binary(BinaryOperation::Add, a, b) => {
                open.extend([(a, factor.clone()), (b, factor)])
            }
            Step::Binary(BinaryOperation::Sub, a, b) => {
                open.extend([(a, factor.clone()), (b, -&factor)])
            }
            Step::Unary(UnaryFunction::Neg, a) => open.push((a, -&factor)),
            Step::Binary(BinaryOperation::Mul, a, b) => match (number(a), number(b)) {
                (Some(own), None) => open.push((b, &factor * own)),
                (None, Some(own)) => open.push((a, &factor * own)),
                _ => add(&mut found, at, &factor),
            },
            _ => add(&mut found, at, &factor),
        }
        if found.len() + open.len() > MOST_TERMS {
            return None;
        }
    }
    found.retain(|_, multiple| !multiple.is_zero());
    Some(found.into_iter().collect())
}

fn add(found: &mut BTreeMap<usize, Rational>, at: usize, factor: &Rational) {
    let sum = found.entry(at).or_insert_with(|| Rational::from(0));
    *sum = &*sum + factor;
}
