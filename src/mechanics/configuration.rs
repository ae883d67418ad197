//! Points of configuration space: the velocity-free part of a [`phase`](super::phase) point.

use std::cell::OnceCell;
use std::rc::Rc;

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual;

use super::body::{axis, scalar};
use super::memo::Memo;
use super::model::{Model, ParameterOrigin};
use super::rubber::{NORMAL, normal};
use super::vocabulary::Meaning;
use crate::formula::{Formula, Symbol, Value};
use crate::graph::is_recorded_literally;
use crate::scalar::Scalar;

/// A point of configuration space over the scalar T: parameters and γ.
pub struct Configuration<'m, T> {
    /// Model to which the point belongs.
    pub model: &'m Model,
    pub(super) parameters: Parameters<T>,
    state: Vec<Value<T>>,
    axis_cosine: Option<T>,
    known: Memo<T>,
    contact: SharedContact<T>,
    /// Parameters without derivative parts, for all lifts.
    lifted_parameters: OnceCell<Parameters<Dual<T>>>,
    /// Contacts at the point lifted along each component of the normal.
    contacts_along: OnceCell<Contacts<Dual<T>>>,
}

/// Values of parameters; `None` for one that is computed by its formula.
pub(super) type Parameters<T> = Rc<[Option<Value<T>>]>;

/// Contact vector of a body and its derivative.
pub(super) type Contact<T> = (Vector3<T>, Matrix3<T>);

/// Contacts at some points, each computed once.
type Contacts<T> = Rc<[OnceCell<Contact<T>>; 3]>;

/// Where the contact at a point is kept: with the point, or in common with other points at which it is
/// the same.
enum SharedContact<T> {
    Own(OnceCell<Box<Contact<T>>>),
    Common(Contacts<T>, usize),
}

impl<'m, T: Scalar> Configuration<'m, T> {
    pub(super) fn new(model: &'m Model, parameters: Parameters<T>, state: Vec<Value<T>>) -> Self {
        Self {
            model,
            parameters,
            state,
            axis_cosine: None,
            known: Memo::default(),
            contact: SharedContact::Own(OnceCell::new()),
            lifted_parameters: OnceCell::new(),
            contacts_along: OnceCell::new(),
        }
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

    /// Returns the contact vector of the model's body and its derivative, which `make` computes.
    pub(super) fn contact(&self, make: impl FnOnce() -> Contact<T>) -> Contact<T> {
        // What is recorded as written differs from what else is recorded.
        if is_recorded_literally() {
            return make();
        }
        match &self.contact {
            SharedContact::Own(own) => **own.get_or_init(|| Box::new(make())),
            SharedContact::Common(contacts, index) => *contacts[*index].get_or_init(make),
        }
    }

    /// Returns the contact, if it was computed.
    pub(super) fn known_contact(&self) -> Option<Contact<T>> {
        match &self.contact {
            SharedContact::Own(own) => own.get().map(|contact| **contact),
            SharedContact::Common(contacts, index) => contacts[*index].get().copied(),
        }
    }

    /// Shares the contact of `lifted`, which is this point lifted along component `index` of the normal,
    /// with all such points.
    pub(super) fn share_contact(&self, lifted: &mut Configuration<'_, Dual<T>>, index: usize) {
        let contacts = self.contacts_along.get_or_init(Contacts::default);
        lifted.contact = SharedContact::Common(Rc::clone(contacts), index);
    }

    /// Lifts the point along component `index` of the normal.
    #[inline(never)]
    pub(super) fn lift_normal(&self, index: usize) -> Configuration<'m, Dual<T>> {
        let mut lifted = self.lift(NORMAL, axis(index));
        self.share_contact(&mut lifted, index);
        lifted
    }

    /// Lifts the point with derivative parts `direction` for state variable `index`, 0 elsewhere.
    #[inline(never)]
    pub fn lift(&self, index: usize, direction: Value<T>) -> Configuration<'m, Dual<T>> {
        self.lift_with(self.lifted_parameters(), index, &direction)
    }

    /// Lifts the same, with parameters that were lifted before.
    pub(super) fn lift_with(
        &self,
        parameters: Parameters<Dual<T>>,
        index: usize,
        direction: &Value<T>,
    ) -> Configuration<'m, Dual<T>> {
        let mut state: Vec<_> = self.state.iter().map(|value| value.map(Dual::from_re)).collect();
        state[index] = dual_value(&self.state[index], direction);
        Configuration::new(self.model, parameters, state)
    }

    /// Returns the parameters without derivative parts.
    pub(super) fn lifted_parameters(&self) -> Parameters<Dual<T>> {
        Rc::clone(self.lifted_parameters.get_or_init(|| lift_parameters(&self.parameters)))
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
        Configuration::new(self.model, self.lifted_parameters(), state)
    }

    /// Lifts the point with all derivative parts 0.
    #[inline(never)]
    pub fn lift_constant(&self) -> Configuration<'m, Dual<T>> {
        let state = self.state.iter().map(|value| value.map(Dual::from_re)).collect();
        Configuration::new(self.model, self.lifted_parameters(), state)
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

fn lift_parameters<T: Scalar>(parameters: &[Option<Value<T>>]) -> Parameters<Dual<T>> {
    let lift = |value: &Value<T>| value.map(Dual::from_re);
    parameters.iter().map(|value| value.as_ref().map(lift)).collect()
}

fn dual_value<T: Scalar>(value: &Value<T>, direction: &Value<T>) -> Value<Dual<T>> {
    let parts = value.components().into_iter().zip(direction.components());
    let parts: Vec<_> = parts.map(|(re, eps)| Dual::new(re, eps)).collect();
    Value::from_components(value.value_type(), &parts)
}
