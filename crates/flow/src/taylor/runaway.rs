//! Motions that run away: their steps shrink at a steady rate, as far as one looks.
//!
//! On a spiral that grows like e^(kt) and turns as fast as it is large, each number of steps that is
//! twice the one before ends a time (ln 2)/k later. Where the mean step has fallen so through several
//! doublings, at a rate that does not fall, the number of steps that are left is known up to what
//! happens far out.

/// Binary logarithm of the number of steps from which on doublings are looked at.
const FIRST: u32 = 10;
/// Number of steps from which on a motion may be given up. One that comes to a cycle before ten times
/// as many shows it by a rate that falls.
const LEAST: u64 = 1 << 18;
/// Number of doublings that have to agree.
const DOUBLINGS: usize = 6;
/// Ratio of the mean steps of two doublings, above which steps shrink.
const SHRINKS: f64 = 1.5;
/// Ratio of the rates of two doublings, below which the later one has fallen.
const FALLS: f64 = 0.95;

/// Mean step over a doubling of the number of steps, and the times between which it was taken.
#[derive(Clone, Copy, Default)]
struct Doubling {
    mean: f64,
    begin: f64,
    end: f64,
}

impl Doubling {
    /// Rate at which steps shrink from another doubling to this one, per time.
    fn rate(&self, before: &Self) -> f64 {
        let apart = 0.5 * ((self.begin - before.begin) + (self.end - before.end));
        (before.mean / self.mean).ln() / apart.abs()
    }
}

/// Mean steps of the last doublings of the number of steps.
#[derive(Clone, Copy, Default)]
pub(super) struct Runaway {
    doublings: [Doubling; DOUBLINGS],
    now: f64,
}

impl Runaway {
    /// Keeps the time after a number of steps. Returns the number of steps that the time that is left
    /// takes if they go on shrinking, where they do so steadily.
    pub(super) fn keep(&mut self, steps: u64, now: f64, left: f64) -> Option<f64> {
        if !steps.is_power_of_two() || steps.ilog2() < FIRST {
            return None;
        }
        let mean = (now - self.now).abs() / (steps / 2) as f64;
        self.doublings.rotate_left(1);
        self.doublings[DOUBLINGS - 1] = Doubling { mean, begin: self.now, end: now };
        self.now = now;
        let is_late = steps >= LEAST;
        let shrinks = |pair: &[Doubling]| pair[0].mean > SHRINKS * pair[1].mean;
        if !is_late || !self.doublings.windows(2).all(shrinks) {
            return None;
        }
        let rates = self.doublings.windows(2).map(|pair| pair[1].rate(&pair[0]));
        let rates: Vec<f64> = rates.collect();
        let is_steady = rates.windows(2).all(|pair| pair[1] > FALLS * pair[0]);
        let rate = rates.iter().copied().fold(f64::INFINITY, f64::min);
        let exponent = rate * left.abs();
        (is_steady && rate > 0.0).then(|| exponent.exp_m1() / (rate * mean))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest number of steps that were found to be left of the time 1000, on a spiral that grows by
    /// `growth` at a radius, and whose steps are 1/3 of 1/radius.
    fn left(growth: impl Fn(f64) -> f64) -> Option<f64> {
        let (mut runaway, mut radius, mut now) = (Runaway::default(), 1.0, 0.0);
        (1..=1 << 21).find_map(|steps| {
            let step = 1.0 / (3.0 * radius);
            radius += growth(radius) * step;
            now += step;
            runaway.keep(steps, now, 1000.0 - now)
        })
    }

    #[test]
    fn a_spiral_that_goes_on_is_told_from_one_that_ends() {
        assert!(left(|r| 0.07 * r).is_some_and(|left| left > 1e20), "for ever");
        assert!(left(|r| 0.007 * r).is_some_and(|left| left < 1e9), "it arrives");
        for cycle in [1e2, 1e3, 1e4] {
            let found = left(|r| 0.07 * r * (1.0 - (r / cycle) * (r / cycle)));
            assert_eq!(found, None, "a cycle at {cycle}");
        }
        assert_eq!(left(|_| 0.07), None, "grows like a root");
    }
}
