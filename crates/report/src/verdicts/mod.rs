//! Verdicts of a run as one table for a paper: a row for each claim, in the order of the files.
//!
//! ```text
//! RunReport ─▶ VerdictTable ─▶ LaTeX, Markdown, HTML
//! ```

mod html;
mod latex;
mod markdown;

pub use markdown::inline;

use liouville::formula::Layout;
use liouville::verdict::{ClaimReport, Evidence, Verdict};

use super::{FileOutcome, RunReport, VERSION, counted};

/// Titles of the columns.
const COLUMNS: [&str; 5] = ["claim", "kind", "statement", "verdict", "evidence"];

/// Verdicts of a run, case by case.
pub struct VerdictTable<'r> {
    cases: Vec<CaseRows<'r>>,
    /// Counts, version and seed.
    caption: String,
}

/// A case with the rows of its claims.
struct CaseRows<'r> {
    title: &'r str,
    source: &'r str,
    rows: Vec<VerdictRow<'r>>,
    /// Mistakes of a file that could not be judged.
    mistakes: Vec<String>,
}

/// A claim with its verdict.
struct VerdictRow<'r> {
    /// Name; empty where it repeats the statement.
    name: &'r str,
    kind: &'static str,
    statement: RowStatement<'r>,
    /// Parts of the statement besides its formula, as a cofactor.
    particulars: &'r str,
    /// Source, if the claim has one of its own.
    source: &'r str,
    verdict: &'static str,
    evidence: String,
    /// Whether the verdict is as the file expects.
    agrees: bool,
}

/// Statement of a claim in its row.
enum RowStatement<'r> {
    /// A formula as boxes.
    Formula(&'r Layout),
    /// The statement as typed.
    Typed(&'r str),
}

impl<'r> VerdictTable<'r> {
    /// Collects the verdicts of a run whose headings have the statements of all claims.
    pub fn of(run: &'r RunReport) -> Self {
        let summary = run.summary();
        let counts = [
            (summary.proved, "proved"),
            (summary.confirmed, "confirmed"),
            (summary.refuted, "refuted"),
            (summary.undecided, "undecided"),
        ];
        let counts = counts.iter().filter(|(count, _)| *count > 0);
        let counts: Vec<String> = counts.map(|(count, word)| format!("{count} {word}")).collect();
        let all = [counted(summary.cases, "case"), counted(summary.claims, "claim")].join(", ");
        let caption = match counts.is_empty() {
            true => format!("{all}. liouville {VERSION}, seed {}.", run.seed),
            false => {
                format!("{all}: {}. liouville {VERSION}, seed {}.", counts.join(", "), run.seed)
            }
        };
        Self { cases: run.outcomes.iter().map(CaseRows::of).collect(), caption }
    }

    /// Renders a LaTeX document for any LaTeX.
    pub fn latex(&self) -> String {
        latex::render(self)
    }

    /// Renders a Markdown table.
    pub fn markdown(&self) -> String {
        markdown::render(self)
    }

    /// Renders a web page with formulas in MathML.
    pub fn html(&self) -> String {
        html::render(self)
    }
}

impl<'r> CaseRows<'r> {
    fn of(outcome: &'r FileOutcome) -> Self {
        let title = match outcome.heading.title.is_empty() {
            true => outcome.path.as_str(),
            false => outcome.heading.title.as_str(),
        };
        let source = outcome.heading.source.as_str();
        let (rows, mistakes) = match &outcome.result {
            Ok(report) => {
                let row = |claim| VerdictRow::of(outcome, claim);
                (report.claims.iter().map(row).collect(), Vec::new())
            }
            Err(failures) => (Vec::new(), failures.iter().map(|own| own.message.clone()).collect()),
        };
        Self { title, source, rows, mistakes }
    }
}

impl<'r> VerdictRow<'r> {
    fn of(outcome: &'r FileOutcome, claim: &'r ClaimReport) -> Self {
        let typed = claim.formula.as_deref().unwrap_or_default();
        let is_repeated = claim.name == typed || claim.name == claim.kind;
        let is_own = claim.source != outcome.heading.source;
        Self {
            name: if is_repeated { "" } else { &claim.name },
            kind: claim.kind,
            statement: match outcome.heading.statements.get(&claim.name) {
                Some(layout) => RowStatement::Formula(layout),
                None => RowStatement::Typed(typed),
            },
            particulars: outcome.heading.particulars.get(&claim.name).map_or("", String::as_str),
            source: if is_own { &claim.source } else { "" },
            verdict: claim.verdict.word(),
            evidence: evidence(claim.verdict, &claim.evidence),
            agrees: claim.agrees,
        }
    }
}

/// Evidence in a few words: how it was proved, or where it fails.
fn evidence(verdict: Verdict, evidence: &Evidence) -> String {
    let method = evidence.method.to_string();
    match (verdict, &evidence.proof, &evidence.witness) {
        (Verdict::Proved, Some(proof), _) => {
            format!("{method}, error < 2^{:.0}", proof.error_log2)
        }
        (Verdict::Confirmed, ..) if evidence.samples > 0 => {
            format!("{method}, {}", counted(evidence.samples, "state"))
        }
        (Verdict::Refuted, _, Some(witness)) => match witness.index {
            Some(index) => format!("residual {:.1e} at state {index}", witness.residual),
            None => format!("residual {:.1e} at a state that was found", witness.residual),
        },
        (Verdict::Undecided, ..) => evidence.reason.clone().unwrap_or_default(),
        _ => method,
    }
}

/// Text in one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A statement and what it leaves out, of which one may be empty.
fn joined(parts: [String; 2]) -> String {
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ")
}
