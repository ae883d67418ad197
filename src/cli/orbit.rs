//! `liouville orbit`

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use liouville::flow::{self, FlowError, Precision, Start};
use liouville::number::pair::Pair;
use liouville::number::rational::Rational;
use liouville::report::orbit;
use liouville::verdict;

use super::Answer;
use super::eval::open;
use super::files::plain;

#[derive(Debug, Args)]
pub struct Orbit {
    /// A case file
    pub case: PathBuf,
    /// How long to follow the motion; negative: backwards
    #[arg(long, default_value = "100", allow_hyphen_values = true)]
    pub time: Rational,
    /// The start, by exact numbers: --state 'ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]', moved to the level
    /// set if it is beside it; drawn by default
    #[arg(long, value_name = "STATE")]
    pub state: Option<String>,
    /// The arithmetic: 16 or 32 digits
    #[arg(long, value_enum, default_value_t = Digits::Float)]
    pub precision: Digits,
    /// Give a parameter a value: --set m=5/4 --set 'I=[2,2,3]'; others are drawn
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<String>,
    /// The number of the state that is drawn
    #[arg(long, default_value_t = 0)]
    pub index: u64,
    /// Seed of the draws
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// The arithmetic of a motion.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Digits {
    /// f64 with compensated sums
    Float,
    /// Some 32 digits, fifty times slower
    DoubleDouble,
}

impl Digits {
    pub fn precision(self) -> Precision {
        match self {
            Digits::Float => Precision::Float,
            Digits::DoubleDouble => Precision::Pair,
        }
    }
}

pub fn run(options: &Orbit) -> Result<Answer, String> {
    let case = open(&options.case, &options.settings)?;
    let state = match &options.state {
        None => None,
        Some(text) => Some(
            verdict::read_state(&case, text).map_err(|error| format!("error: --state: {error}"))?,
        ),
    };
    let told = |error: FlowError| told(&options.case, &error);
    let start = Start::new(&case, state.as_deref(), options.seed, options.index).map_err(told)?;
    let precision = options.precision.precision();
    let time = Pair::from_rational(&options.time);
    let found = flow::orbit(&case, start, time, precision).map_err(told)?;
    let text = match options.json {
        true => {
            let json = orbit::json(&case, &found, precision);
            json.map_err(|error| format!("error: {error}"))? + "\n"
        }
        false => orbit::text(&case, &found, precision),
    };
    Ok(Answer { text, code: 0 })
}

/// A problem of a motion, with the file it belongs to.
pub(super) fn told(path: &std::path::Path, error: &FlowError) -> String {
    plain(path, &error.to_string(), error.help()).rendered
}
