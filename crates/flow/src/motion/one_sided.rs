//! Motion under a one-sided constraint r(x) ≥ 0: free phases and phases of contact.
//!
//! The motion is free while r > 0. It comes into contact where r falls through 0, and then obeys
//! the field of contact, which preserves r = 0, as long as the reaction λ is not negative; where λ
//! falls through 0 it is free again. A minimum of r that is 0 up to rounding is reported as
//! grazing, not as contact.

use crate::error::FlowError;
use crate::motion::orbit::Watcher;
use crate::motion::recorded::program;
use crate::motion::start::Start;
use crate::taylor::event::{Event, Sides, size, slope, starts_positive, value};
use crate::taylor::number::SeriesNumber;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::{Accuracy, Stepper};
use liouville::case::{Case, OneSided};
use liouville::mechanics::calculus::DualPoint;
use liouville::mechanics::{Model, System};
use liouville::number::double_double::DoubleDouble;

/// Roundings of the largest term of r below which a minimum counts as 0.
const ROUNDINGS: f64 = 4096.0;
/// Multiple of the error of a function's operands below which it counts as 0.
const DOUBTS: f64 = 64.0;
/// Number of places behind a root at which a function is looked at.
const SAMPLES: u32 = 32;
/// Units in the last place of the time below which a phase lasts no time.
const PLACES: f64 = 16.0;
/// Limit on the number of phases, above that of any motion of interest.
const MAX_PHASES: usize = 100_000;

/// Kind of event at the constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// The motion arrives, and stays.
    Arrives,
    /// The reaction vanishes, and the motion becomes free.
    Leaves,
    /// The constraint is touched in passing.
    Grazes,
}

/// An event at the constraint.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactEvent {
    /// Kind of the event.
    pub kind: Contact,
    /// Time of the event.
    pub time: DoubleDouble,
    /// State at the event.
    pub state: Vec<DoubleDouble>,
}

/// Both fields, each with the function that ends its phase.
struct Phases {
    /// Free field, with r, r' and λ as further functions.
    free: TaylorProgram,
    /// Field of contact, with λ as a further function.
    contact: TaylorProgram,
}

impl Phases {
    fn new(case: &Case, rule: &OneSided, start: &Start) -> Result<Self, FlowError> {
        let model = &case.model;
        let free = program(model, &start.parameters, |phase| {
            let jet = DualPoint::new(phase.in_model(model, &phase.state()));
            let mut outputs = vec![phase.scalar(&rule.function)];
            outputs.extend(jet.rates(&rule.function));
            outputs.push(phase.scalar(&rule.reaction));
            outputs
        })?;
        let touching = Model { system: System::Field(rule.contact.clone()), ..model.clone() };
        let contact =
            program(&touching, &start.parameters, |phase| vec![phase.scalar(&rule.reaction)])?;
        Ok(Self { free, contact })
    }
}

/// A motion under the constraint.
pub(crate) struct OneSidedMotion {
    pub end: Vec<DoubleDouble>,
    pub steps: u64,
    pub events: Vec<ContactEvent>,
}

/// Follows a motion from a start with r ≥ 0; `watcher` sees each piece, and the state after it.
pub(crate) fn follow<T: SeriesNumber<One = T>>(
    case: &Case,
    rule: &OneSided,
    start: &Start,
    time: DoubleDouble,
    accuracy: Accuracy,
    watcher: &mut impl Watcher<T>,
) -> Result<OneSidedMotion, FlowError> {
    if time.hi < 0.0 {
        return Err(FlowError::OneSidedBackwards);
    }
    let phases = Phases::new(case, rule, start)?;
    let mut walk = Walk::<T> {
        phases: &phases,
        free: Stepper::new(&phases.free, accuracy),
        contact: Stepper::new(&phases.contact, accuracy),
        events: Vec::new(),
        steps: 0,
        state: start.state.clone(),
        now: DoubleDouble::default(),
        until: time,
        is_held: false,
    };
    let mut touching = walk.begins_in_contact()?;
    for _ in 0..MAX_PHASES {
        let begin = walk.now;
        let ended = if touching { walk.touch(watcher)? } else { walk.fly(watcher)? };
        // A free phase that is over at once is too low to be seen.
        let lasts = (walk.now - begin).hi > PLACES * T::EPSILON * walk.now.hi.abs();
        walk.is_held = !touching && !lasts;
        if ended {
            return Ok(OneSidedMotion { end: walk.state, steps: walk.steps, events: walk.events });
        }
        touching = !touching;
    }
    Err(FlowError::TooManyPhases { time: walk.now.hi })
}

struct Walk<'p, T: SeriesNumber> {
    phases: &'p Phases,
    free: Stepper<T>,
    contact: Stepper<T>,
    events: Vec<ContactEvent>,
    steps: u64,
    state: Vec<DoubleDouble>,
    now: DoubleDouble,
    until: DoubleDouble,
    /// Whether a phase of contact begins while the reaction is negative, and lasts until it falls again.
    is_held: bool,
}

impl<T: SeriesNumber<One = T>> Walk<'_, T> {
    /// Whether the motion begins in contact: r = 0, and r would fall, or would not move while λ >
    /// 0.
    fn begins_in_contact(&mut self) -> Result<bool, FlowError> {
        self.free.start(0, &self.state, self.until);
        self.free.expand();
        self.free.ends(0);
        self.free.check(0)?;
        let piece = self.free.piece(0);
        let first = |output: usize| piece.output(output)[0].leading();
        let (r, rate, reaction) = (first(0), first(1), first(2));
        let polynomial = piece.output(0);
        let doubt = self.phases.free.rounding::<T>(0, &self.state, 0.0);
        let limit = ROUNDINGS * T::EPSILON * size(&polynomial, piece.length()) + DOUBTS * doubt;
        match r {
            r if r > limit => Ok(false),
            r if r < -limit => Err(FlowError::BehindConstraint { by: r }),
            _ if rate.abs() > limit => Ok(rate < 0.0),
            _ if size(&polynomial, piece.length()) <= limit => Ok(reaction > 0.0),
            _ => Ok(!starts_positive(&polynomial, limit, piece.length())),
        }
    }

    /// Follows a free phase. Returns whether the motion ends in it.
    fn fly(&mut self, watcher: &mut impl Watcher<T>) -> Result<bool, FlowError> {
        self.free.start(0, &self.state, self.until - self.now);
        let leaves = self.events.last().is_some_and(|event| event.kind == Contact::Leaves);
        loop {
            // A free motion has not come below 0 yet, nor have values that are 0 to rounding.
            let mut sides = Sides::on(true);
            self.free.expand();
            self.free.ends(0);
            self.free.check(0)?;
            let piece = self.free.piece(0);
            let mut polynomial = piece.output(0);
            let at = |after: T| self.now + piece.time(after);
            let doubt = || self.phases.free.rounding::<T>(0, &self.free.pairs(0), 0.0);
            // What has come below 0 without an event, as from a touch, is in contact.
            let limit = ROUNDINGS * T::EPSILON * size(&polynomial, piece.length());
            let is_below = polynomial[0].leading() < -limit - DOUBTS * doubt();
            let below = (self.free.steps(0) > 0 && is_below).then_some(T::ZERO);
            // What leaves is at 0, up to the error of the place of its contact.
            let is_at_0 = polynomial[0].leading() < 0.0 && !is_below;
            if is_at_0 || leaves && self.free.steps(0) == 0 {
                polynomial[0] = T::ZERO;
            }
            let events = sides.events(&polynomial, piece.length(), &doubt);
            let begins = below.map(|after| Event::Crossing { after, rising: false });
            for event in begins.into_iter().chain(events) {
                let after = match event {
                    Event::Crossing { rising: true, .. } => continue,
                    Event::Crossing { after, .. } | Event::Tangency { after } => after,
                };
                let kind = match is_deep(&polynomial, after, piece.length(), doubt()) {
                    true => Contact::Arrives,
                    false => Contact::Grazes,
                };
                // The tangency at which a free phase begins is not an event.
                let begins =
                    self.free.steps(0) == 0 && after.leading() < 1e-3 * piece.length().leading();
                if kind == Contact::Grazes && begins {
                    continue;
                }
                let (time, state) = (at(after), piece.state(after));
                self.events.push(ContactEvent { kind, time, state: state.clone() });
                if kind == Contact::Arrives {
                    watcher.piece(self.now + piece.begin(), &piece, after);
                    self.steps += self.free.steps(0) + 1;
                    (self.now, self.state) = (time, state);
                    watcher.state(self.now, &self.state);
                    return Ok(false);
                }
            }
            watcher.piece(self.now + piece.begin(), &piece, piece.length());
            self.free.advance();
            watcher.state(self.now + self.free.time(0), &self.free.pairs(0));
            if self.free.is_done(0) {
                self.steps += self.free.steps(0);
                (self.now, self.state) = (self.until, self.free.pairs(0));
                return Ok(true);
            }
        }
    }

    /// Follows a phase of contact. Returns whether the motion ends in it.
    fn touch(&mut self, watcher: &mut impl Watcher<T>) -> Result<bool, FlowError> {
        self.contact.start(0, &self.state, self.until - self.now);
        let mut is_held = self.is_held;
        loop {
            let mut sides = Sides::on(!is_held);
            self.contact.expand();
            self.contact.ends(0);
            self.contact.check(0)?;
            let piece = self.contact.piece(0);
            let polynomial = piece.output(0);
            let doubt = || self.phases.contact.rounding::<T>(0, &self.contact.pairs(0), 0.0);
            let is_below = !is_held && polynomial[0].leading() < -DOUBTS * doubt();
            let below = is_below.then_some(T::ZERO);
            let events = sides.events(&polynomial, piece.length(), &doubt);
            let begins = below.map(|after| Event::Crossing { after, rising: false });
            for event in begins.into_iter().chain(events) {
                is_held &= !matches!(event, Event::Crossing { rising: true, .. });
                let Event::Crossing { after, rising: false } = event else { continue };
                // A reaction that only touches 0 holds the body.
                if !is_deep(&polynomial, after, piece.length(), doubt()) {
                    continue;
                }
                watcher.piece(self.now + piece.begin(), &piece, after);
                (self.now, self.state) = (self.now + piece.time(after), piece.state(after));
                let (time, state) = (self.now, self.state.clone());
                self.events.push(ContactEvent { kind: Contact::Leaves, time, state });
                self.steps += self.contact.steps(0) + 1;
                watcher.state(self.now, &self.state);
                return Ok(false);
            }
            watcher.piece(self.now + piece.begin(), &piece, piece.length());
            self.contact.advance();
            watcher.state(self.now + self.contact.time(0), &self.contact.pairs(0));
            if self.contact.is_done(0) {
                self.steps += self.contact.steps(0);
                (self.now, self.state) = (self.until, self.contact.pairs(0));
                return Ok(true);
            }
        }
    }
}

/// Whether the function falls below 0 behind this root by more than rounding, before the end of the
/// piece or where it rises again.
fn is_deep<T: SeriesNumber<One = T>>(polynomial: &[T], root: T, length: T, doubt: f64) -> bool {
    let limit = ROUNDINGS * T::EPSILON * size(polynomial, length) + DOUBTS * doubt;
    let rest = length - root;
    // With slope s and curvature c the minimum is −s²/2c, which may be nearer than the samples.
    let rate = slope(polynomial);
    let (fall, curvature) = value(&rate, root);
    let depth = fall.leading() * fall.leading() / (2.0 * curvature.leading().abs());
    if fall.leading() < 0.0 && depth > limit {
        return true;
    }
    let samples = (1..=SAMPLES).map(|k| T::float(f64::from(k) / f64::from(SAMPLES)));
    let values = samples.map(|share| value(polynomial, root + share * rest).0.leading());
    values.take_while(|value| *value <= limit).any(|value| value < -limit)
}
