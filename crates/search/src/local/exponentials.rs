//! Exponentials of coordinates: where x occurs in e^(n r x) alone, with whole n, it is ln(u)/r, u = e^(r x).
//!
//! An argument of an exponential is a sum of multiples of inputs, or later of logarithms, by rational numbers
//! and by powers of further inputs.

use std::collections::BTreeMap;

use num_integer::Integer;

use liouville::graph::{Expr, Fault, Graph, Step, record};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};
use liouville::scalar::Scalar;

/// Largest number of terms of an argument.
const MOST_TERMS: usize = 32;
/// Largest power of an exponential.
const LARGEST_POWER: i64 = 24;

/// A factor of a term: a number, and powers of the values at places.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Multiple {
    number: Rational,
    powers: BTreeMap<usize, i64>,
}

/// Rate of an exponential: a number times at most one input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rate {
    /// The number, above 0.
    pub number: Rational,
    /// The input.
    pub letter: Option<usize>,
}

impl Multiple {
    fn number(number: Rational) -> Self {
        Self { number, powers: BTreeMap::new() }
    }

    /// Reads a product of numbers and powers of letters; `None` if it has other factors.
    fn of(graph: &Graph, place: usize, is_letter: &dyn Fn(usize) -> bool) -> Option<Self> {
        let own = |place: usize| Self::of(graph, place, is_letter);
        Some(match graph.step(place) {
            Step::Constant(number) => Self::number(number.clone()),
            Step::Input(input) if is_letter(input) => {
                Self { number: Rational::from(1), powers: BTreeMap::from([(input, 1)]) }
            }
            Step::Unary(UnaryFunction::Neg, a) => own(a)?.times(&Self::number(Rational::from(-1))),
            Step::Unary(UnaryFunction::Recip, a) => own(a)?.raised(-1)?,
            Step::Power(a, power) => own(a)?.raised(power.to_integer()?)?,
            Step::Binary(BinaryOperation::Mul, a, b) => own(a)?.times(&own(b)?),
            _ => return None,
        })
    }

    fn times(&self, other: &Self) -> Self {
        let mut powers = self.powers.clone();
        for (input, power) in &other.powers {
            *powers.entry(*input).or_insert(0) += power;
        }
        powers.retain(|_, power| *power != 0);
        Self { number: &self.number * &other.number, powers }
    }

    fn raised(&self, power: i64) -> Option<Self> {
        let number = self.number.powi(i32::try_from(power).ok()?)?;
        let powers = self.powers.iter().map(|(input, own)| Some((*input, own.checked_mul(power)?)));
        Some(Self { number, powers: powers.collect::<Option<_>>()? })
    }
}

/// Terms of a sum: a place that is no sum or product with a number or a letter, and its multiple.
fn terms(
    graph: &Graph,
    place: usize,
    is_letter: &dyn Fn(usize) -> bool,
) -> Option<Vec<(usize, Multiple)>> {
    let minus = Multiple::number(Rational::from(-1));
    let (mut found, mut open) = (Vec::new(), vec![(place, Multiple::number(Rational::from(1)))]);
    while let Some((at, own)) = open.pop() {
        if found.len() + open.len() > MOST_TERMS {
            return None;
        }
        match graph.step(at) {
            Step::Binary(BinaryOperation::Add, a, b) => open.extend([(b, own.clone()), (a, own)]),
            Step::Binary(BinaryOperation::Sub, a, b) => {
                open.extend([(b, own.times(&minus)), (a, own)]);
            }
            Step::Unary(UnaryFunction::Neg, a) => open.push((a, own.times(&minus))),
            Step::Binary(BinaryOperation::Mul, a, b) => {
                let factor = |place: usize| Multiple::of(graph, place, is_letter);
                match (factor(a), factor(b)) {
                    // Of a letter and a number the number is the factor.
                    (Some(_), Some(number)) if number.powers.is_empty() => {
                        open.push((a, own.times(&number)));
                    }
                    (Some(factor), _) => open.push((b, own.times(&factor))),
                    (None, Some(factor)) => open.push((a, own.times(&factor))),
                    (None, None) => found.push((at, own)),
                }
            }
            _ => found.push((at, own)),
        }
    }
    Some(found)
}

/// Lists the places of the arguments of exponentials that some values need.
fn arguments(graph: &Graph, values: &[Expr]) -> Vec<usize> {
    let reached = graph.reached(values.iter().copied());
    let needed = graph.steps().zip(&reached).filter(|(_, reached)| **reached);
    let mut found: Vec<usize> = needed
        .filter_map(|(step, _)| match step {
            Step::Unary(UnaryFunction::Exp, a) => Some(a),
            _ => None,
        })
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// Finds the inputs that occur in exponentials, each with the rate of which the others are whole multiples.
///
/// Those whose rates have no rational ratio are left out: e^x and e^(√2 x) are no rational functions of one
/// coordinate.
pub fn rates(
    graph: &Graph,
    values: &[Expr],
    is_letter: &dyn Fn(usize) -> bool,
) -> BTreeMap<usize, Rate> {
    let mut found: BTreeMap<usize, Option<Rate>> = BTreeMap::new();
    for argument in arguments(graph, values) {
        let Some(all) = terms(graph, argument, is_letter) else { continue };
        for (place, own) in all {
            let letter = match own.powers.iter().collect::<Vec<_>>().as_slice() {
                [] => Some(None),
                [(input, 1)] => Some(Some(**input)),
                _ => None,
            };
            let is_single = matches!(graph.step(place), Step::Input(_));
            for input in graph.inputs_of(graph.at(place)) {
                let new = letter
                    .filter(|_| is_single)
                    .map(|letter| Rate { number: own.number.abs(), letter });
                let known = found.entry(input).or_insert_with(|| new.clone());
                *known = match (known.take(), new) {
                    (Some(a), Some(b)) if a.letter == b.letter => {
                        Some(Rate { number: common(&a.number, &b.number), letter: a.letter })
                    }
                    _ => None,
                };
            }
        }
    }
    let letters: Vec<usize> = found.values().flatten().filter_map(|own| own.letter).collect();
    let all = found.into_iter().filter_map(|(input, own)| Some((input, own?)));
    all.filter(|(input, own)| !own.number.is_zero() && !letters.contains(input)).collect()
}

/// Largest number of which two are whole multiples.
fn common(a: &Rational, b: &Rational) -> Rational {
    let ((a, c), (b, d)) = (a.parts(), b.parts());
    Rational::from_parts((&a * &d).gcd(&(&b * &c)), c * d)
}

/// The value of a coordinate x: ln(u)/r.
pub fn logarithm<T: Scalar>(u: T, number: &Rational, letter: Option<T>) -> T {
    let scaled = u.ln() * T::rational(&number.recip().unwrap_or_else(|| Rational::from(0)));
    letter.map_or(scaled, |letter| scaled * letter.recip())
}

/// Records values anew, with exponentials of sums of whole multiples of logarithms written out.
pub fn without_logarithms(graph: &Graph, values: &[Expr]) -> Result<(Graph, Vec<Expr>), Fault> {
    let products: BTreeMap<usize, Vec<(usize, i64)>> = arguments(graph, values)
        .into_iter()
        .filter_map(|argument| Some((argument, powers(graph, argument)?)))
        .collect();
    let reached = graph.reached(values.iter().copied());
    record(graph.inputs(), |inputs| {
        let replayed = graph.replay(&reached, inputs, |_, step, replayed| match step {
            Step::Unary(UnaryFunction::Exp, a) => product(products.get(&a)?, replayed),
            _ => None,
        });
        let value = |value: &Expr| replayed[graph.place(*value)].unwrap_or_else(Expr::undefined);
        values.iter().map(value).collect()
    })
}

/// Bases and powers of which the exponential of a sum is a product; `None` if it is none.
fn powers(graph: &Graph, argument: usize) -> Option<Vec<(usize, i64)>> {
    let power = |(place, own): (usize, Multiple)| {
        let whole = own.number.to_integer().filter(|n| n.abs() <= LARGEST_POWER)?;
        match graph.step(place) {
            Step::Unary(UnaryFunction::Ln, base) if own.powers.is_empty() => Some((base, whole)),
            _ => None,
        }
    };
    terms(graph, argument, &|_| true)?.into_iter().map(power).collect()
}

fn product(powers: &[(usize, i64)], values: &[Option<Expr>]) -> Option<Expr> {
    let mut all = Expr::rational(&Rational::from(1));
    for (base, power) in powers {
        let base = values[*base]?;
        let base = if *power < 0 { Expr::rational(&Rational::from(1)) / base } else { base };
        for _ in 0..power.abs() {
            all *= base;
        }
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rates of functions of x, y, k, where k is a letter.
    fn of(build: impl FnOnce([Expr; 3]) -> Vec<Expr>) -> Vec<(usize, String)> {
        let (graph, values) =
            record(3, |inputs| build([inputs[0], inputs[1], inputs[2]])).expect("recorded");
        let all = rates(&graph, &values, &|input| input == 2);
        let text = |(input, own): (usize, Rate)| {
            let letter = own.letter.map_or(String::new(), |letter| format!(" of {letter}"));
            (input, format!("{}{letter}", own.number))
        };
        all.into_iter().map(text).collect()
    }

    fn number(above: i64, below: i64) -> Expr {
        Expr::rational(&Rational::new(above, below))
    }

    #[test]
    fn rates_have_rational_ratios() {
        let exp = |x: Expr| x.apply(UnaryFunction::Exp);
        let told = |own: &[(usize, &str)]| -> Vec<(usize, String)> {
            own.iter().map(|(input, rate)| (*input, rate.to_string())).collect()
        };
        assert_eq!(of(|[x, y, _]| vec![exp(x - y)]), told(&[(0, "1"), (1, "1")]));
        let own = of(|[x, y, _]| vec![exp(x * number(3, 2)), exp(y - x)]);
        assert_eq!(own, told(&[(0, "0.5"), (1, "1")]), "3/2 and −1");
        let own = of(|[x, y, k]| vec![exp(x * k), exp(k * (number(2, 1) * (x + y)))]);
        assert_eq!(own, told(&[(0, "1 of 2"), (1, "2 of 2")]));
        assert!(of(|[x, _, k]| vec![exp(x), exp(k * x)]).is_empty(), "1 and k");
        let root = |x: Expr| number(2, 1).apply(UnaryFunction::Sqrt) * x;
        assert_eq!(of(|[x, y, _]| vec![exp(x), exp(root(x) + y)]), told(&[(1, "1")]), "1 and √2");
        assert!(of(|[x, y, _]| vec![exp(x * y), exp(x)]).is_empty(), "a product");
        let own = of(|[_, _, k]| vec![exp(k * number(3, 1)), exp(number(2, 1) * k)]);
        assert_eq!(own, told(&[(2, "1")]), "a parameter as an exponent");
        let own = of(|[x, _, k]| vec![exp(k * x), exp(k)]);
        assert_eq!(own, told(&[(0, "1 of 2")]), "a rate is no exponent itself: exp k stays");
    }

    #[test]
    fn exponentials_of_logarithms_are_products() {
        let left = |build: &dyn Fn([Expr; 3]) -> Expr| {
            let (graph, values) =
                record(3, |inputs| vec![build([inputs[0], inputs[1], inputs[2]])])
                    .expect("recorded");
            let (graph, values) = without_logarithms(&graph, &values).expect("recorded");
            !arguments(&graph, &values).is_empty()
        };
        let (one, two) = (Rational::from(1), Rational::from(2));
        let exp = |x: Expr| x.apply(UnaryFunction::Exp);
        assert!(!left(&|[u, w, _]| exp(
            number(6, 1) * logarithm(u, &two, None) - logarithm(w, &one, None)
        )));
        assert!(!left(&|[u, _, k]| exp(number(2, 1) * k * logarithm(u, &one, Some(k)))));
        assert!(left(&|[u, _, _]| exp(logarithm(u, &two, None))), "a root of u");
        assert!(left(&|[u, _, k]| exp(logarithm(u, &one, Some(k)))), "a power of u");
        assert!(left(&|[u, _, _]| exp(logarithm(u, &one, None) + number(1, 1))), "e u");
    }
}
