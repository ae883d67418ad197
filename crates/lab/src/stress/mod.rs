//! Numerically hard cases: degenerate bodies, extreme ratios, states at the edge of charts, and
//! claims that are wrong by almost nothing.
//!
//! Each [`Scenario`] sweeps one quantity x over powers of ten. At each x two things are measured:
//! the digits that f64 loses against a reference of 256 bits at the same states, and whether the
//! verdicts on all claims are still right. Degenerate is not false, and nearly true is not true.

mod precision;
mod scenarios;

pub use precision::{Loss, digits_lost};
pub use scenarios::{SCENARIOS, Scenario, SweptPart};

use liouville::case::{Case, CaseError, Expect};
use liouville::verdict::{JudgeError, Options, Verdict, judge};

/// Counts of verdicts on stressed cases, against the known answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Tally {
    /// Number of claims judged.
    pub judged: usize,
    /// Number of wrong verdicts: always 0, if the program is right.
    pub wrong: usize,
    /// Number of claims proved or refuted.
    pub decided: usize,
}

impl Tally {
    /// Adds two tallies.
    pub fn and(self, other: Self) -> Self {
        Self {
            judged: self.judged + other.judged,
            wrong: self.wrong + other.wrong,
            decided: self.decided + other.decided,
        }
    }
}

/// Reason why a stressed case could not be judged.
#[derive(Debug, thiserror::Error)]
pub enum StressError {
    /// The parameters are rejected.
    #[error("{0}")]
    Case(Box<CaseError>),
    /// The states cannot be computed.
    #[error(transparent)]
    Judge(#[from] JudgeError),
}

/// Judges all claims of a scenario at x = 10^exponent, with the random numbers of `seed`.
pub fn verdicts(scenario: &Scenario, exponent: i32, seed: u64) -> Result<Tally, StressError> {
    let case = scenario.case(exponent, seed)?;
    let report = judge(&case, &Options { seed, states: 64, ..Options::default() })?;
    let mut tally = Tally::default();
    for report in &report.claims {
        let truth = match report.expect {
            Expect::Holds => true,
            Expect::Fails => false,
            Expect::Open => continue,
        };
        let found = match report.verdict {
            Verdict::Proved | Verdict::Confirmed => Some(true),
            Verdict::Refuted => Some(false),
            Verdict::Undecided => None,
        };
        tally.judged += 1;
        tally.wrong += usize::from(found.is_some_and(|found| found != truth));
        let decided = matches!(report.verdict, Verdict::Proved | Verdict::Refuted);
        tally.decided += usize::from(decided);
    }
    Ok(tally)
}

/// Reads a case with the given settings.
fn read(text: &str, settings: &[liouville::case::Setting]) -> Result<Case, StressError> {
    Case::parse(text, settings).map_err(|error| StressError::Case(Box::new(error)))
}
