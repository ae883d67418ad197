//! Parts of a level that no single solution fills.
//!
//! The level is divided until each part is a graph: the states of a part are made from free
//! coordinates by formulas. A product is 0 where a factor is; |X| is X or −X; λc + μ = 0 is solved for
//! c where λ ≠ 0, and what that leaves out is λ = μ = 0; a c² + b c + d = 0 in the same way, once for
//! each root. docs/soundness-levels.md, "Level sets".

mod closure;
mod combinations;
mod division;
mod node;
mod solving;

use crate::graph::{Expr, Fault, Graph};
use crate::mechanics::{Draw, Model};
use crate::number::rational::Rational;
use crate::proof::{Extent, Group, GroupOutcome, Prover, is_nowhere_zero, sign};

use node::Node;

/// Largest number of parts.
const MOST_PARTS: usize = 16;
/// Largest number of nodes of the tree of divisions.
const MOST_NODES: usize = 128;

/// A part of a level, as a function of draws.
#[derive(Debug)]
pub struct Part {
    /// Graph over the draws.
    pub graph: Graph,
    /// Components of the free parameters, followed by those of the state.
    pub made: Vec<Expr>,
    /// Values that are not negative at a state.
    pub facts: Vec<Expr>,
    /// Whether all of these are bounds of ranges.
    is_bounded_by_ranges: bool,
    /// Whether the part is of lower dimension than the level.
    pub is_thin: bool,
    /// Whether it has the dimension that n variables and k equations leave.
    pub is_whole: bool,
}

/// A level to be divided.
pub struct Cover<'c> {
    /// Model of the system.
    pub model: &'c Model,
    /// Equations that hold, of all of the level.
    pub kept: &'c [bool],
    /// Draws of the free parameters, followed by those of the state.
    pub draws: &'c [Draw],
    /// Number of draws of the free parameters.
    pub parameters: usize,
    /// Ranges of the draws.
    pub extents: &'c [Extent],
    /// Listed values, by draw.
    pub fixed: &'c [Option<Rational>],
    /// Seed of proofs.
    pub seed: u64,
}

/// What is known of a value on the points of a node.
enum Known {
    Zero,
    /// Zero on no open set.
    Thin,
    Open,
}

impl Cover<'_> {
    /// Divides the level into parts that may contain states; `None` if that does not succeed.
    pub fn parts(&self) -> Result<Option<Vec<Part>>, Fault> {
        let count = self.kept.iter().filter(|kept| **kept).count();
        let Some(whole) = Node::whole(self)? else { return Ok(None) };
        let whole = whole.combined()?;
        let (mut open, mut parts) = (vec![whole], Vec::new());
        for _ in 0..MOST_NODES {
            let Some(node) = open.pop() else { return self.without_closures(parts).map(Some) };
            let Some(node) = node.simplified() else { continue };
            let Some(node) = node.without_zero_roots()? else { continue };
            let children = match node.equations.first() {
                None if self.is_empty(&node)? => Some(Vec::new()),
                None => match self.edge(&node)? {
                    Some(edge) => Some(vec![edge]),
                    None => {
                        parts.push(node.into_part(count)?);
                        Some(Vec::new())
                    }
                },
                // After as many solutions as equations one that remains may follow from them.
                Some(equation) if node.solved >= count => {
                    match self.known(&node.graph, *equation, &node.facts)? {
                        Known::Zero => Some(vec![node.without(0)]),
                        Known::Thin | Known::Open => self.children(&node)?,
                    }
                }
                Some(_) => self.children(&node)?,
            };
            let Some(children) = children else { return Ok(None) };
            open.extend(children.into_iter().rev());
            if parts.len() > MOST_PARTS {
                break;
            }
        }
        Ok(None)
    }

    /// Whether a part is known to contain no state.
    fn is_empty(&self, node: &Node) -> Result<bool, Fault> {
        let (graph, facts) = (&node.graph, &node.facts);
        for divisor in &node.divisors {
            if self.is_zero(graph, *divisor, facts)? {
                return Ok(true);
            }
        }
        // 0 vanishes wherever the facts hold.
        Ok(is_nowhere_zero(graph, self.extents, facts, &[graph.at(0)]))
    }

    /// Divides a node by one of its equations, unless it is known to have no points.
    fn children(&self, node: &Node) -> Result<Option<Vec<Node>>, Fault> {
        Ok(match self.divided(node)? {
            None if self.has_no_point(node) => Some(Vec::new()),
            children => children,
        })
    }

    /// Whether one of the equations of a node is known to have no zero in the ranges.
    fn has_no_point(&self, node: &Node) -> bool {
        let has_none =
            |equation: &Expr| is_nowhere_zero(&node.graph, self.extents, &node.facts, &[*equation]);
        node.equations.iter().any(has_none)
    }

    /// Returns the node where a fact that is nowhere positive, and 0 on no open set, is 0: the facts
    /// hold nowhere else.
    fn edge(&self, node: &Node) -> Result<Option<Node>, Fault> {
        for (index, fact) in node.facts.iter().enumerate() {
            let known = sign(&node.graph, self.extents, &[*fact], &[], *fact);
            if known.is_some_and(|known| !known.is_positive)
                && matches!(self.known(&node.graph, *fact, &[])?, Known::Thin)
            {
                let mut edge = node.clone();
                edge.equations.push(edge.facts.swap_remove(index));
                return Ok(Some(edge));
            }
        }
        Ok(None)
    }

    fn prover(&self) -> Prover<'_> {
        Prover { sources: &[], extents: self.extents, seed: self.seed }
    }

    /// Whether a value is proved to be 0 wherever the facts hold.
    fn is_zero(&self, graph: &Graph, value: Expr, facts: &[Expr]) -> Result<bool, Fault> {
        let group = Group { facts: facts.to_vec(), ..Group::of(vec![value]) };
        Ok(self.prover().prove(graph, &[group])?.iter().all(GroupOutcome::is_zero))
    }

    fn known(&self, graph: &Graph, value: Expr, facts: &[Expr]) -> Result<Known, Fault> {
        if self.is_zero(graph, value, facts)? {
            return Ok(Known::Zero);
        }
        Ok(match self.prover().is_nonzero_on_all_cells(graph, value)? {
            true => Known::Thin,
            false => Known::Open,
        })
    }
}
