//! Early end of a search.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::{Meter, SearchError};

/// A limit on the duration of a search, by time or by a signal, with the progress until then; results
/// reached until then are reported.
#[derive(Clone, Debug, Default)]
pub struct Halt {
    deadline: Option<Instant>,
    told: Arc<AtomicBool>,
    meter: Meter,
}

impl Halt {
    /// Makes a limit of this duration from now; there is none where there is no clock, as in a
    /// browser.
    pub fn within(time: Duration) -> Self {
        // A duration beyond the range of the clock is no limit.
        Self { deadline: now().and_then(|now| now.checked_add(time)), ..Self::default() }
    }

    /// Returns the flag that stops the search, to be set from a signal handler or another thread.
    pub fn switch(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.told)
    }

    /// Returns the same limit, with a meter of its own: for parts of a step that is metered as a whole.
    pub fn within_a_step(&self) -> Self {
        Self { meter: Meter::default(), ..self.clone() }
    }

    /// Returns the share of the present step that is done.
    pub fn meter(&self) -> &Meter {
        &self.meter
    }

    /// Whether the duration is limited.
    pub fn is_timed(&self) -> bool {
        self.deadline.is_some()
    }

    /// Time that is left, where the duration is limited.
    pub fn left(&self) -> Option<Duration> {
        Some(self.deadline?.saturating_duration_since(now()?))
    }

    /// Fails once the search is to stop.
    pub fn check(&self) -> Result<(), SearchError> {
        let is_late =
            self.deadline.is_some_and(|deadline| now().is_some_and(|now| now >= deadline));
        match is_late || self.told.load(Ordering::Relaxed) {
            true => Err(SearchError::Stopped),
            false => Ok(()),
        }
    }
}

/// The time, where there is a clock.
fn now() -> Option<Instant> {
    (!cfg!(target_arch = "wasm32")).then(Instant::now)
}
