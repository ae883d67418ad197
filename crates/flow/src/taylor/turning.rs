//! Signs of moduli along motions: a step keeps them, and ends where the argument of one is 0.
//!
//! There the sign turns, and the motion goes on with the other branch of the field. Where the motion
//! begins, and behind a step that ended so, the signs have to agree with where the arguments go: if
//! neither sign of one does, the field pushes towards the zero from both sides, and the motion slides.

use crate::taylor::event::{Event, Sides, size, slope, starts_positive, value};
use crate::taylor::number::SeriesNumber;
use crate::taylor::pace::Lane;
use crate::taylor::plain::FAINT;
use crate::taylor::shorten::known_part;
use crate::taylor::stepper::Stepper;
use crate::taylor::watch::{Edge, may_vanish};

/// Number of steps in turn that end where they begin, from which on signs turn without end.
pub(super) const MOST_STALLS: u32 = 64;
/// Units in the last place of the largest term below which a function behind a zero is not known.
const PLACES: f64 = 256.0;
/// Number of halves of a step down to the first place behind a zero that is looked at.
const MOST_HALVES: i32 = 60;

impl<T: SeriesNumber> Stepper<T> {
    /// Gives signs that are still to be chosen those of the values of their arguments, where these are
    /// not 0 up to rounding: with the other sign a root or a logarithm may have no value, and the motion
    /// no series by which `settle_signs` could choose.
    pub(crate) fn face_signs(&mut self) {
        let count = self.series.signs();
        if count == 0 || self.lanes.iter().all(|lane| lane.is_settled) {
            return;
        }
        self.sampled.is_present = false;
        // An argument may have other signs in it, which come before its own.
        for _ in 0..=count {
            self.series.probe(&self.state);
            let mut changes = false;
            for lane in (0..T::LANES).filter(|lane| !self.lanes[*lane].is_settled) {
                let size = |x: &T| T::EPSILON * x.lane(lane).leading().abs();
                let known = || self.state.iter().zip(&self.peaks);
                let known = known().map(|(x, peak)| size(&peak.larger(*x))).collect();
                let away = self.series.turned_away(lane, known);
                if let Some(sign) = away.filter(|sign| self.lanes[lane].came_to != Some(*sign)) {
                    self.series.turn(sign, lane);
                    changes = true;
                }
            }
            if !changes {
                return;
            }
        }
    }

    /// Chooses the signs of motions that begin, or that have just come to a zero of an argument.
    pub(crate) fn settle_signs(&mut self) {
        let count = self.series.signs();
        self.doubt_signs();
        if count == 0 || self.lanes.iter().all(|lane| lane.is_settled) {
            return;
        }
        let mut turned = vec![false; count * T::LANES];
        for _ in 0..=2 * count {
            let mut changes = false;
            for lane in 0..T::LANES {
                if self.lanes[lane].is_settled || self.lanes[lane].lost.is_some() {
                    continue;
                }
                let wrong = (0..count).find(|sign| !self.agrees(*sign, lane));
                let Some(sign) = wrong else { continue };
                if std::mem::replace(&mut turned[sign * T::LANES + lane], true) && self.jumps {
                    self.lanes[lane].lost = Some(Edge::Slide);
                }
                self.series.turn(sign, lane);
                changes = true;
            }
            if !changes {
                break;
            }
            self.expand_at_state();
        }
        if self.jumps {
            (0..T::LANES).for_each(|lane| self.end_forks(lane));
        }
        for lane in &mut self.lanes {
            (lane.is_settled, lane.came_to) = (true, None);
        }
    }

    /// Lets signs be chosen again where one is not that of its argument, which was 0 up to rounding for a
    /// while and had no side.
    fn doubt_signs(&mut self) {
        for sign in 0..self.series.signs() {
            let (row, argument) = self.series.signed(sign);
            for lane in 0..T::LANES {
                let first = argument[0].lane(lane).leading();
                let differs = first != 0.0 && (first > 0.0) != self.series.is_positive(sign, lane);
                if differs && self.lanes[lane].is_settled {
                    let error = self.series.value_error(row, lane, &self.peaks).max(FAINT);
                    self.lanes[lane].is_settled = first.abs() <= error;
                }
            }
        }
    }

    /// Ends a motion that begins on a jump from which it could leave to both sides.
    fn end_forks(&mut self, lane: usize) {
        let own = &self.lanes[lane];
        if own.is_settled || own.steps > 0 || own.lost.is_some() {
            return;
        }
        for sign in 0..self.series.signs() {
            let (row, argument) = self.series.signed(sign);
            let first = argument[0].lane(lane).leading().abs();
            if first <= self.series.value_error(row, lane, &self.peaks) {
                self.series.turn(sign, lane);
                self.expand_at_state();
                let leaves = self.agrees(sign, lane);
                self.series.turn(sign, lane);
                self.expand_at_state();
                if leaves {
                    self.lanes[lane].lost = Some(Edge::Divisor);
                }
            }
        }
    }

    /// Whether the argument of a sign is on its side, or goes there.
    fn agrees(&self, sign: usize, lane: usize) -> bool {
        let is_positive = self.series.is_positive(sign, lane);
        let (row, argument) = self.series.signed(sign);
        let mut argument: Vec<T::One> = argument.iter().map(|x| x.lane(lane)).collect();
        // The last step ended at a zero, as far as its terms knew, which may be more than a rounding away.
        if self.lanes[lane].came_to == Some(sign) {
            argument[0] = T::One::ZERO;
        }
        if argument.iter().all(|term| term.leading() == 0.0) {
            return true;
        }
        let error = self.series.value_error(row, lane, &self.peaks).max(FAINT);
        // A field that is 0 on one side has steps without an end.
        let left = (self.lanes[lane].until - self.lanes[lane].time).hi / self.lanes[lane].unit;
        let length = self.step_size(lane).min(left.abs()).copysign(left);
        // Next to the zero of a root terms of higher orders say nothing, and the rate decides.
        let rate = argument[1].leading() * left.signum();
        let reach = T::EPSILON.powf(0.25) * self.natural_time(lane) / self.lanes[lane].unit;
        let is_next =
            self.lanes[lane].came_to == Some(sign) && self.series.voids().next().is_some();
        if is_next && rate.abs() * reach > error {
            return (rate > 0.0) == is_positive;
        }
        match argument[0].leading() {
            first if first.is_nan() || length.is_nan() => true,
            _ if self.lanes[lane].steps > 0 => {
                let length = known_part(&argument, T::One::float(length), self.kappa);
                goes_positive(&argument, error, length) == is_positive
            }
            first if first.abs() > error => (first > 0.0) == is_positive,
            _ => starts_positive(&argument, error, T::One::float(length)) == is_positive,
        }
    }

    /// Cuts steps where the argument of a sign is 0.
    pub(crate) fn keep_signs(&mut self) {
        for sign in 0..self.series.signs() {
            let (row, terms) = self.series.signed(sign);
            let steps = T::from_lanes(|lane| self.lanes[lane].step);
            let may_vanish = may_vanish(terms, steps);
            for (place, lane) in self.lanes.iter_mut().enumerate().filter(|(k, _)| may_vanish(*k)) {
                let argument: Vec<T::One> = terms.iter().map(|x| x.lane(place)).collect();
                let step = known_part(&argument, lane.step, self.kappa);
                let error = || self.series.value_error(row, place, &self.peaks).max(FAINT);
                // What is 0 up to rounding for the whole step has no side.
                if size(&argument, step) <= error() {
                    continue;
                }
                lane.step = step;
                let is_positive = self.series.is_positive(sign, place);
                let mut sides = Sides::on(is_positive);
                let crossing = |event: Event<T::One>| match event {
                    Event::Crossing { after, .. } => {
                        let rest = [after, step - after];
                        let turns = match behind(&argument, error(), rest) {
                            Some(side) => side != is_positive,
                            None => is_simple(&argument, after, step),
                        };
                        turns.then_some(after)
                    }
                    Event::Tangency { .. } => None,
                };
                let after = sides.events(&argument, step, &error).into_iter().find_map(crossing);
                let is_first = |after: &T::One| match lane.edge {
                    Some((_, other)) => after.leading().abs() < other.leading().abs(),
                    None => true,
                };
                if let Some(after) = after.filter(is_first) {
                    lane.step = after;
                    lane.edge = Some((Edge::Sign(sign), after));
                }
            }
        }
    }

    /// Whether the present step of a motion ends where the sign of a modulus turns.
    pub(crate) fn ends_at_turn(&self, lane: usize) -> bool {
        let Lane { edge, step, .. } = &self.lanes[lane];
        matches!(edge, Some((Edge::Sign(_), after)) if step.leading().abs() >= after.leading().abs())
    }

    /// Turns the signs of motions that have come to a zero of their arguments.
    pub(crate) fn turn_signs(&mut self) {
        for lane in 0..T::LANES {
            if let Some(sign) = self.lanes[lane].turned.take() {
                self.series.turn(sign, lane);
                (self.lanes[lane].is_settled, self.lanes[lane].came_to) = (false, Some(sign));
            }
        }
    }
}

/// Sign of a function behind a place at which another one is 0, as well as that place is known: the
/// function may have a zero there too, of any order, and the rounding of the place decides its first terms.
fn goes_positive<T: SeriesNumber>(polynomial: &[T], error: f64, length: T) -> bool {
    behind(polynomial, error, [T::ZERO, length])
        .unwrap_or_else(|| starts_positive(polynomial, error, length))
}

/// Whether a root is simple: where rounding splits a double one, the slope is some √ε of its terms.
fn is_simple<T: SeriesNumber>(polynomial: &[T], root: T, length: T) -> bool {
    let slopes = slope(polynomial);
    let least = PLACES * T::EPSILON.sqrt() * size(&slopes, length);
    value(&slopes, root).0.leading().abs() > least
}

/// Sign that a function has first, by more than rounding, from a place on, over a length.
fn behind<T: SeriesNumber>(polynomial: &[T], error: f64, [from, length]: [T; 2]) -> Option<bool> {
    let limit = error.max(PLACES * T::EPSILON * size(polynomial, from + length));
    let at = |halves: i32| {
        let after = length * T::float(libm::ldexp(1.0, -halves));
        value(polynomial, from + after).0.leading()
    };
    let values = (0..=MOST_HALVES).rev().map(at);
    values.into_iter().find(|value| value.abs() > limit).map(|value| value > 0.0)
}
