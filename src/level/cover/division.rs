//! The choice of the next division of a node.

use super::Cover;
use super::node::Node;
use super::solving::Coefficients;
use crate::graph::Fault;
use crate::order::StableOrder;
use crate::proof::sign;

impl Cover<'_> {
    /// Divides a node by one of its equations, one with as few free draws as possible; `None` if none
    /// of them is known to divide it.
    pub(super) fn divided(&self, node: &Node) -> Result<Option<Vec<Node>>, Fault> {
        let contained = |index: usize| -> Vec<usize> {
            let inputs = node.graph.inputs_of(node.equations[index]);
            inputs.into_iter().filter(|input| node.free.contains(input)).collect()
        };
        let mut order: Vec<(Vec<usize>, usize)> =
            (0..node.equations.len()).map(|index| (contained(index), index)).collect();
        order.order_by_key(|(inputs, index)| (inputs.len(), *index));
        for equations in order.chunk_by(|(one, _), (other, _)| one.len() == other.len()) {
            // Of equations with as many unknowns one with the best solution is taken.
            let mut ways: Vec<(usize, Coefficients)> = Vec::new();
            for (inputs, index) in equations {
                if let Some(factors) = node.factors(*index) {
                    return Ok(Some(factors));
                }
                if let Some(factors) = node.polynomial_factors(*index)? {
                    return Ok(Some(factors));
                }
                if let Some(parts) = node.powers(*index)? {
                    return Ok(Some(parts));
                }
                if let Some(child) = node.squares(*index)? {
                    return Ok(Some(vec![child]));
                }
                if let Some(solutions) = node.inverted(*index, self.extents)? {
                    return Ok(Some(solutions));
                }
                // The last coordinates are preferred, as where a level has one solution.
                for draw in inputs.iter().rev() {
                    if let Some(found) = Coefficients::of(node, *index, *draw)? {
                        ways.push((found.cost(self), found));
                    }
                }
            }
            ways.order_by_key(|(cost, _)| *cost);
            for (_, way) in ways {
                if let Some(children) = way.solutions(self, node)? {
                    return Ok(Some(children));
                }
            }
            for (_, index) in equations {
                if let Some(children) = self.by_sign_or_root(node, *index)? {
                    return Ok(Some(children));
                }
            }
        }
        Ok(None)
    }

    /// Divides a node by the sign of a modulus in an equation, or writes the equation without a root.
    fn by_sign_or_root(&self, node: &Node, index: usize) -> Result<Option<Vec<Node>>, Fault> {
        if let Some([plus, minus]) = node.by_sign(index)? {
            // Where −X is nowhere positive, it is 0 if it is not negative, and so is X.
            return Ok(Some(
                match (self.is_nowhere_positive(&plus), self.is_nowhere_positive(&minus)) {
                    (_, true) => vec![plus],
                    (true, false) => vec![minus],
                    (false, false) => vec![plus, minus],
                },
            ));
        }
        Ok(node.without_root(index)?.map(|child| vec![child]))
    }

    /// Whether the last fact of a node is nowhere positive in the ranges.
    fn is_nowhere_positive(&self, node: &Node) -> bool {
        node.facts.last().is_some_and(|fact| {
            let known = sign(&node.graph, self.extents, &[], &[], *fact);
            known.is_some_and(|known| !known.is_positive)
        })
    }
}
