//! The command `liouville search`.

use std::io::IsTerminal;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use crate::report::{diagnostic, search as written};
use clap::Args;
use liouville_search::{ConditionTarget, Effort, Halt};
use signal_hook::consts::SIGINT;
use signal_hook::flag;

use super::super::limits::{LimitArgs, MemoryWatch, STOPPED, parse_seconds};
use super::eval::open_signed;
use super::motion::Threads;
use super::telling;
use super::{CommandOutput, colour, pool};

/// Exit code of a program ended by Ctrl-C.
const INTERRUPTED: i32 = 130;

#[derive(Debug, Args)]
pub struct SearchArgs {
    /// Case file; claims are not needed
    pub case: PathBuf,
    /// Give a parameter a value: --set m=5/4 --set 'I=[2,2,3]'; others stay general
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<String>,
    /// Count integrals polynomial in the velocities up to this degree
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u32).range(0..=10))]
    pub degree: u32,
    /// Skip the comparison of results with the claims of the case
    #[arg(long)]
    pub blind: bool,
    /// Further term that integrals may contain; may be given several times
    #[arg(long = "term", value_name = "FORMULA")]
    pub terms: Vec<String>,
    /// Find the parameters for which a density or more integrals exist, or for which a claim holds
    /// that fails in general: --conditions, --conditions=NAME
    #[arg(long, value_name = "CLAIM", num_args = 0..=1, require_equals = true, default_missing_value = "")]
    pub conditions: Option<String>,
    /// Search for integrals that are polynomials of at most this degree in the positions, over
    /// denominators of the geometry, where the counts leave some: --ansatz, --ansatz=12
    #[arg(long, value_name = "DEGREE", num_args = 0..=1, require_equals = true, default_missing_value = "8",
        value_parser = clap::value_parser!(u32).range(0..=40))]
    pub ansatz: Option<u32>,
    /// Find the potentials under which the known integrals persist
    #[arg(long)]
    pub potentials: bool,
    /// Find the rotors, and the magnetic and other terms linear in the velocities, under which the
    /// known integrals persist
    #[arg(long)]
    pub gyrostats: bool,
    /// Find a Poisson bracket with polynomial entries, for each known integral as the Hamiltonian,
    /// or for a given one: --poisson, --poisson=H
    #[arg(long, value_name = "HAMILTONIAN", num_args = 0..=1, require_equals = true, default_missing_value = "")]
    pub poisson: Option<String>,
    /// Limit of memory of one count, in megabytes; an ansatz that may need more is skipped
    #[arg(long, value_name = "N", default_value_t = 500)]
    pub count_megabytes: u64,
    /// Limit of time of one count, in seconds of an average machine (measured in steps); an ansatz
    /// that may need more is skipped
    #[arg(long, visible_alias = "seconds", value_name = "SECONDS", default_value = "60",
        value_parser = parse_seconds)]
    pub count_seconds: Duration,
    /// Stop after SECONDS and report partial results (also on Ctrl-C); the exit code is then 3. Own
    /// fields are searched in higher degrees until then
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    pub within: Option<Duration>,
    /// Stop when the program takes more than N megabytes of memory, and report partial results; the exit
    /// code is then 3
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub megabytes: Option<u64>,
    #[command(flatten)]
    pub threads: Threads,
    /// Seed of primes, points and states
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

impl SearchArgs {
    /// Limits that the search itself keeps.
    pub fn limits(&self) -> LimitArgs {
        LimitArgs { within: None, megabytes: self.megabytes }
    }
}

pub fn run(options: &SearchArgs) -> Result<CommandOutput, String> {
    options.limits().check()?;
    let (case, digest) = open_signed(&options.case, &options.settings)?;
    let effort = Effort {
        degree: options.degree,
        blind: options.blind,
        terms: options.terms.iter().map(|text| text.as_str().into()).collect(),
        conditions: options.conditions.as_ref().map(|name| match name.as_str() {
            "" => ConditionTarget::Existence,
            name => ConditionTarget::Claim(name.to_string()),
        }),
        seconds: options.count_seconds.as_secs_f64(),
        ansatz: liouville_search::Ansatz {
            wanted: options.ansatz.is_some(),
            positions: options.ansatz.unwrap_or(liouville_search::Ansatz::default().positions),
            potentials: options.potentials,
            gyrostats: options.gyrostats,
            megabytes: options.count_megabytes,
        },
        poisson: options.poisson.as_ref().map(|formula| match formula.as_str() {
            "" => liouville_search::Hamiltonians::Known,
            formula => liouville_search::Hamiltonians::Given(formula.to_string()),
        }),
        halt: options.within.map_or_else(Halt::default, Halt::within),
        options: liouville::verdict::Options {
            seed: options.seed,
            ..liouville::verdict::Options::default()
        },
        ..Effort::default()
    };
    if let Some(plan) = liouville_search::plan(&case, &effort).filter(|plan| plan.seconds >= 1.0) {
        let liouville_search::CountEstimate { unknowns, seconds } = plan;
        eprintln!("up to {unknowns} unknowns: at least {seconds:.0} s");
    }
    // A second Ctrl-C exits immediately.
    let switch = effort.halt.switch();
    let _watch = MemoryWatch::start(options.megabytes, Arc::clone(&switch));
    flag::register_conditional_shutdown(SIGINT, INTERRUPTED, Arc::clone(&switch))
        .and_then(|_| flag::register(SIGINT, switch))
        .map_err(|error| format!("error: cannot listen to Ctrl-C: {error}"))?;
    let meter = effort.halt.meter().clone();
    let report = pool(options.threads.count())?
        .install(|| telling(meter, |progress| liouville_search::search(&case, &effort, progress)));
    let report = report.map_err(|error| {
        let shown = options.case.display().to_string();
        let coloured = colour(std::io::stderr().is_terminal());
        diagnostic::of_file(&shown, &error.to_string(), error.help(), coloured).rendered
    })?;
    let text = match options.json {
        true => written::json(&case.title, &report)
            .and_then(|json| digest.sign(&json))
            .map_err(|error| format!("error: {error}"))?,
        false => written::text(&case.title, &report),
    };
    let code = if report.unreached.is_empty() { 0 } else { STOPPED };
    Ok(CommandOutput { text: text + "\n", code })
}
