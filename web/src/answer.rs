//! Answers to the requests of the page, by the code that answers the commands.

use std::time::Duration;

use liouville::case::Case;
use liouville::verdict::{CaseReport, Options};
use liouville_catalogue::{CATALOGUE, inside, templates, title};
use liouville_report::survey as written;
use liouville_report::{
    CaseDigest, FileFailure, FileOutcome, Heading, RunReport, diagnostic, json, names,
};
use liouville_search::survey::{self, TestedClaim};
use liouville_search::{Ansatz, Effort, Halt};
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

fn answer(request: Request) -> Result<Value, Vec<FileFailure>> {
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
fn wrong(message: &str) -> FileFailure {
    diagnostic::of_file("request", message, "reload the page", false)
}

/// Failures with the excerpts that the command prints.
fn listed(failures: &[FileFailure]) -> Value {
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
fn read(source: &Source) -> Result<Case, Vec<FileFailure>> {
    let (text, case) = Case::read_from(source.text.as_bytes(), &[]);
    case.map_err(|error| diagnostic::of_case(&source.path, &text, &error, false))
}

/// Judges a case; the document is that of `check --json`.
fn check(source: &Source) -> Result<Value, Vec<FileFailure>> {
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
    let outcome = FileOutcome {
        path: source.path.clone(),
        heading,
        result: judged,
        unreached: Vec::new(),
        is_reached: true,
    };
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

fn unwritten(error: serde_json::Error) -> Vec<FileFailure> {
    vec![wrong(&format!("the answer cannot be written: {error}"))]
}

/// Claims as the page shows them, in the order of the report.
fn shown(path: &str, case: &Case, report: &CaseReport) -> Vec<Shown> {
    let findings = report.claims.iter().map(|claim| TestedClaim::claimed(case, claim.clone()));
    findings.map(|finding| Shown::of(path, &finding)).collect()
}

/// Searches a case; the document is that of `search --json`.
fn search(request: &Search) -> Result<Value, Vec<FileFailure>> {
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
        .and_then(|document| CaseDigest::of(&source.text).sign(&document))
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

fn of_whole(source: &Source, message: &str, help: &str) -> Vec<FileFailure> {
    vec![diagnostic::of_file(&source.path, message, help, false)]
}

/// The page of `report`, without the motion.
fn report(source: &Source) -> Result<Value, Vec<FileFailure>> {
    let case = read(source)?;
    let found = survey::survey(&case, &Options::default(), &Halt::default(), &mut |_| ())
        .map_err(|error| of_whole(source, &error.to_string(), error.help()))?;
    let origin = CaseDigest::of(&source.text).line();
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

fn show(name: &str) -> Result<Value, Vec<FileFailure>> {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(request: &Value) -> Value {
        serde_json::from_str(&answered(request.to_string().as_bytes())).expect("JSON")
    }

    fn text(name: &str) -> Value {
        asked(&json!({ "ask": "show", "name": name }))["text"].clone()
    }

    #[test]
    fn a_case_is_judged_typeset_and_searched() {
        let text = text("plane/balanced-ball");
        let found = asked(&json!({ "ask": "check", "path": "case.toml", "text": text }));
        let document: Value = serde_json::from_str(found["json"].as_str().expect("a document"))
            .expect("the document of the command");
        let claims = document["cases"][0]["claims"].as_array().expect("claims");
        let shown = found["shown"].as_array().expect("formulas");
        assert_eq!((&found["code"], claims.len()), (&json!(0), shown.len()));
        for (claim, shown) in claims.iter().zip(shown) {
            let is_typeset = shown["formula"].as_str().is_some_and(|set| set.starts_with("<math"));
            assert_eq!(is_typeset, !claim["formula"].is_null(), "{claim} {shown}");
            let command = shown["witness"].as_str().unwrap_or_default();
            let is_refuted = claim["verdict"] == "refuted" && claim["kind"] != "no-integral";
            assert_eq!(command.starts_with("liouville eval case.toml"), is_refuted, "{command}");
        }
        let found =
            asked(&json!({ "ask": "search", "path": "c.toml", "text": text, "blind": true }));
        assert!(!found["shown"].as_array().expect("finds").is_empty(), "{found}");
        let found = asked(&json!({ "ask": "report", "path": "c.toml", "text": text }));
        assert!(found["page"].as_str().expect("a page").contains("integral and measure"));
        let found = asked(&json!({ "ask": "names", "path": "c.toml", "text": text }));
        assert!(found["text"].as_str().expect("names").starts_with("state variables"));
    }

    #[test]
    fn what_is_wrong_has_a_place() {
        let text = "title = 'x'\n[state]\nx = '1..2'\n[field]\n\"x'\" = 'y'\n";
        for ask in ["check", "search", "report", "names"] {
            let found = asked(&json!({ "ask": ask, "path": "case.toml", "text": text }));
            let failure = &found["failures"][0];
            assert_eq!((&failure["line"], &failure["column"]), (&json!(5), &json!(9)), "{found}");
            let rendered = failure["rendered"].as_str().expect("an excerpt");
            assert!(rendered.contains("case.toml:5:9") && rendered.contains('^'), "{rendered}");
        }
        for request in [json!({ "ask": "nothing" }), json!({ "ask": "show", "name": "plane" })] {
            assert!(asked(&request)["failures"][0]["message"].is_string(), "{request}");
        }
    }

    #[test]
    fn names_cannot_be_markup() {
        let text = "title = '<b>'\n[state]\n'<img>' = '1..2'\n[field]\n\"<img>'\" = '<img>'\n\
                    [[claim]]\nname = '<i>'\nintegral = '<img>'\n";
        let found = asked(&json!({ "ask": "check", "path": "case.toml", "text": text }));
        assert!(found["failures"][0]["message"].is_string(), "such names are refused: {found}");
    }

    #[test]
    fn all_cases_are_there() {
        let all = asked(&json!({ "ask": "cases" }));
        let count = |key: &str| all[key].as_array().map(Vec::len);
        assert_eq!((count("cases"), count("templates")), (Some(CATALOGUE.len()), Some(6)));
        assert!(text("field").as_str().is_some_and(|text| text.contains("[field]")));
    }
}
