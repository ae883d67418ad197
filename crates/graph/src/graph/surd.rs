//! Roots of numbers a + b√n that are sums of two roots.

use super::{Graph, Node, NodeId};
use crate::number::exact::square_root;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

/// Largest depth of a sum that is read.
const DEEPEST: u32 = 6;

/// The number a + b√n.
struct Surd {
    a: Rational,
    b: Rational,
    n: Rational,
}

impl Graph {
    /// Writes √(a + b√n) as √x ± √y with x, y = (a ± √(a² − b²n))/2, if a² − b²n is a square.
    ///
    /// As x ≥ y, the square of the difference is a − 2√(xy) = a − |b|√n, and it is not negative.
    pub(super) fn denested(&mut self, place: NodeId) -> Option<NodeId> {
        let Surd { a, b, n } = self.surd(place, DEEPEST)?;
        if b.is_zero() || a.is_negative() || n.is_negative() {
            return None;
        }
        let half = Rational::new(1, 2);
        let rest = square_root(&(&(&a * &a) - &(&(&b * &b) * &n)))?;
        let [x, y] = [&a + &rest, &a - &rest].map(|sum| &sum * &half);
        let [x, y] = [x, y].map(|value| {
            let value = self.constant(value);
            self.unary(UnaryFunction::Sqrt, value)
        });
        Some(if b.is_negative() { self.sub(x, y) } else { self.add(x, y) })
    }

    /// Reads a value as a number a + b√n.
    fn surd(&self, place: NodeId, depth: u32) -> Option<Surd> {
        let zero = Rational::from(0);
        if let Some(a) = self.constant_at(place) {
            return Some(Surd { a: a.clone(), b: zero.clone(), n: zero });
        }
        let depth = depth.checked_sub(1)?;
        match self.node(place) {
            Node::Unary(UnaryFunction::Sqrt, n) => {
                let n = self.constant_at(n)?.clone();
                Some(Surd { a: zero, b: Rational::from(1), n })
            }
            Node::Unary(UnaryFunction::Neg, x) => {
                let Surd { a, b, n } = self.surd(x, depth)?;
                Some(Surd { a: -&a, b: -&b, n })
            }
            Node::Binary(BinaryOperation::Mul, x, y) => {
                let (x, y) = (self.surd(x, depth)?, self.surd(y, depth)?);
                let (factor, other) = match (x.b.is_zero(), y.b.is_zero()) {
                    (true, _) => (x.a, y),
                    (false, true) => (y.a, x),
                    (false, false) => return None,
                };
                Some(Surd { a: &factor * &other.a, b: &factor * &other.b, n: other.n })
            }
            Node::Binary(operation @ (BinaryOperation::Add | BinaryOperation::Sub), x, y) => {
                let (x, y) = (self.surd(x, depth)?, self.surd(y, depth)?);
                let n = match (x.b.is_zero(), y.b.is_zero()) {
                    (_, true) => x.n,
                    (true, false) => y.n.clone(),
                    (false, false) => (x.n == y.n).then_some(x.n)?,
                };
                Some(match operation {
                    BinaryOperation::Add => Surd { a: &x.a + &y.a, b: &x.b + &y.b, n },
                    _ => Surd { a: &x.a - &y.a, b: &x.b - &y.b, n },
                })
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use crate::graph::{Expr, record};

    #[test]
    fn roots_of_sums_with_a_root_are_sums_of_roots() {
        let number = |n: i32| Expr::from(f64::from(n));
        let same = |nested: &dyn Fn() -> Expr, plain: &dyn Fn() -> Expr| {
            let (_, is_same) = record(0, |_| nested() == plain()).expect("records");
            is_same
        };
        let two = || number(2).sqrt();
        assert!(same(&|| (number(3) + two() * 2.0).sqrt(), &|| two() + 1.0), "1 + √2");
        assert!(same(&|| (number(3) - two() * 2.0).sqrt(), &|| two() - 1.0), "√2 − 1, not 1 − √2");
        let five = || number(5).sqrt();
        assert!(same(&|| (number(6) - five() * 2.0).sqrt(), &|| five() - 1.0), "√5 − 1");
        assert!(!same(&|| (number(1) + two()).sqrt(), &|| two() + 1.0), "√(1 + √2) stays");
        assert!(!same(&|| (two() * 2.0 - number(3)).sqrt(), &|| two() - 1.0), "it has no value");
        let three = || (number(2) + number(3).sqrt()).sqrt();
        assert!(same(&three, &|| (number(3) * 0.5).sqrt() + (number(1) * 0.5).sqrt()));
    }
}
