//! What a search counted, found and excluded, for people and as JSON.

use serde_json::json;

use crate::search::Report;

/// The report as JSON.
pub fn json(title: &str, report: &Report) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(&json!({
        "title": title,
        "counts": report.counts,
        "found": report.found,
        "excluded": report.excluded,
        "second_opinions": report.opinions,
        "conditions": report.conditions,
        "remarks": report.remarks,
        "unreached": report.unreached,
    }))
}

/// The report as text.
pub fn text(title: &str, report: &Report) -> String {
    let mut out = format!("{title}\n");
    if !report.counts.is_empty() {
        out.push_str("\nintegrals polynomial in the velocities, with any smooth coefficients:\n");
    }
    for count in &report.counts {
        let degree = match count.mixed {
            true => format!("up to degree {}", count.degree),
            false => format!("of degree {}", count.degree),
        };
        let known = match (count.dimension.saturating_sub(count.known), count.free) {
            (0, _) if count.dimension == 0 => "none".to_string(),
            (0, false) => "all known".to_string(),
            (0, true) => "powers of the energy".to_string(),
            (new, false) => format!("{new} of them not known"),
            (new, true) => format!("{new} of them no power of the energy"),
        };
        let motion = if count.free { "free motion, " } else { "" };
        out.push_str(&format!(
            "  {motion}{degree:<16} {:>3}   {known}   ({} unknowns, {} equations)\n",
            count.dimension, count.unknowns, count.equations
        ));
    }
    for found in &report.found {
        out.push_str(&format!("\n{} {}\n  {}\n", found.kind, found.verdict.word(), found.formula));
        for (name, text) in &found.abbreviations {
            out.push_str(&format!("    {name} = {text}\n"));
        }
        if let Some(proof) = &found.evidence.proof {
            out.push_str(&format!("  {proof}\n"));
        }
        if let Some(known) = &found.known {
            out.push_str(&format!("  a function of what the case claims: {known}\n"));
        }
    }
    if report.found.is_empty() && report.unreached.is_empty() {
        out.push_str("\nnothing was found among the terms that were tried\n");
    }
    for excluded in &report.excluded {
        out.push_str(&format!("\ntheorem\n  {}\n", excluded.theorem));
    }
    for opinion in &report.opinions {
        let Some(zero) = opinion.largest_zero else { continue };
        let verdict = if opinion.agrees() { "agree" } else { "DO NOT AGREE" };
        out.push_str(&format!(
            "\nsecond opinion, terms over {}: the singular values of {} terms at {} states in f64 {verdict} \
             with {} relations: {:.1e}, then {zero:.1e}\n",
            opinion.denominator, opinion.terms, opinion.states, opinion.relations, opinion.smallest
        ));
    }
    for condition in &report.conditions {
        out.push_str(&format!("\ncondition for: {}\n", condition.of));
        for equation in &condition.equations {
            out.push_str(&format!("  {equation}\n"));
        }
        out.push_str(&format!("  ({})\n", condition.grounds));
    }
    for remark in &report.remarks {
        out.push_str(&format!("\nnote: {remark}\n"));
    }
    if !report.unreached.is_empty() {
        out.push_str("\nthe search was stopped; it did not reach:\n");
        report.unreached.iter().for_each(|part| out.push_str(&format!("  {part}\n")));
    }
    out.trim_end().to_string()
}
