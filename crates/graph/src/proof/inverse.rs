//! Equations f(u) = c with a function f, solved for u.

use crate::graph::{Expr, Graph, Step, record};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::extent::Extent;
use super::factors::fraction_in_functions;
use super::sign;

/// Numbers of quarter turns that are compared with the size of an angle.
const QUARTERS: [i64; 5] = [1, 2, 4, 8, 16];

/// The equation f(u) = c.
pub struct Inverted {
    /// Place of u.
    argument: usize,
    solutions: Solutions,
}

/// The numbers u with f(u) = c.
enum Solutions {
    None,
    Number(Rational),
    /// The value of a function at a number.
    Of(UnaryFunction, Rational),
    /// Quarter turns.
    Quarters(Vec<i64>),
}

impl Inverted {
    /// Solves a value α f(u) + β, with numbers α and β, for u, inside the extents of the inputs; `None` if it has
    /// another form, or solutions that are not known.
    pub fn of(graph: &Graph, value: Expr, inputs: &[Extent]) -> Option<Self> {
        let (whole, places) = fraction_in_functions(graph, value)?;
        let whole = whole.polynomial()?;
        let [variable] = whole.variables()[..] else { return None };
        let Step::Unary(function, argument) = graph.step(*places.get(variable as usize)?) else {
            return None;
        };
        let (mut slope, mut rest) = (None, Rational::from(0));
        for (value, exponents) in whole.terms() {
            match exponents {
                [] => rest = value.clone(),
                [(_, 1)] => slope = Some(value),
                _ => return None,
            }
        }
        let value = &(-&rest) * &slope?.recip()?;
        let is_at_least_one = value.abs() >= Rational::from(1);
        let at = |quarters| {
            Some(Solutions::Quarters(quarters_within(graph, argument, inputs, quarters)?))
        };
        let solutions = match (function, value.to_integer()) {
            (UnaryFunction::Exp, _) if value.is_negative() || value.is_zero() => Solutions::None,
            (UnaryFunction::Exp, Some(1)) => Solutions::Number(Rational::from(0)),
            (UnaryFunction::Exp, _) => Solutions::Of(UnaryFunction::Ln, value),
            (UnaryFunction::Ln, Some(0)) => Solutions::Number(Rational::from(1)),
            (UnaryFunction::Ln, _) => Solutions::Of(UnaryFunction::Exp, value),
            (UnaryFunction::Atan, Some(0)) => Solutions::Number(value),
            (UnaryFunction::Sin, Some(0)) => at((0, 2))?,
            (UnaryFunction::Sin, Some(sign @ (1 | -1))) => at((sign, 4))?,
            (UnaryFunction::Cos, Some(0)) => at((1, 2))?,
            (UnaryFunction::Cos, Some(1)) => at((0, 4))?,
            (UnaryFunction::Cos, Some(-1)) => at((2, 4))?,
            (UnaryFunction::Sin | UnaryFunction::Cos, _) if is_at_least_one => Solutions::None,
            _ => return None,
        };
        Some(Self { argument, solutions })
    }

    /// Number of solutions.
    pub fn count(&self) -> usize {
        match &self.solutions {
            Solutions::None => 0,
            Solutions::Number(_) | Solutions::Of(..) => 1,
            Solutions::Quarters(all) => all.len(),
        }
    }

    /// Records u less a solution, from the values at places.
    pub fn value(&self, index: usize, at: impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        let solution = match &self.solutions {
            Solutions::None => return None,
            Solutions::Number(value) => Expr::rational(value),
            Solutions::Of(function, value) => Expr::rational(value).apply(*function),
            Solutions::Quarters(all) => quarters(*all.get(index)?),
        };
        Some(at(self.argument)? - solution)
    }
}

/// Records an angle of some quarter turns.
fn quarters(count: i64) -> Expr {
    let eighth = Expr::rational(&Rational::from(1)).apply(UnaryFunction::Atan);
    eighth * Expr::rational(&Rational::from(2 * count))
}

/// Lists the numbers `first` + k `step` of quarter turns that an angle may have; `None` if its size is not known.
fn quarters_within(
    graph: &Graph,
    argument: usize,
    inputs: &[Extent],
    (first, step): (i64, i64),
) -> Option<Vec<i64>> {
    let most = QUARTERS.into_iter().find(|most| {
        // u − most π/2 ≤ 0 and u + most π/2 ≥ 0
        [(*most, false), (-*most, true)].into_iter().all(|(count, is_positive)| {
            let reached = graph.reached([graph.at(argument)]);
            let recorded = record(graph.inputs(), |x| {
                Some(graph.repeated(&reached, x)[argument]? - quarters(count))
            });
            let Ok((graph, Some(value))) = recorded else { return false };
            sign(&graph, inputs, &[value], &[], value)
                .is_some_and(|known| known.is_positive == is_positive)
        })
    })?;
    Some((-most..=most).filter(|count| (count - first).rem_euclid(step) == 0).collect())
}
