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

    /// Returns the same limit, but with so much time from now where its own has ended: for what has been
    /// found until then. Who stops the search from outside stops that as well.
    pub fn extended(&self, time: Duration) -> Self {
        let longer = now().and_then(|now| now.checked_add(time));
        let deadline = self.deadline.map(|own| longer.map_or(own, |longer| own.max(longer)));
        Self { deadline, ..self.clone() }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_found_has_time_after_the_end() {
        let ended = Halt::within(Duration::ZERO);
        assert!(ended.check().is_err(), "no time is left");
        assert_eq!(ended.left(), Some(Duration::ZERO));
        let extended = ended.extended(Duration::from_secs(600));
        assert!(extended.check().is_ok(), "ten minutes are");
        assert!(extended.left().is_some_and(|left| left > Duration::from_secs(60)));
        ended.switch().store(true, Ordering::Relaxed);
        assert!(extended.check().is_err(), "who stops the search stops that as well");
        assert!(Halt::default().extended(Duration::ZERO).left().is_none(), "no limit stays none");
    }
}
