//! Polynomials in sines, cosines and roots whose factors are repeated once cos² is 1 − sin², or x the square of √x.

use super::arena::{Arena, ElementaryFunction, NodeId, NodeOperation};
use super::expanded::Reading;
use super::simple_factors::is_product;
use crate::number::rational::Rational;
use crate::proof::{MOST_POLYNOMIAL_WORK, Polynomial};

/// A polynomial with a repeated factor, which has the values of another one.
pub(super) struct Reduced {
    pub polynomial: Polynomial,
    /// Parts that it may contain no more, which have values where the others have.
    pub implied: Vec<u32>,
}

impl Reduced {
    /// Reduces a polynomial in the parts of a reading; `None` unless that shows a factor to be repeated.
    pub fn of(arena: &Arena, reading: &Reading<'_>, whole: &Polynomial) -> Option<Self> {
        let parts = &reading.parts;
        let function = |index: u32| match arena.nodes[*parts.get(index as usize)?].operation {
            NodeOperation::Function(function, of) => Some((function, of)),
            _ => None,
        };
        let own = whole.variables();
        let found = own.iter().find_map(|variable| {
            let (value, implied) = match function(*variable)? {
                (ElementaryFunction::Sin, angle) => {
                    let is_cosine = |other: &u32| {
                        matches!(function(*other), Some((ElementaryFunction::Cos, own)) if reading.is_same(own, angle))
                    };
                    let cosine = own.iter().copied().find(is_cosine)?;
                    // cos² = 1 − sin²
                    let sine = Polynomial::variable(*variable);
                    let square = sine.times(&sine, &mut { MOST_POLYNOMIAL_WORK })?;
                    let one = Polynomial::constant(&Rational::from(1));
                    (replaced(whole, cosine, 2, &one.plus(&square.scaled(&Rational::from(-1))))?, cosine)
                }
                (ElementaryFunction::Sqrt, radicand) => {
                    // x = √(x + c)² − c
                    let (coordinate, constant) = shifted(arena, radicand)?;
                    let is_coordinate = |other: &u32| {
                        parts.get(*other as usize).is_some_and(|own| reading.is_same(*own, coordinate))
                    };
                    let coordinate = own.iter().copied().find(is_coordinate)?;
                    let root = Polynomial::variable(*variable);
                    let square = root.times(&root, &mut { MOST_POLYNOMIAL_WORK })?;
                    let below = Polynomial::constant(&-&constant);
                    (replaced(whole, coordinate, 1, &square.plus(&below))?, coordinate)
                }
                _ => return None,
            };
            let is_repeated = !value.is_zero() && !is_product(&value, &value.factors());
            is_repeated.then_some((value, implied))
        });
        found.map(|(polynomial, implied)| Self { polynomial, implied: vec![implied] })
    }
}

/// Reads a radicand as x + c with a number c.
fn shifted(arena: &Arena, node: NodeId) -> Option<(NodeId, Rational)> {
    match arena.nodes[node].operation {
        NodeOperation::Add(a, b) => match (arena.constant(a), arena.constant(b)) {
            (None, Some(c)) => Some((a, c.clone())),
            (Some(c), None) => Some((b, c.clone())),
            _ => None,
        },
        NodeOperation::Subtract(a, b) => arena.constant(b).map(|c| (a, -c)),
        _ => Some((node, Rational::from(0))),
    }
}

/// Puts a polynomial in the place of a power of a variable; `None` where other powers of it occur.
fn replaced(
    whole: &Polynomial,
    variable: u32,
    power: u32,
    value: &Polynomial,
) -> Option<Polynomial> {
    let mut work = MOST_POLYNOMIAL_WORK;
    let mut sum = Polynomial::default();
    for (exponent, rest) in whole.by_powers(variable) {
        if exponent % power != 0 {
            return None;
        }
        let term = (0..exponent / power).try_fold(rest, |all, _| all.times(value, &mut work))?;
        sum = sum.plus(&term);
    }
    Some(sum)
}
