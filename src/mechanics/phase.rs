//! Points of phase space over a scalar. Values of named quantities are computed on demand, once.
//!
//! [`Phase`] is a point of phase space, [`Configuration`] its velocity-free part, on which support
//! functions and potentials depend. The two are separate because a `Phase<T>` differentiates the
//! body, and so needs `Configuration<Dual<T>>`, but never the reverse.

use std::cell::OnceCell;
use std::rc::Rc;

use num_dual::Dual;

use super::ball::BallMotion;
use super::body::scalar;
use super::configuration::{Configuration, Parameters, formula_of};
use super::level_equation::LevelFunction;
use super::memo::Memo;
use super::model::{Model, Variable};
use super::quantity::Quantity;
use super::rolling::RollingTerms;
use super::rubber::{NORMAL, angular_velocity, normal};
use super::vocabulary::Meaning;
use crate::formula::{Formula, Symbol, Value};
use crate::scalar::Scalar;

/// A point of phase space over the scalar T.
pub struct Phase<'m, T> {
    /// Velocity-free part.
    pub configuration: Configuration<'m, T>,
    known: Memo<T>,
    /// Values that are defined exactly where the written formulas are.
    literal: Memo<T>,
    motion: OnceCell<Box<RollingTerms<T>>>,
    ball_motion: OnceCell<Box<BallMotion<T>>>,
    /// Rates of the system's variables, without those that a case adds.
    own_field: OnceCell<Vec<T>>,
    field: OnceCell<Vec<T>>,
}

impl<'m, T: Scalar> Phase<'m, T> {
    /// Makes the point with the given values of the free parameters and of the state's components.
    pub fn new(model: &'m Model, free: &[T], state: &[T]) -> Self {
        Self::with_parameters(model, model.assign(free), state)
    }

    /// Makes a point of a model with the parameters of another one, given by the free ones of that: values
    /// that it has fixed need not be fixed here.
    #[inline(never)]
    pub fn with_parameters_of(model: &'m Model, other: &Model, free: &[T], state: &[T]) -> Self {
        Self::with_parameters(model, other.assign(free), state)
    }

    #[inline(never)]
    pub(super) fn with_parameters(
        model: &'m Model,
        parameters: Parameters<T>,
        state: &[T],
    ) -> Self {
        let mut rest = state;
        let state = model
            .state
            .iter()
            .map(|variable| {
                let (own, others) = rest.split_at(variable.len().min(rest.len()));
                rest = others;
                Value::from_components(variable.kind, own)
            })
            .collect();
        Self {
            configuration: Configuration::new(model, parameters, state),
            known: Memo::default(),
            literal: Memo::default(),
            motion: OnceCell::new(),
            ball_motion: OnceCell::new(),
            own_field: OnceCell::new(),
            field: OnceCell::new(),
        }
    }

    /// Returns the model to which the point belongs.
    pub fn model(&self) -> &'m Model {
        self.configuration.model
    }

    /// Returns the state's components in order.
    #[inline(never)]
    pub fn state(&self) -> Vec<T> {
        self.configuration.components()
    }

    /// Evaluates a formula.
    #[inline(never)]
    pub fn evaluate(&self, formula: &Formula) -> Value<T> {
        formula.evaluate(&mut |symbol| self.value(symbol))
    }

    /// Evaluates a formula so that the value is defined exactly where every operation written in
    /// it, in its abbreviations and in its parameters is.
    #[inline(never)]
    pub fn evaluate_literally(&self, formula: &Formula) -> Value<T> {
        formula.evaluate_literally(&mut |symbol| self.literal_value(symbol))
    }

    #[inline(never)]
    pub(super) fn literal_value(&self, symbol: Symbol) -> Value<T> {
        let formula = |symbol| self.literal_formula(symbol);
        self.literal.value(symbol, &formula, &|symbol| match self.literal_formula(symbol) {
            Some(formula) => self.evaluate_literally(formula),
            None => self.value(symbol),
        })
    }

    /// Returns the formula that gives a symbol its literal value.
    fn literal_formula(&self, symbol: Symbol) -> Option<&'m Formula> {
        match self.model().vocabulary.entry(symbol).meaning {
            // the value of a changed parameter differs from that of its formula
            Meaning::Parameter(index) if self.configuration.parameters[index].is_some() => None,
            _ => formula_of(self.model(), symbol),
        }
    }

    /// Evaluates a scalar formula.
    pub fn scalar(&self, formula: &Formula) -> T {
        scalar(self.evaluate(formula))
    }

    /// Returns the value of a symbol.
    #[inline(never)]
    pub fn value(&self, symbol: Symbol) -> Value<T> {
        let model = self.model();
        let formula = |symbol| formula_of(model, symbol);
        self.known.value(symbol, &formula, &|symbol| match model.vocabulary.entry(symbol).meaning {
            Meaning::Parameter(_) | Meaning::State(_) => self.configuration.value(symbol),
            Meaning::Abbreviation(index) => self.evaluate(&model.abbreviations[index]),
            Meaning::Quantity(Quantity::Rate(index)) => self.rate(index),
            Meaning::Quantity(quantity) => model.system.quantity(quantity, self),
        })
    }

    /// Returns the rate of state variable `index`.
    #[inline(never)]
    fn rate(&self, index: usize) -> Value<T> {
        let state = &self.model().state;
        let start: usize = state[..index].iter().map(Variable::len).sum();
        // The rates that a case adds may use those of the system, which are therefore computed
        // separately.
        let own = self.own_field();
        let rates = if start < own.len() { own } else { self.field() };
        Value::from_components(state[index].kind, &rates[start..])
    }

    #[inline(never)]
    fn own_field(&self) -> &[T] {
        self.own_field.get_or_init(|| self.model().system.field(self))
    }

    /// Returns the vector field: the time derivatives of the state's components, in order.
    #[inline(never)]
    pub fn field(&self) -> &[T] {
        self.field.get_or_init(|| {
            let mut field = self.own_field().to_vec();
            let further = self.model().extension.iter();
            field.extend(further.flat_map(|rate| self.evaluate(rate).components()));
            field
        })
    }

    /// Returns the intermediate results of a rolling body's equations.
    pub(super) fn motion(&self, make: impl FnOnce() -> RollingTerms<T>) -> &RollingTerms<T> {
        self.motion.get_or_init(|| Box::new(make()))
    }

    /// Returns the intermediate results of the equations of a ball on a surface.
    pub(super) fn ball_motion(&self, make: impl FnOnce() -> BallMotion<T>) -> &BallMotion<T> {
        self.ball_motion.get_or_init(|| Box::new(make()))
    }

    /// Evaluates a level function F.
    #[inline(never)]
    pub fn level_function(&self, function: &LevelFunction) -> T {
        match function {
            LevelFunction::UnitNormal => {
                let gamma = normal(&self.configuration);
                gamma.dot(&gamma) - T::one()
            }
            LevelFunction::NoSpin => {
                let gamma = normal(&self.configuration);
                angular_velocity(&self.configuration).dot(&gamma)
            }
            LevelFunction::Formula(formula) => self.scalar(formula),
        }
    }

    /// Returns another point, with other values of some parameters.
    #[inline(never)]
    pub fn with(&self, parameters: &[(usize, Value<T>)], state: &[T]) -> Self {
        let mut all = Rc::clone(&self.configuration.parameters);
        if !parameters.is_empty() {
            let mut changed = all.to_vec();
            for (index, value) in parameters {
                changed[*index] = Some(value.clone());
            }
            all = changed.into();
        }
        Self::with_parameters(self.model(), all, state)
    }

    /// Returns a point of another model that has the same parameters.
    #[inline(never)]
    pub fn in_model<'n>(&self, model: &'n Model, state: &[T]) -> Phase<'n, T> {
        Phase::with_parameters(model, Rc::clone(&self.configuration.parameters), state)
    }

    /// Lifts the point with a derivative part of one scalar parameter.
    #[inline(never)]
    pub fn lift_parameter(&self, index: usize, direction: T) -> Phase<'m, Dual<T>> {
        let mut parameters = self.configuration.lifted_parameters().to_vec();
        let value = self.configuration.parameter(index);
        parameters[index] = Some(value.map(|x| Dual::new(x, direction)));
        let state: Vec<_> = self.state().into_iter().map(Dual::from_re).collect();
        Phase::with_parameters(self.model(), parameters.into(), &state)
    }

    /// Lifts the point with the derivative part `direction`, one entry for each component of the
    /// state.
    #[inline(never)]
    pub fn lift(&self, direction: &[T]) -> Phase<'m, Dual<T>> {
        let state: Vec<_> =
            self.state().into_iter().zip(direction).map(|(x, d)| Dual::new(x, *d)).collect();
        let parameters = self.configuration.lifted_parameters();
        let lifted = Phase::with_parameters(self.model(), parameters, &state);
        // The contact depends on the normal, and not on the angular velocity before it.
        let is_of_velocity = direction.iter().skip(3 * NORMAL).all(|slope| slope.is_absent());
        if let (Some((r, slope)), true) = (self.configuration.known_contact(), is_of_velocity) {
            lifted.configuration.contact(|| (r.map(Dual::from_re), slope.map(Dual::from_re)));
        }
        lifted
    }

    /// Lifts the point with a derivative part along coordinate `index`.
    #[inline(never)]
    pub fn lift_along(&self, index: usize) -> Phase<'m, Dual<T>> {
        let mut direction = vec![T::zero(); self.model().dimension()];
        direction[index] = T::one();
        let mut lifted = self.lift(&direction);
        if (3 * NORMAL..3 * NORMAL + 3).contains(&index) {
            self.configuration.share_contact(&mut lifted.configuration, index - 3 * NORMAL);
        }
        lifted
    }
}
