//! Commands beyond the claims of a case: its further invariants, its motions, and benchmarks.

mod bench;
mod chart;
mod exponents;
mod growth;
mod motion;
mod orbit;
mod periodic;
mod progress;
mod report;
mod search;
mod section;
mod stress;

use clap::Subcommand;

use super::out::{self, write};
use super::{Answer, Limits, Sampling, colour, eval, files, source, width};

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Search for integrals and densities, and prove the results
    #[command(after_help = "Example:\n  liouville search plane/balanced-ball --blind")]
    Search(search::Search),
    /// List a system's invariants, each with a proof
    #[command(after_help = "Example:\n  liouville report plane/unbalanced-ball --out ball.html")]
    Report(report::Report),
    /// Follow motions: orbits, sections, exponents, charts, periodic points
    Motion {
        #[command(subcommand)]
        command: Motion,
    },
    /// Measure the program: run time against error, numerical stability, growth
    Measure {
        #[command(subcommand)]
        command: Measure,
    },
    #[command(flatten)]
    Former(Former),
}

/// Commands about motions.
#[derive(Debug, Subcommand)]
pub enum Motion {
    /// Follow a motion: its final state, and the drift of integrals
    #[command(after_help = "Example:\n  liouville motion orbit figures/fig-8 --time 1000")]
    Orbit(orbit::Orbit),
    /// Draw the Poincaré section of a rolling body in the Andoyer-like variables
    #[command(after_help = "Example:\n  liouville motion section figures/fig-8 --out section.png")]
    Section(section::Section),
    /// Measure the largest Lyapunov exponent and the mean divergence along motions
    #[command(after_help = "Example:\n  liouville motion exponents figures/fig-10")]
    Exponents(exponents::Exponents),
    /// Draw a plane of motions, such as two parameters, each point coloured by its class
    #[command(after_help = "\
Example:
  liouville motion chart figures/fig-8 --x c1=0..2 --y c2=0..2 --out chart.png")]
    Chart(chart::Chart),
    /// Find fixed and periodic points of a section, with their multipliers
    #[command(after_help = "Example:\n  liouville motion periodic figures/fig-5")]
    Periodic(periodic::Periodic),
}

/// Commands about the program itself.
#[derive(Debug, Subcommand)]
pub enum Measure {
    /// Compare methods of differentiation: run time against error
    #[command(after_help = "Example:\n  liouville measure bench --svg work-precision.svg")]
    Bench(bench::Bench),
    /// Sweep numerically hard cases: digits lost, and verdicts that must stay right
    #[command(after_help = "Example:\n  liouville measure stress --svg stress.svg")]
    Stress(stress::Stress),
    /// Judge families of cases of growing size: time, memory, and the exponents of growth
    #[command(after_help = "Example:\n  liouville measure growth chain toda --within 10")]
    Growth(growth::Growth),
}

/// The same commands under their names of version 0.1.
#[derive(Debug, Subcommand)]
pub enum Former {
    #[command(flatten)]
    Motion(Box<Motion>),
    #[command(flatten)]
    Measure(Measure),
}

impl Command {
    pub fn run(&self) -> Result<Answer, String> {
        match self {
            Self::Search(options) => search::run(options),
            Self::Report(options) => report::run(options),
            Self::Motion { command } => command.run(),
            Self::Former(Former::Motion(command)) => command.run(),
            Self::Measure { command } | Self::Former(Former::Measure(command)) => command.run(),
        }
    }
}

impl Command {
    /// Limits of a command that has nothing to show before its end; a search has its own.
    pub fn limits(&self) -> Limits {
        match self {
            Self::Report(options) => options.limits,
            Self::Motion { command } => command.limits(),
            Self::Former(Former::Motion(command)) => command.limits(),
            Self::Search(_) | Self::Measure { .. } | Self::Former(Former::Measure(_)) => {
                Limits::default()
            }
        }
    }
}

impl Motion {
    fn limits(&self) -> Limits {
        match self {
            Self::Orbit(options) => options.subject.limits,
            Self::Section(options) => options.subject.limits,
            Self::Exponents(options) => options.subject.limits,
            Self::Chart(options) => options.subject.limits,
            Self::Periodic(options) => options.subject.limits,
        }
    }

    fn run(&self) -> Result<Answer, String> {
        match self {
            Self::Orbit(options) => orbit::run(options),
            Self::Section(options) => section::run(options),
            Self::Exponents(options) => exponents::run(options),
            Self::Chart(options) => chart::run(options),
            Self::Periodic(options) => periodic::run(options),
        }
    }
}

impl Measure {
    fn run(&self) -> Result<Answer, String> {
        match self {
            Self::Bench(options) => bench::run(options),
            Self::Stress(options) => stress::run(options),
            Self::Growth(options) => growth::run(options),
        }
    }
}
