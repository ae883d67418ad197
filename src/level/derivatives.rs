//! Derivatives of one equation of a level, and the components of the state that each depends on.

use num_traits::Zero;

use super::equation::{Equation, PartialPoint};
use super::quadric::Quadric;
use crate::graph::{Expr, Graph, Step as Node, record};
use crate::mechanics::Model;
use crate::number::rational::Rational;

/// Largest number of components of the state.
pub const MOST_COMPONENTS: usize = 96;

/// Set of components of the state, as bits.
pub type Set = u128;

/// Returns the set of one component.
pub fn bit(component: usize) -> Set {
    1 << component
}

/// Lists the components of a set.
pub fn members(set: Set) -> Vec<usize> {
    (0..Set::BITS as usize).filter(|k| set >> k & 1 == 1).collect()
}

/// An equation with the derivatives that the analysis needs.
pub struct EquationDerivatives {
    /// The equation.
    pub equation: Equation,
    /// Graph of its value and derivatives.
    pub graph: Graph,
    /// Components of the state that each node depends on.
    sets: Vec<Set>,
    /// Components of the free parameters that the equation depends on.
    pub parameters: Vec<usize>,
    value: Expr,
    pub slopes: Vec<Expr>,
    /// Second derivatives by pairs of the components that the equation contains.
    pub bends: Vec<(usize, usize, Expr)>,
    pub parameter_slopes: Vec<(usize, Expr)>,
}

impl EquationDerivatives {
    /// Differentiates an equation; `None` if it cannot be recorded.
    pub fn at(model: &Model, equation: Equation) -> Option<Self> {
        let (free, dimension) = (model.free_components(), model.dimension());
        let within = |inputs: &[Expr]| {
            let (parameters, state) = inputs.split_at(free);
            PartialPoint { model, parameters: parameters.to_vec(), state: state.to_vec() }
        };
        let (plain, value) =
            record(free + dimension, |inputs| within(inputs).value(equation)).ok()?;
        let reached = plain.reached([value]);
        let used: Vec<usize> = plain
            .steps()
            .zip(reached)
            .filter_map(|(step, reached)| match step {
                Node::Input(input) if reached => Some(input),
                _ => None,
            })
            .collect();
        let own: Vec<usize> = used
            .iter()
            .filter(|k| **k >= free && **k < free + dimension)
            .map(|k| k - free)
            .collect();
        let parameters: Vec<usize> = used.iter().copied().filter(|k| *k < free).collect();
        let pairs: Vec<(usize, usize)> = own
            .iter()
            .flat_map(|i| own.iter().filter(move |j| i <= *j).map(|j| (*i, *j)))
            .collect();
        let (graph, (value, slopes, bends, parameter_slopes)) =
            record(free + dimension, |inputs| {
                let point = within(inputs);
                let mut slopes = vec![Expr::zero(); dimension];
                for (component, slope) in own.iter().zip(point.slopes(equation, &own)) {
                    slopes[*component] = slope;
                }
                let bend = |(i, j): &(usize, usize)| (*i, *j, point.bend(equation, *i, *j));
                let parameter = |k: &usize| (*k, point.parameter_slope(equation, *k));
                (
                    point.value(equation),
                    slopes,
                    pairs.iter().map(bend).collect(),
                    parameters.iter().map(parameter).collect(),
                )
            })
            .ok()?;
        let sets = sets(&graph, free);
        Some(Self { equation, graph, sets, parameters, value, slopes, bends, parameter_slopes })
    }

    /// Returns the components that a value depends on.
    pub fn set(&self, value: Expr) -> Set {
        self.sets[self.graph.place(value)]
    }

    /// Whether a value is 0 identically.
    pub fn is_zero(&self, value: Expr) -> bool {
        self.graph.constant_value(value).is_some_and(Rational::is_zero)
    }

    /// Returns the components that the equation contains.
    pub fn contained(&self) -> Set {
        self.set(self.value)
    }

    /// Whether the equation is jointly linear in some components.
    pub fn is_linear_in(&self, set: Set) -> bool {
        members(set).into_iter().all(|k| self.set(self.slopes[k]) & set == 0)
    }

    /// Whether the equation is of degree at most 2 jointly in some components.
    pub fn is_quadratic_in(&self, set: Set) -> bool {
        let inside = |(i, j, _): &&(usize, usize, Expr)| set & bit(*i) != 0 && set & bit(*j) != 0;
        self.bends.iter().filter(inside).all(|(_, _, bend)| self.set(*bend) & set == 0)
    }

    /// Returns the equation as a quadric with constant coefficients in all components that it
    /// contains.
    pub fn quadric(&self, components: &[usize]) -> Option<Quadric> {
        if !self.parameters.is_empty() || !self.is_quadratic_in(self.contained()) {
            return None;
        }
        let constant = |value: Expr| self.graph.constant_value(value).cloned();
        let n = components.len();
        let mut bends = vec![vec![Rational::from(0); n]; n];
        for (i, j, bend) in &self.bends {
            let place = |k: &usize| components.iter().position(|own| own == k);
            let (i, j, bend) = (place(i)?, place(j)?, constant(*bend)?);
            (bends[i][j], bends[j][i]) = (bend.clone(), bend);
        }
        let [value, slopes @ ..] = &self.at_origin(components)?[..] else { return None };
        Some(Quadric { constant: value.clone(), slopes: slopes.to_vec(), bends })
    }

    /// Returns the value and the slopes at the origin.
    fn at_origin(&self, components: &[usize]) -> Option<Vec<Rational>> {
        let wanted: Vec<Expr> =
            [self.value].into_iter().chain(components.iter().map(|k| self.slopes[*k])).collect();
        let reached = self.graph.reached(wanted.iter().copied());
        let (graph, found) = record(self.graph.inputs(), |inputs| {
            let zeros = vec![Expr::zero(); inputs.len()];
            let values = self.graph.repeated(&reached, &zeros);
            wanted
                .iter()
                .map(|value| values[self.graph.place(*value)])
                .collect::<Option<Vec<Expr>>>()
        })
        .ok()?;
        found?.into_iter().map(|value| graph.constant_value(value).cloned()).collect()
    }
}

/// Finds the components of the state that each step depends on; their inputs follow the free
/// parameters.
fn sets(graph: &Graph, free: usize) -> Vec<Set> {
    let mut sets: Vec<Set> = Vec::with_capacity(graph.len());
    for step in graph.steps() {
        let set = match step {
            Node::Input(input) => match input.checked_sub(free) {
                Some(component) if component < MOST_COMPONENTS => bit(component),
                _ => 0,
            },
            step => step.arguments().fold(0, |set, argument| set | sets[argument]),
        };
        sets.push(set);
    }
    sets
}
