//! Derivative of the logarithm of a formula, taken factor by factor.
//!
//! A density is a product of powers and exponentials. Its value may overflow or need a root that
//! an exact number does not have, while `(ln ρ)' = Σ q f'/f` over its factors `f^q` does not.

use num_dual::Dual;

use super::arena::{Arena, Function, NodeId, Operation};
use super::evaluate::values;
use super::kind::Type;
use super::scope::Symbol;
use super::value::Value;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Returns `(ln f)'` of the arena's last node, along the direction in the dual parts of `lookup`.
///
/// Zero if the formula is not a scalar.
pub(super) fn logarithmic_derivative<T: Scalar>(
    arena: &Arena,
    lookup: &mut dyn FnMut(Symbol) -> Value<Dual<T>>,
) -> T {
    let values = values(arena, lookup);
    let root = arena.nodes.len() - 1;
    if arena.nodes[root].value_type != Type::Scalar {
        return T::zero();
    }
    let scalar = |node: NodeId| values[node].scalar().unwrap_or_else(|| Dual::from(0.0));
    let mut sum: Option<T> = None;
    let mut add = |term: T| sum = Some(sum.map_or(term, |sum| sum + term));
    // scalar factors form a tree: each is reached once
    let mut factors = vec![(root, T::one())];
    while let Some((node, coefficient)) = factors.pop() {
        match &arena.nodes[node].operation {
            Operation::Number(_) => {}
            Operation::Product(all) => factors.extend(all.iter().map(|a| (*a, coefficient))),
            Operation::Multiply(a, b) => factors.extend([(*b, coefficient), (*a, coefficient)]),
            Operation::Divide(a, b) => factors.extend([(*b, -coefficient), (*a, coefficient)]),
            Operation::Negate(a) | Operation::Function(Function::Modulus, a) => {
                factors.push((*a, coefficient));
            }
            Operation::Power(_, exponent) if exponent.is_zero() => {}
            Operation::Power(a, exponent) => {
                factors.push((*a, coefficient * T::rational(exponent)));
            }
            Operation::Function(Function::Sqrt, a) => {
                factors.push((*a, coefficient * T::rational(&Rational::new(1, 2))));
            }
            Operation::PowerOf(a, b) => {
                let exponent = scalar(*b);
                add(coefficient * exponent.eps * scalar(*a).re.ln());
                factors.push((*a, coefficient * exponent.re));
            }
            Operation::Function(Function::Exp, a) => add(coefficient * scalar(*a).eps),
            _ => {
                let factor = scalar(node);
                add(coefficient * factor.eps / factor.re);
            }
        }
    }
    sum.unwrap_or_else(T::zero)
}
