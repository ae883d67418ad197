//! Construction of nodes: equal nodes are shared, and simplifications change no value.
//!
//! Folded: constants, 0 and 1, signs (pulled outwards, so that `a - b` and `b - a` share a node),
//! `x - x`, `x · 1/x`, `√x · √x`, `exp(ln x)`. Where both sides have a value it is the same; the
//! simpler side may have one at more points (`x · 1/x` at 0), unless it is recorded
//! [`literally`](super::literally). A value that is defined nowhere (1/0) stays so: nothing that
//! contains it is folded. Not rewritten, because that would change the real meaning: `√(x²)`,
//! `(xᵃ)ᵇ`.

use super::{Graph, Node, NodeId, ONE, ZERO};
use crate::number::exact::square_root;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

/// Size in bits up to which constants are folded exactly.
const MAX_CONSTANT_BITS: u64 = 1 << 12;
/// Largest exponent of an integer power that is multiplied out, by squaring.
const MAX_UNROLLED: u32 = 1 << 20;

impl Graph {
    pub(super) fn constant(&mut self, value: Rational) -> NodeId {
        let index = self.intern_constant(value);
        self.intern(Node::Constant(index))
    }

    pub(super) fn input(&mut self) -> NodeId {
        let index = self.inputs;
        self.inputs += 1;
        self.intern(Node::Input(index))
    }

    /// Returns the free symbol for an antiderivative, the same one for the same arguments.
    pub(super) fn antiderivative(&mut self, integrand: NodeId, variable: NodeId) -> NodeId {
        if let Some(index) = self.antiderivatives.get(&(integrand, variable)) {
            let node = Node::Input(*index);
            return self.intern(node);
        }
        self.antiderivatives.insert((integrand, variable), self.inputs);
        self.input()
    }

    /// Returns the argument of a negation.
    pub(super) fn negated(&self, id: NodeId) -> Option<NodeId> {
        self.argument(UnaryFunction::Neg, id)
    }

    /// Returns the argument of the node if it is an application of `function`.
    fn argument(&self, function: UnaryFunction, id: NodeId) -> Option<NodeId> {
        match self.node(id) {
            Node::Unary(f, a) if f == function => Some(a),
            _ => None,
        }
    }

    fn fold(
        &mut self,
        a: NodeId,
        b: NodeId,
        operation: impl FnOnce(&Rational, &Rational) -> Rational,
    ) -> Option<NodeId> {
        let value = operation(self.constant_at(a)?, self.constant_at(b)?);
        (value.bits() <= MAX_CONSTANT_BITS).then(|| self.constant(value))
    }

    #[inline(always)]
    pub(super) fn binary(&mut self, operation: BinaryOperation, a: NodeId, b: NodeId) -> NodeId {
        match operation {
            BinaryOperation::Add => self.add(a, b),
            BinaryOperation::Sub => self.sub(a, b),
            BinaryOperation::Mul => self.mul(a, b),
            BinaryOperation::Pow => self.pow(a, b),
        }
    }

    /// Whether a node is an input, a sum, a difference or a product: of the rules below, only those for
    /// constant factors and for roots look at these.
    #[inline]
    fn is_plain(&self, id: NodeId) -> bool {
        matches!(self.node(id), Node::Input(_) | Node::Binary(..))
    }

    fn commutative(&mut self, operation: BinaryOperation, a: NodeId, b: NodeId) -> NodeId {
        self.intern(Node::Binary(operation, a.min(b), a.max(b)))
    }

    #[inline]
    pub(super) fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        // Most entries of derivatives are zero: compare places rather than look at the node.
        if a == ZERO {
            return b;
        }
        if b == ZERO {
            return a;
        }
        self.sum(a, b)
    }

    /// Adds values other than 0.
    fn sum(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if self.is_plain(a) && self.is_plain(b) {
            return self.commutative(BinaryOperation::Add, a, b);
        }
        if let Some(folded) = self.fold(a, b, |x, y| x + y) {
            return folded;
        }
        match (self.negated(a), self.negated(b)) {
            (_, Some(y)) => self.sub(a, y),
            (Some(x), None) => self.sub(b, x),
            (None, None) => self.commutative(BinaryOperation::Add, a, b),
        }
    }

    pub(super) fn sub(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if a == b && self.may_drop(a) {
            return ZERO;
        }
        if a == ZERO {
            return self.unary(UnaryFunction::Neg, b);
        }
        if b == ZERO {
            return a;
        }
        let (x, y) = match self.is_plain(a) && self.is_plain(b) {
            true => (None, None),
            false => match self.fold(a, b, |x, y| x - y) {
                Some(folded) => return folded,
                None => (self.negated(a), self.negated(b)),
            },
        };
        match (x, y) {
            (_, Some(y)) => self.add(a, y),
            (Some(x), None) => {
                let sum = self.add(x, b);
                self.unary(UnaryFunction::Neg, sum)
            }
            (None, None) if a > b => {
                let difference = self.intern(Node::Binary(BinaryOperation::Sub, b, a));
                self.unary(UnaryFunction::Neg, difference)
            }
            (None, None) => self.intern(Node::Binary(BinaryOperation::Sub, a, b)),
        }
    }

    #[inline]
    pub(super) fn mul(&mut self, a: NodeId, b: NodeId) -> NodeId {
        for (zero, other) in [(a, b), (b, a)] {
            if zero == ZERO {
                if self.may_drop(other) {
                    return ZERO;
                }
                return self.commutative(BinaryOperation::Mul, a, b);
            }
        }
        if a == ONE {
            return b;
        }
        if b == ONE {
            return a;
        }
        self.product(a, b)
    }

    /// Multiplies values other than 0 and 1.
    fn product(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if self.is_plain(a) && self.is_plain(b) {
            return self.commutative(BinaryOperation::Mul, a, b);
        }
        if let Some(folded) = self.fold(a, b, |x, y| x * y) {
            return folded;
        }
        match (self.negated(a), self.negated(b)) {
            (Some(x), Some(y)) => return self.mul(x, y),
            (Some(x), None) => return self.negated_product(x, b),
            (None, Some(y)) => return self.negated_product(a, y),
            (None, None) => {}
        }
        for (constant, other) in [(a, b), (b, a)] {
            if let Some(value) = self.constant_at(constant) {
                let opposite = value.is_negative().then(|| -value);
                return self.scaled(opposite, constant, other);
            }
        }
        if self.literal || self.is_undefined(a) || self.is_undefined(b) {
            return self.commutative(BinaryOperation::Mul, a, b);
        }
        if a == b
            && let Some(x) = self.argument(UnaryFunction::Sqrt, a)
        {
            return x;
        }
        if self.argument(UnaryFunction::Recip, a) == Some(b)
            || self.argument(UnaryFunction::Recip, b) == Some(a)
        {
            return ONE;
        }
        self.commutative(BinaryOperation::Mul, a, b)
    }

    fn negated_product(&mut self, a: NodeId, b: NodeId) -> NodeId {
        let product = self.mul(a, b);
        self.unary(UnaryFunction::Neg, product)
    }

    /// Multiplies by a constant: the sign of a negative one, whose opposite is given, moves outwards, and
    /// two constants merge.
    fn scaled(&mut self, opposite: Option<Rational>, constant: NodeId, other: NodeId) -> NodeId {
        if let Some(opposite) = opposite {
            let positive = self.constant(opposite);
            return self.negated_product(positive, other);
        }
        if let Node::Binary(BinaryOperation::Mul, x, y) = self.node(other) {
            for (inner, rest) in [(x, y), (y, x)] {
                if let Some(merged) = self.fold(constant, inner, |p, q| p * q) {
                    return self.mul(merged, rest);
                }
            }
        }
        self.commutative(BinaryOperation::Mul, constant, other)
    }

    pub(super) fn unary(&mut self, function: UnaryFunction, a: NodeId) -> NodeId {
        // A root of 0 is the end of a domain.
        let is_end = self.literal && function == UnaryFunction::Sqrt && a == ZERO;
        if is_end || self.is_undefined(a) || self.is_plain(a) && function != UnaryFunction::Sqrt {
            return self.intern(Node::Unary(function, a));
        }
        if let Some(value) = self.constant_at(a).cloned()
            && let Some(folded) = fold_unary(function, &value)
        {
            return self.constant(folded);
        }
        if function == UnaryFunction::Sqrt
            && let Some(root) = self.denested(a)
        {
            return root;
        }
        let inner = match self.node(a) {
            Node::Unary(inner, x) => Some((inner, x)),
            _ => None,
        };
        match (function, inner) {
            (UnaryFunction::Neg, Some((UnaryFunction::Neg, x)))
            | (UnaryFunction::Ln, Some((UnaryFunction::Exp, x))) => x,
            (UnaryFunction::Recip, Some((UnaryFunction::Recip, x)))
            | (UnaryFunction::Exp, Some((UnaryFunction::Ln, x)))
                if !self.literal =>
            {
                x
            }
            (
                UnaryFunction::Recip | UnaryFunction::Sin | UnaryFunction::Atan,
                Some((UnaryFunction::Neg, x)),
            ) => {
                let positive = self.unary(function, x);
                self.unary(UnaryFunction::Neg, positive)
            }
            (UnaryFunction::Cos | UnaryFunction::Abs, Some((UnaryFunction::Neg, x))) => {
                self.unary(function, x)
            }
            (
                UnaryFunction::Abs,
                Some((UnaryFunction::Abs | UnaryFunction::Sqrt | UnaryFunction::Exp, _)),
            ) => a,
            _ => self.intern(Node::Unary(function, a)),
        }
    }

    pub(super) fn pow(&mut self, base: NodeId, exponent: NodeId) -> NodeId {
        match self.constant_at(exponent).cloned() {
            Some(exponent) => self.power(base, &exponent),
            None if base == ONE && self.may_drop(exponent) => base,
            None => self.intern(Node::Binary(BinaryOperation::Pow, base, exponent)),
        }
    }

    /// Raises to a power x^q: small integers are multiplied out, half-integers use one root, and
    /// any other exponent makes a power node.
    pub(super) fn power(&mut self, base: NodeId, exponent: &Rational) -> NodeId {
        if exponent.is_negative() {
            let positive = self.power(base, &-exponent);
            return self.unary(UnaryFunction::Recip, positive);
        }
        let doubled =
            (exponent * &Rational::from(2)).to_integer().and_then(|n| u32::try_from(n).ok());
        match doubled {
            Some(n) if n <= 2 * MAX_UNROLLED => {
                let whole = self.unrolled(base, n / 2);
                if n % 2 == 0 {
                    return whole;
                }
                let root = self.unary(UnaryFunction::Sqrt, base);
                self.mul(whole, root)
            }
            _ if base == ONE => base,
            _ => {
                let index = self.intern_constant(exponent.clone());
                self.intern(Node::Power(base, index))
            }
        }
    }

    fn unrolled(&mut self, base: NodeId, exponent: u32) -> NodeId {
        match exponent {
            0 if self.may_drop(base) => ONE,
            0 => {
                // 1, where the base has a value.
                let nothing = self.mul(ZERO, base);
                self.add(ONE, nothing)
            }
            1 => base,
            n => {
                let half = self.unrolled(base, n / 2);
                let square = self.mul(half, half);
                if n % 2 == 0 { square } else { self.mul(square, base) }
            }
        }
    }
}

fn fold_unary(function: UnaryFunction, value: &Rational) -> Option<Rational> {
    match function {
        UnaryFunction::Neg => Some(-value),
        UnaryFunction::Recip => value.recip(),
        UnaryFunction::Abs => Some(value.abs()),
        UnaryFunction::Sqrt => square_root(value),
        UnaryFunction::Exp | UnaryFunction::Cos => value.is_zero().then(|| Rational::from(1)),
        UnaryFunction::Sin | UnaryFunction::Atan => value.is_zero().then(|| Rational::from(0)),
        UnaryFunction::Ln => value.is_one().then(|| Rational::from(0)),
    }
}
