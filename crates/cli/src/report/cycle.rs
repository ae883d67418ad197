//! Report of `periodic`: closed orbits with their multipliers, each with an estimate of its error.

use serde_json::{Value, json};

use liouville::case::Case;
use liouville_flow::{ComputedPeriodicPoint, Cycle, CycleKind, MeasuredNumber, Multiplier};

/// A closed orbit, with the point of the section that it goes through if one was asked for.
pub struct FoundOrbit {
    /// Periodic point of a rolling body's section.
    pub point: Option<ComputedPeriodicPoint>,
    /// Number of crossings after which the orbit closes, where they were counted.
    pub crossings: Option<usize>,
    /// Orbit.
    pub cycle: Cycle,
    /// Theorem that the orbit closes, or the reason why there is none, if a proof was tried.
    pub proof: Option<Result<String, String>>,
}

impl FoundOrbit {
    /// Word for the grounds on which the orbit is reported.
    fn status(&self) -> &'static str {
        match self.proof {
            Some(Ok(_)) => "proved",
            _ => "numerical",
        }
    }
}

/// Formats a number with its error: the digits that the error leaves, and one more; 0 within its error.
pub(super) fn shown(x: MeasuredNumber) -> String {
    if x.value.abs() <= x.error {
        return format!("0 ± {:.0e}", x.error);
    }
    let digits = libm::ceil(-libm::log10(x.error)) + 1.0;
    if !(x.error > 0.0 && digits.is_finite()) {
        return format!("{:?}", x.value);
    }
    if x.value.abs() >= 1e15 || (x.value != 0.0 && x.value.abs() < 1e-6) {
        let size = libm::floor(libm::log10(x.value.abs()));
        let digits = (digits + size).clamp(0.0, 16.0) as usize;
        return format!("{:.digits$e} ± {:.0e}", x.value, x.error);
    }
    let digits = digits.clamp(0.0, 17.0) as usize;
    format!("{:.digits$} ± {:.0e}", x.value, x.error)
}

pub(super) fn kind(kind: Option<CycleKind>) -> &'static str {
    kind.map_or("undecided", CycleKind::name)
}

/// Stability in words, as far as the errors allow.
fn verdict(cycle: &Cycle) -> String {
    match cycle.kind {
        Some(CycleKind::Elliptic) => "elliptic: the moduli are 1 within their errors".to_string(),
        Some(other) => other.name().to_string(),
        None if cycle.multipliers.is_empty() => "no multipliers besides 1".to_string(),
        None => "kind undecided: a multiplier has the modulus 1 within its error".to_string(),
    }
}

/// Renders a closed orbit in a few lines.
pub fn text(case: &Case, found: &FoundOrbit) -> String {
    let cycle = &found.cycle;
    let mut out = String::new();
    match (&found.point, found.crossings) {
        (Some(point), _) => out.push_str(&format!(
            "({:.12}, {:.12}) of period {}: {}\n",
            point.at[0],
            point.at[1],
            point.period,
            verdict(cycle)
        )),
        (None, Some(count)) => {
            let crossings = if count == 1 { "crossing" } else { "crossings" };
            out.push_str(&format!("closed orbit of {count} {crossings}: {}\n", verdict(cycle)));
        }
        (None, None) => out.push_str(&format!("closed orbit: {}\n", verdict(cycle))),
    }
    let mut state = cycle.start.state.iter();
    for variable in &case.model.state {
        let values = state.by_ref().take(variable.len());
        // Below the distance of return only rounding is left.
        let known = |x: f64| if x.abs() <= cycle.residual { 0.0 } else { x };
        let values: Vec<String> = values.map(|x| format!("{:?}", known(x.hi))).collect();
        out.push_str(&format!("  {} = {}\n", variable.name, values.join(", ")));
    }
    let period = shown(cycle.period);
    out.push_str(&format!(
        "  returns after t = {period}, at a distance of {:.1e}\n",
        cycle.residual
    ));
    if cycle.turns > 1 {
        let (turns, least) = (cycle.turns, shown(least(cycle)));
        out.push_str(&format!("  run through {turns} times: the least period is {least}\n"));
    }
    for multiplier in &cycle.multipliers {
        if multiplier.im < 0.0 {
            continue;
        }
        let of = match cycle.turns {
            0 | 1 => String::new(),
            turns => format!(", of {turns} turns"),
        };
        out.push_str(&format!("  multiplier{}{of}\n", written(multiplier)));
    }
    let volume = cycle.volume;
    let product = product(volume);
    out.push_str(&format!("  product {}, ∮ div v dt = {}\n", shown(product), shown(volume)));
    match &found.proof {
        Some(Ok(theorem)) => out.push_str(&format!("  proved: {theorem}\n")),
        Some(Err(reason)) => out.push_str(&format!("  numerical, not proved: {reason}\n")),
        None => out.push_str("  numerical: no proof was tried\n"),
    }
    out
}

pub(super) fn written(multiplier: &Multiplier) -> String {
    let error = multiplier.error;
    if multiplier.im == 0.0 {
        return format!(" {}", shown(MeasuredNumber { value: multiplier.re, error }));
    }
    let modulus = MeasuredNumber { value: multiplier.modulus(), error: multiplier.modulus_error };
    let angle = libm::atan2(multiplier.im, multiplier.re);
    let angle = MeasuredNumber { value: angle, error: error / multiplier.modulus() };
    format!("s: modulus {}, argument ±{}", shown(modulus), shown(angle))
}

/// Least period: that after which the orbit closes, over the times that it is run through.
fn least(cycle: &Cycle) -> MeasuredNumber {
    let turns = f64::from(cycle.turns);
    let MeasuredNumber { value, error } = cycle.period;
    MeasuredNumber { value: value / turns, error: error / turns }
}

/// Product of all multipliers, e^∮ div v.
fn product(volume: MeasuredNumber) -> MeasuredNumber {
    let value = libm::exp(volume.value);
    MeasuredNumber { value, error: value * (volume.error + f64::EPSILON) }
}

/// Renders a multiplier as JSON.
pub(super) fn multiplier(one: &Multiplier) -> Value {
    json!({
        "re": one.re,
        "im": one.im,
        "error": one.error,
        "modulus": one.modulus(),
        "modulus_error": one.modulus_error,
    })
}

/// Renders a closed orbit as JSON.
pub fn entry(found: &FoundOrbit) -> Value {
    let cycle = &found.cycle;
    let product = product(cycle.volume);
    let mut entry = json!({
        "at": found.point.map(|point| point.at),
        "period": found.crossings,
        "state": cycle.start.state.iter().map(|x| x.hi).collect::<Vec<_>>(),
        "kind": kind(cycle.kind),
        "status": found.status(),
        "time": cycle.period.value,
        "time_error": cycle.period.error,
        "turns": cycle.turns,
        "least_time": least(cycle).value,
        "least_time_error": least(cycle).error,
        "residual": cycle.residual,
        "multipliers": cycle.multipliers.iter().map(multiplier).collect::<Vec<_>>(),
        "product": product.value,
        "product_error": product.error,
        "volume": cycle.volume.value,
        "volume_error": cycle.volume.error,
    });
    match &found.proof {
        Some(Ok(theorem)) => entry["theorem"] = json!(theorem),
        Some(Err(reason)) => entry["unproved"] = json!(reason),
        None => {}
    }
    entry
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_are_known() {
        let text = |value, error| shown(MeasuredNumber { value, error });
        assert_eq!(text(148.166_473_353_152_24, 3e-11), "148.166473353152 ± 3e-11");
        assert_eq!(text(0.5, 0.2), "0.50 ± 2e-1");
        assert_eq!(text(1.0, 0.0), "1.0", "no error, all digits");
        assert_eq!(text(0.0, 1e-15), "0 ± 1e-15");
    }
}
