//! Hyperbolic functions as they are recorded, (e^u ∓ e^−u)/2.

use super::{Expr, Graph, Node, NodeId};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// A value sinh u or cosh u.
enum Hyperbolic {
    Sine(NodeId),
    Cosine(NodeId),
}

impl Expr {
    /// Returns u for sinh u, its area function at all numbers.
    pub(super) fn area_of_sine(self) -> Option<Self> {
        self.read(|graph, node| match graph.hyperbolic(node)? {
            (Hyperbolic::Sine(argument), is_negative) => Some((argument, is_negative)),
            (Hyperbolic::Cosine(_), _) => None,
        })
        .map(|(argument, is_negative)| if is_negative { -argument } else { argument })
    }

    /// Returns |u| for cosh u, its area function at all numbers.
    pub(super) fn area_of_cosine(self) -> Option<Self> {
        self.read(|graph, node| match graph.hyperbolic(node)? {
            (Hyperbolic::Cosine(argument), false) => Some((argument, false)),
            _ => None,
        })
        .map(|(argument, _)| argument.modulus())
    }
}

impl Graph {
    /// Reads a node as ± sinh u or ± cosh u; the second value tells whether there is a minus.
    fn hyperbolic(&self, node: NodeId) -> Option<(Hyperbolic, bool)> {
        let (node, is_negative) = self.unsigned(node, false);
        let Node::Binary(BinaryOperation::Mul, a, b) = self.node(node) else { return None };
        let half = Rational::new(1, 2);
        let is_half = |node: NodeId| self.constant_at(node) == Some(&half);
        let twice = match (is_half(a), is_half(b)) {
            (true, false) => b,
            (false, true) => a,
            _ => return None,
        };
        let (twice, is_negative) = self.unsigned(twice, is_negative);
        let Node::Binary(operation, a, b) = self.node(twice) else { return None };
        let (p, q) = (self.exponent(a)?, self.exponent(b)?);
        if self.negated(p) != Some(q) && self.negated(q) != Some(p) {
            return None;
        }
        match operation {
            BinaryOperation::Sub => Some((Hyperbolic::Sine(p), is_negative)),
            BinaryOperation::Add => Some((Hyperbolic::Cosine(p), is_negative)),
            BinaryOperation::Mul | BinaryOperation::Pow => None,
        }
    }

    fn unsigned(&self, node: NodeId, is_negative: bool) -> (NodeId, bool) {
        self.negated(node).map_or((node, is_negative), |inner| (inner, !is_negative))
    }

    fn exponent(&self, node: NodeId) -> Option<NodeId> {
        match self.node(node) {
            Node::Unary(UnaryFunction::Exp, a) => Some(a),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use crate::graph::{Expr, record};
    use crate::scalar::Scalar;

    fn is_same(one: impl Fn(Expr) -> Expr, other: impl Fn(Expr) -> Expr) -> bool {
        let (_, same) = record(2, |x| one(x[0]) == other(x[0])).expect("recorded");
        same
    }

    #[test]
    fn area_functions_undo_hyperbolic_ones() {
        assert!(is_same(|x| x.sinh().asinh(), |x| x));
        assert!(is_same(|x| (-x).sinh().asinh(), |x| -x));
        assert!(is_same(|x| (-x.sinh()).asinh(), |x| -x));
        assert!(is_same(|x| (x * x).sinh().asinh(), |x| x * x));
        assert!(is_same(|x| x.cosh().acosh(), |x| x.modulus()));
        assert!(is_same(|x| (-x).cosh().acosh(), |x| x.modulus()));
        assert!(!is_same(|x| x.cosh().acosh(), |x| x), "cosh is even");
        assert!(!is_same(|x| (-x.cosh()).acosh(), |x| x.modulus()), "no value");
        assert!(!is_same(|x| x.cosh().asinh(), |x| x.modulus()));
        assert!(!is_same(|x| x.sinh().acosh(), |x| x));
    }
}
