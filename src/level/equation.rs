//! An equation of a level in the form in which it is solved: F = 0, or A − e² = 0 in place of √A =
//! e.

use num_dual::Dual;
use num_traits::{One, Zero};

use crate::graph::Expr;
use crate::mechanics::{LevelEquation, Model, Phase};
use crate::scalar::Scalar;

/// An equation of a model's level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Equation {
    /// Index of the equation in the level.
    pub index: usize,
    /// Whether both sides are squared.
    pub is_squared: bool,
}

impl Equation {
    fn of(self, model: &Model) -> &LevelEquation {
        &model.level[self.index]
    }

    /// Evaluates left minus right side at a point.
    pub fn value<T: Scalar>(self, phase: &Phase<'_, T>) -> T {
        let equation = self.of(phase.model());
        match &equation.root {
            Some(root) if self.is_squared => {
                let (inside, other) =
                    (phase.scalar(&root.radicand), phase.scalar(&root.other_side));
                let square = if root.is_modulus { inside * inside } else { inside };
                square - other * other
            }
            _ => phase.level_function(&equation.function),
        }
    }

    /// Returns the side that must not be negative, where a root was squared away.
    pub fn other_side(self, phase: &Phase<'_, Expr>) -> Option<Expr> {
        let root = self.of(phase.model()).root.as_ref().filter(|_| self.is_squared)?;
        Some(phase.scalar(&root.other_side))
    }
}

/// A point of the level under construction.
#[derive(Clone)]
pub struct PartialPoint<'m> {
    /// Model of the system.
    pub model: &'m Model,
    /// Components of the free parameters.
    pub parameters: Vec<Expr>,
    /// Components of the state.
    pub state: Vec<Expr>,
}

impl PartialPoint<'_> {
    fn phase<T: Scalar>(&self, lift: impl Fn(Expr) -> T, state: &[T]) -> Phase<'_, T> {
        let parameters: Vec<T> = self.parameters.iter().map(|x| lift(*x)).collect();
        Phase::new(self.model, &parameters, state)
    }

    /// Evaluates the equation at the point.
    pub fn value(&self, equation: Equation) -> Expr {
        equation.value(&self.phase(|x| x, &self.state))
    }

    /// Returns the slope of the equation along each of some components.
    pub fn slopes(&self, equation: Equation, components: &[usize]) -> Vec<Expr> {
        let slope = |component: &usize| {
            let along = |k: usize| if k == *component { Expr::one() } else { Expr::zero() };
            let state = self.state.iter().enumerate().map(|(k, x)| Dual::new(*x, along(k)));
            let state: Vec<Dual<Expr>> = state.collect();
            equation.value(&self.phase(Dual::from_re, &state)).eps
        };
        components.iter().map(slope).collect()
    }

    /// Expands the equation along a direction: F(x + tu) = c + 2bt + at² + …; returns c, b and a.
    pub fn along(&self, equation: Equation, direction: &[(usize, Expr)]) -> [Expr; 3] {
        let mut along = vec![Expr::zero(); self.state.len()];
        for (component, slope) in direction {
            along[*component] = *slope;
        }
        let lifted =
            |(x, u): (&Expr, &Expr)| Dual::new(Dual::new(*x, *u), Dual::new(*u, Expr::zero()));
        let state: Vec<Dual<Dual<Expr>>> = self.state.iter().zip(&along).map(lifted).collect();
        let lift = |x: Expr| Dual::from_re(Dual::from_re(x));
        let value = equation.value(&self.phase(lift, &state));
        let half = Expr::from(0.5);
        [value.re.re, value.re.eps * half, value.eps.eps * half]
    }

    /// Returns the second derivative of the equation along two components.
    pub fn bend(&self, equation: Equation, first: usize, second: usize) -> Expr {
        let unit = |k: usize, of: usize| if k == of { Expr::one() } else { Expr::zero() };
        let state: Vec<Dual<Dual<Expr>>> = self
            .state
            .iter()
            .enumerate()
            .map(|(k, x)| {
                let inner = Dual::new(*x, unit(k, first));
                Dual::new(inner, Dual::new(unit(k, second), Expr::zero()))
            })
            .collect();
        let lift = |x: Expr| Dual::from_re(Dual::from_re(x));
        equation.value(&self.phase(lift, &state)).eps.eps
    }

    /// Returns the slope of the equation along a component of the free parameters.
    pub fn parameter_slope(&self, equation: Equation, component: usize) -> Expr {
        let along = |k: usize| if k == component { Expr::one() } else { Expr::zero() };
        let parameters = self.parameters.iter().enumerate();
        let parameters: Vec<Dual<Expr>> =
            parameters.map(|(k, x)| Dual::new(*x, along(k))).collect();
        let state: Vec<Dual<Expr>> = self.state.iter().map(|x| Dual::from_re(*x)).collect();
        equation.value(&Phase::new(self.model, &parameters, &state)).eps
    }
}
