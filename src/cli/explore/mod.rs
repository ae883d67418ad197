//! Commands beyond judging what is claimed: what else a body has, how it moves, and what that costs.

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
    /// Tell which invariants a body has: everything known is tried, and what is found is proved
    Report(report::Report),
    /// Look for integrals and densities that nobody typed: count them, find them, prove them
    Search(search::Search),
    /// Follow one motion: the state at the end, and how far integrals drift
    Orbit(orbit::Orbit),
    /// Draw the Poincaré section of a rolling body in the Andoyer-like variables
    Section(section::Section),
    /// Measure the largest Lyapunov exponent and the mean divergence along motions
    Exponents(exponents::Exponents),
    /// Draw a plane of motions, such as two parameters, each point coloured by its class
    Chart(chart::Chart),
    /// Find fixed and periodic points of a section, with their multipliers
    Periodic(periodic::Periodic),
    /// Sweep what makes the numbers hard: digits lost, and verdicts that must stay right
    Stress(stress::Stress),
    /// Measure the ways to form derivatives: run time against error
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

/// Writes a file that the user asked for by an option.
fn write(path: &Path, option: &str, bytes: impl AsRef<[u8]>) -> Result<(), String> {
    std::fs::write(path, bytes).map_err(|error| {
        format!(
            "error: cannot write {}: {error}\nhelp: give {option} a file in a folder that exists",
            path.display()
        )
    })
}
