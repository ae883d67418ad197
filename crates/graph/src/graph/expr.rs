//! [`Expr`], the recording scalar: a handle into the graph that is being recorded.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::{
    Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign,
};

use super::expand::{Expanded, Side, expansion};
use super::{Fault, Graph, NodeId, with_graph};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// A value of the recording under way. Arithmetic on it adds nodes to the graph.
///
/// It has neither magnitude nor order: comparing it, or asking for its absolute value by
/// `abs`, makes the recording fail with a [`Fault`]; equality means "the same node".
#[derive(Clone, Copy)]
pub struct Expr {
    session: u32,
    node: NodeId,
}

impl Expr {
    /// Returns the node, or `None` for a handle that was never part of a recording.
    pub(super) fn id(self) -> Option<NodeId> {
        (self.session != 0).then_some(self.node)
    }

    /// Makes the handle of a node.
    pub(super) fn of(session: u32, node: NodeId) -> Self {
        Self { session, node }
    }

    /// Adds a free input to the recording under way.
    pub fn input() -> Self {
        Self::made(Graph::input)
    }

    /// Runs `make` in the current graph.
    #[inline]
    pub(super) fn made(make: impl FnOnce(&mut Graph) -> NodeId) -> Self {
        with_graph(|graph| {
            let node = make(graph);
            Self { session: graph.session, node }
        })
    }

    /// Returns the node of this value in `graph`. A value of another recording is a fault and
    /// counts as 0.
    #[inline]
    pub(super) fn node_in(self, graph: &mut Graph) -> NodeId {
        if self.session == graph.session {
            return self.node;
        }
        graph.fail(Fault::ForeignValue);
        super::ZERO
    }

    pub(super) fn constant(value: Rational) -> Self {
        Self::made(|graph| graph.constant(value))
    }

    pub(super) fn unary(self, function: UnaryFunction) -> Self {
        Self::made(|graph| {
            let a = self.node_in(graph);
            graph.unary(function, a)
        })
    }

    #[inline(always)]
    pub(super) fn binary(self, operation: BinaryOperation, other: Self) -> Self {
        Self::made(|graph| {
            let (a, b) = (self.node_in(graph), other.node_in(graph));
            graph.binary(operation, a, b)
        })
    }

    /// Computes f(x).
    pub fn apply(self, function: UnaryFunction) -> Self {
        self.unary(function)
    }

    /// Computes x op y.
    pub fn combine(self, operation: BinaryOperation, other: Self) -> Self {
        self.binary(operation, other)
    }

    pub(super) fn zero_node() -> Self {
        Self::made(|_| super::ZERO)
    }

    pub(super) fn one_node() -> Self {
        Self::made(|_| super::ONE)
    }

    /// Whether the recorded form proves that the value is defined for all inputs. Valid only while
    /// the recording runs.
    pub fn is_always_defined(self) -> bool {
        with_graph(|graph| {
            let node = self.node_in(graph);
            graph.domains[node.0 as usize] == super::Defined::Always
        })
    }

    /// Whether the recorded form shows that the value is defined for no inputs. Valid only while the
    /// recording runs.
    pub(super) fn is_never(self) -> bool {
        with_graph(|graph| {
            let node = self.node_in(graph);
            graph.is_undefined(node)
        })
    }

    /// Returns the number to which the value was folded, if it was.
    pub(super) fn folded(self) -> Option<Rational> {
        with_graph(|graph| {
            let node = self.node_in(graph);
            graph.constant_at(node).cloned()
        })
    }

    /// Returns the recording that the value belongs to.
    pub(super) fn session(self) -> u32 {
        self.session
    }

    /// Whether the value was folded to 0.
    pub(super) fn is_zero_node(self) -> bool {
        with_graph(|graph| self.node_in(graph) == super::ZERO)
    }

    /// Whether the value was folded to 1.
    pub(super) fn is_one_node(self) -> bool {
        with_graph(|graph| self.node_in(graph) == super::ONE)
    }

    /// Returns the argument if the value is a negation.
    pub(super) fn without_negation(self) -> Option<Self> {
        with_graph(|graph| {
            let node = self.node_in(graph);
            graph.negated(node).map(|node| Self { session: graph.session, node })
        })
    }

    /// Finds another value of the recording by the node of this one, with what else is found.
    pub(super) fn read<T>(
        self,
        find: impl FnOnce(&Graph, NodeId) -> Option<(NodeId, T)>,
    ) -> Option<(Self, T)> {
        with_graph(|graph| {
            let own = self.node_in(graph);
            let (node, found) = find(graph, own)?;
            Some((Self { session: graph.session, node }, found))
        })
    }

    /// Reports an operation that needs a magnitude or an order.
    pub(super) fn refuse(operation: &'static str) {
        with_graph(|graph| graph.fail(Fault::NeedsValue(operation)));
    }
}

impl Scalar for Expr {
    fn rational(value: &Rational) -> Self {
        Self::constant(value.clone())
    }

    fn power(self, exponent: &Rational) -> Self {
        Self::made(|graph| {
            let base = self.node_in(graph);
            graph.power(base, exponent)
        })
    }

    fn power_of(self, exponent: Self) -> Self {
        self.binary(BinaryOperation::Pow, exponent)
    }

    fn modulus(self) -> Self {
        self.unary(UnaryFunction::Abs)
    }

    fn antiderivative(integrand: Self, variable: Self) -> Self {
        Self::made(|graph| {
            let (integrand, variable) = (integrand.node_in(graph), variable.node_in(graph));
            graph.antiderivative(integrand, variable)
        })
    }

    fn note_divisor(self) {
        with_graph(|graph| {
            if let Some(divisors) = &mut graph.divisors {
                divisors.push(self);
            }
        });
    }

    fn literally<R>(build: impl FnOnce() -> R) -> R {
        super::literally(build)
    }

    fn is_absent(&self) -> bool {
        self.is_zero_node()
    }

    fn is_number(&self) -> bool {
        with_graph(|graph| graph.constant_value(*self).is_some())
    }

    fn is_never_defined(&self) -> bool {
        self.is_never()
    }

    fn is_on_edge(&self) -> bool {
        super::edges(&[*self]).into_iter().any(Self::is_never)
    }

    fn expanded(self, variable: Self, side: Side, order: i32) -> Expanded<Self> {
        expansion(self, variable, side, order)
    }

    fn gradients_of(values: &[Self], variables: &[Self]) -> Option<Vec<Vec<(usize, Self)>>> {
        with_graph(|graph| {
            let [values, variables] = [values, variables].map(|of| nodes_in(of, graph));
            let rows = graph.gradients(&values?, &variables?)?;
            let made = |(place, node): (usize, NodeId)| (place, Self::of(graph.session, node));
            Some(rows.into_iter().map(|row| row.into_iter().map(made).collect()).collect())
        })
    }

    fn derivatives_along(
        values: &[Self],
        variables: &[Self],
        direction: &[Self],
    ) -> Option<Vec<Self>> {
        with_graph(|graph| {
            let [values, variables, direction] =
                [values, variables, direction].map(|of| nodes_in(of, graph));
            let found = graph.derivatives_along(&values?, &variables?, &direction?)?;
            Some(found.into_iter().map(|node| Self::of(graph.session, node)).collect())
        })
    }

    fn diagonal_of(values: &[Self], variables: &[Self]) -> Option<Vec<Self>> {
        with_graph(|graph| {
            let [values, variables] = [values, variables].map(|of| nodes_in(of, graph));
            let found = graph.diagonal(&values?, &variables?)?;
            Some(found.into_iter().map(|node| Self::of(graph.session, node)).collect())
        })
    }
}

/// Returns the nodes of values that all belong to `graph`.
fn nodes_in(values: &[Expr], graph: &Graph) -> Option<Vec<NodeId>> {
    values.iter().map(|value| (value.session == graph.session).then_some(value.node)).collect()
}

impl From<f64> for Expr {
    /// Records the dyadic rational equal to the f64; NaN and infinities make the recording fail.
    fn from(value: f64) -> Self {
        match Rational::from_f64(value) {
            Some(value) => Self::constant(value),
            None => {
                Self::refuse("a constant that is not finite");
                Self::constant(Rational::from(0))
            }
        }
    }
}

impl fmt::Debug for Expr {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "node {}", self.node.0)
    }
}

impl fmt::Display for Expr {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, out)
    }
}

impl PartialEq for Expr {
    fn eq(&self, other: &Self) -> bool {
        self.session == other.session && self.node == other.node
    }
}

impl Eq for Expr {}

impl Hash for Expr {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.session, self.node).hash(state);
    }
}

impl PartialEq<f64> for Expr {
    fn eq(&self, other: &f64) -> bool {
        *self == Self::from(*other)
    }
}

impl Neg for Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        self.unary(UnaryFunction::Neg)
    }
}

impl Neg for &Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        -*self
    }
}

fn quotient(a: Expr, b: Expr) -> Expr {
    // One reciprocal serves every quotient by the same denominator.
    a.binary(BinaryOperation::Mul, b.unary(UnaryFunction::Recip))
}

fn remainder(a: Expr, _: Expr) -> Expr {
    Expr::refuse("%");
    a
}

macro_rules! arithmetic {
    ($($trait:ident $method:ident $assign_trait:ident $assign:ident $with:expr;)*) => {$(
        impl $trait for Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                $with(self, other)
            }
        }
        impl $trait<&Expr> for Expr {
            type Output = Expr;
            fn $method(self, other: &Expr) -> Expr {
                $with(self, *other)
            }
        }
        impl $trait<f64> for Expr {
            type Output = Expr;
            fn $method(self, other: f64) -> Expr {
                $with(self, Expr::from(other))
            }
        }
        impl $assign_trait for Expr {
            fn $assign(&mut self, other: Expr) {
                *self = $with(*self, other);
            }
        }
        impl $assign_trait<f64> for Expr {
            fn $assign(&mut self, other: f64) {
                *self = $with(*self, Expr::from(other));
            }
        }
    )*};
}

arithmetic! {
    Add add AddAssign add_assign |a: Expr, b| a.binary(BinaryOperation::Add, b);
    Sub sub SubAssign sub_assign |a: Expr, b| a.binary(BinaryOperation::Sub, b);
    Mul mul MulAssign mul_assign |a: Expr, b| a.binary(BinaryOperation::Mul, b);
    Div div DivAssign div_assign quotient;
    Rem rem RemAssign rem_assign remainder;
}
