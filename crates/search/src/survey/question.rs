//! Questions put to a case, and the resulting findings.
//!
//! A question consists of claims like any other: of a family's file, or made by the program;
//! `verdict::judge` decides.

use serde::Serialize;
use toml::de::DeTable;

use super::data;
use super::family::Family;
use super::shown::{Shown, Typesetter};
use liouville::case::Case;
use liouville::claim::{Claim, Entry};
use liouville::mechanics::Meaning;
use liouville::verdict::{ClaimReport, Independence, JudgeError, Options, Sign, Verdict, judge};

/// Definition of a name in formulas.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Definition {
    /// Defined name.
    pub name: String,
    /// Formula of the name.
    pub formula: String,
}

/// Claims to be tested on a case, with the names they use.
#[derive(Clone, Debug, Default)]
pub struct Question {
    /// Family of the claims.
    pub family: String,
    /// Source of the claims.
    pub source: String,
    /// Additional remarks.
    pub note: Option<String>,
    /// Whether its integrals say nothing about the body.
    pub is_general: bool,
    /// Definitions in order.
    pub definitions: Vec<Definition>,
    /// Claims to be judged.
    pub body: Body,
}

/// Claims of a question.
#[derive(Clone, Debug)]
pub enum Body {
    /// Tables `[[claim]]` of a family's file.
    File(String),
    /// Claims as values.
    Claims(Vec<Claim>),
}

impl Default for Body {
    fn default() -> Self {
        Body::Claims(Vec::new())
    }
}

/// A claim that was tested, with its verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Report on the claim.
    #[serde(flatten)]
    pub claim: ClaimReport,
    /// Family of the claim.
    pub family: String,
    /// Definitions that its formulas use, directly or through others.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub definitions: Vec<Definition>,
    /// For a map or a field, the image or the component of each variable that changes; for a rate,
    /// the function and the value of its rate.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub images: Vec<Definition>,
    /// Fixed set of a reversor, if its dimension is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fixed_set: Option<FixedSet>,
    /// Additional remark.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remark: Option<String>,
    /// Whether it says nothing about the body, for example that a surface is preserved.
    #[serde(skip)]
    pub is_general: bool,
    /// Typeset formulas.
    #[serde(skip)]
    pub shown: Shown,
}

/// The fixed set of a map within the level set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct FixedSet {
    /// Dimension; `None` if the set is empty.
    pub dimension: Option<usize>,
}

/// Family name of the claims of the case.
const OWN: &str = "the case itself";
const SEARCH: &str = "the search";

/// Kinds of claims that are tables of formulas, one for each variable.
const TABLES: [&str; 3] = ["symmetry-field", "symmetry", "reversor"];

impl Finding {
    /// Makes a finding from a claim of the case, with the abbreviations that it uses.
    pub fn claimed(case: &Case, claim: ClaimReport) -> Self {
        let names = &case.model.vocabulary;
        let abbreviations = names.iter().filter_map(|(_, entry)| match entry.meaning {
            Meaning::Abbreviation(index) => {
                Some(define(&entry.name, case.model.abbreviations[index].text()))
            }
            _ => None,
        });
        Self::beside(OWN, case, claim, abbreviations.collect())
    }

    /// Makes a finding from a result of the search, with the names that its formula may use.
    pub fn found(case: &Case, claim: ClaimReport, names: Vec<Definition>) -> Self {
        Self::beside(SEARCH, case, claim, names)
    }

    fn beside(family: &str, case: &Case, claim: ClaimReport, names: Vec<Definition>) -> Self {
        let definitions = used_by(&[claim.formula.as_deref().unwrap_or_default()], &names);
        let asked = defined(case, &definitions);
        let paper = Typesetter(&asked.as_ref().unwrap_or(case).model.vocabulary);
        let shown = Shown {
            statement: claim.formula.as_deref().and_then(|text| paper.formula(text)),
            definitions: paper.definitions(&definitions),
        };
        Self {
            claim,
            family: family.to_string(),
            definitions,
            images: Vec::new(),
            fixed_set: None,
            remark: None,
            is_general: false,
            shown,
        }
    }

    /// Whether the finding comes from a family, rather than from the case or the search.
    pub fn is_of_family(&self) -> bool {
        self.family != OWN && self.family != SEARCH
    }

    /// Whether the claim is known to hold.
    pub fn holds(&self) -> bool {
        matches!(self.claim.verdict, Verdict::Proved | Verdict::Confirmed)
    }

    /// Whether the claim is proved.
    pub fn is_proved(&self) -> bool {
        self.claim.verdict == Verdict::Proved
    }

    /// Whether the claim is known to fail.
    pub fn fails(&self) -> bool {
        self.claim.verdict == Verdict::Refuted
    }

    /// Whether the claim is of this kind.
    pub fn is(&self, kind: &str) -> bool {
        self.claim.kind == kind
    }

    /// Whether the finding is an integral independent of the level and the energy.
    pub fn is_new_integral(&self) -> bool {
        let independent = self.claim.evidence.independence == Some(Independence::Independent);
        self.is("integral") && self.holds() && independent
    }

    /// Whether the finding is a density of constant sign.
    pub fn is_measure(&self) -> bool {
        let sign = self.claim.evidence.sign;
        self.is("density") && self.is_proved() && sign != Some(Sign::Changes)
    }

    /// Whether a formula contains an unevaluated integral.
    pub fn is_quadrature(&self) -> bool {
        let formulas = self.definitions.iter().map(|one| one.formula.as_str());
        formulas.chain([self.formula()]).any(|text| text.contains('∫'))
    }

    /// Returns the formula of the claim, or its name.
    pub fn formula(&self) -> &str {
        self.claim.formula.as_deref().unwrap_or(&self.claim.name)
    }
}

impl Question {
    /// Makes the question of a family, with names for quantities that the case names differently.
    pub fn of(family: &Family, bindings: &[Definition]) -> Self {
        let own = family
            .definitions
            .iter()
            .map(|(name, formula)| Definition { name: name.clone(), formula: formula.clone() });
        Self {
            family: family.name.clone(),
            source: family.source.clone(),
            note: family.note.clone(),
            is_general: family.general,
            definitions: distinct(bindings.iter().cloned().chain(own)),
            body: Body::File(family.claims.clone()),
        }
    }

    /// Makes a question of claims alone.
    pub fn plain(family: &str, bindings: &[Definition], claims: Vec<Claim>) -> Self {
        let (family, body) = (family.to_string(), Body::Claims(claims));
        Self { family, definitions: bindings.to_vec(), body, ..Self::default() }
    }

    /// Returns the case with the names and the claims of the question; `None` if it is meaningless
    /// there.
    fn asked(&self, case: &Case) -> Option<Case> {
        let named = defined(case, &self.definitions)?;
        match &self.body {
            Body::File(text) => named.ask(text).ok(),
            Body::Claims(claims) => named.with_claims(claims).ok(),
        }
    }

    /// Puts the question to a case and judges it; `None` if it is meaningless for the case, for
    /// example because of a name that the case does not have.
    pub fn ask(&self, case: &Case, options: &Options) -> Result<Option<Vec<Finding>>, JudgeError> {
        match self.asked(case) {
            Some(asked) => self.findings(&asked, options).map(Some),
            None => Ok(None),
        }
    }

    /// Judges the claims of a case as those of the question.
    pub fn findings(&self, asked: &Case, options: &Options) -> Result<Vec<Finding>, JudgeError> {
        let report = judge(asked, options)?;
        let tables = self.tables();
        let images = tables.into_iter().chain(std::iter::repeat(Vec::new()));
        let found = report.claims.into_iter().zip(images);
        let paper = Typesetter(&asked.model.vocabulary);
        Ok(found.map(|(claim, images)| self.finding(claim, images, &paper)).collect())
    }

    /// Returns the tables of formulas in the claims, one for each claim.
    fn tables(&self) -> Vec<Vec<Definition>> {
        let text = match &self.body {
            Body::Claims(claims) => return claims.iter().map(table_of).collect(),
            Body::File(text) => text,
        };
        let Ok(document) = DeTable::parse(text) else { return Vec::new() };
        let claims = data::tables(document.get_ref(), "claim");
        let table = |claim: &&DeTable<'_>| {
            let entries = TABLES.iter().flat_map(|key| data::pairs(claim, key));
            let rate = data::word(claim, "rate").zip(data::word(claim, "equals"));
            entries.chain(rate).map(|(name, formula)| Definition { name, formula }).collect()
        };
        claims.iter().map(table).collect()
    }

    fn finding(
        &self,
        mut claim: ClaimReport,
        images: Vec<Definition>,
        paper: &Typesetter<'_>,
    ) -> Finding {
        claim.source = match (self.source.as_str(), claim.source.as_str()) {
            (source, own) if own.is_empty() || source.contains(own) => source.to_string(),
            ("", own) => own.to_string(),
            (source, own) => format!("{source}, {own}"),
        };
        let is_rate = claim.kind == "rate";
        let used = images.iter().map(|image| image.formula.as_str());
        let function = images.iter().map(|image| image.name.as_str()).filter(|_| is_rate);
        let formula = claim.formula.as_deref().filter(|_| images.is_empty());
        let used: Vec<&str> = used.chain(function).chain(formula).collect();
        let definitions = used_by(&used, &self.definitions);
        let statement = match (formula, images.as_slice()) {
            (_, [rate]) if is_rate => paper.rate(&rate.name, &rate.formula),
            (Some(formula), _) => paper.formula(formula),
            (None, []) => None,
            (None, images) => paper.images(images),
        };
        Finding {
            shown: Shown { statement, definitions: paper.definitions(&definitions) },
            // A note concerns the formulas of its family.
            remark: self.note.clone().filter(|_| images.is_empty() || is_rate),
            definitions,
            claim,
            images,
            family: self.family.clone(),
            fixed_set: None,
            is_general: self.is_general,
        }
    }
}

/// Returns the table of formulas in a claim, if it has one.
fn table_of(claim: &Claim) -> Vec<Definition> {
    match claim.entry(claim.key()) {
        Some(Entry::Table(table)) => {
            table.iter().map(|(name, formula)| define(name, formula.text())).collect()
        }
        _ => Vec::new(),
    }
}

/// Returns the case with these definitions, each in the names of those before it; `None` if one has
/// no meaning there.
pub fn defined(case: &Case, definitions: &[Definition]) -> Option<Case> {
    let mut named = case.clone();
    for definition in definitions {
        let formula = named.formula(&definition.formula).ok()?;
        named.define(&definition.name, &formula).ok()?;
    }
    Some(named)
}

/// Makes a definition.
pub fn define(name: &str, formula: &str) -> Definition {
    Definition { name: name.to_string(), formula: formula.to_string() }
}

/// Merges the definitions and formulas of several findings; names with different meanings are
/// renamed.
pub fn merged(bindings: &[Definition], findings: &[&Finding]) -> (Vec<Definition>, Vec<String>) {
    let mut all = bindings.to_vec();
    let mut formulas = Vec::new();
    for (number, finding) in findings.iter().enumerate() {
        let mut own = finding.definitions.clone();
        let mut formula = finding.formula().to_string();
        for index in 0..own.len() {
            let clash = all.iter().any(|one| one.name == own[index].name && *one != own[index]);
            if clash {
                let (old, new) = (
                    own[index].name.clone(),
                    format!("{}{}", "x".repeat(number + 1), own[index].name),
                );
                own[index].name = new.clone();
                for later in &mut own[index + 1..] {
                    later.formula = renamed(&later.formula, &old, &new);
                }
                formula = renamed(&formula, &old, &new);
            }
        }
        for definition in own {
            if !all.contains(&definition) {
                all.push(definition);
            }
        }
        formulas.push(formula);
    }
    (all, formulas)
}

/// Keeps the last definition of each name: a family's own hides a binding.
fn distinct(definitions: impl Iterator<Item = Definition>) -> Vec<Definition> {
    let mut kept: Vec<Definition> = Vec::new();
    for definition in definitions {
        kept.retain(|earlier| earlier.name != definition.name);
        kept.push(definition);
    }
    kept
}

/// Selects the definitions that formulas use, directly or through others, in order.
pub fn used_by(formulas: &[&str], definitions: &[Definition]) -> Vec<Definition> {
    let mut texts = formulas.to_vec();
    let mut used = vec![false; definitions.len()];
    for (index, definition) in definitions.iter().enumerate().rev() {
        // Where g1 is defined, it is a name rather than a component of g.
        let own = |token: &str| {
            token == definition.name || definitions.iter().all(|other| other.name != token)
        };
        if texts.iter().any(|text| mentions(text, &definition.name, &own)) {
            used[index] = true;
            texts.push(&definition.formula);
        }
    }
    let pairs = definitions.iter().zip(used);
    pairs.filter(|(_, used)| *used).map(|(definition, _)| definition.clone()).collect()
}

/// Whether the name occurs in the formula, without an index or with one that does not make it
/// another name.
fn mentions(formula: &str, name: &str, own: &dyn Fn(&str) -> bool) -> bool {
    places(formula, name).any(|start| {
        let after = &formula[start + name.len()..];
        let digits = after.chars().take_while(char::is_ascii_digit).count();
        own(&formula[start..start + name.len() + digits])
    })
}

/// Replaces a name in the formula by another.
fn renamed(formula: &str, name: &str, other: &str) -> String {
    let mut text = String::new();
    let mut done = 0;
    for start in places(formula, name) {
        text.push_str(&formula[done..start]);
        text.push_str(other);
        done = start + name.len();
    }
    text + &formula[done..]
}

/// Finds the places of the name in the formula, with or without an index.
fn places<'t>(formula: &'t str, name: &'t str) -> impl Iterator<Item = usize> + 't {
    let letter = |c: char| c.is_alphanumeric() && !c.is_numeric() || c == '_';
    let stands = move |start: usize| {
        let before = formula[..start].chars().next_back();
        let after = &formula[start + name.len()..];
        let rest = after.trim_start_matches(|c: char| c.is_ascii_digit());
        let own_digits = name.ends_with(|c: char| c.is_ascii_digit());
        let unchanged = !own_digits || rest.len() == after.len();
        !before.is_some_and(|c| letter(c) || c.is_numeric())
            && !rest.starts_with(letter)
            && !rest.starts_with('\'')
            && unchanged
    };
    formula.match_indices(name).map(|(start, _)| start).filter(move |start| stands(*start))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_used_is_shown() {
        let all =
            [define("m", "2*M"), define("J", "I + m*E"), define("g1", "I1"), define("g", "3")];
        let names = |formula: &str| {
            used_by(&[formula], &all).into_iter().map(|d| d.name).collect::<Vec<_>>()
        };
        assert_eq!(names("|J*ω|²"), ["m", "J"], "J, and the m in it");
        assert_eq!(names("√g1*ω3"), ["g1"], "g1 is a name, and no component of g");
        assert_eq!(names("J3"), ["m", "J"], "a component of J");
        assert!(names("gamma*mu").is_empty(), "letters inside a name are no name");
    }

    #[test]
    fn a_name_is_changed_where_it_stands_alone() {
        let text = renamed("J1*(J*ω,J⁻¹*Js) − J'", "J", "xJ");
        assert_eq!(text, "xJ1*(xJ*ω,xJ⁻¹*Js) − J'", "not in Js, nor in J'");
    }
}
