//! Verdicts as annotations of GitHub's workflows, which shows them beside the lines of a file.
//!
//! A line is `::error file=…,line=…,col=…,title=…::message`, with the characters that end its parts
//! as %-codes ("Workflow commands for GitHub Actions").

use std::fmt::Write;

use liouville::verdict::{ClaimReport, Verdict};

use super::{FileFailure, FileOutcome, RunReport};

/// Renders an error for each verdict against expectation and each file that could not be judged, a
/// warning for each claim without a verdict, and a notice with the counts.
///
/// `text_of` returns the text of a file, in which the lines of claims are looked up.
pub fn annotations(run: &RunReport, text_of: impl Fn(&str) -> Option<String>) -> String {
    let mut out = String::new();
    for outcome in &run.outcomes {
        match &outcome.result {
            Ok(report) => {
                let text = text_of(&outcome.path).unwrap_or_default();
                for claim in &report.claims {
                    out.push_str(&of_claim(outcome, claim, &text));
                }
            }
            Err(failures) => {
                failures.iter().for_each(|own| out.push_str(&of_failure(outcome, own)))
            }
        }
    }
    let summary = run.summary();
    let counts = format!(
        "{} claims: {} proved, {} confirmed, {} refuted, {} undecided; against expectation: {}, \
         files not judged: {}",
        summary.claims,
        summary.proved,
        summary.confirmed,
        summary.refuted,
        summary.undecided,
        summary.disagreements,
        summary.errors
    );
    _ = writeln!(out, "::notice title=liouville::{counts}");
    out
}

fn of_claim(outcome: &FileOutcome, claim: &ClaimReport, text: &str) -> String {
    let level = match (claim.agrees, claim.verdict) {
        (false, _) if !outcome.unreached.contains(&claim.name) => "error",
        (false, _) | (_, Verdict::Undecided) => "warning",
        _ => return String::new(),
    };
    let title = format!("{} {}", claim.kind, claim.name);
    annotation(level, &outcome.path, [line_of(text, claim), None], &title, &words(claim))
}

fn of_failure(outcome: &FileOutcome, failure: &FileFailure) -> String {
    let place = [failure.line, failure.column];
    let message = words_of_failure(failure);
    annotation("error", &outcome.path, place, "the case cannot be judged", &message)
}

/// A verdict against what was expected, with its reason and the state of a witness.
pub fn words(claim: &ClaimReport) -> String {
    let mut message = format!("{}, expected: {}", claim.verdict.word(), claim.expect.word());
    if let Some(reason) = &claim.evidence.reason {
        _ = write!(message, "; {reason}");
    }
    if let Some(witness) = &claim.evidence.witness {
        _ = write!(message, "; at {}", witness.state);
    }
    message
}

/// A mistake with its help.
pub fn words_of_failure(failure: &FileFailure) -> String {
    match &failure.help {
        Some(help) => format!("{}\nhelp: {help}", failure.message),
        None => failure.message.clone(),
    }
}

fn annotation(
    level: &str,
    path: &str,
    [line, column]: [Option<usize>; 2],
    title: &str,
    message: &str,
) -> String {
    let mut out = format!("::{level} file={}", property(path));
    for (key, place) in [("line", line), ("col", column)] {
        if let Some(place) = place {
            _ = write!(out, ",{key}={place}");
        }
    }
    out + &format!(",title={}::{}\n", property(title), data(message))
}

/// Line of a claim in the text of its file, from 1.
pub fn line_of(text: &str, claim: &ClaimReport) -> Option<usize> {
    line_with(text, claim.kind, claim.formula.as_ref()?)
}

/// The first line, from 1, that begins with a key and holds a formula.
fn line_with(text: &str, kind: &str, formula: &str) -> Option<usize> {
    let is_own = |line: &str| line.trim_start().starts_with(kind) && line.contains(formula);
    text.lines().position(is_own).map(|line| line + 1)
}

/// Text after the last `::`.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// Text of a property, which a comma or a colon would end.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_an_annotation_do_not_end_early() {
        let line = annotation("error", "a,b:c.toml", [Some(3), None], "x: y", "50 %\nhelp: ::");
        let whole = "::error file=a%2Cb%3Ac.toml,line=3,title=x%3A y::50 %25%0Ahelp: ::\n";
        assert_eq!(line, whole);
    }

    #[test]
    fn claims_are_found_by_their_keys_and_formulas() {
        let text = "# x\n[[claim]]\ndensity = \"x\"\n[[claim]]\n  integral = \"x\"\n";
        assert_eq!(line_with(text, "integral", "x"), Some(5));
        assert_eq!(line_with(text, "integral", "y"), None);
    }
}
