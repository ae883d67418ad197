//! Roots of scales whose squares are beyond the range of f64.

use num_dual::DualNum;

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// Squares outside of these have lost digits, or all.
pub const LEAST: f64 = 1e-280;
pub const MOST: f64 = f64::MAX;
/// A number below all terms that matter: the largest of terms that are 0 is none to divide by.
const TINY: f64 = 1e-300;

/// Records quotients of some values and the root of a sum of squares, without the square of a term.
pub fn ratios(graph: &Graph, sizes: &[Expr], square: Expr) -> Result<(Graph, Vec<Expr>), Fault> {
    let reached = graph.reached(sizes.iter().chain([&square]).copied());
    let (made, found) = record(graph.inputs(), |inputs| {
        let values = graph.repeated(&reached, inputs);
        let root = root(graph, &values, graph.place(square))?;
        sizes
            .iter()
            .map(|size| Some(values[graph.place(*size)]? / root))
            .collect::<Option<Vec<_>>>()
    })?;
    found.map(|found| (made, found)).ok_or(Fault::ForeignValue)
}

/// Returns the root of a value that is not negative: a sum, product or quotient of squares.
fn root(graph: &Graph, values: &[Option<Expr>], place: usize) -> Option<Expr> {
    let of = |place: usize| root(graph, values, place);
    match graph.step(place) {
        Step::Binary(BinaryOperation::Mul, a, b) if a == b => Some(values[a]?.modulus()),
        Step::Binary(BinaryOperation::Mul, a, b) => Some(of(a)? * of(b)?),
        Step::Unary(UnaryFunction::Recip, a) => Some(of(a)?.recip()),
        Step::Power(a, exponent) => match exponent.to_integer() {
            Some(exponent) if exponent % 2 == 0 => {
                Some(values[a]?.modulus().power(&Rational::from(exponent / 2)))
            }
            _ => Some(values[place]?.sqrt()),
        },
        Step::Binary(BinaryOperation::Add, ..) => {
            let (mut open, mut roots) = (vec![place], Vec::new());
            while let Some(place) = open.pop() {
                match graph.step(place) {
                    Step::Binary(BinaryOperation::Add, a, b) => open.extend([a, b]),
                    _ => roots.push(of(place)?),
                }
            }
            let half = Expr::rational(&Rational::new(1, 2));
            let larger = |a: Expr, b: Expr| (a + b + (a - b).modulus()) * half;
            let most = roots.iter().copied().fold(Expr::from(TINY), larger);
            let square = |own: Expr| {
                let part = own / most;
                part * part
            };
            let sum = roots.into_iter().map(square).reduce(|a, b| a + b)?;
            Some(most * sum.sqrt())
        }
        _ => Some(values[place]?.sqrt()),
    }
}
