//! Functions without values modulo a prime, as independent numbers.
//!
//! A relation between terms that holds for any values of e^x, or of √(x² + y²), is found where these are
//! random numbers; others are missed. Sine and cosine of one argument are a point of a circle. A find is
//! judged with the functions themselves.

use std::collections::BTreeMap;

use liouville::graph::{Expr, Graph, Step, record};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};
use liouville::scalar::Scalar;
use num_dual::DualNum;
use num_traits::ToPrimitive;

/// Largest number of roots that are left: with n of them one point in 2ⁿ has values.
const ROOTS: usize = 6;

/// What a number stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Symbol {
    /// The function at a place.
    Function(usize),
    /// Half an angle, whose tangent gives sine and cosine.
    Angle(usize),
    /// A root of the value at a place.
    Root(usize, i64),
}

/// Replaces functions without values modulo a prime, and roots if there are many, by further inputs;
/// `None` if there are none.
pub fn symbolised(graph: &Graph, outputs: &[Vec<Expr>]) -> Option<(Graph, Vec<Vec<Expr>>)> {
    let reached = graph.reached(outputs.iter().flatten().copied());
    let places = || (0..graph.len()).filter(|place| reached[*place]);
    let mut symbols: BTreeMap<usize, Symbol> = BTreeMap::new();
    let mut roots: BTreeMap<usize, Symbol> = BTreeMap::new();
    for place in places() {
        match graph.step(place) {
            Step::Unary(UnaryFunction::Sin | UnaryFunction::Cos, argument) => {
                symbols.insert(place, Symbol::Angle(argument));
            }
            Step::Unary(UnaryFunction::Exp | UnaryFunction::Ln | UnaryFunction::Atan, _)
            | Step::Binary(BinaryOperation::Pow, ..) => {
                symbols.insert(place, Symbol::Function(place));
            }
            Step::Unary(UnaryFunction::Sqrt, argument) => {
                roots.insert(place, Symbol::Root(argument, 2));
            }
            Step::Power(argument, exponent) => match exponent.parts().1.to_i64() {
                Some(1) | None => {}
                Some(order) => {
                    roots.insert(place, Symbol::Root(argument, order));
                }
            },
            _ => {}
        }
    }
    let mut distinct: Vec<Symbol> = Vec::new();
    let mut number = |own: Symbol| {
        distinct.iter().position(|other| *other == own).unwrap_or_else(|| {
            distinct.push(own);
            distinct.len() - 1
        })
    };
    let of_roots: Vec<usize> =
        places().filter_map(|place| roots.get(&place).map(|own| number(*own))).collect();
    let count = of_roots.iter().max().map_or(0, |last| last + 1);
    match count > ROOTS {
        true => symbols.extend(roots),
        false if symbols.is_empty() => return None,
        false => {}
    }
    let mut inputs: BTreeMap<Symbol, usize> = BTreeMap::new();
    for place in places() {
        if let Some(own) = symbols.get(&place) {
            let next = graph.inputs() + inputs.len();
            inputs.entry(*own).or_insert(next);
        }
    }
    let made = record(graph.inputs() + inputs.len(), |given| {
        let one = Expr::rational(&Rational::from(1));
        let values = graph.replay(&reached, given, |place, step, _| {
            let own = symbols.get(&place)?;
            let symbol = given[*inputs.get(own)?];
            Some(match step {
                Step::Unary(UnaryFunction::Sin, _) => {
                    (symbol + symbol) * (one + symbol * symbol).recip()
                }
                Step::Unary(UnaryFunction::Cos, _) => {
                    (one - symbol * symbol) * (one + symbol * symbol).recip()
                }
                Step::Power(_, exponent) => symbol.powi(exponent.parts().0.to_i32()?),
                _ => symbol,
            })
        });
        let zero = Expr::rational(&Rational::from(0));
        let value = |own: &Expr| values[graph.place(*own)].unwrap_or(zero);
        outputs.iter().map(|own| own.iter().map(value).collect()).collect::<Vec<Vec<Expr>>>()
    });
    made.ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_become_numbers_that_keep_simple_relations() {
        let (graph, outputs) = record(2, |inputs| {
            let (x, y) = (inputs[0], inputs[1]);
            let one = x.sin() * x.sin() + x.cos() * x.cos();
            vec![vec![one, x.exp() * y], vec![x.exp() + y.ln(), x]]
        })
        .expect("a recording");
        let (made, outputs) = symbolised(&graph, &outputs).expect("there are functions");
        // Two draws, the half angle, exp and ln.
        assert_eq!(made.inputs(), 5);
        let reached = made.reached(outputs.iter().flatten().copied());
        let is_function = |place: usize| {
            matches!(made.step(place), Step::Unary(own, _) if !matches!(
                own,
                UnaryFunction::Neg | UnaryFunction::Recip
            ))
        };
        assert!(!(0..made.len()).any(|place| reached[place] && is_function(place)));
    }

    #[test]
    fn a_few_roots_are_left() {
        let roots = |count: usize| {
            record(count, |inputs| vec![inputs.iter().map(|x| x.sqrt()).collect::<Vec<_>>()])
                .expect("a recording")
        };
        let (graph, outputs) = roots(ROOTS);
        assert!(symbolised(&graph, &outputs).is_none());
        let (graph, outputs) = roots(ROOTS + 1);
        assert_eq!(
            symbolised(&graph, &outputs).map(|(made, _)| made.inputs()),
            Some(2 * ROOTS + 2)
        );
    }
}
