//! A mechanical system with its names, parameters, state and level set.

use std::rc::Rc;

use super::System;
use super::level_equation::{LevelEquation, Orientation};
use super::listed::ListedValues;
use super::recipe::{Draw, SamplerSpec};
use super::variables::NewVariables;
use super::vocabulary::{Dependence, Meaning, Vocabulary};
use crate::formula::{Formula, Scope, Symbol, Type, Value};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// A parameter of a case.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Canonical name.
    pub name: String,
    /// Type of the value: scalar, vector or matrix.
    pub kind: Type,
    /// Source of the value.
    pub origin: ParameterOrigin,
}

/// Name of time, where formulas use it and it has no other meaning.
pub const TIME: &str = "t";

/// The source of a parameter's value.
#[derive(Clone, Debug)]
pub enum ParameterOrigin {
    /// Fixed by the file, component by component; folded into the tape.
    Fixed(Vec<Rational>),
    /// Drawn anew for every state: an input of the tape.
    Free(SamplerSpec),
    /// Computed from other parameters.
    Formula(Formula),
}

/// A variable of the state.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Canonical name.
    pub name: String,
    /// Type of the value: scalar, vector or matrix.
    pub kind: Type,
    /// Matrix that the file declares, and that is made of the components of this vector.
    pub shape: Option<MatrixShape>,
}

/// A symmetric or skew matrix whose entries on and above the diagonal are the components of a
/// vector, row by row; a skew one has none on the diagonal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MatrixShape {
    /// Name of the matrix.
    pub name: String,
    /// Number of rows.
    pub rows: usize,
    /// Whether it is skew, rather than symmetric.
    pub is_skew: bool,
}

impl MatrixShape {
    /// Returns the place of the component that an entry above the diagonal, or on it, is.
    fn place(&self, i: usize, j: usize) -> Option<usize> {
        let mut places = self.places();
        places.position(|place| place == (i, j))
    }

    /// Lists the entries that are components, in their order.
    pub fn places(&self) -> impl Iterator<Item = (usize, usize)> {
        let (rows, first) = (self.rows, usize::from(self.is_skew));
        (0..rows).flat_map(move |i| (i + first..rows).map(move |j| (i, j)))
    }

    /// Writes the matrix with the components of a vector of this name.
    pub fn text(&self, vector: &str) -> String {
        let entry = |i: usize, j: usize| match self.place(i.min(j), i.max(j)) {
            Some(k) if self.is_skew && i > j => format!("−{vector}[{}]", k + 1),
            Some(k) => format!("{vector}[{}]", k + 1),
            None => "0".to_string(),
        };
        let row = |i: usize| {
            let entries: Vec<String> = (0..self.rows).map(|j| entry(i, j)).collect();
            format!("[{}]", entries.join(", "))
        };
        let rows: Vec<String> = (0..self.rows).map(row).collect();
        format!("[{}]", rows.join(", "))
    }
}

impl Variable {
    /// Number of components.
    pub fn len(&self) -> usize {
        components(self.kind)
    }

    /// Whether the variable has no components: never.
    pub fn is_empty(&self) -> bool {
        false
    }
}

/// Number of components of a value of this type.
pub fn components(kind: Type) -> usize {
    kind.size()
}

/// A mechanical system with its names and its level set, the subject of a case.
#[derive(Clone, Debug)]
pub struct Model {
    /// Equations of motion.
    pub system: System,
    /// All names of the case.
    pub vocabulary: Vocabulary,
    /// Parameters in the order of the file, then those of arbitrary functions.
    pub parameters: Vec<Parameter>,
    /// State variables in order: the system's variables, then those added by a case.
    pub state: Vec<Variable>,
    /// Rates of the variables that a case adds to a built-in system, one after another; the rate of
    /// a vector may take several formulas.
    pub extension: Vec<Formula>,
    /// New variables as functions of the state, with a bracket for them.
    pub variables: Option<Box<NewVariables>>,
    /// Abbreviations defined by `let`.
    pub abbreviations: Vec<Formula>,
    /// Equations of the level set.
    pub level: Vec<LevelEquation>,
    /// Equations that choose halves of the level.
    pub orientations: Vec<Orientation>,
    /// Names whose values are written into the case outside formulas, as sizes and in keys.
    pub fixed: Vec<Symbol>,
    /// Choices of listed values for which the equations of motion have no value.
    pub undetermined: Vec<ListedValues>,
}

impl Model {
    /// Takes an equation out of the level that says nothing new beside the others. The entries that are left of the
    /// same equation of the file say less than it does.
    pub fn leave_out(&mut self, index: usize) -> LevelEquation {
        let equation = self.level.remove(index);
        for own in self.level.iter_mut().filter(|own| own.written() == equation.written()) {
            own.lacks_entries = true;
        }
        equation
    }

    /// Makes a model with the same parameters, a state that is only named, and the abbreviations
    /// that can be read in its names, where they are the same functions of the named values.
    pub fn with_names(&self, vocabulary: Vocabulary, state: Vec<Variable>) -> Self {
        let mut named = Self {
            system: self.system.clone(),
            vocabulary,
            state,
            parameters: self.parameters.clone(),
            extension: Vec::new(),
            variables: None,
            abbreviations: self.abbreviations.clone(),
            level: Vec::new(),
            orientations: Vec::new(),
            fixed: self.fixed.clone(),
            undetermined: self.undetermined.clone(),
        };
        for (symbol, entry) in self.vocabulary.iter() {
            let Meaning::Abbreviation(index) = entry.meaning else { continue };
            let is_hidden = self.vocabulary.lookup(&entry.name).is_none_or(|(s, _)| s != symbol);
            if is_hidden || named.vocabulary.find(&entry.name).is_some() {
                continue;
            }
            let text = self.abbreviations[index].text();
            if let Ok(read) = Formula::parse(text, &named.vocabulary) {
                let reach =
                    named.vocabulary.reach(&read).map_or(Dependence::Parameters, |e| e.reach);
                let index = named.abbreviations.len();
                named.vocabulary.define(&entry.name, index, &read, reach);
                named.abbreviations.push(read);
            }
        }
        named
    }

    /// Whether a formula, or an abbreviation that it uses, contains an ∫.
    pub fn has_antiderivative(&self, formula: &Formula) -> bool {
        let all = self.vocabulary.with_abbreviations(formula, &self.abbreviations);
        all.into_iter().any(Formula::has_antiderivative)
    }

    /// Whether the value of a symbol is no number that the file gives.
    pub(crate) fn varies(&self, symbol: Symbol) -> bool {
        let any = |formula: &Formula| formula.symbols().any(|symbol| self.varies(symbol));
        match self.vocabulary.entry(symbol).meaning {
            Meaning::Parameter(index) => match &self.parameters[index].origin {
                ParameterOrigin::Fixed(_) => false,
                ParameterOrigin::Free(_) => true,
                ParameterOrigin::Formula(formula) => any(formula),
            },
            Meaning::Abbreviation(index) => self.abbreviations.get(index).is_some_and(any),
            Meaning::State(_) | Meaning::Quantity(_) => true,
        }
    }

    /// Whether the value of a symbol that varies depends on lists of numbers alone.
    pub(crate) fn is_listed(&self, symbol: Symbol) -> bool {
        let all = |formula: &Formula| {
            formula.symbols().all(|symbol| !self.varies(symbol) || self.is_listed(symbol))
        };
        match self.vocabulary.entry(symbol).meaning {
            Meaning::Parameter(index) => match &self.parameters[index].origin {
                ParameterOrigin::Fixed(_) => false,
                ParameterOrigin::Free(recipe) => {
                    recipe.draws().iter().all(|draw| matches!(draw, Draw::OneOf(_) | Draw::Sign))
                }
                ParameterOrigin::Formula(formula) => all(formula),
            },
            Meaning::Abbreviation(index) => self.abbreviations.get(index).is_some_and(all),
            Meaning::State(_) | Meaning::Quantity(_) => false,
        }
    }

    /// Whether formulas contain different `∫`, each with a constant of its own.
    pub(crate) fn has_several_antiderivatives(&self, formulas: &[&Formula]) -> bool {
        let all = formulas
            .iter()
            .flat_map(|formula| self.vocabulary.with_abbreviations(formula, &self.abbreviations));
        let all: Vec<&Formula> = all.collect();
        let mut texts = all.iter().flat_map(|formula| formula.antiderivative_texts());
        let first = texts.next();
        texts.any(|text| Some(text) != first)
    }

    /// Number of state variables of the system, without those that a case adds.
    pub fn own_variables(&self) -> usize {
        let mut added: usize = self.extension.iter().map(|rate| rate.value_type().size()).sum();
        let mut count = self.state.len();
        while added > 0 && count > 0 {
            count -= 1;
            added = added.saturating_sub(self.state[count].len());
        }
        count
    }

    /// Dimension of phase space.
    pub fn dimension(&self) -> usize {
        self.state.iter().map(Variable::len).sum()
    }

    /// Returns the variable that a component of the state belongs to, and the place in it.
    pub fn variable_of(&self, component: usize) -> Option<(&Variable, usize)> {
        let mut first = 0;
        let starts = self.state.iter().map(|variable| {
            first += variable.len();
            (variable, first - variable.len())
        });
        let found = starts.take_while(|(_, start)| *start <= component).last();
        found.map(|(variable, start)| (variable, component - start))
    }

    /// Returns the name of a component of the state, such as `γ3` or `L[2,1]`.
    pub fn component_name(&self, component: usize) -> String {
        match self.variable_of(component) {
            Some((variable, place)) => variable.kind.component(&variable.name, place),
            None => String::new(),
        }
    }

    /// Number of inputs for the free parameters.
    pub fn free_components(&self) -> usize {
        self.free_parameters().map(|parameter| components(parameter.kind)).sum()
    }

    /// Returns the parameters that are inputs of the tape.
    pub fn free_parameters(&self) -> impl Iterator<Item = &Parameter> {
        self.parameters
            .iter()
            .filter(|parameter| matches!(parameter.origin, ParameterOrigin::Free(_)))
    }

    /// Returns the place of parameter `index` among the components of the free ones, if it is free.
    pub fn free_component(&self, index: usize) -> Option<usize> {
        let is_free = |parameter: &Parameter| matches!(parameter.origin, ParameterOrigin::Free(_));
        let before = self.parameters[..index].iter().filter(|parameter| is_free(parameter));
        let start = before.map(|parameter| components(parameter.kind)).sum();
        is_free(&self.parameters[index]).then_some(start)
    }

    /// Returns the draws that make the free parameters, in order.
    pub fn parameter_draws(&self) -> Vec<Draw> {
        self.recipes().flat_map(SamplerSpec::draws).collect()
    }

    /// Returns the index of the draw of a component of the free parameters, if it is a single drawn
    /// number.
    pub fn draw_of_component(&self, component: usize) -> Option<usize> {
        let (mut first, mut draw) = (0, 0);
        for parameter in self.free_parameters() {
            let ParameterOrigin::Free(recipe) = &parameter.origin else { continue };
            if first == component && matches!(recipe, SamplerSpec::Scalar(_)) {
                return Some(draw);
            }
            first += components(parameter.kind);
            draw += recipe.draws().len();
        }
        None
    }

    /// Makes the components of the free parameters from the draws they need; returns them with the
    /// remaining draws.
    pub fn make_parameters<'d, T: Scalar>(&self, mut draws: &'d [T]) -> (Vec<T>, &'d [T]) {
        let mut values = Vec::new();
        for recipe in self.recipes() {
            let (own, others) = draws.split_at(recipe.draws().len());
            draws = others;
            values.extend(recipe.make(own).components());
        }
        (values, draws)
    }

    fn recipes(&self) -> impl Iterator<Item = &SamplerSpec> {
        self.parameters.iter().filter_map(|parameter| match &parameter.origin {
            ParameterOrigin::Free(recipe) => Some(recipe),
            _ => None,
        })
    }

    /// Distributes the values of the free parameters (`inputs`, in order) over all parameters.
    pub fn assign<T: Scalar>(&self, inputs: &[T]) -> Rc<[Option<Value<T>>]> {
        let mut rest = inputs;
        self.parameters
            .iter()
            .map(|parameter| match &parameter.origin {
                ParameterOrigin::Fixed(values) => {
                    let values: Vec<T> = values.iter().map(T::rational).collect();
                    Some(Value::from_components(parameter.kind, &values))
                }
                ParameterOrigin::Free(_) => {
                    let (own, others) = rest.split_at(components(parameter.kind).min(rest.len()));
                    rest = others;
                    Some(Value::from_components(parameter.kind, own))
                }
                ParameterOrigin::Formula(_) => None,
            })
            .collect()
    }
}
