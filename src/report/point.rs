//! `eval`: everything at one state, as JSON with decimal strings or as text.

use serde_json::{Map, Value, json};

use crate::verdict::{Enclosed, PointReport};

/// The report as JSON; numbers are decimal strings, null where undefined.
pub fn json(report: &PointReport) -> Result<String, serde_json::Error> {
    let list = |values: &[Enclosed]| Value::from(values.iter().map(number).collect::<Vec<_>>());
    let named = |entries: &[(String, Vec<String>)]| {
        let pair = |(name, values): &(String, Vec<String>)| (name.clone(), json!(values));
        Value::Object(entries.iter().map(pair).collect::<Map<String, Value>>())
    };
    let level: Map<String, Value> =
        report.level.iter().map(|(text, value)| (text.clone(), number(value))).collect();
    let claims: Map<String, Value> = report
        .claims
        .iter()
        .map(|(name, value, residual)| {
            let entry = json!({
                "value": number(value),
                "residual": number(residual),
                "residual_error": residual.map(|(_, error)| decimal(error)),
            });
            (name.clone(), entry)
        })
        .collect();
    let mut root = Map::new();
    root.insert("parameters".into(), named(&report.parameters));
    root.insert("state".into(), named(&report.state));
    root.insert("level".into(), Value::Object(level));
    root.insert("field".into(), list(&report.field));
    root.insert("divergence".into(), number(&report.divergence));
    root.insert("level_divergence".into(), number(&report.level_divergence));
    if let Some(chi) = &report.chi {
        root.insert("chi".into(), list(chi));
    }
    if let Some(criterion) = &report.criterion {
        root.insert("criterion".into(), number(criterion));
    }
    if let Some(energy) = &report.energy {
        root.insert("energy".into(), number(energy));
    }
    root.insert("claims".into(), Value::Object(claims));
    serde_json::to_string_pretty(&Value::Object(root))
}

/// The report for people: each number with the bound on its error.
pub fn text(report: &PointReport) -> String {
    let mut out = String::new();
    let mut line = |name: &str, value: String| out.push_str(&format!("{name:<18} {value}\n"));
    for (name, values) in report.parameters.iter().chain(&report.state) {
        line(name, values.join(", "));
    }
    for (equation, value) in &report.level {
        line(equation, format!("off by {}", shown(value)));
    }
    let rates: Vec<String> = report.field.iter().map(shown).collect();
    line("field", rates.join("\n                   "));
    line("divergence", shown(&report.divergence));
    line("  on the level", shown(&report.level_divergence));
    if let Some(chi) = &report.chi {
        line("χ", chi.iter().map(shown).collect::<Vec<_>>().join("\n                   "));
    }
    if let Some(criterion) = &report.criterion {
        line("criterion", shown(criterion));
    }
    if let Some(energy) = &report.energy {
        line("energy", shown(energy));
    }
    for (name, value, residual) in &report.claims {
        let value = value.map_or(String::new(), |value| format!("  value {}", shown(&Some(value))));
        line("claim", name.to_string());
        line("", format!("residual {}{value}", shown(residual)));
    }
    out
}

fn number(value: &Enclosed) -> Value {
    value.map_or(Value::Null, |(mid, _)| Value::String(decimal(mid)))
}

/// The shortest decimal that reads back as the same f64.
fn decimal(value: f64) -> String {
    format!("{value:?}")
}

fn shown(value: &Enclosed) -> String {
    match value {
        Some((mid, error)) => format!("{} ± {error:.1e}", decimal(*mid)),
        None => "undefined".to_string(),
    }
}
