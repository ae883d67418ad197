//! Factors of a product that have the same sign, written next to each other.

use crate::graph::{Graph, Step};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;
use crate::order::StableOrder;

use super::alike::{Side, arguments, increasing};
use super::collected::{ReadValue, read_with, text};
use super::polynomial::Polynomial;

/// Two factors f and g, of which f times a number is p − q, and g times a number is F(p) − F(q).
pub(super) struct Pair {
    /// Numbers of the factors, each with f/(p − q) or g/(F(p) − F(q)).
    pub factors: [(usize, Rational); 2],
    /// (p − q)*(F(p) − F(q)), in brackets.
    pub text: String,
}

/// Finds pairs among factors with odd powers; no factor is in two of them.
pub(super) fn pairs(
    read: &ReadValue,
    graph: &Graph,
    names: &[String],
    factors: &[(Polynomial, u32)],
) -> Vec<Pair> {
    let mut found: Vec<Pair> = Vec::new();
    for second in 0..factors.len() {
        let is_free = |found: &[Pair], k: usize| {
            factors[k].1 % 2 == 1 && !found.iter().any(|pair| pair.factors.iter().any(|f| f.0 == k))
        };
        if !is_free(&found, second) {
            continue;
        }
        let Some(seen) = Seen::of(read, graph, &factors[second].0) else { continue };
        let Some(plain) = seen.difference(read, graph) else { continue };
        let multiple = |first: usize| {
            let mut work = super::polynomial::MOST_WORK;
            let share = plain.over(&factors[first].0, &mut work)?.number()?;
            Some((first, share.recip()?))
        };
        let other = (0..factors.len()).filter(|k| *k != second && is_free(&found, *k));
        let Some(first) = other.into_iter().find_map(multiple) else { continue };
        if let Some(text) = seen.text(graph, names) {
            found.push(Pair { factors: [first, (second, seen.share)], text });
        }
    }
    found
}

/// Writes a value Σ k (x − y)(F(x) − F(y)) in this form, for variables x and y and factors k that contain none of them.
pub(super) fn pair_sum(read: &ReadValue, graph: &Graph, names: &[String]) -> Option<String> {
    let place_of = |variable: u32| read.places.get(variable as usize).copied();
    // Functions with their arguments, by variables.
    let functions: Vec<(u32, u32)> = (0..read.places.len() as u32)
        .filter_map(|variable| {
            let (_, argument) = increasing(graph.step(place_of(variable)?))?;
            let argument = read.places.iter().position(|place| *place == argument)?;
            Some((variable, u32::try_from(argument).ok()?))
        })
        .collect();
    let own: Vec<u32> = functions.iter().map(|(variable, _)| *variable).collect();
    let arguments: Vec<u32> = functions.iter().map(|(_, argument)| *argument).collect();
    let count = functions.len();
    let unit = |powers: &[u32]| {
        let place = powers.iter().position(|power| *power == 1)?;
        (powers.iter().sum::<u32>() == 1).then_some(place)
    };
    let mut factors: Vec<Vec<Option<Polynomial>>> = vec![vec![None; count]; count];
    for (powers, coefficient) in read.whole.above.collected(&own) {
        let row = unit(&powers)?;
        for (powers, factor) in coefficient.collected(&arguments) {
            factors[row][unit(&powers)?] = Some(factor);
        }
    }
    let mut terms = Vec::new();
    for (row, factors) in factors.iter().enumerate() {
        for (column, factor) in factors.iter().enumerate().take(row) {
            let Some(factor) = factor else { continue };
            let side = |k: usize| Some(Side::Place(place_of(own[k])?));
            let argument = |k: usize| Some(Side::Place(place_of(arguments[k])?));
            let seen = Seen {
                share: Rational::from(1),
                above: side(row)?,
                below: side(column)?,
                p: argument(row)?,
                q: argument(column)?,
            };
            terms.push(format!("-({})*{}", factor.text(&read.names), seen.text(graph, names)?));
        }
    }
    (count > 1 && !terms.is_empty()).then(|| terms.join(" "))
}

/// A factor k (F(p) − F(q)), or k sin p.
struct Seen {
    share: Rational,
    above: Side,
    below: Side,
    p: Side,
    q: Side,
}

impl Seen {
    fn of(read: &ReadValue, graph: &Graph, factor: &Polynomial) -> Option<Self> {
        let mut sides: Vec<(Rational, Side)> = Vec::new();
        for (value, powers) in factor.terms() {
            let side = match powers {
                [] => Side::Number(Rational::from(1)),
                [(variable, 1)] => Side::Place(*read.places.get(*variable as usize)?),
                _ => return None,
            };
            sides.push((value.clone(), side));
        }
        // The first is a function; a number is written as one.
        sides.order_by_key(|(_, side)| matches!(side, Side::Number(_)));
        let zero = || Side::Number(Rational::from(0));
        let (share, above, below) = match sides.as_slice() {
            [(share, own)] => (share.clone(), own.clone(), zero()),
            [(share, own), (value, Side::Number(_))] => {
                let number = &-value * &share.recip()?;
                (share.clone(), own.clone(), Side::Number(number))
            }
            [(share, own), (other, below)] if (share + other).is_zero() => {
                (share.clone(), own.clone(), below.clone())
            }
            _ => return None,
        };
        let sine = match (&above, sides.len()) {
            (Side::Place(place), 1) => match graph.step(*place) {
                Step::Unary(UnaryFunction::Sin, p) => Some((Side::Place(p), zero())),
                _ => None,
            },
            _ => None,
        };
        let (p, q) = sine.or_else(|| arguments(graph, &above, &below))?;
        Some(Self { share, above, below, p, q })
    }

    /// p − q.
    fn difference(&self, read: &ReadValue, graph: &Graph) -> Option<Polynomial> {
        let of = |side: &Side| match side {
            Side::Number(value) => Some(Polynomial::constant(value)),
            Side::Place(place) => {
                let own = read_with(graph, *place, &read.places)?;
                Some(own.above.scaled(&own.below.number()?.recip()?))
            }
        };
        Some(of(&self.p)?.plus(&of(&self.q)?.scaled(&Rational::from(-1))))
    }

    fn text(&self, graph: &Graph, names: &[String]) -> Option<String> {
        let of = |side: &Side| match side {
            Side::Number(value) => Some(format!("({value})")),
            Side::Place(place) => text(graph, *place, names),
        };
        let less = |above: &Side, below: &Side| match below {
            Side::Number(value) if value.is_zero() => of(above),
            _ => Some(format!("({} - {})", of(above)?, of(below)?)),
        };
        Some(format!("({}*{})", less(&self.p, &self.q)?, less(&self.above, &self.below)?))
    }
}
