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
    let (recording, handles) = Recording::of_inputs(inputs);
    let result = build(&handles);
    Ok((recording.finish()?, result))
}

/// Records further values of a graph, from its inputs and its own values, in a copy of it: `build` gets
/// the inputs, and a function that finds a value of the graph in the copy. Values keep their places.
pub fn record_further<R>(
    graph: &Graph,
    build: impl FnOnce(&[Expr], &dyn Fn(Expr) -> Expr) -> R,
) -> Result<(Graph, R), Fault> {
    let (recording, handles) = Recording::of_copy(graph);
    let session = recording.session;
    let place = |value| Expr::of(session, NodeId(graph.place(value) as u32));
    let result = build(&handles, &place);
    Ok((recording.finish()?, result))
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
///
/// None of its functions depends on what is recorded: each is compiled once, not for each closure.
struct Recording {
    session: u32,
    outer: Option<Graph>,
}

impl Recording {
    /// Begins an empty graph with free inputs.
    fn of_inputs(inputs: usize) -> (Self, Vec<Expr>) {
        let session = next_session();
        let recording = Self::begin(Graph::begin(session));
        (recording, (0..inputs).map(|_| Expr::input()).collect())
    }

    /// Begins with a copy of a graph.
    fn of_copy(graph: &Graph) -> (Self, Vec<Expr>) {
        let session = next_session();
        let recording = Self::begin(graph.copy(session));
        let input = |input: u32| Expr::made(|graph| graph.intern(Node::Input(input)));
        (recording, (0..graph.inputs).map(input).collect())
    }

    fn begin(graph: Graph) -> Self {
        Self { session: graph.session, outer: Some(RECORDING.replace(graph)) }
    }

    fn finish(mut self) -> Result<Graph, Fault> {
        let mut graph = self.restore().unwrap_or_else(|| Graph::begin(self.session));
        match graph.fault.take() {
            Some(fault) => Err(fault),
            None => Ok(graph),
        }
    }

    fn restore(&mut self) -> Option<Graph> {
        self.outer.take().map(|outer| RECORDING.replace(outer))
    }
}

impl Drop for Recording {
    #[inline(never)]
    fn drop(&mut self) {
        self.restore();
    }
}

/// The number of a new session, which is not 0.
fn next_session() -> u32 {
    SESSIONS.with_borrow_mut(|last| {
        *last = last.wrapping_add(1).max(1);
        *last
    })
}

#[inline]
pub(super) fn with_graph<R>(action: impl FnOnce(&mut Graph) -> R) -> R {
    RECORDING.with_borrow_mut(action)
}
