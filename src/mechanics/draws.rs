//! Addressable randomness: state number i depends on the seed and on i alone.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::recipe::Draw;
use crate::number::rational::Rational;

/// The draws of state `index`: short decimals strictly inside their ranges, never 0.
///
/// The same seed and index give the same numbers, whatever else is drawn, on every machine.
pub fn draw_state(seed: u64, index: u64, draws: &[Draw]) -> Vec<Rational> {
    let mut stream = ChaCha8Rng::seed_from_u64(seed);
    stream.set_stream(index);
    draws.iter().map(|draw| draw_one(draw, stream.next_u64())).collect()
}

fn draw_one(draw: &Draw, bits: u64) -> Rational {
    match draw {
        Draw::OneOf(values) => values
            .get(scale(bits, values.len() as u64) as usize)
            .cloned()
            .unwrap_or_else(|| Rational::from(0)),
        Draw::Within(range) => {
            let width = &range.high - &range.low;
            let (step, count) = grid(&width);
            let value = &range.low + &(&step * &Rational::from(1 + scale(bits, count) as i64));
            // Formulas that are wrong in general hold on coordinate planes.
            if value.is_zero() { &value + &step } else { value }
        }
    }
}

/// A step of the form 10^k and how many points lie strictly inside `width`: about a thousand.
fn grid(width: &Rational) -> (Rational, u64) {
    let (size, _) = width.to_f64();
    let exponent = (size.log10().floor() as i32).clamp(-400, 400) - 3;
    let step = Rational::from(10).powi(exponent).unwrap_or_else(|| Rational::from(1));
    let (steps, _) = step.recip().map_or((1000.0, true), |inverse| (width * &inverse).to_f64());
    // One point is kept back, for the step away from 0.
    (step, (steps.ceil() as u64).saturating_sub(2).max(1))
}

/// Maps 64 random bits to 0..count, by multiplication.
fn scale(bits: u64, count: u64) -> u64 {
    ((u128::from(bits) * u128::from(count)) >> 64) as u64
}

#[cfg(test)]
mod tests {
    use super::super::recipe::Range;
    use super::*;

    #[test]
    fn the_stream_is_frozen() {
        let draws = vec![Draw::Within(Range::between((1, 2), (2, 1))); 3];
        let shown: Vec<String> = draw_state(7, 3, &draws).iter().map(|x| x.to_string()).collect();
        assert_eq!(shown, FROZEN, "a change here changes every witness ever printed");
    }

    const FROZEN: [&str; 3] = ["0.5", "0.5", "0.5"];

    #[test]
    fn draws_stay_inside_and_off_zero() {
        let range = Range::between((-1, 1), (1, 1));
        let draws = vec![Draw::Within(range.clone()); 2000];
        for value in draw_state(1, 0, &draws) {
            assert!(value > range.low && value < range.high && !value.is_zero(), "{value}");
        }
        let narrow = Draw::Within(Range::between((1, 1_000_000), (2, 1_000_000)));
        let value = draw_state(1, 0, &[narrow])[0].clone();
        assert!(value > Rational::new(1, 1_000_000) && value < Rational::new(2, 1_000_000));
    }

    #[test]
    fn states_differ_and_do_not_depend_on_each_other() {
        let draws = vec![Draw::Within(Range::between((0, 1), (1, 1))); 4];
        assert_ne!(draw_state(1, 0, &draws), draw_state(1, 1, &draws));
        assert_eq!(draw_state(1, 5, &draws)[..2], draw_state(1, 5, &draws[..2])[..]);
    }
}
