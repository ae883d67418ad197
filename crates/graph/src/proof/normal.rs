//! Graphs in which exponentials of multiples of one value are powers of one, and logarithms of products are sums.

use rustc_hash::FxHashMap;

use crate::graph::{Expr, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// Largest power of an exponential.
const MOST_POWER: i64 = 8;
/// Largest number of factors of the argument of a logarithm.
const MOST_FACTORS: usize = 24;

/// Records values so that exp(2x) is exp(x)², and ln(x²/y) is 2 ln x − ln y; they are the same where both have a
/// value. `None` if nothing changes.
pub(super) fn normalised(graph: &Graph, values: &[Expr]) -> Option<(Graph, Vec<Expr>)> {
    let reached = graph.reached(values.iter().copied());
    let exponentials = exponentials(graph, &reached);
    let is_split = |(place, step): (usize, Step<'_>)| match step {
        Step::Unary(UnaryFunction::Ln, a) if reached[place] => factors(graph, a).is_some(),
        _ => false,
    };
    if exponentials.is_empty() && !graph.steps().enumerate().any(is_split) {
        return None;
    }
    let (normal, found) = record(graph.inputs(), |inputs| {
        let own = graph.replay(&reached, inputs, |place, step, own| match step {
            Step::Unary(UnaryFunction::Exp, _) => {
                let (core, unit, power) = exponentials.get(&place)?;
                let argument = own[*core]? * Expr::rational(unit);
                Some(argument.apply(UnaryFunction::Exp).power(&Rational::from(*power)))
            }
            Step::Unary(UnaryFunction::Ln, a) => {
                let mut sum = Expr::rational(&Rational::from(0));
                for (factor, power) in factors(graph, a)? {
                    sum += own[factor]?.apply(UnaryFunction::Ln) * Expr::rational(&power);
                }
                Some(sum)
            }
            _ => None,
        });
        values.iter().map(|value| own[graph.place(*value)]).collect::<Option<Vec<Expr>>>()
    })
    .ok()?;
    Some((normal, found?))
}

/// Exponentials as powers of exp(unit·core), by place.
fn exponentials(graph: &Graph, reached: &[bool]) -> FxHashMap<usize, (usize, Rational, i64)> {
    let mut by_core: FxHashMap<usize, Vec<(usize, Rational)>> = FxHashMap::default();
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        if let Step::Unary(UnaryFunction::Exp, a) = step {
            let (core, multiple) = multiple(graph, a);
            by_core.entry(core).or_default().push((place, multiple));
        }
    }
    let mut all = FxHashMap::default();
    for (core, own) in by_core.into_iter().filter(|(_, own)| own.len() > 1) {
        let unit = own[1..].iter().fold(own[0].1.abs(), |unit, (_, next)| common(unit, next.abs()));
        let Some(inverse) = unit.recip() else { continue };
        for (place, multiple) in own {
            let power = (&multiple * &inverse).to_integer();
            if let Some(power) = power.filter(|power| power.abs() <= MOST_POWER) {
                all.insert(place, (core, unit.clone(), power));
            }
        }
    }
    all
}

/// The largest number of which two positive ones are whole multiples; the first, if they are long.
fn common(first: Rational, second: Rational) -> Rational {
    let found = || {
        let ((a, b), (c, d)) = (first.small_parts()?, second.small_parts()?);
        let (mut above, mut rest) = (a.checked_mul(d)?, c.checked_mul(b)?);
        while rest != 0 {
            (above, rest) = (rest, above % rest);
        }
        Some(Rational::new(above, b.checked_mul(d)?))
    };
    found().unwrap_or(first)
}

/// A value as a multiple of another.
fn multiple(graph: &Graph, mut place: usize) -> (usize, Rational) {
    let mut factor = Rational::from(1);
    loop {
        let number = |place: usize| match graph.step(place) {
            Step::Constant(value) if !value.is_zero() => Some(value),
            _ => None,
        };
        match graph.step(place) {
            Step::Unary(UnaryFunction::Neg, a) => (place, factor) = (a, -&factor),
            Step::Binary(BinaryOperation::Mul, a, b) => match (number(a), number(b)) {
                (Some(own), _) => (place, factor) = (b, &factor * own),
                (_, Some(own)) => (place, factor) = (a, &factor * own),
                _ => return (place, factor),
            },
            _ => return (place, factor),
        }
    }
}

/// Factors of a product with their powers; `None` if it is none, or if a number among them is not positive.
fn factors(graph: &Graph, place: usize) -> Option<Vec<(usize, Rational)>> {
    let mut found: Vec<(usize, Rational)> = Vec::new();
    let mut open = vec![(place, Rational::from(1))];
    while let Some((place, power)) = open.pop() {
        match graph.step(place) {
            Step::Binary(BinaryOperation::Mul, a, b) => {
                open.extend([(b, power.clone()), (a, power)]);
            }
            Step::Unary(UnaryFunction::Recip, a) => open.push((a, -&power)),
            Step::Unary(UnaryFunction::Sqrt, a) => open.push((a, &power * &Rational::new(1, 2))),
            Step::Power(a, exponent) => open.push((a, &power * exponent)),
            Step::Constant(value) if value.is_negative() || value.is_zero() => return None,
            _ => match found.iter_mut().find(|(own, _)| *own == place) {
                Some((_, before)) => *before = &*before + &power,
                None => found.push((place, power)),
            },
        }
        if found.len() + open.len() > MOST_FACTORS {
            return None;
        }
    }
    let is_itself = matches!(found.as_slice(), [(own, power)] if *own == place && power.is_one());
    (!is_itself).then_some(found)
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;

    #[test]
    fn exponentials_become_powers_and_logarithms_sums() {
        let (graph, values) = record(2, |x| {
            let two = Expr::rational(&Rational::from(2));
            let other = Expr::rational(&Rational::from(-3));
            vec![(x[0] * two).exp() * (x[0] * other).exp(), (x[0] * x[0] / x[1]).ln(), x[1].ln()]
        })
        .expect("records");
        let (normal, found) = normalised(&graph, &values).expect("changes");
        let (same, expected) = record(2, |x| {
            let two = Expr::rational(&Rational::from(2));
            let e = x[0].exp();
            let of = |value: Expr, power: i64| value.power(&Rational::from(power));
            vec![of(e, 2) * of(e, -3), x[0].ln() * two - x[1].ln(), x[1].ln()]
        })
        .expect("records");
        let text = |graph: &Graph, value: &Expr| {
            super::super::collected::text(graph, graph.place(*value), &["x".into(), "y".into()])
        };
        assert_eq!(text(&normal, &found[0]), text(&same, &expected[0]));
        assert!(found.iter().all(|value| !normal.is_nowhere_defined(*value)));
        let steps: Vec<Step<'_>> = normal.steps().collect();
        let logarithms = steps.iter().filter(|step| matches!(step, Step::Unary(UnaryFunction::Ln, a) if matches!(normal.step(*a), Step::Input(_))));
        assert_eq!(logarithms.count(), 2, "ln x and ln y");
        let (graph, value) = record(1, |x| (-x[0] * x[0] + x[0]).ln()).expect("records");
        assert!(normalised(&graph, &[value]).is_none(), "a sum has no factors");
    }
}
