//! Answers to the requests of the page, by the code that answers the commands.

use std::time::Duration;

use liouville::case::Case;
use liouville::verdict::{CaseReport, Options};
use liouville_catalogue::{CATALOGUE, inside, templates, title};
use liouville_report::survey as written;
use liouville_report::{Digest, Failure, Heading, Outcome, RunReport, diagnostic, json, names};
use liouville_search::survey::{self, Finding};
use liouville_search::{Ansatz, Effort};
use serde_json::{Value, json};

use crate::page::Shown;
use crate::request::{Request, Search, Source};

/// Answers a request; what is wrong with it becomes a message.
pub fn answered(request: &[u8]) -> String {
    let answer = match serde_json::from_slice(request) {
        Ok(request) => answer(request),
        Err(error) => Err(vec![wrong(&format!("the request cannot be read: {error}"))]),
    };
    answer.unwrap_or_else(|failures| json!({ "failures": listed(&failures) })).to_string()
}

fn answer(request: Request) -> Result<Value, Vec<Failure>> {
    match request {
        Request::Check(source) => check(&source),
        Request::Search(request) => search(&request),
        Request::Report(source) => report(&source),
        Request::Names(source) => read(&source).map(|case| json!({ "text": names::text(&case) })),
        Request::Cases => Ok(cases()),
        Request::Show { name } => show(&name),
    }
}

/// Failure of a request, rather than of a case.
fn wrong(message: &str) -> Failure {
    diagnostic::of_file("request", message, "reload the page", false)
}

/// Failures with the excerpts that the command prints.
fn listed(failures: &[Failure]) -> Value {
    let each = failures.iter().map(|failure| {
        json!({
            "message": failure.message,
            "help": failure.help,
            "line": failure.line,
            "column": failure.column,
            "rendered": failure.rendered,
        })
    });
    each.collect()
}

/// Reads a case with the limits of the command.
fn read(source: &Source) -> Result<Case, Vec<Failure>> {
    let (text, case) = Case::read_from(source.text.as_bytes(), &[]);
    case.map_err(|error| diagnostic::of_case(&source.path, &text, &error, false))
}

/// Judges a case; the document is that of `check --json`.
fn check(source: &Source) -> Result<Value, Vec<Failure>> {
    let options = Options::default();
    let case = read(source);
    let judged = case.as_ref().map_err(Clone::clone).and_then(|case| {
        liouville_search::judge(case, &options).map_err(|error| {
            vec![diagnostic::of_judging(&source.path, &source.text, &error, false)]
        })
    });
    let shown = match (&case, &judged) {
        (Ok(case), Ok(report)) => shown(&source.path, case, report),
        _ => Vec::new(),
    };
    let failures = judged.as_ref().err().map(|failures| listed(failures));
    let heading = case.map_or_else(|_| Heading::default(), |case| Heading::of(&case, &source.text));
    let outcome =
        Outcome { path: source.path.clone(), heading, result: judged, unreached: Vec::new() };
    let run =
        RunReport { seed: options.seed, outcomes: vec![outcome], elapsed: Duration::default() };
    let document = json::render(&run).map_err(unwritten)?;
    Ok(json!({
        "code": run.exit_code(),
        "json": document,
        "shown": shown,
        "failures": failures.unwrap_or_else(|| json!([])),
    }))
}

fn unwritten(error: serde_json::Error) -> Vec<Failure> {
    vec![wrong(&format!("the answer cannot be written: {error}"))]
}

/// Claims as the page shows them, in the order of the report.
fn shown(path: &str, case: &Case, report: &CaseReport) -> Vec<Shown> {
    let findings = report.claims.iter().map(|claim| Finding::claimed(case, claim.clone()));
    findings.map(|finding| Shown::of(path, &finding)).collect()
}

/// Searches a case; the document is that of `search --json`.
fn search(request: &Search) -> Result<Value, Vec<Failure>> {
    let source = &request.source;
    let case = read(source)?;
    let effort = Effort {
        degree: request.degree.min(10),
        blind: request.blind,
        seconds: request.seconds,
        ansatz: Ansatz { megabytes: request.megabytes, ..Ansatz::default() },
        ..Effort::default()
    };
    let found = liouville_search::search(&case, &effort, &mut |_| ())
        .map_err(|error| of_whole(source, &error.to_string(), error.help()))?;
    let document = liouville_report::search::json(&case.title, &found)
        .and_then(|document| Digest::of(&source.text).sign(&document))
        .map_err(unwritten)?;
    let shown: Vec<Shown> = found
        .found
        .iter()
        .map(|one| Shown::of(&source.path, &survey::of_search(&case, one.clone())))
        .collect();
    Ok(json!({
        "json": document,
        "text": liouville_report::search::text(&case.title, &found),
        "shown": shown,
    }))
}

fn of_whole(source: &Source, message: &str, help: &str) -> Vec<Failure> {
    vec![diagnostic::of_file(&source.path, message, help, false)]
}

/// The page of `report`, without the motion.
fn report(source: &Source) -> Result<Value, Vec<Failure>> {
    let case = read(source)?;
    let found = survey::survey(&case, &Options::default(), &mut |_| ())
        .map_err(|error| of_whole(source, &error.to_string(), error.help()))?;
    let origin = Digest::of(&source.text).line();
    Ok(json!({ "page": written::document(&found, &origin).html() }))
}

fn cases() -> Value {
    let short =
        |name: &str| name.trim_start_matches("cases/").trim_end_matches(".toml").to_string();
    let cases = CATALOGUE.iter().map(|(name, text)| json!([short(name), title(text)]));
    let templates = templates::ALL.iter().map(|(name, text)| json!([name, title(text)]));
    json!({
        "version": liouville_report::VERSION,
        "cases": cases.collect::<Value>(),
        "templates": templates.collect::<Value>(),
    })
}

fn show(name: &str) -> Result<Value, Vec<Failure>> {
    let template = templates::ALL.iter().find(|(kind, _)| *kind == name).map(|(_, text)| *text);
    let text = template.or_else(|| match inside(name.as_ref()).as_slice() {
        [(_, text)] => Some(*text),
        _ => None,
    });
    match text {
        Some(text) => Ok(json!({ "text": text })),
        None => {
            let message = format!("the catalogue has no case {name}");
            Err(vec![diagnostic::of_file(name, &message, "choose one of the list", false)])
        }
    }
}
