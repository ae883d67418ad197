//! Verdicts, searches and reports of invariants.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use liouville::verdict::{self, CaseReport, JudgeError, Options, Trust};
use liouville_cli::report::survey::{self as written, PageStyle};
use liouville_cli::report::{CaseDigest, FileOutcome, Heading, RunReport, json};
use liouville_flow::observe::observe_each;
use liouville_search::{Ansatz, ConditionTarget, Effort, Halt, Hamiltonians, survey};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::case::Case;
use super::errors;
use super::work::Work;

/// Width of reports as text.
const WIDTH: u16 = 100;

/// Judges the claims; returns what `check --json` prints.
#[pyfunction]
pub fn check(
    py: Python<'_>,
    case: &Case,
    sampling: (u64, u64, &str),
    mutants: bool,
    motion: bool,
    threads: Option<usize>,
) -> PyResult<String> {
    let (seed, states, trust) = sampling;
    let options = Options { seed, states, trust: read_trust(trust)?, mutants };
    let inner = Arc::clone(&case.inner);
    let started = Instant::now();
    let report = Work::on(threads).shared(py, move || verdicts(&inner, &options, motion))?;
    let report = report.map_err(|error| errors::of_judging(py, &case.name, &case.text, &error))?;
    let heading = Heading {
        title: case.inner.title.clone(),
        source: case.inner.source.clone(),
        system: case.inner.system.clone(),
        column: case.inner.column.clone(),
        notes: case.inner.notes.clone(),
        digest: Some(CaseDigest::of(&case.text)),
        ..Heading::default()
    };
    let path = case.name.clone();
    let outcome =
        FileOutcome { path, heading, result: Ok(report), unreached: Vec::new(), is_reached: true };
    let run = RunReport { seed, outcomes: vec![outcome], elapsed: started.elapsed() };
    json::render(&run).map_err(|error| errors::of_output(&error))
}

/// Searches for invariants; returns what `search --json` prints.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "each is an argument of the Python function")]
pub fn search(
    py: Python<'_>,
    case: &Case,
    scope: (u32, u64, bool),
    terms: Vec<String>,
    conditions: Option<String>,
    ansatz: Option<u32>,
    kinds: (bool, bool),
    poisson: Option<String>,
    limits: (Option<f64>, f64, u64),
    threads: Option<usize>,
) -> PyResult<String> {
    let (degree, seed, blind) = scope;
    let (potentials, gyrostats) = kinds;
    let (within, seconds, megabytes) = limits;
    let work = Work::on(threads);
    let within = within.map(Duration::try_from_secs_f64).transpose();
    let within = within.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let effort = Effort {
        degree,
        blind,
        terms: terms.into_iter().map(|text| text.as_str().into()).collect(),
        conditions: conditions.map(|name| match name.as_str() {
            "" => ConditionTarget::Existence,
            _ => ConditionTarget::Claim(name),
        }),
        seconds,
        ansatz: Ansatz {
            wanted: ansatz.is_some(),
            positions: ansatz.unwrap_or(Ansatz::default().positions),
            potentials,
            gyrostats,
            megabytes,
        },
        poisson: poisson.map(|formula| match formula.as_str() {
            "" => Hamiltonians::Known,
            _ => Hamiltonians::Given(formula),
        }),
        halt: within.map_or_else(Halt::default, Halt::within),
        options: Options { seed, ..Options::default() },
        ..Effort::default()
    };
    let inner = Arc::clone(&case.inner);
    // A search has a switch of its own, which ends it between two steps.
    let switch = effort.halt.switch();
    let found = work.shared(py, move || liouville_search::search(&inner, &effort, &mut |_| ()));
    if found.is_err() {
        switch.store(true, Ordering::Relaxed);
    }
    let report = found?.map_err(|error| errors::of_search(py, &error))?;
    let title = &case.inner.title;
    liouville_cli::report::search::json(title, &report)
        .and_then(|json| CaseDigest::of(&case.text).sign(&json))
        .map_err(|error| errors::of_output(&error))
}

/// Reports the invariants of the system as `html`, `markdown`, `latex`, `text` or `json`.
#[pyfunction]
pub fn report(
    py: Python<'_>,
    case: &Case,
    format: String,
    seed: u64,
    threads: Option<usize>,
) -> PyResult<String> {
    let work = Work::on(threads);
    let (inner, count) = (Arc::clone(&case.inner), work.threads());
    let digest = CaseDigest::of(&case.text);
    let written = work.shared(py, move || {
        let options = Options { seed, ..Options::default() };
        let found = survey::survey(&inner, &options, &Halt::default(), &mut |_| ())?;
        let origin = digest.line();
        Ok(match format.as_str() {
            "html" => {
                let motion = liouville_flow::portrait(&inner, seed, count);
                Ok(written::html(&found, &origin, motion.as_ref()))
            }
            "markdown" => Ok(written::markdown(&found, &origin)),
            "latex" => Ok(written::latex(&found, &origin)),
            "json" => written::json(&found).and_then(|json| digest.sign(&json)),
            _ => {
                let style = PageStyle { verbose: false, colour: false, width: WIDTH };
                Ok(written::text(&found, &origin, style))
            }
        })
    })?;
    let written = written
        .map_err(|error: JudgeError| errors::of_judging(py, &case.name, &case.text, &error))?;
    written.map_err(|error| errors::of_output(&error))
}
/// Judges all claims, those about motion if they are wanted.
fn verdicts(
    case: &liouville::case::Case,
    options: &Options,
    motion: bool,
) -> Result<CaseReport, JudgeError> {
    let mut report = verdict::judge(case, options)?;
    liouville_search::complete(case, options, &mut report)?;
    if motion {
        observe_each(case, options, &mut |claim| report.claims.push(claim));
        report.motions_left = 0;
    }
    Ok(report)
}

fn read_trust(text: &str) -> PyResult<Trust> {
    match text {
        "best" => Ok(Trust::Best),
        "proof" => Ok(Trust::Proof),
        "float" => Ok(Trust::Float),
        _ => Err(PyValueError::new_err("trust is \"best\", \"proof\" or \"float\"")),
    }
}
