//! The command `liouville measure growth`.

use std::process::Command;
use std::time::Duration;

use crate::report::growth;
use clap::{Args, ValueEnum};
use liouville_lab::growth::{
    CaseFamily, FAMILIES, FamilyGrowth as Measured, SizePoint, measure, measure_one,
};

use super::{CommandOutput, Progress, pool};

#[derive(Debug, Args)]
pub struct GrowthArgs {
    /// Families of cases; all by default
    #[arg(value_name = "FAMILY", value_parser = families())]
    pub families: Vec<String>,
    /// Seconds for each family
    #[arg(long, default_value_t = 5.0, value_parser = seconds)]
    pub within: f64,
    /// Stop when a size takes more than N megabytes of memory
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub megabytes: Option<u64>,
    /// Measure this size alone, in this process
    #[arg(long, requires = "families", value_parser = clap::value_parser!(u64).range(1..))]
    pub size: Option<u64>,
    /// Number of threads; all cores by default
    #[arg(long)]
    pub threads: Option<usize>,
    /// Format of the output
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

/// Format of the measurements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Tables for a terminal
    Text,
    /// JSON, one document
    Json,
    /// One line for each size, with a header
    Csv,
}

/// Measures one size in a process of its own, whose memory nothing else has used.
fn apart(family: &CaseFamily, size: u64, options: &GrowthArgs) -> Result<SizePoint, String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let mut command = Command::new(program);
    command.args(["measure", "growth", family.name, "--format", "json"]);
    command.args(["--size", &size.to_string()]);
    if let Some(threads) = options.threads {
        command.args(["--threads", &threads.to_string()]);
    }
    if let Some(megabytes) = options.megabytes {
        command.args(["--megabytes", &megabytes.to_string()]);
    }
    let output = command.output().map_err(|error| error.to_string())?;
    let told: Vec<PriorMember> = serde_json::from_slice(&output.stdout)
        .map_err(|_| String::from_utf8_lossy(&output.stderr).trim().to_string())?;
    let one = told.into_iter().next().ok_or("nothing was measured")?;
    match (one.points.first(), one.problem) {
        (Some(point), _) => Ok(*point),
        (None, Some(problem)) => {
            let reason = problem.split_once(": ").map_or(problem.as_str(), |(_, reason)| reason);
            Err(reason.to_string())
        }
        (None, None) => Err("nothing was measured".to_string()),
    }
}

/// Part of the JSON that is read back.
#[derive(serde::Deserialize)]
struct PriorMember {
    points: Vec<SizePoint>,
    problem: Option<String>,
}

/// Reads a positive number of seconds.
fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds <= 1e6 => Ok(seconds),
        _ => Err("write a number of seconds from above 0 to 1000000".to_string()),
    }
}

fn families() -> clap::builder::PossibleValuesParser {
    FAMILIES.map(|family| family.name).into()
}

pub fn run(options: &GrowthArgs) -> Result<CommandOutput, String> {
    let pool = pool(options.threads.unwrap_or(0))?;
    let is_meant = |family: &&CaseFamily| {
        options.families.is_empty() || options.families.iter().any(|name| name == family.name)
    };
    let meant = FAMILIES.iter().filter(is_meant);
    let bar = Progress::of(meant.clone().count() as u64, "families");
    let told =
        |family: &CaseFamily, size: u64| bar.tell(&format!("{} of size {size}", family.name));
    let measured: Vec<Measured> = match options.size {
        Some(size) => meant.map(|family| pool.install(|| measure_one(family, size))).collect(),
        None => {
            let within = Duration::from_secs_f64(options.within);
            let at_size = |family: &CaseFamily, size: u64| {
                told(family, size);
                apart(family, size, options)
            };
            let each = |family| {
                let growth = measure(family, within, at_size);
                bar.add(1.0);
                growth
            };
            meant.map(each).collect()
        }
    };
    bar.finish();
    let text = match options.format {
        Format::Text => growth::text(&measured),
        Format::Json => growth::json(&measured).map_err(|error| format!("error: {error}"))? + "\n",
        Format::Csv => growth::csv(&measured),
    };
    let has_problem = measured.iter().any(|growth| growth.problem.is_some());
    Ok(CommandOutput { text, code: u8::from(has_problem) })
}
