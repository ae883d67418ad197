//! Points of configuration space: the velocity-free part of a [`phase`](super::phase) point.

use std::rc::Rc;

use num_dual::Dual;

use super::body::scalar;
use super::memo::Memo;
use super::model::{Model, ParameterOrigin};
use super::rubber::normal;
use super::vocabulary::Meaning;
use crate::formula::{Formula, Symbol, Value};
use crate::scalar::Scalar;

/// A point of configuration space over the scalar T: parameters and γ.
pub struct Configuration<'m, T> {
    /// Model to which the point belongs.
    pub model: &'m Model,
    pub(super) parameters: Rc<[Option<Value<T>>]>,
    state: Vec<Value<T>>,
    axis_cosine: Option<T>,
    known: Memo<T>,
}

impl<'m, T: Scalar> Configuration<'m, T> {
    pub(super) fn new(
        model: &'m Model,
        parameters: Rc<[Option<Value<T>>]>,
        state: Vec<Value<T>>,
    ) -> Self {
        Self { model, parameters, state, axis_cosine: None, known: Memo::default() }
    }

    /// Returns the same point with another value of state variable `index`.
    #[inline(never)]
    pub fn moved(&self, index: usize, value: Value<T>) -> Self {
        let mut state = self.state.clone();
        state[index] = value;
        Self::new(self.model, Rc::clone(&self.parameters), state)
    }

    /// Returns the same point with `z` as the cosine at which a profile is evaluated.
    #[inline(never)]
    pub fn with_axis_cosine(&self, z: T) -> Self {
        let mut moved = Self::new(self.model, Rc::clone(&self.parameters), self.state.clone());
        moved.axis_cosine = Some(z);
        moved
    }

    /// Returns `z`, which is γ₃/|γ| unless it was given.
    pub fn axis_cosine(&self) -> T {
        self.axis_cosine.unwrap_or_else(|| {
            let gamma = normal(self);
            gamma.z / gamma.dot(&gamma).sqrt()
        })
    }

    /// Evaluates a formula that depends on the configuration at most.
    #[inline(never)]
    pub fn evaluate(&self, formula: &Formula) -> Value<T> {
        formula.evaluate(&mut |symbol| self.value(symbol))
    }

    /// Returns the value of state variable `index`.
    pub fn variable(&self, index: usize) -> Value<T> {
        self.state[index].clone()
    }

    /// Returns the value of parameter `index`.
    #[inline(never)]
    pub fn parameter(&self, index: usize) -> Value<T> {
        match (&self.parameters[index], &self.model.parameters[index].origin) {
            (Some(value), _) => value.clone(),
            (None, ParameterOrigin::Formula(formula)) => self.evaluate(formula),
            (None, _) => unreachable!("only formulas have no value of their own"),
        }
    }

    /// Returns the value of a parameter by name, if it is declared.
    #[inline(never)]
    pub fn named(&self, name: &str) -> Option<Value<T>> {
        match self.model.vocabulary.find(name)?.meaning {
            Meaning::Parameter(index) => Some(self.parameter(index)),
            _ => None,
        }
    }

    /// The value of a scalar formula that reaches no further than the configuration.
    pub fn scalar(&self, formula: &Formula) -> T {
        scalar(self.evaluate(formula))
    }

    #[inline(never)]
    pub(super) fn value(&self, symbol: Symbol) -> Value<T> {
        let formula = |symbol| formula_of(self.model, symbol);
        self.known.value(symbol, &formula, &|symbol| match self
            .model
            .vocabulary
            .entry(symbol)
            .meaning
        {
            Meaning::Parameter(index) => self.parameter(index),
            Meaning::State(index) => self.variable(index),
            Meaning::Abbreviation(index) => self.evaluate(&self.model.abbreviations[index]),
            Meaning::Quantity(quantity) => self.model.system.configuration_quantity(quantity, self),
        })
    }

    /// Lifts the point with derivative parts `direction` for state variable `index`, 0 elsewhere.
    #[inline(never)]
    pub fn lift(&self, index: usize, direction: Value<T>) -> Configuration<'m, Dual<T>> {
        let mut state: Vec<_> = self.state.iter().map(|value| value.map(Dual::from_re)).collect();
        state[index] = dual_value(&self.state[index], &direction);
        Configuration::new(self.model, lift_parameters(&self.parameters), state)
    }

    /// Returns the components of all state variables in order.
    #[inline(never)]
    pub fn components(&self) -> Vec<T> {
        self.state.iter().flat_map(|value| value.components()).collect()
    }

    /// Lifts the point with the derivative part `direction`, one entry for each component of the
    /// state.
    #[inline(never)]
    pub fn lift_state(&self, direction: &[T]) -> Configuration<'m, Dual<T>> {
        let mut rest = direction;
        let state = self
            .state
            .iter()
            .map(|value| {
                let (own, others) = rest.split_at(value.value_type().size());
                rest = others;
                dual_value(value, &Value::from_components(value.value_type(), own))
            })
            .collect();
        Configuration::new(self.model, lift_parameters(&self.parameters), state)
    }

    /// Lifts the point with all derivative parts 0.
    #[inline(never)]
    pub fn lift_constant(&self) -> Configuration<'m, Dual<T>> {
        let state = self.state.iter().map(|value| value.map(Dual::from_re)).collect();
        Configuration::new(self.model, lift_parameters(&self.parameters), state)
    }
}

/// Returns the formula of an abbreviation, or of a parameter that has one.
pub(super) fn formula_of(model: &Model, symbol: Symbol) -> Option<&Formula> {
    match model.vocabulary.entry(symbol).meaning {
        Meaning::Abbreviation(index) => model.abbreviations.get(index),
        Meaning::Parameter(index) => match &model.parameters[index].origin {
            ParameterOrigin::Formula(formula) => Some(formula),
            _ => None,
        },
        _ => None,
    }
}

pub(super) fn lift_parameters<T: Scalar>(
    parameters: &[Option<Value<T>>],
) -> Rc<[Option<Value<Dual<T>>>]> {
    let lift = |value: &Value<T>| value.map(Dual::from_re);
    parameters.iter().map(|value| value.as_ref().map(lift)).collect()
}

fn dual_value<T: Scalar>(value: &Value<T>, direction: &Value<T>) -> Value<Dual<T>> {
    let parts = value.components().into_iter().zip(direction.components());
    let parts: Vec<_> = parts.map(|(re, eps)| Dual::new(re, eps)).collect();
    Value::from_components(value.value_type(), &parts)
}
