//! Equations that are sums and differences of the same terms: F + G = 0, F − G = 0 is F = G = 0.

use std::collections::BTreeMap;

use num_traits::Zero;

use crate::graph::{Expr, Graph, Step};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// A value as a combination of products of values at places that are no products and no numbers.
pub type Combination = BTreeMap<Vec<usize>, Rational>;

/// Largest number of terms of an equation.
const MOST_TERMS: usize = 64;

/// Finds combinations of equations with fewer terms, that are all 0 exactly where these are; `None` if there are
/// none.
pub fn simplest(graph: &Graph, equations: &[Expr]) -> Option<Vec<Combination>> {
    if equations.len() < 2 {
        return None;
    }
    let mut rows: Vec<Combination> =
        equations.iter().map(|own| terms(graph, graph.place(*own))).collect::<Option<_>>()?;
    let size = |rows: &[Combination]| rows.iter().map(BTreeMap::len).sum::<usize>();
    let before = size(&rows);
    let mut rank = 0;
    while rank < rows.len() {
        let Some((product, value)) =
            rows[rank].last_key_value().map(|(k, v)| (k.clone(), v.clone()))
        else {
            // The equation follows from the others.
            rows.remove(rank);
            continue;
        };
        let inverse = value.recip()?;
        let own = rows[rank].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(index, _)| *index != rank) {
            if let Some(other) = row.get(&product) {
                let times = -&(other * &inverse);
                add(row, &own, &times);
            }
        }
        rank += 1;
    }
    (size(&rows) < before && !rows.is_empty()).then_some(rows)
}

/// Adds a multiple of a combination to another one.
fn add(to: &mut Combination, own: &Combination, times: &Rational) {
    for (product, value) in own {
        let more = value * times;
        let sum = match to.get(product) {
            Some(before) => before + &more,
            None => more,
        };
        if sum.is_zero() {
            to.remove(product);
        } else {
            to.insert(product.clone(), sum);
        }
    }
}

/// Reads the value at a place as a combination; `None` if it has many terms.
fn terms(graph: &Graph, place: usize) -> Option<Combination> {
    let mut open = vec![(place, Rational::from(1))];
    let mut found = Combination::new();
    for _ in 0..4 * MOST_TERMS {
        let Some((place, factor)) = open.pop() else { return Some(found) };
        match graph.step(place) {
            Step::Unary(UnaryFunction::Neg, a) => open.push((a, -&factor)),
            Step::Binary(BinaryOperation::Add, a, b) => {
                open.extend([(a, factor.clone()), (b, factor)]);
            }
            Step::Binary(BinaryOperation::Sub, a, b) => {
                open.extend([(a, factor.clone()), (b, -&factor)]);
            }
            _ => {
                let (product, number) = product(graph, place)?;
                let sum = match &product[..] {
                    // 2 (F + G)
                    [own] if is_sum(graph.step(*own)) => Some(*own),
                    _ => None,
                };
                match sum {
                    Some(own) => open.push((own, &factor * &number)),
                    None => add(&mut found, &[(product, number)].into(), &factor),
                }
            }
        }
    }
    None
}

fn is_sum(step: Step<'_>) -> bool {
    matches!(step, Step::Binary(BinaryOperation::Add | BinaryOperation::Sub, ..))
}

/// Reads the value at a place as a product of values that are no products, and a number; `None` if it has many
/// factors.
fn product(graph: &Graph, place: usize) -> Option<(Vec<usize>, Rational)> {
    let (mut factors, mut number) = (Vec::new(), Rational::from(1));
    for (count, (place, step)) in graph.factors_at(place, |_| None).enumerate() {
        match step {
            _ if count == MOST_TERMS => return None,
            Step::Constant(value) => number = &number * value,
            Step::Unary(UnaryFunction::Neg, _) => number = -&number,
            _ => factors.push(place),
        }
    }
    factors.sort_unstable();
    Some((factors, number))
}

/// Records a combination from the values at places.
pub fn value(of: &Combination, at: &dyn Fn(usize) -> Option<Expr>) -> Option<Expr> {
    let mut sum = Expr::zero();
    for (product, factor) in of {
        let all = product.iter().try_fold(Expr::rational(factor), |all, own| Some(all * at(*own)?));
        sum += all?;
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::record;

    fn sizes(build: impl FnOnce(&[Expr]) -> Vec<Expr>) -> Option<Vec<usize>> {
        let (graph, values) = record(4, build).expect("records");
        Some(simplest(&graph, &values)?.iter().map(BTreeMap::len).collect())
    }

    #[test]
    fn sums_and_differences_of_products_become_the_products() {
        let both = |x: &[Expr]| [(x[0] + 1.0) * x[1] * x[2], (x[0] - x[3]) * x[2]];
        let sum = |x: &[Expr], a: f64, b: f64| {
            let [f, g] = both(x);
            f * a + g * b
        };
        assert_eq!(sizes(|x| vec![sum(x, 1.0, 1.0), sum(x, 1.0, -1.0)]), Some(vec![1, 1]));
        assert_eq!(sizes(|x| vec![sum(x, 2.0, 3.0), sum(x, -1.0, 5.0)]), Some(vec![1, 1]));
        assert_eq!(sizes(|x| vec![sum(x, 2.0, 3.0), sum(x, -4.0, -6.0)]), Some(vec![2]), "twice");
        assert_eq!(sizes(|x| vec![sum(x, 1.0, 1.0), x[0] + x[1]]), None, "nothing in common");
        assert_eq!(sizes(|x| vec![sum(x, 1.0, 1.0)]), None, "one equation");
        let inside = |x: &[Expr], k: f64| {
            let [f, g] = both(x);
            f + (x[0] - x[3]) * k * x[2] + g
        };
        assert_eq!(sizes(|x| vec![inside(x, 2.0), inside(x, -3.0)]), Some(vec![1, 1]), "numbers");
    }
}
