//! Factors of a formula, as it is written.

use super::Formula;
use super::arena::{Arena, ElementaryFunction, NodeId, NodeOperation};
use super::kind::Type;
use crate::number::rational::Rational;

/// Largest number of factors.
const MOST_FACTORS: usize = 16;

/// A term k Aⁿ; a number k has no base.
struct Term {
    factor: Rational,
    base: Option<NodeId>,
    exponent: u32,
}

impl Formula {
    /// Returns formulas of which one is 0 at exactly those real points at which this one is, where all of
    /// them have values everywhere: those of a product, of a power, of |A|, and of k Aⁿ − l Bⁿ = 0, which is
    /// A = r B, and A = −r B for even n, with rⁿ = l/k, a rational r or n > 2; and k |u| − l |v| = 0, which is k² |u|² = l² |v|² for l/k ≥ 0;
    /// and those over ℚ of a sum, as a polynomial in its parts.
    /// `None` if the formula is none of these.
    pub(crate) fn factors(&self) -> Option<Vec<Formula>> {
        let mut arena = self.arena.clone();
        let whole = arena.nodes.len().checked_sub(1)?;
        let (mut open, mut found) = (vec![whole], Vec::new());
        while let Some(node) = open.pop() {
            if open.len() + found.len() >= MOST_FACTORS {
                return None;
            }
            match &arena.nodes[node].operation {
                NodeOperation::Negate(a)
                | NodeOperation::Function(ElementaryFunction::Modulus, a) => {
                    open.push(*a);
                }
                NodeOperation::Power(a, exponent)
                    if exponent.to_integer().is_some_and(|exponent| exponent > 0) =>
                {
                    open.push(*a);
                }
                NodeOperation::Multiply(a, b) => open.extend([*b, *a]),
                NodeOperation::Number(value) if !value.is_zero() => {}
                NodeOperation::Subtract(a, b) => {
                    let (a, b) = (*a, *b);
                    match difference(&mut arena, a, b) {
                        Some(parts) => open.extend(parts.into_iter().rev()),
                        None => found.extend(expanded(&mut arena, node)),
                    }
                }
                NodeOperation::Add(..) | NodeOperation::Sum(_) => {
                    found.extend(expanded(&mut arena, node));
                }
                _ => found.push(node),
            }
        }
        if found.is_empty() || found == [whole] {
            return None;
        }
        let of_node =
            |node: NodeId| Formula { text: self.text.clone(), arena: arena.ending_at(node) };
        Some(found.into_iter().map(of_node).collect())
    }
}

/// Returns the factors of a sum that is written out, or the sum.
fn expanded(arena: &mut Arena, node: NodeId) -> Vec<NodeId> {
    arena.expanded_factors(node).unwrap_or_else(|| vec![node])
}

/// Reads a node as a term.
fn term(arena: &Arena, node: NodeId) -> Term {
    let whole = |factor: Rational| Term { factor, base: Some(node), exponent: 1 };
    let one = Rational::from(1);
    if let Some(value) = arena.constant(node) {
        return Term { factor: value.clone(), base: None, exponent: 0 };
    }
    match &arena.nodes[node].operation {
        NodeOperation::Negate(a) => {
            let own = term(arena, *a);
            Term { factor: -&own.factor, ..own }
        }
        NodeOperation::Multiply(a, b) => {
            let (number, other) = match (arena.constant(*a), arena.constant(*b)) {
                (Some(number), None) => (number.clone(), *b),
                (None, Some(number)) => (number.clone(), *a),
                _ => return whole(one),
            };
            let own = term(arena, other);
            Term { factor: &own.factor * &number, ..own }
        }
        NodeOperation::Divide(a, b) => match arena.constant(*b).and_then(Rational::recip) {
            Some(below) => {
                let own = term(arena, *a);
                Term { factor: &own.factor * &below, ..own }
            }
            None => whole(one),
        },
        NodeOperation::Power(a, exponent) => {
            let exponent = exponent.to_integer().and_then(|exponent| u32::try_from(exponent).ok());
            match (exponent.filter(|exponent| *exponent >= 2), arena.squared_norm(*a)) {
                // |v|⁴ = (v,v)²
                (Some(exponent), Some(square)) if exponent % 2 == 0 => match exponent / 2 {
                    1 => whole(one),
                    exponent => Term { factor: one, base: Some(square), exponent },
                },
                (Some(exponent), _) => Term { factor: one, base: Some(*a), exponent },
                (None, _) => whole(one),
            }
        }
        _ => whole(one),
    }
}

/// Divides a difference of terms of the same degree.
fn difference(arena: &mut Arena, a: NodeId, b: NodeId) -> Option<Vec<NodeId>> {
    let (mut above, mut below) = (term(arena, a), term(arena, b));
    if above.base.is_none() {
        (above, below) = (below, above);
    }
    let base = above.base?;
    let exponent = above.exponent;
    let ratio = &below.factor * &above.factor.recip()?;
    let span = arena.nodes[a].span.start..arena.nodes[b].span.end;
    if exponent == 1 && below.exponent <= 1 {
        // |u| = r |v| is |u|² = r² |v|².
        if ratio.is_negative() {
            return None;
        }
        let square = squared(arena, base)?;
        let other = below.base.map(|other| squared(arena, other));
        let number = NodeOperation::Number(&ratio * &ratio);
        let number = arena.push(number, Type::Scalar, span.clone());
        let other = match other {
            Some(other) => {
                let product = NodeOperation::Multiply(number, other?);
                arena.push(product, Type::Scalar, span.clone())
            }
            None => number,
        };
        return Some(vec![arena.push(NodeOperation::Subtract(square, other), Type::Scalar, span)]);
    }
    if exponent < 2 || below.base.is_some() && below.exponent != exponent {
        return None;
    }
    let is_even = exponent.is_multiple_of(2);
    if is_even && ratio.is_negative() {
        return None;
    }
    let rational = root(&ratio, exponent);
    // Quadratic equations are solved by their own rules.
    if rational.is_none() && exponent < 3 {
        return None;
    }
    let mut push = |operation| arena.push(operation, Type::Scalar, span.clone());
    let number = match rational {
        Some(root) => push(NodeOperation::Number(root)),
        None => {
            let size = push(NodeOperation::Number(ratio.abs()));
            let root = push(NodeOperation::Power(size, Rational::new(1, i64::from(exponent))));
            if ratio.is_negative() { push(NodeOperation::Negate(root)) } else { root }
        }
    };
    let other = match below.base {
        Some(other) => push(NodeOperation::Multiply(number, other)),
        None => number,
    };
    let mut parts = vec![push(NodeOperation::Subtract(base, other))];
    if is_even {
        parts.push(push(NodeOperation::Add(base, other)));
    }
    Some(parts)
}

/// Returns the square of a node that is a norm or a modulus.
fn squared(arena: &mut Arena, node: NodeId) -> Option<NodeId> {
    if let NodeOperation::Function(ElementaryFunction::Modulus, x) = arena.nodes[node].operation {
        let span = arena.nodes[node].span.clone();
        let square = NodeOperation::Power(x, Rational::from(2));
        return Some(arena.push(square, Type::Scalar, span));
    }
    arena.squared_norm(node)
}

/// Returns the real root of a rational number, not negative for an even exponent, if it is rational.
fn root(value: &Rational, exponent: u32) -> Option<Rational> {
    if value.is_negative() && exponent.is_multiple_of(2) {
        return None;
    }
    let (above, below) = value.parts();
    let (above, below) = (above.nth_root(exponent), below.nth_root(exponent));
    let root = Rational::from_parts(above, below);
    let power = root.powi(i32::try_from(exponent).ok()?)?;
    (power == *value).then_some(root)
}
