//! Classification of motions over a plane of two parameters, energies, or starts on a section.

use super::andoyer::Sphere;
use super::error::FlowError;
use super::lyapunov::Exponents;
use super::motion::Loose;
use super::open::OpenModel;
use super::shadow::{ShadowStart, Shadowed};
use super::start::{LevelFunctions, Start, fixed_parameters, two_sided};
use liouville::case::{Angle, Case};
use liouville::mechanics::Model;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;
use liouville::part::Part;

/// Quantity that varies along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// Component of a parameter of the case.
    Parameter {
        /// Index of the parameter in the model.
        index: usize,
        /// Index of its component, row by row.
        component: usize,
    },
    /// Coordinate l of the start on the section.
    L,
    /// Coordinate L/G of the start on the section.
    Z,
    /// Energy of the start on the section.
    Energy,
}

impl Coordinate {
    /// Index of the parameter and of its component, if it is one.
    pub(super) fn parameter(self) -> Option<(usize, usize)> {
        match self {
            Coordinate::Parameter { index, component } => Some((index, component)),
            _ => None,
        }
    }
}

/// One axis of the plane.
#[derive(Clone, Debug)]
pub struct ChartAxis {
    /// Quantity along the axis.
    pub coordinate: Coordinate,
    /// Lower end.
    pub from: Rational,
    /// Upper end.
    pub to: Rational,
    /// Number of points; the first and the last are half a step inside.
    pub count: usize,
}

impl ChartAxis {
    /// Position of a point, between -1 and 1.
    fn place(&self, index: usize) -> Rational {
        Rational::new(2 * index as i64 + 1 - self.count as i64, self.count as i64)
    }

    /// Component of the free parameters that varies along the axis, given the offset of each
    /// parameter.
    fn loose(&self, model: &Model, places: &[usize]) -> Option<Loose> {
        let (index, component) = self.coordinate.parameter()?;
        Some(Loose::within(model, [index, component], places[index], [&self.from, &self.to]))
    }

    /// Value at a point of the axis.
    pub fn value(&self, index: usize) -> Rational {
        let share = Rational::new(2 * index as i64 + 1, 2 * self.count as i64);
        &self.from + &(&(&self.to - &self.from) * &share)
    }
}

/// Starts of the motions of a plane, as far as the axes leave them open.
#[derive(Clone, Debug)]
pub enum Launch {
    /// On the section g = g₀.
    Section {
        /// Angle g₀ of the section.
        g0: Angle,
        /// Energy of the motions.
        energy: Rational,
        /// Coordinates l and L/G.
        at: [f64; 2],
    },
    /// At a given state moved to the level set, or at a drawn one.
    State(Option<Vec<Rational>>),
}

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
    progress: &(dyn Fn() + Sync),
) -> Result<Vec<Result<Exponents, FlowError>>, FlowError> {
    plane_part(case, request, Part::WHOLE, threads, progress)
}

/// Classifies a part of the motions of a plane, each with the same bits as among all of them.
pub fn plane_part(
    case: &Case,
    request: &PlaneRequest,
    part: Part,
    threads: usize,
    progress: &(dyn Fn() + Sync),
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
