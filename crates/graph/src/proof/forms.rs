//! Values of degree 2 as sums of squares with factors, by completing one square after another.

use std::collections::BTreeSet;

use crate::graph::{Expr, Graph, Step};
use crate::number::rational::Rational;

use super::collected::reduced;
use super::polynomial::{MOST_WORK, Polynomial, fraction};

/// Largest number of variables of a form.
const MOST_VARIABLES: usize = 24;
/// Longest text.
const MOST_LETTERS: usize = 20_000;

/// A value as a sum of squares with factors.
pub struct CompletedSquares {
    /// Text of the sum.
    pub text: String,
    /// Whether a factor divides by more than a number.
    pub divides: bool,
}

/// Writes a value as Σ d (x + l y + …)², where x, y, … are the inputs from `first` on, and d and l
/// are quotients of polynomials in the inputs before; `names` are those of the inputs.
///
/// `None` if the value is not of degree 2 in these inputs, or if its squares cannot be completed
/// one after another.
pub fn completed_squares(
    graph: &Graph,
    value: Expr,
    first: usize,
    names: &[String],
) -> Option<CompletedSquares> {
    let input = |_: usize, step: Step<'_>| match step {
        Step::Input(number) => u32::try_from(number).ok().map(Polynomial::variable),
        _ => None,
    };
    let whole = reduced(fraction(graph, graph.place(value), &input)?)?;
    let is_coefficient = |variable: &u32| (*variable as usize) < first;
    if !whole.below.variables().iter().all(is_coefficient) {
        return None;
    }
    let own: Vec<u32> =
        whole.above.variables().into_iter().filter(|number| !is_coefficient(number)).collect();
    if own.len() > MOST_VARIABLES {
        return None;
    }
    let mut form = Form::of(&whole.above, &own)?;
    let mut scale = whole.below;
    let mut open: BTreeSet<usize> = (0..=own.len()).collect();
    let variable = |k: usize| own.get(k).map_or("1", |number| names[*number as usize].as_str());
    let mut terms: Vec<String> = Vec::new();
    let mut divides = scale.number().is_none();
    while let Some(pivot) = form.pivot(&open)? {
        open.remove(&pivot);
        let own = form.entries[pivot][pivot].clone();
        let others: Vec<usize> =
            open.iter().copied().filter(|k| !form.entries[pivot][*k].is_zero()).collect();
        let rest = others.iter().map(|k| {
            format!(" + {}*{}", quotient(&form.entries[pivot][*k], &own, names), variable(*k))
        });
        let sum = format!("{}{}", variable(pivot), rest.collect::<String>());
        terms.push(format!("{}*({sum})^2", quotient(&own, &scale, names)));
        if !others.is_empty() {
            divides |= own.number().is_none();
            form.complete(pivot, &open, &mut scale)?;
        }
        if terms.iter().map(String::len).sum::<usize>() > MOST_LETTERS {
            return None;
        }
    }
    let text = if terms.is_empty() { "0".to_string() } else { terms.join(" + ") };
    Some(CompletedSquares { text, divides })
}

/// Writes a quotient in brackets.
fn quotient(above: &Polynomial, below: &Polynomial, names: &[String]) -> String {
    match below.number().and_then(|number| number.recip()) {
        Some(inverse) => format!("({})", above.scaled(&inverse).text(names)),
        None => format!("({})/({})", above.text(names), below.text(names)),
    }
}

/// A symmetric matrix of polynomials, for the variables and 1.
struct Form {
    entries: Vec<Vec<Polynomial>>,
}

impl Form {
    /// Reads a polynomial of degree 2 in some variables.
    fn of(polynomial: &Polynomial, own: &[u32]) -> Option<Self> {
        let size = own.len() + 1;
        let mut entries = vec![vec![Polynomial::default(); size]; size];
        let half = Rational::new(1, 2);
        for (powers, coefficient) in polynomial.collected(own) {
            let mut places: Vec<usize> = Vec::new();
            for (place, power) in powers.iter().enumerate() {
                places.extend(std::iter::repeat_n(place, *power as usize));
            }
            let (i, j) = match places[..] {
                [] => (size - 1, size - 1),
                [i] => (i, size - 1),
                [i, j] => (i, j),
                _ => return None,
            };
            if i == j {
                entries[i][i] = coefficient;
            } else {
                entries[i][j] = coefficient.scaled(&half);
                entries[j][i] = entries[i][j].clone();
            }
        }
        Some(Self { entries })
    }

    /// Chooses the next square to complete: no square is left in the outer `None`, nothing at all in
    /// the inner one.
    fn pivot(&self, open: &BTreeSet<usize>) -> Option<Option<usize>> {
        let last = self.entries.len() - 1;
        let square = |k: &&usize| !self.entries[**k][**k].is_zero();
        let cost = |k: &&usize| {
            let own = &self.entries[**k][**k];
            (own.number().is_none(), own.size(), **k == last, **k)
        };
        let found = open.iter().filter(square).min_by_key(cost).copied();
        let is_empty = || open.iter().all(|i| open.iter().all(|j| self.entries[*i][*j].is_zero()));
        (found.is_some() || is_empty()).then_some(found)
    }

    /// Subtracts a square with the variable of a pivot from the others; `scale` divides what is left.
    fn complete(
        &mut self,
        pivot: usize,
        open: &BTreeSet<usize>,
        scale: &mut Polynomial,
    ) -> Option<()> {
        let own = self.entries[pivot][pivot].clone();
        let inverse = own.number().and_then(|number| number.recip());
        let mut work = MOST_WORK;
        for i in open {
            for j in open.range(*i..) {
                let product = self.entries[pivot][*i].times(&self.entries[pivot][*j], &mut work)?;
                let rest = match &inverse {
                    Some(inverse) => self.entries[*i][*j].plus(&product.scaled(&-inverse)),
                    None => {
                        let whole = self.entries[*i][*j].times(&own, &mut work)?;
                        whole.plus(&product.scaled(&Rational::from(-1)))
                    }
                };
                self.entries[*i][*j] = rest.clone();
                self.entries[*j][*i] = rest;
            }
        }
        if inverse.is_none() {
            *scale = scale.times(&own, &mut work)?;
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::record;

    fn squares(build: impl FnOnce(&[Expr]) -> Expr) -> Option<String> {
        let (graph, value) = record(3, build).expect("records");
        let found = completed_squares(&graph, value, 1, &["a", "x", "y"].map(String::from))?;
        assert_eq!(found.divides, found.text.contains("/(a"), "{}", found.text);
        Some(found.text)
    }

    #[test]
    fn squares_are_completed() {
        let form = |x: &[Expr]| x[1] * x[1] * 2.0 + x[1] * x[2] * 4.0 + x[2] * x[2] * 5.0;
        let told = squares(form).expect("of degree 2");
        assert_eq!(told, "(2)*(x + (1)*y)^2 + (3)*(y)^2");
        let told = squares(|x| x[1] * x[1] * x[0] + x[1] * x[2] * 2.0).expect("a square of x");
        assert_eq!(told, "(a)*(x + (1)/(a)*y)^2 + (-1)/(a)*(y)^2");
        assert_eq!(squares(|x| x[1] - x[1]).as_deref(), Some("0"));
        assert_eq!(squares(|x| x[1] * x[2]), None, "no square");
        assert_eq!(squares(|x| x[1] * x[1] * x[2]), None, "of degree 3");
        assert_eq!(squares(|x| x[1] / x[2]), None, "a quotient");
    }
}
