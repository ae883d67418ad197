//! Maps on the sphere of γ for one body of the case: of the density, or of the criterion that
//! excludes it.
//!
//! d ln ρ = d ln ρ₀ − (w,dγ) on |γ| = 1, where ρ₀ = det Ĩ (γ,Ĩ⁻¹γ) D_T, or det Ĩ D_T with spin, and w is the covector of
//! the criterion (BMB 2013, (2.6); (2.20) on the sphere). It is integrated along the equator from
//! e₁, and from there along meridians.

use std::f64::consts::PI;

use num_traits::Zero;
use serde::Serialize;

use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::{Phase, System};
use liouville::number::float::Float;
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::scalar::Scalar;
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
pub(super) struct BodyOnSphere {
    contact: Tape,
    reference: Tape,
    criterion: Tape,
    covector: Tape,
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
            rows.order_by(|a, b| latitudes[*a].abs().total_cmp(&latitudes[*b].abs()));
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

impl BodyOnSphere {
    /// Takes the body with the parameters of the first state; `None` for a case without a body, or
    /// with further variables.
    pub fn first(case: &Case, options: &Options) -> Result<Option<(Self, Parameters)>, JudgeError> {
        let model = &case.model;
        let Some(body) = model.system.body().filter(|_| model.extension.is_empty()) else {
            return Ok(None);
        };
        let printed = Sampler::new(case, &LevelSubset::level(model), options.seed)?
            .printed(0, f64::MANTISSA_DIGITS);
        let mut rest = printed.as_slice();
        let shown = model.free_parameters().map(|parameter| {
            let (own, others) = rest.split_at(liouville::mechanics::components(parameter.kind));
            rest = others;
            (parameter.name.clone(), parameter.kind.as_setting(own))
        });
        let shown = shown.collect();
        let numbers = &printed[..model.free_components()];
        let tape = |read: &dyn Fn(&Phase<'_, Expr>) -> Vec<Expr>| -> Result<Tape, JudgeError> {
            let number = |text: &String| match text.parse::<Rational>() {
                Ok(value) => Expr::rational(&value),
                Err(_) => Expr::undefined(),
            };
            let (graph, values) = record(3, |gamma| {
                let parameters: Vec<Expr> = numbers.iter().map(number).collect();
                let state = [&[Expr::zero(); 3], gamma].concat();
                read(&Phase::new(model, &parameters, &state))
            })?;
            Ok(Tape::new(&graph, &values))
        };
        let system = &model.system;
        let own = Self {
            contact: tape(&|at| body.shape.contact(&at.configuration).0.as_slice().to_vec())?,
            reference: tape(&|at| Vec::from_iter(system.reference_density(&at.configuration)))?,
            criterion: tape(&|at| Vec::from_iter(system.criterion(at).first().copied()))?,
            covector: tape(&|at| system.criterion_covector(at).unwrap_or_default())?,
        };
        Ok(Some((own, shown)))
    }

    /// Computes the point of contact r.
    pub fn contact(&self, gamma: [f64; 3]) -> [f64; 3] {
        values(&self.contact, gamma)
    }

    /// Computes ρ₀.
    fn reference(&self, gamma: [f64; 3]) -> f64 {
        let [density] = values(&self.reference, gamma);
        density
    }

    fn criterion(&self, gamma: [f64; 3]) -> f64 {
        let [criterion] = values(&self.criterion, gamma);
        criterion
    }

    /// Computes ∫ (w,dγ) along a path with parameter 0 ≤ t ≤ 1.
    fn work(&self, path: impl Fn(f64) -> [f64; 3]) -> f64 {
        let mut sum = 0.0;
        for (node, weight) in NODES {
            let (t, small) = ((node + 1.0) / 2.0, 1e-4);
            // Central differences on a circle: an error of 1e-9 of the step's length.
            let (before, after) = (path(t - small), path(t + small));
            let covector: [f64; 3] = values(&self.covector, path(t));
            let along: f64 =
                (0..3).map(|k| covector[k] * (after[k] - before[k]) / (2.0 * small)).sum();
            sum += weight * along / 2.0;
        }
        sum
    }
}

/// Evaluates a tape at a point; what it does not compute is NaN.
fn values<const N: usize>(tape: &Tape, gamma: [f64; 3]) -> [f64; N] {
    let mut evaluator = Evaluator::new(tape, Float::<1>);
    evaluator.run(&gamma.map(|x| [x]));
    let mut outputs = evaluator.outputs();
    std::array::from_fn(|_| outputs.next().map_or(f64::NAN, |block| block[0]))
}
