//! The command `liouville measure stress`.

use std::path::PathBuf;
use std::time::Instant;

use crate::report::stress::{StressPoint, StressReport, SweepReport};
use clap::Args;
use liouville_lab::stress::{SCENARIOS, Scenario, StressError, Tally, digits_lost, verdicts};
use rayon::prelude::*;

use super::{CommandOutput, LimitArgs, Progress, pool};

#[derive(Debug, Args)]
pub struct Stress {
    /// Number of random bodies judged at each power of ten
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub bodies: u64,
    /// Seed of all random numbers
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Number of threads; all cores by default
    #[arg(long)]
    pub threads: Option<usize>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Draw the heat map
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    #[command(flatten)]
    pub limits: LimitArgs,
}

pub fn run(options: &Stress) -> Result<CommandOutput, String> {
    if let Some(path) = &options.svg {
        super::out::check(path, "--svg", &[])?;
    }
    let started = Instant::now();
    let pool = pool(options.threads.unwrap_or(0))?;
    let bar =
        Progress::of(SCENARIOS.iter().map(|own| units(own, options)).sum(), "states and bodies");
    let scenarios: Vec<SweepReport> =
        pool.install(|| SCENARIOS.iter().map(|scenario| sweep(scenario, options, &bar)).collect());
    bar.finish();
    let verdicts = scenarios.iter().map(|s| s.verdicts).fold(Tally::default(), Tally::and);
    let seconds = started.elapsed().as_secs_f64();
    let report = StressReport { seed: options.seed, scenarios, verdicts, seconds };
    if let Some(path) = &options.svg {
        super::write(path, "--svg", report.heat_map())?;
    }
    let text = match options.json {
        true => report.json().map_err(|error| format!("error: {error}"))? + "\n",
        false => report.text(),
    };
    let problems = report.scenarios.iter().any(|scenario| !scenario.problems.is_empty());
    Ok(CommandOutput { text, code: u8::from(verdicts.wrong > 0 || problems) })
}

/// Number of bodies that are judged at each power of ten.
fn bodies(scenario: &Scenario, options: &Stress) -> u64 {
    if scenario.changes_case() { options.bodies } else { 0 }
}

/// Number of units of a sweep: one for each power of ten, and one for each body there.
fn units(scenario: &Scenario, options: &Stress) -> u64 {
    (scenario.from..=scenario.to).count() as u64 * (1 + bodies(scenario, options))
}

/// Runs one sweep: the digits lost at each power of ten, and verdicts for the requested number of
/// bodies.
fn sweep(scenario: &Scenario, options: &Stress, bar: &Progress) -> SweepReport {
    let exponents: Vec<i32> = (scenario.from..=scenario.to).collect();
    let points: Vec<(StressPoint, Option<StressError>)> = exponents
        .par_iter()
        .map(|exponent| {
            let found = digits_lost(scenario, *exponent, options.seed);
            bar.add(1.0);
            match found {
                Ok(loss) => (StressPoint { exponent: *exponent, loss: Some(loss) }, None),
                Err(error) => (StressPoint { exponent: *exponent, loss: None }, Some(error)),
            }
        })
        .collect();
    let bodies = bodies(scenario, options);
    let cases: Vec<(i32, u64)> = (0..bodies)
        .flat_map(|body| exponents.iter().map(move |exponent| (*exponent, body)))
        .collect();
    let judged: Vec<Result<Tally, StressError>> = cases
        .par_iter()
        .map(|(exponent, body)| {
            let found = verdicts(scenario, *exponent, options.seed.wrapping_add(*body));
            bar.add(1.0);
            found
        })
        .collect();
    let (mut tally, mut problems) = (Tally::default(), Vec::new());
    let mut note = |problem: StressError| {
        let problem = problem.to_string();
        if !problems.contains(&problem) {
            problems.push(problem);
        }
    };
    let mut kept = Vec::new();
    for (point, problem) in points {
        kept.push(point);
        problem.into_iter().for_each(&mut note);
    }
    for outcome in judged {
        match outcome {
            Ok(found) => tally = tally.and(found),
            Err(problem) => note(problem),
        }
    }
    SweepReport { name: scenario.name, points: kept, verdicts: tally, problems }
}
