//! Report of `eval`: everything at one state, as JSON with decimal strings or as text.

use serde_json::{Map, Value, json};

use liouville::mechanics::Model;
use liouville::verdict::{Digits, Enclosed, OVERFLOW, PointReport};

/// A number of a report in decimal notation.
pub trait Decimal {
    /// Whether numbers come with bounds on their errors; without, all digits printed are right.
    const HAS_ERRORS: bool;

    /// Decimal form of the number, or [`OVERFLOW`], if it is defined.
    fn number(&self) -> Option<String>;

    /// Bound on its error, if there is one.
    fn error(&self) -> Option<f64>;
}

impl Decimal for Enclosed {
    const HAS_ERRORS: bool = true;

    fn number(&self) -> Option<String> {
        self.map(|(mid, error)| match error.is_finite() {
            true => decimal(mid),
            false => OVERFLOW.to_string(),
        })
    }

    fn error(&self) -> Option<f64> {
        self.map(|(_, error)| error).filter(|error| error.is_finite())
    }
}

impl Decimal for Digits {
    const HAS_ERRORS: bool = false;

    fn number(&self) -> Option<String> {
        self.clone()
    }

    fn error(&self) -> Option<f64> {
        None
    }
}

/// Renders the report as JSON; numbers are decimal strings, `overflow` where they are too large, and
/// null where undefined. Bounds on errors stand beside them.
pub fn json<N: Decimal>(report: &PointReport<N>) -> Result<String, serde_json::Error> {
    let list = |values: &[N]| Value::from(values.iter().map(number).collect::<Vec<_>>());
    let errors = |values: &[N]| Value::from(values.iter().map(error).collect::<Vec<_>>());
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
            for (key, values) in [("value_error", value), ("residual_error", residual)] {
                let is_known = values.iter().all(|one| one.error().is_some());
                let largest = values.iter().filter_map(Decimal::error).reduce(f64::max);
                if let Some(error) = largest.filter(|_| is_known) {
                    entry[key] = decimal(error).into();
                }
            }
            (name.clone(), entry)
        })
        .collect();
    let mut root = Map::new();
    root.insert("parameters".into(), named(&report.parameters));
    root.insert("state".into(), named(&report.state));
    let mut bounds = Map::new();
    let mut insert = |key: &str, value: Value, error: Value| {
        root.insert(key.to_string(), value);
        bounds.insert(key.to_string(), error);
    };
    let level_errors: Map<String, Value> =
        report.level.iter().map(|(text, value)| (text.clone(), error(value))).collect();
    insert("level", Value::Object(level), Value::Object(level_errors));
    let field = if report.determinant.is_some() { "image" } else { "field" };
    insert(field, list(&report.field), errors(&report.field));
    if let Some(determinant) = &report.determinant {
        insert("determinant", number(determinant), error(determinant));
    } else {
        let (whole, level) = (&report.divergence, &report.level_divergence);
        insert("divergence", number(whole), error(whole));
        insert("level_divergence", number(level), error(level));
    }
    if let Some(chi) = &report.chi {
        insert("chi", list(chi), errors(chi));
    }
    if let Some(criterion) = &report.criterion {
        insert("criterion", number(criterion), error(criterion));
    }
    if let Some(conditions) = &report.conditions {
        insert("conditions", list(conditions), errors(conditions));
    }
    if let Some(energy) = &report.energy {
        insert("energy", number(energy), error(energy));
    }
    if N::HAS_ERRORS {
        root.insert("errors".into(), bounds.into());
    }
    if !report.antiderivatives.is_empty() {
        root.insert("antiderivatives".into(), json!(report.antiderivatives));
    }
    root.insert("claims".into(), Value::Object(claims));
    serde_json::to_string_pretty(&Value::Object(root))
}

/// Renders the report as text: each number with the bound on its error.
pub fn text<N: Decimal>(report: &PointReport<N>, model: &Model) -> String {
    let mut out = String::new();
    let mut line = |name: &str, value: String| out.push_str(&format!("{name:<18} {value}\n"));
    for ((name, values), parameter) in report.parameters.iter().zip(model.free_parameters()) {
        line(name, parameter.kind.as_setting(values));
    }
    for (name, values) in &report.state {
        line(name, values.join(", "));
    }
    for (equation, value) in &report.level {
        line(equation, format!("off by {}", shown(value)));
    }
    if report.level.iter().any(|(_, value)| is_off(value)) {
        line(
            "warning",
            "this state is off the level: claims on the level do not concern it".into(),
        );
    }
    let (word, prime) = if report.determinant.is_some() { ("image", "") } else { ("field", "'") };
    for (place, rate) in report.field.iter().enumerate() {
        let word = if place == 0 { word } else { "" };
        let name = model.component_name(place);
        line(&format!("{word:<5} {name}{prime}"), shown(rate));
    }
    if let Some(determinant) = &report.determinant {
        line("det DΦ", shown(determinant));
    } else {
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
    if all_values(report).iter().any(|value| value.number().as_deref() == Some(OVERFLOW)) {
        let further = if N::HAS_ERRORS { ": --digits 10 goes further than f64" } else { "" };
        let reason = "a number, or one that it is formed of, is too large, or too near 0";
        line("overflow", format!("{reason}{further}"));
    }
    out
}

/// Difference of the sides of an equation up to which a state counts as on the level.
const ON_LEVEL: f64 = 1e-9;

/// Whether a difference of sides is not 0 up to rounding of the given state.
fn is_off<N: Decimal>(value: &N) -> bool {
    let number = value.number().and_then(|number| number.parse::<f64>().ok());
    number.is_some_and(|number| number.abs() > ON_LEVEL + value.error().unwrap_or(0.0))
}

/// All numbers of a report.
fn all_values<N>(report: &PointReport<N>) -> Vec<&N> {
    let PointReport { field, divergence, level_divergence, .. } = report;
    let level = report.level.iter().map(|(_, value)| value);
    let claims = report.claims.iter().flat_map(|(_, value, residual)| value.iter().chain(residual));
    let single = [&report.determinant, &report.criterion, &report.energy].into_iter().flatten();
    let chi = report.chi.iter().flatten();
    let conditions = report.conditions.iter().flatten();
    level
        .chain(field)
        .chain([divergence, level_divergence])
        .chain(single)
        .chain(chi)
        .chain(conditions)
        .chain(claims)
        .collect()
}

/// JSON of the bound on the error of a number.
fn error(value: &impl Decimal) -> Value {
    value.error().map_or(Value::Null, |error| decimal(error).into())
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
        (Some(number), Some(error)) => {
            let value = number.parse::<f64>().unwrap_or(f64::NAN);
            match error {
                0.0 => whole(number),
                _ if value.abs() <= error => format!("0 ± {error:.1e}"),
                _ => format!("{number} ± {error:.1e}"),
            }
        }
        (Some(number), None) => whole(number),
        (None, _) => "undefined".to_string(),
    }
}

/// A number as it is written, 0 without decimals.
fn whole(number: String) -> String {
    if number == "0.0" || number == "-0.0" { "0".to_string() } else { number }
}
