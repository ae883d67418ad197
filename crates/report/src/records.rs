//! Verdicts claim by claim for other programs: CSV for tables, JUnit's XML for continuous
//! integration.

use std::fmt::Write;

use liouville::verdict::{ClaimReport, Verdict};

use super::typeset::mathml;
use super::{FileOutcome, RunReport};

/// Renders a header and one line for each claim; files that could not be judged have one line, with
/// the first mistake as the reason.
pub fn csv(run: &RunReport) -> String {
    let mut out = String::from(
        "path,title,claim,kind,source,expected,verdict,as_expected,method,reason,remark\n",
    );
    let mut line = |fields: [&str; 11]| {
        let fields = fields.map(quoted);
        // a `String` takes all that is written to it
        _ = writeln!(out, "{}", fields.join(","));
    };
    for outcome in &run.outcomes {
        let title = &outcome.heading.title;
        match &outcome.result {
            Ok(report) => report.claims.iter().for_each(|claim| {
                let method = claim.evidence.method.to_string();
                line([
                    &outcome.path,
                    title,
                    &claim.name,
                    claim.kind,
                    &claim.source,
                    claim.expect.word(),
                    claim.verdict.word(),
                    match claim.agrees {
                        true => "yes",
                        false if outcome.unreached.contains(&claim.name) => "not reached",
                        false => "no",
                    },
                    &method,
                    claim.evidence.reason.as_deref().unwrap_or_default(),
                    claim.evidence.remark.as_deref().unwrap_or_default(),
                ]);
            }),
            Err(failures) => {
                let message = failures.first().map_or("", |failure| failure.message.as_str());
                line([&outcome.path, title, "", "", "", "", "error", "no", "", message, ""]);
            }
        }
    }
    out
}

/// Quotes a field if it contains a comma, a quote or the end of a line.
fn quoted(field: &str) -> String {
    match field.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", field.replace('"', "\"\"")),
        false => field.to_string(),
    }
}

/// Renders one test suite for each file and one test for each claim.
///
/// A verdict against expectation is a failure, a file that could not be judged an error, and a
/// claim about motion that was not looked at is absent.
pub fn junit(run: &RunReport) -> String {
    let summary = run.summary();
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{}\" failures=\"{}\" \
         errors=\"{}\" time=\"{:.3}\">\n",
        summary.claims, summary.disagreements, summary.errors, summary.seconds
    );
    run.outcomes.iter().for_each(|outcome| out.push_str(&suite(outcome)));
    out.push_str("</testsuites>\n");
    out
}

fn suite(outcome: &FileOutcome) -> String {
    let path = escaped(&outcome.path);
    let mut out = String::new();
    match &outcome.result {
        Ok(report) => {
            let is_failure =
                |claim: &&ClaimReport| !claim.agrees && !outcome.unreached.contains(&claim.name);
            let failures = report.claims.iter().filter(is_failure).count();
            let tests = report.claims.len();
            _ = writeln!(
                out,
                "  <testsuite name=\"{path}\" tests=\"{tests}\" failures=\"{failures}\" errors=\"0\">"
            );
            for claim in &report.claims {
                let is_reached = !outcome.unreached.contains(&claim.name);
                out.push_str(&test(&path, claim, is_reached));
            }
        }
        Err(failures) => {
            _ = writeln!(
                out,
                "  <testsuite name=\"{path}\" tests=\"1\" failures=\"0\" errors=\"1\">\n    \
                 <testcase classname=\"{path}\" name=\"the file\">"
            );
            for failure in failures {
                _ = writeln!(out, "      <error message=\"{}\"/>", escaped(&failure.message));
            }
            out.push_str("    </testcase>\n");
        }
    }
    out.push_str("  </testsuite>\n");
    out
}

fn test(path: &str, claim: &ClaimReport, is_reached: bool) -> String {
    let name = escaped(&format!("{}: {}", claim.kind, claim.name));
    let open = format!("    <testcase classname=\"{path}\" name=\"{name}\"");
    if claim.agrees {
        return format!("{open}/>\n");
    }
    let verdict = claim.verdict.word();
    let reason = match (claim.verdict, &claim.evidence.reason) {
        (Verdict::Undecided, Some(reason)) => format!(": {reason}"),
        _ => String::new(),
    };
    if !is_reached {
        let message = escaped(claim.evidence.reason.as_deref().unwrap_or("not reached"));
        return format!("{open}>\n      <skipped message=\"{message}\"/>\n    </testcase>\n");
    }
    let message = escaped(&format!("{verdict}, expected: {}{reason}", claim.expect.word()));
    format!("{open}>\n      <failure message=\"{message}\"/>\n    </testcase>\n")
}

/// Escapes a text for XML; control characters, which XML 1.0 has no place for, become spaces.
fn escaped(text: &str) -> String {
    mathml::escaped(&text.replace(char::is_control, " "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_and_texts_are_escaped() {
        assert_eq!(quoted("a,b"), "\"a,b\"");
        assert_eq!(quoted("say \"x\""), "\"say \"\"x\"\"\"");
        assert_eq!(quoted("(1.10)"), "(1.10)");
        assert_eq!(escaped("a<b & \"c\"\n"), "a&lt;b &amp; &quot;c&quot; ");
    }
}
