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
        "remarks": report.remarks,
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
        let known = match (count.known, count.mixed) {
            (0, _) => "none known".to_string(),
            (known, false) => format!("{known} a power of the energy"),
            (known, true) => format!("{known} of them constants and powers of the energy"),
        };
        out.push_str(&format!(
            "  {degree:<16} {:>3}   {known}   ({} unknowns, {} equations)\n",
            count.dimension, count.unknowns, count.equations
        ));
    }
    for found in &report.found {
        out.push_str(&format!("\n{} {}\n  {}\n", found.kind, found.verdict.word(), found.formula));
        if let Some(proof) = &found.evidence.proof {
            out.push_str(&format!("  {proof}\n"));
        }
        if let Some(known) = &found.known {
            out.push_str(&format!("  a function of what the case claims: {known}\n"));
        }
    }
    if report.found.is_empty() {
        out.push_str("\nnothing was found among the terms that were tried\n");
    }
    for excluded in &report.excluded {
        out.push_str(&format!("\ntheorem\n  {}\n", excluded.theorem));
    }
    for remark in &report.remarks {
        out.push_str(&format!("\nnote: {remark}\n"));
    }
    out.trim_end().to_string()
}
