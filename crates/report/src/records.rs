//! Verdicts claim by claim for other programs: CSV for tables, JUnit's XML for continuous
//! integration.

use std::fmt::Write;

use liouville::verdict::ClaimReport;

use super::annotations::{line_of, words, words_of_failure};
use super::evidence::options;
use super::typeset::mathml;
use super::{FileFailure, FileOutcome, RunReport};

/// Renders a header and one line for each claim; of a file that could not be judged one for each
/// mistake, which is the reason.
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
            Err(failures) => failures.iter().for_each(|failure| {
                let message = failure.message.as_str();
                line([&outcome.path, title, "", "", "", "", "error", "no", "", message, ""]);
            }),
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

/// Renders one test suite for each file and one test for each claim, or for each mistake of a file that
/// could not be judged, by the schema `junit-10.xsd`.
///
/// A verdict against expectation is a failure, a mistake an error, and a claim about motion that was not
/// looked at is absent. `text_of` returns the text of a file, in which the lines of claims are looked up.
pub fn junit(run: &RunReport, text_of: impl Fn(&str) -> Option<String>) -> String {
    let suites: Vec<TestSuite> =
        run.outcomes.iter().map(|outcome| TestSuite::of(outcome, &text_of)).collect();
    let count = |kind| suites.iter().map(|suite| suite.count(kind)).sum::<usize>();
    let tests: usize = suites.iter().map(|suite| suite.tests.len()).sum();
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{tests}\" failures=\"{}\" \
         errors=\"{}\" time=\"{:.3}\">\n",
        count("failure"),
        count("error"),
        run.elapsed.as_secs_f64()
    );
    suites.iter().for_each(|suite| out.push_str(&suite.render()));
    out + "</testsuites>\n"
}

/// Tests of a file.
struct TestSuite {
    path: String,
    tests: Vec<TestCase>,
}

/// A claim or a mistake as a test.
struct TestCase {
    name: String,
    /// Name of the element that says why it did not pass, its type, its message and its text.
    problem: Option<(&'static str, &'static str, String, String)>,
}

impl TestSuite {
    fn of(outcome: &FileOutcome, text_of: &impl Fn(&str) -> Option<String>) -> Self {
        let path = outcome.path.clone();
        let tests = match &outcome.result {
            Ok(report) => {
                let has_problem = report.claims.iter().any(|claim| !claim.agrees);
                let text = has_problem.then(|| text_of(&path)).flatten().unwrap_or_default();
                report.claims.iter().map(|claim| TestCase::of(outcome, claim, &text)).collect()
            }
            Err(failures) => {
                let place = |number: usize| match failures.len() {
                    1 => "the file".to_string(),
                    _ => format!("the file, mistake {}", number + 1),
                };
                let test = |(number, failure): (usize, &FileFailure)| TestCase {
                    name: place(number),
                    problem: Some((
                        "error",
                        "mistake",
                        failure.message.clone(),
                        placed(&path, failure.line, &words_of_failure(failure)),
                    )),
                };
                failures.iter().enumerate().map(test).collect()
            }
        };
        Self { path, tests }
    }

    fn count(&self, kind: &str) -> usize {
        let is_own = |test: &&TestCase| test.problem.as_ref().is_some_and(|own| own.0 == kind);
        self.tests.iter().filter(is_own).count()
    }

    fn render(&self) -> String {
        let path = escaped(&self.path);
        let mut out = format!(
            "  <testsuite name=\"{path}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n",
            self.tests.len(),
            self.count("failure"),
            self.count("error"),
            self.count("skipped")
        );
        for test in &self.tests {
            let name = escaped(&test.name);
            // a `String` takes all that is written to it
            _ = write!(out, "    <testcase classname=\"{path}\" name=\"{name}\"");
            _ = match &test.problem {
                None => writeln!(out, "/>"),
                Some((element, kind, message, text)) => writeln!(
                    out,
                    ">\n      <{element} type=\"{kind}\" message=\"{}\">{}</{element}>\n    </testcase>",
                    escaped(message),
                    escaped_lines(text)
                ),
            };
        }
        out + "  </testsuite>\n"
    }
}

impl TestCase {
    fn of(outcome: &FileOutcome, claim: &ClaimReport, text: &str) -> Self {
        let name = format!("{}: {}", claim.kind, claim.name);
        let problem = match (claim.agrees, outcome.unreached.contains(&claim.name)) {
            (true, _) => None,
            (false, true) => {
                let reason = claim.evidence.reason.as_deref().unwrap_or("not reached");
                Some(("skipped", "not reached", reason.to_string(), String::new()))
            }
            (false, false) => {
                let message = words(claim);
                let line = line_of(text, claim);
                let mut whole = placed(&outcome.path, line, &message);
                if let Some(formula) = &claim.formula {
                    _ = write!(whole, "\n{} = {formula}", claim.kind);
                }
                let witness = claim.evidence.witness.as_ref();
                if let Some(witness) = witness {
                    _ = write!(whole, "\nwitness: {}", options(witness));
                }
                Some(("failure", claim.verdict.word(), message, whole))
            }
        };
        Self { name, problem }
    }
}

/// A message behind the place in its file.
fn placed(path: &str, line: Option<usize>, message: &str) -> String {
    match line {
        Some(line) => format!("{path}:{line}: {message}"),
        None => format!("{path}: {message}"),
    }
}

/// Escapes a text of several lines.
fn escaped_lines(text: &str) -> String {
    text.lines().map(escaped).collect::<Vec<_>>().join("\n")
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
