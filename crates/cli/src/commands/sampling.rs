//! Options of the sampling, which several commands share.

use clap::{Args, ValueEnum};

/// Options of the sampling.
#[derive(Clone, Copy, Debug, Args)]
pub struct SamplingArgs {
    /// Seed of all random states
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Number of states at which a claim is tested (rounded up to blocks of 64)
    #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    pub states: u64,
    /// Evidence required for a claim to hold: a proof, or states in floating point alone (faster).
    /// By default a proof is tried, and a confirmation accepted where there is none
    #[arg(long, value_enum)]
    pub trust: Option<TrustArg>,
    /// Number of threads; all cores by default. Results do not depend on it
    #[arg(long, value_parser = parse_threads)]
    pub threads: Option<usize>,
}

/// Reads a number of threads.
pub fn parse_threads(text: &str) -> Result<usize, String> {
    const MOST_THREADS: usize = 1024;
    let threads = text.parse().ok().filter(|threads| (1..=MOST_THREADS).contains(threads));
    threads.ok_or(format!("write a number of threads from 1 to {MOST_THREADS}"))
}

/// Required strength of evidence.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum TrustArg {
    Proof,
    Float,
}

impl SamplingArgs {
    pub fn options(&self) -> liouville::verdict::Options {
        use liouville::verdict::{Options, Trust as Asked};
        let trust = match self.trust {
            Some(TrustArg::Proof) => Asked::Proof,
            Some(TrustArg::Float) => Asked::Float,
            None => Asked::Best,
        };
        Options { seed: self.seed, states: self.states, trust, mutants: false }
    }
}
