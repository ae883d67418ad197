//! The command `liouville measure growth`.

use std::time::Duration;

use clap::{Args, ValueEnum};
use liouville_cli::report::growth;
use liouville_lab::growth::{FAMILIES, Family, Growth as Measured, measure};

use super::Answer;

#[derive(Debug, Args)]
pub struct Growth {
    /// Families of cases; all by default
    #[arg(value_name = "FAMILY", value_parser = families())]
    pub families: Vec<String>,
    /// Seconds for each family
    #[arg(long, default_value_t = 5.0, value_parser = seconds)]
    pub within: f64,
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

pub fn run(options: &Growth) -> Result<Answer, String> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads.unwrap_or(0))
        .build()
        .map_err(|error| format!("error: cannot start threads: {error}"))?;
    let is_meant = |family: &&Family| {
        options.families.is_empty() || options.families.iter().any(|name| name == family.name)
    };
    let within = Duration::from_secs_f64(options.within);
    let meant = FAMILIES.iter().filter(is_meant);
    let measured: Vec<Measured> =
        meant.map(|family| pool.install(|| measure(family, within))).collect();
    let text = match options.format {
        Format::Text => growth::text(&measured),
        Format::Json => growth::json(&measured).map_err(|error| format!("error: {error}"))? + "\n",
        Format::Csv => growth::csv(&measured),
    };
    let has_problem = measured.iter().any(|growth| growth.problem.is_some());
    Ok(Answer { text, code: u8::from(has_problem) })
}
