//! The table `[let]`: names for formulas used elsewhere, in any order.

use super::error::{Mistake, Problem};
use super::formulas::formula;
use super::order::{ItemKind, Stage, WaitingName};
use super::parameters::named;
use super::section::SpannedStr;
use super::systems::Reading;
use crate::formula::{Formula, Type};
use crate::mechanics::{Dependence, Meaning};

impl Reading<'_, '_> {
    /// Lists the names of `[let]`, without reading their formulas.
    pub(super) fn list_abbreviations(&mut self) {
        let Some(section) = self.root.table("let") else { return };
        for (key, value) in section.entries() {
            let Some(name) = self.mistakes().keep(named(key)) else { continue };
            let known = self.items.iter().any(|item| item.name == name);
            match self.mistakes().keep(section.as_text(key.get_ref(), value)) {
                _ if known => self.taken(&name, key.span()),
                None => self.mistakes().fail(&name),
                Some(text) => {
                    self.items.push(WaitingName::new(
                        name,
                        key.span(),
                        ItemKind::Abbreviation(text),
                    ));
                }
            }
        }
    }

    /// Lists the matrices that are made of components of the state, and their rates.
    pub(super) fn list_shapes(&mut self) {
        let variables = self.state.variables.clone();
        let is_declared = |name: &str| {
            variables.iter().any(|own| own.shape.as_ref().is_some_and(|shape| shape.name == name))
        };
        for own in &variables {
            let Some(shape) = &own.shape else { continue };
            let rate = format!("{}'", shape.name);
            let rates = (!is_declared(&rate)).then(|| (rate, format!("{}'", own.name)));
            let both = [(shape.name.clone(), own.name.clone())].into_iter().chain(rates);
            for (name, vector) in both {
                let is_known = self.items.iter().any(|item| item.name == name);
                if is_known && name != shape.name {
                    continue;
                }
                let text = SpannedStr::made(shape.text(&vector), 0..0);
                if is_known {
                    self.taken(&name, 0..0);
                } else {
                    let kind = ItemKind::Abbreviation(text);
                    self.items.push(WaitingName::new(name, 0..0, kind));
                }
            }
        }
    }

    fn taken(&self, name: &str, place: std::ops::Range<usize>) {
        let (name, reason) = (name.to_string(), "it is taken already".to_string());
        self.mistakes().add(Mistake::at(place, Problem::BadName { name, reason }));
    }

    /// Reads one abbreviation, if all names in it are known.
    pub(super) fn abbreviate(
        &mut self,
        item: usize,
        text: &SpannedStr,
        stage: Stage,
    ) -> Result<(), Mistake> {
        let name = self.items[item].name.clone();
        let hides = match self.vocabulary.find(&name).map(|entry| entry.meaning) {
            None => false,
            Some(Meaning::Quantity(_)) => true,
            Some(_) => {
                let (place, reason) = (self.items[item].key.clone(), "it is taken already");
                let problem = Problem::BadName { name, reason: reason.to_string() };
                return Err(Mistake::at(place, problem));
            }
        };
        let reach =
            if stage == Stage::Parameters { Dependence::Parameters } else { Dependence::Phase };
        let read = formula(text, &self.vocabulary, &name, None, reach)?;
        let reach =
            self.vocabulary.reach(&read).map_or(Dependence::Parameters, |entry| entry.reach);
        let kind = read.value_type();
        self.vocabulary.define(&name, self.abbreviations.len(), &read, reach);
        if (kind, reach) == (Type::Scalar, Dependence::Parameters)
            && let Ok(whole) = Formula::whole_number(read.text(), &self.vocabulary)
        {
            self.vocabulary.set_whole(&name, whole);
        }
        self.abbreviations.push(read);
        if hides {
            self.hidden.push(name);
        }
        Ok(())
    }
}
