//! Writers of reports for people and for machines: verdicts as JSON and CSV, mistakes at their
//! place, the invariants of a body as LaTeX, Markdown and HTML.

mod annotations;
pub mod diagnostic;
mod digest;
pub mod evidence;
pub mod json;
pub mod names;
pub mod records;
pub mod search;
pub mod site;
pub mod survey;
pub mod typeset;
mod verdicts;

pub use annotations::annotations;
pub use digest::{CaseDigest, VERSION, sha256};
pub use verdicts::{VerdictTable, inline};

use std::collections::BTreeMap;
use std::time::Duration;

use serde::Serialize;

use liouville::case::{Case, Column, PlacedClaim};
use liouville::formula::Layout;
use liouville::verdict::{CaseReport, ClaimReport, EquationsSize, MutationReport, Verdict};

/// Writes a number with its noun: 1 case, 2 cases.
pub fn counted(count: usize, noun: &str) -> String {
    match count {
        1 => format!("1 {noun}"),
        _ => format!("{count} {noun}s"),
    }
}

/// Outcome for one file of a run.
#[derive(Debug)]
pub struct FileOutcome {
    /// Path as given or found.
    pub path: String,
    /// Title, source, system and column of the case; empty where it could not be read.
    pub heading: Heading,
    /// Verdicts, or the reasons why there are none.
    pub result: Result<CaseReport, Vec<FileFailure>>,
    /// Names of the claims that were not reached when the run was stopped.
    pub unreached: Vec<String>,
    /// Whether the file itself was reached; otherwise the result is the reason why not.
    pub is_reached: bool,
}

/// Reason why a file could not be judged.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FileFailure {
    /// Message that describes the error.
    pub message: String,
    /// Suggested correction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub help: Option<String>,
    /// Line of the error, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// Column of the error in characters, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<usize>,
    /// Message with an excerpt of the file, for a terminal.
    #[serde(skip)]
    pub rendered: String,
}

/// Description of a case by its author.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Heading {
    /// Title of the case.
    pub title: String,
    /// Publication that the case is taken from.
    pub source: String,
    /// Kind of the system.
    pub system: String,
    /// Table and column that the case belongs to.
    pub column: Option<Column>,
    /// Notes of the author.
    pub notes: Vec<String>,
    /// Digest of the file's text.
    pub digest: Option<CaseDigest>,
    /// Formulas of claims, of those that fill cells of a table at least, by the names of the claims.
    pub statements: BTreeMap<String, Layout>,
    /// Parts of statements that their texts leave out, with the statements of all claims.
    pub particulars: BTreeMap<String, String>,
    /// Size of the recorded equations of motion, where it was asked for.
    pub equations: Option<EquationsSize>,
}

impl Heading {
    /// Heading of a case that was read from this text.
    pub fn of(case: &Case, text: &str) -> Self {
        Self {
            title: case.title.clone(),
            source: case.source.clone(),
            system: case.system.clone(),
            column: case.column.clone(),
            notes: case.notes.clone(),
            digest: Some(CaseDigest::of(text)),
            statements: statements(case, |claim| case.column.is_some() && claim.cell.is_some()),
            particulars: BTreeMap::new(),
            equations: None,
        }
    }

    /// The same heading with the statements of all claims.
    pub fn with_all_statements(self, case: &Case) -> Self {
        let claims = case.homes().flat_map(|home| home.claims.iter().map(move |own| (home, own)));
        // What is set has them.
        let particulars = claims
            .filter(|(home, own)| own.kind.layout(&home.model).is_none())
            .filter_map(|(_, own)| Some((own.name.clone(), own.kind.particulars()?)))
            .collect();
        Self { statements: statements(case, |_| true), particulars, ..self }
    }
}

/// Sets the formulas of some claims.
fn statements(case: &Case, takes: impl Fn(&PlacedClaim) -> bool) -> BTreeMap<String, Layout> {
    let claims = case.homes().flat_map(|home| home.claims.iter().map(move |claim| (home, claim)));
    claims
        .filter(|(_, claim)| takes(claim))
        .filter_map(|(home, claim)| {
            let layout = typeset::claim::statement(&home.model, claim)?;
            Some((claim.name.clone(), layout))
        })
        .collect()
}

/// Results for all files of a run.
#[derive(Debug)]
pub struct RunReport {
    /// Seed of all states.
    pub seed: u64,
    /// Outcome of each file, in the order of the paths.
    pub outcomes: Vec<FileOutcome>,
    /// Duration of the run.
    pub elapsed: Duration,
}

/// Counts over a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    /// Number of cases judged.
    pub cases: usize,
    /// Number of claims in them.
    pub claims: usize,
    /// Number of claims proved.
    pub proved: usize,
    /// Number of claims confirmed.
    pub confirmed: usize,
    /// Number of claims refuted.
    pub refuted: usize,
    /// Number of claims undecided.
    pub undecided: usize,
    /// Number of verdicts that contradict the expectation in the file.
    pub disagreements: usize,
    /// Number of files that could not be judged.
    pub errors: usize,
    /// Number of claims that were not reached when the run was stopped.
    #[serde(skip_serializing_if = "is_zero")]
    pub unreached: usize,
    /// Number of files that were not reached when the run was stopped.
    #[serde(skip_serializing_if = "is_zero")]
    pub unreached_files: usize,
    /// Number of claims about motion that were skipped.
    #[serde(skip_serializing_if = "is_zero")]
    pub motions_left: usize,
    /// Claims of absence that were left alone.
    #[serde(skip_serializing_if = "is_zero")]
    pub absences_left: usize,
    /// Counts of mutants, if they were requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mutants: Option<MutantCounts>,
    /// Duration of the run in seconds.
    pub seconds: f64,
}

/// Counts of mutants by verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct MutantCounts {
    /// Number of mutants refuted.
    pub killed: usize,
    /// Number of mutants neither refuted nor proved.
    pub survived: usize,
    /// Number of mutants proved that are nothing new.
    pub equivalent: usize,
    /// Number of mutants proved that are independent of what is known.
    pub discovered: usize,
}

/// Whether a count is zero, and left out of the report.
fn is_zero(count: &usize) -> bool {
    *count == 0
}

impl RunReport {
    /// All claims of all cases that were judged.
    pub fn claims(&self) -> impl Iterator<Item = (&FileOutcome, &ClaimReport)> {
        self.outcomes.iter().flat_map(|outcome| {
            let claims = outcome.result.iter().flat_map(|report| &report.claims);
            claims.map(move |claim| (outcome, claim))
        })
    }

    /// Mutants of all cases, where they were requested.
    pub fn mutants(&self) -> impl Iterator<Item = (&FileOutcome, &MutationReport)> {
        self.outcomes.iter().filter_map(|outcome| {
            let report = outcome.result.as_ref().ok()?;
            Some((outcome, report.mutants.as_ref()?))
        })
    }

    /// Keeps some claims; cases without any are left out.
    pub fn retain(&mut self, keep: impl Fn(&Heading, &ClaimReport) -> bool) {
        self.outcomes.retain_mut(|outcome| match &mut outcome.result {
            Err(_) => true,
            Ok(report) => {
                let heading = &outcome.heading;
                report.claims.retain(|claim| keep(heading, claim));
                !report.claims.is_empty()
            }
        });
    }

    /// Counts over the run.
    pub fn summary(&self) -> Summary {
        let mut summary = Summary { seconds: self.elapsed.as_secs_f64(), ..Summary::default() };
        for outcome in &self.outcomes {
            match outcome.result {
                Ok(ref report) => {
                    summary.cases += 1;
                    summary.motions_left += report.motions_left;
                    summary.absences_left += report.absences_left;
                }
                Err(_) if !outcome.is_reached => summary.unreached_files += 1,
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
        for (outcome, claim) in self.claims() {
            let is_reached = !outcome.unreached.contains(&claim.name);
            summary.claims += 1;
            summary.unreached += usize::from(!is_reached);
            *match claim.verdict {
                Verdict::Proved => &mut summary.proved,
                Verdict::Confirmed => &mut summary.confirmed,
                Verdict::Refuted => &mut summary.refuted,
                Verdict::Undecided => &mut summary.undecided,
            } += 1;
            summary.disagreements += usize::from(!claim.agrees && is_reached);
        }
        summary
    }

    /// Exit code. 0: all as expected; 1: a verdict contradicts its expectation, or a mutant
    /// survived; 2: a file could not be judged; 3: the run was stopped before all was judged.
    pub fn exit_code(&self) -> u8 {
        let summary = self.summary();
        let survived = summary.mutants.map_or(0, |mutants| mutants.survived);
        match (summary.errors, summary.disagreements + survived) {
            (0, 0) if summary.unreached + summary.unreached_files > 0 => 3,
            (0, 0) => 0,
            (0, _) => 1,
            _ => 2,
        }
    }
}
