//! Logarithms, powers and exponentials in terms of logarithms and powers of other values.

use crate::graph::{Expr, Graph, Step};
use crate::number::BinaryOperation::Pow;
use crate::number::UnaryFunction::{Exp, Ln};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// The logarithm of a positive value: Σ e ln p + Σ q ln X_j.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Logarithm {
    /// Primes p with their multiples e.
    pub numbers: Vec<(i64, Rational)>,
    /// Places of the X_j with their multiples q.
    pub terms: Vec<(usize, Rational)>,
}

impl Logarithm {
    /// Records y ln X; ln X without y.
    pub fn value(&self, graph: &Graph, values: &[Option<Expr>]) -> Option<Expr> {
        let mut sum = Expr::rational(&Rational::from(0));
        for (number, multiple) in &self.numbers {
            let number = Expr::rational(&Rational::from(*number)).apply(Ln);
            sum += number * Expr::rational(multiple);
        }
        for (place, multiple) in &self.terms {
            let own = match graph.step(*place) {
                Step::Unary(Exp, a) => values[a]?,
                Step::Binary(Pow, a, y) => values[y]? * values[a]?.apply(Ln),
                _ => values[*place]?.apply(Ln),
            };
            sum += own * Expr::rational(multiple);
        }
        Some(sum)
    }

    /// Records X^y.
    pub fn power(&self, graph: &Graph, y: Expr, values: &[Option<Expr>]) -> Option<Expr> {
        let mut product = Expr::rational(&Rational::from(1));
        for (number, multiple) in &self.numbers {
            let number = Expr::rational(&Rational::from(*number));
            product *= number.power_of(y * Expr::rational(multiple));
        }
        for (place, multiple) in &self.terms {
            let exponent = y * Expr::rational(multiple);
            product *= match graph.step(*place) {
                Step::Unary(Exp, a) => (values[a]? * exponent).apply(Exp),
                Step::Binary(Pow, a, y) => values[a]?.power_of(values[y]? * exponent),
                _ => values[*place]?.power_of(exponent),
            };
        }
        Some(product)
    }
}

/// Records e^E as e^R Π X_j^Y_j, where E is the value at a place and the ln X_j are at others.
pub fn split_exponential(
    graph: &Graph,
    exponent: usize,
    logarithms: &[usize],
    values: &[Option<Expr>],
) -> Option<Expr> {
    let (rest, factors) = sum(graph, exponent, logarithms, values)?;
    let mut product = rest.apply(Exp);
    for (place, factor) in logarithms.iter().zip(factors) {
        let argument = graph.step(*place).arguments().next()?;
        product *= values[argument]?.power_of(factor);
    }
    Some(product)
}

/// Records R and Y_j of E = R + Σ Y_j L_j, for values L_j at some places: R is E with 0 for all of
/// them, Y_j is E − R with 1 for L_j.
pub fn sum(
    graph: &Graph,
    place: usize,
    parts: &[usize],
    values: &[Option<Expr>],
) -> Option<(Expr, Vec<Expr>)> {
    let reached = graph.reached_from(&[place]);
    let with = |one: Option<usize>| {
        let mut made: Vec<Option<Expr>> = vec![None; graph.len()];
        for at in (0..=place).filter(|at| reached[*at]) {
            if parts.contains(&at) {
                made[at] = Some(Expr::rational(&Rational::from(i64::from(Some(at) == one))));
            } else if graph.step(at).arguments().any(|argument| made[argument].is_some()) {
                let of = |argument: usize| made[argument].or(values[argument]);
                made[at] = Some(graph.step(at).repeat_from(of)?);
            }
        }
        made[place].or(values[place])
    };
    let rest = with(None)?;
    let factors: Option<Vec<Expr>> =
        parts.iter().map(|part| Some(with(Some(*part))? - rest)).collect();
    Some((rest, factors?))
}
