//! Collection of the mistakes of a file while it is read.

use std::cell::{Cell, RefCell};

use rustc_hash::FxHashSet;

use super::error::{Mistake, Problem};
use crate::formula::canonical_name;
use crate::mechanics::TIME;

/// Mistakes so far, and the names that are unknown only because of them.
#[derive(Default)]
pub struct Mistakes {
    list: RefCell<Vec<Mistake>>,
    failed: RefCell<FxHashSet<String>>,
    /// Abbreviations that are not known yet because they contain rates.
    waiting: RefCell<Vec<String>>,
    /// Abbreviations that are left out, as they use time.
    timed: RefCell<FxHashSet<String>>,
    /// Whether a table could not be read, so that any name may be unknown.
    blind: Cell<bool>,
}

impl Mistakes {
    /// Returns the value read, or `None` after noting the mistake.
    pub fn keep<T>(&self, result: Result<T, Mistake>) -> Option<T> {
        result.map_err(|mistake| self.add(mistake)).ok()
    }

    /// Notes a mistake, unless it follows from another.
    pub fn add(&self, mistake: Mistake) {
        if mistake.unknown_name().is_some_and(|name| self.has_failed(name)) {
            return;
        }
        let mistake = self.explained(mistake);
        let mut list = self.list.borrow_mut();
        let is_known =
            |known: &Mistake| known.span == mistake.span && known.message() == mistake.message();
        if !list.iter().any(is_known) {
            list.push(mistake);
        }
    }

    /// Rewords the mistake about a name that is merely not known yet.
    fn explained(&self, mistake: Mistake) -> Mistake {
        let written = mistake.unknown_name().unwrap_or_default();
        let name = canonical_name(written).unwrap_or_default();
        let waiting = self.waiting.borrow();
        match bases(&name).find_map(|base| waiting.iter().find(|known| *known == base)) {
            None => mistake,
            Some(name) => {
                let message = format!("`{name}` contains a rate, which [field] defines");
                let remedy = "write the formula without rates".to_string();
                Mistake::new(mistake.span, Problem::Other { message, remedy })
            }
        }
    }

    /// Notes which abbreviations are not known yet.
    pub fn wait_for(&self, names: Vec<String>) {
        *self.waiting.borrow_mut() = names;
    }

    /// Notes that a name is declared, but unknown because of a mistake in its declaration.
    pub fn fail(&self, name: &str) {
        self.failed.borrow_mut().insert(name.to_string());
    }

    /// Notes that names may be unknown because a whole table was not read.
    pub fn blind(&self) {
        self.blind.set(true);
    }

    /// Whether the name, as written, is unknown because of a mistake elsewhere.
    pub fn has_failed(&self, written: &str) -> bool {
        if self.blind.get() {
            return true;
        }
        let failed = self.failed.borrow();
        let name = canonical_name(written).unwrap_or_else(|| written.to_string());
        bases(&name).any(|base| failed.contains(base))
    }

    /// Whether there are no mistakes so far.
    pub fn is_empty(&self) -> bool {
        self.list.borrow().is_empty()
    }

    /// Number of mistakes so far.
    pub fn len(&self) -> usize {
        self.list.borrow().len()
    }

    /// Notes that an abbreviation is left out, as it uses time.
    pub fn leave_out(&self, name: &str) {
        self.timed.borrow_mut().insert(name.to_string());
    }

    /// Whether this abbreviation is left out.
    pub fn is_left_out(&self, name: &str) -> bool {
        self.timed.borrow().contains(name)
    }

    /// Whether abbreviations are left out.
    pub fn leaves_out(&self) -> bool {
        !self.timed.borrow().is_empty()
    }

    /// Whether one of the mistakes after the first `before` is that time is unknown, or a name that uses it.
    pub fn lacks_time_since(&self, before: usize) -> bool {
        let (list, timed) = (self.list.borrow(), self.timed.borrow());
        let is_of_time = |written: &str| {
            let name = canonical_name(written).unwrap_or_else(|| written.to_string());
            written == TIME || bases(&name).any(|base| timed.contains(base))
        };
        list.iter().skip(before).any(|mistake| mistake.unknown_name().is_some_and(is_of_time))
    }

    /// Forgets all mistakes after the first `before`.
    pub fn forget_since(&self, before: usize) {
        self.list.borrow_mut().truncate(before);
    }

    /// Returns all mistakes, except missing keys of a table in which a key is misspelt.
    pub fn into_list(self) -> Vec<Mistake> {
        let mut list = self.list.into_inner();
        let misspelt: Vec<String> = list
            .iter()
            .filter_map(|mistake| match &mistake.problem {
                Problem::UnknownKey { section, .. } => Some(section.clone()),
                _ => None,
            })
            .collect();
        list.retain(|mistake| match &mistake.problem {
            Problem::MissingKey { section, .. } | Problem::Incomplete { section, .. } => {
                !misspelt.contains(section)
            }
            _ => true,
        });
        list
    }
}

/// Declared names that a name may refer to: itself, the value it is a component of, or the one it
/// is the rate of.
pub fn bases(name: &str) -> impl Iterator<Item = &str> {
    let bare = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let plain = bare.trim_end_matches('_');
    let own = [name, bare, plain].into_iter();
    own.chain([name, bare].map(|name| name.trim_end_matches('\'')))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_from_a_failed_name_is_left_out() {
        let mistakes = Mistakes::default();
        mistakes.fail("γ");
        for name in ["γ", "gamma3", "γ'", "γ'2", "γ_1"] {
            assert!(mistakes.has_failed(name), "`{name}` is of γ");
        }
        assert!(!mistakes.has_failed("ω"), "another name");
        mistakes.blind();
        assert!(mistakes.has_failed("ω"), "anything may be meant");
    }

    #[test]
    fn the_same_mistake_is_told_once() {
        let mistakes = Mistakes::default();
        for _ in 0..2 {
            mistakes.add(Mistake::at(3..4, Problem::Parameter("wrong".to_string())));
        }
        mistakes.add(Mistake::at(5..6, Problem::Parameter("wrong".to_string())));
        assert_eq!(mistakes.into_list().len(), 2, "two places");
    }
}
