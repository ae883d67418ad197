//! Messages on motions that end early.

use super::MOST_STEPS;

/// Growth of the state from which on a motion runs away.
const GROWN: f64 = 10.0;

/// Words for the direction of time in which a motion was followed up to here.
fn direction(time: f64) -> &'static str {
    if time < 0.0 { "backwards in time " } else { "" }
}

pub(super) fn without_value(formula: &str, time: f64, place: &str) -> String {
    let direction = direction(time);
    match time == 0.0 {
        true => format!("`{formula}` has no value at the start, {place}"),
        false => {
            format!("{direction}the motion ends at t = {time}: `{formula}` has no value at {place}")
        }
    }
}

pub(super) fn overflow(time: f64) -> String {
    match time == 0.0 {
        true => "overflow at the start: a number of the equations is too large for f64".to_string(),
        false => {
            let direction = direction(time);
            format!(
                "overflow: {direction}a number of the motion is too large for f64 from t = {time} on"
            )
        }
    }
}

pub(super) fn shrinking(time: f64, [step, rest, grown]: [f64; 3], state: &[f64]) -> String {
    let direction = direction(time);
    let (what, size) = match grown > GROWN {
        // A motion may start at 0.
        true if grown.is_infinite() => ("runs away", String::new()),
        true => ("runs away", format!(", {grown:.1e} times as large as at the start,")),
        false => ("turns ever faster", String::new()),
    };
    let rest = match rest.is_finite() {
        true => format!("the rest of the time takes {rest:.0e} of them"),
        false => "no number of them reaches the end of the time".to_string(),
    };
    format!(
        "{direction}the motion {what}: at t = {time}, near the state [{}]{size} a step is {:.1e}; if they \
         go on shrinking, {rest}",
        shown(state),
        step.abs()
    )
}

pub(super) fn endless(time: f64, step: f64, until: f64) -> String {
    format!(
        "{}the time is too long: at t = {time:.4e} a step is {:.1e}, and up to t = {until:e} there would \
         be more than {MOST_STEPS:e} of them",
        direction(until),
        step.abs()
    )
}

/// Components of a state, in figures.
fn shown(state: &[f64]) -> String {
    let one = |x: &f64| if x.abs() < 1e6 { format!("{x:.6}") } else { format!("{x:.3e}") };
    state.iter().map(one).collect::<Vec<String>>().join(", ")
}

pub(super) fn singular(time: f64, state: &[f64]) -> String {
    let (direction, state) = (direction(time), shown(state));
    match time == 0.0 {
        true => format!("the equations of motion are singular at the start, the state [{state}]"),
        false => {
            format!(
                "{direction}the motion runs into a singularity at t = {time}, near the state [{state}]"
            )
        }
    }
}

pub(super) fn runs_away(time: f64, state: &[f64]) -> String {
    format!(
        "{}the motion runs away to infinity at t = {time}, where it is at the state [{}]",
        direction(time),
        shown(state)
    )
}

pub(super) fn slides(time: f64, state: &[f64]) -> String {
    let what = "the field jumps, and pushes towards the jump from both sides, so that the motion would slide";
    match time == 0.0 {
        true => format!("{what} at the start, the state [{}]", shown(state)),
        false => {
            format!("{}{what} from t = {time} on, at the state [{}]", direction(time), shown(state))
        }
    }
}

pub(super) fn too_short(time: f64, state: &[f64]) -> String {
    format!(
        "{}the steps became too short at t = {time}, near the state [{}]: the field varies there over less \
         than the rounding of the time, or jumps as atan2 does at its cut",
        direction(time),
        shown(state)
    )
}

/// Words for a motion that was stopped.
pub(super) fn stopped_at(time: f64, state: &[f64]) -> String {
    let parts: Vec<String> = state.iter().map(|x| format!("{x:?}")).collect();
    format!("stopped at t = {time:?}, at the state [{}]", parts.join(", "))
}
