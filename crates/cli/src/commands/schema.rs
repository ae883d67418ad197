//! The command `liouville schema`: a JSON Schema of case files.
//!
//! The keys are those that the reader of case files names when it refuses another; what they mean
//! is taken from the guide.

use liouville::case::{Case, Problem, SYSTEM_NAMES, TABLE_ROWS, claim_keys};
use liouville::claim::ValueShape;
use serde_json::{Map, Value, json};

use super::CommandOutput;

/// The pages whose tables explain keys.
const GUIDE: &str = concat!(
    include_str!("../../../../docs/writing-a-case.md"),
    include_str!("../../../../docs/claims.md"),
    include_str!("../../../../docs/systems.md"),
);

/// A key that no table has.
const UNKNOWN: &str = "schema-probe";

/// Keys of tables of the file whose values are more than a text.
const SHAPES: [(&str, ValueShape); 12] = [
    ("gyrostat", ValueShape::List),
    ("bracket", ValueShape::ListOrTable),
    ("pairs", ValueShape::List),
    ("constraints", ValueShape::List),
    ("quasi-velocities", ValueShape::List),
    ("multipliers", ValueShape::List),
    ("forces", ValueShape::Table),
    ("equations", ValueShape::List),
    ("chart", ValueShape::Table),
    ("starts", ValueShape::List),
    ("lines", ValueShape::List),
    ("field", ValueShape::Table),
];

pub fn run() -> Result<CommandOutput, String> {
    let text =
        serde_json::to_string_pretty(&schema()).map_err(|error| format!("error: {error}"))?;
    Ok(CommandOutput { text: text + "\n", code: 0 })
}

/// The schema of a case file.
pub fn schema() -> Value {
    let formula = json!({ "type": ["string", "number"] });
    let formulas = json!({ "type": "object", "additionalProperties": formula });
    let mut properties = Map::new();
    for key in known("") {
        let value = match key.as_str() {
            "title" | "source" => json!({ "type": ["string", "number"] }),
            "note" => text_or_list(),
            "system" => json!({ "enum": SYSTEM_NAMES }),
            "check-weights" => json!({ "type": "boolean" }),
            "table" => of_column(),
            "body" => closed(bodies()),
            "level" => closed(known("[level]")),
            "hamiltonian" => closed(known("[hamiltonian]")),
            "lagrangian" => closed(known("[lagrangian]")),
            "section" => closed(known("[section]")),
            "one-sided" => closed(known("[one-sided]")),
            "claim" => json!({ "type": "array", "items": claim() }),
            "parameters" | "state" => json!({
                "type": "object",
                "additionalProperties": { "type": ["string", "number", "array"] },
            }),
            // one bracket, or several with names
            "poisson" => json!({
                "type": "object",
                "additionalProperties": {
                    "type": ["string", "number", "object"],
                    "additionalProperties": { "type": ["string", "number"] },
                },
            }),
            _ => formulas.clone(),
        };
        properties.insert(key.clone(), explained(&key, value));
    }
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Case of liouville",
        "type": "object",
        "properties": properties,
        "required": ["title"],
        "additionalProperties": false,
    })
}

fn text_or_list() -> Value {
    json!({ "type": ["string", "number", "array"] })
}

fn of_column() -> Value {
    let mut properties = Map::new();
    for key in ["number", "column"] {
        properties.insert(key.to_string(), json!({ "type": "integer" }));
    }
    for row in TABLE_ROWS.into_iter().chain(["caption"]) {
        properties.insert(row.to_string(), json!({ "type": ["string", "number"] }));
    }
    properties.insert("notes".to_string(), text_or_list());
    json!({ "type": "object", "properties": properties, "additionalProperties": false })
}

/// A table that has these keys and no others.
fn closed(keys: Vec<String>) -> Value {
    let of_key = |key: &String| value(key, &[ValueShape::of(key, &SHAPES)]);
    let properties: Map<String, Value> =
        keys.iter().map(|key| (key.clone(), explained(key, of_key(key)))).collect();
    json!({ "type": "object", "properties": properties, "additionalProperties": false })
}

/// A claim: one statement, and what may stand beside it.
fn claim() -> Value {
    let (mut properties, mut required) = (Map::new(), Vec::new());
    // A key of several statements takes what any of them takes.
    let mut shapes: Vec<(&str, Vec<ValueShape>)> = Vec::new();
    for (statement, keys) in claim_keys() {
        required.push(json!({ "required": [statement] }));
        for (key, shape) in keys {
            match shapes.iter_mut().find(|(known, _)| *known == key) {
                Some((_, all)) => all.push(shape),
                None => shapes.push((key, vec![shape])),
            }
        }
    }
    for (key, shapes) in shapes {
        properties.insert(key.to_string(), explained(key, value(key, &shapes)));
    }
    json!({
        "type": "object",
        "properties": properties,
        "anyOf": required,
        "additionalProperties": false,
    })
}

/// Schema of the value of a key that has one of these shapes.
fn value(key: &str, shapes: &[ValueShape]) -> Value {
    let mut kinds = vec!["string", "number"];
    if shapes.iter().any(|own| matches!(own, ValueShape::List | ValueShape::ListOrTable)) {
        kinds.push("array");
    }
    if shapes.iter().any(|own| matches!(own, ValueShape::Table | ValueShape::ListOrTable)) {
        kinds.push("object");
    }
    match key {
        "expect" => json!({ "enum": ["holds", "fails", "open"] }),
        "backwards" => json!({ "type": "boolean" }),
        "cell" => json!({ "enum": TABLE_ROWS }),
        _ => json!({ "type": kinds }),
    }
}

/// Adds the words of the guide.
fn explained(key: &str, mut value: Value) -> Value {
    if let (Some(object), Some(words)) = (value.as_object_mut(), words(key)) {
        object.insert("description".to_string(), words.into());
    }
    value
}

/// Meaning of a key: the second cell of the row of the guide that begins with it.
fn words(key: &str) -> Option<String> {
    let starts = [format!("| `{key} ="), format!("| `{key}`")];
    let row = GUIDE.lines().find(|line| starts.iter().any(|start| line.starts_with(start)))?;
    let cells = row.replace("\\|", "\u{1}");
    let cell = cells.split('|').nth(2)?.trim().replace('\u{1}', "|");
    Some(cell.replace('`', ""))
}

/// Keys of `[body]` in all systems that have one.
fn bodies() -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for system in SYSTEM_NAMES {
        let text = format!("title = 't'\nsystem = '{system}'\n[body]\n{UNKNOWN} = 1\n");
        for key in refused(&text, "[body]") {
            if !all.contains(&key) {
                all.push(key);
            }
        }
    }
    all
}

/// Keys of a table of the file; `""` is the file itself.
fn known(table: &str) -> Vec<String> {
    let field = "title = 't'\nsystem = 'field'\n[state]\nx = '1..2'\n";
    let rates = "[field]\n\"x'\" = '1'\n";
    let text = match table {
        "" => format!("{UNKNOWN} = 1\n{field}{rates}"),
        "[hamiltonian]" => format!("{field}{table}\n{UNKNOWN} = 1\n"),
        "[lagrangian]" => format!(
            "title = 't'\nsystem = 'nonholonomic'\n[state]\nx = '1..2'\n\"x'\" = '1..2'\n\
             {table}\n{UNKNOWN} = 1\n"
        ),
        "[section]" => format!("{field}{rates}{table}\ng0 = 0\nenergy = 1\n{UNKNOWN} = 1\n"),
        _ => format!("{field}{rates}{table}\n{UNKNOWN} = 1\n"),
    };
    refused(&text, if table.is_empty() { "the file" } else { table })
}

/// Keys that the reader names when it refuses an unknown one.
fn refused(text: &str, table: &str) -> Vec<String> {
    let Err(error) = Case::parse(text, &[]) else { return Vec::new() };
    let named = error.mistakes().iter().find_map(|mistake| match &mistake.problem {
        Problem::UnknownKey { section, known, .. } if section == table => Some(known),
        _ => None,
    });
    named.iter().flat_map(|known| known.iter().map(|key| key.to_string())).collect()
}

#[cfg(test)]
#[path = "../../tests/common/values.rs"]
mod values;

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::claim::ClaimKind;
    use liouville::claim::absence::Absence;
    use liouville_catalogue::CATALOGUE;

    /// First place where a value breaks the schema.
    fn broken(schema: &Value, value: &Value, place: &str) -> Option<String> {
        if let Some(all) = schema.get("enum").and_then(Value::as_array) {
            return (!all.contains(value)).then(|| format!("{place}: {value}"));
        }
        let own = match value {
            Value::String(_) => "string",
            Value::Number(number) if number.is_i64() => "integer",
            Value::Number(_) => "number",
            Value::Array(_) => "array",
            Value::Object(_) => "object",
            Value::Bool(_) => "boolean",
            Value::Null => "null",
        };
        let kinds = match &schema["type"] {
            Value::Array(kinds) => kinds.clone(),
            kind => vec![kind.clone()],
        };
        let fits = kinds.iter().any(|kind| kind == own || own == "integer" && kind == "number");
        if !fits {
            return Some(format!("{place} is a {own}: {value}"));
        }
        match value {
            Value::Array(items) => {
                let inner = schema.get("items")?;
                items.iter().find_map(|item| broken(inner, item, place))
            }
            Value::Object(entries) => {
                let missing = schema.get("required").and_then(Value::as_array);
                if missing.is_some_and(|keys| {
                    keys.iter().any(|key| value.get(key.as_str().unwrap_or("")).is_none())
                }) {
                    return Some(format!("{place} lacks a key"));
                }
                if let Some(all) = schema.get("anyOf").and_then(Value::as_array) {
                    let has = |one: &Value| {
                        value.get(one["required"][0].as_str().unwrap_or("")).is_some()
                    };
                    if !all.iter().any(has) {
                        return Some(format!("{place} states nothing"));
                    }
                }
                entries.iter().find_map(|(key, entry)| {
                    let own = schema.get("properties").and_then(|all| all.get(key));
                    let inner = own.or(schema.get("additionalProperties"));
                    match inner {
                        None => None,
                        Some(Value::Bool(false)) => Some(format!("{place} has no `{key}`")),
                        Some(inner) => broken(inner, entry, &format!("{place}.{key}")),
                    }
                })
            }
            _ => None,
        }
    }

    #[test]
    fn the_catalogue_fits_the_schema() {
        let schema = schema();
        for (name, text) in CATALOGUE {
            let value = values::read(text);
            assert_eq!(broken(&schema, &value, name), None);
        }
    }

    #[test]
    fn values_have_the_shapes_of_their_statements() {
        let schema = schema();
        let claims = &schema["properties"]["claim"]["items"]["properties"];
        let takes = |key: &str, kind: &str| {
            claims[key]["type"].as_array().is_some_and(|all| all.iter().any(|own| own == kind))
        };
        for key in ["involution", "independent", "spectrum", "integrals", "point", "note"] {
            assert!(takes(key, "array") && !takes(key, "object"), "{key} is a list");
        }
        for key in ["symmetry", "lax", "equals", "field", "no-integral", "parameters"] {
            assert!(takes(key, "object") && !takes(key, "array"), "{key} is a table");
        }
        assert!(takes("state", "array") && takes("state", "object"), "a list or a table");
        assert!(!takes("integral", "array") && !takes("integral", "object"), "a formula");
        for (statement, keys) in claim_keys() {
            let shapes = ClaimKind::shapes(statement).iter().chain(Absence::shapes(statement));
            for (key, _) in shapes {
                assert!(keys.iter().any(|(own, _)| own == key), "{statement} has no {key}");
            }
        }
    }

    #[test]
    fn what_the_reader_refuses_the_schema_refuses() {
        let schema = schema();
        for (text, wrong) in [
            ("title = 't'\ntitel = 'x'", "has no `titel`"),
            ("system = 'field'", "lacks a key"),
            ("title = 't'\nsystem = 'pendulum'", "system"),
            ("title = 't'\n[body]\ncolour = 'red'", "has no `colour`"),
            ("title = 't'\n[[claim]]\nname = 'x'", "states nothing"),
            ("title = 't'\n[[claim]]\nintegral = 'x'\nexpect = 'fail'", "expect"),
            ("title = 't'\n[section]\ng1 = 0", "has no `g1`"),
        ] {
            let value = values::read(text);
            let found = broken(&schema, &value, "t").unwrap_or_default();
            assert!(found.contains(wrong), "{text}: {found}");
        }
        let claims = &schema["properties"]["claim"]["items"]["properties"];
        assert!(claims["integral"]["description"].as_str().is_some_and(|it| it.contains("first")));
    }
}
