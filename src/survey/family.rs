//! What the tool knows: one small file a family of systems, with the conditions under which its
//! formulas make sense, and the formulas.
//!
//! A file has a head (`family`, `system`, `when`, `unless`, `around`, `source`, `note`) and then the
//! tables `[let]` and `[[claim]]` of a case file. A family `around` an axis is tried for each axis;
//! `@a`, `@γ`, `@ω`, `@S`, `@I1`, `@I3` and `@name` in it stand for the axis and for components and
//! moments along and across it.

use toml::de::{DeTable, DeValue};

/// A family of systems with the formulas to be tried on them.
#[derive(Clone, Debug)]
pub struct Family {
    /// What the family is called.
    pub name: String,
    /// The kinds of systems it is about.
    pub systems: Vec<String>,
    /// Facts that must hold.
    pub when: Vec<String>,
    /// Facts that must not hold.
    pub unless: Vec<String>,
    /// Is it tried for each axis of revolution?
    pub around: bool,
    /// Where the formulas come from.
    pub source: String,
    /// What is known beside them.
    pub note: Option<String>,
    /// The names its formulas use.
    pub definitions: Vec<(String, String)>,
    /// The tables `[[claim]]`.
    pub claims: String,
}

/// The files of the families.
macro_rules! files {
    ($($name:literal),* $(,)?) => {
        [$(include_str!(concat!("families/", $name, ".toml"))),*]
    };
}

const TEXTS: [&str; 48] = files![
    "rubber",
    "rubber-free",
    "plane-reference",
    "plane-ball-balanced",
    "plane-ball-balanced-integral",
    "plane-ball-balanced-rotor",
    "plane-ball-brun",
    "plane-ball-unbalanced",
    "plane-revolution",
    "plane-revolution-integral",
    "plane-revolution-rotor",
    "plane-spherical-inertia",
    "plane-ellipsoid-criterion",
    "plane-ellipsoid-criterion-13",
    "plane-ellipsoid-mb-mu",
    "sphere-reference",
    "sphere-ball-balanced",
    "sphere-ball-kappa",
    "sphere-ball-kappa-potential",
    "sphere-ball-equal",
    "sphere-revolution-ball",
    "sphere-revolution-ball-integral",
    "sphere-revolution-ball-rotor",
    "sphere-revolution",
    "sphere-revolution-integral",
    "sphere-revolution-rotor",
    "sphere-disk",
    "sphere-ellipsoid",
    "sphere-plane-integrals",
    "flat-base",
    "flat-base-free",
    "flat-base-central",
    "flat-base-central-rotor",
    "flat-base-symmetric",
    "flat-base-symmetric-integral",
    "flat-base-symmetric-rotor",
    "surface",
    "surface-at-rest",
    "surface-free",
    "surface-level",
    "surface-support",
    "surface-quadric",
    "surface-revolution",
    "surface-rotating",
    "surface-rotating-sphere",
    "surface-cylinder",
    "lagrangian",
    "field",
];

/// All families, in the order in which they are tried.
pub fn all() -> Vec<Family> {
    TEXTS.iter().filter_map(|text| read(text)).collect()
}

/// A family from its file; a test makes sure that each can be read.
fn read(text: &str) -> Option<Family> {
    let (head, body) = text.split_at(text.find("\n[").map_or(text.len(), |end| end + 1));
    let head = DeTable::parse(head).ok()?;
    let head = head.get_ref();
    let word = |key: &str| match head.get(key)?.get_ref() {
        DeValue::String(text) => Some(text.to_string()),
        _ => None,
    };
    let words = |key: &str| -> Vec<String> {
        let Some(DeValue::Array(items)) = head.get(key).map(|value| value.get_ref()) else {
            return Vec::new();
        };
        let each = items.iter().map(|item| match item.get_ref() {
            DeValue::String(text) => Some(text.to_string()),
            _ => None,
        });
        each.flatten().collect()
    };
    let claims = body.find("[[claim]]").map_or("", |start| &body[start..]);
    Some(Family {
        name: word("family")?,
        systems: words("system"),
        when: words("when"),
        unless: words("unless"),
        around: matches!(head.get("around").map(|v| v.get_ref()), Some(DeValue::Boolean(true))),
        source: word("source").unwrap_or_default(),
        note: word("note"),
        definitions: definitions(&body[..body.len() - claims.len()])?,
        claims: claims.to_string(),
    })
}

/// The entries of `[let]`, in order.
fn definitions(text: &str) -> Option<Vec<(String, String)>> {
    let document = DeTable::parse(text).ok()?;
    let Some(table) = document.get_ref().get("let") else { return Some(Vec::new()) };
    let DeValue::Table(table) = table.get_ref() else { return None };
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    let pairs = entries.into_iter().map(|(key, value)| match value.get_ref() {
        DeValue::String(text) => Some((key.get_ref().to_string(), text.to_string())),
        _ => None,
    });
    pairs.collect()
}

impl Family {
    /// Does it apply to this kind of system with these facts?
    pub fn applies(&self, system: &str, holds: impl Fn(&str) -> bool) -> bool {
        self.systems.iter().any(|known| known == system)
            && self.when.iter().all(|fact| holds(fact))
            && !self.unless.iter().any(|fact| holds(fact))
    }

    /// The same family with other words for the placeholders.
    pub fn with(&self, words: &[(&str, &str)]) -> Self {
        let replace = |text: &String| {
            words.iter().fold(text.clone(), |text, (from, to)| text.replace(from, to))
        };
        let mut other = self.clone();
        other.name = replace(&self.name);
        other.claims = replace(&self.claims);
        for (_, formula) in &mut other.definitions {
            *formula = replace(formula);
        }
        other
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_family_can_be_read() {
        for text in TEXTS {
            let family = read(text).unwrap_or_else(|| panic!("a family:\n{text}"));
            assert!(!family.systems.is_empty(), "{} names its systems", family.name);
            assert!(family.claims.contains("[[claim]]"), "{} has claims", family.name);
            let at = family.claims.contains('@') || family.name.contains('@');
            assert!(family.around || !at, "{} has an axis to put in", family.name);
        }
    }
}
