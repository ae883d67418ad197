//! Commands beyond the claims of a case: its further invariants, its motions, and benchmarks.

mod andoyer;
mod basins;
mod bench;
pub(super) mod branch;
pub(super) mod chart;
mod diagram;
pub(super) mod exponents;
mod fixing;
mod growth;
pub(super) mod ink;
mod iterates;
mod map_exponents;
mod map_points;
pub(super) mod motion;
mod orbit;
pub(super) mod output;
mod periodic;
pub(super) mod report;
mod rotation;
mod search;
pub(super) mod section;
pub(super) mod share;
mod site;
mod starts;
mod stress;
mod surface;
pub(super) mod sweep;
mod symmetric;
mod track;
mod watching;

use clap::Subcommand;

use super::out::{self, write};
use super::progress::{Progress, telling};
use super::threads::pool;
use super::{
    CommandOutput, LimitArgs, SamplingArgs, bodies, check, colour, eval, files, source, width,
};
use motion::MotionArgs;
use share::Share;

#[derive(Debug, Subcommand)]
pub enum ExploreCommand {
    /// Search for integrals and densities, and prove the results
    #[command(after_help = "Example:\n  liouville search plane/balanced-ball --blind")]
    Search(search::SearchArgs),
    /// List a system's invariants, each with a proof
    #[command(after_help = "\
Examples:
  liouville report plane/unbalanced-ball --out ball.html
  liouville report plane/unbalanced-ball --settings bodies.csv --out classes.csv")]
    Report(report::ReportArgs),
    /// Write a web page for each case of a folder, and an index by class and by folder
    #[command(after_help = "Example:\n  liouville site cases/plane --out public --within 60")]
    Site(site::Site),
    /// Find the largest residual of each claim over many states, in floating point
    #[command(after_help = "\
Examples:
  liouville sweep plane/balanced-ball --states 1e8
  liouville sweep plane/balanced-ball --states 1e12 --part 3/40 --out parts/")]
    Sweep(sweep::Sweep),
    /// Integrate motions: orbits, sections, exponents, charts, periodic orbits
    Motion {
        #[command(subcommand)]
        command: Box<MotionCommand>,
    },
    /// Measure the program: run time against error, numerical stability, growth
    Measure {
        #[command(subcommand)]
        command: MeasureCommand,
    },
    #[command(flatten)]
    Former(FormerCommand),
}

/// Commands about motions.
#[derive(Debug, Subcommand)]
pub enum MotionCommand {
    /// Integrate motions, or iterate a map: drift of integrals, samples as data or a picture
    #[command(after_help = "\
Examples:
  liouville motion orbit figures/fig-8 --time 1000
  liouville motion orbit figures/fig-8 --start 3.4,0.3 --time 20 --every 0.01 --columns 't, γ, F2' --out orbit.csv
  liouville motion orbit spin/rattleback-reversal --state 'ω=[1/50,1/50,1] γ=[0,0,1]' --time 20 --plot 't, (ω,γ)' --out spin.png
  liouville motion orbit spin/rattleback-reversal --time 20 --track --out track.pdf
  liouville motion orbit classical/maps/standard --set s=2 --iterates 2000 --orbits 30 --columns 'atan2(sin(x), cos(x)), p' --out standard.png")]
    Orbit(orbit::OrbitArgs),
    /// Draw a Poincaré section: g = g₀ of a rolling body, or any surface of any system
    #[command(after_help = "\
Examples:
  liouville motion section figures/fig-8 --out section.pdf --width 85 --point-size 0.15
  liouville motion section figures/fig-8 --both-ways --opacity 0.4 --out attractor-and-repeller.png
  liouville motion section figures/fig-A4-a figures/fig-A4-b figures/fig-A4-c --panels 3x1 --out panels.pdf
  liouville motion section plane/unbalanced-ball --section 'γ3 = 0' --axes 'γ1, ω3' --out points.csv")]
    Section(section::SectionArgs),
    /// Measure Lyapunov exponents and the mean divergence along motions
    #[command(after_help = "\
Examples:
  liouville motion exponents figures/fig-10
  liouville motion exponents classical/flows/nose-hoover --spectrum
  liouville motion exponents figures/fig-10 --starts starts.csv --part 3/40 --out parts/")]
    Exponents(exponents::ExponentsArgs),
    /// Draw a chart of chaos: motions over two parameters or starts, coloured by class
    #[command(after_help = "\
Examples:
  liouville motion chart figures/fig-8 --x c1=0..2 --y c2=0..2 --colour exponent --out chart.pdf
  liouville motion chart figures/fig-8 --x c1=0..2 --y c2=0..2 --part 3/40 --out parts/")]
    Chart(chart::ChartArgs),
    /// Find closed orbits, or periodic points of a map, with multipliers and error estimates
    #[command(after_help = "\
Examples:
  liouville motion periodic figures/fig-5 --start pi/2,0
  liouville motion periodic classical/flows/van-der-pol-cycle --start 2,0 --section 'p = 0'
  liouville motion periodic figures/fig-A2 --symmetric L=0,l=0,l=pi/2 --period 4
  liouville motion periodic classical/maps/henon --set s=0.63 --set b=0.3 --period 4 --box x=-2..2 --box y=-2..2")]
    Periodic(periodic::Periodic),
    /// Follow a closed orbit while a parameter or the energy varies, through folds, and find its
    /// bifurcations
    #[command(after_help = "\
Examples:
  liouville motion continue figures/fig-5 --start pi/2,0.366 --parameter energy --from 80 --to 200 --out branch.pdf
  liouville motion continue classical/flows/van-der-pol-cycle --start 2,0 --section 'p = 0' --parameter μ --from 0.1 --to 3")]
    Continue(branch::ContinueArgs),
    /// Draw a bifurcation diagram: crossings of a section over a parameter or the energy
    #[command(after_help = "\
Examples:
  liouville motion diagram figures/fig-8 --over a_g=5..15 --out diagram.png
  liouville motion diagram classical/flows/duffing-forced --set δ=1/4 --over f=0.2..0.4 --section 'sin(t) = 0' --direction up --axes x --start 1,0,0 --out diagram.pdf")]
    Diagram(diagram::DiagramArgs),
    /// Measure rotation numbers along a line of starts on a section, and mark resonances
    #[command(after_help = "\
Examples:
  liouville motion rotation figures/fig-A2 --from 3.2,0 --to 4.4,0 --centre pi,0 --out rotation.pdf
  liouville motion rotation classical/planar/henon-heiles-hamiltonian --set ε=1/2 --energy 1/10 --section 'x = 0' --axes 'y, py' --from 0,0 --to 0.4,0 --centre 0.2,0")]
    Rotation(rotation::RotationArgs),
    /// Draw basins of attraction: where the motions from a plane of starts end
    #[command(after_help = "\
Examples:
  liouville motion basins classical/flows/duffing-forced --set δ=1/5 --set f=1/10 --x x=-2..2 --y p=-2..2 --start 0,0,0 --out basins.png
  liouville motion basins classical/flows/lorenz-equilibria --set σ=10 --set b=8/3 --set r=20 --x x=-20..20 --y y=-20..20 --start 0,0,20")]
    Basins(basins::BasinArgs),
}

/// Commands about the program itself.
#[derive(Debug, Subcommand)]
pub enum MeasureCommand {
    /// Compare methods of differentiation: run time against error
    #[command(after_help = "Example:\n  liouville measure bench --svg work-precision.svg")]
    Bench(bench::BenchArgs),
    /// Sweep numerically hard cases: digits lost, and verdicts that must stay right
    #[command(after_help = "Example:\n  liouville measure stress --svg stress.svg")]
    Stress(stress::Stress),
    /// Measure how time and memory grow with the size of a case
    #[command(after_help = "Example:\n  liouville measure growth chain toda --within 10")]
    Growth(growth::GrowthArgs),
}

/// The same commands under their names of version 0.1.
#[derive(Debug, Subcommand)]
pub enum FormerCommand {
    #[command(flatten)]
    Motion(Box<MotionCommand>),
    #[command(flatten)]
    Measure(MeasureCommand),
}

impl ExploreCommand {
    pub fn run(&self) -> Result<CommandOutput, String> {
        match self {
            Self::Search(options) => search::run(options),
            Self::Report(options) => report::run(options),
            Self::Site(options) => site::run(options),
            Self::Sweep(options) => sweep::run(options),
            Self::Motion { command } => command.run(),
            Self::Former(FormerCommand::Motion(command)) => command.run(),
            Self::Measure { command } | Self::Former(FormerCommand::Measure(command)) => {
                command.run()
            }
        }
    }
}

impl ExploreCommand {
    /// Part of a job that may be done in parts.
    pub fn share(&mut self) -> Option<&mut Share> {
        match self {
            Self::Report(options) if options.bodies.settings.is_some() => Some(&mut options.share),
            Self::Sweep(options) => Some(&mut options.share),
            Self::Motion { command } | Self::Former(FormerCommand::Motion(command)) => {
                match command.as_mut() {
                    MotionCommand::Section(options) => Some(&mut options.share),
                    MotionCommand::Exponents(options) => Some(&mut options.share),
                    MotionCommand::Chart(options) => Some(&mut options.share),
                    MotionCommand::Orbit(_)
                    | MotionCommand::Periodic(_)
                    | MotionCommand::Continue(_)
                    | MotionCommand::Diagram(_)
                    | MotionCommand::Rotation(_)
                    | MotionCommand::Basins(_) => None,
                }
            }
            _ => None,
        }
    }

    /// Limits that a command was given; a search plans its memory by itself.
    pub fn all_limits(&self) -> LimitArgs {
        match self {
            Self::Site(options) => options.limits,
            Self::Search(options) => options.limits(),
            Self::Motion { command } => command.subject().limits,
            Self::Former(FormerCommand::Motion(command)) => command.subject().limits,
            _ => self.limits(),
        }
    }

    /// Limits of a command that has nothing to show before its end; a search and a site have their own.
    pub fn limits(&self) -> LimitArgs {
        match self {
            Self::Report(options) => options.limits,
            Self::Sweep(options) => options.subject.limits,
            Self::Motion { command } => command.limits(),
            Self::Former(FormerCommand::Motion(command)) => command.limits(),
            Self::Measure { command } | Self::Former(FormerCommand::Measure(command)) => {
                command.limits()
            }
            Self::Search(_) | Self::Site(_) => LimitArgs::default(),
        }
    }
}

impl MotionCommand {
    fn subject(&self) -> &MotionArgs {
        match self {
            Self::Orbit(options) => &options.subject,
            Self::Section(options) => &options.subject,
            Self::Exponents(options) => &options.subject,
            Self::Chart(options) => &options.subject,
            Self::Periodic(options) => &options.search.subject,
            Self::Continue(options) => &options.search.subject,
            Self::Diagram(options) => &options.subject,
            Self::Rotation(options) => &options.subject,
            Self::Basins(options) => &options.subject,
        }
    }

    fn limits(&self) -> LimitArgs {
        match self {
            // it reports what was reached
            Self::Continue(_) | Self::Orbit(_) | Self::Basins(_) => LimitArgs::default(),
            Self::Section(options) if options.share.part.is_none() => LimitArgs::default(),
            Self::Exponents(options) if options.is_watched() => LimitArgs::default(),
            _ => self.subject().limits,
        }
    }

    /// Case whose free parameters are drawn once for all motions; `None` where some vary.
    fn with_drawn_parameters(&self) -> Option<&MotionArgs> {
        match self {
            Self::Section(options) => options.others.is_empty().then_some(&options.subject),
            Self::Orbit(_)
            | Self::Exponents(_)
            | Self::Periodic(_)
            | Self::Rotation(_)
            | Self::Basins(_) => Some(self.subject()),
            Self::Chart(_) | Self::Continue(_) | Self::Diagram(_) => None,
        }
    }

    /// Carries the command out.
    pub fn run(&self) -> Result<CommandOutput, String> {
        let mut output = match self {
            Self::Orbit(options) => orbit::run(options),
            Self::Section(options) => section::run(options),
            Self::Exponents(options) => exponents::run(options),
            Self::Chart(options) => chart::run(options),
            Self::Periodic(options) => periodic::run(options),
            Self::Continue(options) => branch::run(options),
            Self::Diagram(options) => diagram::run(options),
            Self::Rotation(options) => rotation::run(options),
            Self::Basins(options) => basins::run(options),
        }?;
        if let Some(subject) = self.with_drawn_parameters().filter(|_| !output.text.is_empty()) {
            output.text.push_str(&subject.drawn_parameters());
        }
        Ok(output)
    }
}

impl MeasureCommand {
    fn limits(&self) -> LimitArgs {
        match self {
            Self::Bench(options) => options.limits,
            Self::Stress(options) => options.limits,
            // its seconds are those of each family
            Self::Growth(options) => LimitArgs { within: None, megabytes: options.megabytes },
        }
    }

    fn run(&self) -> Result<CommandOutput, String> {
        match self {
            Self::Bench(options) => bench::run(options),
            Self::Stress(options) => stress::run(options),
            Self::Growth(options) => growth::run(options),
        }
    }
}
