//! Reports: verdicts as a table, as JSON, as the paper's tables; problems with their place.

#[cfg(feature = "explore")]
pub mod bench;
#[cfg(feature = "explore")]
pub mod chart;
pub mod diagnostic;
#[cfg(feature = "explore")]
pub mod diagram;
#[cfg(feature = "explore")]
pub mod exponents;
pub mod json;
#[cfg(feature = "explore")]
pub mod orbit;
#[cfg(feature = "explore")]
pub mod picture;
pub mod point;
#[cfg(feature = "explore")]
pub mod search;
#[cfg(feature = "explore")]
pub mod section;
#[cfg(feature = "explore")]
pub mod stress;
#[cfg(feature = "explore")]
pub mod survey;
pub mod table;
pub mod terminal;
mod typeset;

use std::time::Duration;

use serde::Serialize;

use crate::verdict::{CaseReport, ClaimReport, MutationReport, Verdict};

/// One file of a run.
#[derive(Debug)]
pub struct Outcome {
    /// The path as it was given or found.
    pub path: String,
    /// The case's title, source, system and column; empty where it could not be read.
    pub heading: Heading,
    /// The verdicts, or why there are none.
    pub result: Result<CaseReport, Vec<Failure>>,
}

/// Why a file could not be judged.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Failure {
    /// What is wrong.
    pub message: String,
    /// What would be right.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub help: Option<String>,
    /// The line it concerns, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// The column in characters, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<usize>,
    /// The same with an excerpt of the file, for a terminal.
    #[serde(skip)]
    pub rendered: String,
}

/// What a case says about itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Heading {
    /// What the case is about.
    pub title: String,
    /// Where it comes from.
    pub source: String,
    /// The kind of system.
    pub system: String,
    /// The table and column it belongs to.
    pub column: Option<crate::case::Column>,
    /// The author's notes.
    pub notes: Vec<String>,
}

/// All files of a run.
#[derive(Debug)]
pub struct RunReport {
    /// The seed of all states.
    pub seed: u64,
    /// One outcome a file, in the order of the paths.
    pub outcomes: Vec<Outcome>,
    /// How long it took.
    pub elapsed: Duration,
}

/// Counts over a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    /// Cases that were judged.
    pub cases: usize,
    /// Their claims.
    pub claims: usize,
    /// Claims proved.
    pub proved: usize,
    /// Claims confirmed.
    pub confirmed: usize,
    /// Claims refuted.
    pub refuted: usize,
    /// Claims undecided.
    pub undecided: usize,
    /// Verdicts that contradict what the file expects.
    pub disagreements: usize,
    /// Files that could not be judged.
    pub errors: usize,
    /// Claims about motion that were left alone.
    #[serde(skip_serializing_if = "is_zero")]
    pub motions_left: usize,
    /// Claims of absence that were left alone.
    #[serde(skip_serializing_if = "is_zero")]
    pub absences_left: usize,
    /// What became of mutants, if they were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mutants: Option<MutantCounts>,
    /// How long the run took.
    pub seconds: f64,
}

/// Counts of mutants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct MutantCounts {
    /// Refuted.
    pub killed: usize,
    /// Neither refuted nor proved.
    pub survived: usize,
    /// Proved, and nothing new.
    pub equivalent: usize,
    /// Proved, and independent of what is known.
    pub discovered: usize,
}

/// Is a count not worth telling?
fn is_zero(count: &usize) -> bool {
    *count == 0
}

impl RunReport {
    /// All claims of all cases that were judged.
    pub fn claims(&self) -> impl Iterator<Item = (&Outcome, &ClaimReport)> {
        self.outcomes.iter().flat_map(|outcome| {
            let claims = outcome.result.iter().flat_map(|report| &report.claims);
            claims.map(move |claim| (outcome, claim))
        })
    }

    /// The mutants of all cases, where they were asked for.
    pub fn mutants(&self) -> impl Iterator<Item = (&Outcome, &MutationReport)> {
        self.outcomes.iter().filter_map(|outcome| {
            let report = outcome.result.as_ref().ok()?;
            Some((outcome, report.mutants.as_ref()?))
        })
    }

    /// The counts.
    pub fn summary(&self) -> Summary {
        let mut summary = Summary { seconds: self.elapsed.as_secs_f64(), ..Summary::default() };
        for outcome in &self.outcomes {
            match outcome.result {
                Ok(ref report) => {
                    summary.cases += 1;
                    summary.motions_left += report.motions_left;
                    summary.absences_left += report.absences_left;
                }
                Err(_) => summary.errors += 1,
            }
        }
        for mutants in self.mutants().map(|(_, mutants)| mutants) {
            let counts = summary.mutants.get_or_insert_default();
            counts.killed += mutants.killed;
            counts.survived += mutants.survived.len();
            counts.equivalent += mutants.equivalent;
            counts.discovered += mutants.discovered.len();
        }
        for (_, claim) in self.claims() {
            summary.claims += 1;
            *match claim.verdict {
                Verdict::Proved => &mut summary.proved,
                Verdict::Confirmed => &mut summary.confirmed,
                Verdict::Refuted => &mut summary.refuted,
                Verdict::Undecided => &mut summary.undecided,
            } += 1;
            summary.disagreements += usize::from(!claim.agrees);
        }
        summary
    }

    /// 0: all as expected; 1: a verdict contradicts its expectation, or a mutant survived; 2: a file
    /// could not be judged.
    pub fn exit_code(&self) -> u8 {
        let summary = self.summary();
        let survived = summary.mutants.map_or(0, |mutants| mutants.survived);
        match (summary.errors, summary.disagreements + survived) {
            (0, 0) => 0,
            (0, _) => 1,
            _ => 2,
        }
    }
}
