//! Ends of ranges: rational numbers, and formulas of numbers such as 2π, rounded outward.

use num_bigint::BigInt;
use num_integer::Integer;

use super::parameters::constant;
use crate::formula::{Formula, Scope, Type};
use crate::graph::{self, Evaluator, Tape};
use crate::mechanics::Vocabulary;
use crate::number::arb::ArbBall;
use crate::number::rational::Rational;

/// Precision of an end that is no rational number, in bits.
const BITS: u32 = 160;
/// Decimals kept of it, from the first that is not 0: no number of f64 lies between it and the end.
const DIGITS: i32 = 24;

/// One of the ends of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RangeEnd {
    Low,
    High,
}

/// Reads an end of a range: the number, or one with few digits outside of it; `None` if the text is no
/// formula of numbers alone.
pub fn end(text: &str, side: RangeEnd, scope: &dyn Scope) -> Option<Rational> {
    let text = text.trim();
    if let Ok(number) = text.parse() {
        return Some(number);
    }
    let formula = Formula::parse(text, scope).ok()?;
    if formula.value_type() != Type::Scalar || formula.symbols().next().is_some() {
        return None;
    }
    let exact = constant(&formula).and_then(|values| values.into_iter().next());
    exact.or_else(|| rounded(&formula, side))
}

/// Reads a number, or a formula of numbers alone such as 2π/3 and √2, which is rounded to f64.
pub fn number(text: &str) -> Option<Rational> {
    let text = text.trim();
    let exact = || end(text, RangeEnd::Low, &Vocabulary::default());
    text.parse().ok().or_else(|| Rational::from_f64(exact()?.to_f64().0))
}

/// Encloses a formula of numbers, and rounds the end of the enclosure outward.
fn rounded(formula: &Formula, side: RangeEnd) -> Option<Rational> {
    let (graph, values) = graph::record(0, |_| {
        formula.evaluate::<graph::Expr>(&mut |_| unreachable!("it has no symbols")).components()
    })
    .ok()?;
    let tape = Tape::new(&graph, &values);
    let mut evaluator = Evaluator::new(&tape, ArbBall::new(BITS));
    evaluator.run(&[]);
    let value = evaluator.outputs().next()?.clone()?;
    let (middle, exponent, radius) = value.parts();
    let end = match side {
        RangeEnd::Low => middle - BigInt::from(radius),
        RangeEnd::High => middle + BigInt::from(radius),
    };
    let two = Rational::from(2).powi(i32::try_from(exponent).ok()?)?;
    let end = &Rational::from_parts(end, BigInt::from(1)) * &two;
    let size = end.to_f64().0.abs();
    if !size.is_normal() {
        return None;
    }
    let unit = Rational::from(10).powi(DIGITS - size.log10().floor() as i32)?;
    let (above, below) = (&end * &unit).parts();
    let digits = match side {
        RangeEnd::Low => above.div_floor(&below),
        RangeEnd::High => -(-above).div_floor(&below),
    };
    Some(&Rational::from_parts(digits, BigInt::from(1)) * &unit.recip()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_may_be_formulas() {
        assert_eq!(number(" 3/7 "), Some(Rational::new(3, 7)));
        for (text, value) in [("2*pi", 2.0 * std::f64::consts::PI), ("sqrt(2)/2", 0.5f64.sqrt())] {
            let own = number(text).map(|x| x.to_f64().0);
            assert!(own.is_some_and(|x| (x - value).abs() < 1e-15), "{text}: {own:?}");
        }
        assert_eq!((number("1 2"), number("x"), number("")), (None, None, None));
    }

    #[test]
    fn ends_are_exact_or_outside_by_less_than_f64_sees() {
        let names = Vocabulary::default();
        let ends = |text: &str| [RangeEnd::Low, RangeEnd::High].map(|side| end(text, side, &names));
        for (text, value) in
            [("3/7", (3, 7)), ("2*3", (6, 1)), ("(1 + 2)/4", (3, 4)), ("-2^3", (-8, 1))]
        {
            let exact = Some(Rational::new(value.0, value.1));
            assert_eq!(ends(text), [exact.clone(), exact], "{text}");
        }
        for (text, value) in [
            ("pi", std::f64::consts::PI),
            ("-π", -std::f64::consts::PI),
            ("2*pi/3", 2.0 * std::f64::consts::PI / 3.0),
            ("√2", std::f64::consts::SQRT_2),
            ("e^-20", (-20f64).exp()),
        ] {
            let [Some(low), Some(high)] = ends(text) else { panic!("{text} is a number") };
            assert!(low < high, "{text}");
            let gap = (&high - &low).to_f64().0;
            assert!(gap < 1e-22 * value.abs(), "{text}: {gap:e}");
            assert!((low.to_f64().0 - value).abs() <= 1e-15 * value.abs(), "{text}");
            // π = 3.14159265358979323846264338327950288…
            if text == "pi" {
                let digits = |text: &str| text.parse::<Rational>().expect("a number");
                assert!(low < digits("3.14159265358979323846264338327950289"));
                assert!(high > digits("3.14159265358979323846264338327950288"));
            }
        }
        for text in ["k", "180°", "", "[1,2]", "1/0", "ln(-1)", "1 2"] {
            assert_eq!(ends(text), [None, None], "{text}");
        }
    }
}
