//! Report of `check` on a terminal: one line for each claim, grouped by case, and a summary.

use comfy_table::{Cell, Color, ContentArrangement, Table, presets};

use super::evidence::{details, equations, measured};
use super::{FileOutcome, RunReport, counted, diagnostic};
use liouville::case::Expect;
use liouville::verdict::{
    CaseReport, ClaimReport, DensitySign, Independence, Measurement, Method, Verdict,
};

/// Decimal places of measured numbers in the table.
const SHOWN: f64 = 10.0;

/// Style of the output.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// Amount of detail.
    pub detail: Detail,
    /// Whether to use colours.
    pub colour: bool,
    /// Width of the terminal.
    pub width: u16,
}

/// Amount of detail of the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// The summary, cases that could not be judged, and verdicts against expectation.
    Summary,
    /// One line for each case, with the claims that are not proved or refuted as expected.
    Cases,
    /// All claims.
    Claims,
    /// All claims, with witnesses, notes and the climb to each verdict.
    Evidence,
}

/// Renders all cases of a run.
pub fn render(run: &RunReport, style: Style) -> String {
    let mut out = String::new();
    for outcome in &run.outcomes {
        if style.detail >= Detail::Claims || outcome.result.is_err() {
            out.push_str(&case(outcome, style));
            out.push('\n');
        } else {
            out.push_str(&line(outcome, style));
        }
    }
    if style.detail == Detail::Cases {
        out.push('\n');
    }
    out.push_str(&mutants(run));
    out.push_str(&summary(run));
    out
}

fn case(outcome: &FileOutcome, style: Style) -> String {
    let heading = &outcome.heading;
    let report = match &outcome.result {
        Err(failures) => return format!("{}\n", diagnostic::rendered(failures)),
        Ok(report) => report,
    };
    let mut out = format!("{}\n  {}", outcome.path, heading.title);
    if !heading.source.is_empty() {
        out.push_str(&format!(" — {}", heading.source));
    }
    out.push('\n');
    out.push_str(&remarks(report));
    if style.detail == Detail::Evidence {
        if let Some(digest) = &heading.digest {
            out.push_str(&format!("  digest: {digest}\n"));
        }
        if let Some(size) = &heading.equations {
            out.push_str(&format!("  {}\n", equations(size)));
        }
        for note in &heading.notes {
            out.push_str(&format!("  note: {note}\n"));
        }
    }
    let all: Vec<&ClaimReport> = report.claims.iter().collect();
    out.push_str(&claims(&all, &outcome.unreached, style));
    out.push('\n');
    if style.detail == Detail::Evidence {
        out.push_str(&details(&outcome.path, report));
    } else {
        out.push_str(&theorems(report));
    }
    out
}

/// Prints warnings and remarks.
fn remarks(report: &CaseReport) -> String {
    let warnings = report.warnings.iter().map(|text| format!("  warning: {text}\n"));
    let remarks = report.remarks.iter().map(|text| format!("  remark: {text}\n"));
    warnings.chain(remarks).collect()
}

/// Longest name of a claim in a table; the middle of a longer one is left out.
const LONGEST_NAME: usize = 400;

/// Name of a claim, short enough for a table.
fn short(name: &str) -> String {
    match name.chars().count() {
        count if count > LONGEST_NAME => {
            let start: String = name.chars().take(LONGEST_NAME / 2).collect();
            let end: String = name.chars().skip(count - LONGEST_NAME / 4).collect();
            format!("{start} … {end}")
        }
        _ => name.to_string(),
    }
}

/// Prints the theorems of claims of absence, for which no table has room.
fn theorems(report: &CaseReport) -> String {
    let stated = report.claims.iter().filter_map(|claim| {
        let theorem = claim.evidence.theorem.as_ref()?;
        Some(format!("    {}\n      theorem   {theorem}\n", claim.name))
    });
    stated.collect()
}

/// Renders a case as one line with the counts of its verdicts, followed by the claims that deserve
/// attention.
fn line(outcome: &FileOutcome, style: Style) -> String {
    let Ok(report) = &outcome.result else { return String::new() };
    let is_settled = |claim: &&ClaimReport| {
        claim.agrees && matches!(claim.verdict, Verdict::Proved | Verdict::Refuted)
    };
    let is_shown = |claim: &&ClaimReport| match style.detail {
        Detail::Summary => !claim.agrees,
        _ => !is_settled(claim),
    };
    let shown: Vec<&ClaimReport> = report.claims.iter().filter(is_shown).collect();
    let mut out = String::new();
    if style.detail != Detail::Summary || !shown.is_empty() {
        let count = |verdict: Verdict| {
            let number = report.claims.iter().filter(|claim| claim.verdict == verdict).count();
            (number > 0).then(|| format!("{number} {}", verdict.word()))
        };
        let counts = [Verdict::Proved, Verdict::Confirmed, Verdict::Refuted, Verdict::Undecided];
        let counts: Vec<String> = counts.into_iter().filter_map(count).collect();
        let counts = if counts.is_empty() { NO_CLAIMS.to_string() } else { counts.join(", ") };
        out.push_str(&format!("{}: {counts}\n", outcome.path));
    }
    if style.detail != Detail::Summary {
        out.push_str(&remarks(report));
    }
    if !shown.is_empty() {
        out.push_str(&claims(&shown, &outcome.unreached, style));
        out.push('\n');
    }
    out
}

/// Remark on a case without claims.
const NO_CLAIMS: &str = "no claims";

fn claims(claims: &[&ClaimReport], unreached: &[String], style: Style) -> String {
    if claims.is_empty() {
        return format!("      {NO_CLAIMS}");
    }
    let mut table = Table::new();
    table.set_header(["   ", "  verdict", "expected", "kind", "claim", "evidence", "source"]);
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_width(style.width);
    if style.colour {
        table.enforce_styling();
    } else {
        table.force_no_tty();
    }
    for claim in claims {
        let is_reached = !unreached.contains(&claim.name);
        let agrees = claim.agrees || !is_reached;
        let mark = if agrees { " " } else { "✗" };
        let mut verdict = Cell::new(format!("{mark} {}", claim.verdict.word()));
        if style.colour {
            verdict = verdict.fg(match (agrees, claim.verdict) {
                (false, _) => Color::Red,
                (true, Verdict::Undecided) => Color::Yellow,
                (true, _) => Color::Green,
            });
        }
        let expected = match claim.expect {
            expect if expect == Expect::Open || agrees => expect.word().to_string(),
            expect => format!("expected: {}", expect.word()),
        };
        table.add_row(vec![
            Cell::new("   "),
            verdict,
            Cell::new(expected),
            Cell::new(claim.kind),
            Cell::new(short(&claim.name)),
            Cell::new(remark(claim)),
            Cell::new(&claim.source),
        ]);
    }
    table.trim_fmt()
}

/// Remark on a verdict, in a few words.
fn remark(claim: &ClaimReport) -> String {
    let evidence = &claim.evidence;
    let mut words = Vec::new();
    match claim.verdict {
        _ if !evidence.measured.is_empty() => {
            let stated = |found: &&Measurement| {
                found.stated.is_some() || evidence.measured.iter().all(|one| one.stated.is_none())
            };
            words.extend(evidence.measured.iter().filter(stated).map(|one| measured(one, SHOWN)));
            words.extend(evidence.remark.clone());
            words.extend(evidence.reason.clone());
        }
        // The theorem stands below the table.
        Verdict::Proved if evidence.theorem.is_some() => {
            words.extend(evidence.remark.clone());
            words.push(evidence.method.to_string());
        }
        Verdict::Confirmed | Verdict::Proved => {
            let holds: Vec<String> = evidence.holds.iter().map(ToString::to_string).collect();
            words.push(holds.join("; "));
            match evidence.independence {
                Some(Independence::Constant) => words.push("constant on the level".to_string()),
                Some(Independence::General) => words.push("function of the energy".to_string()),
                _ => {}
            }
            match evidence.sign {
                Some(DensitySign::Changes) => {
                    words.push("changes sign, no positive measure: zeros or poles".to_string())
                }
                Some(DensitySign::ChangesWithParameters) => {
                    words.push("changes its sign with the parameters: take |ρ|".to_string())
                }
                Some(DensitySign::Negative) => words.push("negative: take −ρ".to_string()),
                _ => {}
            }
            words.extend(evidence.remark.clone());
            words.push(match &evidence.proof {
                Some(proof) => format!("{}, error < 2^{:.0}", evidence.method, proof.error_log2),
                None if evidence.samples > 0 => {
                    format!("{}, {}", evidence.method, counted(evidence.samples, "state"))
                }
                None => evidence.method.to_string(),
            });
        }
        Verdict::Refuted if evidence.exhibit.is_some() => words.extend(evidence.exhibit.clone()),
        Verdict::Refuted => {
            if let Some(witness) = &evidence.witness {
                let shown = witness.digits.clone();
                let shown = shown.unwrap_or_else(|| format!("{:.2e}", witness.residual));
                words.push(match witness.index {
                    Some(index) => format!("{shown} at state {index}"),
                    None => format!("{shown} at a state that was looked for"),
                });
                if evidence.method != Method::Ball {
                    words.push(evidence.method.to_string());
                }
            } else if evidence.method == Method::Motion {
                words.extend(evidence.reason.clone());
                words.push(evidence.method.to_string());
            } else {
                words.push(format!("on an open set of states, {}", evidence.method));
            }
            words.extend(evidence.remark.clone());
        }
        Verdict::Undecided => {}
    }
    if !evidence.measured.is_empty() {
        return words.join("; ");
    }
    if claim.verdict == Verdict::Undecided || (!claim.agrees && claim.verdict != Verdict::Refuted) {
        words.extend(evidence.reason.clone());
    }
    words.retain(|word| !word.is_empty());
    words.join(", ")
}

/// Lists the mutants that deserve attention.
fn mutants(run: &RunReport) -> String {
    let mut out = String::new();
    for (outcome, report) in run.mutants() {
        let marked = [("survived", &report.survived), ("discovered", &report.discovered)];
        for (word, list) in marked {
            for mutant in list {
                let (claim, change) = (&mutant.claim, &mutant.change);
                out.push_str(&format!(
                    "mutant {word}: {}, claim {claim}: {change}\n    {}\n",
                    outcome.path, mutant.formula
                ));
            }
        }
    }
    out
}

fn summary(run: &RunReport) -> String {
    let summary = run.summary();
    let count = |number: usize, noun: &str| counted(number, noun);
    let mut line = format!(
        "{}, {}: {} proved, {} confirmed, {} refuted, {} undecided; {} against expectation",
        count(summary.cases, "case"),
        count(summary.claims, "claim"),
        summary.proved,
        summary.confirmed,
        summary.refuted,
        summary.undecided,
        summary.disagreements,
    );
    if summary.errors > 0 {
        line.push_str(&format!("; {} could not be judged", count(summary.errors, "file")));
    }
    if summary.unreached > 0 {
        line.push_str(&format!("; {} not reached", count(summary.unreached, "claim")));
    }
    if summary.unreached_files > 0 {
        line.push_str(&format!("; {} not reached", count(summary.unreached_files, "file")));
    }
    if summary.motions_left > 0 {
        let left = count(summary.motions_left, "claim");
        line.push_str(&format!("; {left} about motion not judged (add --motion)"));
    }
    if let Some(mutants) = summary.mutants {
        line.push_str(&format!(
            "; mutants: {} killed, {} survived, {} equivalent, {} discovered",
            mutants.killed, mutants.survived, mutants.equivalent, mutants.discovered
        ));
    }
    format!("{line}; {:.2} s, seed {}\n", summary.seconds, run.seed)
}
