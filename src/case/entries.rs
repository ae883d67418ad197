//! Entries of a claim's table: texts, formulas and lists, each with complaints at its place.

use std::ops::Range;

use toml::de::DeValue;

use super::PlacedClaim;
use super::complex;
use super::equations::sides;
use super::error::{Mistake, Problem};
use super::formulas::formula;
use super::section::{CaseTable, SpannedStr};
use crate::claim::{ComplexFormula, Reader};
use crate::formula::{Formula, Type, canonical_name, excerpt};
use crate::mechanics::{Dependence, Model, Vocabulary};

/// Entries of a claim in a case file.
pub struct Entries<'e, 's> {
    /// Its table.
    pub section: &'e CaseTable<'s>,
    /// The case that it is about.
    pub model: &'e Model,
    /// Whether nothing of the case is left out because of a mistake.
    pub is_whole: bool,
    /// Claims before it, whose names stand for their formulas in a list of integrals.
    pub claims: &'e [PlacedClaim],
}

impl Reader for Entries<'_, '_> {
    type Error = Mistake;

    fn model(&self) -> &Model {
        self.model
    }

    fn complete_model(&self) -> Option<&Model> {
        self.is_whole.then_some(self.model)
    }

    fn text(&self, key: &'static str) -> Result<Option<String>, Mistake> {
        Ok(self.section.text(key)?.map(|text| text.value))
    }

    fn texts(&self, key: &'static str) -> Result<Option<Vec<String>>, Mistake> {
        if self.section.value(key).is_none() {
            return Ok(None);
        }
        let texts = self.section.texts(key)?;
        Ok(Some(texts.into_iter().map(|text| text.value).collect()))
    }

    fn formula_in(
        &self,
        key: &'static str,
        kind: Option<Type>,
        scope: &Vocabulary,
    ) -> Result<Option<Formula>, Mistake> {
        let Some(text) = self.section.text(key)? else { return Ok(None) };
        formula(&text, scope, &format!("`{key}`"), kind, Dependence::Phase).map(Some)
    }

    fn list_in(
        &self,
        key: &'static str,
        scope: &Vocabulary,
    ) -> Result<Option<Vec<Formula>>, Mistake> {
        if self.section.value(key).is_none() {
            return Ok(None);
        }
        let texts = self.section.texts(key)?;
        let claimed = |name: &str| {
            let own =
                self.claims.iter().find(|own| key == "integrals" && own.name == name.trim())?;
            own.kind.formula().cloned()
        };
        let read = |text: &SpannedStr| match claimed(&text.value) {
            Some(formula) => Ok(formula),
            None => formula(text, scope, "an entry", None, Dependence::Phase),
        };
        texts.iter().map(read).collect::<Result<_, _>>().map(Some)
    }

    fn complex_list(&self, key: &'static str) -> Result<Option<Vec<ComplexFormula>>, Mistake> {
        if self.section.value(key).is_none() {
            return Ok(None);
        }
        let texts = self.section.texts(key)?;
        let read = |text: &SpannedStr| complex::read(text, &self.model.vocabulary);
        texts.iter().map(read).collect::<Result<_, _>>().map(Some)
    }

    fn equation(&self, key: &'static str) -> Result<(Formula, Formula), Mistake> {
        let text = self.section.text(key)?.ok_or_else(|| self.missing(key))?;
        let Some((left, right, second)) = sides(&text.value) else {
            let message = format!("`{key}` has two sides");
            return Err(mistake_at(&text, message, "write \"A = B\""));
        };
        let read = |side: &str, start: usize| {
            Formula::parse(side, &self.model.vocabulary).map_err(|error| {
                let span = error.span();
                let place = text.locate(start + span.start..start + span.end);
                Mistake::at(place, Problem::Formula(error))
            })
        };
        Ok((read(left, 0)?, read(right, second)?))
    }

    fn table_in(
        &self,
        key: &'static str,
        scope: &Vocabulary,
    ) -> Result<Option<Vec<(String, Formula)>>, Mistake> {
        let section = self.section.section(key)?;
        section.map(|section| formulas_of(&section, scope)).transpose()
    }

    fn table_inside(
        &self,
        key: &'static str,
        inner: &'static str,
        known: &[&'static str],
        scope: &Vocabulary,
    ) -> Result<Option<Vec<(String, Formula)>>, Mistake> {
        let Some(outer) = self.section.section(key)? else { return Ok(None) };
        outer.allow(known);
        outer.section(inner)?.map(|section| formulas_of(&section, scope)).transpose()
    }

    fn text_inside(
        &self,
        key: &'static str,
        inner: &'static str,
        remedy: &str,
    ) -> Result<Option<String>, Mistake> {
        if self.section.value(key).is_none() {
            return Ok(None);
        }
        let Ok(Some(table)) = self.section.section(key) else {
            let message = format!("`{key}` does not state a degree");
            return Err(self.complaint(key, message, remedy));
        };
        table.allow(&[inner]);
        match table.value(inner) {
            None => Err(self.complaint(key, format!("`{key}` has no `{inner}`"), remedy)),
            Some(value) => Ok(Some(match value.get_ref() {
                DeValue::Integer(number) => number.to_string(),
                DeValue::Float(number) => number.to_string(),
                DeValue::String(text) => excerpt(&format!("\"{text}\"")),
                _ => inner.to_string(),
            })),
        }
    }

    fn words_in(&self, key: &'static str) -> Result<Option<Vec<(String, String)>>, Mistake> {
        let Some(section) = self.section.section(key)? else { return Ok(None) };
        let mut words = Vec::new();
        for (key, value) in section.entries() {
            let name = canonical_name(key.get_ref()).unwrap_or_else(|| key.get_ref().to_string());
            words.push((name, section.as_text(key.get_ref(), value)?.value));
        }
        Ok(Some(words))
    }

    fn complaint_inside(
        &self,
        key: &'static str,
        inner: &'static str,
        message: String,
        remedy: &str,
    ) -> Mistake {
        let table = self.section.section(key).ok().flatten();
        let own = table.and_then(|table| Some(table.value(inner)?.span()));
        let span = own.unwrap_or_else(|| place_of(self.section, key));
        Mistake::at(span, Problem::Other { message, remedy: remedy.to_string() })
    }

    fn not_a_variable(&self, key: &'static str, name: &str, remedy: String) -> Mistake {
        let span = place_of(self.section, key);
        Mistake::at(span, Problem::NotAVariable { name: name.to_string(), remedy })
    }

    fn complaint(&self, key: &'static str, message: String, remedy: &str) -> Mistake {
        let span = place_of(self.section, key);
        Mistake::at(span, Problem::Other { message, remedy: remedy.to_string() })
    }
}

/// Entries of a table of formulas: name and formula.
fn formulas_of(
    section: &CaseTable<'_>,
    scope: &Vocabulary,
) -> Result<Vec<(String, Formula)>, Mistake> {
    let mut entries = Vec::new();
    for (key, value) in section.entries() {
        let name = canonical_name(key.get_ref()).unwrap_or_else(|| key.get_ref().to_string());
        let text = section.as_text(key.get_ref(), value)?;
        let read = formula(&text, scope, &format!("`{name}`"), None, Dependence::Phase)?;
        entries.push((name, read));
    }
    Ok(entries)
}

/// Place of a key's value, or of its table.
pub fn place_of(section: &CaseTable<'_>, key: &'static str) -> Range<usize> {
    section.value(key).map_or(section.span.clone(), |value| value.span())
}

/// The mistake in a text, with its remedy.
pub fn mistake_at(text: &SpannedStr, message: String, remedy: &str) -> Mistake {
    Mistake::at(text.span.clone(), Problem::Other { message, remedy: remedy.to_string() })
}
