//! Size of a linear system, and the limits on it.

use super::super::Effort;

/// Lower bound on the elementary steps of an elimination per second.
const STEPS: f64 = 5e8;

/// Numbers of unknowns and blocks of a linear system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SystemSize {
    unknowns: usize,
    blocks: usize,
    largest: usize,
    seconds: f64,
}

impl SystemSize {
    /// Computes the size of a system that decomposes into blocks.
    pub fn of(blocks: &[Vec<usize>]) -> Self {
        let sizes = || blocks.iter().map(Vec::len);
        Self {
            unknowns: sizes().sum(),
            blocks: blocks.len(),
            largest: sizes().max().unwrap_or(0),
            seconds: sizes().map(|n| (n as f64).powi(3) / STEPS).sum(),
        }
    }

    fn megabytes(&self) -> u64 {
        let largest = self.largest as u64;
        (largest * largest * 8).div_ceil(1_000_000)
    }

    /// Returns the limit that the system exceeds, if any.
    pub fn beyond(&self, effort: &Effort) -> Option<String> {
        if self.megabytes() > effort.ansatz.megabytes {
            return Some(format!(
                "the bound is {} MB, see --count-megabytes",
                effort.ansatz.megabytes
            ));
        }
        (self.seconds > effort.seconds)
            .then(|| format!("the bound is {} s, see --count-seconds", effort.seconds))
    }
}

impl std::fmt::Display for SystemSize {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { unknowns, blocks, largest, seconds } = self;
        let megabytes = self.megabytes();
        write!(
            f,
            "{unknowns} unknowns in {blocks} blocks, {largest} in the largest, at most {seconds:.1} s and {megabytes} MB"
        )
    }
}
