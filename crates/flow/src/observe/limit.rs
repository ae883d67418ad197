//! Limits of motions for a vanishing parameter, compared with the motion at 0.

use super::judgement::MotionJudgement;
use super::scene::FollowedCase;
use super::settling::{FEWEST, settled};
use crate::{FlowError, MeasuredNumber, Precision, orbit, value_at};
use liouville::claim::Components;
use liouville::claim::motion::{Beginning, LimitOfMotion};
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;

/// Divisors of the parameter's value, in no geometric series: what returns with the logarithm of the
/// parameter is not taken for a constant.
const DIVISORS: [i64; 7] = [1, 3, 10, 40, 120, 400, 1600];

/// Two more, at which quotients that have settled are looked at again.
const FAR: [i64; 2] = [10_000_000, 1_000_000_000_000];

/// Further ones where the quotients have not settled, as far as rounding lets them be seen.
const FURTHER: [i64; 8] = [
    48_000,
    4_800_000,
    192_000_000,
    5_760_000_000,
    576_000_000_000,
    23_000_000_000_000,
    690_000_000_000_000,
    69_000_000_000_000_000,
];

/// Number of its errors above which a power is not 0: that of a logarithm falls to 0 slowly.
const CLEAR: f64 = 4.0;

/// Share of a quotient that its noise is at most where a power is looked for.
const KNOWN: f64 = 1e-2;

/// Roundings of the constant below which quotients do not differ.
const ROUNDINGS: f64 = 16.0;

/// Tests whether |F(ε) - F(0)|/ε^order tends to a constant.
///
/// Quotients that settle have the constant as their limit. Where they do not, they may be a power of
/// the parameter: the order is lower where it grows for ε → 0, and higher where it falls.
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
    let motions = Motions { claim, scene, point, component, drawn: scene.parameters()? };
    let limit = motions.at(Rational::from(0))?;
    let mut seen = Quotients::default();
    motions.extend(&mut seen, &limit, &DIVISORS)?;
    if seen.len() < FEWEST {
        let reason = "rounding hides the quotients: give a lower order or a larger parameter";
        judgement.leave_open(reason.to_string());
        return Ok(judgement);
    }
    let mut constant = seen.constant();
    if let Some(found) = constant {
        for divisor in FAR {
            let (_, far, noise) = motions.quotient(&limit, divisor)?;
            if (far - found.value).abs() > found.error.max(ROUNDINGS * f64::EPSILON * far) + noise {
                constant = None;
            }
        }
    }
    if constant.is_none() && seen.len() == DIVISORS.len() {
        motions.extend(&mut seen, &limit, &FURTHER)?;
        constant = seen.constant();
    }
    match (constant, &claim.constant) {
        (Some(found), Some(stated)) => judgement.compare("constant", found, stated),
        (Some(found), None) => judgement.show("constant", found),
        (None, _) => match seen.power() {
            Some(power) if power > 0.0 => {
                judgement.refute("the quotients tend to 0: the order is higher".to_string());
            }
            Some(_) => {
                judgement
                    .refute("the quotients grow without bound: the order is lower".to_string());
            }
            None => {
                let reason = format!(
                    "the quotients do not settle between ε = {:.1e} and {:.1e}: they show neither a \
                     constant nor a power of ε",
                    seen.values.first().copied().unwrap_or(f64::NAN),
                    seen.values.last().copied().unwrap_or(f64::NAN),
                );
                judgement.leave_open(reason);
            }
        },
    }
    Ok(judgement)
}

/// Motions of a claim, by the value of its parameter.
struct Motions<'m, 'c> {
    claim: &'m LimitOfMotion,
    scene: &'m FollowedCase<'c>,
    point: &'m Components,
    component: usize,
    drawn: Vec<Rational>,
}

impl Motions<'_, '_> {
    fn followed(
        &self,
        value: &Rational,
        precision: Precision,
    ) -> Result<Vec<DoubleDouble>, FlowError> {
        let mut parameters = self.drawn.clone();
        parameters[self.component] = value.clone();
        let start = self.scene.state(self.point, parameters)?;
        let time = DoubleDouble::from_f64(self.claim.time);
        let found = orbit(self.scene.case, start, time, precision)?;
        let model = &self.scene.case.model;
        value_at(model, &self.claim.function, &found.start.parameters, &found.end)
    }

    /// Values of F, with their noise. Roundings grow alike in both precisions, from the last digit of
    /// each on.
    fn at(&self, value: Rational) -> Result<(Vec<DoubleDouble>, f64), FlowError> {
        let fine = self.followed(&value, Precision::Pair)?;
        let coarse = self.followed(&value, Precision::Float)?;
        let length =
            |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
        let gap = length(&mut fine.iter().zip(&coarse).map(|(x, y)| (*x - *y).hi));
        let size = length(&mut fine.iter().map(|x| x.hi));
        Ok((fine, ROUNDINGS * f64::EPSILON * (gap + f64::EPSILON * size)))
    }

    /// Size of the parameter divided by a number, the quotient there, and its noise.
    fn quotient(
        &self,
        limit: &(Vec<DoubleDouble>, f64),
        divisor: i64,
    ) -> Result<(f64, f64, f64), FlowError> {
        let value = &self.drawn[self.component] * &Rational::new(1, divisor);
        let parameter = value.to_f64().0.abs();
        let size = libm::pow(parameter, self.claim.order as f64);
        let (values, noise) = self.at(value)?;
        let squares = values.iter().zip(&limit.0).map(|(x, y)| (*x - *y).hi * (*x - *y).hi);
        Ok((parameter, squares.sum::<f64>().sqrt() / size, (noise + limit.1) / size))
    }

    /// Adds the quotients at some divisors, until they are rounding.
    fn extend(
        &self,
        seen: &mut Quotients,
        limit: &(Vec<DoubleDouble>, f64),
        divisors: &[i64],
    ) -> Result<(), FlowError> {
        for divisor in divisors {
            let (value, quotient, noise) = self.quotient(limit, *divisor)?;
            let change = seen.quotients.last().map(|last: &f64| (quotient - last).abs());
            let visible = change.map(|change| change.max(ROUNDINGS * f64::EPSILON * quotient));
            if noise.is_nan() || visible.is_some_and(|visible| noise > visible) {
                break;
            }
            seen.values.push(value);
            seen.quotients.push(quotient);
            seen.noises.push(noise);
        }
        Ok(())
    }
}

/// Quotients at falling values of the parameter.
#[derive(Default)]
struct Quotients {
    values: Vec<f64>,
    quotients: Vec<f64>,
    noises: Vec<f64>,
}

impl Quotients {
    fn len(&self) -> usize {
        self.quotients.len()
    }

    /// Their limit, if they settle to one that is not 0.
    fn constant(&self) -> Option<MeasuredNumber> {
        let rounded = |(q, noise): (&f64, &f64)| noise.max(ROUNDINGS * f64::EPSILON * q);
        let noises: Vec<f64> = self.quotients.iter().zip(&self.noises).map(rounded).collect();
        settled(&self.quotients, &noises).filter(|found| found.value > found.error)
    }

    /// The power of the parameter that they follow, if it settles to one that is not 0.
    fn power(&self) -> Option<f64> {
        let shares = self.quotients.iter().zip(&self.noises).map(|(q, noise)| noise / q);
        let shares: Vec<f64> = shares.take_while(|share| *share < KNOWN).collect();
        let logs = |pair: &[f64]| libm::log(pair[1] / pair[0]);
        let steps: Vec<f64> = self.values[..shares.len()].windows(2).map(logs).collect();
        let powers: Vec<f64> =
            self.quotients.windows(2).zip(&steps).map(|(pair, step)| logs(pair) / step).collect();
        let noise = |(pair, step): (&[f64], &f64)| {
            (pair[0] + pair[1] + ROUNDINGS * f64::EPSILON) / step.abs()
        };
        let noises: Vec<f64> = shares.windows(2).zip(&steps).map(noise).collect();
        let found = settled(&powers, &noises)?;
        (found.value.abs() > CLEAR * found.error).then_some(found.value)
    }
}
