//! Commands beyond the claims of a case: its further invariants, its motions, and benchmarks.

mod bench;
mod chart;
mod exponents;
mod motion;
mod orbit;
mod periodic;
mod progress;
mod report;
mod search;
mod section;
mod stress;

use std::path::Path;

use clap::Subcommand;

use super::{Answer, Sampling, colour, eval, files, width};

#[derive(Debug, Subcommand)]
pub enum Command {
    /// List a system's invariants, each with a proof
    Report(report::Report),
    /// Search for integrals and densities, and prove the results
    Search(search::Search),
    /// Follow a motion: its final state, and the drift of integrals
    Orbit(orbit::Orbit),
    /// Draw the Poincaré section of a rolling body in the Andoyer-like variables
    Section(section::Section),
    /// Measure the largest Lyapunov exponent and the mean divergence along motions
    Exponents(exponents::Exponents),
    /// Draw a plane of motions, such as two parameters, each point coloured by its class
    Chart(chart::Chart),
    /// Find fixed and periodic points of a section, with their multipliers
    Periodic(periodic::Periodic),
    /// Sweep numerically hard cases: digits lost, and verdicts that must stay right
    Stress(stress::Stress),
    /// Compare methods of differentiation: run time against error
    Bench(bench::Bench),
}

impl Command {
    pub fn run(&self) -> Result<Answer, String> {
        match self {
            Self::Report(options) => report::run(options),
            Self::Search(options) => search::run(options),
            Self::Orbit(options) => orbit::run(options),
            Self::Section(options) => section::run(options),
            Self::Exponents(options) => exponents::run(options),
            Self::Chart(options) => chart::run(options),
            Self::Periodic(options) => periodic::run(options),
            Self::Stress(options) => stress::run(options),
            Self::Bench(options) => bench::run(options),
        }
    }
}

/// Writes a file requested by an option.
fn write(path: &Path, option: &str, bytes: impl AsRef<[u8]>) -> Result<(), String> {
    std::fs::write(path, bytes).map_err(|error| {
        format!(
            "error: cannot write {}: {error}\nhelp: give {option} a file in a folder that exists",
            path.display()
        )
    })
}
