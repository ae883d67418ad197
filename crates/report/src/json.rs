//! Report of `check --json`: a stable schema for machines.

use serde::Serialize;

use super::{CaseDigest, FileFailure, RunReport, Summary, VERSION};
use liouville::verdict::{ClaimReport, MutationReport};

#[derive(Serialize)]
struct CheckJson<'a> {
    version: &'static str,
    seed: u64,
    cases: Vec<CaseEntry<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<ErrorEntry<'a>>,
    summary: Summary,
}

#[derive(Serialize)]
struct CaseEntry<'a> {
    path: &'a str,
    title: &'a str,
    source: &'a str,
    system: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    digest: Option<&'a CaseDigest>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    warnings: &'a [String],
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    remarks: &'a [String],
    claims: &'a [ClaimReport],
    #[serde(skip_serializing_if = "Option::is_none")]
    mutants: Option<&'a MutationReport>,
}

#[derive(Serialize)]
struct ErrorEntry<'a> {
    path: &'a str,
    #[serde(flatten)]
    failure: &'a FileFailure,
}

/// Renders the run as pretty-printed JSON.
pub fn render(run: &RunReport) -> Result<String, serde_json::Error> {
    let mut root = CheckJson {
        version: VERSION,
        seed: run.seed,
        cases: Vec::new(),
        errors: Vec::new(),
        summary: run.summary(),
    };
    for outcome in &run.outcomes {
        match &outcome.result {
            Ok(report) => root.cases.push(CaseEntry {
                path: &outcome.path,
                title: &outcome.heading.title,
                source: &outcome.heading.source,
                system: &outcome.heading.system,
                digest: outcome.heading.digest.as_ref(),
                warnings: &report.warnings,
                remarks: &report.remarks,
                claims: &report.claims,
                mutants: report.mutants.as_ref(),
            }),
            Err(failures) => root
                .errors
                .extend(failures.iter().map(|failure| ErrorEntry { path: &outcome.path, failure })),
        }
    }
    serde_json::to_string_pretty(&root)
}
