//! Series that are proved to be those of quotients, up to a bound of what they leave out.

use super::COUNT;
use crate::taylor::germ::Germ;
use crate::taylor::remainder::{self, RADII, Rest, above, bounds};

/// Part of the largest coefficient that what a series leaves out may reach.
const REST: f64 = 1e-17;

/// Bounds of the series of a quotient.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::taylor) struct ProvedSeries {
    /// Size of v up to which the series are used.
    pub(in crate::taylor) reach: f64,
    /// Radius R of the norm Σ |a_k| R^k.
    pub(in crate::taylor) radius: f64,
    /// Bounds of the norms of Σ a_(k + n) v^k, n the number of coefficients, series by series.
    pub(in crate::taylor) rests: Vec<f64>,
}

impl ProvedSeries {
    /// Chooses the radius with the largest reach.
    pub(super) fn of(quotient: &Germ) -> Option<Self> {
        let all: Vec<_> = quotient.terms.values().collect();
        let beyond: Vec<Rest> = all
            .iter()
            .map(|own| {
                let known = remainder::norm_from(&own.first, COUNT);
                bounds(|index| known[index] + own.rest[index])
            })
            .collect();
        let reach = |index: usize| {
            let radius = remainder::radius(index);
            let each = all.iter().zip(&beyond).map(|(own, rest)| {
                let size = own.first.iter().map(|x| x.to_f64().0.abs()).fold(0.0, f64::max);
                radius * libm::pow(REST * size / rest[index], 1.0 / COUNT as f64)
            });
            each.fold(radius, f64::min)
        };
        let best = (0..RADII).filter(|index| beyond.iter().all(|rest| rest[*index].is_finite()));
        let best = best.max_by(|a, b| reach(*a).total_cmp(&reach(*b)))?;
        let radius = remainder::radius(best);
        let scale = libm::pow(radius, COUNT as f64);
        let rests = beyond.iter().map(|rest| above(rest[best] / scale)).collect();
        Some(Self { reach: reach(best), radius, rests })
    }
}
