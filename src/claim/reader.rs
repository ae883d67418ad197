//! What a kind of claim asks of the text it is read from.

use crate::formula::{Formula, Type};
use crate::mechanics::{Model, Vocabulary};

/// A number by its real part, and a pair of conjugate ones by both parts.
pub type Complex = (Formula, Option<Formula>);

/// The entries of one claim, whatever file format they stand in.
pub trait Reader {
    /// A complaint that knows its place in the text.
    type Error;

    /// The case that the claim is about.
    fn model(&self) -> &Model;

    /// The text under a key.
    fn text(&self, key: &'static str) -> Result<Option<String>, Self::Error>;

    /// The texts of a list; one text by itself is a list of one.
    fn texts(&self, key: &'static str) -> Result<Option<Vec<String>>, Self::Error>;

    /// The formula under a key, in the names of `scope`; of any kind if none is given.
    fn formula_in(
        &self,
        key: &'static str,
        kind: Option<Type>,
        scope: &Vocabulary,
    ) -> Result<Option<Formula>, Self::Error>;

    /// The formulas of a list, in the names of `scope`.
    fn list_in(
        &self,
        key: &'static str,
        scope: &Vocabulary,
    ) -> Result<Option<Vec<Formula>>, Self::Error>;

    /// The two sides of an equation `A = B`.
    fn equation(&self, key: &'static str) -> Result<(Formula, Formula), Self::Error>;

    /// The entries of a table of formulas: name and formula, in the names of `scope`.
    fn table_in(
        &self,
        key: &'static str,
        scope: &Vocabulary,
    ) -> Result<Option<Vec<(String, Formula)>>, Self::Error>;

    /// The same of the table under `inner` in the table under `key`, which has no keys but `known`.
    fn table_inside(
        &self,
        key: &'static str,
        inner: &'static str,
        known: &[&'static str],
        scope: &Vocabulary,
    ) -> Result<Option<Vec<(String, Formula)>>, Self::Error>;

    /// The entries of a list of numbers that may be complex: a, or a and b for a ± b*i.
    fn complex_list(&self, key: &'static str) -> Result<Option<Vec<Complex>>, Self::Error>;

    /// A complaint about an entry.
    fn complaint(&self, key: &'static str, message: String, remedy: &str) -> Self::Error;

    /// The formula under a key, in the names of the case.
    fn formula(
        &self,
        key: &'static str,
        kind: Option<Type>,
    ) -> Result<Option<Formula>, Self::Error> {
        self.formula_in(key, kind, &self.model().vocabulary)
    }

    /// The formulas of a list, in the names of the case.
    fn list(&self, key: &'static str) -> Result<Option<Vec<Formula>>, Self::Error> {
        self.list_in(key, &self.model().vocabulary)
    }

    /// The formula under a key that must be there.
    fn required(&self, key: &'static str, kind: Option<Type>) -> Result<Formula, Self::Error> {
        self.formula(key, kind)?.ok_or_else(|| self.missing(key))
    }

    /// The entries of a table of formulas that must be there, in the names of the case.
    fn table(&self, key: &'static str) -> Result<Vec<(String, Formula)>, Self::Error> {
        self.table_in(key, &self.model().vocabulary)?.ok_or_else(|| self.missing(key))
    }

    /// Reads `key = "holds"` or the like, where a claim is about no formula.
    fn word(&self, key: &'static str, word: &'static str) -> Result<(), Self::Error> {
        match self.text(key)? {
            Some(found) if found == word => Ok(()),
            Some(found) => Err(self.complaint(
                key,
                format!("`{found}` is not what can be claimed here"),
                &format!("write \"{word}\", and expect = \"fails\" where it does not"),
            )),
            None => Err(self.missing(key)),
        }
    }

    /// The complaint that an entry is missing.
    fn missing(&self, key: &'static str) -> Self::Error {
        self.complaint(key, format!("the claim has no `{key}`"), &format!("add {key} = \"…\""))
    }

    /// The complaint that two formulas are of different kinds.
    fn unlike(&self, key: &'static str, left: Type, right: Type) -> Self::Error {
        let message = format!("a {left} is compared with a {right}");
        self.complaint(key, message, "compare what is of one kind")
    }
}
