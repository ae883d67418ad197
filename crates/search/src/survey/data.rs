//! Access to the embedded files of the survey: small TOML tables of strings.

use toml::de::{DeTable, DeValue};

use liouville::order::StableOrder;

/// Returns the string of a key.
pub fn word(table: &DeTable<'_>, key: &str) -> Option<String> {
    match table.get(key)?.get_ref() {
        DeValue::String(text) => Some(text.to_string()),
        _ => None,
    }
}

/// Returns the strings of a list; empty without the key.
pub fn words(table: &DeTable<'_>, key: &str) -> Vec<String> {
    let Some(DeValue::Array(items)) = table.get(key).map(|value| value.get_ref()) else {
        return Vec::new();
    };
    let text = |item: &DeValue<'_>| match item {
        DeValue::String(text) => Some(text.to_string()),
        _ => None,
    };
    items.iter().filter_map(|item| text(item.get_ref())).collect()
}

/// Whether the key exists and is `true`.
pub fn flag(table: &DeTable<'_>, key: &str) -> bool {
    matches!(table.get(key).map(|value| value.get_ref()), Some(DeValue::Boolean(true)))
}

/// Returns the tables of a list of tables.
pub fn tables<'t, 'a>(table: &'t DeTable<'a>, key: &str) -> Vec<&'t DeTable<'a>> {
    let Some(DeValue::Array(items)) = table.get(key).map(|value| value.get_ref()) else {
        return Vec::new();
    };
    let inner = |item: &'t DeValue<'a>| match item {
        DeValue::Table(inner) => Some(inner),
        _ => None,
    };
    items.iter().filter_map(|item| inner(item.get_ref())).collect()
}

/// Returns the strings of the table of a key, in the order of the file.
pub fn pairs(table: &DeTable<'_>, key: &str) -> Vec<(String, String)> {
    let Some(DeValue::Table(inner)) = table.get(key).map(|value| value.get_ref()) else {
        return Vec::new();
    };
    let mut entries: Vec<_> = inner.iter().collect();
    entries.order_by_key(|(key, _)| key.span().start);
    let mut found = Vec::new();
    for (key, value) in entries {
        if let DeValue::String(text) = value.get_ref() {
            found.push((key.get_ref().to_string(), text.to_string()));
        }
    }
    found
}
