//! A node of the division: points that satisfy equations, with coordinates that are free.

use std::sync::Arc;

use num_traits::Zero;

use super::{Cover, Part, combinations};
use crate::graph::{Expr, Fault, Graph, Step, literally, record};
use crate::mechanics::{Draw, Phase};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;
use crate::proof::{Extent, Factors, Inverted, Rationalised, vanishing_root};
use crate::scalar::Scalar;

/// Points with free coordinates at which equations hold and facts are not negative.
#[derive(Clone)]
pub struct Node {
    /// Graph over the draws.
    pub graph: Arc<Graph>,
    /// Components of the free parameters, followed by those of the state.
    pub made: Vec<Expr>,
    /// Values that are 0.
    pub equations: Vec<Expr>,
    /// Values that are not negative.
    pub facts: Vec<Expr>,
    /// Values that are not 0: divisors of the equations and of the formulas.
    pub divisors: Vec<Expr>,
    /// Whether all facts are bounds of ranges.
    pub is_bounded_by_ranges: bool,
    /// Draws that can be solved for.
    pub free: Vec<usize>,
    /// Number of draws that were solved for.
    pub solved: usize,
}

/// A value made from those of the steps before it.
pub type Value<'c> = &'c dyn Fn(&[Option<Expr>]) -> Option<Expr>;

/// A change of a node.
pub struct Change<'c> {
    /// Equation that is left out.
    pub dropped: Option<usize>,
    /// Draw that is solved for.
    pub solved: Option<usize>,
    /// Step with another value.
    pub replaced: Option<(usize, Value<'c>)>,
}

/// Further equations and facts of a changed node, and the value of the draw that is solved for.
#[derive(Default)]
pub struct Additions {
    pub value: Option<Expr>,
    pub equations: Vec<Expr>,
    pub facts: Vec<Expr>,
    /// Facts that the value is within its range.
    pub bounds: Vec<Expr>,
    /// Divisor of the value.
    pub divisor: Option<Expr>,
}

/// Adds to a node, from the draws and from the values of the node before a draw is solved for.
type Adding<'a> = dyn FnMut(&[Expr], &[Option<Expr>]) -> Option<Additions> + 'a;

impl Node {
    /// Makes the node of all points at which the equations of a level hold; `None` if they contain
    /// antiderivatives.
    pub fn whole(cover: &Cover<'_>) -> Result<Option<Self>, Fault> {
        let model = cover.model;
        let (graph, (made, equations, written)) = record(cover.draws.len(), |inputs| {
            let mut inputs = inputs.to_vec();
            for (input, value) in inputs.iter_mut().zip(cover.fixed) {
                if let Some(value) = value {
                    *input = Expr::rational(value);
                }
            }
            let (parameters, state) = model.make_parameters(&inputs);
            let phase = Phase::new(model, &parameters, state);
            let kept = model.level.iter().zip(cover.kept).filter(|(_, kept)| **kept);
            let all = || kept.clone().map(|(equation, _)| phase.level_function(&equation.function));
            let equations: Vec<Expr> = all().collect();
            let written: Vec<Expr> = literally(|| all().collect());
            let made: Vec<Expr> = parameters.iter().chain(state).copied().collect();
            (made, equations, written)
        })?;
        if graph.inputs() > cover.draws.len() {
            return Ok(None);
        }
        let is_free = |draw: &usize| match cover.draws[*draw] {
            Draw::Within(_) => true,
            Draw::Of(..) => *draw >= cover.parameters,
            Draw::OneOf(_) | Draw::Sign => false,
        };
        let free = (0..cover.draws.len()).filter(is_free).collect();
        let divisors = divisors(&graph, &written);
        let (graph, facts) = (Arc::new(graph), Vec::new());
        let (is_bounded_by_ranges, solved) = (true, 0);
        Ok(Some(Self {
            graph,
            made,
            equations,
            facts,
            divisors,
            is_bounded_by_ranges,
            free,
            solved,
        }))
    }

    /// Puts combinations with fewer terms in the place of the equations.
    pub fn combined(self) -> Result<Self, Fault> {
        let Some(found) = combinations::simplest(&self.graph, &self.equations) else {
            return Ok(self);
        };
        let reached = self.graph.reached(self.equations.iter().copied());
        let bare = Self { equations: Vec::new(), ..self.clone() };
        let change = Change { dropped: None, solved: None, replaced: None };
        bare.changed(&change, |inputs, _| {
            let own = self.graph.repeated(&reached, inputs);
            let at = |place: usize| own.get(place).copied().flatten();
            let all = found.iter().map(|one| combinations::value(one, &at));
            let equations = all.collect::<Option<Vec<Expr>>>()?;
            Some(Additions { equations, ..Additions::default() })
        })
    }

    /// Drops what is a number; `None` if an equation or a fact cannot hold, or a divisor is 0.
    pub fn simplified(mut self) -> Option<Self> {
        let graph = Arc::clone(&self.graph);
        let number = |value: &Expr| graph.constant_value(*value);
        // No point is made by a formula without a value.
        if self.made.iter().any(|made| graph.is_nowhere_defined(*made)) {
            return None;
        }
        if self.facts.iter().any(|fact| number(fact).is_some_and(Rational::is_negative))
            || self.divisors.iter().any(|divisor| number(divisor).is_some_and(Rational::is_zero))
            || self.equations.iter().any(|own| number(own).is_some_and(|value| !value.is_zero()))
        {
            return None;
        }
        self.facts.retain(|fact| number(fact).is_none());
        self.divisors.retain(|divisor| number(divisor).is_none());
        self.equations.retain(|equation| number(equation).is_none());
        Some(self)
    }

    /// Puts 0 in the place of roots of values that are 0 wherever they exist; `None` if an equation or a fact
    /// cannot hold then.
    pub fn without_zero_roots(mut self) -> Result<Option<Self>, Fault> {
        loop {
            let all = self.made.iter().chain(&self.equations).chain(&self.facts);
            let reached = self.graph.reached(all.copied());
            let Some(place) = vanishing_root(&self.graph, &reached) else { return Ok(Some(self)) };
            let zero = |_: &[Option<Expr>]| Some(Expr::zero());
            let change = Change { dropped: None, solved: None, replaced: Some((place, &zero)) };
            // The roots inside exist, though the value may not contain them any more.
            let inside = self.graph.reached([self.graph.at(place)]);
            let changed = self.changed(&change, |_, values| {
                let radicand = |(at, step): (usize, Step<'_>)| match step {
                    Step::Unary(UnaryFunction::Sqrt, a) if at < place && inside[at] => Some(a),
                    _ => None,
                };
                let radicands = self.graph.steps().enumerate().filter_map(radicand);
                let facts = radicands.map(|a| values[a]).collect::<Option<Vec<Expr>>>()?;
                Some(Additions { facts, ..Additions::default() })
            })?;
            let Some(changed) = changed.simplified() else { return Ok(None) };
            self = changed;
        }
    }

    /// Makes the part that the node is, of a level of `count` equations.
    pub fn into_part(self, count: usize) -> Result<Part, Fault> {
        let all: Vec<Expr> = self.made.iter().chain(&self.facts).copied().collect();
        let (graph, values) = record(self.graph.inputs(), |inputs| {
            let reached = self.graph.reached(all.iter().copied());
            let values = self.graph.repeated(&reached, inputs);
            all.iter().map(|value| values[self.graph.place(*value)]).collect::<Option<Vec<Expr>>>()
        })?;
        let mut made = values.ok_or(Fault::ForeignValue)?;
        let facts = made.split_off(self.made.len());
        let is_bounded_by_ranges = self.is_bounded_by_ranges;
        let (is_thin, is_whole) = (self.solved > count, self.solved == count);
        Ok(Part { graph, made, facts, is_bounded_by_ranges, is_thin, is_whole })
    }

    /// Leaves out an equation.
    pub fn without(&self, index: usize) -> Self {
        let mut node = self.clone();
        node.equations.remove(index);
        node
    }

    /// Divides by the factors of an equation; `None` if it is no product, root or modulus.
    pub fn factors(&self, index: usize) -> Option<Vec<Self>> {
        let inside = |step: Step<'_>| match step {
            Step::Unary(UnaryFunction::Sqrt | UnaryFunction::Abs, a) => Some(a),
            _ => None,
        };
        let whole = self.graph.place(self.equations[index]);
        let (mut factors, mut is_product) = (Vec::new(), false);
        let mut unsigned = whole;
        for (place, step) in self.graph.factors_at(whole, inside) {
            // What is walked first, but for signs, is the value itself if it is no product.
            is_product |= place != unsigned;
            match step {
                Step::Unary(UnaryFunction::Neg, a) => unsigned = a,
                // A quotient is 0 where its numerator is.
                Step::Unary(UnaryFunction::Recip, _) => {}
                Step::Constant(value) if !value.is_zero() => {}
                _ if factors.contains(&place) => {}
                _ => factors.push(place),
            }
        }
        let with = |place: &usize| {
            let mut node = self.clone();
            node.equations[index] = self.graph.at(*place);
            node
        };
        is_product.then(|| factors.iter().map(with).collect())
    }

    /// Divides by the factors of an equation that is written out; `None` if none are found.
    pub fn polynomial_factors(&self, index: usize) -> Result<Option<Vec<Self>>, Fault> {
        let Some(factors) = Factors::of(&self.graph, self.equations[index]) else {
            return Ok(None);
        };
        let with =
            |factor: usize| self.replaced(index, |at| Some(vec![factors.value(factor, at)?]));
        (0..factors.count()).map(with).collect::<Result<Vec<Self>, Fault>>().map(Some)
    }

    /// Divides by the differences of an equation c Aⁿ + d Bⁿ = 0, or c e^u + d e^v = 0; `None` if it is none.
    pub fn powers(&self, index: usize) -> Result<Option<Vec<Self>>, Fault> {
        let equation = self.equations[index];
        let found = Factors::of_exponentials(&self.graph, equation)
            .or_else(|| Factors::of_powers(&self.graph, equation));
        let Some(found) = found else { return Ok(None) };
        let with = |own: usize| self.replaced(index, |at| Some(vec![found.value(own, at)?]));
        (0..found.count()).map(with).collect::<Result<Vec<Self>, Fault>>().map(Some)
    }

    /// Writes an equation that is a sum of squares as several; `None` if it is none.
    pub fn squares(&self, index: usize) -> Result<Option<Self>, Fault> {
        let Some(squares) = Factors::of_squares(&self.graph, self.equations[index]) else {
            return Ok(None);
        };
        let all = 0..squares.count();
        self.replaced(index, |at| {
            all.map(|own| squares.value(own, at)).collect::<Option<Vec<Expr>>>()
        })
        .map(Some)
    }

    /// Divides an equation f(u) = c with a function f by its solutions u inside the extents of the draws; `None` if
    /// it is none.
    pub fn inverted(&self, index: usize, extents: &[Extent]) -> Result<Option<Vec<Self>>, Fault> {
        let Some(found) = Inverted::of(&self.graph, self.equations[index], extents) else {
            return Ok(None);
        };
        let with =
            |solution: usize| self.replaced(index, |at| Some(vec![found.value(solution, at)?]));
        (0..found.count()).map(with).collect::<Result<Vec<Self>, Fault>>().map(Some)
    }

    /// Puts others, made from the values at places, in the place of an equation.
    fn replaced(
        &self,
        index: usize,
        others: impl FnOnce(&dyn Fn(usize) -> Option<Expr>) -> Option<Vec<Expr>>,
    ) -> Result<Self, Fault> {
        let change = Change { dropped: Some(index), solved: None, replaced: None };
        let reached = self.graph.reached([self.equations[index]]);
        self.changed(&change, |inputs, _| {
            let own = self.graph.repeated(&reached, inputs);
            let equations = others(&|place| own.get(place).copied().flatten())?;
            Some(Additions { equations, ..Additions::default() })
        })
    }

    /// Writes an equation A + B √C = 0 as A² = B²C, with the fact −A B ≥ 0; `None` if it is none.
    pub fn without_root(&self, index: usize) -> Result<Option<Self>, Fault> {
        let Some(other) = Rationalised::of(&self.graph, self.equations[index]) else {
            return Ok(None);
        };
        let change = Change { dropped: Some(index), solved: None, replaced: None };
        let reached = self.graph.reached([self.equations[index]]);
        let made = self.changed(&change, |inputs, _| {
            let own = self.graph.repeated(&reached, inputs);
            let (equation, facts) = other.values(|place| own.get(place).copied().flatten())?;
            Some(Additions { equations: vec![equation], facts, ..Additions::default() })
        })?;
        Ok(Some(made))
    }

    /// Divides by the sign of the first modulus in an equation; `None` if there is none.
    pub fn by_sign(&self, index: usize) -> Result<Option<[Self; 2]>, Fault> {
        let reached = self.graph.reached([self.equations[index]]);
        let steps = self.graph.steps_at(&reached);
        let modulus = steps.into_iter().find_map(|(place, step)| match step {
            Step::Unary(UnaryFunction::Abs, a) => Some((place, a)),
            _ => None,
        });
        let Some((place, argument)) = modulus else { return Ok(None) };
        let with = |positive: bool| {
            let signed = move |value: Expr| if positive { value } else { -value };
            let own = move |values: &[Option<Expr>]| values[argument].map(signed);
            let change = Change { dropped: None, solved: None, replaced: Some((place, &own)) };
            self.changed(&change, |_, values| {
                let fact = signed(values[argument]?);
                Some(Additions { facts: vec![fact], ..Additions::default() })
            })
        };
        Ok(Some([with(true)?, with(false)?]))
    }

    /// Makes the node after a change; `more` adds to it, from the draws and from the values of the node
    /// before a draw is solved for.
    pub fn changed(
        &self,
        change: &Change<'_>,
        more: impl FnOnce(&[Expr], &[Option<Expr>]) -> Option<Additions>,
    ) -> Result<Self, Fault> {
        let mut more = Some(more);
        self.changed_by(change, &mut |inputs, before| more.take()?(inputs, before))
    }

    /// The same for any closure, compiled once.
    fn changed_by(&self, change: &Change<'_>, more: &mut Adding<'_>) -> Result<Self, Fault> {
        let kept = (0..self.equations.len()).filter(|index| change.dropped != Some(*index));
        let equations: Vec<Expr> = kept.map(|index| self.equations[index]).collect();
        let all = self.made.iter().chain(&self.equations).chain(&self.facts).chain(&self.divisors);
        let reached = self.graph.reached(all.copied());
        let (graph, found) = record(self.graph.inputs(), |inputs| {
            let replay = |inputs: &[Expr]| {
                self.graph.replay(&reached, inputs, |place, _, values| match change.replaced {
                    Some((own, value)) if own == place => value(values),
                    _ => None,
                })
            };
            let before = replay(inputs);
            let more = more(inputs, &before)?;
            let values = match (change.solved, more.value) {
                (Some(draw), Some(value)) => {
                    let mut inputs = inputs.to_vec();
                    inputs[draw] = value;
                    replay(&inputs)
                }
                _ => before,
            };
            let at = |some: &[Expr]| {
                let all = some.iter().map(|value| values[self.graph.place(*value)]);
                all.collect::<Option<Vec<Expr>>>()
            };
            let equations = [at(&equations)?, more.equations].concat();
            let is_bounded_by_ranges = self.is_bounded_by_ranges && more.facts.is_empty();
            let facts = [at(&self.facts)?, more.facts, more.bounds].concat();
            let mut divisors = at(&self.divisors)?;
            divisors.extend(more.divisor);
            Some((at(&self.made)?, equations, facts, divisors, is_bounded_by_ranges))
        })?;
        let (made, equations, facts, divisors, is_bounded_by_ranges) =
            found.ok_or(Fault::ForeignValue)?;
        let free = self.free.iter().copied().filter(|draw| change.solved != Some(*draw)).collect();
        let solved = self.solved + usize::from(change.solved.is_some());
        let graph = Arc::new(graph);
        Ok(Self { graph, made, equations, facts, divisors, is_bounded_by_ranges, free, solved })
    }
}

/// Lists what some values are divided by.
fn divisors(graph: &Graph, values: &[Expr]) -> Vec<Expr> {
    let reached = graph.reached(values.iter().copied());
    let divisor = |(place, step): (usize, Step<'_>)| match step {
        Step::Unary(UnaryFunction::Recip, a) if reached[place] => Some(graph.at(a)),
        Step::Power(a, exponent) if reached[place] && exponent.is_negative() => Some(graph.at(a)),
        _ => None,
    };
    graph.steps().enumerate().take(reached.len()).filter_map(divisor).collect()
}
