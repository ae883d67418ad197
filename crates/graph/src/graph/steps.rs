//! Access to the operations of a graph in order, and their replay in another recording.

use super::{Expr, Graph, Node, with_graph};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// One operation; arguments are places of earlier steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step<'g> {
    /// An exact constant.
    Constant(&'g Rational),
    /// A free input, by index.
    Input(usize),
    /// f(x)
    Unary(UnaryFunction, usize),
    /// x op y
    Binary(BinaryOperation, usize, usize),
    /// x^q
    Power(usize, &'g Rational),
}

impl Step<'_> {
    /// Returns the places of the arguments.
    #[inline]
    pub fn arguments(&self) -> impl Iterator<Item = usize> {
        let [first, second] = match *self {
            Step::Constant(_) | Step::Input(_) => [None, None],
            Step::Unary(_, a) | Step::Power(a, _) => [Some(a), None],
            Step::Binary(_, a, b) => [Some(a), Some(b)],
        };
        first.into_iter().chain(second)
    }

    /// Whether the step is an input, a constant, a sum, a product, a quotient or a whole power.
    pub fn is_rational(&self) -> bool {
        match self {
            Step::Constant(_) | Step::Input(_) => true,
            Step::Unary(function, _) => {
                matches!(function, UnaryFunction::Neg | UnaryFunction::Recip)
            }
            Step::Power(_, exponent) => exponent.to_integer().is_some(),
            Step::Binary(operation, ..) => *operation != BinaryOperation::Pow,
        }
    }

    /// Whether the step is a root of any index: it has branches, and no value at some arguments.
    pub fn is_root(&self) -> bool {
        match self {
            Step::Unary(function, _) => *function == UnaryFunction::Sqrt,
            Step::Power(_, exponent) => exponent.to_integer().is_none(),
            _ => false,
        }
    }

    /// Whether the step is a modulus.
    pub fn is_modulus(&self) -> bool {
        matches!(self, Step::Unary(UnaryFunction::Abs, _))
    }

    /// Whether the step is a function that has no values modulo a prime: exp, ln, sin, cos, atan or x^y.
    pub fn is_transcendental(&self) -> bool {
        use UnaryFunction::{Atan, Cos, Exp, Ln, Sin};
        matches!(
            self,
            Step::Unary(Exp | Ln | Sin | Cos | Atan, _) | Step::Binary(BinaryOperation::Pow, ..)
        )
    }

    /// Repeats a step other than an input in the recording under way, from the values of its
    /// arguments.
    pub fn repeat_from(&self, at: impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        self.repeat(&[], at)
    }

    /// Repeats the step in the recording under way, from other inputs and the values of its
    /// arguments.
    pub fn repeat(&self, inputs: &[Expr], at: impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        Some(match *self {
            Step::Constant(value) => Expr::rational(value),
            Step::Input(input) => *inputs.get(input)?,
            Step::Unary(function, a) => at(a)?.apply(function),
            Step::Binary(operation, a, b) => at(a)?.combine(operation, at(b)?),
            Step::Power(a, exponent) => at(a)?.power(exponent),
        })
    }
}

impl Graph {
    /// Iterates over all steps; the place of a step is its index.
    #[inline]
    pub fn steps(&self) -> impl DoubleEndedIterator<Item = Step<'_>> + ExactSizeIterator {
        (0..self.nodes.len()).map(|place| self.step(place))
    }

    /// Returns the step at a place.
    #[inline]
    pub fn step(&self, place: usize) -> Step<'_> {
        self.step_of(self.nodes[place])
    }

    /// Returns a node as a step.
    #[inline]
    pub(super) fn step_of(&self, node: Node) -> Step<'_> {
        match node {
            Node::Constant(index) => Step::Constant(&self.constants[index as usize]),
            Node::Input(input) => Step::Input(input as usize),
            Node::Unary(function, a) => Step::Unary(function, a.0 as usize),
            Node::Binary(operation, a, b) => Step::Binary(operation, a.0 as usize, b.0 as usize),
            Node::Power(a, exponent) => {
                Step::Power(a.0 as usize, &self.constants[exponent as usize])
            }
        }
    }

    /// Returns the place of the step that makes `expr`; 0, a constant, for a handle that belongs to
    /// no recording.
    #[inline]
    pub fn place(&self, expr: Expr) -> usize {
        expr.id().map_or(0, |id| id.0 as usize)
    }

    /// Returns the value made by the step at a place.
    pub fn at(&self, place: usize) -> Expr {
        Expr::of(self.session, super::NodeId(place as u32))
    }

    /// Marks the steps that the outputs need.
    pub fn reached(&self, outputs: impl IntoIterator<Item = Expr>) -> Vec<bool> {
        let places: Vec<usize> = outputs.into_iter().map(|output| self.place(output)).collect();
        self.reached_from(&places)
    }

    /// Steps with their places where a mark is set, as [`Graph::reached`] sets them.
    pub fn steps_at<'g>(
        &'g self,
        marks: &'g [bool],
    ) -> impl DoubleEndedIterator<Item = (usize, Step<'g>)> {
        let marked = marks.iter().enumerate().filter(|(_, own)| **own);
        marked.map(|(place, _)| (place, self.step(place)))
    }

    /// Marks the steps that those at these places need.
    pub fn reached_from(&self, places: &[usize]) -> Vec<bool> {
        let mut reached = vec![false; self.nodes.len()];
        places.iter().for_each(|place| reached[*place] = true);
        // Arguments come before the steps that use them.
        let end = places.iter().max().map_or(0, |last| last + 1);
        for place in (0..end).rev() {
            if !reached[place] {
                continue;
            }
            match self.nodes[place] {
                Node::Constant(_) | Node::Input(_) => {}
                Node::Unary(_, a) | Node::Power(a, _) => reached[a.0 as usize] = true,
                Node::Binary(_, a, b) => {
                    reached[a.0 as usize] = true;
                    reached[b.0 as usize] = true;
                }
            }
        }
        reached
    }

    /// Whether one of the steps that some outputs need is such a step. Takes as long as these, but for a
    /// bit a node of the graph.
    pub fn has_step(&self, outputs: &[Expr], mut is_such: impl FnMut(Step<'_>) -> bool) -> bool {
        let mut found = false;
        self.visit(outputs, |node| found = found || is_such(self.step_of(node)));
        found
    }

    /// Repeats the reached steps with other inputs in the recording under way; returns the new value
    /// of each place.
    pub fn repeated(&self, reached: &[bool], inputs: &[Expr]) -> Vec<Option<Expr>> {
        self.repeated_with(reached, inputs, |_| None)
    }

    /// Repeats the same, but for places whose values are given. `given` may not record anything.
    pub fn repeated_with(
        &self,
        reached: &[bool],
        inputs: &[Expr],
        given: impl Fn(usize) -> Option<Expr>,
    ) -> Vec<Option<Expr>> {
        let mut values: Vec<Option<Expr>> = vec![None; self.nodes.len()];
        with_graph(|graph| {
            graph.make_room(reached.iter().filter(|reached| **reached).count());
            for (place, _) in reached.iter().enumerate().filter(|(_, reached)| **reached) {
                values[place] = given(place).or_else(|| {
                    let value = |place: super::NodeId| values[place.0 as usize];
                    let node = match self.nodes[place] {
                        Node::Constant(index) => {
                            graph.constant(self.constants[index as usize].clone())
                        }
                        Node::Input(input) => return inputs.get(input as usize).copied(),
                        Node::Unary(function, a) => {
                            let a = value(a)?.node_in(graph);
                            graph.unary(function, a)
                        }
                        Node::Binary(operation, a, b) => {
                            let (a, b) = (value(a)?.node_in(graph), value(b)?.node_in(graph));
                            graph.binary(operation, a, b)
                        }
                        Node::Power(a, exponent) => {
                            let a = value(a)?.node_in(graph);
                            graph.power(a, &self.constants[exponent as usize])
                        }
                    };
                    Some(Expr::of(graph.session, node))
                });
            }
        });
        values
    }

    /// Replays the reached steps with other inputs in the recording under way; returns the new
    /// value of each place.
    ///
    /// `replace` may give a step another value; it is called with the step and the new values of
    /// the places before it.
    pub fn replay(
        &self,
        reached: &[bool],
        inputs: &[Expr],
        mut replace: impl FnMut(usize, Step<'_>, &[Option<Expr>]) -> Option<Expr>,
    ) -> Vec<Option<Expr>> {
        let mut values: Vec<Option<Expr>> = Vec::with_capacity(self.nodes.len());
        let end = reached.iter().rposition(|reached| *reached).map_or(0, |last| last + 1);
        for (place, reached) in reached[..end].iter().enumerate() {
            if !reached {
                values.push(None);
                continue;
            }
            let step = self.step(place);
            let value = replace(place, step, &values)
                .or_else(|| step.repeat(inputs, |place| values[place]));
            values.push(value);
        }
        values.resize(self.nodes.len(), None);
        values
    }
}

#[cfg(test)]
mod tests {
    use super::super::record;
    use super::*;
    use num_dual::DualNum;

    #[test]
    fn steps_are_found_among_those_that_are_needed() {
        let build = |x: &[Expr]| [x[0].sqrt() * x[1] + x[0], x[1] * x[1] - x[0]];
        let (graph, [with, without]) = record(2, build).expect("records");
        let is_root = |step: Step<'_>| matches!(step, Step::Unary(UnaryFunction::Sqrt, _));
        assert!(graph.has_step(&[with], is_root) && graph.has_step(&[without, with], is_root));
        assert!(!graph.has_step(&[without], is_root) && !graph.has_step(&[], is_root));
    }

    #[test]
    fn a_replay_repeats_and_replaces() {
        let (graph, outputs) = record(2, |x| [x[0] * x[1] + x[0].sqrt(), x[0]]).expect("records");
        let reached = graph.reached(outputs);
        let (_, same) = record(2, |x| {
            let values = graph.repeated(&reached, x);
            values[graph.place(outputs[0])] == Some(x[0] * x[1] + x[0].sqrt())
        })
        .expect("records");
        assert!(same, "equal steps are equal nodes");
        let (_, replaced) = record(2, |x| {
            let values = graph.replay(&reached, x, |_, step, _| {
                matches!(step, Step::Unary(UnaryFunction::Sqrt, _)).then(|| x[1])
            });
            values[graph.place(outputs[0])] == Some(x[0] * x[1] + x[1])
        })
        .expect("records");
        assert!(replaced, "the root was given another value");
    }
}
