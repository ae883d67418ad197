//! Remarks on what a file may say by mistake: parameters without use, tables that are not read,
//! differences in place of ranges, densities that are no measures.

use std::fmt;

use rustc_hash::FxHashSet;
use toml::de::DeValue;

use super::PlacedClaim;
use super::mistakes::bases;
use super::section::CaseTable;
use crate::claim::ClaimKind;
use crate::formula::{Type, canonical_name, names_in};
use crate::mechanics::{Model, ParameterOrigin, System};
use crate::number::rational::Rational;

/// Keys whose texts are words, and no formulas.
const WORDS: [&str; 7] = ["title", "source", "note", "name", "system", "cell", "table"];

/// A remark on what a file may say by mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CaseRemark {
    /// The file has no claims.
    NoClaims,
    /// Any other, as it is printed.
    Text(String),
}

impl From<String> for CaseRemark {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl fmt::Display for CaseRemark {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoClaims => out.write_str(
                "there are no claims: `liouville report` lists the invariants of a system, \
                 `liouville search` looks for others",
            ),
            Self::Text(text) => out.write_str(text),
        }
    }
}

/// Names that the tables of a system read without being told.
fn implied(system: &System) -> &'static [&'static str] {
    match system {
        System::Rubber(_) | System::Spinning(_) => &["m", "I", "R", "c", "B", "k"],
        System::FlatBase(_) => &["m", "I", "k", "z"],
        System::Ball(_) => &["m", "R", "μ"],
        _ => &[],
    }
}

/// Remarks on a file that has no mistakes.
pub fn remarks(
    root: &CaseTable<'_>,
    system: &str,
    model: &Model,
    claims: &[PlacedClaim],
    is_without_claims: bool,
) -> Vec<CaseRemark> {
    let mut all = unread(root, system, model);
    all.extend(without_use(root, model));
    all.extend(without_dimension(root, model));
    all.extend(of_components(model));
    all.extend(differences(root));
    all.extend(claims.iter().filter_map(of_density));
    let no_claims = is_without_claims.then_some(CaseRemark::NoClaims);
    all.into_iter().map(CaseRemark::from).chain(no_claims).collect()
}

/// Tables that the system does not read.
fn unread(root: &CaseTable<'_>, system: &str, model: &Model) -> Vec<String> {
    let mut all: Vec<String> = root
        .unread()
        .iter()
        .map(|key| {
            format!("[{key}] is not read: a case with system = \"{system}\" does not use it")
        })
        .collect();
    if root.has("section") && !matches!(model.system, System::Rubber(_)) {
        all.push(
            "[section] is not read: sections are drawn of bodies that roll without spinning"
                .to_string(),
        );
    }
    all
}

/// Parameters that stand in no formula.
fn without_use(root: &CaseTable<'_>, model: &Model) -> Vec<String> {
    let mut used = FxHashSet::default();
    for (key, value) in root.entries() {
        let table = key.get_ref().as_ref();
        if WORDS.contains(&table) {
            continue;
        }
        match (table, value.get_ref()) {
            ("parameters", DeValue::Table(entries)) => {
                for (name, value) in entries.iter() {
                    let own = canonical_name(name.get_ref()).unwrap_or_default();
                    gather(value.get_ref(), &own, &mut used);
                }
            }
            (_, value) => gather(value, "", &mut used),
        }
    }
    let implied = implied(&model.system);
    let is_idle =
        |name: &&str| !name.contains('[') && !used.contains(*name) && !implied.contains(name);
    let names = model.parameters.iter().map(|parameter| parameter.name.as_str());
    let idle: Vec<&str> = names.filter(is_idle).collect();
    idle.iter().map(|name| format!("the parameter `{name}` stands in no formula")).collect()
}

/// State variables without a dimension, where other names have one.
fn without_dimension(root: &CaseTable<'_>, model: &Model) -> Option<String> {
    let (given, declared) = (root.value("dimensions")?, root.value("state")?);
    let (DeValue::Table(given), DeValue::Table(declared)) = (given.get_ref(), declared.get_ref())
    else {
        return None;
    };
    let names = |table: &toml::de::DeTable<'_>| -> FxHashSet<String> {
        table.keys().filter_map(|key| canonical_name(key.get_ref())).collect()
    };
    let (given, declared) = (names(given), names(declared));
    let lacks = |name: &&str| declared.contains(*name) && !given.contains(*name);
    let open = model.state.iter().map(|own| own.name.as_str()).filter(lacks);
    let open: Vec<String> = open.map(|name| format!("`{name}`")).collect();
    (!open.is_empty()).then(|| {
        format!(
            "[dimensions] says nothing of {}: sums that contain them are not checked; an angle has the \
             dimension \"1\"",
            open.join(", ")
        )
    })
}

/// Adds the names in the texts and keys of a value, but for one.
fn gather(value: &DeValue<'_>, own: &str, used: &mut FxHashSet<String>) {
    let mut add = |text: &str| {
        for name in names_in(text) {
            for base in bases(&name).filter(|base| *base != own) {
                if !used.contains(base) {
                    used.insert(base.to_string());
                }
            }
        }
    };
    match value {
        DeValue::String(text) => add(text),
        DeValue::Array(items) => items.iter().for_each(|item| gather(item.get_ref(), own, used)),
        DeValue::Table(entries) => {
            for (key, value) in entries.iter() {
                for name in names_in(key.get_ref()) {
                    used.extend(bases(&name).filter(|base| *base != own).map(String::from));
                }
                if !WORDS.contains(&key.get_ref().as_ref()) {
                    gather(value.get_ref(), own, used);
                }
            }
        }
        _ => {}
    }
}

/// Parameters named like a component of another that is not made of them.
fn of_components(model: &Model) -> Vec<String> {
    let find = |name: &str| model.parameters.iter().find(|own| own.name == name);
    let told = |name: &str| {
        let base = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let list = find(base).filter(|own| own.kind != Type::Scalar && base.len() < name.len())?;
        let is_made_of_it = match &list.origin {
            ParameterOrigin::Formula(formula) => {
                names_in(formula.text()).iter().any(|used| used == name)
            }
            _ => false,
        };
        let is_component = name[base.len()..]
            .parse()
            .is_ok_and(|index: usize| (1..=list.kind.size()).contains(&index) || index > 10);
        (is_component && !is_made_of_it).then(|| {
            format!("`{name}` is a parameter of its own, and hides that component of `{base}`")
        })
    };
    model.parameters.iter().filter_map(|parameter| told(&parameter.name)).collect()
}

/// Differences such as `1-3`, where a range may be meant.
fn differences(root: &CaseTable<'_>) -> Vec<String> {
    let mut all = Vec::new();
    for table in ["parameters", "state"] {
        let entries = root.table(table);
        for (key, value) in entries.map(|section| section.entries()).unwrap_or_default() {
            let DeValue::String(text) = value.get_ref() else { continue };
            let Some((low, high)) = text.trim().split_once(['-', '−']) else { continue };
            let number = |text: &str| text.trim().parse::<Rational>().ok();
            let (Some(a), Some(b)) = (number(low), number(high)) else { continue };
            let (low, high) = (low.trim(), high.trim());
            all.push(format!(
                "`{} = \"{text}\"` is the number {}; a range is written \"{low}..{high}\"",
                key.get_ref(),
                &a - &b
            ));
        }
    }
    all
}

/// A density that is a number, and not positive.
fn of_density(claim: &PlacedClaim) -> Option<String> {
    let ClaimKind::Density(_) = &claim.kind else { return None };
    let number = claim.kind.text()?.replace('−', "-").parse::<Rational>().ok()?;
    let is_positive = !number.is_zero() && !number.is_negative();
    (!is_positive).then(|| {
        let density = "the density of a measure must be positive";
        format!("the claimed density `{}` is {number}; {density}", claim.name)
    })
}
