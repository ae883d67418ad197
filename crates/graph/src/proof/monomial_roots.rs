//! Inputs as products of powers of roots and of other inputs: b = y²/a where y = √(ab) occurs.

use std::collections::BTreeMap;

use crate::graph::{Graph, Step};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;

use super::polynomial::{Fraction, Polynomial, fraction};

/// Largest exponent in absolute value.
const MOST_POWER: i64 = 8;

/// A number other than 0 times powers of variables, none with the exponent 0.
#[derive(Clone)]
struct Product {
    factor: Rational,
    exponents: BTreeMap<u32, i64>,
}

/// Writes inputs that some places need by roots of products of inputs; empty if there are no such
/// roots. Variables are places.
pub fn inputs_by_roots(graph: &Graph, places: &[usize]) -> BTreeMap<usize, Fraction> {
    let reached = graph.reached_from(places);
    let mut known: BTreeMap<u32, Product> = BTreeMap::new();
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        let Step::Unary(UnaryFunction::Sqrt, argument) = step else { continue };
        let Some(own) = Product::of(graph, argument).and_then(|own| own.with(&known)) else {
            continue;
        };
        let is_input = |variable: &u32| matches!(graph.step(*variable as usize), Step::Input(_));
        let solvable =
            |(variable, exponent): &(&u32, &i64)| exponent.abs() == 1 && is_input(variable);
        let Some((input, exponent)) =
            own.exponents.iter().rev().find(solvable).map(|(input, exponent)| (*input, *exponent))
        else {
            continue;
        };
        // y² = c x^±1 m
        let mut rest = own;
        rest.exponents.remove(&input);
        let Some(mut solved) = rest.inverse().filter(|_| place as u32 > input) else { continue };
        solved.multiply(place as u32, 2);
        let solved = if exponent == 1 { Some(solved) } else { solved.inverse() };
        let Some(solved) = solved else { continue };
        let solution = BTreeMap::from([(input, solved.clone())]);
        let changed: Option<BTreeMap<u32, Product>> =
            known.iter().map(|(own, by)| Some((*own, by.clone().with(&solution)?))).collect();
        if let Some(changed) = changed {
            known = changed;
            known.insert(input, solved);
        }
    }
    known.into_iter().map(|(input, by)| (input as usize, by.fraction())).collect()
}

impl Product {
    /// Reads the value at a place.
    fn of(graph: &Graph, place: usize) -> Option<Self> {
        let input = |at: usize, step: Step<'_>| match step {
            Step::Input(_) => Some(Polynomial::variable(at as u32)),
            _ => None,
        };
        let Fraction { above, below } = fraction(graph, place, &input)?;
        let ((above, own), (below, others)) = (above.as_term()?, below.as_term()?);
        let mut product = Self { factor: above * &below.recip()?, exponents: BTreeMap::new() };
        own.iter().for_each(|(variable, power)| product.multiply(*variable, i64::from(*power)));
        others.iter().for_each(|(variable, power)| product.multiply(*variable, -i64::from(*power)));
        Some(product)
    }

    fn multiply(&mut self, variable: u32, exponent: i64) {
        let own = self.exponents.entry(variable).or_insert(0);
        *own += exponent;
        if *own == 0 {
            self.exponents.remove(&variable);
        }
    }

    fn inverse(&self) -> Option<Self> {
        let exponents = self.exponents.iter().map(|(variable, power)| (*variable, -power));
        Some(Self { factor: self.factor.recip()?, exponents: exponents.collect() })
    }

    /// Replaces variables by products.
    fn with(self, known: &BTreeMap<u32, Product>) -> Option<Self> {
        let mut product = Self { factor: self.factor, exponents: BTreeMap::new() };
        for (variable, power) in self.exponents {
            let Some(by) = known.get(&variable) else {
                product.multiply(variable, power);
                continue;
            };
            let factor = if power > 0 { by.factor.clone() } else { by.factor.recip()? };
            for _ in 0..power.abs() {
                product.factor = &product.factor * &factor;
            }
            by.exponents
                .iter()
                .for_each(|(own, exponent)| product.multiply(*own, exponent * power));
        }
        product.exponents.values().all(|power| power.abs() <= MOST_POWER).then_some(product)
    }

    fn fraction(&self) -> Fraction {
        let powers = |sign: i64| {
            let own = self.exponents.iter().map(move |(variable, power)| (*variable, sign * power));
            own.filter(|(_, power)| *power > 0).map(|(variable, power)| (variable, power as u32))
        };
        Fraction {
            above: Polynomial::of_term(&self.factor, powers(1)),
            below: Polynomial::of_term(&Rational::from(1), powers(-1)),
        }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::{Expr, record};

    #[test]
    fn inputs_are_written_by_roots_of_products() {
        let roots = |x: &[Expr]| [x[0] * x[1], x[1] / x[2] * 4.0, x[0] + x[1]].map(|x| x.sqrt());
        let (graph, (inputs, roots)) =
            record(3, |x| ([x[0], x[1], x[2]], roots(x))).expect("records");
        let places = roots.map(|root| graph.place(root));
        let found = inputs_by_roots(&graph, &places);
        assert_eq!(found.len(), 2, "of two products");
        // The values that inputs and roots have at (2, 3, 5).
        let numbers = [2.0, 3.0, 5.0];
        let value = |place: usize| {
            let input = inputs.iter().position(|x| graph.place(*x) == place);
            input.map_or_else(
                || if place == places[0] { 6f64.sqrt() } else { 2.4f64.sqrt() },
                |k| numbers[k],
            )
        };
        let of = |polynomial: &Polynomial| {
            let (factor, exponents) = polynomial.as_term().expect("a product");
            let powers = exponents.iter().map(|(v, e)| value(*v as usize).powi(*e as i32));
            factor.to_f64().0 * powers.product::<f64>()
        };
        for (input, by) in &found {
            let ratio = of(&by.above) / of(&by.below) / value(*input);
            assert!((ratio - 1.0).abs() < 1e-12, "{ratio}");
        }
    }
}
