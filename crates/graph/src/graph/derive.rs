//! Derivatives of recorded values within their own recording.
//!
//! Dual numbers repeat a computation for every direction. The graph already knows which operations a
//! value needs and on which inputs these depend, so that a gradient takes one sweep from the value
//! down to its inputs, and a derivative along a direction one sweep up: both visit the operations of
//! the value alone, however many variables there are.

use super::{Graph, Node, NodeId, ONE, ZERO};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

/// Partial derivatives that are not 0 by their form, with the places of their variables.
pub(super) type Row = Vec<(usize, NodeId)>;

/// Marks and derivatives by node, kept between sweeps so that a small one does not pay for a large
/// graph.
#[derive(Debug, Default)]
pub(super) struct Sweeps {
    /// Sweep that reached the node last.
    reached: Vec<u32>,
    sweep: u32,
    /// Derivative of the node, or with respect to it; valid where the node was reached.
    derivative: Vec<NodeId>,
    /// Whether the node depends on a variable; valid where the node was reached.
    varies: Vec<bool>,
    /// Place of a variable plus one, by node; 0 for all other nodes.
    variable: Vec<u32>,
}

impl Sweeps {
    /// Makes room for all nodes and begins a new sweep.
    fn begin(&mut self, nodes: usize) {
        if self.sweep == u32::MAX {
            *self = Self::default();
        }
        self.sweep += 1;
        if self.reached.len() < nodes {
            self.reached.resize(nodes, 0);
            self.derivative.resize(nodes, ZERO);
            self.varies.resize(nodes, false);
            self.variable.resize(nodes, 0);
        }
    }

    fn place(&self, node: NodeId) -> Option<usize> {
        (self.variable[node.0 as usize] as usize).checked_sub(1)
    }
}

impl Graph {
    /// Computes the gradients of values; `None` if the variables are not different inputs, or if a
    /// value may contain an antiderivative, which depends on inputs that its node does not show.
    pub(super) fn gradients(
        &mut self,
        values: &[NodeId],
        variables: &[NodeId],
    ) -> Option<Vec<Row>> {
        let rows = |graph: &mut Self, sweeps: &mut Sweeps| {
            values.iter().map(|value| graph.gradient(*value, sweeps)).collect()
        };
        self.with_variables(variables, rows)
    }

    /// Computes the derivatives of values along one direction; `None` as for [`Self::gradients`].
    pub(super) fn derivatives_along(
        &mut self,
        values: &[NodeId],
        variables: &[NodeId],
        direction: &[NodeId],
    ) -> Option<Vec<NodeId>> {
        self.with_variables(variables, |graph, sweeps| {
            let needed = graph.needed(values, sweeps);
            let seed = |place: usize| direction.get(place).copied().unwrap_or(ZERO);
            graph.push_up(&needed, seed, sweeps);
            values.iter().map(|value| sweeps.derivative[value.0 as usize]).collect()
        })
    }

    /// Computes the derivative of each value with respect to the variable at its own place; `None`
    /// as for [`Self::gradients`].
    pub(super) fn diagonal(
        &mut self,
        values: &[NodeId],
        variables: &[NodeId],
    ) -> Option<Vec<NodeId>> {
        self.with_variables(variables, |graph, sweeps| {
            let mut diagonal = Vec::with_capacity(values.len());
            for (own, value) in values.iter().enumerate() {
                let needed = graph.needed(&[*value], sweeps);
                let seed = |place: usize| if place == own { ONE } else { ZERO };
                graph.push_up(&needed, seed, sweeps);
                diagonal.push(sweeps.derivative[value.0 as usize]);
            }
            diagonal
        })
    }

    /// Runs `work` with the places of the variables noted.
    fn with_variables<R>(
        &mut self,
        variables: &[NodeId],
        work: impl FnOnce(&mut Self, &mut Sweeps) -> R,
    ) -> Option<R> {
        if !self.antiderivatives.is_empty() {
            return None;
        }
        let mut sweeps = std::mem::take(&mut self.sweeps);
        sweeps.begin(self.nodes.len());
        let mut are_inputs = true;
        for (place, variable) in variables.iter().enumerate() {
            let noted = &mut sweeps.variable[variable.0 as usize];
            are_inputs &= matches!(self.nodes[variable.0 as usize], Node::Input(_)) && *noted == 0;
            *noted = place as u32 + 1;
        }
        let result = are_inputs.then(|| work(self, &mut sweeps));
        for variable in variables {
            sweeps.variable[variable.0 as usize] = 0;
        }
        self.sweeps = sweeps;
        result
    }

    /// Lists the nodes that some values need, arguments first, and notes which depend on a variable.
    fn needed(&self, values: &[NodeId], sweeps: &mut Sweeps) -> Vec<NodeId> {
        sweeps.begin(self.nodes.len());
        let sweep = sweeps.sweep;
        let mut needed: Vec<NodeId> = Vec::new();
        let reach = |node: NodeId, needed: &mut Vec<NodeId>, sweeps: &mut Sweeps| {
            if sweeps.reached[node.0 as usize] != sweep {
                sweeps.reached[node.0 as usize] = sweep;
                sweeps.derivative[node.0 as usize] = ZERO;
                sweeps.varies[node.0 as usize] = false;
                needed.push(node);
            }
        };
        values.iter().for_each(|value| reach(*value, &mut needed, sweeps));
        let mut next = 0;
        while let Some(node) = needed.get(next).copied() {
            next += 1;
            match self.nodes[node.0 as usize] {
                Node::Constant(_) | Node::Input(_) => {}
                Node::Unary(_, a) | Node::Power(a, _) => reach(a, &mut needed, sweeps),
                Node::Binary(_, a, b) => {
                    reach(a, &mut needed, sweeps);
                    reach(b, &mut needed, sweeps);
                }
            }
        }
        needed.sort_unstable();
        for node in &needed {
            let varies = |id: NodeId| sweeps.varies[id.0 as usize];
            sweeps.varies[node.0 as usize] = match self.nodes[node.0 as usize] {
                Node::Constant(_) => false,
                Node::Input(_) => sweeps.place(*node).is_some(),
                Node::Unary(_, a) | Node::Power(a, _) => varies(a),
                Node::Binary(_, a, b) => varies(a) || varies(b),
            };
        }
        needed
    }

    /// Sweeps up from the variables, each with the derivative that `seed` gives to its place.
    fn push_up(&mut self, needed: &[NodeId], seed: impl Fn(usize) -> NodeId, sweeps: &mut Sweeps) {
        for id in needed {
            if !sweeps.varies[id.0 as usize] {
                continue;
            }
            let of = |a: NodeId| sweeps.derivative[a.0 as usize];
            let derivative = match self.node(*id) {
                Node::Constant(_) => ZERO,
                Node::Input(_) => sweeps.place(*id).map_or(ZERO, &seed),
                Node::Unary(function, a) => match of(a) {
                    ZERO => ZERO,
                    inner => self.chained(function, a, *id, inner),
                },
                Node::Power(a, exponent) => match of(a) {
                    ZERO => ZERO,
                    inner => {
                        let slope = self.slope_of_power(a, exponent);
                        self.mul(inner, slope)
                    }
                },
                Node::Binary(operation, a, b) => match (of(a), of(b)) {
                    (ZERO, ZERO) => ZERO,
                    (left, right) => match operation {
                        BinaryOperation::Add => self.add(left, right),
                        BinaryOperation::Sub => self.sub(left, right),
                        BinaryOperation::Mul => {
                            let first = if left == ZERO { ZERO } else { self.mul(left, b) };
                            let second = if right == ZERO { ZERO } else { self.mul(a, right) };
                            self.add(first, second)
                        }
                        BinaryOperation::Pow => {
                            let [by_base, by_exponent] = self.slopes_of_pow(a, b, *id);
                            let first = if left == ZERO { ZERO } else { self.mul(left, by_base) };
                            let second =
                                if right == ZERO { ZERO } else { self.mul(right, by_exponent) };
                            self.add(first, second)
                        }
                    },
                },
            };
            sweeps.derivative[id.0 as usize] = derivative;
        }
    }

    /// Sweeps down from a value to the variables.
    fn gradient(&mut self, value: NodeId, sweeps: &mut Sweeps) -> Row {
        let needed = self.needed(&[value], sweeps);
        let mut row = Row::new();
        if !sweeps.varies[value.0 as usize] {
            return row;
        }
        sweeps.derivative[value.0 as usize] = ONE;
        for id in needed.iter().rev() {
            let outer = sweeps.derivative[id.0 as usize];
            if outer == ZERO || !sweeps.varies[id.0 as usize] {
                continue;
            }
            let terms = match self.node(*id) {
                Node::Constant(_) => [None, None],
                Node::Input(_) => {
                    row.extend(sweeps.place(*id).map(|place| (place, outer)));
                    [None, None]
                }
                Node::Unary(function, a) => {
                    [Some((a, self.chained(function, a, *id, outer))), None]
                }
                Node::Power(a, exponent) => {
                    let slope = self.slope_of_power(a, exponent);
                    [Some((a, self.mul(outer, slope))), None]
                }
                Node::Binary(operation, a, b) => {
                    let (by_a, by_b) = (sweeps.varies[a.0 as usize], sweeps.varies[b.0 as usize]);
                    match operation {
                        BinaryOperation::Add => [Some((a, outer)), Some((b, outer))],
                        BinaryOperation::Sub => {
                            let minus = by_b.then(|| (b, self.unary(UnaryFunction::Neg, outer)));
                            [Some((a, outer)), minus]
                        }
                        BinaryOperation::Mul => [
                            by_a.then(|| (a, self.mul(outer, b))),
                            by_b.then(|| (b, self.mul(outer, a))),
                        ],
                        BinaryOperation::Pow => {
                            let [by_base, by_exponent] = self.slopes_of_pow(a, b, *id);
                            [
                                by_a.then(|| (a, self.mul(outer, by_base))),
                                by_b.then(|| (b, self.mul(outer, by_exponent))),
                            ]
                        }
                    }
                }
            };
            for (argument, term) in terms.into_iter().flatten() {
                if sweeps.varies[argument.0 as usize] {
                    let before = sweeps.derivative[argument.0 as usize];
                    sweeps.derivative[argument.0 as usize] = self.add(before, term);
                }
            }
        }
        row.sort_unstable_by_key(|(place, _)| *place);
        row
    }

    /// Multiplies `factor` by the derivative of `f` at `a`, where `value` is f(a).
    fn chained(&mut self, f: UnaryFunction, a: NodeId, value: NodeId, factor: NodeId) -> NodeId {
        match f {
            UnaryFunction::Neg => self.unary(UnaryFunction::Neg, factor),
            UnaryFunction::Recip => {
                let square = self.mul(value, value);
                let product = self.mul(factor, square);
                self.unary(UnaryFunction::Neg, product)
            }
            UnaryFunction::Sqrt => {
                let inverse = self.unary(UnaryFunction::Recip, value);
                let half = self.constant(Rational::new(1, 2));
                let slope = self.mul(inverse, half);
                self.mul(factor, slope)
            }
            UnaryFunction::Abs => {
                let inverse = self.unary(UnaryFunction::Recip, value);
                let along = self.mul(factor, a);
                self.mul(along, inverse)
            }
            UnaryFunction::Exp => self.mul(factor, value),
            UnaryFunction::Ln => {
                let inverse = self.unary(UnaryFunction::Recip, a);
                self.mul(factor, inverse)
            }
            UnaryFunction::Sin => {
                let cosine = self.unary(UnaryFunction::Cos, a);
                self.mul(factor, cosine)
            }
            UnaryFunction::Cos => {
                let sine = self.unary(UnaryFunction::Sin, a);
                let product = self.mul(factor, sine);
                self.unary(UnaryFunction::Neg, product)
            }
            UnaryFunction::Atan => {
                let square = self.mul(a, a);
                let sum = self.add(square, ONE);
                let inverse = self.unary(UnaryFunction::Recip, sum);
                self.mul(factor, inverse)
            }
        }
    }

    /// Computes q x^(q-1) for the exponent at an index of the constants.
    fn slope_of_power(&mut self, a: NodeId, exponent: u32) -> NodeId {
        let exponent = self.constants[exponent as usize].clone();
        let lower = self.power(a, &(&exponent - &Rational::from(1)));
        let factor = self.constant(exponent);
        self.mul(factor, lower)
    }

    /// Computes the derivatives of x^y by x and by y, where `value` is x^y.
    fn slopes_of_pow(&mut self, x: NodeId, y: NodeId, value: NodeId) -> [NodeId; 2] {
        let inverse = self.unary(UnaryFunction::Recip, x);
        let ratio = self.mul(y, inverse);
        let logarithm = self.unary(UnaryFunction::Ln, x);
        [self.mul(value, ratio), self.mul(value, logarithm)]
    }
}

#[cfg(test)]
mod tests;
