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
        let mut row = Vec::new();
        for image in each.collect::<Option<Vec<_>>>()? {
            if !row.is_empty() {
                row.extend([Layout::Sign(","), Layout::Space]);
            }
            row.push(image);
        }
        Some(Layout::Row(row))
    }

    /// Typesets the rate of a function and its value.
    pub fn rate(&self, function: &str, rate: &str) -> Option<Layout> {
        let (function, rate) = (self.formula(function)?, self.formula(rate)?);
        let parts = vec![Layout::Word("d"), Layout::Space, function];
        let below = vec![Layout::Word("d"), Layout::name("t", Type::Scalar)];
        let left = Layout::Fraction(Box::new(Layout::Row(parts)), Box::new(Layout::Row(below)));
        Some(Layout::equation(left, rate))
    }

    /// Typesets all definitions that can be read.
    pub fn definitions(&self, definitions: &[Definition]) -> Vec<Layout> {
        definitions.iter().filter_map(|one| self.definition(one)).collect()
    }

    fn typed(&self, text: &str) -> Option<(Layout, Type)> {
        let formula = Formula::parse(text, self.0 as &dyn Scope).ok()?;
        let name = |symbol: Symbol| self.0.entry(symbol).name.clone();
        Some((formula.layout(&name), formula.value_type()))
    }
}
