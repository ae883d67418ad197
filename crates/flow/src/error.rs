//! Reasons why a motion cannot be computed.

mod ends;

use ends::{
    endless, overflow, runs_away, shrinking, singular, slides, stopped_at, too_short, without_value,
};
use liouville::graph::Fault;
use serde::{Deserialize, Serialize};

/// Number of steps that no motion takes.
pub(super) const MOST_STEPS: f64 = 1e10;

/// Reason why a motion cannot be computed.
///
/// Those of single motions can be written to a record and read back; the motion that was stopped
/// cannot, and those of the equations of all motions.
#[derive(Clone, Debug, PartialEq, thiserror::Error, Serialize, Deserialize)]
pub enum FlowError {
    /// A proof about a field with a function that has no Taylor series.
    #[error(
        "the field contains |x|, sign, max or min, which have no Taylor series where they change their sign"
    )]
    #[serde(skip)]
    NotAnalytic,
    /// The field contains an antiderivative, whose value is not known.
    #[error("the field contains ∫, whose value is not determined")]
    Antiderivative,
    /// The steps become too small, or values become infinite or undefined.
    #[error("{}", singular(*time, state))]
    Singular {
        /// Time of the last state.
        #[serde(with = "crate::record")]
        time: f64,
        /// Last state.
        #[serde(with = "crate::record")]
        state: Vec<f64>,
    },
    /// The motion goes to infinity in finite time.
    #[error("{}", runs_away(*time, state))]
    RunsAway {
        /// Time of the last state.
        #[serde(with = "crate::record")]
        time: f64,
        /// Last state.
        #[serde(with = "crate::record")]
        state: Vec<f64>,
    },
    /// The field jumps, and pushes towards the jump from both sides.
    #[error("{}", slides(*time, state))]
    Slides {
        /// Time of the last state.
        #[serde(with = "crate::record")]
        time: f64,
        /// Last state.
        #[serde(with = "crate::record")]
        state: Vec<f64>,
    },
    /// Tangent vectors are wanted along motions through jumps of the field.
    #[error(
        "the field jumps where the argument of a sign is 0, and with it tangent vectors would: exponents and \
         multipliers are known for continuous fields alone"
    )]
    Jumps,
    /// The steps become too small, with no sign of a singularity.
    #[error("{}", too_short(*time, state))]
    TooShort {
        /// Time of the last state.
        #[serde(with = "crate::record")]
        time: f64,
        /// Last state.
        #[serde(with = "crate::record")]
        state: Vec<f64>,
    },
    /// A formula of the system has no value where the motion starts, or where it comes to.
    #[error("{}", without_value(formula, *time, place))]
    NoValue {
        /// Formula as written.
        formula: String,
        /// Time from which on it has no value.
        #[serde(with = "crate::record")]
        time: f64,
        /// State there, in words.
        place: String,
    },
    /// A number is beyond the range of f64.
    #[error("{}", overflow(*.0))]
    Overflow(#[serde(with = "crate::record")] f64),
    /// A value that was asked for does not exist at a state of the motion.
    #[error("`{column}` has no value at a state of the motion, or one too large for f64")]
    #[serde(skip)]
    NoColumnValue {
        /// Formula of the value.
        #[serde(skip)]
        column: String,
    },
    /// The steps have shrunk, and become so many that the end is out of reach.
    #[error("{}", shrinking(*time, [*step, *rest, *grown], state))]
    Shrinking {
        /// Time of the last state.
        #[serde(with = "crate::record")]
        time: f64,
        /// Last step.
        #[serde(with = "crate::record")]
        step: f64,
        /// Number of steps that are left.
        #[serde(with = "crate::record")]
        rest: f64,
        /// Largest size of the state, relative to that at the start.
        #[serde(with = "crate::record")]
        grown: f64,
        /// Last state.
        #[serde(with = "crate::record")]
        state: Vec<f64>,
    },
    /// The time takes too many steps.
    #[error("{}", endless(*time, *step, *until))]
    Endless {
        /// Time of the last state.
        #[serde(with = "crate::record")]
        time: f64,
        /// Last step.
        #[serde(with = "crate::record")]
        step: f64,
        /// Time at which the motion would end.
        #[serde(with = "crate::record")]
        until: f64,
    },
    /// The section uses variables that this system does not have.
    #[error(
        "without --section, a section is in the variables (l, L/G): these are for a body that rolls without \
         spinning, with the state ω, γ alone"
    )]
    NoAndoyer,
    /// The case has no section.
    #[error("the case has no [section]")]
    NoSection,
    /// The system has an arbitrary function, so that no single motion is determined.
    #[error("the shape or the potential is arbitrary, so that no one motion is its own")]
    Arbitrary,
    /// A system that has no motions in time.
    #[error("the case is a map, and this is for motions in time")]
    Discrete,
    /// The point does not lie on the sphere.
    #[error("(l, L/G) = ({l}, {z}) is not a point of the section: |L/G| has to be below 1")]
    OffSphere {
        /// Coordinate l.
        #[serde(with = "crate::record")]
        l: f64,
        /// Coordinate L/G.
        #[serde(with = "crate::record")]
        z: f64,
    },
    /// The energy is not above the potential at the start.
    #[error(
        "over (l, L/G) = ({l:.6}, {z:.6}) the potential is {potential:.6}, at or above the energy {energy}"
    )]
    BelowPotential {
        /// Coordinate l.
        #[serde(with = "crate::record")]
        l: f64,
        /// Coordinate L/G.
        #[serde(with = "crate::record")]
        z: f64,
        /// Potential at the start.
        #[serde(with = "crate::record")]
        potential: f64,
        /// Energy of the section.
        #[serde(with = "crate::record")]
        energy: f64,
    },
    /// The motion does not return to the section.
    #[error("{}", never_crossed(*time, *crossings, *others))]
    NeverCrossed {
        /// Time up to which the motion was followed.
        #[serde(with = "crate::record")]
        time: f64,
        /// Number of crossings found.
        crossings: usize,
        /// Number of crossings in the direction that does not count.
        others: usize,
    },
    /// A formula of the section has no value from some point of the motion on, or the motion ends there.
    #[error(
        "a formula of the section cannot be followed beyond t = {time:.6} of the motion: it has no value there, jumps, or is 0 to a high order"
    )]
    SectionEnds {
        /// Time of the last value.
        #[serde(with = "crate::record")]
        time: f64,
    },
    /// The level set is a point.
    #[error("the level set has dimension 0, so that nothing moves on it")]
    NoTangents,
    /// The motion stands still.
    #[error("the start is an equilibrium: the motion stays there")]
    AtRest,
    /// The motion stays in the surface.
    #[error("the motion stays in the surface, and does not cross it")]
    InSurface,
    /// The system has no energy.
    #[error("the system has no energy, so that none can be given")]
    NoEnergy,
    /// No state with the values requested was found.
    #[error("no state on the surface was found with {0}")]
    NoPoint(String),
    /// The case has no such claim, or it is not about a formula.
    #[error("the case has no claim `{0}` about a formula")]
    NoSuchClaim(String),
    /// A motion under a one-sided constraint does not determine its past.
    #[error("a motion with a one-sided constraint cannot be followed backwards")]
    OneSidedBackwards,
    /// Motions under a one-sided constraint, where only the field is followed.
    #[error("the case has a one-sided constraint, which single orbits keep alone")]
    OneSided,
    /// The start violates the one-sided constraint.
    #[error("the start violates the one-sided constraint: its function is {by:e} there")]
    BehindConstraint {
        /// Value of r, which must not be negative.
        #[serde(with = "crate::record")]
        by: f64,
    },
    /// Contact and free motion alternate without end.
    #[error("contact and free motion alternate without end near t = {time}")]
    TooManyPhases {
        /// Time near which the phases accumulate.
        #[serde(with = "crate::record")]
        time: f64,
    },
    /// Newton's method does not converge.
    #[error("no point of period {period} was found near (l, L/G) = ({l}, {z})")]
    NoPeriodicPoint {
        /// Coordinate l.
        #[serde(with = "crate::record")]
        l: f64,
        /// Coordinate L/G.
        #[serde(with = "crate::record")]
        z: f64,
        /// Period, in crossings of the section.
        period: usize,
    },
    /// Newton's method for a closed orbit does not converge.
    #[error("no closed orbit was found near the start, with a period near {0}")]
    NoClosedOrbit(#[serde(with = "crate::record")] f64),
    /// Time is a variable of the state.
    #[error("no motion closes: `t` is a variable of rate 1 here, and grows")]
    NeverCloses,
    /// Newton's method leaves a distance at which there need be no closed orbit.
    #[error(
        "the motion is back after t = {0} to {1:.1e} only, and Newton's method does not come nearer: there may be no closed orbit, or one with a multiplier near 1"
    )]
    NearReturn(#[serde(with = "crate::record")] f64, #[serde(with = "crate::record")] f64),
    /// The equations of a closed orbit are singular.
    #[error(
        "the equations of a closed orbit near t = {0} are degenerate: it is one of a family, such as those of a further integral, or has another multiplier 1, or there is none"
    )]
    Degenerate(#[serde(with = "crate::record")] f64),
    /// The equations of a closed orbit are singular because of coordinates that occur nowhere.
    #[error(
        "the equations of a closed orbit near t = {time} are degenerate: no rate depends on {names}, so that an orbit comes with all those shifted along, or closes only up to a shift"
    )]
    Cyclic {
        /// Period that was tried.
        #[serde(with = "crate::record")]
        time: f64,
        /// Names of the coordinates.
        names: String,
    },
    /// A line is not that of a reversor.
    #[error(
        "{line} is no line of a reversor of this section: mirrored about it, the image of (l, L/G) = ({l:.4}, {z:.4}) comes back {by:.1e} away"
    )]
    #[serde(skip)]
    NoReversor {
        /// Name of the line.
        #[serde(skip)]
        line: &'static str,
        /// Coordinate l.
        l: f64,
        /// Coordinate L/G.
        z: f64,
        /// Distance.
        by: f64,
    },
    /// The quantity that varies along a branch of closed orbits begins outside its range.
    #[error("what varies is {value} at the start, outside the range from {from} to {to}")]
    OutsideRange {
        /// Value at the start.
        #[serde(with = "crate::record")]
        value: f64,
        /// Lower end.
        #[serde(with = "crate::record")]
        from: f64,
        /// Upper end.
        #[serde(with = "crate::record")]
        to: f64,
    },
    /// The energy changes along the motion.
    #[error("the energy changes along the motion, so that closed orbits have no energy to vary")]
    EnergyChanges,
    /// The point has no separatrices.
    #[error("the periodic point ({l:.6}, {z:.6}) is not hyperbolic but of kind: {kind}")]
    #[serde(skip)]
    NotHyperbolic {
        /// Coordinate l.
        #[serde(with = "crate::record")]
        l: f64,
        /// Coordinate L/G.
        #[serde(with = "crate::record")]
        z: f64,
        /// Kind of the periodic point.
        #[serde(skip)]
        kind: &'static str,
    },
    /// The field has a sum of more terms than a proof allows for.
    #[error("the field has a sum of more than a thousand terms")]
    TooLong,
    /// The motion was stopped from outside.
    #[error("the motion was stopped")]
    #[serde(skip)]
    Stopped,
    /// A single motion was stopped from outside.
    #[error("{}", stopped_at(*time, state))]
    #[serde(skip)]
    StoppedAt {
        /// Time that was reached.
        time: f64,
        /// State at that time.
        state: Vec<f64>,
    },
    /// No state on the level set was found.
    #[error("no state on the level set was found near the one that was asked for")]
    NoStart,
    /// No state with a value of the energy, or of an integral, was found.
    #[error(
        "no state with {name} = {value} was found near the start; drawn states have values from {low} \
         to {high}"
    )]
    NoValueState {
        /// Name of the function.
        name: String,
        /// Value that is wanted.
        value: String,
        /// Least value at some drawn states.
        low: String,
        /// Greatest value at them.
        high: String,
    },
    /// The equations cannot be recorded.
    #[error("{0}")]
    #[serde(skip)]
    Recording(#[from] Fault),
}

/// A time with five figures.
fn rounded(time: f64) -> String {
    match (1e-3..1e5).contains(&time.abs()) {
        true => format!("{time:.1}"),
        false => format!("{time:.4e}"),
    }
}

fn never_crossed(time: f64, crossings: usize, others: usize) -> String {
    let others = match others {
        0 => String::new(),
        1 => "; it is crossed once in the direction that does not count".to_string(),
        count => format!("; it is crossed {count} times in the direction that does not count"),
    };
    let crossed = match crossings {
        0 => "the motion never crosses the section".to_string(),
        1 => "the motion does not cross the section again after 1 crossing".to_string(),
        _ => format!("the motion does not cross the section again after {crossings} crossings"),
    };
    format!("{crossed}, up to t = {}{others}", rounded(time))
}
