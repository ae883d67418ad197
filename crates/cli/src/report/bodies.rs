//! Report of a table of bodies: a row for each, as text, CSV, JSON and lines of JSON.

use liouville::verdict::Verdict;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::data::quoted;
use super::{CaseDigest, VERSION};

/// Mistake of one row; the others have their results.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RowMistake {
    /// Message.
    pub message: String,
    /// Remedy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub help: Option<String>,
}

impl RowMistake {
    /// Mistake with its remedy.
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: Some(help.into()) }
    }
}

/// A body: a row of the table with what was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// Number of the row, from 1.
    pub row: u64,
    /// Line of the table on which it begins.
    pub line: u64,
    /// Names and values of the row.
    pub settings: Vec<(String, String)>,
    /// Results, or the reasons why there are none.
    pub found: Result<Finding, Vec<RowMistake>>,
}

/// Verdicts and invariants of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Verdicts on the claims of the case, in their order.
    pub verdicts: Vec<Verdict>,
    /// Places of the claims whose verdicts are not as expected.
    pub against: Vec<usize>,
    /// Invariants of the body, if they were asked for.
    pub invariants: Option<Invariants>,
    /// Warnings about the body.
    #[serde(default)]
    pub warnings: Vec<String>,
}

/// Invariants of a body, by name.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Invariants {
    /// Class of the hierarchy.
    pub class: String,
    /// State of knowledge about densities.
    pub measure: String,
    /// Integrals other than the general ones.
    pub integrals: Vec<String>,
    /// Densities.
    pub densities: Vec<String>,
    /// Symmetry fields.
    pub fields: Vec<String>,
    /// Reversors.
    pub reversors: Vec<String>,
    /// Discrete symmetries.
    pub symmetries: Vec<String>,
}

impl Invariants {
    /// Columns of a table for a terminal; files have all.
    const SHOWN: [&str; 4] = ["class", "measure", "integrals", "densities"];

    /// Values as texts, with their titles.
    fn named(&self) -> [(&'static str, String); 7] {
        let listed = |names: &[String]| names.join("; ");
        [
            ("class", self.class.clone()),
            ("measure", self.measure.clone()),
            ("integrals", listed(&self.integrals)),
            ("densities", listed(&self.densities)),
            ("fields", listed(&self.fields)),
            ("reversors", listed(&self.reversors)),
            ("symmetries", listed(&self.symmetries)),
        ]
    }
}

/// A claim of the case.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct StatedClaim {
    /// Name.
    pub name: String,
    /// Key of the statement.
    pub kind: &'static str,
    /// Formula, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub formula: Option<String>,
    /// Expected outcome.
    pub expect: &'static str,
}

/// All bodies of a table with the case that they are bodies of.
pub struct BodiesReport<'r> {
    /// Title of the case.
    pub title: &'r str,
    /// Name of its file.
    pub path: &'r str,
    /// Digest of its text.
    pub digest: CaseDigest,
    /// Seed of all states.
    pub seed: u64,
    /// Claims that were judged, in the order of the verdicts.
    pub claims: &'r [StatedClaim],
    /// Whether invariants were asked for.
    pub has_invariants: bool,
    /// Bodies in the order of the rows.
    pub bodies: &'r [Body],
}

/// Counts over all bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct BodiesSummary {
    /// Number of bodies with results.
    pub bodies: usize,
    /// Numbers of claims proved, confirmed, refuted and undecided.
    #[serde(flatten)]
    pub counts: Counts,
    /// Number of rows without results.
    pub errors: usize,
}

/// Numbers of verdicts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    proved: usize,
    confirmed: usize,
    refuted: usize,
    undecided: usize,
    /// Number of verdicts that are not as expected.
    disagreements: usize,
}

impl Counts {
    fn of(found: &Finding) -> Self {
        let count = |own| found.verdicts.iter().filter(|verdict| **verdict == own).count();
        Self {
            proved: count(Verdict::Proved),
            confirmed: count(Verdict::Confirmed),
            refuted: count(Verdict::Refuted),
            undecided: count(Verdict::Undecided),
            disagreements: found.against.len(),
        }
    }

    /// Numbers with their titles.
    fn named(self) -> [(&'static str, usize); 5] {
        [
            ("proved", self.proved),
            ("confirmed", self.confirmed),
            ("refuted", self.refuted),
            ("undecided", self.undecided),
            ("disagreements", self.disagreements),
        ]
    }

    fn and(self, other: Self) -> Self {
        Self {
            proved: self.proved + other.proved,
            confirmed: self.confirmed + other.confirmed,
            refuted: self.refuted + other.refuted,
            undecided: self.undecided + other.undecided,
            disagreements: self.disagreements + other.disagreements,
        }
    }
}

impl BodiesReport<'_> {
    /// Counts over all bodies.
    pub fn summary(&self) -> BodiesSummary {
        let found = || self.bodies.iter().filter_map(|body| body.found.as_ref().ok());
        let counts = found().map(Counts::of).fold(Counts::default(), Counts::and);
        let bodies = found().count();
        BodiesSummary { bodies, counts, errors: self.bodies.len() - bodies }
    }

    /// Exit code. 0: all as expected; 1: a verdict contradicts its expectation, unless invariants
    /// were asked for; 2: a row has no results.
    pub fn exit_code(&self) -> u8 {
        let summary = self.summary();
        match (summary.errors, summary.counts.disagreements) {
            (0, _) if self.has_invariants => 0,
            (0, 0) => 0,
            (0, _) => 1,
            _ => 2,
        }
    }

    /// Names of the columns of values.
    fn names(&self) -> Vec<String> {
        let first = self.bodies.first();
        first
            .map_or(Vec::new(), |body| body.settings.iter().map(|(name, _)| name.clone()).collect())
    }

    /// Renders a row for each body, with a column for each claim.
    pub fn csv(&self) -> String {
        let names = self.names();
        let mut titles = vec!["row".to_string(), "line".to_string()];
        titles.extend(names.iter().cloned());
        titles.extend(titles_of(&Counts::default().named()));
        titles.extend(self.claims.iter().map(|claim| format!("claim {}", claim.name)));
        if self.has_invariants {
            titles.extend(titles_of(&Invariants::default().named()));
        }
        titles.extend(["warnings", "error"].map(String::from));
        let width = titles.len();
        let mut out = line(&titles);
        for body in self.bodies {
            let mut fields = vec![body.row.to_string(), body.line.to_string()];
            let values = body.settings.iter().map(|(_, value)| value.clone());
            fields.extend(values.chain(std::iter::repeat(String::new())).take(names.len()));
            match &body.found {
                Ok(found) => {
                    let counts = Counts::of(found).named();
                    fields.extend(counts.map(|(_, count)| count.to_string()));
                    fields.extend(found.verdicts.iter().map(|verdict| verdict.word().to_string()));
                    let texts = found.invariants.iter().flat_map(Invariants::named);
                    fields.extend(texts.map(|(_, text)| text));
                    fields.extend([found.warnings.join("; "), String::new()]);
                }
                Err(mistakes) => {
                    fields.resize(width - 1, String::new());
                    fields.push(mistakes.first().map_or("", |own| &own.message).to_string());
                }
            }
            out.push_str(&line(&fields));
        }
        out
    }

    /// Results of a body.
    fn entry(&self, body: &Body) -> Value {
        let settings: Map<String, Value> =
            body.settings.iter().map(|(name, value)| (name.clone(), json!(value))).collect();
        let mut entry = Map::new();
        entry.insert("row".to_string(), json!(body.row));
        entry.insert("line".to_string(), json!(body.line));
        entry.insert("settings".to_string(), settings.into());
        match &body.found {
            Err(mistakes) => _ = entry.insert("errors".to_string(), json!(mistakes)),
            Ok(found) => {
                let name = |place: &usize| self.claims.get(*place).map(|claim| &claim.name);
                let verdicts = self.claims.iter().zip(&found.verdicts);
                let verdicts: Map<String, Value> =
                    verdicts.map(|(claim, verdict)| (claim.name.clone(), json!(verdict))).collect();
                let against: Vec<_> = found.against.iter().filter_map(name).collect();
                entry.insert("verdicts".to_string(), verdicts.into());
                entry.insert("disagreements".to_string(), json!(against));
                entry.insert("warnings".to_string(), json!(found.warnings));
                if let Some(Ok(Value::Object(own))) =
                    found.invariants.as_ref().map(serde_json::to_value)
                {
                    entry.extend(own);
                }
            }
        }
        entry.into()
    }

    /// Renders all bodies as one document.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        let bodies: Vec<Value> = self.bodies.iter().map(|body| self.entry(body)).collect();
        serde_json::to_string_pretty(&json!({
            "version": VERSION,
            "title": self.title,
            "path": self.path,
            "digest": self.digest,
            "seed": self.seed,
            "claims": self.claims,
            "bodies": bodies,
            "summary": self.summary(),
        }))
    }

    /// Renders a line for each body.
    pub fn json_lines(&self) -> String {
        self.bodies.iter().map(|body| format!("{}\n", self.entry(body))).collect()
    }

    /// Renders the summary as a line.
    pub fn summary_line(&self) -> String {
        let BodiesSummary { bodies, counts, errors } = self.summary();
        let Counts { proved, confirmed, refuted, undecided, disagreements } = counts;
        let confirmed = match confirmed {
            0 => String::new(),
            _ => format!("{confirmed} confirmed, "),
        };
        let noun = if bodies == 1 { "body" } else { "bodies" };
        let differ = if disagreements == 1 { "disagreement" } else { "disagreements" };
        let mut out = format!(
            "{bodies} {noun}: {proved} proved, {confirmed}{refuted} refuted, {undecided} undecided, \
             {disagreements} {differ}"
        );
        if errors > 0 {
            let rows = if errors == 1 { "row" } else { "rows" };
            out.push_str(&format!("; {errors} {rows} without results"));
        }
        out + "\n"
    }

    /// Renders a table for a terminal, and below it the mistakes and warnings of rows.
    pub fn text(&self) -> String {
        let has_confirmed = self.summary().counts.confirmed > 0;
        let is_counted = |title: &str| title != "confirmed" || has_confirmed;
        let mut titles = vec!["row".to_string()];
        titles.extend(self.names());
        let columns = titles.len();
        let counts = titles_of(&Counts::default().named()).into_iter();
        titles.extend(counts.filter(|title| is_counted(title)));
        if self.has_invariants {
            titles.extend(Invariants::SHOWN.map(String::from));
        }
        let width = titles.len();
        let mut lines = vec![titles];
        let mut mistakes = String::new();
        for body in self.bodies {
            let mut cells = vec![body.row.to_string()];
            cells.extend(body.settings.iter().map(|(_, value)| value.replace('\n', " ")));
            cells.resize(columns, String::new());
            match &body.found {
                Ok(found) => {
                    let counts = Counts::of(found).named().into_iter();
                    let counts = counts.filter(|(title, _)| is_counted(title));
                    cells.extend(counts.map(|(_, count)| count.to_string()));
                    let texts = found.invariants.iter().flat_map(Invariants::named);
                    let texts = texts.filter(|(title, _)| Invariants::SHOWN.contains(title));
                    cells.extend(texts.map(|(_, text)| text));
                    for warning in &found.warnings {
                        mistakes.push_str(&format!("warning: line {}: {warning}\n", body.line));
                    }
                }
                Err(reasons) => {
                    cells.push("–".to_string());
                    cells.resize(width, String::new());
                    for RowMistake { message, help } in reasons {
                        mistakes.push_str(&format!("error: line {}: {message}\n", body.line));
                        let help = help.iter().map(|help| format!("help: {help}\n"));
                        mistakes.extend(help);
                    }
                }
            }
            lines.push(cells);
        }
        format!("{}\n{}{}{mistakes}", self.title, aligned(&lines), self.summary_line())
    }
}

/// Titles of values.
fn titles_of<T>(named: &[(&'static str, T)]) -> Vec<String> {
    named.iter().map(|(title, _)| title.to_string()).collect()
}

/// Line of CSV.
fn line(fields: &[String]) -> String {
    fields.iter().map(|field| quoted(field)).collect::<Vec<_>>().join(",") + "\n"
}

/// Lines with their cells below each other.
fn aligned(lines: &[Vec<String>]) -> String {
    let columns = lines.first().map_or(0, Vec::len);
    let length = |text: &String| text.chars().count();
    let widths: Vec<usize> = (0..columns)
        .map(|k| lines.iter().filter_map(|cells| cells.get(k)).map(length).max().unwrap_or(0))
        .collect();
    let mut out = String::new();
    for cells in lines {
        let padded = cells.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}"));
        out.push_str(padded.collect::<Vec<_>>().join("  ").trim_end());
        out.push('\n');
    }
    out
}
