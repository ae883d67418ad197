//! Progress of single motions: shares that are told while a motion is followed.

/// Least share of a motion that is told by itself.
const LEAST: f64 = 1.0 / 256.0;

/// Share of a motion that was told so far; all that is told adds up to 1.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ToldShare(f64);

impl ToldShare {
    /// Tells that this share of the motion is done, if that is news.
    pub fn reach(&mut self, share: f64, progress: &dyn Fn(f64)) {
        // The rest is told by `finish`. NaN stays NaN, and is not told.
        let share = share.clamp(0.0, 1.0 - LEAST);
        if share - self.0 >= LEAST {
            progress(share - self.0);
            self.0 = share;
        }
    }

    /// Tells that the motion is done.
    pub fn finish(&mut self, progress: &dyn Fn(f64)) {
        progress(1.0 - self.0);
        self.0 = 1.0;
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    #[test]
    fn shares_add_up_to_one() {
        let (sum, times) = (Cell::new(0.0), Cell::new(0));
        let progress = |share: f64| {
            assert!(share > 0.0, "only what is new is told");
            sum.set(sum.get() + share);
            times.set(times.get() + 1);
        };
        let mut told = ToldShare::default();
        for step in 0..10_000 {
            // A step that is taken back, and a share that is NaN, change nothing.
            told.reach(f64::from(step) / 9_000.0, &progress);
            told.reach(0.0, &progress);
            told.reach(f64::NAN, &progress);
        }
        assert!(sum.get() > 0.99 && sum.get() < 1.0, "{} before the end", sum.get());
        assert!(times.get() <= 256, "{} times", times.get());
        told.finish(&progress);
        assert!((sum.get() - 1.0).abs() < 1e-12, "{}", sum.get());
    }
}
