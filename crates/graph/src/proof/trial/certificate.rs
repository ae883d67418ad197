//! Bounds on the probability of an error, and their combination.

/// A bound on the probability that a value found zero at all points is not identically zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// Number of primes used.
    pub primes: usize,
    /// Number of accepted points, all primes together.
    pub points: usize,
    /// Number of points drawn.
    pub draws: u64,
    /// Bound βn on the degree.
    pub degree: f64,
    /// Bound H on the bits of the coefficients.
    pub height: f64,
    /// Number of roots of any index.
    pub roots: usize,
    /// Log₂ of the error probability.
    pub error_log2: f64,
}

impl Certificate {
    /// Returns the bound for the case that both certificates are needed.
    pub fn and(self, other: Self) -> Self {
        Self {
            primes: self.primes.max(other.primes),
            points: fewest(self.points, other.points),
            draws: self.draws.max(other.draws),
            degree: self.degree.max(other.degree),
            height: self.height.max(other.height),
            roots: self.roots.max(other.roots),
            error_log2: sum_log2(self.error_log2, other.error_log2),
        }
    }
}

/// Log₂ of a bound on the sum of two error probabilities, from theirs: log₂(2^a + 2^b) ≤ max + 1.
pub fn sum_log2(a: f64, b: f64) -> f64 {
    a.max(b) + 1.0
}

/// Returns the smaller number of points; 0 counts as missing.
pub fn fewest(a: usize, b: usize) -> usize {
    if a == 0 || b == 0 { a.max(b) } else { a.min(b) }
}

/// Returns the bound for all certificates present.
pub fn both(a: Option<Certificate>, b: Option<Certificate>) -> Option<Certificate> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.and(b)),
        (a, b) => a.or(b),
    }
}
