//! Invariance of the area form of a claimed density under the section map.
//!
//! The Andoyer variables are canonical on |γ| = 1, (ω,γ) = 0 up to a constant: the volume there is
//! dL∧dG∧dl∧dg. With z = L/G and E = G²T + U a density ρ gives the area form ρ |g'|/(2T) dl∧dz on a
//! section g = g₀ of a level of the energy. The map Φ preserves it where |det dΦ| takes the factor
//! at x to that at Φ(x).

use crate::closed::periodic::{End, SectionMap};
use crate::error::FlowError;
use crate::motion::recorded::point;
use crate::motion::start::fixed_parameters;
use crate::section::rolling::SectionRequest;
use liouville::case::{Case, Expect};
use liouville::claim::ClaimKind;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Number of starts at which the area form is tested.
const AREA_STARTS: usize = 12;
/// Smallest deviation of a factor from 1 that counts, in errors of the derivative.
const ERRORS: f64 = 10.0;
/// Distances of the finite differences, relative to the widest.
const SCALES: [f64; 4] = [1.0, 0.25, 0.0625, 0.015625];
/// Lower bound on the relative error of a finite difference, due to rounding.
const ROUNDING: f64 = 1e-9;

/// Test of the area form of one claimed density.
#[derive(Clone, Debug, PartialEq)]
pub struct AreaForm {
    /// Name of the claim.
    pub claim: String,
    /// Number of points tested.
    pub points: usize,
    /// Largest |J - 1|, where J is the factor by which the area grows over one return.
    pub deviation: f64,
    /// Error of J there, estimated from two derivatives.
    pub error: f64,
    /// First point where the deviation exceeds the error, if any.
    pub broken: Option<[f64; 2]>,
}

/// Tests the area forms of all densities that a case claims to hold, at some starts of a section.
pub fn area_forms(case: &Case, request: &SectionRequest) -> Result<Vec<AreaForm>, FlowError> {
    let densities: Vec<_> = case
        .claims
        .iter()
        .filter(|claim| claim.expect == Expect::Holds)
        .filter_map(|claim| match &claim.kind {
            ClaimKind::Density(density) => Some((&claim.name, &density.0)),
            _ => None,
        })
        .filter(|(_, formula)| !case.model.has_antiderivative(formula))
        .collect();
    if densities.is_empty() {
        return Ok(Vec::new());
    }
    let parameters = fixed_parameters(case, request.seed, request.index)?;
    // ρ/T for each density.
    let (graph, weights) = record(case.model.dimension(), |state| {
        let at = point(&case.model, &parameters, state);
        let (omega, gamma) = state.split_at(3);
        let square = omega.iter().map(|x| *x * *x).sum::<Expr>();
        let rest = [[Expr::rational(&Rational::from(0)); 3].as_slice(), gamma].concat();
        let resting = point(&case.model, &parameters, &rest);
        let system = &case.model.system;
        let kinetic = system
            .energy(&at)
            .zip(system.energy(&resting))
            .map(|(all, potential)| (all - potential) / square);
        let density = |formula| kinetic.map(|kinetic| at.scalar(formula) / kinetic);
        densities.iter().filter_map(|(_, formula)| density(*formula)).collect::<Vec<_>>()
    })?;
    let map = SectionMap::new(case, &request.g0, &request.energy, request.seed)?;
    let tape = Tape::new(&graph, &weights);
    let mut seen: Vec<AreaForm> = densities
        .iter()
        .map(|(name, _)| AreaForm {
            claim: name.to_string(),
            points: 0,
            deviation: 0.0,
            error: 0.0,
            broken: None,
        })
        .collect();
    for at in request.starts.iter().take(AREA_STARTS) {
        let Ok(factors) = factors(&map, &tape, *at) else { continue };
        for (form, (factor, error)) in seen.iter_mut().zip(factors) {
            let deviation = (factor - 1.0).abs();
            if !deviation.is_finite() {
                continue;
            }
            form.points += 1;
            if deviation > ERRORS * error {
                form.broken = form.broken.or(Some(*at));
            }
            if deviation >= form.deviation {
                (form.deviation, form.error) = (deviation, error);
            }
        }
    }
    Ok(seen)
}

/// Factors of the area forms over one return, with their errors.
fn factors(map: &SectionMap<'_>, tape: &Tape, at: [f64; 2]) -> Result<Vec<(f64, f64)>, FlowError> {
    let passage = map.passage(at, 1)?;
    let weights = |end: &End| {
        let mut evaluator = Evaluator::new(tape, DoubleDoubles);
        evaluator.run(&end.state);
        let values: Vec<DoubleDouble> = evaluator.outputs().copied().collect();
        values.into_iter().map(|weight| (weight.hi * end.rate).abs()).collect::<Vec<f64>>()
    };
    let determinant = |scale: f64| {
        let [[a, b], [c, d]] = map.derivative(at, 1, scale)?;
        Ok::<_, FlowError>((a * d - b * c).abs())
    };
    // Truncation shrinks with the distance and rounding grows: the two that agree best are right.
    let tried = SCALES.iter().map(|scale| determinant(*scale)).collect::<Result<Vec<_>, _>>()?;
    let apart = |pair: &[f64]| (pair[0] / pair[1] - 1.0).abs();
    let best = tried.windows(2).min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(&[1.0, 1.0]);
    let (fine, relative) = (best[1], apart(best).max(ROUNDING));
    let (before, after) = (weights(&passage.departure), weights(&passage.arrival));
    Ok(before
        .into_iter()
        .zip(after)
        .map(|(x, y)| (fine * y / x, relative * fine * y / x))
        .collect())
}
