//! Loss of digits in f64.

use super::{Scenario, StressError, SweptPart};
use liouville::claim::LevelSubset;
use liouville::graph::{Evaluator, Tape, record};
use liouville::mechanics::calculus::DualPoint;
use liouville::mechanics::{Model, Phase};
use liouville::number::Domain;
use liouville::number::arb::{Approximation, ArbBall};
use liouville::number::float::Float;
use liouville::number::rational::Rational;
use liouville::verdict::{JudgeError, Sampler};

/// Bits of the reference: 77 digits.
const REFERENCE_BITS: u32 = 256;
/// Number of states compared.
const STATES: u64 = 8;

/// Decimal digits lost at the worst state, of the 16 of f64.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Loss {
    /// Loss of the field: |Δv|/|v|.
    pub field: f64,
    /// Loss of the residuals of all claims: |ΔR| over the residual's scale.
    pub residual: f64,
}

/// Measures the digits that f64 loses at x = 10^exponent.
pub fn digits_lost(scenario: &Scenario, exponent: i32, seed: u64) -> Result<Loss, StressError> {
    let case = scenario.case(exponent, seed)?;
    let model = &case.model;
    let level = LevelSubset::level(model);
    let sampler = Sampler::new(&case, &level, seed).map_err(JudgeError::from)?;
    let (mut field, mut residuals, mut scales) = (Vec::new(), Vec::new(), Vec::new());
    let inputs = model.free_components() + model.dimension();
    let (graph, outputs) = record(inputs, |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        let jet = DualPoint::new(Phase::new(model, parameters, state));
        field.extend_from_slice(jet.phase.field());
        for claim in &case.claims {
            let residual = claim.kind.residual(&jet, &claim.place.kept);
            let scale = claim.kind.context(&jet, &claim.place.kept).scale;
            if let ([residual], Some(scale)) = (residual.as_slice(), scale) {
                residuals.push(*residual);
                scales.push(scale);
            }
        }
        [&field[..], &residuals, &scales].concat()
    })
    .map_err(JudgeError::from)?;
    let tape = Tape::new(&graph, &outputs);
    let (fields, claims) = (field.len(), residuals.len());
    let mut loss = Loss { field: 0.0, residual: 0.0 };
    for index in 0..STATES {
        let Some(point) = point(scenario, exponent, &sampler, model, index) else { continue };
        // Antiderivatives are free: any number serves, the same for both.
        let extra = graph.inputs() - point.len();
        let exact: Vec<Rational> =
            point.into_iter().chain((0..extra).map(|_| Rational::new(1, 3))).collect();
        let floats: Vec<[f64; 1]> = exact.iter().map(|x| [x.to_f64().0]).collect();
        let domain = ArbBall::new(REFERENCE_BITS);
        let seen: Option<Vec<_>> =
            floats.iter().map(|x| Some(domain.constant(&Rational::from_f64(x[0])?))).collect();
        let Some(seen) = seen else { continue };
        let near = run(&tape, Float::<1>, &floats);
        let far = run(&tape, domain, &seen);
        let Some(far) = far.into_iter().collect::<Option<Vec<Approximation>>>() else { continue };
        let distance = |k: usize| far[k].distance(near[k][0]);
        let size = |k: usize| far[k].enclosure().0.abs();
        let norm = |f: &dyn Fn(usize) -> f64| (0..fields).map(|k| f(k).powi(2)).sum::<f64>().sqrt();
        loss.field = loss.field.max(lost(norm(&distance), norm(&size)));
        for k in 0..claims {
            let scale = size(fields + claims + k).sqrt();
            loss.residual = loss.residual.max(lost(distance(fields + k), scale));
        }
    }
    Ok(loss)
}

/// Returns log₁₀ of a relative error in units of rounding, at least 0 and at most all digits.
fn lost(error: f64, size: f64) -> f64 {
    if error == 0.0 {
        return 0.0;
    }
    (error / size / (f64::EPSILON / 2.0)).log10().clamp(0.0, 16.0)
}

/// Parameters and state of state `index`; `None` where they are not representable.
fn point(
    scenario: &Scenario,
    exponent: i32,
    sampler: &Sampler,
    model: &Model,
    index: u64,
) -> Option<Vec<Rational>> {
    let numbers = sampler.exact(index);
    let mut point = numbers.into_iter().collect::<Option<Vec<Rational>>>()?;
    if let SweptPart::State(factors) = scenario.sweep {
        let [along_u, along_v, along_omega] = factors(10f64.powi(exponent));
        let state = model.free_components();
        let [w1, w2, w3, x, y, z] = point.get(state..)? else { return None };
        // Back from γ to (u, v) = (γ₁, γ₂)/(1 + γ₃), and from ω to a = ω×γ, as ω = γ×(ω×γ).
        let float = |q: &Rational| q.to_f64().0;
        let gamma = [float(x), float(y), float(z)];
        let omega = [float(w1), float(w2), float(w3)];
        let (u, v) = (gamma[0] / (1.0 + gamma[2]) * along_u, gamma[1] / (1.0 + gamma[2]) * along_v);
        let square = u * u + v * v;
        let moved = [2.0 * u, 2.0 * v, 1.0 - square].map(|x| x / (1.0 + square));
        let arm = cross(&omega, &gamma);
        let turned = cross(&moved, &arm).map(|x| x * along_omega);
        let made: Option<Vec<Rational>> =
            turned.iter().chain(&moved).map(|x| Rational::from_f64(*x)).collect();
        point.splice(state.., made?);
    }
    Some(point)
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn run<D: Domain>(tape: &Tape, domain: D, inputs: &[D::Block]) -> Vec<D::Block> {
    let mut evaluator = Evaluator::new(tape, domain);
    evaluator.run(inputs);
    evaluator.outputs().cloned().collect()
}
