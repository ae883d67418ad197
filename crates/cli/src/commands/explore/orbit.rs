//! The command `liouville motion orbit`.

use clap::{Args, ValueEnum};
use liouville::number::pair::Pair;
use liouville::number::rational::Rational;
use liouville::verdict;
use liouville_cli::report::orbit;
use liouville_flow::{FlowError, Precision, Start};

use super::Answer;
use super::eval::wrong_state;
use super::motion::Subject;

#[derive(Debug, Args)]
pub struct Orbit {
    #[command(flatten)]
    pub subject: Subject,
    /// Time to follow the motion; negative: backwards
    #[arg(long, default_value = "100", allow_hyphen_values = true)]
    pub time: Rational,
    /// Start by exact numbers: --state 'ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]', moved to the level set if
    /// it is off it; drawn by default
    #[arg(long, value_name = "STATE")]
    pub state: Option<String>,
    /// Arithmetic: 16 or 32 digits
    #[arg(long, value_enum, default_value_t = Digits::Float)]
    pub precision: Digits,
    /// Number of the state that is drawn
    #[arg(long, default_value_t = 0)]
    pub index: u64,
}

/// Arithmetic of a motion.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Digits {
    /// f64 with compensated sums
    Float,
    /// About 32 digits, fifty times slower
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
    let subject = &options.subject;
    let case = subject.open()?;
    let state = match &options.state {
        None => None,
        Some(text) => Some(verdict::read_state(&case, text).map_err(|error| wrong_state(&error))?),
    };
    let told = |error: FlowError| subject.told(&error);
    let start = Start::new(&case, state.as_deref(), subject.seed, options.index).map_err(told)?;
    let precision = options.precision.precision();
    let time = Pair::from_rational(&options.time);
    let found = liouville_flow::orbit(&case, start, time, precision).map_err(told)?;
    let text = match subject.json {
        true => {
            let json = orbit::json(&case, &found, precision);
            json.map_err(|error| format!("error: {error}"))? + "\n"
        }
        false => orbit::text(&case, &found, precision),
    };
    Ok(Answer { text, code: 0 })
}
