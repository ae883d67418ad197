//! Closed orbits, proved by enclosures, and the densities that their ∮ div v excludes.

use super::ground::Ground;
use super::judgement::MotionJudgement;
use super::scene::FollowedCase;
use crate::{
    Conserved, Cycle, Enclosure, FlowError, MeasuredNumber, Obstacle, ProvedOrbit, Request, Start,
    prove,
};
use liouville::case::Case;
use liouville::claim::motion::{Change, ClosedOrbit, Neighbourhood, Stability, Stated};
use liouville::number::rational::Rational;
use liouville::verdict::Options;

/// Distance from the start within which an orbit is the claimed one, relative to what each component
/// covers; the same for the period.
pub(super) const NEAR: f64 = 1e-2;

/// Proves the closed orbit of a claim.
pub fn judge(
    claim: &ClosedOrbit,
    scene: &FollowedCase<'_>,
    options: &Options,
) -> Result<MotionJudgement, FlowError> {
    by(claim, scene, options, prove).map(|(judgement, _)| judgement)
}

/// Judges a claim by an orbit that `proof` encloses; returns the orbit too.
pub fn by(
    claim: &ClosedOrbit,
    scene: &FollowedCase<'_>,
    options: &Options,
    proof: impl FnOnce(&Request<'_>) -> Result<ProvedOrbit, Obstacle>,
) -> Result<(MotionJudgement, Option<ProvedOrbit>), FlowError> {
    let mut judgement = MotionJudgement::default();
    let ground = match Ground::of(claim.into(), scene, options)? {
        Ok(ground) => ground,
        Err(reason) => {
            judgement.leave_open(reason);
            return Ok((judgement, None));
        }
    };
    let found = ground.enclosed(proof);
    match &found {
        Ok(found) => {
            weigh(claim, &claim.parameters, found, &mut judgement);
            doubt(&ground, &claim.period, (&found.start, found.period), &mut judgement);
        }
        Err(reason) => judgement.leave_open(reason.clone()),
    }
    if !claim.parameters.is_empty() && judgement.is_open() {
        judgement = refuted_at_centres(claim, &ground).unwrap_or(judgement);
    }
    Ok((judgement, found.ok()))
}

/// Refutation of a claim about boxes of parameters by the values of the case itself, which are among them.
fn refuted_at_centres(claim: &ClosedOrbit, ground: &Ground<'_>) -> Option<MotionJudgement> {
    let ground = ground.at_centres();
    let found = ground.enclosed(prove).ok()?;
    let mut judgement = MotionJudgement::default();
    weigh(claim, &[], &found, &mut judgement);
    doubt(&ground, &claim.period, (&found.start, found.period), &mut judgement);
    judgement.is_refuted().then_some(judgement)
}

/// Leaves a claim open that is wrong of the orbit found, unless no other one with a period as stated is
/// proved to begin as near to the start: it may lie next to that.
pub(super) fn doubt(
    ground: &Ground<'_>,
    stated: &Stated,
    (start, period): (&[Enclosure], Enclosure),
    judgement: &mut MotionJudgement,
) {
    if judgement.is_refuted() && !ground.is_alone(stated.unit, (start, period)) {
        judgement.withdraw(format!(
            "the closed orbit found from the start has period {:.10}, and is not proved to be the only \
             one there: start nearer to the one that is claimed",
            period.mid
        ));
    }
}

/// Reason why an orbit is not the one that is claimed.
pub(super) fn far(
    what: &str,
    moved: f64,
    (stated, period): (&Stated, Enclosure),
) -> Option<String> {
    let shift = (period.mid - stated.value).abs() / stated.value;
    if shift.is_nan() || shift > NEAR {
        return Some(format!(
            "the {what} that is found has period {:.10}, which is not within 1 % of {}",
            period.mid, stated.text
        ));
    }
    (moved.is_nan() || moved > NEAR).then(|| {
        format!(
            "the {what} that is found has period {:.10}, and a component begins {moved:.1e} of what it \
             covers away from the start: start nearer to it",
            period.mid
        )
    })
}

/// Proves that no density is continuous and positive on the closed orbit near a start; `None` where
/// the enclosures do not show it.
pub(super) fn exclusion(
    case: &Case,
    start: &Start,
    period: f64,
    energy: Option<&Rational>,
    options: &Options,
) -> Option<String> {
    let ground = Ground::near(case, (start.clone(), Vec::new()), period, energy, options).ok()?;
    let found = ground.enclosed(prove).ok()?;
    let changes = found.volume.is_positive() || (-found.volume).is_positive();
    changes.then(|| format!("proved: {}", theorem(&found, true, stability(&found), &[])))
}

/// Proves that a computed orbit closes, in its least period, and returns the theorem, or the reason why
/// there is none. On an orbit through the section of a rolling body the energy is given.
pub fn theorem_about(
    case: &Case,
    cycle: &Cycle,
    energy: Option<&Rational>,
    options: &Options,
) -> Result<String, String> {
    let period = cycle.period.value / f64::from(cycle.turns);
    let formula = |own: &Conserved| match own {
        Conserved::Integral { formula, .. } => Some(formula.clone()),
        Conserved::Energy => None,
    };
    let integrals = cycle.integrals.iter().filter_map(formula).collect();
    let ground = Ground::near(case, (cycle.start.clone(), integrals), period, energy, options)?;
    let found = ground.enclosed(prove)?;
    if found.moved > NEAR {
        let far = printed_bound(found.moved);
        return Err(format!(
            "the closed orbit that is proved begins {far} of what a component covers away"
        ));
    }
    let changes = found.volume.is_positive() || (-found.volume).is_positive();
    Ok(theorem(&found, changes, stability(&found), &[]))
}

/// Compares the orbit that was found with the claim, which is about it: another may lie next to it.
fn weigh(
    claim: &ClosedOrbit,
    varied: &[Neighbourhood],
    found: &ProvedOrbit,
    judgement: &mut MotionJudgement,
) {
    if let Some(reason) = far("closed orbit", found.moved, (&claim.period, found.period)) {
        judgement.leave_open(reason);
        return;
    }
    let measured = |x: Enclosure| MeasuredNumber { value: x.mid, error: x.rad };
    judgement.note("period", measured(found.period), Some(&claim.period));
    judgement.note("∮ div v dt", measured(found.volume), None);
    compare_period(&claim.period, found.period, judgement);
    if claim.is_least {
        match &found.turns {
            Ok(1) => {}
            Ok(turns) => {
                let share = Enclosure::exact(*turns as f64).recip();
                let least = printed(found.period * share);
                judgement.refute(format!(
                    "the orbit found from the start is run through {turns} times in it, and its \
                     least period is {least}"
                ));
            }
            Err(doubt) => {
                judgement.leave_open(format!("the period is not proved to be the least: {doubt}"));
            }
        }
    }
    let negative = (-found.volume).is_positive();
    let changes = found.volume.is_positive() || negative;
    if !changes && (claim.divergence.is_some() || claim.excludes_density) {
        judgement.leave_open("∮ div v dt is not separated from 0".to_string());
    }
    match claim.divergence {
        Some(Change::Negative) if found.volume.is_positive() => {
            judgement.refute("along the orbit found from the start volume grows".to_string());
        }
        Some(Change::Positive) if negative => {
            judgement.refute("along the orbit found from the start volume shrinks".to_string());
        }
        _ => {}
    }
    let seen = claim.stability.and_then(|_| stability(found));
    if let Some(claimed) = claim.stability {
        if let Some(sum) = found.sum {
            judgement.note("λ₁ + λ₂", measured(sum), None);
        }
        match seen {
            Some(seen) if seen == claimed => {}
            Some(seen) => {
                let seen = name(seen);
                judgement
                    .refute(format!("the orbit found from the start is of another kind: {seen}"));
            }
            None => {
                judgement.leave_open("its stability is not proved by the enclosures".to_string())
            }
        }
    }
    judgement.theorem = Some(theorem(found, changes, seen, varied));
}

/// Stability by the enclosed multipliers, one or two of them. That their moduli are 1 is not proved.
fn stability(found: &ProvedOrbit) -> Option<Stability> {
    let grows = match (found.volume.is_positive(), (-found.volume).is_positive()) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    };
    let by_volume = |grows| if grows { Stability::Source } else { Stability::Sink };
    match found.multipliers {
        1 => grows.map(by_volume),
        2 => {
            // The characteristic polynomial at ±1 is 1 + λ₁λ₂ ∓ (λ₁ + λ₂).
            let sum = found.sum?;
            let one_and_product = Enclosure::exact(1.0) + found.volume.exp();
            let [ahead, behind] = [one_and_product - sum, one_and_product + sum];
            if (-ahead).is_positive() || (-behind).is_positive() {
                return Some(Stability::Hyperbolic);
            }
            let is_inside = ahead.is_positive() && behind.is_positive();
            grows.filter(|_| is_inside).map(by_volume)
        }
        _ => None,
    }
}

fn name(stability: Stability) -> &'static str {
    let named = Stability::ALL.iter().find(|(_, one)| *one == stability);
    named.map_or("", |(name, _)| name)
}

/// Compares an enclosed period with the digits stated.
pub(super) fn compare_period(stated: &Stated, period: Enclosure, judgement: &mut MotionJudgement) {
    let rounding = 4.0 * f64::EPSILON * (period.mid.abs() + stated.value.abs());
    let gap = (period.mid - stated.value).abs();
    let is_inside = gap + period.rad + rounding <= stated.unit;
    if gap > stated.unit + period.rad + rounding {
        judgement
            .refute(format!("the period of the orbit found from the start is not {}", stated.text));
    } else if stated.unit == 0.0 {
        let reason = "an enclosure does not prove that the period is exactly";
        judgement.leave_open(format!("{reason} {}: write a decimal", stated.text));
    } else if !is_inside {
        let digits = known_digits(period)
            .map_or_else(String::new, |known| format!(": state {known}, whose digits are proved"));
        judgement
            .leave_open(format!("the enclosure of the period is wider than the digits{digits}"));
    }
}

/// Longest decimal that an enclosed period proves to one unit of its last digit.
fn known_digits(period: Enclosure) -> Option<String> {
    let rounded = |decimals: usize| {
        let text = format!("{:.decimals$}", period.mid);
        let value: f64 = text.parse().ok()?;
        let rounding = 4.0 * f64::EPSILON * (period.mid.abs() + value.abs());
        let gap = (period.mid - value).abs() + period.rad + rounding;
        (gap < libm::pow(10.0, -(decimals as f64))).then_some(text)
    };
    (1..=MOST_DECIMALS).rev().find_map(rounded)
}

/// Prints a bound with one digit, rounded up.
pub(super) fn printed_bound(bound: f64) -> String {
    if bound.is_nan() || bound <= 0.0 {
        return bound.to_string();
    }
    let exponent = libm::floor(libm::log10(bound)) as i32;
    let digit = libm::ceil(bound / libm::pow(10.0, f64::from(exponent)) * (1.0 + 1e-9));
    match digit as u32 {
        10.. => format!("{}e{}", digit as u32 / 10, exponent + 1),
        digit => format!("{digit}e{exponent}"),
    }
}

/// Prints an enclosure; the printed radius covers the digits left out.
pub(super) fn printed(x: Enclosure) -> String {
    let decimals = libm::ceil(-libm::log10(x.rad)).clamp(0.0, 16.0) as usize + 1;
    let left_out = 0.51 * libm::pow(10.0, -(decimals as f64));
    format!("{} ± {}", decimal(x.mid, decimals), printed_bound(x.rad + left_out))
}

/// Prints a number with this many decimals, 0 without a sign.
fn decimal(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    let is_zero = !text.contains(|letter: char| ('1'..='9').contains(&letter));
    match is_zero {
        true => text.trim_start_matches('-').to_string(),
        false => text,
    }
}

/// Largest number of decimals of a period that is suggested.
const MOST_DECIMALS: usize = 15;
/// Number of decimals of the state in a theorem.
const DECIMALS: usize = 12;

fn theorem(
    found: &ProvedOrbit,
    changes: bool,
    seen: Option<Stability>,
    varied: &[Neighbourhood],
) -> String {
    let state: Vec<String> = found.start.iter().map(|x| decimal(x.mid, DECIMALS)).collect();
    let wide = found.start.iter().map(|x| x.rad).fold(0.0, f64::max);
    let wide = printed_bound(wide + 0.51 * libm::pow(10.0, -(DECIMALS as f64)));
    let kind = seen.map_or(String::new(), |seen| format!("; it is of kind {}", name(seen)));
    let (period, volume) = (printed(found.period), printed(found.volume));
    let period = match &found.turns {
        Ok(1) => format!("least period {period}"),
        Ok(turns) => format!("period {period}, {turns} times the least,"),
        Err(_) => format!("period {period}"),
    };
    let contraction = printed_bound(found.contraction);
    let varied: Vec<String> = varied.iter().map(Neighbourhood::text).collect();
    let varied = varied.join(", ");
    let each = match varied.as_str() {
        "" => String::new(),
        varied => format!("for all parameters with {varied}, "),
    };
    let orbit = format!(
        "{each}a closed orbit goes through ({}) ± {wide}, with {period} and ∮ div v dt = {volume} \
         ({} segments, ‖1 − CG'‖ ≤ {contraction}){kind}",
        state.join(", "),
        found.segments,
    );
    if !changes {
        return orbit;
    }
    let near = match (found.persists, found.kept) {
        (false, _) => "",
        (true, 0) => " and all near them",
        (true, _) => " and all near them for which the motion keeps the same functions",
    };
    let these = if varied.is_empty() { "these parameters" } else { "all these parameters" };
    format!(
        "{orbit}; so no invariant measure has a density that is continuous and positive on it, for \
         {these}{near}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_digits_that_are_known_are_proved() {
        let known = |mid, rad| known_digits(Enclosure::about(mid, rad));
        // 5.88109 is off by 1.5e-6, and the radius takes more than the rest of its unit
        assert_eq!(known(5.881_088_46, 5e-5).as_deref(), Some("5.8811"));
        assert_eq!(known(6.982_757_465, 2e-5).as_deref(), Some("6.9828"));
        assert_eq!(known(6.5, 0.2), None);
    }

    #[test]
    fn printed_enclosures_are_true() {
        assert_eq!(printed_bound(3.1e-12), "4e-12");
        assert_eq!(printed_bound(9.7e-12), "1e-11", "up to the next digit");
        assert_eq!([-1e-40, -0.25, 0.0].map(|x| decimal(x, 2)), ["0.00", "-0.25", "0.00"]);
        for (mid, rad) in [(3.197_991_923_280_63, 4e-14), (-0.020_093_772_9, 8.7e-11), (2.5, 0.3)] {
            let text = printed(Enclosure::about(mid, rad));
            let (number, bound) = text.split_once(" ± ").expect("both");
            let [number, bound] = [number, bound].map(|x| x.parse::<f64>().expect("a number"));
            assert!((number - mid).abs() + rad <= bound, "{text}");
            assert!(bound <= 2.5 * rad, "{text}: not wider than it has to be");
        }
    }
}
