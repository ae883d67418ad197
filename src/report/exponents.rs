//! `exponents`: what a motion looks like, with the numbers that say so.

use serde_json::{Value, json};

use crate::flow::{Estimate, Exponents};

/// One line a start.
pub fn text(title: &str, rows: &[(String, Exponents)]) -> String {
    let mut out = format!("{title}\n");
    let shown = |estimate: Estimate| format!("{:+.5} ± {:.5}", estimate.mean, estimate.error);
    for (name, found) in rows {
        out.push_str(&format!(
            "{name}\n  t = {}: {}\n  largest exponent {} (later half {:+.5})\n  \
             mean divergence  {} (later half {:+.5})\n",
            found.time,
            found.character.name(),
            shown(found.largest),
            found.largest.later,
            shown(found.divergence),
            found.divergence.later,
        ));
    }
    out
}

/// The same as JSON.
pub fn json(title: &str, rows: &[(String, Exponents)]) -> Result<String, serde_json::Error> {
    let estimate = |estimate: Estimate| json!({ "mean": estimate.mean, "error": estimate.error, "later": estimate.later });
    let rows: Vec<Value> = rows
        .iter()
        .map(|(name, found)| {
            json!({
                "start": name,
                "time": found.time,
                "character": found.character.name(),
                "largest": estimate(found.largest),
                "divergence": estimate(found.divergence),
            })
        })
        .collect();
    serde_json::to_string_pretty(&json!({ "title": title, "motions": rows }))
}
