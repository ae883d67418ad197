//! Ends of motions that come early, and their reasons.

use crate::error::FlowError;
use crate::taylor::number::SeriesNumber;
use crate::taylor::pace::Lost;
use crate::taylor::stepper::Stepper;
use crate::taylor::turning::MOST_STALLS;
use crate::taylor::watch::{Edge, Presence};
use liouville::number::double_double::DoubleDouble;

/// Number of steps before a singularity at which it counts as near.
const STEPS_BEFORE: f64 = 64.0;
/// Size of a state, or of its change in a unit of time, that is the last one below the end of the range of f64.
const HUGE: f64 = 1e290;
/// Ratio of the time since the start to that in which a motion changes by its own size, from which on it
/// runs into a singularity.
const SUDDEN: f64 = 1e3;

/// Size below which an argument that falls may underflow in place of coming to 0.
const FAINT: f64 = 1e-250;
/// Ratio of the last step of a motion to its longest one, above which it comes to no singularity.
const SHRUNK: f64 = 1e-5;
/// Growth of the state since the start, from which on a motion may run away beside poles of its field.
const GROWN: f64 = 100.0;

impl<T: SeriesNumber> Stepper<T> {
    /// Checks the present expansion of a motion; fails where the motion runs into a singularity,
    /// where its end is out of reach, and once it is stopped.
    pub fn check(&self, lane: usize) -> Result<(), FlowError> {
        if self.halt.is_raised() {
            return Err(FlowError::Stopped);
        }
        let motion = &self.lanes[lane];
        let step = motion.length();
        let finite = self.is_regular(lane);
        let left = (motion.until - motion.time).hi.abs();
        // Less than the time's last place may be left of a very long run.
        let at_end = left <= f64::EPSILON * motion.time.hi.abs();
        // A step may end where it begins, at a zero of a modulus.
        let turns = matches!(motion.edge, Some((Edge::Sign(_), _))) && motion.stalls < MOST_STALLS;
        let advances = at_end || turns || motion.moves();
        let time = motion.time.hi;
        let state = || self.own_state(lane).iter().map(|x| x.hi).collect();
        match (motion.lost, &self.presence) {
            (None, _) => {}
            (Some(Edge::Watched(index)), Some(presence)) => {
                return Err(self.without_value(lane, presence, presence.formula(index)));
            }
            (Some(Edge::Slide), _) => return Err(FlowError::Slides { time, state: state() }),
            (Some(_), _) => return Err(self.singular(lane)),
        }
        if motion.is_faint {
            return Err(FlowError::Overflow(time));
        }
        match finite && advances && step.is_finite() {
            true => match motion.pace.lost.filter(|_| !at_end) {
                None => Ok(()),
                Some(Lost::Shrinking(rest)) => {
                    let [first, largest] = motion.sizes;
                    let grown = largest / first;
                    Err(FlowError::Shrinking { time, step, rest, grown, state: state() })
                }
                Some(Lost::Endless) if motion.is_open => Ok(()),
                Some(Lost::Endless) => Err(FlowError::Endless { time, step, until: motion.aim.hi }),
            },
            false => Err(self.singular(lane)),
        }
    }

    /// Longest step that a motion has taken.
    pub(crate) fn longest_step(&self, lane: usize) -> f64 {
        self.lanes[lane].pace.longest()
    }

    /// State of the system itself, without further components.
    fn own_state(&self, lane: usize) -> Vec<DoubleDouble> {
        let mut state = self.pairs(lane);
        state.truncate(self.presence.as_ref().map_or(state.len(), |presence| presence.dimension()));
        state
    }

    /// Error at a state where the field has no series: a start without a value is told by the formula
    /// that has none.
    fn singular(&self, lane: usize) -> FlowError {
        let (time, state) = (self.lanes[lane].time.hi, self.pairs(lane));
        let is_lost = self.lanes[lane].lost.is_some();
        if !is_lost && self.series.overflows(lane) {
            return FlowError::Overflow(time);
        }
        if (time == 0.0 || is_lost)
            && let Some(presence) = &self.presence
            && let Some(formula) = presence.missing(&state)
        {
            return self.without_value(lane, presence, formula);
        }
        let sizes = self.sizes.norms.map(|norm| norm.lane(lane).leading());
        let is_too_large = !state.iter().all(|x| x.is_finite()) || sizes[0].max(sizes[1]) > HUGE;
        // At the start of a field without poles no coefficient is that of a singularity nearby.
        let is_first = time == 0.0 && self.series.is_entire();
        if is_too_large || self.series.overflows(lane) || is_first {
            return FlowError::Overflow(time);
        }
        let state = self.own_state(lane).iter().map(|x| x.hi).collect();
        match is_lost || self.is_at_end(lane) {
            true if !is_lost && self.runs_away(lane) => FlowError::RunsAway { time, state },
            true => FlowError::Singular { time, state },
            // All numbers at the state are finite, and some coefficient is not.
            false if !self.is_regular(lane) => FlowError::Overflow(time),
            false => FlowError::TooShort { time, state },
        }
    }

    /// Whether a singularity is near: steps have shrunk, and the motion changes by its own size in a
    /// small part of the time since its start, or the argument of a quotient, a root or a logarithm
    /// comes to 0 within a few steps. What e^(e^t) does is none, nor an argument that underflows.
    fn is_at_end(&self, lane: usize) -> bool {
        let motion = &self.lanes[lane];
        let at = |value: T| value.lane(lane).leading();
        let [still, moving, ..] = self.sizes.norms.map(at);
        let is_shrunk = motion.former <= SHRUNK * motion.pace.longest();
        is_shrunk && moving * (motion.time.hi / motion.unit).abs() > SUDDEN * still
            || self.an_argument_vanishes(lane)
    }

    /// Whether the argument of a quotient, a root or a logarithm comes to 0 within a few steps.
    fn an_argument_vanishes(&self, lane: usize) -> bool {
        let motion = &self.lanes[lane];
        let reach = STEPS_BEFORE * motion.former / motion.unit;
        let direction = (motion.until - motion.time).hi.signum();
        self.series.arguments().any(|own| {
            let [value, rate] = own.map(|x| x.lane(lane).leading());
            let is_faint = value != 0.0 && value.abs() < FAINT;
            let grows = value * rate * direction > 0.0;
            !is_faint && !grows && value.abs() <= rate.abs() * reach || value == 0.0
        })
    }

    /// Whether a motion that ends goes to infinity: motions of a field that has values and series
    /// everywhere end in no other way. With other fields its size grows, and no argument of a quotient, a
    /// root or a logarithm comes to 0.
    fn runs_away(&self, lane: usize) -> bool {
        if self.series.is_entire() {
            return true;
        }
        let motion = &self.lanes[lane];
        let direction = motion.step.leading().signum();
        let rates = self.pairs(lane).into_iter().zip(self.velocity(lane));
        let largest =
            rates.map(|(x, rate)| (x.hi, rate)).max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        let grows = largest.is_some_and(|(x, rate)| x * rate * direction > 0.0);
        grows && motion.sizes[1] > GROWN * motion.sizes[0] && !self.an_argument_vanishes(lane)
    }

    /// Error at a state where a formula has no value.
    fn without_value(&self, lane: usize, presence: &Presence, formula: &str) -> FlowError {
        FlowError::NoValue {
            formula: formula.to_string(),
            time: self.lanes[lane].time.hi,
            place: presence.place(&self.pairs(lane)),
        }
    }

    /// Whether the present expansion of a motion is finite.
    pub(crate) fn is_regular(&self, lane: usize) -> bool {
        self.sizes.soundness.lane(lane).leading() == 0.0
    }

    /// Whether the present step of a motion is cut where the motion itself may go on.
    pub fn is_cut(&self, lane: usize) -> bool {
        self.is_regular(lane) && self.lanes[lane].is_cut
    }
}
