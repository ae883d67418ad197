//! When a search stops before its end.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::SearchError;

/// A search stops after some time, or when it is told to; what was reached until then is reported.
#[derive(Clone, Debug, Default)]
pub struct Halt {
    deadline: Option<Instant>,
    told: Arc<AtomicBool>,
}

impl Halt {
    /// Stops after this time, which begins now.
    pub fn within(time: Duration) -> Self {
        // A time beyond what the clock can hold is no limit.
        Self { deadline: Instant::now().checked_add(time), ..Self::default() }
    }

    /// What to set to make it stop, from a signal handler or another thread.
    pub fn switch(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.told)
    }

    /// Fails once it is time to stop.
    pub fn check(&self) -> Result<(), SearchError> {
        let is_late = self.deadline.is_some_and(|deadline| Instant::now() >= deadline);
        match is_late || self.told.load(Ordering::Relaxed) {
            true => Err(SearchError::Stopped),
            false => Ok(()),
        }
    }
}
