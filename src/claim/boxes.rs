//! Statements of claims as boxes on paper.

use super::components::Components;
use super::images::Transformation;
use crate::formula::{Formula, Layout, Symbol, Type};
use crate::mechanics::{Model, TIME, Variable};

/// Typesetter of formulas in the names of a model.
#[derive(Clone, Copy)]
pub struct Boxes<'m>(pub &'m Model);

impl Boxes<'_> {
    fn named(self, symbol: Symbol) -> String {
        self.0.vocabulary.entry(symbol).name.clone()
    }

    /// Sets a formula.
    pub fn formula(self, formula: &Formula) -> Layout {
        formula.layout(&|symbol| self.named(symbol))
    }

    /// Sets formulas one after another, with commas between them.
    pub fn listed(self, formulas: &[Formula]) -> Layout {
        Layout::listed(formulas.iter().map(|own| self.formula(own)))
    }

    /// Sets a formula as a factor.
    pub fn factor(self, formula: &Formula) -> Layout {
        formula.layout_of_factor(&|symbol| self.named(symbol))
    }

    /// Sets a formula before a factor.
    pub fn product(self, formula: &Formula) -> Layout {
        formula.layout_of_product(&|symbol| self.named(symbol))
    }

    /// Sets the multiple of a box, −x for the factor −1.
    pub fn multiple(self, factor: &Formula, of: Layout) -> Layout {
        match written(factor).as_str() {
            "0" => Layout::Number("0".to_string()),
            "1" => of,
            "-1" => Layout::Row(vec![Layout::Sign("−"), of]),
            _ => Layout::Row(vec![self.factor(factor), Layout::Space, of]),
        }
    }

    /// Sets d f/dt.
    pub fn rate(self, function: &Formula) -> Layout {
        Layout::rate(self.factor(function))
    }

    /// Sets a vector field as a derivation, u ∂/∂x + ….
    pub fn field(self, own: &Components) -> Layout {
        Layout::derivation(own.named(self.0), &|symbol| self.named(symbol))
    }

    /// Sets a point, a name and a value for each variable that is not 0; all of them where all are 0.
    pub fn point(self, own: &Components) -> Layout {
        let name = |variable: &Variable| Layout::name(&variable.name, variable.kind);
        let given: Vec<_> = own.named(self.0).collect();
        if given.is_empty() {
            let mut row = Vec::new();
            for variable in &self.0.state {
                row.extend([name(variable), Layout::Sign("=")]);
            }
            row.push(Layout::Number("0".to_string()));
            return Layout::Row(row);
        }
        let equation = |(name, own): (&str, &Formula)| {
            Layout::equation(Layout::name(name, own.value_type()), self.formula(own))
        };
        Layout::listed(given.into_iter().map(equation))
    }

    /// Sets the images of a map, and that of the time where it is scaled.
    pub(super) fn images(self, map: &Transformation, time: Option<&Formula>) -> Layout {
        let image = |name: &str, kind: Type, own: &Formula| {
            Layout::image(Layout::name(name, kind), self.formula(own))
        };
        let variables = self.0.state.iter().zip(&map.state);
        let variables = variables
            .filter_map(|(own, formula)| Some(image(&own.name, own.kind, formula.as_ref()?)));
        let parameters = map.parameters.iter().filter_map(|(index, formula)| {
            let own = self.0.parameters.get(*index)?;
            Some(image(&own.name, own.kind, formula))
        });
        let time = time.map(|own| {
            let name = || Layout::name(TIME, Type::Scalar);
            Layout::image(name(), self.multiple(own, name()))
        });
        Layout::listed(variables.chain(parameters).chain(time))
    }
}

/// Text of a factor, with an ASCII sign.
fn written(factor: &Formula) -> String {
    factor.text().trim().replace('−', "-")
}

/// Writes the multiple of a name, −x for the factor −1.
pub(super) fn multiple_text(factor: &Formula, of: &str) -> String {
    match written(factor).as_str() {
        "0" => "0".to_string(),
        "1" => of.to_string(),
        "-1" => format!("−{of}"),
        _ => format!("{}*{of}", factor.as_factor().text().trim()),
    }
}
