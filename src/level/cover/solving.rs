//! Coefficients of an equation as a polynomial in one draw, and where a solution misses points.

use num_dual::DualNum;
use num_traits::Zero;

use super::node::{Additions, Change, Node};
use super::{Cover, Known};
use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::mechanics::Draw;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::{SquareRoot, are_coprime, is_nowhere_zero};
use crate::scalar::Scalar;

/// An equation a c² + b c + d = 0 for one draw c, with coefficients that do not depend on it.
pub struct Coefficients {
    /// Graph over the draws.
    graph: Graph,
    /// Index of the equation.
    equation: usize,
    /// The draw c.
    draw: usize,
    /// d, b and a.
    rest: Expr,
    slope: Expr,
    bend: Expr,
    /// b² − 4 a d
    discriminant: Expr,
    /// Values that are not negative at a point of the node.
    facts: Vec<Expr>,
}

impl Coefficients {
    /// Finds the coefficients of an equation; `None` if it is no such equation.
    pub fn of(node: &Node, equation: usize, draw: usize) -> Result<Option<Self>, Fault> {
        let reached = node.graph.reached([node.equations[equation]]);
        let place = node.graph.place(node.equations[equation]);
        // The derivatives of x/|x| do not tell that it has two values.
        if !is_polynomial(&node.graph, &reached, draw) {
            return Ok(None);
        }
        let (expanded, found) = record(node.graph.inputs(), |inputs| {
            let value = node.graph.repeated(&reached, inputs)[place]?;
            let slope = derivative(value, inputs[draw])?;
            Some([value, slope, derivative(slope, inputs[draw])?])
        })?;
        let Some(found @ [.., bend]) = found else { return Ok(None) };
        if expanded.depends_on(bend, draw) {
            return Ok(None);
        }
        let reached = expanded.reached(found);
        let all = node.equations.iter().chain(&node.facts).copied();
        let whole = node.graph.reached(all);
        let (graph, made) = record(node.graph.inputs(), |inputs| {
            let mut origin = inputs.to_vec();
            origin[draw] = Expr::zero();
            let values = expanded.repeated(&reached, &origin);
            let [rest, slope, bend] = found.map(|value| values[expanded.place(value)]);
            let bend = bend? * Expr::rational(&Rational::new(1, 2));
            let four = Expr::rational(&Rational::from(4));
            let discriminant = slope? * slope? - four * bend * rest?;
            let values = node.graph.repeated(&whole, inputs);
            let at = |value: &Expr| values[node.graph.place(*value)];
            let mut facts = node.facts.iter().map(at).collect::<Option<Vec<Expr>>>()?;
            for equation in &node.equations {
                let value = at(equation)?;
                facts.extend([value, -value]);
            }
            Some(([rest?, slope?, bend, discriminant], facts))
        })?;
        let ([rest, slope, bend, discriminant], facts) = made.ok_or(Fault::ForeignValue)?;
        Ok(Some(Self { graph, equation, draw, rest, slope, bend, discriminant, facts }))
    }

    fn is_linear(&self) -> bool {
        self.number(self.bend).is_some_and(Rational::is_zero)
    }

    /// Returns what a solution divides by.
    fn divisor(&self) -> Expr {
        if self.is_linear() { self.slope } else { self.bend }
    }

    fn number(&self, value: Expr) -> Option<&Rational> {
        self.graph.constant_value(value)
    }

    /// Rates a solution by what it divides by: numbers are best, and linear equations.
    pub fn cost(&self, cover: &Cover<'_>) -> usize {
        const ROOT: usize = 1000;
        const PARAMETER: usize = 10_000;
        let of_degree = if self.is_linear() { 0 } else { ROOT };
        let of_draw = if self.draw < cover.parameters { PARAMETER } else { 0 };
        // Roots of numbers are worse than numbers.
        let divisor = self.divisor();
        let of_divisor = usize::from(self.number(divisor).is_none());
        of_degree + of_draw + of_divisor + self.graph.inputs_of(divisor).len()
    }

    /// Divides a node into the solutions of the equation, and what they may miss; `None` if the
    /// divisor is not known to be 0 everywhere, or on no open set.
    pub fn solutions(&self, cover: &Cover<'_>, node: &Node) -> Result<Option<Vec<Node>>, Fault> {
        let divisor = self.divisor();
        let lower = |with_divisor: bool| {
            let change = Change { dropped: Some(self.equation), solved: None, replaced: None };
            node.changed(&change, |inputs, _| {
                let [rest, slope, divisor] = self.at([self.rest, self.slope, divisor], inputs)?;
                let left = if self.is_linear() { rest } else { slope * inputs[self.draw] + rest };
                let equations = if with_divisor { vec![divisor, left] } else { vec![left] };
                Some(Additions { equations, ..Additions::default() })
            })
        };
        let known = match self.number(divisor) {
            Some(number) if number.is_zero() => Known::Zero,
            Some(_) => Known::Thin,
            None => cover.known(&self.graph, divisor, &[])?,
        };
        match known {
            Known::Zero => return Ok(Some(vec![lower(false)?])),
            Known::Thin => {}
            Known::Open => return Ok(None),
        }
        let Some(mut children) = self.roots(cover, node)? else { return Ok(None) };
        if self.may_miss(cover, node) {
            children.push(lower(true)?);
        }
        Ok(Some(children))
    }

    /// Makes a node for each root of the equation.
    fn roots(&self, cover: &Cover<'_>, node: &Node) -> Result<Option<Vec<Node>>, Fault> {
        if self.is_linear() {
            return Ok(Some(vec![self.child(cover, node, None, 1)?]));
        }
        if !matches!(cover.known(&self.graph, self.discriminant, &[])?, Known::Thin) {
            return Ok(None);
        }
        let square = SquareRoot::of(&self.graph, self.discriminant);
        // Real roots are where the discriminant vanishes.
        if square.as_ref().is_some_and(SquareRoot::is_negative) {
            // At a = 0 the equation says more.
            let dropped = self.number(self.bend).map(|_| self.equation);
            let change = Change { dropped, solved: None, replaced: None };
            let double = node.changed(&change, |inputs, _| {
                let all = [self.discriminant, self.bend, self.slope];
                let [discriminant, bend, slope] = self.at(all, inputs)?;
                let middle = (bend + bend) * inputs[self.draw] + slope;
                let equations = vec![discriminant, middle];
                Some(Additions { equations, ..Additions::default() })
            })?;
            return Ok(Some(vec![double]));
        }
        let one = |sign| self.child(cover, node, square.as_ref(), sign);
        Ok(Some(vec![one(1)?, one(-1)?]))
    }

    fn child(
        &self,
        cover: &Cover<'_>,
        node: &Node,
        square: Option<&SquareRoot>,
        sign: i64,
    ) -> Result<Node, Fault> {
        let change =
            Change { dropped: Some(self.equation), solved: Some(self.draw), replaced: None };
        node.changed(&change, |inputs, _| {
            let values = self.replayed(inputs);
            let at = |value: Expr| values[self.graph.place(value)];
            let (facts, value) = match (self.is_linear(), square) {
                (true, _) => (Vec::new(), -(at(self.rest)? / at(self.slope)?)),
                (false, square) => {
                    let (facts, root) = match square {
                        Some(square) => (Vec::new(), square.value(|place| values[place])?),
                        None => {
                            let discriminant = at(self.discriminant)?;
                            (vec![discriminant], discriminant.sqrt())
                        }
                    };
                    let root = root * Expr::rational(&Rational::from(sign));
                    let below = at(self.bend)? * Expr::rational(&Rational::from(2));
                    (facts, (root - at(self.slope)?) / below)
                }
            };
            let mut bounds = Vec::new();
            if let Draw::Within(range) = &cover.draws[self.draw] {
                let [low, high] = [&range.low, &range.high].map(Expr::rational);
                bounds.extend([value - low, high - value]);
            }
            let divisor = Some(at(self.divisor())?);
            let value = Some(value);
            Some(Additions { value, facts, bounds, divisor, ..Additions::default() })
        })
    }

    /// Whether points may be missed: those at which the divisor and the terms that remain vanish. For
    /// the last equation they do no harm if these have no common factor.
    fn may_miss(&self, cover: &Cover<'_>, node: &Node) -> bool {
        let divisor = self.divisor();
        if self.number(divisor).is_some() {
            return false;
        }
        let values = match self.is_linear() {
            true => vec![divisor, self.rest],
            false => vec![divisor],
        };
        let has_none = is_nowhere_zero(&self.graph, cover.extents, &self.facts, &values);
        let is_last = self.is_linear() && node.equations.len() == 1;
        !(has_none || is_last && are_coprime(&self.graph, &values, cover.seed))
    }

    fn replayed(&self, inputs: &[Expr]) -> Vec<Option<Expr>> {
        let all = [self.rest, self.slope, self.bend, self.discriminant];
        self.graph.repeated(&self.graph.reached(all), inputs)
    }

    fn at<const N: usize>(&self, values: [Expr; N], inputs: &[Expr]) -> Option<[Expr; N]> {
        let made = self.replayed(inputs);
        let found: Option<Vec<Expr>> =
            values.iter().map(|value| made[self.graph.place(*value)]).collect();
        found?.try_into().ok()
    }
}

/// Whether those steps that depend on a draw are polynomials in it.
fn is_polynomial(graph: &Graph, reached: &[bool], draw: usize) -> bool {
    let mut depends = vec![false; reached.len()];
    for (place, step) in graph.steps().enumerate().take(reached.len()) {
        depends[place] = match step {
            Step::Input(input) => input == draw,
            _ => step.arguments().any(|argument| depends[argument]),
        };
        if reached[place] && depends[place] && !is_sum_or_product(step) {
            return false;
        }
    }
    true
}

/// Whether a step makes a polynomial of polynomials.
pub fn is_sum_or_product(step: Step<'_>) -> bool {
    match step {
        Step::Constant(_) | Step::Input(_) | Step::Unary(UnaryFunction::Neg, _) => true,
        Step::Binary(operation, ..) => operation != BinaryOperation::Pow,
        Step::Power(_, exponent) => exponent.to_integer().is_some_and(|exponent| exponent >= 0),
        Step::Unary(..) => false,
    }
}

/// Differentiates a recorded value by an input.
fn derivative(value: Expr, input: Expr) -> Option<Expr> {
    let rows = Expr::gradients_of(&[value], &[input])?;
    Some(rows.first()?.first().map_or_else(Expr::zero, |(_, slope)| *slope))
}
