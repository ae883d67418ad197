//! Report of `growth`: time and memory by size, as a table, JSON and CSV.

use std::fmt::Write;

use liouville_lab::growth::{FamilyGrowth, SizePoint};

/// Renders the families as text: a table each, and the exponents below it.
pub fn text(families: &[FamilyGrowth]) -> String {
    let mut out = String::new();
    for growth in families {
        // a `String` takes all that is written to it
        _ = writeln!(
            out,
            "{}\n{:>12} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}",
            growth.family,
            growth.counts,
            "operations",
            "nodes",
            "read",
            "record",
            "judge",
            "memory"
        );
        for point in &growth.points {
            let memory = point
                .memory
                .map_or("–".to_string(), |bytes| format!("{:.0} MB", bytes as f64 / 1e6));
            let lost = match point.claims - point.holding {
                0 => String::new(),
                lost => format!("  {lost} of {} claims not shown to hold", point.claims),
            };
            _ = writeln!(
                out,
                "{:>12} {:>10} {:>10} {:>10} {:>10} {:>10} {memory:>10}{lost}",
                point.size,
                point.operations,
                point.nodes,
                seconds(point.read),
                seconds(point.record),
                seconds(point.judge),
            );
        }
        if let Some(problem) = &growth.problem {
            _ = writeln!(out, "{problem}");
        }
        let exponents = growth.exponents;
        let of = |exponent: Option<f64>| exponent.map_or("–".to_string(), |e| format!("{e:.2}"));
        _ = writeln!(
            out,
            "exponents: operations in size {}, recording in operations {}, all in operations {}, \
             all in size {}\n",
            of(exponents.operations),
            of(exponents.record),
            of(exponents.judge),
            of(exponents.size)
        );
    }
    out
}

/// Formats a duration with three figures.
fn seconds(value: f64) -> String {
    match value {
        v if v < 1e-3 => format!("{:.0} µs", v * 1e6),
        v if v < 1.0 => format!("{:.1} ms", v * 1e3),
        v => format!("{v:.2} s"),
    }
}

/// Renders the families as JSON.
pub fn json(families: &[FamilyGrowth]) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(families)
}

/// Renders a header, and a line for each measurement.
pub fn csv(families: &[FamilyGrowth]) -> String {
    let mut out =
        String::from("family,size,operations,nodes,read,record,judge,memory,claims,holding\n");
    for growth in families {
        for point in &growth.points {
            let SizePoint { size, operations, nodes, read, record, judge, claims, holding, .. } =
                point;
            let memory = point.memory.map_or(String::new(), |bytes| bytes.to_string());
            // a `String` takes all that is written to it
            _ = writeln!(
                out,
                "{},{size},{operations},{nodes},{read:.6},{record:.6},{judge:.6},{memory},{claims},\
                 {holding}",
                growth.family
            );
        }
    }
    out
}
