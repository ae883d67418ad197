//! Poincaré sections of rolling bodies, g = g₀ in the Andoyer-like variables.

use serde::{Deserialize, Serialize};

use crate::error::FlowError;
use crate::motion::orbit::energy_drift;
use crate::motion::recorded::{point, program};
use crate::motion::start::{Start, fixed_parameters, two_sided};
use crate::section::andoyer::{SectionChart, applies, coordinates, section_functions};
use crate::section::crossings::{CrossingTask, Met, MotionCrossings};
use liouville::case::{Angle, Case, Direction};
use liouville::graph::{Evaluator, Tape, record};
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use liouville::number::rational::Rational;

/// Start of an orbit, or the reason why there is none.
type Launched = Result<Start, FlowError>;

/// Request for a section.
#[derive(Clone, Debug)]
pub struct SectionRequest {
    /// Angle g₀ of the section.
    pub g0: Angle,
    /// Energy of the orbits.
    pub energy: Rational,
    /// Direction of the crossings that count.
    pub direction: Direction,
    /// Number of crossings to collect for each orbit.
    pub crossings: usize,
    /// Number of crossings left out at the beginning.
    pub skip: usize,
    /// Starts of the orbits: (l, L/G).
    pub starts: Vec<[f64; 2]>,
    /// Whether to follow the orbits backwards in time.
    pub backwards: bool,
    /// Seed of the free parameters.
    pub seed: u64,
    /// Index of the free parameters among the draws.
    pub index: u64,
}

/// A crossing of the section.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Crossing {
    /// Position: l and L/G.
    #[serde(with = "crate::record")]
    pub at: [f64; 2],
    /// Time of the crossing.
    #[serde(with = "crate::record")]
    pub time: f64,
    /// Whether g grows with time there.
    pub rising: bool,
}

/// Crossings of one orbit.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SectionOrbit {
    /// Start of the orbit.
    #[serde(with = "crate::record")]
    pub start: [f64; 2],
    /// Crossings that count, without those at the beginning.
    pub crossings: Vec<Crossing>,
    /// Number of crossings in the other direction, which are not drawn.
    pub others: usize,
    /// Number of points where the orbit touches the section without crossing it.
    pub tangencies: usize,
    /// Number of steps taken.
    pub steps: u64,
    /// Relative change of the energy between start and end.
    #[serde(with = "crate::record")]
    pub drift: f64,
    /// Reason why the orbit ended early, or did not start.
    pub problem: Option<FlowError>,
}

/// Computes the section of a case: one entry for each start, in their order. Calls `progress` after
/// each orbit.
pub fn section(
    case: &Case,
    request: &SectionRequest,
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<SectionOrbit>, FlowError> {
    two_sided(case)?;
    if !applies(&case.model) {
        return Err(FlowError::NoAndoyer);
    }
    let parameters = fixed_parameters(case, request.seed, request.index)?;
    let program =
        program(&case.model, &parameters, |phase| section_functions(phase, &request.g0).to_vec())?;
    let chart = SectionChart::new(&case.model, &parameters, &request.g0, &request.energy)?;
    let starts: Vec<Result<Start, FlowError>> =
        request.starts.iter().map(|at| chart.start(*at)).collect();
    let task = CrossingTask {
        program: &program,
        starts: &starts,
        direction: request.direction,
        crossings: request.crossings,
        skip: request.skip,
        backwards: request.backwards,
        // The other half of the circle is g = g₀ + π, where g' has the other sign too.
        has_side: true,
    };
    let tracks = task.run(
        threads,
        &|| |_: DoubleDouble, state: &[DoubleDouble]| coordinates(state),
        progress,
    );
    let orbit = |((track, start), at): ((MotionCrossings<[f64; 2]>, &Launched), &[f64; 2])| {
        let drift = match (start, &track.end) {
            (Ok(start), Some(end)) => energy_drift(&case.model, start, end)?,
            _ => 0.0,
        };
        let crossings = track.crossings.into_iter();
        let crossing = |met: Met<_>| Crossing { at: met.at, time: met.time, rising: met.rising };
        Ok(SectionOrbit {
            start: *at,
            crossings: crossings.map(crossing).collect(),
            others: track.others,
            tangencies: track.tangencies,
            steps: track.steps,
            drift,
            problem: track.problem,
        })
    };
    tracks.into_iter().zip(&starts).zip(&request.starts).map(orbit).collect()
}

/// Returns the states over points (l, L/G) of a section.
pub fn section_starts(
    case: &Case,
    g0: &Angle,
    energy: &Rational,
    points: &[[f64; 2]],
    seed: u64,
) -> Result<Vec<Result<Start, FlowError>>, FlowError> {
    if !applies(&case.model) {
        return Err(FlowError::NoAndoyer);
    }
    let parameters = fixed_parameters(case, seed, 0)?;
    let chart = SectionChart::new(&case.model, &parameters, g0, energy)?;
    Ok(points.iter().map(|at| chart.start(*at)).collect())
}

/// Evaluates a claim's formula at each start; NaN where there is no state.
pub fn values_at_starts(
    case: &Case,
    request: &SectionRequest,
    claim: &str,
) -> Result<Vec<f64>, FlowError> {
    let formula = case.claim(claim).and_then(|claim| claim.kind.formula());
    let formula = formula.ok_or_else(|| FlowError::NoSuchClaim(claim.to_string()))?;
    let parameters = fixed_parameters(case, request.seed, request.index)?;
    let chart = SectionChart::new(&case.model, &parameters, &request.g0, &request.energy)?;
    let (graph, values) = record(case.model.dimension(), |state| {
        point(&case.model, &parameters, state).evaluate(formula).components()
    })?;
    let tape = Tape::new(&graph, &values[..1]);
    let mut evaluator = Evaluator::new(&tape, DoubleDoubles);
    let mut at = |start: Start| {
        evaluator.run(&start.state);
        evaluator.output(0).hi
    };
    Ok(request.starts.iter().map(|l_z| chart.start(*l_z).map_or(f64::NAN, &mut at)).collect())
}
