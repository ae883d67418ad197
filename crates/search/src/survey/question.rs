//! Questions put to a case, and the resulting findings.
//!
//! A question consists of claims like any other: of a family's file, or made by the program;
//! `verdict::judge` decides.

use serde::Serialize;
use toml::de::DeTable;

use super::data;
use super::definitions::{Definition, define, defined, distinct, used_by};
use super::family::SystemFamily;
use super::shown::{Shown, Typesetter};
use liouville::case::Case;
use liouville::claim::{Claim, ClaimEntry, Rate, Statement, SymmetryField};
use liouville::mechanics::{Meaning, TIME};
use liouville::verdict::{
    ClaimReport, DensitySign, Flaw, Independence, JudgeError, Options, Verdict, judge,
};

/// Claims to be tested on a case, with the names they use.
#[derive(Clone, Debug, Default)]
pub struct SurveyQuestion {
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
    pub body: ClaimFormulas,
}

/// Claims of a question.
#[derive(Clone, Debug)]
pub enum ClaimFormulas {
    /// Tables `[[claim]]` of a family's file.
    File(String),
    /// Claims as values.
    Claims(Vec<Claim>),
}

impl Default for ClaimFormulas {
    fn default() -> Self {
        ClaimFormulas::Claims(Vec::new())
    }
}

/// A claim that was tested, with its verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TestedClaim {
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
    /// Listed values of parameters for which alone it holds, as `a = 1`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub values: Option<String>,
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
/// Largest length of a formula in a list of names, in characters.
const LABEL: usize = 60;

/// Kinds of claims that are tables of formulas, one for each variable.
const TABLES: [&str; 3] = ["symmetry-field", "symmetry", "reversor"];

impl TestedClaim {
    /// Makes a finding from a claim of the case, with the abbreviations that it uses.
    pub fn claimed(case: &Case, claim: ClaimReport) -> Self {
        let names = &case.model.vocabulary;
        let abbreviations = names.iter().filter_map(|(_, entry)| match entry.meaning {
            Meaning::Abbreviation(index) => {
                Some(define(&entry.name, case.model.abbreviations[index].text()))
            }
            _ => None,
        });
        let mut claims =
            case.homes().flat_map(|home| home.claims.iter().map(move |own| (home, own)));
        let own = claims.find(|(_, own)| own.name == claim.name && own.kind.name() == claim.kind);
        let mut tested = Self::beside(OWN, case, claim, abbreviations.collect());
        if let Some((home, own)) = own {
            tested.remark = own.kind.particulars();
            let layout = own.kind.layout(&home.model);
            tested.shown.statement = layout.or(tested.shown.statement);
        }
        tested
    }

    /// The same with the components of a vector field by variable.
    pub(crate) fn with_field(mut self, case: &Case, components: &[Definition]) -> Self {
        self.shown.statement = Typesetter(&case.model.vocabulary).field(components);
        self
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
            values: None,
            is_general: false,
            shown,
        }
    }

    /// The same with its rate, or its cofactor.
    pub(crate) fn with_rate(mut self, case: &Case, what: &str, rate: &str) -> Self {
        let paper = Typesetter(&case.model.vocabulary);
        self.shown.statement = match what {
            "rate" => paper.rate(self.formula(), rate),
            _ => paper.zeros(self.formula(), rate),
        };
        self
    }

    /// Whether the finding comes from a family, rather than from the case or the search.
    pub fn is_of_family(&self) -> bool {
        self.family != OWN && self.family != SEARCH
    }

    /// Whether its formula contains the time t as a variable of the state.
    pub fn uses_time(&self, case: &Case) -> bool {
        let is_driven = case.model.state.iter().any(|variable| variable.name == TIME);
        let Some(named) = defined(case, &self.definitions).filter(|_| is_driven) else {
            return false;
        };
        let Ok(formula) = named.formula(self.formula()) else { return false };
        let used = named.model.vocabulary.uses(&formula, &named.model.abbreviations);
        used.iter().any(|entry| entry.name == TIME)
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

    /// Whether the finding is a density of constant sign, without a pole that is seen.
    pub fn is_measure(&self) -> bool {
        let evidence = &self.claim.evidence;
        let has_one_sign = evidence.sign != Some(DensitySign::Changes);
        self.is("density") && self.is_proved() && has_one_sign && !evidence.has(Flaw::Infinite)
    }

    /// Whether the finding is an integral that jumps, which a motion that crosses the jump does not
    /// keep.
    pub fn jumps(&self) -> bool {
        self.is("integral") && self.claim.evidence.has(Flaw::Jumps)
    }

    /// Whether a formula contains an unevaluated integral.
    pub fn is_quadrature(&self) -> bool {
        let formulas = self.definitions.iter().map(|one| one.formula.as_str());
        formulas.chain([self.formula()]).any(|text| text.contains('∫'))
    }

    /// Returns the name of the claim, or the beginning of the formula of a find, which has none.
    pub fn label(&self) -> String {
        if self.family != SEARCH {
            return self.claim.name.clone();
        }
        match self.formula().char_indices().nth(LABEL) {
            Some((end, _)) => {
                let start = &self.formula()[..end];
                let depth = |text: &str| {
                    text.matches('(').count().saturating_sub(text.matches(')').count())
                };
                let whole = [" + ", " − "].iter().filter_map(|sign| start.rfind(sign));
                let whole = whole.map(|place| &start[..place]).max_by_key(|own| own.len());
                match whole.filter(|own| depth(own) == 0) {
                    Some(own) => format!("{own} + …"),
                    None => format!("{}…", start.trim_end()),
                }
            }
            None => self.formula().to_string(),
        }
    }

    /// Returns the formula of the claim, or its name.
    pub fn formula(&self) -> &str {
        self.claim.formula.as_deref().unwrap_or(&self.claim.name)
    }
}

impl SurveyQuestion {
    /// Makes the question of a family, with names for quantities that the case names differently.
    pub fn of(family: &SystemFamily, bindings: &[Definition]) -> Self {
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
            body: ClaimFormulas::File(family.claims.clone()),
        }
    }

    /// Makes a question of claims alone.
    pub fn plain(family: &str, bindings: &[Definition], claims: Vec<Claim>) -> Self {
        let (family, body) = (family.to_string(), ClaimFormulas::Claims(claims));
        Self { family, definitions: bindings.to_vec(), body, ..Self::default() }
    }

    /// Returns the case with the names and the claims of the question; `None` if it is meaningless
    /// there.
    fn asked(&self, case: &Case) -> Option<Case> {
        let named = defined(case, &self.definitions)?;
        match &self.body {
            ClaimFormulas::File(text) => named.ask(text).ok(),
            ClaimFormulas::Claims(claims) => named.with_claims(claims).ok(),
        }
    }

    /// Puts the question to a case and judges it; `None` if it is meaningless for the case, for
    /// example because of a name that the case does not have.
    pub fn ask(
        &self,
        case: &Case,
        options: &Options,
    ) -> Result<Option<Vec<TestedClaim>>, JudgeError> {
        match self.asked(case) {
            Some(asked) => self.tested(&asked, options).map(Some),
            None => Ok(None),
        }
    }

    /// Judges the claims of a case as those of the question.
    pub fn tested(&self, asked: &Case, options: &Options) -> Result<Vec<TestedClaim>, JudgeError> {
        let report = judge(asked, options)?;
        let tables = self.tables();
        let images = tables.into_iter().chain(std::iter::repeat(Vec::new()));
        let found = report.claims.into_iter().zip(images);
        let paper = Typesetter(&asked.model.vocabulary);
        Ok(found.map(|(claim, images)| self.tested_claim(claim, images, &paper)).collect())
    }

    /// Returns the tables of formulas in the claims, one for each claim.
    fn tables(&self) -> Vec<Vec<Definition>> {
        let text = match &self.body {
            ClaimFormulas::Claims(claims) => return claims.iter().map(table_of).collect(),
            ClaimFormulas::File(text) => text,
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

    fn tested_claim(
        &self,
        mut claim: ClaimReport,
        images: Vec<Definition>,
        paper: &Typesetter<'_>,
    ) -> TestedClaim {
        claim.source = match (self.source.as_str(), claim.source.as_str()) {
            (source, own) if own.is_empty() || source.contains(own) => source.to_string(),
            ("", own) => own.to_string(),
            (source, own) => format!("{source}, {own}"),
        };
        let is_rate = claim.kind == Rate::NAME;
        let used = images.iter().map(|image| image.formula.as_str());
        let function = images.iter().map(|image| image.name.as_str()).filter(|_| is_rate);
        let formula = claim.formula.as_deref().filter(|_| images.is_empty());
        let used: Vec<&str> = used.chain(function).chain(formula).collect();
        let definitions = used_by(&used, &self.definitions);
        let statement = match (formula, images.as_slice()) {
            (_, [rate]) if is_rate => paper.rate(&rate.name, &rate.formula),
            (Some(formula), _) => paper.formula(formula),
            (None, []) => None,
            (None, images) if claim.kind == SymmetryField::NAME => paper.field(images),
            (None, images) => paper.images(images),
        };
        TestedClaim {
            shown: Shown { statement, definitions: paper.definitions(&definitions) },
            // A note concerns the formulas of its family.
            remark: self.note.clone().filter(|_| images.is_empty() || is_rate),
            definitions,
            claim,
            images,
            family: self.family.clone(),
            fixed_set: None,
            values: None,
            is_general: self.is_general,
        }
    }
}

/// Returns the table of formulas in a claim, if it has one.
fn table_of(claim: &Claim) -> Vec<Definition> {
    match claim.entry(claim.key()) {
        Some(ClaimEntry::Table(table)) => {
            table.iter().map(|(name, formula)| define(name, formula.text())).collect()
        }
        _ => Vec::new(),
    }
}
