//! Long computations, beside the interpreter: they leave its lock to others, and Ctrl-C ends them.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::{Builder, available_parallelism};
use std::time::Duration;

use liouville_cli::report::diagnostic::panic_message;
use liouville_flow::stoppable;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;

/// Time between two looks for signals.
const GLANCE: Duration = Duration::from_millis(50);

/// Stack of each thread; formulas nest, and what follows them does.
const STACK: usize = 64 << 20;

/// A computation, with its threads and the switch that ends it.
///
/// All threads are its own: a process that is forked later finds none of them missing.
#[derive(Clone, Default)]
pub struct Work {
    /// Number of threads; as many as cores if it is not given.
    threads: Option<usize>,
    /// Switch that ends motions and searches.
    pub switch: Arc<AtomicBool>,
}

impl Work {
    /// Work on this number of threads.
    pub fn on(threads: Option<usize>) -> Self {
        Self { threads, ..Self::default() }
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        let cores = || available_parallelism().map_or(1, std::num::NonZero::get);
        self.threads.unwrap_or_else(cores)
    }

    /// Runs a computation on one thread. On Ctrl-C it is told to stop, and left.
    pub fn alone<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> PyResult<T> {
        let (sender, mut receiver) = channel();
        let switch = Arc::clone(&self.switch);
        let run = move || {
            let found = catch_unwind(AssertUnwindSafe(|| stoppable(&switch, work)));
            // nobody waits any more if this fails
            _ = sender.send(found);
        };
        Builder::new().stack_size(STACK).spawn(run).map_err(|error| cannot_start(&error))?;
        loop {
            let (back, found) = py.detach(move || {
                let found = receiver.recv_timeout(GLANCE);
                (receiver, found)
            });
            receiver = back;
            match found {
                Ok(found) => return found.map_err(|panic| fault(panic.as_ref())),
                Err(RecvTimeoutError::Disconnected) => return Err(fault(&"no message")),
                Err(RecvTimeoutError::Timeout) => {}
            }
            if let Err(interrupt) = py.check_signals() {
                self.switch.store(true, Ordering::Relaxed);
                return Err(interrupt);
            }
        }
    }

    /// Runs a computation whose parts are shared among the threads.
    pub fn shared<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> PyResult<T> {
        let (threads, switch) = (self.threads(), Arc::clone(&self.switch));
        let run = move || {
            let pool = ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build()?;
            Ok(pool.install(|| stoppable(&switch, work)))
        };
        self.alone(py, run)?.map_err(|error: rayon::ThreadPoolBuildError| cannot_start(&error))
    }
}

fn cannot_start(error: &dyn std::error::Error) -> PyErr {
    PyRuntimeError::new_err(format!("cannot start threads: {error}"))
}

/// Error about a fault of the program.
fn fault(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic_message(panic);
    PyRuntimeError::new_err(format!(
        "liouville failed: {text}\nthis is a fault of the program: please report it with the case"
    ))
}
