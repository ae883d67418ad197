//! TOML as values of JSON.

use serde_json::{Map, Value};
use toml::de::{DeTable, DeValue};

/// Reads a text; it has to be valid.
pub fn read(text: &str) -> Value {
    let table = DeTable::parse(text).unwrap_or_else(|error| panic!("{error}"));
    of_table(table.get_ref())
}

fn of_table(table: &DeTable<'_>) -> Value {
    let entry = |(key, value): (&toml::Spanned<_>, &toml::Spanned<DeValue<'_>>)| {
        let key: &std::borrow::Cow<'_, str> = key.get_ref();
        (key.to_string(), of(value.get_ref()))
    };
    Value::Object(table.iter().map(entry).collect::<Map<String, Value>>())
}

fn of(value: &DeValue<'_>) -> Value {
    let number = |text: String| serde_json::from_str(&text).unwrap_or(Value::String(text));
    match value {
        DeValue::String(text) => Value::String(text.to_string()),
        DeValue::Integer(digits) => number(digits.to_string()),
        DeValue::Float(digits) => number(digits.to_string()),
        DeValue::Boolean(flag) => Value::Bool(*flag),
        DeValue::Array(items) => items.iter().map(|item| of(item.get_ref())).collect(),
        DeValue::Table(table) => of_table(table),
        DeValue::Datetime(date) => Value::String(date.to_string()),
    }
}
