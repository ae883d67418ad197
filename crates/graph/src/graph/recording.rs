//! Recordings under way, one at a time on each thread.

use std::cell::RefCell;

use super::{Expr, Fault, Graph, Node, NodeId};

thread_local! {
    /// The recording under way on this thread, if any.
    static RECORDING: RefCell<Graph> = RefCell::new(Graph::begin(0));
    static SESSIONS: RefCell<u32> = const { RefCell::new(0) };
}

/// Records what `build` computes from `inputs` free inputs; returns the graph and the result.
///
/// Recordings may be nested; each has its own graph. Fails if a recorded value was used in an
/// operation that needs a magnitude or an order, or in another recording.
pub fn record<R>(inputs: usize, build: impl FnOnce(&[Expr]) -> R) -> Result<(Graph, R), Fault> {
    recorded(Graph::begin, || {
        let handles: Vec<Expr> = (0..inputs).map(|_| Expr::input()).collect();
        build(&handles)
    })
}

/// Records further values of a graph, from its inputs and its own values, in a copy of it: `build` gets
/// the inputs, and a function that finds a value of the graph in the copy. Values keep their places.
pub fn record_further<R>(
    graph: &Graph,
    build: impl FnOnce(&[Expr], &dyn Fn(Expr) -> Expr) -> R,
) -> Result<(Graph, R), Fault> {
    recorded(
        |session| graph.copy(session),
        || {
            let input = |input: u32| Expr::made(|graph| graph.intern(Node::Input(input)));
            let handles: Vec<Expr> = (0..graph.inputs).map(input).collect();
            let session = with_graph(|graph| graph.session);
            build(&handles, &|value| Expr::of(session, NodeId(graph.place(value) as u32)))
        },
    )
}

/// Records from a graph of a new session on.
fn recorded<R>(
    begin: impl FnOnce(u32) -> Graph,
    build: impl FnOnce() -> R,
) -> Result<(Graph, R), Fault> {
    let session = SESSIONS.with_borrow_mut(|last| {
        *last = last.wrapping_add(1).max(1);
        *last
    });
    let mut outer = Restore(Some(RECORDING.replace(begin(session))));
    let result = build();
    let mut graph = outer.finish().unwrap_or_else(|| Graph::begin(session));
    match graph.fault.take() {
        Some(fault) => Err(fault),
        None => Ok((graph, result)),
    }
}

/// Runs `build` without folding away any operation on recorded values that may be undefined, so
/// that the result is defined exactly where the formula as written is.
///
/// Otherwise √x·√x becomes x and 0·√x becomes 0, which are defined for x < 0 too.
pub fn literally<R>(build: impl FnOnce() -> R) -> R {
    struct Restore(bool);
    impl Drop for Restore {
        fn drop(&mut self) {
            with_graph(|graph| graph.literal = self.0);
        }
    }
    let _restore = Restore(with_graph(|graph| std::mem::replace(&mut graph.literal, true)));
    build()
}

/// Returns the values by which systems of equations are divided in what `build` records, also where the quotient
/// is folded: 0·(1/det) is 0.
pub fn divisors_of(build: impl FnOnce()) -> Vec<Expr> {
    let outer = with_graph(|graph| graph.divisors.replace(Vec::new()));
    build();
    with_graph(|graph| std::mem::replace(&mut graph.divisors, outer)).unwrap_or_default()
}

/// Whether the recording under way folds away nothing that may be undefined, as within [`literally`].
pub fn is_recorded_literally() -> bool {
    with_graph(|graph| graph.literal)
}

/// A guard that puts the outer recording back, also when the closure unwinds.
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
pub(super) fn with_graph<R>(action: impl FnOnce(&mut Graph) -> R) -> R {
    RECORDING.with_borrow_mut(action)
}
