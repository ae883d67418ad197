//! Report of `eval`: everything at one state, as JSON with decimal strings or as text.

use serde_json::{Map, Value, json};

use liouville::verdict::{Digits, Enclosed, PointReport};

/// A number of a report in decimal notation.
pub trait Decimal {
    /// Decimal form of the number, if it is defined.
    fn number(&self) -> Option<String>;

    /// Bound on its error; `None` where all digits printed are right.
    fn error(&self) -> Option<f64>;
}

impl Decimal for Enclosed {
    fn number(&self) -> Option<String> {
        self.map(|(mid, _)| decimal(mid))
    }

    fn error(&self) -> Option<f64> {
        self.map(|(_, error)| error)
    }
}

impl Decimal for Digits {
    fn number(&self) -> Option<String> {
        self.clone()
    }

    fn error(&self) -> Option<f64> {
        None
    }
}

/// Renders the report as JSON; numbers are decimal strings, null where undefined.
pub fn json<N: Decimal>(report: &PointReport<N>) -> Result<String, serde_json::Error> {
    let list = |values: &[N]| Value::from(values.iter().map(number).collect::<Vec<_>>());
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
            let mut entry = json!({ "value": numbers(value), "residual": numbers(residual) });
            if let Some(error) = residual.iter().filter_map(Decimal::error).reduce(f64::max) {
                entry["residual_error"] = decimal(error).into();
            }
            (name.clone(), entry)
        })
        .collect();
    let mut root = Map::new();
    root.insert("parameters".into(), named(&report.parameters));
    root.insert("state".into(), named(&report.state));
    root.insert("level".into(), Value::Object(level));
    if let Some(determinant) = &report.determinant {
        root.insert("image".into(), list(&report.field));
        root.insert("determinant".into(), number(determinant));
    } else {
        root.insert("field".into(), list(&report.field));
        root.insert("divergence".into(), number(&report.divergence));
        root.insert("level_divergence".into(), number(&report.level_divergence));
    }
    if let Some(chi) = &report.chi {
        root.insert("chi".into(), list(chi));
    }
    if let Some(criterion) = &report.criterion {
        root.insert("criterion".into(), number(criterion));
    }
    if let Some(conditions) = &report.conditions {
        root.insert("conditions".into(), list(conditions));
    }
    if let Some(energy) = &report.energy {
        root.insert("energy".into(), number(energy));
    }
    if !report.antiderivatives.is_empty() {
        root.insert("antiderivatives".into(), json!(report.antiderivatives));
    }
    root.insert("claims".into(), Value::Object(claims));
    serde_json::to_string_pretty(&Value::Object(root))
}

/// Renders the report as text: each number with the bound on its error.
pub fn text<N: Decimal>(report: &PointReport<N>) -> String {
    let mut out = String::new();
    let mut line = |name: &str, value: String| out.push_str(&format!("{name:<18} {value}\n"));
    for (name, values) in report.parameters.iter().chain(&report.state) {
        line(name, values.join(", "));
    }
    for (equation, value) in &report.level {
        line(equation, format!("off by {}", shown(value)));
    }
    let rates: Vec<String> = report.field.iter().map(|rate| shown(rate)).collect();
    let rates = rates.join("\n                   ");
    if let Some(determinant) = &report.determinant {
        line("image", rates);
        line("det DΦ", shown(determinant));
    } else {
        line("field", rates);
        line("divergence", shown(&report.divergence));
        line("  on the level", shown(&report.level_divergence));
    }
    if let Some(chi) = &report.chi {
        line(
            "χ",
            chi.iter()
                .map(|component| shown(component))
                .collect::<Vec<_>>()
                .join("\n                   "),
        );
    }
    if let Some(criterion) = &report.criterion {
        line("criterion", shown(criterion));
    }
    if let Some([along, across]) = &report.conditions {
        line("C1", shown(along));
        line("C2", shown(across));
    }
    if let Some(energy) = &report.energy {
        line("energy", shown(energy));
    }
    if !report.antiderivatives.is_empty() {
        let values = report.antiderivatives.join(", ");
        line("∫", format!("{values}, put in: the constant is free, and values below contain it"));
    }
    for (name, value, residual) in &report.claims {
        let all = |values: &[N]| values.iter().map(|x| shown(x)).collect::<Vec<_>>().join(", ");
        let known = value.iter().any(|value| value.number().is_some());
        let value = if known { format!("  value {}", all(value)) } else { String::new() };
        line("claim", name.to_string());
        line("", format!("residual {}{value}", all(residual)));
    }
    out
}

/// JSON of a number, a list of components, or null.
fn numbers<N: Decimal>(values: &[N]) -> Value {
    match values {
        [] => Value::Null,
        [value] => number(value),
        _ => values.iter().map(number).collect(),
    }
}

fn number(value: &impl Decimal) -> Value {
    value.number().map_or(Value::Null, Value::String)
}

/// Shortest decimal that reads back as the same f64.
fn decimal(value: f64) -> String {
    format!("{value:?}")
}

fn shown(value: &impl Decimal) -> String {
    match (value.number(), value.error()) {
        (Some(number), Some(error)) => format!("{number} ± {error:.1e}"),
        (Some(number), None) => number,
        (None, _) => "undefined".to_string(),
    }
}
