//! Fixed and periodic points, computed in f64 and in double-double; the difference is the error.

use std::f64::consts::PI;

use super::density::speaks_against;
use super::judgement::MotionJudgement;
use super::scene::{FollowedCase, coordinates};
use crate::{ComputedClosedOrbit, FlowError, MeasuredNumber, Multipliers, SectionMap};
use liouville::claim::motion::{PeriodicPoint, Stability};

/// Compares the periodic point found with the claim.
pub fn judge(
    claim: &PeriodicPoint,
    scene: &FollowedCase<'_>,
) -> Result<MotionJudgement, FlowError> {
    let map = scene.map()?;
    let orbit = map.closed(coordinates(&claim.at), claim.period)?;
    let mut judgement = MotionJudgement::default();
    if !orbit.is_supported() {
        let near = FlowError::NearReturn(orbit.point().time, orbit.point().residual);
        judgement.leave_open(near.to_string());
        return Ok(judgement);
    }
    // The angle, on the turn for which it is stated.
    let turns = ((orbit.point().at[0] - claim.at[0].value) / (2.0 * PI)).round();
    let l = orbit.measure(|point| point.at[0] - 2.0 * PI * turns);
    judgement.compare("l", l, &claim.at[0]);
    let z = orbit.measure(|point| point.at[1]);
    judgement.compare("L/G", z, &claim.at[1]);
    match &claim.time {
        Some(stated) => judgement.compare("return time", orbit.measure(|p| p.time), stated),
        None => judgement.show("return time", orbit.measure(|p| p.time)),
    }
    let product = orbit.measure(|point| point.determinant);
    match &claim.product {
        Some(stated) => judgement.compare("product of the multipliers", product, stated),
        None => judgement.show("product of the multipliers", product),
    }
    compare_multipliers(claim, &orbit, &mut judgement);
    if let Some(stability) = claim.stability {
        let seen = stability_of(&orbit);
        // A sink or a source may be too weak to be told from an elliptic point.
        let is_weak = seen == Some(Stability::Elliptic)
            && matches!(stability, Stability::Sink | Stability::Source);
        judgement.expect(seen.filter(|_| !is_weak), stability, "kind of the point");
    }
    if let Some(shorter) = shorter_period(map, &orbit, libm::hypot(l.error, z.error))? {
        judgement.refute(format!("it comes back after {shorter} crossings"));
    }
    judgement.remark = speaks_against(product)
        .then(|| "evidence against a density: volumes change over the period".to_string());
    Ok(judgement)
}

fn compare_multipliers(
    claim: &PeriodicPoint,
    orbit: &ComputedClosedOrbit,
    judgement: &mut MotionJudgement,
) {
    let modulus = orbit.measure_multipliers(|multipliers| match multipliers {
        Multipliers::Complex { modulus, .. } => Some(modulus),
        Multipliers::Real(..) => None,
    });
    let argument = orbit.measure_multipliers(|multipliers| match multipliers {
        Multipliers::Complex { argument, .. } => Some(argument),
        Multipliers::Real(..) => None,
    });
    let larger = orbit.measure_multipliers(|multipliers| match multipliers {
        Multipliers::Real(larger, _) => Some(larger),
        Multipliers::Complex { .. } => None,
    });
    let claims = [
        ("modulus of the multipliers", modulus, &claim.modulus),
        ("argument of the multipliers", argument, &claim.argument),
        ("larger multiplier", larger, &claim.multiplier),
    ];
    for (quantity, found, stated) in claims {
        match (found, stated) {
            (Some(found), Some(stated)) => judgement.compare(quantity, found, stated),
            (Some(found), None) => judgement.show(quantity, found),
            (None, Some(_)) if orbit.has_decided_multipliers() => {
                judgement.refute(format!("there is no {quantity}"));
            }
            (None, Some(_)) => judgement.leave_open(format!(
                "the {quantity} is not decided by these numbers: the multipliers nearly coincide"
            )),
            (None, None) => {}
        }
    }
}

/// Stability by the multipliers, beyond their errors.
fn stability_of(orbit: &ComputedClosedOrbit) -> Option<Stability> {
    let product = orbit.measure(|point| point.determinant);
    let off = product.value.abs() - 1.0;
    match orbit.point().multipliers() {
        Multipliers::Complex { .. } if off.abs() <= product.error => Some(Stability::Elliptic),
        Multipliers::Complex { .. } if off < 0.0 => Some(Stability::Sink),
        Multipliers::Complex { .. } => Some(Stability::Source),
        Multipliers::Real(..) => {
            let of = |which: fn(f64, f64) -> f64| {
                orbit.measure_multipliers(|multipliers| match multipliers {
                    Multipliers::Real(a, b) => Some(which(a.abs(), b.abs())),
                    Multipliers::Complex { .. } => None,
                })
            };
            let (larger, smaller) = (of(f64::max)?, of(f64::min)?);
            let beyond = |x: MeasuredNumber| x.value - 1.0 > x.error;
            let below = |x: MeasuredNumber| 1.0 - x.value > x.error;
            match (beyond(larger), below(smaller)) {
                (true, true) => Some(Stability::Hyperbolic),
                (false, true) if below(larger) => Some(Stability::Sink),
                (true, false) if beyond(smaller) => Some(Stability::Source),
                _ => None,
            }
        }
    }
}

/// Proper divisor of the period after which the point already returns, up to its error.
fn shorter_period(
    map: &SectionMap<'_>,
    orbit: &ComputedClosedOrbit,
    error: f64,
) -> Result<Option<usize>, FlowError> {
    let point = orbit.point();
    for divisor in (1..point.period).filter(|n| point.period.is_multiple_of(*n)) {
        let (image, _) = map.image(point.at, divisor)?;
        let turn = (image[0] - point.at[0]) / (2.0 * PI);
        let dl = 2.0 * PI * (turn - turn.round());
        // The map carries the error of the point to its image.
        let blur = error + map.blur(point.at, divisor)?;
        if libm::hypot(dl, image[1] - point.at[1]) <= blur {
            return Ok(Some(divisor));
        }
    }
    Ok(None)
}
