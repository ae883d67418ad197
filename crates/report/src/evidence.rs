//! Evidence of `check -v`: formula, climb, witness and reasons of each claim.

use liouville::verdict::{CaseReport, DensitySign, EquationsSize, Measurement, Method, Witness};

/// Decimal places of measured numbers.
const ALL: f64 = 15.0;

/// Formats a number with its error, to the digits that the error leaves, and the statement about
/// it.
pub fn measured(found: &Measurement, most: f64) -> String {
    let stated = found.stated.as_ref().map_or(String::new(), |text| format!(" [{text}]"));
    let places = (1.0 - libm::floor(libm::log10(found.error))).clamp(0.0, most) as usize;
    let (quantity, error) = (&found.quantity, found.error);
    // without the sign of a rounded zero
    let value = if found.value.abs() < error { found.value.abs() } else { found.value };
    format!("{quantity} {value:.places$} ± {error:.0e}{stated}")
}

/// Renders the size of the equations of motion: all operations, those of each part that the case
/// has, and the parts that were not recorded because it has none of them.
pub fn equations(size: &EquationsSize) -> String {
    let mut out = format!("equations: {} operations", size.operations);
    let own = size.parts.iter().filter_map(|(part, share)| Some((part.name(), (*share)?)));
    for (index, (name, share)) in own.enumerate() {
        let before = if index == 0 { ", of which " } else { ", " };
        out.push_str(&format!("{before}{name} {share}"));
    }
    let absent: Vec<&str> = size
        .parts
        .iter()
        .filter(|(_, share)| share.is_none())
        .map(|(part, _)| part.name())
        .collect();
    if !absent.is_empty() {
        out.push_str(&format!("; not recorded: {}", absent.join(", ")));
    }
    out
}

/// Renders the evidence for each claim of the case at `path`.
pub fn details(path: &str, report: &CaseReport) -> String {
    let mut out = String::new();
    for claim in &report.claims {
        out.push_str(&format!("    {}\n", claim.name));
        if let Some(formula) = claim.formula.as_ref().filter(|formula| **formula != claim.name) {
            out.push_str(&format!("      formula   {formula}\n"));
        }
        let evidence = &claim.evidence;
        if evidence.measured.is_empty() && evidence.method != Method::Count {
            out.push_str(&format!(
                "      residual  {} operations per state\n",
                evidence.operations
            ));
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
            out.push_str(&format!("      rounding  at most {scaled:.3} of its error bound\n"));
        }
        if let Some(sign) = evidence.sign {
            let sign = match sign {
                DensitySign::Positive => "positive",
                DensitySign::Negative => "negative",
                DensitySign::Changes => "of both signs",
                DensitySign::ChangesWithParameters => "changes its sign with the parameters",
            };
            let extent = match (evidence.sign_is_proved, evidence.sign) {
                (true, Some(DensitySign::Changes)) => "at states with the same parameters",
                (true, _) if evidence.sign_may_vanish => "at all states at which it is not 0",
                (true, _) => "at all states",
                (false, _) if evidence.sign_is_partial => {
                    "at the states tried at which its value is known"
                }
                (false, _) => "at the states that were tried",
            };
            let line = match evidence.sign {
                Some(DensitySign::ChangesWithParameters) => sign.to_string(),
                _ => format!("{sign} {extent}"),
            };
            out.push_str(&format!("      sign      {line}\n"));
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
            out.push_str(&format!("                {}\n", command(path, witness)));
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

/// Writes the command that evaluates the case at a witness, for a shell.
pub fn command(path: &str, witness: &Witness) -> String {
    format!("liouville eval {} {}", shell_quoted(path), options(witness))
}

/// Writes the options of `eval` that name a witness, for a shell.
pub fn options(witness: &Witness) -> String {
    let set = witness.parameters.iter();
    let set =
        set.map(|(name, value)| format!("--set {} ", shell_quoted(&format!("{name}={value}"))));
    format!("{}--state {}", set.collect::<String>(), shell_quoted(&witness.state))
}

/// Quotes a word for a shell where it needs that.
pub fn shell_quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=+,:".contains(c);
    match !word.is_empty() && word.chars().all(is_plain) {
        true => word.to_string(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}
