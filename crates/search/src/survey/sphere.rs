//! Maps on the sphere of γ for one body of the case: of the density, or of the criterion that
//! excludes it.
//!
//! d ln ρ = d ln ρ₀ − (w,dγ) on |γ| = 1, where ρ₀ = det Ĩ (γ,Ĩ⁻¹γ) D_T, or det Ĩ D_T with spin, and w is the covector of
//! the criterion (BMB 2013, (2.6); (2.20) on the sphere). It is integrated along the equator from
//! e₁, and from there along meridians.

use std::f64::consts::PI;

use serde::Serialize;

use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::mechanics::{Model, Phase, System};
use liouville::number::rational::Rational;
use liouville::verdict::{JudgeError, Options, Sampler};

/// Number of latitudes of the grid, from south to north.
const LATITUDES: usize = 24;
/// Number of longitudes of the grid, eastwards from e₁.
const LONGITUDES: usize = 48;

/// Nodes and weights of the Gauss–Legendre rule with four points, on [-1,1].
const NODES: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// Values of the free parameters, by name.
type Parameters = Vec<(String, String)>;

/// Values on a grid of the sphere of γ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SphereMap {
    /// Quantity of the map: `ln ρ`, minus its value at e₁, or the criterion, `C` or `C₁`.
    pub quantity: &'static str,
    /// Values of the free parameters, by name.
    pub parameters: Parameters,
    /// Latitudes of the rows, in degrees; γ₃ is the sine.
    pub latitudes: Vec<f64>,
    /// Longitudes of the columns, in degrees from e₁.
    pub longitudes: Vec<f64>,
    /// Values to six digits, row by row; `null` where undefined.
    pub values: Vec<Vec<Option<f64>>>,
    /// Largest integral along a closed parallel for ln ρ, which would be 0 without rounding and the
    /// error of the rule.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub closure: Option<f64>,
}

/// One body of the case, evaluated at points of the sphere.
pub(super) struct BodyOnSphere<'c> {
    model: &'c Model,
    parameters: Vec<f64>,
}

/// Maps the logarithm of a density that exists by the criterion.
pub fn density(case: &Case, options: &Options) -> Result<Option<SphereMap>, JudgeError> {
    let Some((body, parameters)) = BodyOnSphere::first(case, options)? else { return Ok(None) };
    let (latitudes, longitudes) = grid();
    let step = 2.0 * PI / LONGITUDES as f64;
    let reference = |latitude, longitude| body.reference(point(latitude, longitude)).abs().ln();
    let start = reference(0.0, 0.0);
    let mut values = vec![vec![None; LONGITUDES]; LATITUDES];
    let mut along_equator = 0.0;
    for (column, longitude) in longitudes.iter().enumerate() {
        let from = if column == 0 { 0.0 } else { longitudes[column - 1] };
        along_equator -= body.work(|t| point(0.0, from + (longitude - from) * t));
        for hemisphere in [1.0, -1.0] {
            let (mut value, mut from) = (along_equator, 0.0);
            let mut rows: Vec<usize> =
                (0..LATITUDES).filter(|row| latitudes[*row] * hemisphere > 0.0).collect();
            rows.sort_by(|a, b| latitudes[*a].abs().total_cmp(&latitudes[*b].abs()));
            for row in rows {
                let to = latitudes[row];
                value -= body.work(|t| point(from + (to - from) * t, *longitude));
                from = to;
                values[row][column] = rounded(value + reference(to, *longitude) - start);
            }
        }
    }
    let around = |latitude: &f64| -> f64 {
        let each = |k: usize| body.work(|t| point(*latitude, (k as f64 + t) * step));
        (0..LONGITUDES).map(each).sum::<f64>().abs()
    };
    let closure = latitudes.iter().map(around).fold(0.0, f64::max);
    Ok(Some(SphereMap {
        quantity: "ln ρ",
        parameters,
        latitudes: degrees(&latitudes),
        longitudes: degrees(&longitudes),
        values,
        // Two digits; the rest is rounding error.
        closure: format!("{closure:.1e}").parse().ok(),
    }))
}

/// Maps the criterion (γ, rot w), where no density of the configuration exists.
pub fn criterion(case: &Case, options: &Options) -> Result<Option<SphereMap>, JudgeError> {
    let Some((body, parameters)) = BodyOnSphere::first(case, options)? else { return Ok(None) };
    let (latitudes, longitudes) = grid();
    let value = |latitude: f64, longitude: f64| rounded(body.criterion(point(latitude, longitude)));
    let row =
        |latitude: &f64| longitudes.iter().map(|longitude| value(*latitude, *longitude)).collect();
    Ok(Some(SphereMap {
        quantity: match case.model.system {
            System::Spinning(_) => "C₁",
            _ => "C",
        },
        parameters,
        values: latitudes.iter().map(row).collect(),
        latitudes: degrees(&latitudes),
        longitudes: degrees(&longitudes),
        closure: None,
    }))
}

/// Returns the centres of the cells, in radians.
fn grid() -> (Vec<f64>, Vec<f64>) {
    let latitudes = (0..LATITUDES).map(|k| PI * ((k as f64 + 0.5) / LATITUDES as f64 - 0.5));
    let longitudes = (0..LONGITUDES).map(|k| 2.0 * PI * (k as f64 + 0.5) / LONGITUDES as f64);
    (latitudes.collect(), longitudes.collect())
}

fn degrees(angles: &[f64]) -> Vec<f64> {
    angles.iter().map(|angle| (angle.to_degrees() * 100.0).round() / 100.0).collect()
}

pub(super) fn point(latitude: f64, longitude: f64) -> [f64; 3] {
    let (sine, cosine) = (libm::sin(latitude), libm::cos(latitude));
    [cosine * libm::cos(longitude), cosine * libm::sin(longitude), sine]
}

/// Rounds to six digits: further ones differ between machines.
fn rounded(value: f64) -> Option<f64> {
    value.is_finite().then(|| format!("{value:.5e}").parse().ok()).flatten()
}

impl<'c> BodyOnSphere<'c> {
    /// Takes the body with the parameters of the first state; `None` for a case without a body, or
    /// with further variables.
    pub fn first(
        case: &'c Case,
        options: &Options,
    ) -> Result<Option<(Self, Parameters)>, JudgeError> {
        let model = &case.model;
        if model.system.body().is_none() || !model.extension.is_empty() {
            return Ok(None);
        }
        let printed = Sampler::new(case, &LevelSubset::level(model), options.seed)?
            .printed(0, f64::MANTISSA_DIGITS);
        let numbers = printed[..model.free_components()].iter();
        let parameters: Vec<f64> = numbers
            .map(|text| text.parse::<Rational>().map_or(f64::NAN, |value| value.to_f64().0))
            .collect();
        let mut rest = printed.as_slice();
        let shown = model.free_parameters().map(|parameter| {
            let (own, others) = rest.split_at(liouville::mechanics::components(parameter.kind));
            rest = others;
            (parameter.name.clone(), own.join(", "))
        });
        let shown = shown.collect();
        Ok(Some((Self { model, parameters }, shown)))
    }

    fn at<R>(&self, gamma: [f64; 3], read: impl FnOnce(&Phase<'_, f64>) -> R) -> R {
        let state = [[0.0; 3], gamma].concat();
        read(&Phase::new(self.model, &self.parameters, &state))
    }

    /// Computes the point of contact r.
    pub fn contact(&self, gamma: [f64; 3]) -> [f64; 3] {
        self.at(gamma, |phase| match self.model.system.body() {
            Some(body) => body.shape.contact(&phase.configuration).0.into(),
            None => [f64::NAN; 3],
        })
    }

    /// Computes ρ₀.
    fn reference(&self, gamma: [f64; 3]) -> f64 {
        let density = |phase: &Phase<'_, f64>| {
            self.model.system.reference_density(&phase.configuration).unwrap_or(f64::NAN)
        };
        self.at(gamma, density)
    }

    fn criterion(&self, gamma: [f64; 3]) -> f64 {
        self.at(gamma, |phase| self.model.system.criterion(phase))
            .first()
            .copied()
            .unwrap_or(f64::NAN)
    }

    /// Computes ∫ (w,dγ) along a path with parameter 0 ≤ t ≤ 1.
    fn work(&self, path: impl Fn(f64) -> [f64; 3]) -> f64 {
        let mut sum = 0.0;
        for (node, weight) in NODES {
            let (t, small) = ((node + 1.0) / 2.0, 1e-4);
            // Central differences on a circle: an error of 1e-9 of the step's length.
            let (before, after) = (path(t - small), path(t + small));
            let covector = self.at(path(t), |phase| self.model.system.criterion_covector(phase));
            let Some(covector) = covector else { return f64::NAN };
            let along: f64 =
                (0..3).map(|k| covector[k] * (after[k] - before[k]) / (2.0 * small)).sum();
            sum += weight * along / 2.0;
        }
        sum
    }
}
