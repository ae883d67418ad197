//! Arena of a parsed formula: a flat list of typed nodes, arguments before their users.

use std::collections::BTreeMap;

use super::error::Span;
use super::kind::Type;
use super::scope::Symbol;
use crate::number::rational::Rational;

/// Size above which exact constants are left to the evaluation, in bits.
pub(super) const MAX_CONSTANT_BITS: u64 = 4096;

/// Index of a node in the arena.
pub(super) type NodeId = usize;

/// Operation with its type and the text it was read from.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub operation: NodeOperation,
    pub value_type: Type,
    pub span: Span,
}

/// Operation of a node on earlier nodes. Operand types are checked when it is built.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum NodeOperation {
    Number(Rational),
    Constant(Constant),
    /// Value of the symbol in this slot of [`Arena::symbols`].
    Symbol(usize),
    /// Identity matrix of the node's type.
    Identity,
    /// Zero of the node's type; as a scalar an empty sum, which can be added to any type.
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
    /// Any value over a scalar.
    Divide(NodeId, NodeId),
    Dot(NodeId, NodeId),
    Cross(NodeId, NodeId),
    Outer(NodeId, NodeId),
    /// Scalar to a constant rational power.
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
    /// Vector with these scalars as components.
    Vector(Box<[NodeId]>),
    /// Matrix with these vectors as rows.
    Rows(Box<[NodeId]>),
    /// Sum of terms of one type, one for each index.
    Sum(Box<[NodeId]>),
    /// Product of scalars, one for each index.
    Product(Box<[NodeId]>),
    /// Matrix with a vector on its diagonal.
    Diagonal(NodeId),
    /// Function of one scalar.
    Function(ElementaryFunction, NodeId),
    /// Angle of the point (x, y), given as `(y, x)`.
    Angle(NodeId, NodeId),
    /// Least or greatest of some scalars.
    Extreme(Extreme, Box<[NodeId]>),
    /// Antiderivative `∫(integrand, variable)`.
    Antiderivative(NodeId, NodeId),
    /// Partial derivative `∂of/∂by`: the value of `derivative`, where `of` is defined.
    Partial {
        derivative: NodeId,
        of: NodeId,
        by: NodeId,
    },
}

impl NodeOperation {
    /// Same operation on other operands.
    pub fn on(&self, mut other: impl FnMut(NodeId) -> NodeId) -> Self {
        use NodeOperation::*;
        let mut all = |nodes: &[NodeId]| nodes.iter().map(|node| other(*node)).collect();
        match self {
            Vector(parts) => return Vector(all(parts)),
            Rows(parts) => return Rows(all(parts)),
            Sum(parts) => return Sum(all(parts)),
            Product(parts) => return Product(all(parts)),
            Extreme(which, parts) => return Extreme(*which, all(parts)),
            _ => {}
        }
        let mut own = self.clone();
        match &mut own {
            Number(_) | Constant(_) | Symbol(_) | Identity | Zero => {}
            Vector(_) | Rows(_) | Sum(_) | Product(_) | Extreme(..) => {}
            Negate(a)
            | Power(a, _)
            | MatrixPower(a, _)
            | Component(a, _)
            | Row(a, _)
            | Entry(a, _, _)
            | Transpose(a)
            | Inverse(a)
            | Adjugate(a)
            | Determinant(a)
            | Trace(a)
            | Diagonal(a)
            | Function(_, a) => *a = other(*a),
            Add(a, b)
            | Subtract(a, b)
            | Multiply(a, b)
            | Scale(a, b)
            | Apply(a, b)
            | Compose(a, b)
            | Divide(a, b)
            | Dot(a, b)
            | Cross(a, b)
            | Outer(a, b)
            | PowerOf(a, b)
            | Solve(a, b)
            | Angle(a, b)
            | Antiderivative(a, b) => (*a, *b) = (other(*a), other(*b)),
            Partial { derivative, of, by } => {
                (*derivative, *of, *by) = (other(*derivative), other(*of), other(*by));
            }
        }
        own
    }
}

/// Numbers that have a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Constant {
    /// The number π.
    Pi,
    /// Euler's number e.
    Euler,
}

/// Functions of one scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ElementaryFunction {
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

/// Choice of the least or the greatest of some scalars.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extreme {
    Least,
    Greatest,
}

/// Nodes of a formula, during construction and after.
#[derive(Clone, Debug, Default)]
pub(super) struct Arena {
    pub nodes: Vec<Node>,
    /// Symbols, each once, in order of first use.
    pub symbols: Vec<(Symbol, Type)>,
    /// Names of the symbols, in the same order, as the scope knows them.
    pub names: Vec<String>,
    /// Symbols whose values are written into the formula: those in indices, bounds and sizes.
    pub fixed: Vec<Symbol>,
    slots: BTreeMap<Symbol, usize>,
}

impl Arena {
    /// Appends a node.
    pub fn push(&mut self, operation: NodeOperation, value_type: Type, span: Span) -> NodeId {
        self.nodes.push(Node { operation, value_type, span });
        self.nodes.len() - 1
    }

    /// Appends a use of a symbol, which the first time has to be named.
    pub fn push_symbol(
        &mut self,
        symbol: Symbol,
        value_type: Type,
        span: Span,
        name: impl FnOnce() -> String,
    ) -> NodeId {
        let slot = *self.slots.entry(symbol).or_insert_with(|| {
            self.symbols.push((symbol, value_type));
            self.names.push(name());
            self.symbols.len() - 1
        });
        self.push(NodeOperation::Symbol(slot), value_type, span)
    }

    /// Same arena with other symbols in the place of its own; `None` where `other` has none.
    pub fn with_symbols(
        &self,
        mut other: impl FnMut(Symbol, &str, Type) -> Option<Symbol>,
    ) -> Option<Self> {
        let mut changed = self.clone();
        for ((symbol, kind), name) in changed.symbols.iter_mut().zip(&self.names) {
            *symbol = other(*symbol, name, *kind)?;
        }
        let slots = changed.symbols.iter().enumerate().map(|(slot, (symbol, _))| (*symbol, slot));
        changed.slots = slots.collect();
        Some(changed)
    }

    /// Marks the nodes that some others need.
    pub fn reached(&self, from: impl IntoIterator<Item = NodeId>) -> Vec<bool> {
        let mut reached = vec![false; self.nodes.len()];
        from.into_iter().for_each(|node| reached[node] = true);
        for node in (0..reached.len()).rev() {
            if reached[node] {
                self.nodes[node].operation.on(|other| {
                    reached[other] = true;
                    other
                });
            }
        }
        reached
    }

    /// An arena with the nodes alone that one needs, as its last, and with the symbols in them.
    pub fn ending_at(&self, last: NodeId) -> Self {
        let reached = self.reached([last]);
        let mut made = Self { fixed: self.fixed.clone(), ..Self::default() };
        let mut places = vec![0; self.nodes.len()];
        for (node, own) in self.nodes.iter().enumerate().filter(|(node, _)| reached[*node]) {
            let span = own.span.clone();
            places[node] = match &own.operation {
                NodeOperation::Symbol(slot) => {
                    let (symbol, kind) = self.symbols[*slot];
                    made.push_symbol(symbol, kind, span, || self.names[*slot].clone())
                }
                other => made.push(other.on(|node| places[node]), own.value_type, span),
            };
        }
        made
    }

    /// Returns (v,v) where a node is the norm |v| of a vector.
    pub fn squared_norm(&self, node: NodeId) -> Option<NodeId> {
        match self.nodes[node].operation {
            NodeOperation::Function(ElementaryFunction::Sqrt, square) if matches!(self.nodes[square].operation, NodeOperation::Dot(a, b) if a == b) => {
                Some(square)
            }
            _ => None,
        }
    }

    /// Number held by a node, if it is a constant.
    pub fn constant(&self, node: NodeId) -> Option<&Rational> {
        match &self.nodes[node].operation {
            NodeOperation::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Removes and returns the number held by a node, if it is a constant and the last node.
    pub fn take_constant(&mut self, node: NodeId) -> Option<Rational> {
        let last = node + 1 == self.nodes.len();
        let value = self.constant(node).filter(|_| last)?.clone();
        self.nodes.pop();
        Some(value)
    }

    /// Appends a scalar operation, or its value if all operands are numbers.
    ///
    /// The operands are then the last nodes and are removed, so that the arena holds nothing
    /// unused.
    pub fn push_folded(
        &mut self,
        operation: NodeOperation,
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
                self.push(NodeOperation::Number(value), Type::Scalar, span)
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
        let number = |n: i64| NodeOperation::Number(Rational::from(n));
        let a = arena.push(number(3), Type::Scalar, 0..1);
        let b = arena.push(number(4), Type::Scalar, 2..3);
        let sum = arena.push_folded(NodeOperation::Add(a, b), &[a, b], 0..3, |n| Some(n[0] + n[1]));
        assert_eq!(arena.constant(sum), Some(&Rational::from(7)), "3 + 4");
        assert_eq!(arena.nodes.len(), 1, "the summands are gone");
        let x = arena.push_symbol(Symbol(9), Type::Scalar, 4..5, || "x".to_string());
        let sum = arena.push_folded(NodeOperation::Add(sum, x), &[sum, x], 0..5, |_| None);
        assert_eq!(arena.constant(sum), None, "x is not a number");
    }

    #[test]
    fn a_symbol_has_one_slot() {
        let mut arena = Arena::default();
        for span in [0..1, 2..3] {
            arena.push_symbol(Symbol(9), Type::Scalar, span, || "x".to_string());
        }
        assert_eq!(arena.symbols, [(Symbol(9), Type::Scalar)], "however often it is used");
    }
}
