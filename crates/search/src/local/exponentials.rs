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

/// Terms of a sum: a place that is no sum or product with a number or a letter, and its multiple.
fn terms(
    graph: &Graph,
    place: usize,
    is_letter: &dyn Fn(usize) -> bool,
) -> Option<Vec<(usize, Multiple)>> {
    let one = Multiple { number: Rational::from(1), powers: BTreeMap::new() };
    let (mut found, mut open) = (Vec::new(), vec![(place, one)]);
    // Powers of letters: x, 1/x and xⁿ.
    let letter = |place: usize| -> Option<(usize, i64)> {
        let input = |own: usize| match graph.step(own) {
            Step::Input(input) => is_letter(input).then_some(input),
            _ => None,
        };
        match graph.step(place) {
            Step::Input(_) => Some((input(place)?, 1)),
            Step::Unary(UnaryFunction::Recip, a) => Some((input(a)?, -1)),
            Step::Power(a, power) => Some((input(a)?, power.to_integer()?)),
            _ => None,
        }
    };
    while let Some((at, own)) = open.pop() {
        if found.len() + open.len() > MOST_TERMS {
            return None;
        }
        let times = |number: &Rational| Multiple { number: &own.number * number, ..own.clone() };
        let raised = |(input, power): (usize, i64)| {
            let mut own = own.clone();
            *own.powers.entry(input).or_insert(0) += power;
            own.powers.retain(|_, power| *power != 0);
            own
        };
        match graph.step(at) {
            Step::Binary(BinaryOperation::Add, a, b) => open.extend([(b, own.clone()), (a, own)]),
            Step::Binary(BinaryOperation::Sub, a, b) => {
                let minus = times(&Rational::from(-1));
                open.extend([(b, minus), (a, own)]);
            }
            Step::Unary(UnaryFunction::Neg, a) => open.push((a, times(&Rational::from(-1)))),
            Step::Binary(BinaryOperation::Mul, a, b) => {
                match (graph.step(a), graph.step(b), letter(a), letter(b)) {
                    (Step::Constant(number), ..) => open.push((b, times(number))),
                    (_, Step::Constant(number), ..) => open.push((a, times(number))),
                    (.., Some(power), _) => open.push((b, raised(power))),
                    (.., None, Some(power)) => open.push((a, raised(power))),
                    _ => found.push((at, own)),
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
