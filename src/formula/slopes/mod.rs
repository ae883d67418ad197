//! Rules of calculus: the derivative of every node of a formula along one variable.
//!
//! A derivative is made of nodes like any other formula, and is defined where the rules have a
//! value: (√x)' = x^(−1/2)/2 is undefined at 0, and so is |x|'. Abbreviations are differentiated
//! through, by the chain rule.

mod abbreviations;
mod elementary;
mod matrices;
mod rules;

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use super::arena::{NodeId, NodeOperation};
use super::error::{FormulaError, Span};
use super::kind::Type;
use super::scope::{Scope, Symbol};
use super::typing::{Builder, Infix, Operand};
use crate::number::rational::Rational;

/// Limit on the nodes of a derivative.
const MOST_NODES: usize = 200_000;

/// A node of the derivative; `None` where the derivative is zero.
pub(super) type Slope = Result<Option<NodeId>, FormulaError>;

/// Part of a variable that is varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum VariedPart {
    Whole,
    /// Component of a vector, from 0.
    Component(usize),
    /// Entry of a matrix, from 0.
    Entry(usize, usize),
}

/// Derivatives of the nodes of a formula in the making.
pub(super) struct Slopes<'b, 't> {
    builder: &'b mut Builder<'t>,
    scope: &'b dyn Scope,
    variable: Symbol,
    part: VariedPart,
    /// Text of the whole derivative.
    span: Span,
    found: FxHashMap<NodeId, Option<NodeId>>,
    /// Last nodes of the abbreviations that are written out.
    written_out: FxHashMap<Symbol, NodeId>,
    dependent: FxHashMap<Symbol, bool>,
    /// Number of nodes before the derivative.
    before: usize,
    depth: usize,
}

impl<'b, 't> Slopes<'b, 't> {
    pub fn new(
        builder: &'b mut Builder<'t>,
        scope: &'b dyn Scope,
        variable: Symbol,
        span: Span,
    ) -> Self {
        let before = builder.arena.nodes.len();
        Self {
            builder,
            scope,
            variable,
            part: VariedPart::Whole,
            span,
            found: FxHashMap::default(),
            written_out: FxHashMap::default(),
            dependent: FxHashMap::from_iter([(variable, true)]),
            before,
            depth: 0,
        }
    }

    /// Derivative of a node along a part of the variable.
    pub fn along(&mut self, part: VariedPart, node: NodeId) -> Slope {
        self.part = part;
        self.found.clear();
        self.slope(node)
    }

    fn slope(&mut self, root: NodeId) -> Slope {
        let mut nodes = BTreeSet::from([root]);
        let mut open = vec![root];
        while let Some(node) = open.pop() {
            self.builder.arena.nodes[node].operation.on(|operand| {
                if nodes.insert(operand) {
                    open.push(operand);
                }
                operand
            });
        }
        for node in nodes {
            if !self.found.contains_key(&node) && !self.is_variable(node) {
                let slope = self.step(node)?;
                self.found.insert(node, slope);
            }
            if self.builder.arena.nodes.len() > self.before + MOST_NODES {
                let error = FormulaError::new(self.span.clone(), "this derivative is too long");
                return Err(error.with_help(format!("it has more than {MOST_NODES} operations")));
            }
        }
        self.of(root)
    }

    fn is_variable(&self, node: NodeId) -> bool {
        match self.builder.arena.nodes[node].operation {
            NodeOperation::Symbol(slot) => self.builder.arena.symbols[slot].0 == self.variable,
            _ => false,
        }
    }

    /// Derivative of a node that was passed.
    pub fn of(&mut self, node: NodeId) -> Slope {
        if !self.is_variable(node) {
            return Ok(self.found.get(&node).copied().flatten());
        }
        let [zero, one] = [0, 1].map(|number| self.number(number));
        let entry = |is_varied: bool| if is_varied { one.clone() } else { zero.clone() };
        let span = self.span.clone();
        let unit = match (self.builder.arena.nodes[node].value_type, self.part) {
            (Type::Vector(n), VariedPart::Component(i)) => {
                let parts: Vec<Operand> = (0..n).map(|k| entry(k == i)).collect();
                self.builder.vector(&parts, span)?
            }
            (Type::Matrix(rows, columns), VariedPart::Entry(i, j)) => {
                let mut all = Vec::new();
                for row in 0..rows {
                    let parts: Vec<Operand> =
                        (0..columns).map(|column| entry((row, column) == (i, j))).collect();
                    all.push(self.builder.vector(&parts, span.clone())?);
                }
                self.builder.rows(&all, span)?
            }
            _ => one,
        };
        Ok(Some(unit.node))
    }

    /// Operand for a node.
    pub fn at(&self, node: NodeId) -> Operand {
        self.builder.operand(node, self.span.clone())
    }

    /// Appends a number.
    pub fn number(&mut self, value: impl Into<Rational>) -> Operand {
        let number = NodeOperation::Number(value.into());
        self.builder.push(number, Type::Scalar, self.span.clone())
    }

    /// Appends zero of a type.
    pub fn zero(&mut self, kind: Type) -> Operand {
        match kind {
            Type::Scalar => self.number(0),
            _ => self.builder.push(NodeOperation::Zero, kind, self.span.clone()),
        }
    }

    /// Appends an operation that needs no check.
    fn push(&mut self, operation: NodeOperation, kind: Type) -> NodeId {
        self.builder.push(operation, kind, self.span.clone()).node
    }

    /// Appends `a operator b`.
    pub fn infix(&mut self, infix: Infix, a: NodeId, b: NodeId) -> Result<NodeId, FormulaError> {
        let (a, b) = (self.at(a), self.at(b));
        Ok(self.builder.infix(infix, &a, &b)?.node)
    }

    pub fn times(&mut self, a: NodeId, b: NodeId) -> Result<NodeId, FormulaError> {
        self.infix(Infix::Multiply, a, b)
    }

    pub fn negative(&mut self, a: NodeId) -> NodeId {
        let a = self.at(a);
        self.builder.negate(&a, self.span.clone()).node
    }

    /// Sum of two derivatives.
    fn sum(&mut self, a: Option<NodeId>, b: Option<NodeId>) -> Slope {
        match (a, b) {
            (Some(a), Some(b)) => self.infix(Infix::Add, a, b).map(Some),
            (one, other) => Ok(one.or(other)),
        }
    }

    /// Power of a scalar with a constant exponent.
    pub fn power(&mut self, a: NodeId, exponent: &Rational) -> Result<NodeId, FormulaError> {
        if exponent.to_integer() == Some(1) {
            return Ok(a);
        }
        let a = self.at(a);
        Ok(self.builder.constant_power(&a, exponent, self.span.clone(), self.span.clone())?.node)
    }

    /// The error for what has no derivative here.
    pub fn refused(&self, what: &str, help: &str) -> FormulaError {
        FormulaError::new(self.span.clone(), what).with_help(help)
    }
}
