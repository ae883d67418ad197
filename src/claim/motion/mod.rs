//! Claims about motion: long orbits, periodic points and limits of orbits.
//!
//! They have no residual that could be proved to vanish, but are observed: confirmed or refuted by
//! numbers with errors. Closed orbits and horseshoes are proved. Each kind is one file that defines
//! the claim; `observe` measures.

mod beginning;
mod closed_orbit;
mod confined;
mod contacts;
mod exponent;
mod horseshoe;
mod limit_cycle;
mod limit_of_motion;
mod mean_divergence;
mod neighbourhood;
mod periodic_point;
mod reaches;
mod stated;

use super::kinds::statements;
use super::{Reader, ValueShape};
use crate::formula::{Formula, Type};

pub use beginning::Beginning;
pub use closed_orbit::{Change, ClosedOrbit};
pub use confined::{Confined, SectionCoordinate};
pub use contacts::{Contacts, Touch};
pub use exponent::{Exponent, Growth};
pub use horseshoe::Horseshoe;
pub use limit_cycle::LimitCycle;
pub use limit_of_motion::LimitOfMotion;
pub use mean_divergence::{MeanDivergence, Tendency};
pub use neighbourhood::Neighbourhood;
pub use periodic_point::{PeriodicPoint, Stability};
pub use reaches::Reaches;
pub use stated::Stated;

/// A kind of claim about motion, with its syntax.
pub trait Motional: Clone {
    /// Key in case files, and name in reports.
    const NAME: &'static str;
    /// Keys that may accompany the statement.
    const COMPANIONS: &'static [&'static str];
    /// Those of its keys whose values are more than a text.
    const SHAPES: &'static [(&'static str, ValueShape)] =
        &[("start", ValueShape::List), ("state", ValueShape::ListOrTable)];

    /// Reads the statement.
    fn read<R: Reader>(from: &R) -> Result<Self, R::Error>;

    /// Returns the start of the motion.
    fn beginning(&self) -> &Beginning;

    /// Returns the statement in a few words.
    fn text(&self) -> String;
}

statements! {
    /// A claimed statement about motions, by kind.
    MotionKind,
    /// Keys of the statements that a claim about motion can make.
    MOTIONS,
    Exponent,
    MeanDivergence,
    PeriodicPoint,
    LimitCycle,
    Confined,
    LimitOfMotion,
    Contacts,
    ClosedOrbit,
    Horseshoe,
    Reaches,
}

/// Evaluates an expression for the statement of any kind.
macro_rules! of_each {
    ($self:expr, $statement:ident => $result:expr) => {
        match $self {
            MotionKind::Exponent($statement) => $result,
            MotionKind::MeanDivergence($statement) => $result,
            MotionKind::PeriodicPoint($statement) => $result,
            MotionKind::LimitCycle($statement) => $result,
            MotionKind::Confined($statement) => $result,
            MotionKind::LimitOfMotion($statement) => $result,
            MotionKind::Contacts($statement) => $result,
            MotionKind::ClosedOrbit($statement) => $result,
            MotionKind::Horseshoe($statement) => $result,
            MotionKind::Reaches($statement) => $result,
        }
    };
}

impl MotionKind {
    /// Returns the start of the motion.
    pub fn beginning(&self) -> &Beginning {
        of_each!(self, claim => claim.beginning())
    }

    /// Returns the statement in a few words.
    pub fn text(&self) -> String {
        of_each!(self, claim => claim.text())
    }
}

/// Reads the number of a key.
fn number<R: Reader>(from: &R, key: &'static str) -> Result<Option<Stated>, R::Error> {
    let Some(text) = from.text(key)? else { return Ok(None) };
    stated(from, key, &text).map(Some)
}

/// Reads the number of a required key.
fn required_number<R: Reader>(from: &R, key: &'static str) -> Result<Stated, R::Error> {
    number(from, key)?.ok_or_else(|| from.missing(key))
}

/// Reads the period of a closed orbit.
fn period<R: Reader>(from: &R, key: &'static str, remedy: &str) -> Result<Stated, R::Error> {
    let period = required_number(from, key)?;
    if period.value <= 0.0 || !period.value.is_finite() {
        let message = format!("a closed orbit does not have the period {}", period.text);
        return Err(from.complaint(key, message, remedy));
    }
    if period.text.contains('±') {
        let message =
            format!("`{}` has an error, and a period that is proved has digits", period.text);
        return Err(from.complaint(key, message, "write as many digits as are known"));
    }
    Ok(period)
}

/// Reads the integrals that hold an orbit besides the level functions and the energy.
fn integrals<R: Reader>(from: &R) -> Result<Vec<Formula>, R::Error> {
    let integrals = from.list("integrals")?.unwrap_or_default();
    if integrals.iter().any(|formula| formula.value_type() != Type::Scalar) {
        let message = "an integral that holds an orbit is a scalar".to_string();
        return Err(from.complaint("integrals", message, "list the components one by one"));
    }
    Ok(integrals)
}

fn stated<R: Reader>(from: &R, key: &'static str, text: &str) -> Result<Stated, R::Error> {
    Stated::parse(text).ok_or_else(|| {
        let message = format!("`{text}` is not a number");
        from.complaint(key, message, "write 1.234, 3/7, π/2, or \"0.035 ± 0.003\"")
    })
}

/// Reads the point [l, L/G] of a key.
fn point<R: Reader>(from: &R, key: &'static str) -> Result<Option<[Stated; 2]>, R::Error> {
    let Some(texts) = from.texts(key)? else { return Ok(None) };
    let numbers =
        texts.iter().map(|text| stated(from, key, text)).collect::<Result<Vec<_>, _>>()?;
    let count = numbers.len();
    <[Stated; 2]>::try_from(numbers).map(Some).map_err(|_| {
        let message = format!("a point of the section has two coordinates, not {count}");
        from.complaint(key, message, "write [l, L/G]")
    })
}

/// Largest number of crossings, and largest length of a cycle.
const MOST_CROSSINGS: usize = 1_000_000_000;

/// Reads an integer, not less than `least`.
fn count<R: Reader>(from: &R, key: &'static str, least: usize) -> Result<Option<usize>, R::Error> {
    let Some(text) = from.text(key)? else { return Ok(None) };
    match text.parse() {
        Ok(count) if (least..=MOST_CROSSINGS).contains(&count) => Ok(Some(count)),
        Ok(count) if count > MOST_CROSSINGS => {
            let message = format!("`{text}` is too large");
            Err(from.complaint(key, message, &format!("write a number up to {MOST_CROSSINGS}")))
        }
        _ => {
            let [first, second, third] = [0, 1, 2].map(|more| least + more);
            let remedy = format!("write {first}, {second}, {third}, …");
            Err(from.complaint(key, format!("`{text}` is not a count"), &remedy))
        }
    }
}

/// Reads the length of the motion, a positive time.
fn time<R: Reader>(from: &R) -> Result<f64, R::Error> {
    let time = required_number(from, "time")?;
    match time.value > 0.0 && time.value.is_finite() {
        true => without_error(from, "time", &time).map(|()| time.value),
        false => {
            let message = format!("a motion cannot be followed for the time {}", time.text);
            Err(from.complaint("time", message, "write a positive number"))
        }
    }
}

/// Refuses an error of a number that is taken as it is written.
fn without_error<R: Reader>(from: &R, key: &'static str, read: &Stated) -> Result<(), R::Error> {
    let Some((number, _)) = read.text.split_once('±') else { return Ok(()) };
    let message = format!("`{}` has an error, and is taken as it is written", read.text);
    Err(from.complaint(key, message, &format!("write {key} = {}", number.trim())))
}

/// Reads one of some words.
fn word<R: Reader, T: Copy>(
    from: &R,
    key: &'static str,
    words: &[(&str, T)],
) -> Result<Option<T>, R::Error> {
    let Some(text) = from.text(key)? else { return Ok(None) };
    match words.iter().find(|(word, _)| *word == text.trim()) {
        Some((_, meaning)) => Ok(Some(*meaning)),
        None => {
            let known: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
            let message = format!("`{text}` is not a value of `{key}`");
            Err(from.complaint(key, message, &format!("write {}", known.join(" or "))))
        }
    }
}
