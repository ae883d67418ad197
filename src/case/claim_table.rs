//! Claims as values, read like the tables of a file.

use super::claim_error::ClaimError;
use super::equations::both_sides;
use crate::claim::{Claim, ClaimEntry, ClaimKind, ComplexFormula, LevelSubset, Locus, Reader};
use crate::formula::{Formula, Type, canonical_name};
use crate::mechanics::{Model, Vocabulary};

/// The error for a formula in the names of another case.
pub(super) fn stranger(what: &str, name: &str) -> ClaimError {
    let message = format!("`{name}` is not a name of this case with the same meaning");
    ClaimError::new(
        what,
        message,
        "build the formula from the names of the case in which it is used",
    )
}

/// A claim as a value, read like the table of a file.
pub(super) struct ClaimTable<'v> {
    pub claim: &'v Claim,
    pub model: &'v Model,
}

impl ClaimTable<'_> {
    /// Fails for a key that this kind of claim does not have.
    pub fn check_keys(&self) -> Result<(), ClaimError> {
        let companions = ClaimKind::companions(self.claim.key());
        let mut others = self.claim.entries().iter().map(|(key, _)| *key).skip(1);
        match others.find(|key| !companions.contains(key)) {
            None => Ok(()),
            Some(key) => {
                let remedy = match companions {
                    [] => "it has no further keys".to_string(),
                    known => format!("its keys are {}", known.join(", ")),
                };
                let message = format!("the claim has no `{key}`");
                Err(self.complaint(self.claim.key(), message, &remedy))
            }
        }
    }

    /// Returns the name that is set, or the text of the statement, with a number if it is taken.
    pub fn name(&self, kind: &ClaimKind, taken: &[String]) -> Result<String, ClaimError> {
        let is_taken = |name: &String| taken.contains(name);
        if let Some(name) = self.claim.name().map(str::to_string) {
            if is_taken(&name) {
                let message = format!("two claims are called `{name}`");
                return Err(self.complaint(kind.name(), message, "give each a different name"));
            }
            return Ok(name);
        }
        let base = kind.text().unwrap_or_else(|| kind.name().to_string());
        let numbered = (2..).map(|number| format!("{base} ({number})"));
        let mut names = std::iter::once(base.clone()).chain(numbered);
        Ok(names.find(|name| !is_taken(name)).unwrap_or(base))
    }

    pub fn place(&self) -> Result<(LevelSubset, bool), ClaimError> {
        let model = self.model;
        match self.claim.locus() {
            Locus::Level => Ok((LevelSubset::level(model), false)),
            Locus::LevelOnly => Ok((LevelSubset::level(model), true)),
            Locus::Everywhere => Ok((LevelSubset::everywhere(model), false)),
            Locus::Equation(text) => match LevelSubset::equation(model, text) {
                Some(place) => Ok((place, false)),
                None => {
                    let message = format!("`{text}` is not a place of this case");
                    let remedy = "give one of the equations of the level set";
                    Err(self.complaint(self.claim.key(), message, remedy))
                }
            },
        }
    }

    /// Checks that a formula is in the names of `scope`, and of the required type.
    fn fits(
        &self,
        key: &str,
        formula: &Formula,
        kind: Option<Type>,
        scope: &Vocabulary,
    ) -> Result<Formula, ClaimError> {
        // hidden names of the case keep their meaning; names of its variables have another
        let is_own = std::ptr::eq(scope, &self.model.vocabulary);
        let known = if is_own { scope.check_own(formula) } else { scope.check_named(formula) };
        known.map_err(|name| stranger(&self.what(), &name))?;
        match kind {
            Some(kind) if kind != formula.value_type() => {
                let message =
                    format!("`{key}` is a {}, and has to be a {kind}", formula.value_type());
                Err(ClaimError::new(&self.what(), message, "give a formula of that type"))
            }
            _ => Ok(formula.clone()),
        }
    }

    fn read(
        &self,
        key: &str,
        entry: &ClaimEntry,
        kind: Option<Type>,
        scope: &Vocabulary,
    ) -> Result<Formula, ClaimError> {
        match entry {
            ClaimEntry::Formula(formula) => self.fits(key, formula, kind, scope),
            ClaimEntry::Text(text) => {
                let read = Formula::parse(text, scope).map_err(|error| {
                    let help = error.help().unwrap_or("write it in the names of the case");
                    ClaimError::new(&self.what(), error.message(), help)
                })?;
                self.fits(key, &read, kind, scope)
            }
            _ => Err(self.unfit(key, "a formula")),
        }
    }

    fn table_of(
        &self,
        table: &[(String, Formula)],
        scope: &Vocabulary,
    ) -> Result<Vec<(String, Formula)>, ClaimError> {
        let read = |(name, formula): &(String, Formula)| {
            let canonical = canonical_name(name).unwrap_or_else(|| name.clone());
            Ok((canonical, self.fits(name, formula, None, scope)?))
        };
        table.iter().map(read).collect()
    }

    fn what(&self) -> String {
        match self.claim.name() {
            Some(name) => format!("the claim `{name}`"),
            None => format!("a claim `{}`", self.claim.key()),
        }
    }

    fn unfit(&self, key: &str, wanted: &str) -> ClaimError {
        let message = format!("`{key}` is not {wanted}");
        ClaimError::new(&self.what(), message, &format!("give {wanted}"))
    }
}

impl Reader for ClaimTable<'_> {
    type Error = ClaimError;

    fn model(&self) -> &Model {
        self.model
    }

    fn text(&self, key: &'static str) -> Result<Option<String>, ClaimError> {
        match self.claim.entry(key) {
            None => Ok(None),
            Some(ClaimEntry::Text(text)) => Ok(Some(text.clone())),
            Some(ClaimEntry::Formula(formula)) => Ok(Some(formula.to_string())),
            Some(_) => Err(self.unfit(key, "a text")),
        }
    }

    fn texts(&self, key: &'static str) -> Result<Option<Vec<String>>, ClaimError> {
        match self.claim.entry(key) {
            Some(ClaimEntry::List(list)) => {
                Ok(Some(list.iter().map(ToString::to_string).collect()))
            }
            _ => Ok(self.text(key)?.map(|text| vec![text])),
        }
    }

    fn formula_in(
        &self,
        key: &'static str,
        kind: Option<Type>,
        scope: &Vocabulary,
    ) -> Result<Option<Formula>, ClaimError> {
        let entry = self.claim.entry(key);
        entry.map(|entry| self.read(key, entry, kind, scope)).transpose()
    }

    fn list_in(
        &self,
        key: &'static str,
        scope: &Vocabulary,
    ) -> Result<Option<Vec<Formula>>, ClaimError> {
        match self.claim.entry(key) {
            None => Ok(None),
            Some(ClaimEntry::List(list)) => list
                .iter()
                .map(|one| self.fits(key, one, None, scope))
                .collect::<Result<_, _>>()
                .map(Some),
            Some(entry) => Ok(Some(vec![self.read(key, entry, None, scope)?])),
        }
    }

    fn complex_list(&self, key: &'static str) -> Result<Option<Vec<ComplexFormula>>, ClaimError> {
        let scope = &self.model.vocabulary;
        match self.claim.entry(key) {
            None => Ok(None),
            Some(ClaimEntry::Complex(list)) => {
                let fits = |part: &Formula| self.fits(key, part, Some(Type::Scalar), scope);
                let read = |(real, imaginary): &ComplexFormula| {
                    Ok((fits(real)?, imaginary.as_ref().map(fits).transpose()?))
                };
                list.iter().map(read).collect::<Result<_, _>>().map(Some)
            }
            Some(_) => Err(self.unfit(key, "a list of numbers")),
        }
    }

    fn equation(&self, key: &'static str) -> Result<(Formula, Formula), ClaimError> {
        let scope = &self.model.vocabulary;
        match self.claim.entry(key) {
            Some(ClaimEntry::Equation(left, right)) => {
                Ok((self.fits(key, left, None, scope)?, self.fits(key, right, None, scope)?))
            }
            Some(ClaimEntry::Text(text)) => match both_sides(text, scope) {
                Some((left, right)) => {
                    Ok((self.fits(key, &left, None, scope)?, self.fits(key, &right, None, scope)?))
                }
                None => Err(self.unfit(key, "an equation \"A = B\" in the names of the case")),
            },
            _ => Err(self.unfit(key, "an equation")),
        }
    }

    fn table_in(
        &self,
        key: &'static str,
        scope: &Vocabulary,
    ) -> Result<Option<Vec<(String, Formula)>>, ClaimError> {
        match self.claim.entry(key) {
            None => Ok(None),
            Some(ClaimEntry::Table(table)) => self.table_of(table, scope).map(Some),
            Some(_) => Err(self.unfit(key, "a table of formulas")),
        }
    }

    fn table_inside(
        &self,
        key: &'static str,
        inner: &'static str,
        known: &[&'static str],
        scope: &Vocabulary,
    ) -> Result<Option<Vec<(String, Formula)>>, ClaimError> {
        let tables = match self.claim.entry(key) {
            None => return Ok(None),
            Some(ClaimEntry::Tables(tables)) => tables,
            Some(_) => return Err(self.unfit(key, "a table of tables")),
        };
        if let Some((other, _)) = tables.iter().find(|(name, _)| !known.contains(name)) {
            let message = format!("`{key}` has no `{other}`");
            return Err(self.complaint(key, message, &format!("give {}", known.join(", "))));
        }
        let own = tables.iter().find(|(name, _)| *name == inner);
        own.map(|(_, table)| self.table_of(table, scope)).transpose()
    }

    fn text_inside(
        &self,
        key: &'static str,
        _: &'static str,
        remedy: &str,
    ) -> Result<Option<String>, ClaimError> {
        match self.claim.entry(key) {
            None => Ok(None),
            Some(_) => Err(self.complaint(key, format!("`{key}` is not a table of texts"), remedy)),
        }
    }

    fn words_in(&self, key: &'static str) -> Result<Option<Vec<(String, String)>>, ClaimError> {
        match self.claim.entry(key) {
            None => Ok(None),
            Some(_) => Err(self.unfit(key, "a table of texts")),
        }
    }

    fn complaint_inside(
        &self,
        key: &'static str,
        inner: &'static str,
        message: String,
        remedy: &str,
    ) -> ClaimError {
        self.complaint(key, format!("{inner}: {message}"), remedy)
    }

    fn not_a_variable(&self, key: &'static str, name: &str, remedy: String) -> ClaimError {
        self.complaint(key, format!("`{name}` is not a state variable"), &remedy)
    }

    fn complaint(&self, _: &'static str, message: String, remedy: &str) -> ClaimError {
        ClaimError::new(&self.what(), message, remedy)
    }
}
