//! Classification of motions over a plane of two parameters, energies, or starts on a section.

use crate::chaos::shadow::{ShadowStart, Shadowed};
use crate::error::FlowError;
use crate::motion::lyapunov::Exponents;
use crate::motion::open::OpenModel;
use crate::motion::recorded::Loose;
use crate::motion::start::{LevelFunctions, Start, fixed_parameters, two_sided};
use crate::section::andoyer::Sphere;
use crate::section::coordinate::{ChartAxis, Coordinate, Launch};
use liouville::case::Case;
use liouville::mechanics::Model;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;
use liouville::part::Part;

/// Request for a plane of motions.
#[derive(Clone, Debug)]
pub struct PlaneRequest {
    /// Horizontal and vertical axis.
    pub axes: [ChartAxis; 2],
    /// Starts of the motions.
    pub launch: Launch,
    /// Time for which each motion is followed; negative for backwards.
    pub time: f64,
    /// Seed of the random draws.
    pub seed: u64,
}

/// Classifies the motions of a plane, row by row from the least value of the second axis.
///
/// A motion that cannot start, or runs into a singularity, yields its error.
pub fn plane(
    case: &Case,
    request: &PlaneRequest,
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<Result<Exponents, FlowError>>, FlowError> {
    plane_part(case, request, Part::WHOLE, threads, progress)
}

/// Classifies a part of the motions of a plane, each with the same bits as among all of them.
pub fn plane_part(
    case: &Case,
    request: &PlaneRequest,
    part: Part,
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<Result<Exponents, FlowError>>, FlowError> {
    two_sided(case)?;
    let indices = request.axes.iter().filter_map(|axis| axis.coordinate.parameter());
    let indices: Vec<usize> = indices.map(|(index, _)| index).collect();
    let drawn = fixed_parameters(case, request.seed, 0)?;
    let OpenModel { model, parameters, places } = OpenModel::new(&case.model, &drawn, &indices);
    let model = &model;
    let [across, up] = &request.axes;
    let loose: Vec<Loose> =
        request.axes.iter().filter_map(|axis| axis.loose(&case.model, &places)).collect();
    let equations = Shadowed::new(model, &parameters, &loose)?;
    let launcher = Launcher::new(case, model, request, &parameters, &loose)?;
    let cells = part.range((across.count * up.count) as u64);
    let points = cells.map(|cell| cell as usize).map(|k| [k % across.count, k / across.count]);
    let begins: Vec<Result<ShadowStart, FlowError>> =
        points.map(|at| launcher.begin(equations.level(), at)).collect();
    Ok(equations.follow(&begins, request.time, threads, progress))
}

/// Source of the starts of a plane.
struct Launcher<'r> {
    axes: &'r [ChartAxis; 2],
    source: AxisSource,
}

enum AxisSource {
    Sphere { sphere: Sphere, at: [f64; 2], energy: DoubleDouble },
    State(Vec<DoubleDouble>),
}

impl<'r> Launcher<'r> {
    fn new(
        case: &Case,
        model: &Model,
        request: &'r PlaneRequest,
        parameters: &[Rational],
        loose: &[Loose],
    ) -> Result<Self, FlowError> {
        let source = match &request.launch {
            Launch::Section { g0, energy, at } => AxisSource::Sphere {
                sphere: Sphere::new(model, parameters, loose, g0)?,
                at: *at,
                energy: DoubleDouble::from_rational(energy),
            },
            Launch::State(state) => {
                AxisSource::State(Start::new(case, state.as_deref(), request.seed, 0)?.state)
            }
        };
        Ok(Self { axes: &request.axes, source })
    }

    /// Returns the start at a point of the plane.
    fn begin(&self, level: &LevelFunctions, at: [usize; 2]) -> Result<ShadowStart, FlowError> {
        let axes = || self.axes.iter().zip(at);
        let is_loose = |axis: &ChartAxis| matches!(axis.coordinate, Coordinate::Parameter { .. });
        let loose: Vec<DoubleDouble> = axes()
            .filter(|(axis, _)| is_loose(axis))
            .map(|(axis, index)| DoubleDouble::from_rational(&axis.place(index)))
            .collect();
        let state = match &self.source {
            AxisSource::Sphere { sphere, at, energy } => {
                let (mut at, mut energy) = (*at, *energy);
                for (axis, index) in axes() {
                    let value = DoubleDouble::from_rational(&axis.value(index));
                    match axis.coordinate {
                        Coordinate::L => at[0] = value.hi,
                        Coordinate::Z => at[1] = value.hi,
                        Coordinate::Energy => energy = value,
                        Coordinate::Integral(_) => {}
                        Coordinate::Parameter { .. } => {}
                    }
                }
                sphere.state(at.map(DoubleDouble::from_f64), energy, &loose)?
            }
            AxisSource::State(state) => {
                let mut state = state.clone();
                level.correct(&mut state, &loose)?;
                state
            }
        };
        Ok(ShadowStart { state, loose })
    }
}
