//! Least periods: how many times a closed orbit is run through in the period that is enclosed.
//!
//! ```text
//! (n, v) > 0 up to the time t                      the orbit closes at no time in (0, t]
//! φ(T/(k p)) apart from the start, primes p ≤ T/(k t)      T/k is the least of the periods, if it is one
//! ```
//!
//! docs/closed-orbits.md has the theorems. Times are shares of the period in units of the nodes, so
//! that its enclosure does not enter the bounds of k.

/// Number of windows into which the first segment, or the begin of it, is divided.
pub const WINDOWS: usize = 8;
/// Begins of the first segment that are tried: all of it, and then the first window of the one before.
const BEGINS: usize = 3;
/// Largest number of parts of a period that are tried.
const MOST_PARTS: f64 = 20_000.0;
/// Factor that covers the rounding of a sum of shares.
const ALLOWANCE: f64 = 1.0 + 1e-9;

/// Reason why it is not known how many times an orbit is run through.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Doubt {
    /// No time is known in which the motion does not return.
    #[error("no time is proved in which the motion leaves its start")]
    Start,
    /// A part of the period may be a period.
    #[error(
        "after 1/{0} of the period the motion is so near its start that neither a return nor its \
         absence is proved"
    )]
    Part(usize),
}

/// Closed orbit that is enclosed, and can be followed from its nodes.
pub trait Followed {
    /// Shares of the period between the nodes.
    fn shares(&self) -> &[f64];
    /// Number of windows of this share, one after another from the start, in which (n, v) > 0 for
    /// a vector n. At most [`WINDOWS`].
    fn leaves(&self, window: f64) -> usize;
    /// Whether the motion is apart from the start after 1/k of the period, for each of some k.
    fn are_apart(&self, parts: &[usize]) -> Vec<bool>;
    /// Whether 1/k of the period is proved to be a period, given a share of the period in which the
    /// orbit does not close.
    fn closes(&self, part: usize, early: f64) -> bool;
}

/// Number k for which 1/k of the enclosed period is proved to be the least period.
pub fn turns(orbit: &impl Followed) -> Result<usize, Doubt> {
    let early = early(orbit).ok_or(Doubt::Start)?;
    let most = whole(orbit.shares()) * ALLOWANCE / early;
    if most.is_nan() || most > MOST_PARTS {
        return Err(Doubt::Start);
    }
    let most = most as usize;
    let mut known = 1;
    loop {
        let parts: Vec<usize> = primes(most / known).map(|prime| known * prime).collect();
        let apart = orbit.are_apart(&parts);
        let near = parts.iter().enumerate().find(|(index, _)| apart.get(*index) != Some(&true));
        match near {
            None => return Ok(known),
            Some((_, part)) if orbit.closes(*part, early) => known = *part,
            Some((_, part)) => return Err(Doubt::Part(*part)),
        }
    }
}

/// Share of the period, rounded down, before which the orbit does not close.
fn early(orbit: &impl Followed) -> Option<f64> {
    let mut window = orbit.shares().first()? / WINDOWS as f64;
    for _ in 0..BEGINS {
        let count = orbit.leaves(window);
        if count > 0 {
            return Some(window * count as f64 / ALLOWANCE);
        }
        window /= WINDOWS as f64;
    }
    None
}

/// Sum of all shares.
pub fn whole(shares: &[f64]) -> f64 {
    shares.iter().fold(0.0, |sum, share| sum + share)
}

/// Primes up to a number.
fn primes(most: usize) -> impl Iterator<Item = usize> {
    let is_prime = |n: &usize| (2..).take_while(|d| d * d <= *n).all(|d| !n.is_multiple_of(d));
    (2..=most).filter(is_prime)
}

/// Share of a segment, relative to it, below which a time is counted with the segment before: there
/// a step does not begin at its end.
const BRIM: f64 = 1e-6;

/// Segment that contains a share of the period, or ends a little before it.
pub fn place(shares: &[f64], after: f64) -> usize {
    let (mut begin, mut found) = (0.0, 0);
    for (index, share) in shares.iter().enumerate() {
        if begin + BRIM * share >= after {
            break;
        }
        found = index;
        begin += share;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Orbit of equal segments that leaves its start in the first, and is run through some times.
    struct Circle {
        shares: Vec<f64>,
        turns: usize,
        /// Number of windows in which it leaves the start, for windows up to a share.
        leaves: (usize, f64),
        /// Whether returns are proved.
        closes: bool,
    }

    impl Followed for Circle {
        fn shares(&self) -> &[f64] {
            &self.shares
        }

        fn leaves(&self, window: f64) -> usize {
            if window <= self.leaves.1 { self.leaves.0 } else { 0 }
        }

        fn are_apart(&self, parts: &[usize]) -> Vec<bool> {
            parts.iter().map(|part| !self.turns.is_multiple_of(*part)).collect()
        }

        fn closes(&self, part: usize, _: f64) -> bool {
            assert!(self.turns.is_multiple_of(part), "asked where it is apart");
            self.closes
        }
    }

    #[test]
    fn turns_are_counted() {
        for count in 1..=60 {
            let mut orbit = Circle {
                shares: vec![1.0 / 64.0; 64],
                turns: count,
                leaves: (1, 1.0),
                closes: true,
            };
            assert_eq!(turns(&orbit), Ok(count), "run through {count} times");
            orbit.closes = false;
            let least = (2..=count).find(|k| count.is_multiple_of(*k));
            assert_eq!(turns(&orbit), least.map_or(Ok(1), |k| Err(Doubt::Part(k))), "{count}");
        }
    }

    #[test]
    fn without_a_begin_nothing_is_known() {
        let mut orbit = Circle { shares: vec![0.25; 4], turns: 1, leaves: (0, 1.0), closes: true };
        assert_eq!(turns(&orbit), Err(Doubt::Start), "it never leaves");
        orbit.leaves = (3, 1e-3);
        assert_eq!(turns(&orbit), Ok(1), "in a shorter window");
        orbit.leaves = (3, 1e-9);
        assert_eq!(turns(&orbit), Err(Doubt::Start), "in none that is tried");
        orbit.leaves = (3, 1.0);
        for shares in [vec![], vec![0.0, 1.0], vec![f64::NAN, 1.0], vec![1e-300, 1.0]] {
            orbit.shares = shares;
            assert_eq!(turns(&orbit), Err(Doubt::Start), "{:?}", orbit.shares);
        }
    }

    #[test]
    fn times_have_their_segments() {
        let shares = [0.25, 0.5, 0.25];
        for (after, segment) in [
            (1e-9, 0),
            (0.1, 0),
            (0.25, 0),
            (0.25 + 1e-9, 0),
            (0.26, 1),
            (0.75, 1),
            (0.9, 2),
            (1.0, 2),
        ] {
            assert_eq!(place(&shares, after), segment, "{after}");
        }
        assert_eq!(primes(20).collect::<Vec<_>>(), [2, 3, 5, 7, 11, 13, 17, 19]);
        assert_eq!(primes(1).count() + primes(0).count(), 0);
    }
}
