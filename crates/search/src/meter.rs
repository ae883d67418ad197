//! Share of the present step of a search that is done, for whoever shows it.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Parts of a step that are counted.
const PARTS: f64 = 1e9;
/// Stands for a share that is not known.
const UNKNOWN: u64 = u64::MAX;

/// Share of the present step that is done, where that is known; clones show the same.
#[derive(Clone, Debug)]
pub struct Meter(Arc<AtomicU64>);

impl Default for Meter {
    fn default() -> Self {
        Self(Arc::new(AtomicU64::new(UNKNOWN)))
    }
}

impl Meter {
    /// Says how many pieces of the step are done.
    pub fn set(&self, done: usize, all: usize) {
        let share = if all == 0 { 0.0 } else { done as f64 / all as f64 };
        self.0.store((share.min(1.0) * PARTS) as u64, Ordering::Relaxed);
    }

    /// Says that the share is not known, as at the beginning of a step.
    pub fn clear(&self) {
        self.0.store(UNKNOWN, Ordering::Relaxed);
    }

    /// Returns the share, if it is known.
    pub fn share(&self) -> Option<f64> {
        let parts = self.0.load(Ordering::Relaxed);
        (parts != UNKNOWN).then(|| parts as f64 / PARTS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clones_show_the_same_share() {
        let meter = Meter::default();
        let shown = meter.clone();
        assert_eq!(shown.share(), None, "nothing is known");
        meter.set(1, 4);
        assert_eq!(shown.share(), Some(0.25));
        meter.set(0, 0);
        assert_eq!(shown.share(), Some(0.0), "nothing to do is no division by 0");
        meter.clear();
        assert_eq!(shown.share(), None);
    }
}
