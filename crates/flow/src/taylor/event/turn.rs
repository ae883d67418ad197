//! Zeros where two pieces meet with different polynomials, as those of |x| where x is 0: the function
//! touches 0 there if it has the same side before and after, and crosses it else.

use super::sides::{DOUBTS, Sides, starts_positive};
use super::{Event, ROUNDINGS, size, value};
use crate::taylor::number::SeriesNumber;

impl Sides {
    /// Finds the events of a piece that may end where the sign of a modulus turns. A zero there is left to
    /// the next piece, which begins with it.
    pub fn events_up_to_turn<T: SeriesNumber<One = T>>(
        &mut self,
        polynomial: &[T],
        length: T,
        doubt: &dyn Fn() -> f64,
        ends_at_turn: bool,
    ) -> Vec<Event<T>> {
        if !ends_at_turn && self.open.is_none() || length.leading() == 0.0 {
            return self.events(polynomial, length, doubt);
        }
        let rounding = size(polynomial, length) * ROUNDINGS * T::EPSILON;
        let tolerance = rounding + DOUBTS * doubt();
        let is_zero = |at: T| value(polynomial, at).0.leading().abs() <= tolerance;
        // Whether the function is 0 up to rounding from one time to another.
        let stays = |from: T, to: T| {
            let half = T::float(0.5);
            is_zero(from) && is_zero((from + to) * half) && is_zero(to)
        };
        if self.open.is_some() && size(polynomial, length) <= tolerance {
            return Vec::new();
        }
        let before = self.open.take();
        let begin = match before {
            Some(_) => starts_positive(polynomial, tolerance, length),
            None => self.begin(polynomial, length, rounding, doubt),
        };
        let forward = length.leading() > 0.0;
        let mut own = Sides::on(begin);
        let mut events = own.events(polynomial, length, doubt);
        if let Some(before) = before {
            events.retain(|event| !stays(T::ZERO, event.after()));
            let after = T::ZERO;
            events.insert(
                0,
                match before == begin {
                    true => Event::Tangency { after },
                    false => Event::Crossing { after, rising: begin == forward },
                },
            );
        }
        if ends_at_turn && is_zero(length) {
            events.retain(|event| !stays(event.after(), length));
            let side = events.iter().rev().find_map(|event| match event {
                Event::Crossing { rising, .. } => Some(*rising == forward),
                Event::Tangency { .. } => None,
            });
            own.open = Some(side.unwrap_or(begin));
        }
        *self = own;
        events
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Events of pieces of length 1 that all end at turns.
    fn events(pieces: &[&[f64]], begin: bool) -> Vec<Vec<Event<f64>>> {
        let mut sides = Sides::on(begin);
        let found = pieces.iter().map(|own| sides.events_up_to_turn(own, 1.0, &|| 0.0, true));
        found.collect()
    }

    #[test]
    fn a_kink_touches_and_an_odd_power_crosses() {
        for error in [-1e-17, 0.0, 1e-17] {
            // |1 − t| and (1 − t)|1 − t|
            let touch = events(&[&[1.0 + error, -1.0], &[error, 1.0]], true);
            assert_eq!(touch[0], [], "left to the next piece");
            assert!(matches!(touch[1][..], [Event::Tangency { after: 0.0 }]), "{touch:?}");
            let cross = events(&[&[1.0 + error, -2.0, 1.0], &[error, 0.0, -1.0]], true);
            assert_eq!(cross[0], [], "left to the next piece");
            let [Event::Crossing { after: 0.0, rising: false }] = cross[1][..] else {
                panic!("{cross:?}")
            };
        }
    }

    #[test]
    fn zeros_elsewhere_are_found_as_ever() {
        // (1/4 − t)(1 − t), and then t(t − 1/2)
        let found = events(&[&[0.25, -1.25, 1.0], &[0.0, -0.5, 1.0]], true);
        assert!(matches!(found[0][..], [Event::Crossing { after: 0.25, rising: false }]));
        let [Event::Tangency { .. }, Event::Crossing { rising: true, .. }] = found[1][..] else {
            panic!("{found:?}")
        };
        let mut sides = Sides::on(true);
        let plain = sides.events_up_to_turn(&[0.5, -1.0], 1.0, &|| 0.0, false);
        assert_eq!(plain.len(), 1, "without a turn");
    }
}
