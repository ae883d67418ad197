//! Report of `search`: what was counted, found and excluded, as text and as JSON.

use serde_json::json;

use liouville_search::{FoundKind, Given, MultiplierReport, SearchReport};

/// Renders the report as JSON.
pub fn json(title: &str, report: &SearchReport) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(&json!({
        "title": title,
        "counts": report.counts,
        "multipliers": report.multipliers,
        "orbits": report.orbits,
        "found": report.found,
        "excluded": report.excluded,
        "second_opinions": report.opinions,
        "conditions": report.conditions,
        "remarks": report.remarks,
        "unreached": report.unreached,
    }))
}

/// Renders the report as text.
pub fn text(title: &str, report: &SearchReport) -> String {
    let mut out = format!("{title}\n");
    if let Some(first) = report.counts.first() {
        let and = if first.mixed { " and constants" } else { "" };
        out.push_str(&format!(
            "\nlinearly independent integrals polynomial in the velocities, with any smooth coefficients, \
             products{and} included:\n"
        ));
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
            (1, false) if report.is_complete => "1 of them a function of those known".to_string(),
            (new, false) if report.is_complete => format!("{new} of them functions of those known"),
            (new, false) => format!("at most {new} of them not known"),
            (1, true) => "1 of them is not a power of the energy".to_string(),
            (new, true) => format!("{new} of them are not powers of the energy"),
        };
        let motion = if count.free { "free motion, " } else { "" };
        out.push_str(&format!(
            "  {motion}{degree:<16} {:>3}   {known}   ({} unknowns, {} equations)\n",
            count.dimension, count.unknowns, count.equations
        ));
    }
    out.push_str(&multipliers(&report.multipliers));
    if let Some(last) = report.orbits.last() {
        out.push_str(&format!("\n{}\n", last.sentence()));
    }
    for found in &report.found {
        out.push_str(&format!("\n{} {}\n  {}\n", found.kind, found.verdict.word(), found.text()));
        for own in &found.with {
            let relation = match own {
                // Its source, and no condition.
                Given::Bracket(_) | Given::DerivativeAlong(_) => "as",
                _ => "with",
            };
            out.push_str(&format!("  {relation} the {} {}\n", own.name(), own.text()));
        }
        if found.kind == FoundKind::FurtherIntegral {
            out.push_str(
                "  near almost every state a function of the integrals known, though no polynomial in \
                 them of its degree\n",
            );
        }
        for (name, text) in &found.abbreviations {
            out.push_str(&format!("    {name} = {text}\n"));
        }
        if let Some(proof) = &found.evidence.proof {
            out.push_str(&format!("  {proof}\n"));
        }
        if let Some(remark) = &found.evidence.remark {
            out.push_str(&format!("  {remark}\n"));
        }
        if let Some(known) = &found.known {
            out.push_str(&format!("  a function of what the case claims: {known}\n"));
        }
    }
    if report.found.is_empty() && report.unreached.is_empty() {
        out.push_str("\nno invariant was found among the terms tried\n");
    }
    for excluded in &report.excluded {
        out.push_str(&format!("\ntheorem\n  {}\n", excluded.theorem));
    }
    for opinion in &report.opinions {
        let Some(zero) = opinion.largest_zero else { continue };
        let verdict = if opinion.agrees() { "agrees with" } else { "contradicts" };
        let (vanish, relations) = match opinion.relations {
            1 => ("1 singular value vanishes".to_string(), "1 relation".to_string()),
            more => (format!("{more} singular values vanish"), format!("{more} relations")),
        };
        let over = match opinion.denominator.as_str() {
            "1" => String::new(),
            denominator => format!(" over {denominator}"),
        };
        out.push_str(&format!(
            "\ncross-check in floating point, on the rates of {} terms{over} at {} states: {vanish} \
             (at most {zero:.1e}, the others at least {:.1e}), which {verdict} {relations} modulo a \
             prime\n",
            opinion.terms, opinion.states, opinion.smallest
        ));
    }
    for condition in &report.conditions {
        out.push_str(&format!("\ncondition for: {}\n", condition.of));
        for equation in &condition.equations {
            out.push_str(&format!("  {equation}\n"));
        }
        if condition.equations.is_empty() {
            out.push_str("  no equation was found\n");
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

/// Lists the counts of densities P^(1/α): nonzero ones singly, the others together.
fn multipliers(counts: &[MultiplierReport]) -> String {
    let mut out = String::new();
    if !counts.is_empty() {
        out.push_str(
            "\ndensities P^(1/α), P polynomial in the velocities, with any smooth coefficients:\n",
        );
    }
    for free in [true, false] {
        let own = || counts.iter().filter(move |count| count.free == free);
        let motion = if free { "free motion, " } else { "" };
        // The count ends with the first degree at which a density is not excluded.
        let excess = own().find(|count| count.dimension > 0).map(|count| count.degree);
        let last = own().map(|count| count.degree).max();
        let empty = match excess {
            Some(degree) => degree.checked_sub(1),
            None => last,
        };
        out.push_str(&match empty {
            None => String::new(),
            Some(0) => format!("  {motion}of the configuration: none\n"),
            Some(degree) => {
                format!("  {motion}of degree at most {degree}, α = ±1, ±2, ±3, ±4: none\n")
            }
        });
        for count in own().filter(|count| count.dimension > 0) {
            out.push_str(&match count.alpha {
                None => format!("  {motion}of the configuration: at most {}\n", count.dimension),
                Some(alpha) => format!(
                    "  {motion}of degree {}, α = {alpha}: at most {}\n",
                    count.degree, count.dimension
                ),
            });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use liouville_search::{CountReport, OrbitReport};

    use super::*;

    #[test]
    fn numbers_say_what_is_counted() {
        let count = |dimension, known| CountReport {
            degree: 2,
            mixed: true,
            free: false,
            dimension,
            known,
            unknowns: 5,
            equations: 6,
        };
        let mut report = SearchReport::default();
        report.counts = vec![count(7, 6)];
        let header = "linearly independent integrals polynomial in the velocities, with any smooth \
                      coefficients, products and constants included:\n";
        assert!(text("x", &report).contains(header));
        assert!(text("x", &report).contains("  7   at most 1 of them not known"));
        report.is_complete = true;
        assert!(text("x", &report).contains("  7   1 of them a function of those known"));
        report.counts = vec![count(8, 6), CountReport { mixed: false, ..count(2, 2) }];
        assert!(text("x", &report).contains("  8   2 of them functions of those known"));
        report.counts.remove(0);
        assert!(text("x", &report).contains("products included:"), "constants are of degree 0");
        let (degree, monomials, variables) = (2, 15, Vec::new());
        let orbit = OrbitReport { degree, monomials, relations: 1, integrals: 1, variables };
        report.orbits = vec![orbit];
        let own = "1 relation between the 15 monomials of degree at most 2 along an orbit: 1 algebraic integral\n";
        assert!(text("x", &report).contains(own));
        report.orbits[0].relations = 0;
        let own = "no relation between the 15 monomials of degree at most 2 holds along an orbit\n";
        assert!(text("x", &report).contains(own));
    }
}
