//! The parsed formula: a flat list of typed nodes, arguments before their users.

use std::collections::HashMap;

use super::error::Span;
use super::kind::Type;
use super::scope::Symbol;
use crate::number::rational::Rational;

/// Exact constants wider than this are left to the evaluation.
pub(super) const MAX_CONSTANT_BITS: u64 = 4096;

/// The place of a node in the arena.
pub(super) type NodeId = usize;

/// One operation, its type and the text it was read from.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub operation: Operation,
    pub value_type: Type,
    pub span: Span,
}

/// What a node computes from earlier nodes. Operand types are settled when it is built.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Operation {
    Number(Rational),
    Constant(Constant),
    /// The value of the symbol in this slot of [`Arena::symbols`].
    Symbol(usize),
    /// The identity matrix of its type.
    Identity,
    /// The zero of its type; as a scalar a sum of no terms, which any type may be added to.
    Zero,
    Negate(NodeId),
    Add(NodeId, NodeId),
    Subtract(NodeId, NodeId),
    /// Scalar times scalar.
    Multiply(NodeId, NodeId),
    /// Scalar times vector or matrix, the scalar first.
    Scale(NodeId, NodeId),
    /// Matrix times vector.
    Apply(NodeId, NodeId),
    /// Matrix times matrix.
    Compose(NodeId, NodeId),
    /// Anything by a scalar.
    Divide(NodeId, NodeId),
    Dot(NodeId, NodeId),
    Cross(NodeId, NodeId),
    Outer(NodeId, NodeId),
    /// Scalar to a rational power.
    Power(NodeId, Rational),
    /// Scalar to a scalar power.
    PowerOf(NodeId, NodeId),
    /// Matrix to a power of at least 1.
    MatrixPower(NodeId, u32),
    /// Component of a vector, from 0.
    Component(NodeId, usize),
    /// Row of a matrix, from 0.
    Row(NodeId, usize),
    /// Entry of a matrix: row, column, from 0.
    Entry(NodeId, usize, usize),
    Transpose(NodeId),
    Inverse(NodeId),
    Adjugate(NodeId),
    Determinant(NodeId),
    Trace(NodeId),
    /// `A⁻¹ b`.
    Solve(NodeId, NodeId),
    /// The vector of some scalars.
    Vector(Box<[NodeId]>),
    /// The matrix with some vectors as rows.
    Rows(Box<[NodeId]>),
    /// The sum of terms of one type, one for each index.
    Sum(Box<[NodeId]>),
    /// The product of scalars, one for each index.
    Product(Box<[NodeId]>),
    /// The matrix with a vector on its diagonal.
    Diagonal(NodeId),
    /// A function of one scalar.
    Function(Function, NodeId),
    /// The angle of the point (x, y), given as `(y, x)`.
    Angle(NodeId, NodeId),
    /// The least or the greatest of some scalars.
    Extreme(Extreme, Box<[NodeId]>),
    /// `∫(integrand, variable)`.
    Antiderivative(NodeId, NodeId),
}

/// The numbers that have a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Constant {
    /// π
    Pi,
    /// e, Euler's number.
    Euler,
}

/// The functions of one scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    Sqrt,
    Exp,
    Ln,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Modulus,
    Sign,
}

/// Which of some scalars is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extreme {
    Least,
    Greatest,
}

/// The nodes of a formula under construction and, once built, of the formula.
#[derive(Clone, Debug, Default)]
pub(super) struct Arena {
    pub nodes: Vec<Node>,
    /// Each symbol once, in order of first use.
    pub symbols: Vec<(Symbol, Type)>,
    /// Symbols whose values are written into the formula: those in indices, bounds and sizes.
    pub fixed: Vec<Symbol>,
    slots: HashMap<Symbol, usize>,
}

impl Arena {
    /// Appends a node.
    pub fn push(&mut self, operation: Operation, value_type: Type, span: Span) -> NodeId {
        self.nodes.push(Node { operation, value_type, span });
        self.nodes.len() - 1
    }

    /// Appends a use of a symbol.
    pub fn push_symbol(&mut self, symbol: Symbol, value_type: Type, span: Span) -> NodeId {
        let slot = *self.slots.entry(symbol).or_insert_with(|| {
            self.symbols.push((symbol, value_type));
            self.symbols.len() - 1
        });
        self.push(Operation::Symbol(slot), value_type, span)
    }

    /// The number a node holds, if it is one.
    pub fn constant(&self, node: NodeId) -> Option<&Rational> {
        match &self.nodes[node].operation {
            Operation::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Takes the number off the end that a node holds, if it is one and the last.
    pub fn take_constant(&mut self, node: NodeId) -> Option<Rational> {
        let last = node + 1 == self.nodes.len();
        let value = self.constant(node).filter(|_| last)?.clone();
        self.nodes.pop();
        Some(value)
    }

    /// Appends a scalar operation, or, if all it acts on are numbers, the number it gives.
    ///
    /// The numbers it acted on are then the last nodes and are taken away, so that the arena
    /// holds nothing unused.
    pub fn push_folded(
        &mut self,
        operation: Operation,
        operands: &[NodeId],
        span: Span,
        fold: impl FnOnce(&[&Rational]) -> Option<Rational>,
    ) -> NodeId {
        let numbers: Option<Vec<&Rational>> =
            operands.iter().map(|operand| self.constant(*operand)).collect();
        let start = self.nodes.len() - operands.len();
        let last = (start..).zip(operands).all(|(node, operand)| node == *operand);
        let folded = numbers.filter(|_| last).and_then(|numbers| fold(&numbers));
        match folded.filter(|value| value.bits() <= MAX_CONSTANT_BITS) {
            Some(value) => {
                self.nodes.truncate(start);
                self.push(Operation::Number(value), Type::Scalar, span)
            }
            None => self.push(operation, Type::Scalar, span),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fold_and_leave_nothing_behind() {
        let mut arena = Arena::default();
        let number = |n: i64| Operation::Number(Rational::from(n));
        let a = arena.push(number(3), Type::Scalar, 0..1);
        let b = arena.push(number(4), Type::Scalar, 2..3);
        let sum = arena.push_folded(Operation::Add(a, b), &[a, b], 0..3, |n| Some(n[0] + n[1]));
        assert_eq!(arena.constant(sum), Some(&Rational::from(7)), "3 + 4");
        assert_eq!(arena.nodes.len(), 1, "the summands are gone");
        let x = arena.push_symbol(Symbol(9), Type::Scalar, 4..5);
        let sum = arena.push_folded(Operation::Add(sum, x), &[sum, x], 0..5, |_| None);
        assert_eq!(arena.constant(sum), None, "x is no number");
    }

    #[test]
    fn a_symbol_has_one_slot() {
        let mut arena = Arena::default();
        arena.push_symbol(Symbol(9), Type::Scalar, 0..1);
        arena.push_symbol(Symbol(9), Type::Scalar, 2..3);
        assert_eq!(arena.symbols, [(Symbol(9), Type::Scalar)], "however often it is used");
    }
}
