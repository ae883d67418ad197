//! Library of known invariants: one small file for each family of systems, with its formulas and
//! the conditions under which they are meaningful.
//!
//! A file has a head (`family`, `system`, `when`, `unless`, `source`, `note`, and the keys below),
//! followed by the tables `[let]` and `[[claim]]` of a case file. `general = true` marks integrals
//! that say nothing about the body. `gives = ["…", …]` names the integrals that follow from its
//! claims by a linear equation. A family `around` an axis is tried for each axis; in it `@a`, `@γ`,
//! `@ω`, `@r`, `@S`, `@M`, `@I1`, `@I3`, `@x` and `@name` stand for the axis, for components and
//! moments along and across it, and for the state's second vector.

use toml::de::DeTable;

use super::data;

/// A family of systems with the formulas to be tried on them.
#[derive(Clone, Debug)]
pub struct SystemFamily {
    /// Name of the family.
    pub name: String,
    /// Kinds of systems to which it applies.
    pub systems: Vec<String>,
    /// Facts that must hold.
    pub when: Vec<String>,
    /// Facts that must not hold.
    pub unless: Vec<String>,
    /// Whether its integrals hold for every system of this kind, as the energy does.
    pub general: bool,
    /// Integrals that follow from its claims by a linear equation, if all claims hold.
    pub gives: Vec<String>,
    /// Whether it is tried for each axis of revolution.
    pub around: bool,
    /// Source of the formulas.
    pub source: String,
    /// Additional remarks.
    pub note: Option<String>,
    /// Definitions that its formulas use.
    pub definitions: Vec<(String, String)>,
    /// Tables `[[claim]]` as text.
    pub claims: String,
}

/// Includes the files of the families.
macro_rules! files {
    ($($name:literal),* $(,)?) => {
        [$(include_str!(concat!("families/", $name, ".toml"))),*]
    };
}

const TEXTS: [&str; 71] = files![
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
    "rolling",
    "rolling-free",
    "rolling-ball-balanced",
    "rolling-ball-balanced-momentum",
    "rolling-ball-balanced-momentum-rotor",
    "rolling-plane-ball-balanced",
    "rolling-plane-ball-balanced-rotor",
    "rolling-plane-ball-brun",
    "rolling-sphere-ball-brun",
    "rolling-sphere-ball-kappa",
    "rolling-ball-unbalanced",
    "rolling-plane-revolution",
    "rolling-sphere-revolution",
    "rolling-plane-ball-axis",
    "rolling-plane-ball-axis-rotor",
    "rolling-sphere-ball-axis",
    "rolling-plane-revolution-linear",
    "rolling-plane-revolution-linear-rotor",
    "rolling-sphere-revolution-linear",
    "rolling-plane-spherical-inertia",
    "rolling-sphere-spherical-inertia",
    "rolling-plane-ellipsoid-mb-mu",
    "rolling-sphere-ellipsoid-mb-mu",
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
    "surface-revolution-linear",
    "surface-rotating",
    "surface-rotating-sphere",
    "surface-cylinder",
    "lagrangian",
    "field",
];

/// Returns all families, in the order in which they are tried.
pub fn all() -> Vec<SystemFamily> {
    TEXTS.iter().filter_map(|text| read(text)).collect()
}

/// Reads a family from its file; a test ensures that each can be read.
fn read(text: &str) -> Option<SystemFamily> {
    let document = DeTable::parse(text).ok()?;
    let table = document.get_ref();
    let claims = text.find("[[claim]]").map_or("", |start| &text[start..]);
    Some(SystemFamily {
        name: data::word(table, "family")?,
        systems: data::words(table, "system"),
        when: data::words(table, "when"),
        unless: data::words(table, "unless"),
        general: data::flag(table, "general"),
        gives: data::words(table, "gives"),
        around: data::flag(table, "around"),
        source: data::word(table, "source").unwrap_or_default(),
        note: data::word(table, "note"),
        definitions: data::pairs(table, "let"),
        claims: claims.to_string(),
    })
}

impl SystemFamily {
    /// Whether the family applies to this kind of system with these facts.
    pub fn applies(&self, system: &str, holds: impl Fn(&str) -> bool) -> bool {
        self.systems.iter().any(|known| known == system)
            && self.when.iter().all(|fact| holds(fact))
            && !self.unless.iter().any(|fact| holds(fact))
    }

    /// Returns the same family with replacements for the placeholders.
    pub fn with(&self, words: &[(&str, String)]) -> Self {
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
