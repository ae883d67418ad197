//! Interface from which claims are read.

use crate::formula::{Formula, Type};
use crate::mechanics::{Model, Vocabulary};

/// A real number, or the real and the imaginary part of a conjugate pair.
pub type ComplexFormula = (Formula, Option<Formula>);

/// The entries of one claim, independent of the file format.
pub trait Reader {
    /// A complaint with its place in the text.
    type Error;

    /// Returns the model of the case.
    fn model(&self) -> &Model;

    /// Returns the model if it can be evaluated: a mistake in the file may have left parts out.
    fn complete_model(&self) -> Option<&Model> {
        Some(self.model())
    }

    /// Returns the text of a key.
    fn text(&self, key: &'static str) -> Result<Option<String>, Self::Error>;

    /// Returns the texts of a list; a single text is a list of one.
    fn texts(&self, key: &'static str) -> Result<Option<Vec<String>>, Self::Error>;

    /// Returns the formula of a key, in the names of `scope`; of any type if none is given.
    fn formula_in(
        &self,
        key: &'static str,
        kind: Option<Type>,
        scope: &Vocabulary,
    ) -> Result<Option<Formula>, Self::Error>;

    /// Returns the formulas of a list, in the names of `scope`.
    fn list_in(
        &self,
        key: &'static str,
        scope: &Vocabulary,
    ) -> Result<Option<Vec<Formula>>, Self::Error>;

    /// Returns the two sides of an equation `A = B`.
    fn equation(&self, key: &'static str) -> Result<(Formula, Formula), Self::Error>;

    /// Returns the entries of a table of formulas, each a name and a formula in the names of
    /// `scope`.
    fn table_in(
        &self,
        key: &'static str,
        scope: &Vocabulary,
    ) -> Result<Option<Vec<(String, Formula)>>, Self::Error>;

    /// Returns the entries of the table of `inner` inside the table of `key`, which may contain the
    /// keys `known` only.
    fn table_inside(
        &self,
        key: &'static str,
        inner: &'static str,
        known: &[&'static str],
        scope: &Vocabulary,
    ) -> Result<Option<Vec<(String, Formula)>>, Self::Error>;

    /// Returns the number of `inner` in the table of `key`, which has no other keys, as written in
    /// the file, a string with its quotes; if there is no such table, the complaint has this
    /// `remedy`.
    fn text_inside(
        &self,
        key: &'static str,
        inner: &'static str,
        remedy: &str,
    ) -> Result<Option<String>, Self::Error>;

    /// Returns the entries of a table of texts, each with its name.
    fn words_in(&self, key: &'static str) -> Result<Option<Vec<(String, String)>>, Self::Error>;

    /// Makes a complaint about the entry of `inner` in the table of `key`.
    fn complaint_inside(
        &self,
        key: &'static str,
        inner: &'static str,
        message: String,
        remedy: &str,
    ) -> Self::Error;

    /// Returns the entries of a list of real or complex numbers: a, or a and b for a ± b*i.
    fn complex_list(&self, key: &'static str) -> Result<Option<Vec<ComplexFormula>>, Self::Error>;

    /// Makes a complaint about an entry.
    fn complaint(&self, key: &'static str, message: String, remedy: &str) -> Self::Error;

    /// Makes a complaint about a name that is none of a state variable.
    fn not_a_variable(&self, key: &'static str, name: &str, remedy: String) -> Self::Error;

    /// Returns the formula of a key, in the names of the case.
    fn formula(
        &self,
        key: &'static str,
        kind: Option<Type>,
    ) -> Result<Option<Formula>, Self::Error> {
        self.formula_in(key, kind, &self.model().vocabulary)
    }

    /// Returns the formulas of a list, in the names of the case.
    fn list(&self, key: &'static str) -> Result<Option<Vec<Formula>>, Self::Error> {
        self.list_in(key, &self.model().vocabulary)
    }

    /// Returns the formula of a required key.
    fn required(&self, key: &'static str, kind: Option<Type>) -> Result<Formula, Self::Error> {
        self.formula(key, kind)?.ok_or_else(|| self.missing(key))
    }

    /// Returns the entries of a required table of formulas, in the names of the case.
    fn table(&self, key: &'static str) -> Result<Vec<(String, Formula)>, Self::Error> {
        self.table_in(key, &self.model().vocabulary)?.ok_or_else(|| self.missing(key))
    }

    /// Reads `key = "holds"` or the like, for a claim without a formula.
    fn word(&self, key: &'static str, word: &'static str) -> Result<(), Self::Error> {
        match self.text(key)? {
            Some(found) if found == word => Ok(()),
            Some(found) => Err(self.complaint(
                key,
                format!("`{found}` is not a value of `{key}`"),
                &format!("write \"{word}\", and expect = \"fails\" where it does not"),
            )),
            None => Err(self.missing(key)),
        }
    }

    /// Makes the complaint that an entry is missing.
    fn missing(&self, key: &'static str) -> Self::Error {
        self.complaint(key, format!("the claim has no `{key}`"), &format!("add {key} = \"…\""))
    }

    /// Makes the complaint that two formulas have different types.
    fn unlike(&self, key: &'static str, left: Type, right: Type) -> Self::Error {
        let message = format!("a {left} is compared with a {right}");
        self.complaint(key, message, "compare values of the same type")
    }
}
