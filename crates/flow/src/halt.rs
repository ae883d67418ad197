//! Early end of motions, at a request from another thread.
//!
//! The flag belongs to a thread and to those that it starts for its motions, so that no function
//! on the way needs to know of it.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    /// Flag under which this thread works.
    static CURRENT: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
}

/// Flag that ends motions, if there is one.
#[derive(Clone, Debug, Default)]
pub(super) struct Halt(Option<Arc<AtomicBool>>);

impl Halt {
    /// Flag of this thread.
    pub fn current() -> Self {
        Self(CURRENT.with_borrow(Clone::clone))
    }

    /// Whether motions are to end.
    pub fn is_raised(&self) -> bool {
        self.0.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Runs work under this flag.
    pub fn over<R>(self, work: impl FnOnce() -> R) -> R {
        let _former = Former(CURRENT.replace(self.0));
        work()
    }
}

/// Flag of before, which comes back when this is dropped.
struct Former(Option<Arc<AtomicBool>>);

impl Drop for Former {
    fn drop(&mut self) {
        CURRENT.set(self.0.take());
    }
}

/// Runs work whose motions end early once the flag is raised; each of them then yields
/// [`FlowError::Stopped`](crate::FlowError::Stopped), single orbits
/// [`FlowError::StoppedAt`](crate::FlowError::StoppedAt).
///
/// ```
/// use std::sync::Arc;
/// use std::sync::atomic::AtomicBool;
/// use liouville::case::Case;
/// use liouville::number::double_double::DoubleDouble;
/// use liouville_flow::{FlowError, Precision, Start, orbit, stoppable};
///
/// let case = Case::parse("title = 'a'\n[state]\nx = '-1..1'\n[field]\n\"x'\" = '1 - x'\n", &[])?;
/// let start = Start::new(&case, None, 1, 0)?;
/// let raised = Arc::new(AtomicBool::new(true));
/// let found =
///     stoppable(&raised, || orbit(&case, start, DoubleDouble::from_f64(1e9), Precision::Float));
/// assert!(matches!(found, Err(FlowError::StoppedAt { .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn stoppable<R>(flag: &Arc<AtomicBool>, work: impl FnOnce() -> R) -> R {
    Halt(Some(Arc::clone(flag))).over(work)
}

/// Question whether the work of this thread is to end, for the threads that share it.
///
/// ```
/// use std::sync::Arc;
/// use std::sync::atomic::AtomicBool;
/// use liouville_flow::{stop_request, stoppable};
///
/// let raised = Arc::new(AtomicBool::new(true));
/// assert!(stoppable(&raised, || stop_request()()));
/// assert!(!stop_request()());
/// ```
pub fn stop_request() -> impl Fn() -> bool + Send + Sync {
    let halt = Halt::current();
    move || halt.is_raised()
}
