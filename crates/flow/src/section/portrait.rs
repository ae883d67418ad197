//! A default section of a body's motion: an energy at which the body can turn to any side, and
//! starts spread over the sphere.

use crate::error::FlowError;
use crate::motion::recorded::point;
use crate::motion::start::fixed_parameters;
use crate::section::andoyer::{applies, spread};
use crate::section::rolling::{SectionOrbit, SectionRequest, section};
use liouville::case::{Angle, Case, Direction};
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::number::float::Float;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Numbers of orbits, and of crossings of each.
const ORBITS: usize = 24;
const CROSSINGS: usize = 120;
/// Number of directions in which the potential is evaluated.
const DIRECTIONS: usize = 400;
/// Excess of the energy over the largest potential, relative to the potential's range.
const ABOVE: f64 = 0.25;

/// A section with its request.
pub struct Portrait {
    /// Request of the section.
    pub request: SectionRequest,
    /// Orbits of the section.
    pub orbits: Vec<SectionOrbit>,
    /// Whether parameters are drawn at random.
    pub is_drawn: bool,
}

/// Computes the section of the case, or one of few orbits at an energy above the potential.
pub fn portrait(case: &Case, seed: u64, threads: usize) -> Result<Portrait, FlowError> {
    if !applies(&case.model) {
        return Err(FlowError::NoAndoyer);
    }
    if case.model.system.has_arbitrary_function() {
        return Err(FlowError::Arbitrary);
    }
    let (g0, energy) = match &case.section {
        Some(plan) => (plan.g0.clone(), plan.energy.clone()),
        None => (Angle::QuarterTurns(2), energy(case, seed)?),
    };
    let request = SectionRequest {
        g0,
        energy,
        direction: Direction::Both,
        crossings: CROSSINGS,
        skip: 0,
        starts: spread(ORBITS),
        backwards: false,
        seed,
        index: 0,
    };
    let orbits = section(case, &request, threads, &|_| ())?;
    let problem = orbits.iter().find_map(|orbit| orbit.problem.clone());
    match problem {
        Some(problem) if orbits.iter().all(|orbit| orbit.crossings.is_empty()) => Err(problem),
        _ => Ok(Portrait { request, orbits, is_drawn: case.model.free_components() > 0 }),
    }
}

/// Returns an energy somewhat above the largest value of the potential; 1 without a potential.
fn energy(case: &Case, seed: u64) -> Result<Rational, FlowError> {
    let parameters = fixed_parameters(case, seed, 0)?;
    let (graph, potential) = record(3, |gamma| {
        let zero = Expr::rational(&Rational::from(0));
        let state = [[zero; 3].as_slice(), gamma].concat();
        case.model.system.energy(&point(&case.model, &parameters, &state)).unwrap_or(zero)
    })?;
    let tape = Tape::new(&graph, &[potential]);
    let mut evaluator = Evaluator::new(&tape, Float::<1>);
    let mut at = |[angle, z]: [f64; 2]| {
        let s = (1.0 - z * z).sqrt();
        evaluator.run(&[[s * libm::sin(angle)], [s * libm::cos(angle)], [z]]);
        evaluator.output(0)[0]
    };
    let values: Vec<f64> = spread(DIRECTIONS).into_iter().map(&mut at).collect();
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let is_level = high - low <= f64::EPSILON * high.abs();
    let above = if is_level { high + 1.0 } else { high + ABOVE * (high - low) };
    // Two digits are enough, rounded up.
    let exponent = libm::floor(libm::log10(above.abs().max(1e-300))) - 1.0;
    let count = libm::ceil(above / libm::pow(10.0, exponent));
    // exact, so that it prints as a short decimal
    format!("{count:.0}e{exponent:.0}").parse().map_err(|_| FlowError::NoStart)
}
