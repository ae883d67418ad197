//! Ends of ranges: rational numbers, and formulas of numbers such as 2π, rounded inward to f64.
//!
//! An end rounded outward would lie beyond π, where sin x changes its sign.

use num_bigint::BigInt;

use super::parameters::constant;
use crate::formula::{Formula, Scope, Type};
use crate::graph::{self, Evaluator, Tape};
use crate::mechanics::Vocabulary;
use crate::number::arb::ArbBall;
use crate::number::rational::Rational;

/// Precision of an end that is no rational number, in bits.
const BITS: u32 = 160;

/// One of the ends of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RangeEnd {
    Low,
    High,
}

/// Reads an end of a range: the number if it is rational, else the next one of f64 inside of the range;
/// `None` if the text is no formula of numbers alone.
pub fn end(text: &str, side: RangeEnd, scope: &dyn Scope) -> Option<Rational> {
    match read(text, scope)? {
        EndValue::Exact(number) => Some(number),
        EndValue::Within([low, high]) => {
            let inside = match side {
                RangeEnd::Low => high.to_f64().0.next_up(),
                RangeEnd::High => low.to_f64().0.next_down(),
            };
            let is_inside = |x: &Rational| match side {
                RangeEnd::Low => *x >= high,
                RangeEnd::High => *x <= low,
            };
            // The conversion may be off by one step to either side.
            let outward = |x: f64| match side {
                RangeEnd::Low => x.next_down(),
                RangeEnd::High => x.next_up(),
            };
            let steps = std::iter::successors(Some(inside), |x| Some(outward(*x)));
            steps.map_while(Rational::from_f64).take_while(is_inside).take(4).last()
        }
    }
}

/// Reads a number, or a formula of numbers alone such as 2π/3 and √2, which is rounded to f64.
pub fn number(text: &str) -> Option<Rational> {
    match read(text, &Vocabulary::default())? {
        EndValue::Exact(number) if text.trim().parse::<Rational>().is_ok() => Some(number),
        EndValue::Exact(number) => Rational::from_f64(number.to_f64().0),
        EndValue::Within([low, _]) => Rational::from_f64(low.to_f64().0),
    }
}

/// A number as it is written.
enum EndValue {
    Exact(Rational),
    /// Bounds of a number that is not seen to be rational, closer to each other than f64 sees.
    Within([Rational; 2]),
}

/// Reads a formula of numbers alone.
fn read(text: &str, scope: &dyn Scope) -> Option<EndValue> {
    let text = text.trim();
    if let Ok(number) = text.parse() {
        return Some(EndValue::Exact(number));
    }
    let formula = Formula::parse(text, scope).ok()?;
    if formula.value_type() != Type::Scalar || formula.symbols().next().is_some() {
        return None;
    }
    let exact = constant(&formula).and_then(|values| values.into_iter().next());
    exact.map(EndValue::Exact).or_else(|| enclosed(&formula))
}

/// Encloses a formula of numbers.
fn enclosed(formula: &Formula) -> Option<EndValue> {
    let (graph, values) = graph::record(0, |_| {
        formula.evaluate::<graph::Expr>(&mut |_| unreachable!("it has no symbols")).components()
    })
    .ok()?;
    let tape = Tape::new(&graph, &values);
    let mut evaluator = Evaluator::new(&tape, ArbBall::new(BITS));
    evaluator.run(&[]);
    let value = evaluator.outputs().next()?.clone()?;
    let (middle, exponent, radius) = value.parts();
    let two = Rational::from(2).powi(i32::try_from(exponent).ok()?)?;
    let at = |end: BigInt| &Rational::from_parts(end, BigInt::from(1)) * &two;
    let bounds = [at(middle.clone() - BigInt::from(radius)), at(middle + BigInt::from(radius))];
    bounds.iter().all(|end| end.to_f64().0.is_normal()).then_some(EndValue::Within(bounds))
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
    fn ends_are_exact_or_the_next_f64_inside() {
        let names = Vocabulary::default();
        let ends = |text: &str| [RangeEnd::Low, RangeEnd::High].map(|side| end(text, side, &names));
        for (text, value) in
            [("3/7", (3, 7)), ("2*3", (6, 1)), ("(1 + 2)/4", (3, 4)), ("-2^3", (-8, 1))]
        {
            let exact = Some(Rational::new(value.0, value.1));
            assert_eq!(ends(text), [exact.clone(), exact], "{text}");
        }
        for text in ["pi", "-π", "pi/2", "2*pi", "2*pi/3", "100*pi", "√2", "e^-20", "-sqrt(3)/7"]
        {
            let [Some(low), Some(high)] = ends(text) else { panic!("{text} is a number") };
            let (above, below) = (low.to_f64().0, high.to_f64().0);
            assert_eq!(above, below.next_up(), "{text}: neighbours");
            assert_eq!(Rational::from_f64(above), Some(low), "{text}");
            assert_eq!(Rational::from_f64(below), Some(high), "{text}");
        }
        // π = 3.14159265358979323846…, and f64 has 3.14159265358979311… and 3.14159265358979356….
        let [Some(low), Some(high)] = ends("pi") else { panic!("it is a number") };
        assert_eq!([low.to_f64().0, high.to_f64().0], [3.1415926535897936, std::f64::consts::PI]);
        assert_eq!(number("pi").map(|x| x.to_f64().0), Some(std::f64::consts::PI));
        for text in ["k", "180°", "", "[1,2]", "1/0", "ln(-1)", "1 2"] {
            assert_eq!(ends(text), [None, None], "{text}");
        }
    }
}
