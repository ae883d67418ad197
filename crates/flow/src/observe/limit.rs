//! Limits of motions for a vanishing parameter, compared with the motion at 0.

use super::judgement::MotionJudgement;
use super::scene::FollowedCase;
use crate::{FlowError, MeasuredNumber, Precision, orbit, value_at};
use liouville::claim::motion::{Beginning, LimitOfMotion};
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;

/// Number of values of the parameter, each a tenth of the previous one.
const VALUES: i64 = 5;

/// Least number of values for which a trend is seen.
const FEWEST: usize = 3;

/// Roundings of the constant below which quotients do not differ.
const ROUNDINGS: f64 = 16.0;

/// Tests whether |F(ε) - F(0)|/ε^order tends to a constant.
///
/// With an error C ε^order (1 + O(ε)) the quotients converge; their last difference is the error of
/// C. If they grow, the order is lower than claimed; if C is not above its error, higher.
pub fn judge(
    claim: &LimitOfMotion,
    scene: &FollowedCase<'_>,
) -> Result<MotionJudgement, FlowError> {
    let Beginning::State(point) = &claim.beginning else { return Err(FlowError::NoStart) };
    let mut judgement = MotionJudgement::default();
    let Some(component) = claim.component else {
        judgement.leave_open("the parameter has a fixed value: give it a range".to_string());
        return Ok(judgement);
    };
    let model = &scene.case.model;
    let drawn = scene.parameters()?;
    let followed = |value: &Rational, precision: Precision| {
        let mut parameters = drawn.clone();
        parameters[component] = value.clone();
        let start = scene.state(point, parameters)?;
        let time = DoubleDouble::from_f64(claim.time);
        let found = orbit(scene.case, start, time, precision)?;
        value_at(model, &claim.function, &found.start.parameters, &found.end)
    };
    // Roundings grow alike in both precisions, from the last digit of each on.
    let at = |value: Rational| -> Result<(Vec<DoubleDouble>, f64), FlowError> {
        let (fine, coarse) =
            (followed(&value, Precision::Pair)?, followed(&value, Precision::Float)?);
        let length =
            |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
        let gap = length(&mut fine.iter().zip(&coarse).map(|(x, y)| (*x - *y).hi));
        let size = length(&mut fine.iter().map(|x| x.hi));
        Ok((fine, ROUNDINGS * f64::EPSILON * (gap + f64::EPSILON * size)))
    };
    let (limit, noise_of_limit) = at(Rational::from(0))?;
    let (mut quotients, mut noises) = (Vec::new(), Vec::new());
    let mut divisor = 1;
    for _ in 0..VALUES {
        let value = &drawn[component] * &Rational::new(1, divisor);
        let size = libm::pow(value.to_f64().0.abs(), claim.order as f64);
        let (values, noise) = at(value)?;
        let squares = values.iter().zip(&limit).map(|(x, y)| (*x - *y).hi * (*x - *y).hi);
        let quotient = squares.sum::<f64>().sqrt() / size;
        let noise = (noise + noise_of_limit) / size;
        let change = quotients.last().map(|last: &f64| (quotient - last).abs());
        let visible = change.map(|change| change.max(ROUNDINGS * f64::EPSILON * quotient));
        // From here on the quotients are rounding.
        if noise.is_nan() || visible.is_some_and(|visible| noise > visible) {
            break;
        }
        quotients.push(quotient);
        noises.push(noise);
        divisor *= 10;
    }
    if quotients.len() < FEWEST {
        let reason = "rounding hides the quotients: give a lower order or a larger parameter";
        judgement.leave_open(reason.to_string());
        return Ok(judgement);
    }
    let differences: Vec<f64> =
        quotients.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let last = quotients.len() - 1;
    let noise = noises[last] + noises[last - 1];
    let found = MeasuredNumber { value: quotients[last], error: differences[last - 1].max(noise) };
    match &claim.constant {
        Some(stated) => judgement.compare("constant", found, stated),
        None => judgement.show("constant", found),
    }
    // Differences that are rounding have no trend.
    let rounding = (ROUNDINGS * f64::EPSILON * found.value).max(noise);
    if differences[last - 1] >= differences[0].max(rounding) {
        judgement.refute("the quotients do not tend to a constant".to_string());
    } else if found.value <= found.error {
        judgement.refute("the quotients tend to 0: the order is higher".to_string());
    } else if differences.windows(2).any(|pair| pair[1] >= pair[0].max(rounding)) {
        judgement.leave_open("the quotients do not settle steadily".to_string());
    }
    Ok(judgement)
}
