//! Formulas of a system that have to have values where its motions go.
//!
//! The recorded field may do without an operation that is written: x²/x is recorded as x, which goes on
//! through x = 0, and 0·ln x as 0. A motion ends where such an operation has no value, and none starts
//! there, and the same holds of quotients x²/x that are recorded as they are, and whose series cancel.
//! At a start without a value the formula as written is named, whatever became of it.

use std::sync::Arc;

use crate::taylor::event::{Event, Sides, extremum, size, turns, value};
use crate::taylor::number::SeriesNumber;
use crate::taylor::quotients::Needed;
use crate::taylor::shorten::known_part;
use crate::taylor::stepper::Stepper;
use liouville::graph::{Evaluator, Expr, Graph, Step, Tape};
use liouville::mechanics::{Model, Phase};
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use liouville::number::{BinaryOperation, UnaryFunction};

/// Formulas of a system as written, each with the values that have to exist.
pub(crate) type Written = Vec<(String, Vec<Expr>)>;

/// Records the formulas of a system and of its parameters as written; those that have values
/// everywhere are left out.
pub(crate) fn written(phase: &Phase<'_, Expr>) -> Written {
    let model = phase.model();
    let own = model.equations_of_motion();
    let formulas = model.parameter_formulas_of(&own).into_iter().chain(own);
    let known = formulas.filter(|formula| !model.has_antiderivative(formula));
    let all = known.map(|f| (f.text().trim().to_string(), phase.literal_values([f])));
    all.filter(|(_, values)| !values.is_empty()).collect()
}

/// Size of an argument from which on it may overflow before it comes to 0.
const LARGE: f64 = 1e200;

/// Part of its largest size below which a divisor may be 0 up to rounding.
const LOW: f64 = 1e-6;

/// Values of an argument at which an operation exists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Domain {
    Nonzero,
    Positive,
    NotNegative,
}

impl Domain {
    /// Domain of an operation that does not exist everywhere, and the place of its argument.
    pub(crate) fn of(step: Step<'_>) -> Option<(Self, usize)> {
        match step {
            Step::Unary(UnaryFunction::Recip, a) => Some((Domain::Nonzero, a)),
            Step::Unary(UnaryFunction::Sqrt, a) => Some((Domain::NotNegative, a)),
            Step::Unary(UnaryFunction::Ln, a) | Step::Binary(BinaryOperation::Pow, a, _) => {
                Some((Domain::Positive, a))
            }
            Step::Power(a, exponent) => {
                let is_whole = exponent.to_integer().is_some();
                Some(match (is_whole, exponent.is_negative()) {
                    (true, false) => return None,
                    (true, true) => (Domain::Nonzero, a),
                    (false, true) => (Domain::Positive, a),
                    (false, false) => (Domain::NotNegative, a),
                })
            }
            _ => None,
        }
    }

    pub(crate) fn contains(self, argument: f64) -> bool {
        match self {
            Domain::Nonzero => argument != 0.0,
            Domain::Positive => argument > 0.0,
            Domain::NotNegative => argument >= 0.0,
        }
    }

    /// Time within a piece at which the argument leaves the domain, 0 if it is outside from the
    /// beginning on.
    fn left_after<T: SeriesNumber<One = T>>(self, argument: &[T], length: T) -> Option<T> {
        let first = argument[0].leading();
        let is_inside = match self {
            Domain::Nonzero => first != 0.0 && !first.is_nan(),
            Domain::Positive => first > 0.0,
            Domain::NotNegative => first > 0.0 || first == 0.0 && !falls(argument, length),
        };
        if !is_inside {
            return Some(T::ZERO);
        }
        if argument.iter().all(|term| term.leading() == 0.0) {
            return None;
        }
        let ends = |event: Event<T>| match event {
            Event::Tangency { .. } if self == Domain::NotNegative => None,
            Event::Crossing { .. }
                if self == Domain::NotNegative && !is_below(argument, length) =>
            {
                None
            }
            Event::Tangency { after } | Event::Crossing { after, .. } => Some(after),
        };
        let mut sides = Sides::on(first >= 0.0);
        sides.events(argument, length, &|| 0.0).into_iter().find_map(ends)
    }
}

/// Whether a function is below 0 by more than rounding somewhere on a piece, as far as samples show; what
/// touches 0 at the end is not.
fn is_below<T: SeriesNumber<One = T>>(argument: &[T], length: T) -> bool {
    const SAMPLES: i32 = 32;
    const ROUNDINGS: f64 = 256.0;
    let limit = ROUNDINGS * T::EPSILON * size(argument, length);
    let at = |k: i32| length * T::float(f64::from(k) / f64::from(SAMPLES));
    (1..=SAMPLES).any(|k| value(argument, at(k)).0.leading() < -limit)
}

/// Whether a function that begins at 0 is negative next.
fn falls<T: SeriesNumber>(argument: &[T], length: T) -> bool {
    let leaves = argument.iter().enumerate().find(|(_, term)| term.leading() != 0.0);
    leaves.is_some_and(|(n, term)| {
        let forwards = length.leading() > 0.0 || n.is_multiple_of(2);
        (term.leading() > 0.0) != forwards
    })
}

/// An operation that has no value from somewhere on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Edge {
    /// An operation that is written, and that the field does without, by its index.
    Watched(usize),
    /// A quotient of the field.
    Divisor,
    /// A jump of the field towards which it pushes from both sides.
    Slide,
    /// A modulus whose argument is 0, by the index of its sign: there the motion goes on.
    Sign(usize),
}

impl Edge {
    /// The same where it ends a motion.
    pub(crate) fn ends(self) -> Option<Self> {
        (!matches!(self, Edge::Sign(_))).then_some(self)
    }
}

/// An operation that is written, and that the field does without.
#[derive(Clone, Copy, Debug)]
struct Watched {
    domain: Domain,
    /// Index of the formula that it is written in.
    formula: usize,
}

/// Values that a motion has to have.
#[derive(Clone, Debug)]
pub(crate) struct Presence {
    /// Names of the components of the state.
    names: Vec<String>,
    formulas: Vec<String>,
    /// Values of the formulas as written, and where those of each formula end.
    tape: Tape,
    ends: Vec<usize>,
    /// Operations whose arguments are the last further functions of the program.
    watched: Vec<Watched>,
}

impl Presence {
    /// Lists the values that have to exist along the motions of a field; returns the arguments to be
    /// watched too.
    pub fn new(
        model: &Model,
        graph: &Graph,
        field: &[Expr],
        written: Written,
    ) -> (Arc<Self>, Vec<Expr>) {
        let (formulas, values): (Vec<String>, Vec<Vec<Expr>>) = written.into_iter().unzip();
        let all = values.concat();
        let reached: Vec<Vec<bool>> =
            values.iter().map(|own| graph.reached(own.iter().copied())).collect();
        let (mut watched, mut arguments) = (Vec::new(), Vec::new());
        let places: Vec<usize> = all.iter().map(|value| graph.place(*value)).collect();
        // Quotients with limits have values where their divisors are 0.
        let needed = Needed::exactly(graph, &places).places;
        for operation in graph.left_out(field, &all) {
            let place = graph.place(operation);
            if !needed[place] {
                continue;
            }
            let formula = reached.iter().position(|reached| reached[place]);
            if let (Some(formula), Some((domain, argument))) =
                (formula, Domain::of(graph.step(place)))
            {
                watched.push(Watched { domain, formula });
                arguments.push(graph.at(argument));
            }
        }
        // x/√x is followed as √x, also where x is 0 for a while.
        for place in 0..graph.len() {
            let formula = reached.iter().position(|reached| reached[place]);
            if let (Some(formula), Some(base)) = (formula, root_of_modulus(graph, place)) {
                watched.push(Watched { domain: Domain::Positive, formula });
                arguments.push(graph.at(base));
            }
        }
        let ends = values.iter().scan(0, |end, own| {
            *end += own.len();
            Some(*end)
        });
        let presence = Self {
            names: (0..model.dimension()).map(|k| model.component_name(k)).collect(),
            formulas,
            ends: ends.collect(),
            tape: Tape::new(graph, &all),
            watched,
        };
        (Arc::new(presence), arguments)
    }

    /// Formula without a value at a state, if there is one.
    pub fn missing(&self, state: &[DoubleDouble]) -> Option<&str> {
        let mut evaluator = Evaluator::new(&self.tape, DoubleDoubles);
        evaluator.run(state);
        let place = evaluator.outputs().position(|value| !value.is_finite())?;
        Some(&self.formulas[self.ends.partition_point(|end| *end <= place)])
    }

    /// Formula of a watched operation.
    pub fn formula(&self, watched: usize) -> &str {
        &self.formulas[self.watched[watched].formula]
    }

    /// The state of the system, without further components, in words.
    pub fn place(&self, state: &[DoubleDouble]) -> String {
        let parts = self.names.iter().zip(state).map(|(name, x)| format!("{name} = {:?}", x.hi));
        parts.collect::<Vec<_>>().join(", ")
    }

    /// Number of components of the system's state.
    pub fn dimension(&self) -> usize {
        self.names.len()
    }
}

/// Base of the root that the step at a place divides by, if it contains a modulus.
fn root_of_modulus(graph: &Graph, place: usize) -> Option<usize> {
    let Step::Unary(UnaryFunction::Recip, root) = graph.step(place) else { return None };
    let Step::Unary(UnaryFunction::Sqrt, base) = graph.step(root) else { return None };
    let parts = graph.reached_from(&[base]);
    let is_modulus = |place: usize| matches!(graph.step(place), Step::Unary(UnaryFunction::Abs, _));
    (0..graph.len()).any(|place| parts[place] && is_modulus(place)).then_some(base)
}

/// Time within a piece at which a divisor that does not change its sign comes as near to 0 as it may be
/// wrong by.
fn touches<One: SeriesNumber<One = One>>(
    divisor: &[One],
    length: One,
    doubt: impl Fn() -> f64,
) -> Option<One> {
    let (first, last) = (divisor[1].leading(), value(divisor, length).1.leading());
    if !turns(first, last, length.leading(), divisor[0].leading() > 0.0) {
        return None;
    }
    let after = extremum(divisor, length);
    (value(divisor, after).0.leading().abs() <= doubt()).then_some(after)
}

/// Lanes in which a polynomial may vanish within a step, by the sizes of its terms.
pub(crate) fn may_vanish<T: SeriesNumber>(polynomial: &[T], steps: T) -> impl Fn(usize) -> bool {
    let size = T::ZERO.larger(steps);
    let (mut power, mut rest) = (T::ONE, T::ZERO);
    for coefficient in &polynomial[1..] {
        power = power * size;
        rest = rest + T::ZERO.larger(*coefficient * power);
    }
    let first = T::ZERO.larger(polynomial[0]);
    move |lane| {
        let [first, rest] = [first, rest].map(|x| x.lane(lane).leading());
        // Where a coefficient is not finite the step is of no account.
        first <= rest && rest.is_finite()
    }
}

impl<T: SeriesNumber> Stepper<T> {
    /// Cuts steps where a quotient ceases to have a value. Near a pole steps are short anyway; but
    /// in x²/x the series of 1/x cancels, and steps go on through 0.
    pub(crate) fn keep_quotients(&mut self) {
        let steps = T::from_lanes(|lane| self.lanes[lane].step);
        for ((row, divisor), height) in self.series.divisors().zip(&mut self.heights) {
            *height = height.larger(divisor[0]);
            let may_vanish = may_vanish(divisor, steps);
            for (place, lane) in self.lanes.iter_mut().enumerate() {
                let low = LOW * height.lane(place).leading();
                let is_low = divisor[0].lane(place).leading().abs() < low;
                let is_large = divisor[0].lane(place).leading().abs() >= LARGE;
                if is_large || !is_low && !may_vanish(place) {
                    continue;
                }
                let argument: Vec<T::One> = divisor.iter().map(|x| x.lane(place)).collect();
                // Beyond where it is known, a polynomial has zeros that the divisor has not.
                lane.step = known_part(&argument, lane.step, self.kappa);
                let vanishes = Domain::Nonzero.left_after(&argument, lane.step);
                let doubt = || self.series.value_error(row, place, &self.peaks);
                let touch = || touches(&argument, lane.step, doubt);
                if let Some(after) = vanishes.or_else(|| touch().filter(|_| is_low)) {
                    lane.step = after;
                    lane.edge = Some((Edge::Divisor, after));
                }
            }
        }
    }

    /// Cuts steps where an operation that is written ceases to have a value.
    pub(crate) fn keep_values(&mut self) {
        let Some(presence) = self.presence.clone() else { return };
        let count = presence.watched.len();
        let first = self.series.outputs() - count;
        for index in 0..count {
            self.ends_of(first + index, |argument| argument.abs() < LARGE);
        }
        for (index, watched) in presence.watched.iter().enumerate() {
            for place in 0..T::LANES {
                let argument = self.series.output(first + index).iter();
                let argument: Vec<T::One> = argument.map(|x| x.lane(place)).collect();
                let value = argument[0].leading();
                if value.abs() >= LARGE && watched.domain.contains(value) {
                    continue;
                }
                let lane = &mut self.lanes[place];
                if let Some(after) = watched.domain.left_after(&argument, lane.step) {
                    lane.step = after;
                    lane.edge = Some((Edge::Watched(index), after));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_leave_their_domains() {
        let falling = [0.5, -1.0];
        for domain in [Domain::Nonzero, Domain::Positive, Domain::NotNegative] {
            let after = domain.left_after(&falling, 1.0).expect("through 0 at 0.5");
            assert!((after - 0.5).abs() < 1e-15, "{domain:?}");
            assert_eq!(domain.left_after(&falling, 0.4), None, "{domain:?}: not yet");
            assert_eq!(domain.left_after(&falling, -1.0), None, "{domain:?}: backwards");
            assert_eq!(domain.left_after(&[f64::NAN, 1.0], 1.0), Some(0.0), "{domain:?}");
        }
    }

    #[test]
    fn what_cannot_vanish_is_seen_by_its_terms() {
        assert!(!may_vanish(&[1.0, 0.5, 0.25], 1.0)(0) && may_vanish(&[1.0, -0.5, 0.5], 1.0)(0));
        assert!(!may_vanish(&[1.0, 0.5, 0.25], -1.0)(0) && may_vanish(&[0.0, 1.0], 0.1)(0));
    }

    #[test]
    fn a_root_may_touch_0_and_a_quotient_may_not() {
        let touching = [0.25, -1.0, 1.0];
        assert_eq!(Domain::NotNegative.left_after(&touching, 1.0), None);
        for domain in [Domain::Nonzero, Domain::Positive] {
            let after = domain.left_after(&touching, 1.0).expect("touches at 0.5");
            assert!((after - 0.5).abs() < 1e-7, "{domain:?}");
        }
        assert_eq!(
            Domain::Nonzero.left_after(&[-1.0, 0.5], 1.0),
            None,
            "below 0 is outside of none"
        );
        assert_eq!(Domain::Positive.left_after(&[-1.0, 0.5], 1.0), Some(0.0));
    }

    #[test]
    fn what_begins_at_0_may_go_up() {
        for (argument, length, stays) in [
            ([0.0, 1.0], 1.0, true),
            ([0.0, -1.0], 1.0, false),
            ([0.0, 1.0], -1.0, false),
            ([0.0, -1.0], -1.0, true),
            ([0.0, 0.0], 1.0, true),
        ] {
            let left = Domain::NotNegative.left_after(&argument, length);
            assert_eq!(left.is_none(), stays, "{argument:?} {length}");
            assert_eq!(Domain::Nonzero.left_after(&argument, length), Some(0.0));
        }
    }
}
