//! Typesetting of the formulas of a finding.

use super::definitions::Definition;
use liouville::formula::{Formula, Layout, Scope, Symbol, Type};
use liouville::mechanics::Vocabulary;

/// Typeset formulas of a finding.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    /// Statement of the claim.
    pub statement: Option<Layout>,
    /// Names it uses, each as an equation.
    pub definitions: Vec<Layout>,
}

/// Typesetter of texts in the names of a vocabulary.
pub struct Typesetter<'v>(pub &'v Vocabulary);

impl Typesetter<'_> {
    /// Typesets a formula; `None` if it cannot be read.
    pub fn formula(&self, text: &str) -> Option<Layout> {
        self.typed(text).map(|(layout, _)| layout)
    }

    /// Typesets name = formula.
    pub fn definition(&self, definition: &Definition) -> Option<Layout> {
        let (right, kind) = self.typed(&definition.formula)?;
        Some(Layout::equation(Layout::name(&definition.name, kind), right))
    }

    /// Typesets name ↦ formula for each image.
    pub fn images(&self, images: &[Definition]) -> Option<Layout> {
        let each = images.iter().map(|one| {
            let (right, kind) = self.typed(&one.formula)?;
            Some(Layout::image(Layout::name(&one.name, kind), right))
        });
        Some(Layout::listed(each.collect::<Option<Vec<_>>>()?))
    }

    /// Typesets the rate of a function and its value.
    pub fn rate(&self, function: &str, rate: &str) -> Option<Layout> {
        let function = self.read(function)?.layout_of_factor(&|symbol| self.name(symbol));
        Some(Layout::equation(Layout::rate(function), self.formula(rate)?))
    }

    /// Typesets the zeros of a Darboux polynomial, with its cofactor κ.
    pub fn zeros(&self, function: &str, cofactor: &str) -> Option<Layout> {
        let zero = Layout::Number("0".to_string());
        let zeros = Layout::equation(self.formula(function)?, zero);
        let cofactor = Layout::equation(Layout::name("κ", Type::Scalar), self.formula(cofactor)?);
        Some(Layout::listed([zeros, cofactor]))
    }

    /// Typesets a vector field as a derivation.
    pub fn field(&self, components: &[Definition]) -> Option<Layout> {
        let read = |own: &Definition| Some((own.name.clone(), self.read(&own.formula)?));
        let parts = components.iter().map(read).collect::<Option<Vec<_>>>()?;
        let parts = parts.iter().map(|(name, own)| (name.as_str(), own));
        Some(Layout::derivation(parts, &|symbol| self.name(symbol)))
    }

    /// Typesets all definitions that can be read.
    pub fn definitions(&self, definitions: &[Definition]) -> Vec<Layout> {
        definitions.iter().filter_map(|one| self.definition(one)).collect()
    }

    fn typed(&self, text: &str) -> Option<(Layout, Type)> {
        let formula = self.read(text)?;
        Some((formula.layout(&|symbol| self.name(symbol)), formula.value_type()))
    }

    fn read(&self, text: &str) -> Option<Formula> {
        Formula::parse(text, self.0 as &dyn Scope).ok()
    }

    fn name(&self, symbol: Symbol) -> String {
        self.0.entry(symbol).name.clone()
    }
}
