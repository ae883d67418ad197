//! The expression graph: a computation recorded once and run in any number domain.
//!
//! ```text
//! generic code ─ instantiated at Expr ─▶ Graph ─▶ Tape ─ run over a number domain ─▶ values
//! ```
//!
//! [`record`] runs a closure over [`Expr`] inputs and keeps every operation as a node. Equal nodes
//! are one node, and exact simplifications are made on the way (see `simplify`).

mod derive;
mod dispatch;
mod dual_num;
mod emitted;
mod evaluate;
mod expand;
mod expr;
mod fingerprint;
mod hyperbolic;
mod index;
mod merge;
mod plan;
mod points;
mod presence;
mod product;
mod recording;
mod scaled;
mod simplify;
mod size;
mod steps;
mod surd;
mod tally;
mod tape;

use rustc_hash::{FxBuildHasher, FxHashMap};

use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

pub use dispatch::vector_features;
pub use dispatch::{InstructionSet, Kernel, widest, with_widest_vectors};
pub use evaluate::Evaluator;
pub use expand::{Expanded, Expansion, Side, Term};
pub use expr::Expr;
use index::Index;
pub use merge::{Choice, Member};
pub use points::Points;
pub use presence::{Need, edges, has_moduli, left_out, logarithms_times_zero};
use recording::with_graph;
pub use recording::{divisors_of, is_recorded_literally, literally, record, record_further};
pub use size::squares_of_terms;
pub use steps::Step;
pub(crate) use tape::Instruction;
pub use tape::Tape;

/// A node's place in its graph; arguments come before their users.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(u32);

/// One recorded operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Node {
    /// An index into the graph's constants.
    Constant(u32),
    Input(u32),
    Unary(UnaryFunction, NodeId),
    Binary(BinaryOperation, NodeId, NodeId),
    /// A power whose exponent is an index into the graph's constants.
    Power(NodeId, u32),
}

/// An operation that a recorded value cannot carry out, because it has no magnitude and no order.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// An operation such as abs, signum, a comparison, a remainder, atan2, or conversion to a
    /// float.
    #[error(
        "`{0}` was applied to a recorded value, which has neither magnitude nor order; \
         use operations that hold for every number, and `Scalar::modulus` for |x|"
    )]
    NeedsValue(&'static str),
    /// A value kept from an earlier recording.
    #[error("a value of one recording was used in another")]
    ForeignValue,
}

/// Domain of definition of a node, as far as its form determines it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Defined {
    /// Defined wherever the inputs are.
    Always,
    /// Not defined everywhere, or not known to be.
    Partly,
    /// Defined nowhere: 1/0 and everything that contains it.
    Never,
}

impl Defined {
    /// Domain of a value that is made from two others.
    fn and(self, other: Self) -> Self {
        self.max(other)
    }
}

/// A set of nodes as bits.
struct Met(Vec<u64>);

impl Met {
    /// Adds a node; returns whether it is new.
    #[inline]
    fn insert(&mut self, id: NodeId) -> bool {
        let (word, bit) = (&mut self.0[id.0 as usize / 64], 1 << (id.0 % 64));
        let is_new = *word & bit == 0;
        *word |= bit;
        is_new
    }
}

/// Number of nodes for which there is room from the beginning.
const USUAL: usize = 256;
/// Number of constants for which there is room from the beginning.
const FEW: usize = 14;

/// The constant 0, the first node of every graph.
const ZERO: NodeId = NodeId(0);
/// The constant 1, the second node of every graph.
const ONE: NodeId = NodeId(1);

/// A recorded computation.
#[derive(Debug)]
pub struct Graph {
    session: u32,
    nodes: Vec<Node>,
    /// Domain of definition of each node.
    domains: Vec<Defined>,
    /// Whether folds that would extend the domain of a formula are left out.
    literal: bool,
    /// Values by which systems of equations were divided, while they are asked for.
    divisors: Option<Vec<Expr>>,
    constants: Vec<Rational>,
    index: Index,
    constant_ids: FxHashMap<Rational, u32>,
    inputs: u32,
    antiderivatives: FxHashMap<(NodeId, NodeId), u32>,
    fault: Option<Fault>,
    sweeps: Box<derive::Sweeps>,
}

impl Graph {
    /// Makes an empty graph with its two constants in place.
    fn begin(session: u32) -> Self {
        let mut graph = Self {
            session,
            nodes: Vec::with_capacity(USUAL),
            domains: Vec::with_capacity(USUAL),
            literal: false,
            divisors: None,
            constants: Vec::with_capacity(FEW),
            index: Index::new(),
            constant_ids: FxHashMap::with_capacity_and_hasher(FEW, FxBuildHasher),
            inputs: 0,
            antiderivatives: FxHashMap::default(),
            fault: None,
            sweeps: Box::default(),
        };
        for value in [0, 1] {
            graph.constant(Rational::from(value));
        }
        graph
    }

    /// Makes a copy for another session.
    fn copy(&self, session: u32) -> Self {
        Self {
            session,
            nodes: self.nodes.clone(),
            domains: self.domains.clone(),
            literal: false,
            divisors: None,
            constants: self.constants.clone(),
            index: self.index.clone(),
            constant_ids: self.constant_ids.clone(),
            inputs: self.inputs,
            antiderivatives: self.antiderivatives.clone(),
            fault: None,
            sweeps: Box::default(),
        }
    }

    /// Number of nodes kept.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether nothing was recorded.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Number of inputs: those requested, followed by one for each antiderivative met.
    pub fn inputs(&self) -> usize {
        self.inputs as usize
    }

    /// Returns the exact constant that an expression was folded to, if it was.
    pub fn constant_value(&self, expr: Expr) -> Option<&Rational> {
        self.constant_at(expr.id()?)
    }

    /// Whether the form of an expression shows that it is defined for no inputs: 1/0 and everything
    /// that contains it.
    pub fn is_nowhere_defined(&self, expr: Expr) -> bool {
        expr.id().is_some_and(|id| self.is_undefined(id))
    }

    /// Whether the form shows that a value is defined wherever the inputs are.
    pub fn is_always_defined(&self, expr: Expr) -> bool {
        expr.id().is_none_or(|id| self.domains[id.0 as usize] == Defined::Always)
    }

    /// Whether an expression depends on input `input`. Linear in the size of the graph.
    pub fn depends_on(&self, expr: Expr, input: usize) -> bool {
        let Some(root) = expr.id() else { return false };
        let mut reached = vec![false; root.0 as usize + 1];
        for (index, node) in self.nodes.iter().enumerate().take(reached.len()) {
            reached[index] = match *node {
                Node::Constant(_) => false,
                Node::Input(i) => i as usize == input,
                Node::Unary(_, a) | Node::Power(a, _) => reached[a.0 as usize],
                Node::Binary(_, a, b) => reached[a.0 as usize] || reached[b.0 as usize],
            };
        }
        reached[root.0 as usize]
    }

    /// Lists the inputs on which an expression depends, in order.
    pub fn inputs_of(&self, expr: Expr) -> Vec<usize> {
        let mut inputs = Vec::new();
        self.visit(&[expr], |node| {
            if let Node::Input(input) = node {
                inputs.push(input as usize);
            }
        });
        inputs.sort_unstable();
        inputs
    }

    /// Number of operations that these expressions take together.
    pub fn operations(&self, exprs: &[Expr]) -> usize {
        let mut count = 0;
        self.visit(exprs, |node| count += usize::from(node.is_computed()));
        count
    }

    /// Visits each node that some expressions need once. Takes as long as these, but for a bit a node of
    /// the graph.
    fn visit(&self, exprs: &[Expr], mut each: impl FnMut(Node)) {
        let mut met = Met(vec![0; self.nodes.len().div_ceil(64)]);
        let mut open: Vec<NodeId> = exprs.iter().filter_map(|expr| expr.id()).collect();
        open.retain(|id| met.insert(*id));
        while let Some(id) = open.pop() {
            let node = self.node(id);
            each(node);
            let arguments = match node {
                Node::Constant(_) | Node::Input(_) => [None, None],
                Node::Unary(_, a) | Node::Power(a, _) => [Some(a), None],
                Node::Binary(_, a, b) => [Some(a), Some(b)],
            };
            open.extend(arguments.into_iter().flatten().filter(|argument| met.insert(*argument)));
        }
    }

    #[inline]
    fn constant_at(&self, id: NodeId) -> Option<&Rational> {
        match self.nodes[id.0 as usize] {
            Node::Constant(index) => Some(&self.constants[index as usize]),
            _ => None,
        }
    }

    #[inline]
    fn node(&self, id: NodeId) -> Node {
        self.nodes[id.0 as usize]
    }

    #[inline]
    fn intern(&mut self, node: Node) -> NodeId {
        if let Some(id) = self.index.find_or_note(node, &self.nodes) {
            return id;
        }
        let id = NodeId(self.nodes.len() as u32);
        self.domains.push(self.domain_of(node));
        self.nodes.push(node);
        id
    }

    /// Makes room for so many more nodes.
    fn make_room(&mut self, more: usize) {
        self.nodes.reserve(more);
        self.domains.reserve(more);
        self.index.reserve(self.nodes.len() + more, &self.nodes);
    }

    #[inline]
    fn is_undefined(&self, id: NodeId) -> bool {
        self.domains[id.0 as usize] == Defined::Never
    }

    /// Whether a value may be dropped: it is defined everywhere, or domains are not preserved.
    #[inline]
    fn may_drop(&self, id: NodeId) -> bool {
        match self.domains[id.0 as usize] {
            Defined::Always => true,
            Defined::Partly => !self.literal,
            Defined::Never => false,
        }
    }

    /// Finds the domain of definition of a node from its arguments and its own operation: 1/0, √-1,
    /// ln 0 and 0^-1 are undefined.
    #[inline]
    fn domain_of(&self, node: Node) -> Defined {
        match node {
            Node::Binary(BinaryOperation::Pow, ..) | Node::Power(..) => {}
            Node::Binary(_, a, b) => {
                return self.domains[a.0 as usize].and(self.domains[b.0 as usize]);
            }
            Node::Unary(UnaryFunction::Neg, a) => return self.domains[a.0 as usize],
            Node::Constant(_) | Node::Input(_) => return Defined::Always,
            Node::Unary(..) => {}
        }
        let step = self.step_of(node);
        let arguments = step.arguments().map(|place| self.domains[place]);
        let arguments = arguments.fold(Defined::Always, Defined::and);
        let Some((place, need)) = step.need() else { return arguments };
        match self.constant_at(NodeId(place as u32)) {
            // √0 is at the end of a domain.
            Some(value) if need.is_met_by(value) && !value.is_zero() => arguments,
            Some(value) if need.is_met_by(value) => arguments.and(Defined::Partly),
            Some(_) => Defined::Never,
            None => arguments.and(Defined::Partly),
        }
    }

    fn intern_constant(&mut self, value: Rational) -> u32 {
        if let Some(index) = self.constant_ids.get(&value) {
            return *index;
        }
        let index = self.constants.len() as u32;
        self.constants.push(value.clone());
        self.constant_ids.insert(value, index);
        index
    }

    fn fail(&mut self, fault: Fault) {
        self.fault.get_or_insert(fault);
    }
}
