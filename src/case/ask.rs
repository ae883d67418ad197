//! Other claims about the same system: how the tool itself asks what a file does not.

use toml::de::DeTable;

use super::body::formula;
use super::error::{CaseError, Problem};
use super::parameters::named;
use super::section::Section;
use super::{Case, Claim, claims, variables};
use crate::claim::jets;
use crate::mechanics::{Meaning, Model, Reach};

/// The tables that a question has.
const KEYS: [&str; 4] = ["let", "variables", "poisson", "claim"];

impl Case {
    /// The same system with the claims of `text`, which has the tables `[let]`, `[variables]`,
    /// `[poisson]` and `[[claim]]` of a case file, and nothing else.
    ///
    /// Names mean what they mean in the case; an abbreviation of the text hides a name of the case.
    /// Weights are not checked, and a claim has no source but its own.
    ///
    /// ```
    /// use liouville::case::Case;
    /// use liouville::verdict::{Options, Verdict, judge};
    ///
    /// let case = Case::parse(
    ///     r#"
    ///     title = "any body"
    ///     system = "rubber-plane"
    ///     [parameters]
    ///     m = "0.5..2"
    ///     I = "inertia(0.5..5)"
    ///     [body]
    ///     support = "arbitrary"
    ///     "#,
    ///     &[],
    /// )?;
    /// let asked = case.ask("[[claim]]\nintegral = \"energy\"")?;
    /// let report = judge(&asked, &Options::default()).expect("the equations are regular");
    /// assert_eq!(report.claims[0].verdict, Verdict::Proved);
    /// # Ok::<(), liouville::case::CaseError>(())
    /// ```
    pub fn ask(&self, text: &str) -> Result<Case, CaseError> {
        let document = DeTable::parse(text).map_err(|error| {
            let message = error.message().to_string();
            CaseError { span: error.span(), problem: Problem::Toml { message, help: None } }
        })?;
        let root = Section::new("the question", document.get_ref(), 0..0, text);
        root.allow(&KEYS)?;
        let mut asked = self.clone();
        asked.motions.clear();
        if let Some(section) = root.section("let")? {
            abbreviate(&section, &mut asked.model)?;
        }
        if root.section("variables")?.is_some() {
            asked.model.variables = None;
            variables::read(&root, &mut asked.model)?;
        }
        let (mut stated, mut names) = (Vec::new(), Vec::new());
        for section in root.sections("claim")? {
            let claim = claims::read(&section, &asked.model, &names, "")?;
            self.check_degrees(&claim, &section)?;
            names.push(claim.name.clone());
            stated.push(claim);
        }
        asked.claims = stated;
        Ok(asked)
    }
}

impl Case {
    /// Arbitrary functions have the degree that the claims of the file need.
    fn check_degrees(&self, claim: &Claim, section: &Section<'_>) -> Result<(), CaseError> {
        let needed = |claim: &Claim| jets(claim.kind.name());
        let has = self.claims.iter().map(needed).max().unwrap_or_default();
        if needed(claim) <= has || !self.model.system.has_arbitrary_function() {
            return Ok(());
        }
        let message = "the arbitrary functions of this case have too low a degree for this claim";
        let remedy = "state a claim of this kind in the case file";
        Err(section
            .complaint(Problem::Other { message: message.to_string(), remedy: remedy.to_string() }))
    }
}

/// Adds abbreviations, each of which may use those before it.
fn abbreviate(section: &Section<'_>, model: &mut Model) -> Result<(), CaseError> {
    for (key, value) in section.entries() {
        let name = named(key)?;
        let text = section.as_text(key.get_ref(), value)?;
        let read = formula(&text, &model.vocabulary, &name, None, Reach::Phase)?;
        let reach = model.vocabulary.reach(&read).map_or(Reach::Parameters, |entry| entry.reach);
        let meaning = Meaning::Abbreviation(model.abbreviations.len());
        model.vocabulary.add(&name, meaning, read.value_type(), reach);
        model.abbreviations.push(read);
    }
    Ok(())
}
