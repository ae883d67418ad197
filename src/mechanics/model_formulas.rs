//! The formulas of a model, and those that others use.

use super::level_equation::LevelFunction;
use super::model::{Model, Parameter, ParameterOrigin};
use super::quantity::Quantity;
use super::vocabulary::Meaning;
use crate::formula::{Formula, FormulaError, Symbol, Type};

impl Model {
    /// Names of the components of the free parameters, the first inputs of a recording.
    pub fn parameter_names(&self) -> Vec<String> {
        let components = |own: &Parameter| {
            let name = |place| own.kind.component(&own.name, place);
            (0..own.kind.size()).map(name).collect::<Vec<_>>()
        };
        self.free_parameters().flat_map(components).collect()
    }

    /// Names of the components of the state.
    pub fn state_names(&self) -> Vec<String> {
        (0..self.dimension()).map(|component| self.component_name(component)).collect()
    }

    /// Variables of the state as formulas.
    pub fn state_variables(&self) -> Vec<Formula> {
        let formula = |index: usize| self.vocabulary.formula_of(Meaning::State(index));
        (0..self.state.len()).filter_map(formula).collect()
    }

    /// Components of the state as formulas: `x`, `γ3`, or `γ[3]` where γ3 is another name.
    ///
    /// # Errors
    /// None is known: a component of a variable always has a formula.
    pub fn state_formulas(&self) -> Result<Vec<Formula>, FormulaError> {
        let mut all = Vec::new();
        for variable in self.state_variables() {
            match variable.value_type() {
                Type::Scalar => all.push(variable),
                Type::Vector(length) => {
                    for index in 1..=length {
                        all.push(variable.element(index, &self.vocabulary)?);
                    }
                }
                kind => {
                    for place in kind.places() {
                        all.push(variable.component(&place)?);
                    }
                }
            }
        }
        Ok(all)
    }

    /// Whether the value of a parameter is written into the case, or into one of these formulas, as
    /// a size or an index, so that the parameter cannot change.
    pub fn is_rigid(&self, parameter: usize, formulas: &[&Formula]) -> bool {
        let given = self.parameter_formulas();
        let own = self.functions().into_iter().chain(&self.abbreviations).chain(given);
        let all = own.chain(formulas.iter().copied());
        let symbols = all.flat_map(Formula::fixed_symbols).chain(&self.fixed).copied();
        let mut reached: Vec<Symbol> = symbols.collect();
        let mut next = 0;
        while let Some(symbol) = reached.get(next).copied() {
            next += 1;
            let formula = match self.vocabulary.entry(symbol).meaning {
                Meaning::Parameter(index) if index == parameter => return true,
                Meaning::Parameter(index) => match &self.parameters[index].origin {
                    ParameterOrigin::Formula(formula) => Some(formula),
                    _ => None,
                },
                Meaning::Abbreviation(index) => self.abbreviations.get(index),
                _ => None,
            };
            let inner = formula.into_iter().flat_map(Formula::symbols);
            let new: Vec<Symbol> = inner.filter(|symbol| !reached.contains(symbol)).collect();
            reached.extend(new);
        }
        false
    }

    /// Returns the formulas that are functions of the state apart from the claims: the equations of
    /// motion, the new variables, and the level.
    pub fn functions(&self) -> Vec<&Formula> {
        self.dynamics().into_iter().chain(self.level_formulas()).collect()
    }

    /// Returns the formulas of level functions that the file gives.
    pub fn level_formulas(&self) -> impl Iterator<Item = &Formula> {
        self.level.iter().filter_map(|equation| match &equation.function {
            LevelFunction::Formula(formula) => Some(formula),
            _ => None,
        })
    }

    /// Returns the formulas of parameters that are computed from others.
    pub fn parameter_formulas(&self) -> impl Iterator<Item = &Formula> {
        self.parameters.iter().filter_map(|parameter| match &parameter.origin {
            ParameterOrigin::Formula(formula) => Some(formula),
            _ => None,
        })
    }

    /// Returns the formulas of those parameters that formulas use, directly or through others.
    pub fn parameter_formulas_of(&self, formulas: &[&Formula]) -> Vec<&Formula> {
        let mut reached: Vec<Symbol> = Vec::new();
        let mut own: Vec<&Formula> = Vec::new();
        let mut reach = |formula: &Formula| {
            let new: Vec<Symbol> =
                formula.symbols().filter(|symbol| !reached.contains(symbol)).collect();
            reached.extend(&new);
            new
        };
        let mut next: Vec<Symbol> = formulas.iter().flat_map(|formula| reach(formula)).collect();
        while let Some(symbol) = next.pop() {
            let formula = match self.vocabulary.entry(symbol).meaning {
                Meaning::Parameter(index) => match &self.parameters[index].origin {
                    ParameterOrigin::Formula(formula) => Some(formula),
                    _ => None,
                },
                Meaning::Abbreviation(index) => self.abbreviations.get(index),
                Meaning::State(_) | Meaning::Quantity(_) => None,
            };
            let Some(formula) = formula else { continue };
            if matches!(self.vocabulary.entry(symbol).meaning, Meaning::Parameter(_)) {
                own.push(formula);
            }
            next.extend(reach(formula));
        }
        own
    }

    /// Returns the formulas of the equations of motion and of the new variables.
    pub fn dynamics(&self) -> Vec<&Formula> {
        let images = self.variables.iter().flat_map(|variables| &variables.images);
        self.equations_of_motion().into_iter().chain(images).collect()
    }

    /// Returns the formulas of the equations of motion, with those of the constants in them.
    pub fn equations_of_motion(&self) -> Vec<&Formula> {
        let own = self.system.functions().into_iter().chain(self.system.constants());
        own.chain(&self.extension).collect()
    }

    /// Whether an exponent in the equations of motion has listed values.
    pub(crate) fn has_listed_exponents(&self) -> bool {
        let own = self.equations_of_motion().into_iter();
        let mut all =
            own.flat_map(|own| self.vocabulary.with_abbreviations(own, &self.abbreviations));
        all.any(|own| own.has_varying_exponent(&|symbol| self.is_listed(symbol)))
    }

    /// Whether a formula contains quantities that the system defines, such as rates.
    pub fn has_quantities(&self, formula: &Formula) -> bool {
        self.has_quantity(formula, &|_| true)
    }

    /// Whether a formula contains rates that the equations of motion give, or reactions.
    pub fn has_rates(&self, formula: &Formula) -> bool {
        self.has_quantity(formula, &|own| matches!(own, Quantity::Rate(_) | Quantity::Reaction(_)))
    }

    /// Whether a formula contains some quantity, itself or by an abbreviation.
    fn has_quantity(&self, formula: &Formula, is_meant: &dyn Fn(Quantity) -> bool) -> bool {
        formula.symbols().any(|symbol| match self.vocabulary.entry(symbol).meaning {
            Meaning::Quantity(own) => is_meant(own),
            Meaning::Abbreviation(index) => {
                let own = self.abbreviations.get(index);
                own.is_some_and(|own| self.has_quantity(own, is_meant))
            }
            Meaning::Parameter(_) | Meaning::State(_) => false,
        })
    }
}
