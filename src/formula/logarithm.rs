//! Derivative of the logarithm of a formula, taken factor by factor.
//!
//! A density is a product of powers and exponentials. Its value may overflow or need a root that
//! an exact number does not have, while `(ln ρ)' = Σ q f'/f` over its factors `f^q` does not.

use std::collections::BTreeMap;

use num_dual::Dual;

use super::arena::{Arena, ElementaryFunction, NodeId, NodeOperation};
use super::evaluate::values;
use super::kind::Type;
use super::scope::Symbol;
use super::value::Value;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// A term of `(ln f)'`: a coefficient times the derivative of a node, times or over a value.
struct Term<T> {
    coefficient: T,
    node: NodeId,
    beside: Beside<T>,
}

/// Partner of the derivative in a [`Term`]: a factor, a divisor, or none.
enum Beside<T> {
    Nothing,
    Factor(T),
    Divisor(T),
}

impl<T: Scalar> Term<T> {
    /// Computes the term from the derivative of its node.
    fn at(&self, derivative: T) -> T {
        let value = self.coefficient * derivative;
        match self.beside {
            Beside::Nothing => value,
            Beside::Factor(factor) => value * factor,
            Beside::Divisor(divisor) => value / divisor,
        }
    }
}

/// Returns `(ln f)'` of the arena's last node, along the direction in the dual parts of `lookup`.
///
/// Undefined if the formula is not a scalar.
#[inline(never)]
pub(super) fn logarithmic_derivative<T: Scalar>(
    arena: &Arena,
    lookup: &mut dyn FnMut(Symbol) -> Value<Dual<T>>,
) -> T {
    let values = values(arena, lookup);
    let scalar = |node: NodeId| values[node].scalar().unwrap_or_else(Dual::undefined);
    let Some(terms) = terms(arena, |node| scalar(node).re) else { return T::undefined() };
    let terms = terms.into_iter().map(|term| term.at(scalar(term.node).eps));
    terms.reduce(|sum, term| sum + term).unwrap_or_else(T::zero)
}

/// Partial derivatives of some values that are not 0, each with the place of its variable.
pub(super) type Gradients<'g, T> = &'g dyn Fn(&[T]) -> Option<Vec<Vec<(usize, T)>>>;

/// Returns the partial derivatives of `ln f` that are not 0 from those of the factors, with the
/// places of their variables.
#[inline(never)]
pub(super) fn logarithmic_gradient<T: Scalar>(
    arena: &Arena,
    lookup: &mut dyn FnMut(Symbol) -> Value<T>,
    gradients: Gradients<'_, T>,
) -> Option<Vec<(usize, T)>> {
    let values = values(arena, lookup);
    let scalar = |node: NodeId| values[node].scalar().unwrap_or_else(T::undefined);
    let terms = terms(arena, scalar)?;
    let nodes: Vec<T> = terms.iter().map(|term| scalar(term.node)).collect();
    let mut row: BTreeMap<usize, T> = BTreeMap::new();
    for (term, slopes) in terms.iter().zip(gradients(&nodes)?) {
        for (place, slope) in slopes {
            let part = term.at(slope);
            row.entry(place).and_modify(|sum| *sum += part).or_insert(part);
        }
    }
    Some(row.into_iter().collect())
}

/// Lists the terms of `(ln f)'` for the arena's last node; `None` if it is not a scalar.
fn terms<T: Scalar>(arena: &Arena, scalar: impl Fn(NodeId) -> T) -> Option<Vec<Term<T>>> {
    let root = arena.nodes.len() - 1;
    let mut terms = Vec::new();
    if arena.nodes[root].value_type != Type::Scalar {
        return None;
    }
    // scalar factors form a tree: each is reached once
    let mut factors = vec![(root, T::one())];
    while let Some((node, coefficient)) = factors.pop() {
        match &arena.nodes[node].operation {
            NodeOperation::Number(_) => {}
            NodeOperation::Product(all) => factors.extend(all.iter().map(|a| (*a, coefficient))),
            NodeOperation::Multiply(a, b) => factors.extend([(*b, coefficient), (*a, coefficient)]),
            NodeOperation::Divide(a, b) => factors.extend([(*b, -coefficient), (*a, coefficient)]),
            NodeOperation::Negate(a) | NodeOperation::Function(ElementaryFunction::Modulus, a) => {
                factors.push((*a, coefficient));
            }
            NodeOperation::Power(_, exponent) if exponent.is_zero() => {}
            NodeOperation::Power(a, exponent) => {
                factors.push((*a, coefficient * T::rational(exponent)));
            }
            NodeOperation::Function(ElementaryFunction::Sqrt, a) => {
                factors.push((*a, coefficient * T::rational(&Rational::new(1, 2))));
            }
            NodeOperation::PowerOf(a, b) => {
                let beside = Beside::Factor(scalar(*a).ln());
                terms.push(Term { coefficient, node: *b, beside });
                factors.push((*a, coefficient * scalar(*b)));
            }
            NodeOperation::Function(ElementaryFunction::Exp, a) => {
                terms.push(Term { coefficient, node: *a, beside: Beside::Nothing });
            }
            _ => {
                let beside = Beside::Divisor(scalar(node));
                terms.push(Term { coefficient, node, beside });
            }
        }
    }
    Some(terms)
}
