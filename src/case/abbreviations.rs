//! `[let]`: names for formulas that others use.

use super::body;
use super::error::{CaseError, Problem};
use super::section::Text;
use super::systems::Reading;
use crate::formula::canonical_name;
use crate::mechanics::{Meaning, Reach};

impl Reading<'_, '_> {
    /// Reads `[let]`: each abbreviation may use those before it.
    pub(super) fn read_abbreviations(&mut self) -> Result<(), CaseError> {
        let Some(section) = self.root.section("let")? else { return Ok(()) };
        let rates: Vec<String> =
            self.state.variables.iter().map(|variable| format!("{}'", variable.name)).collect();
        for (key, value) in section.entries() {
            let text = section.as_text(key.get_ref(), value)?;
            let uses = |name: &String| text.value.contains(name.as_str());
            let unknown = |name: &String| self.vocabulary.find(name).is_none();
            if rates.iter().any(|name| unknown(name) && uses(name)) || self.waiting.iter().any(uses)
            {
                self.waiting.push(key.get_ref().to_string());
            } else {
                self.abbreviate(key.get_ref(), key.span(), &text)?;
            }
        }
        Ok(())
    }

    /// Reads the abbreviations that use rates.
    pub(super) fn read_waiting(&mut self) -> Result<(), CaseError> {
        let Some(section) = self.root.section("let")? else { return Ok(()) };
        for (key, value) in section.entries() {
            if self.waiting.iter().any(|name| name == key.get_ref().as_ref()) {
                let text = section.as_text(key.get_ref(), value)?;
                self.abbreviate(key.get_ref(), key.span(), &text)?;
            }
        }
        Ok(())
    }

    fn abbreviate(
        &mut self,
        key: &str,
        place: std::ops::Range<usize>,
        text: &Text,
    ) -> Result<(), CaseError> {
        let bad = |reason: &str| {
            let (name, reason) = (key.to_string(), reason.to_string());
            CaseError::at(place.clone(), Problem::BadName { name, reason })
        };
        let name = canonical_name(key)
            .ok_or_else(|| bad("a name is letters, then digits, primes or _"))?;
        match self.vocabulary.find(&name).map(|entry| entry.meaning) {
            None => {}
            Some(Meaning::Quantity(_)) => self.hidden.push(name.clone()),
            Some(_) => return Err(bad("it is taken already")),
        }
        let read = body::formula(text, &self.vocabulary, &name, None, Reach::Phase)?;
        let reach = self.vocabulary.reach(&read).map_or(Reach::Parameters, |entry| entry.reach);
        let meaning = Meaning::Abbreviation(self.abbreviations.len());
        self.vocabulary.add(&name, meaning, read.value_type(), reach);
        self.abbreviations.push(read);
        Ok(())
    }
}
