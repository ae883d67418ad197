//! Number of times that a closed orbit is run through until it was found to close.

use crate::error::FlowError;
use crate::motion::carry::carried;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::Accuracy;
use liouville::number::double_double::DoubleDouble;

/// Largest prime number of turns that is tried.
const MOST_TURNS: u32 = 1000;

/// Number of turns in a time, by the state after parts of it in double-double: the motion is back
/// where it agrees with the start to all digits of f64, or as well as it does after the whole time.
pub(crate) fn turns(
    field: &TaylorProgram,
    start: &[DoubleDouble],
    time: DoubleDouble,
    residual: f64,
) -> Result<u32, FlowError> {
    let size = start.iter().map(|x| x.hi * x.hi).sum::<f64>().sqrt();
    let near = residual.max(f64::EPSILON * size);
    let mut count: u32 = 1;
    for prime in primes(MOST_TURNS) {
        // A motion that hardly moves is back after any part.
        while let Some(parts) = count.checked_mul(prime) {
            if !is_back(field, start, time, parts, near)? {
                break;
            }
            count = parts;
        }
    }
    Ok(count)
}

/// Whether the motion is back after a part of the time.
fn is_back(
    field: &TaylorProgram,
    start: &[DoubleDouble],
    time: DoubleDouble,
    parts: u32,
    near: f64,
) -> Result<bool, FlowError> {
    let part = time * DoubleDouble::from_f64(f64::from(parts)).recip();
    let end = carried::<DoubleDouble>(field, start, part, Accuracy::PAIR)?;
    let gap = end.iter().zip(start).map(|(x, y)| (*x - *y).hi);
    Ok(gap.map(|x| x * x).sum::<f64>().sqrt() <= near)
}

/// Prime numbers up to a bound.
fn primes(most: u32) -> impl Iterator<Item = u32> {
    let is_prime = |n: &u32| (2..*n).take_while(|k| k * k <= *n).all(|k| !n.is_multiple_of(k));
    (2..=most).filter(is_prime)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::recorded::program;
    use crate::motion::start::Start;
    use liouville::case::Case;
    use liouville::number::rational::Rational;

    #[test]
    fn turns_are_counted() {
        let text = r#"
            title = "Two frequencies"
            [state]
            x = "-2..2"
            y = "-2..2"
            u = "-2..2"
            v = "-2..2"
            [field]
            "x'" = "y"
            "y'" = "-x"
            "u'" = "2*v"
            "v'" = "-2*u"
        "#;
        let case = Case::parse(text, &[]).expect("a case");
        let field = program(&case.model, &[], |_| Vec::new()).expect("a field");
        let turn: Rational = "6.28318530717958647692528676655900577".parse().expect("2π");
        let turn = DoubleDouble::from_rational(&turn);
        for (at, least) in [([1, 0, 1, 0], 1), ([0, 0, 1, 0], 2), ([1, 0, 0, 0], 1)] {
            let state = at.map(Rational::from);
            let start = Start::new(&case, Some(&state), 1, 0).expect("a start");
            for count in [1, 2, 3, 7, 12] {
                let time = turn * DoubleDouble::from_f64(f64::from(count));
                let found = turns(&field, &start.state, time, 0.0);
                assert_eq!(found, Ok(count * least), "{at:?}, {count}");
            }
        }
        let away = [1, 0, 0, 0].map(Rational::from);
        let away = Start::new(&case, Some(&away), 1, 0).expect("a start").state;
        let close = turn * DoubleDouble::from_f64(1.0 + 1e-9) * DoubleDouble::from_f64(2.0);
        assert_eq!(turns(&field, &away, close, 0.0), Ok(1), "1e-9 of a turn is far in f64");
    }
}
