//! The expression graph: what a computation *is*, recorded once and run in any number domain.
//!
//! ```text
//! generic code ─ instantiated at Expr ─▶ Graph ─▶ Tape ─ run over a number domain ─▶ values
//! ```
//!
//! [`record`] runs a closure over [`Expr`] inputs and keeps every operation as a node. Equal nodes
//! are one node, and exact simplifications are made on the way (see `simplify`).

mod dispatch;
mod dual_num;
mod evaluate;
mod expr;
mod fingerprint;
mod index;
mod merge;
mod simplify;
mod steps;
mod tape;

use std::cell::RefCell;

use rustc_hash::FxHashMap;

use crate::number::rational::Rational;
use crate::number::{Function, Operation};

pub use dispatch::vector_features;
pub(crate) use dispatch::{Vectors, Work, widest, with_widest_vectors};
pub use evaluate::Evaluator;
pub use expr::Expr;
use index::Index;
pub(crate) use merge::{Choice, Member};
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
    Unary(Function, NodeId),
    Binary(Operation, NodeId, NodeId),
    /// A power whose exponent is an index into the graph's constants.
    Power(NodeId, u32),
}

/// An operation that a recorded value cannot carry out, because it has no magnitude and no order.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// abs, signum, comparisons, remainders, atan2, reading off a float.
    #[error(
        "`{0}` was applied to a recorded value, which has neither magnitude nor order; \
         use operations that hold for every number, and `Scalar::modulus` for |x|"
    )]
    NeedsValue(&'static str),
    /// A value kept from an earlier recording.
    #[error("a value of one recording was used in another")]
    ForeignValue,
}

/// The constant 0, the first node of every graph.
const ZERO: NodeId = NodeId(0);
/// The constant 1, the second.
const ONE: NodeId = NodeId(1);

/// A recorded computation.
#[derive(Debug)]
pub struct Graph {
    session: u32,
    nodes: Vec<Node>,
    /// Which nodes have no value, whatever the inputs: 1/0 and what follows from it.
    undefined: Vec<bool>,
    constants: Vec<Rational>,
    index: Index,
    constant_ids: FxHashMap<Rational, u32>,
    inputs: u32,
    antiderivatives: FxHashMap<(NodeId, NodeId), u32>,
    fault: Option<Fault>,
}

impl Graph {
    /// An empty graph with its two constants in place.
    fn begin(session: u32) -> Self {
        let mut graph = Self {
            session,
            nodes: Vec::new(),
            undefined: Vec::new(),
            constants: Vec::new(),
            index: Index::new(),
            constant_ids: FxHashMap::default(),
            inputs: 0,
            antiderivatives: FxHashMap::default(),
            fault: None,
        };
        for value in [0, 1] {
            graph.constant(Rational::from(value));
        }
        graph
    }

    /// How many nodes were kept.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Was nothing recorded?
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// How many inputs there are: those asked for, then one for each antiderivative met.
    pub fn inputs(&self) -> usize {
        self.inputs as usize
    }

    /// The exact constant that an expression was folded to, if it was.
    pub fn constant_value(&self, expr: Expr) -> Option<&Rational> {
        self.constant_at(expr.id()?)
    }

    /// Does this expression depend on input `input`? (Linear in the size of the graph.)
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

    /// How many operations these expressions take together.
    pub fn operations(&self, exprs: &[Expr]) -> usize {
        let reached = self.reached(exprs.iter().copied());
        let computed = |(node, reached): &(&Node, bool)| *reached && node.is_computed();
        self.nodes.iter().zip(reached).filter(computed).count()
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
        self.undefined.push(self.has_no_value(node));
        self.nodes.push(node);
        id
    }

    #[inline]
    fn is_undefined(&self, id: NodeId) -> bool {
        self.undefined[id.0 as usize]
    }

    /// Is this undefined, because of its arguments or of its own: 1/0, √-1, ln 0, 0^-1?
    fn has_no_value(&self, node: Node) -> bool {
        let negative = |a| self.constant_at(a).is_some_and(Rational::is_negative);
        match node {
            Node::Constant(_) | Node::Input(_) => false,
            Node::Unary(function, a) => {
                self.is_undefined(a)
                    || match function {
                        Function::Recip => a == ZERO,
                        Function::Sqrt => negative(a),
                        Function::Ln => a == ZERO || negative(a),
                        _ => false,
                    }
            }
            Node::Binary(_, a, b) => self.is_undefined(a) || self.is_undefined(b),
            Node::Power(a, exponent) => {
                let below = self.constants[exponent as usize].is_negative();
                self.is_undefined(a) || negative(a) || (a == ZERO && below)
            }
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

thread_local! {
    /// The recording under way on this thread, if any, and the number of the last one begun.
    static RECORDING: RefCell<Graph> = RefCell::new(Graph::begin(0));
    static SESSIONS: RefCell<u32> = const { RefCell::new(0) };
}

/// Records what `build` computes from `inputs` free inputs; returns the graph and its result.
///
/// Recordings may be nested; each has its own graph. Fails when a recorded value was asked for
/// something it does not have.
pub fn record<R>(inputs: usize, build: impl FnOnce(&[Expr]) -> R) -> Result<(Graph, R), Fault> {
    let session = SESSIONS.with_borrow_mut(|last| {
        *last = last.wrapping_add(1).max(1);
        *last
    });
    let mut outer = Restore(Some(RECORDING.replace(Graph::begin(session))));
    let handles: Vec<Expr> = (0..inputs).map(|_| Expr::input()).collect();
    let result = build(&handles);
    let mut graph = outer.finish().unwrap_or_else(|| Graph::begin(session));
    match graph.fault.take() {
        Some(fault) => Err(fault),
        None => Ok((graph, result)),
    }
}

/// Puts the outer recording back, also when the closure unwinds.
struct Restore(Option<Graph>);

impl Restore {
    fn finish(&mut self) -> Option<Graph> {
        self.0.take().map(|outer| RECORDING.replace(outer))
    }
}

impl Drop for Restore {
    fn drop(&mut self) {
        self.finish();
    }
}

#[inline]
fn with_graph<R>(action: impl FnOnce(&mut Graph) -> R) -> R {
    RECORDING.with_borrow_mut(action)
}
