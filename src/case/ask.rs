//! Further claims about the same system, for questions of the program itself.

use toml::de::DeTable;

use super::claims::{self, ClaimContext};
use super::error::{CaseError, Mistake, Problem};
use super::formulas::formula;
use super::mistakes::Mistakes;
use super::parameters::named;
use super::section::CaseTable;
use super::{Case, PlacedClaim, toml_errors, variables};
use crate::mechanics::{Dependence, Model};

/// Tables of a question.
const KEYS: [&str; 4] = ["let", "variables", "poisson", "claim"];

impl Case {
    /// Returns the same system with the claims of `text`, which has the tables `[let]`,
    /// `[variables]`, `[poisson]` and `[[claim]]` of a case file, and nothing else.
    ///
    /// Names have the same meaning as in the case; an abbreviation of the text hides a name of the
    /// case. Weights are not checked, and a claim has no source unless it names one.
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
        let (document, errors) = DeTable::parse_recoverable(text);
        if !errors.is_empty() {
            return Err(CaseError::new(toml_errors::mistakes(text, &errors), text));
        }
        let mistakes = Mistakes::default();
        let asked = {
            let root = CaseTable::new("the question", document.get_ref(), 0..0, text, &mistakes);
            self.asked(&root)
        };
        match mistakes.is_empty() {
            true => Ok(asked),
            false => Err(CaseError::new(mistakes.into_list(), text)),
        }
    }

    fn asked(&self, root: &CaseTable<'_>) -> Case {
        root.allow(&KEYS);
        let mut asked = self.clone();
        asked.motions.clear();
        asked.absences.clear();
        asked.without_time = None;
        if let Some(section) = root.table("let") {
            abbreviate(&section, &mut asked.model);
        }
        if root.value("variables").is_some() || root.value("poisson").is_some() {
            asked.model.variables = None;
            variables::read(root, &mut asked.model);
        }
        let is_whole = root.mistakes().is_empty();
        let plan = asked.section.as_ref();
        let context = ClaimContext { model: &asked.model, is_whole, plan, source: "" };
        let (mut stated, mut names) = (Vec::new(), Vec::new());
        for section in root.tables("claim") {
            let claim = claims::read(&section, &context, &names);
            let claim = claim.and_then(|claim| {
                self.check_degrees(&claim, &section)?;
                Ok(claim)
            });
            if let Some(claim) = root.keep(claim) {
                names.push(claim.name.clone());
                stated.push(claim);
            }
        }
        asked.claims = stated;
        asked
    }

    /// Checks that the arbitrary functions, whose degree fits the claims of the file, fit this
    /// claim.
    fn check_degrees(&self, claim: &PlacedClaim, section: &CaseTable<'_>) -> Result<(), Mistake> {
        self.check_degree(claim.kind.name()).map_err(|(message, remedy)| {
            let (message, remedy) = (message.to_string(), remedy.to_string());
            section.complaint(Problem::Other { message, remedy })
        })
    }
}

/// Adds abbreviations, each of which may use those before it.
fn abbreviate(section: &CaseTable<'_>, model: &mut Model) {
    for (key, value) in section.entries() {
        let read = named(key).and_then(|name| {
            let text = section.as_text(key.get_ref(), value)?;
            let read = formula(&text, &model.vocabulary, &name, None, Dependence::Phase)?;
            Ok((name, read))
        });
        let Some((name, read)) = section.keep(read) else {
            section.mistakes().fail(key.get_ref());
            continue;
        };
        let reach =
            model.vocabulary.reach(&read).map_or(Dependence::Parameters, |entry| entry.reach);
        model.vocabulary.define(&name, model.abbreviations.len(), &read, reach);
        model.abbreviations.push(read);
    }
}
