//! Report of `check` on a terminal: one line for each claim, grouped by case, and a summary.

use comfy_table::{Cell, Color, ContentArrangement, Table, presets};

use super::{Outcome, RunReport, diagnostic};
use liouville::case::Expect;
use liouville::verdict::{
    CaseReport, ClaimReport, Independence, Measurement, Method, Sign, Verdict,
};

/// Decimal places of measured numbers in the table, and with `-v`.
const SHOWN: f64 = 10.0;
const ALL: f64 = 15.0;

/// Style of the output.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// Whether to show witnesses, notes and the climb to each verdict.
    pub verbose: bool,
    /// Whether to use colours.
    pub colour: bool,
    /// Width of the terminal.
    pub width: u16,
}

/// Renders all cases of a run.
pub fn render(run: &RunReport, style: Style) -> String {
    let mut out = String::new();
    for outcome in &run.outcomes {
        out.push_str(&case(outcome, style));
        out.push('\n');
    }
    out.push_str(&mutants(run));
    out.push_str(&summary(run));
    out
}

fn case(outcome: &Outcome, style: Style) -> String {
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
    for warning in &report.warnings {
        out.push_str(&format!("  warning: {warning}\n"));
    }
    if style.verbose {
        for note in &heading.notes {
            out.push_str(&format!("  note: {note}\n"));
        }
    }
    out.push_str(&claims(report, style));
    out.push('\n');
    if style.verbose {
        out.push_str(&details(report));
    } else {
        out.push_str(&theorems(report));
    }
    out
}

/// Prints the theorems of claims of absence, for which no table has room.
fn theorems(report: &CaseReport) -> String {
    let stated = report.claims.iter().filter_map(|claim| {
        let theorem = claim.evidence.theorem.as_ref()?;
        Some(format!("    {}\n      theorem   {theorem}\n", claim.name))
    });
    stated.collect()
}

fn claims(report: &CaseReport, style: Style) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_width(style.width);
    if style.colour {
        table.enforce_styling();
    } else {
        table.force_no_tty();
    }
    for claim in &report.claims {
        let mark = if claim.agrees { "✓" } else { "✗" };
        let mut verdict = Cell::new(format!("{mark} {}", claim.verdict.word()));
        if style.colour {
            verdict = verdict.fg(match (claim.agrees, claim.verdict) {
                (false, _) => Color::Red,
                (true, Verdict::Undecided) => Color::Yellow,
                (true, _) => Color::Green,
            });
        }
        let expected = match claim.expect {
            expect if expect == Expect::Open || claim.agrees => expect.word().to_string(),
            expect => format!("expected: {}", expect.word()),
        };
        table.add_row(vec![
            Cell::new("   "),
            verdict,
            Cell::new(expected),
            Cell::new(claim.kind),
            Cell::new(&claim.name),
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
            words.push(evidence.holds.join("; "));
            match evidence.independence {
                Some(Independence::Constant) => words.push("trivial: constant there".to_string()),
                Some(Independence::General) => words.push("a general integral".to_string()),
                _ => {}
            }
            match evidence.sign {
                Some(Sign::Changes) => {
                    words.push("changes sign, no positive measure: zeros or poles".to_string())
                }
                Some(Sign::Negative) => words.push("negative: take −ρ".to_string()),
                _ => {}
            }
            words.extend(evidence.remark.clone());
            words.push(match &evidence.proof {
                Some(proof) => format!("{}, error < 2^{:.0}", evidence.method, proof.error_log2),
                None if evidence.samples > 0 => {
                    format!("{}, {} states", evidence.method, evidence.samples)
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
            } else {
                words.push(format!("at almost every state, {}", evidence.method));
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

/// Formats a number with its error, to the digits that the error leaves, and the statement about
/// it.
fn measured(found: &Measurement, most: f64) -> String {
    let stated = found.stated.as_ref().map_or(String::new(), |text| format!(" [{text}]"));
    let places = (1.0 - libm::floor(libm::log10(found.error))).clamp(0.0, most) as usize;
    let (quantity, error) = (&found.quantity, found.error);
    // without the sign of a rounded zero
    let value = if found.value.abs() < error { found.value.abs() } else { found.value };
    format!("{quantity} {value:.places$} ± {error:.0e}{stated}")
}

fn details(report: &CaseReport) -> String {
    let mut out = String::new();
    for claim in &report.claims {
        out.push_str(&format!("    {}\n", claim.name));
        if let Some(formula) = claim.formula.as_ref().filter(|formula| **formula != claim.name) {
            out.push_str(&format!("      formula   {formula}\n"));
        }
        let evidence = &claim.evidence;
        if evidence.measured.is_empty() && evidence.method != Method::Count {
            out.push_str(&format!("      residual  {} operations a state\n", evidence.operations));
        }
        for (index, found) in evidence.measured.iter().enumerate() {
            let label = if index == 0 { "measured" } else { "" };
            out.push_str(&format!("      {label:<9} {}\n", measured(found, ALL)));
        }
        for (index, rung) in evidence.climb.iter().enumerate() {
            let label = if index == 0 { "climb" } else { "" };
            out.push_str(&format!("      {label:<9} {}: {}\n", rung.rung, rung.found));
        }
        if let Some(scaled) = evidence.max_scaled_residual {
            out.push_str(&format!("      rounding  {scaled:.3} of its error bound at most\n"));
        }
        if let Some(sign) = evidence.sign {
            let sign = match sign {
                Sign::Positive => "positive",
                Sign::Negative => "negative",
                Sign::Changes => "of both signs",
            };
            let extent = match (evidence.sign_is_proved, evidence.sign) {
                (true, Some(Sign::Changes)) => "at states with the same parameters",
                (true, _) => "at all states",
                (false, _) => "at the states that were tried",
            };
            out.push_str(&format!("      sign      {sign} {extent}\n"));
        }
        if let Some(volume) = &evidence.volume {
            out.push_str(&format!("      volume    {volume}\n"));
        }
        if let Some(witness) = &evidence.witness {
            let shown = witness
                .digits
                .clone()
                .unwrap_or_else(|| format!("{:e} ± {:.1e}", witness.residual, witness.error_bound));
            out.push_str(&format!("      witness   residual {shown}\n"));
            let set =
                witness.parameters.iter().map(|(name, value)| format!(" --set '{name}={value}'"));
            out.push_str(&format!(
                "                eval …{} --state '{}'\n",
                set.collect::<String>(),
                witness.state
            ));
        }
        for (label, text) in [("theorem", &evidence.theorem), ("exhibit", &evidence.exhibit)] {
            if let Some(text) = text {
                out.push_str(&format!("      {label:<9} {text}\n"));
            }
        }
        if let Some(reason) = &evidence.reason {
            out.push_str(&format!("      reason    {reason}\n"));
        }
        if let Some(note) = &claim.note {
            out.push_str(&format!("      note      {note}\n"));
        }
    }
    out
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
    let count = |number: usize, noun: &str| match number {
        1 => format!("1 {noun}"),
        _ => format!("{number} {noun}s"),
    };
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
    if summary.motions_left > 0 {
        let left = count(summary.motions_left, "claim");
        line.push_str(&format!("; {left} about motion not looked at: add --motion"));
    }
    if let Some(mutants) = summary.mutants {
        line.push_str(&format!(
            "; mutants: {} killed, {} survived, {} equivalent, {} discovered",
            mutants.killed, mutants.survived, mutants.equivalent, mutants.discovered
        ));
    }
    format!("{line}; {:.2} s, seed {}\n", summary.seconds, run.seed)
}
