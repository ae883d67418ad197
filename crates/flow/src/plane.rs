//! Classification of motions over a plane of two parameters, energies, or starts on a section.

use super::andoyer::Sphere;
use super::error::FlowError;
use super::lyapunov::Exponents;
use super::motion::Loose;
use super::shadow::{Begin, Shadowed};
use super::start::{Level, Start, fixed_parameters};
use liouville::case::{Angle, Case};
use liouville::formula::Type;
use liouville::mechanics::{Draw, Model, Origin, Range, Recipe, components};
use liouville::number::pair::Pair;
use liouville::number::rational::Rational;

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

/// One axis of the plane.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Quantity along the axis.
    pub coordinate: Coordinate,
    /// Lower end.
    pub from: Rational,
    /// Upper end.
    pub to: Rational,
    /// Number of points; the first and the last are half a step inside.
    pub count: usize,
}

impl Axis {
    /// Position of a point, between -1 and 1.
    fn place(&self, index: usize) -> Rational {
        Rational::new(2 * index as i64 + 1 - self.count as i64, self.count as i64)
    }

    /// Component of the free parameters that varies along the axis, given the offset of each
    /// parameter.
    fn loose(&self, places: &[usize]) -> Option<Loose> {
        let Coordinate::Parameter { index, component } = self.coordinate else { return None };
        let half = Rational::new(1, 2);
        Some(Loose {
            component: places[index] + component,
            centre: &(&self.from + &self.to) * &half,
            half: &(&self.to - &self.from) * &half,
        })
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
    pub axes: [Axis; 2],
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
    let Free { model, parameters, places } = Free::new(case, request)?;
    let model = &model;
    let [across, up] = &request.axes;
    let loose: Vec<Loose> = request.axes.iter().filter_map(|axis| axis.loose(&places)).collect();
    let equations = Shadowed::new(model, &parameters, &loose)?;
    let launcher = Launcher::new(case, model, request, &parameters, &loose)?;
    let points = (0..up.count).flat_map(|row| (0..across.count).map(move |column| [column, row]));
    let begins: Vec<Result<Begin, FlowError>> =
        points.map(|at| launcher.begin(equations.level(), at)).collect();
    Ok(equations.follow(&begins, request.time, threads, progress))
}

/// Model in which the varied parameters are free.
struct Free {
    model: Model,
    /// Components of all free parameters.
    parameters: Vec<Rational>,
    /// Offset of each parameter in the components.
    places: Vec<usize>,
}

impl Free {
    fn new(case: &Case, request: &PlaneRequest) -> Result<Self, FlowError> {
        let drawn = fixed_parameters(case, request.seed, 0)?;
        let mut drawn = drawn.as_slice();
        let mut model = case.model.clone();
        let varies = |wanted: usize| {
            let is_it = |axis: &Axis| matches!(axis.coordinate, Coordinate::Parameter { index, .. } if index == wanted);
            request.axes.iter().any(is_it)
        };
        let (mut parameters, mut places) = (Vec::new(), Vec::new());
        for (index, parameter) in model.parameters.iter_mut().enumerate() {
            places.push(parameters.len());
            match &parameter.origin {
                Origin::Free(_) => {
                    let (own, others) = drawn.split_at(components(parameter.kind));
                    parameters.extend_from_slice(own);
                    drawn = others;
                }
                Origin::Fixed(values) if varies(index) => {
                    parameters.extend_from_slice(values);
                    parameter.origin = Origin::Free(open(parameter.kind));
                }
                Origin::Fixed(_) | Origin::Formula(_) => {}
            }
        }
        Ok(Self { model, parameters, places })
    }
}

/// Recipe that admits any value of a type; nothing is drawn from it.
fn open(kind: Type) -> Recipe {
    let draw = Draw::Within(Range { low: Rational::from(-1), high: Rational::from(1) });
    match kind {
        Type::Scalar => Recipe::Scalar(draw),
        Type::Vector(length) => Recipe::Vector(length, draw),
        Type::Matrix(rows, columns) => Recipe::Matrix(rows, columns, draw),
    }
}

/// Source of the starts of a plane.
struct Launcher<'r> {
    axes: &'r [Axis; 2],
    source: Source,
}

enum Source {
    Sphere { sphere: Sphere, at: [f64; 2], energy: Pair },
    State(Vec<Pair>),
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
            Launch::Section { g0, energy, at } => Source::Sphere {
                sphere: Sphere::new(model, parameters, loose, g0)?,
                at: *at,
                energy: Pair::from_rational(energy),
            },
            Launch::State(state) => {
                Source::State(Start::new(case, state.as_deref(), request.seed, 0)?.state)
            }
        };
        Ok(Self { axes: &request.axes, source })
    }

    /// Returns the start at a point of the plane.
    fn begin(&self, level: &Level, at: [usize; 2]) -> Result<Begin, FlowError> {
        let axes = || self.axes.iter().zip(at);
        let is_loose = |axis: &Axis| matches!(axis.coordinate, Coordinate::Parameter { .. });
        let loose: Vec<Pair> = axes()
            .filter(|(axis, _)| is_loose(axis))
            .map(|(axis, index)| Pair::from_rational(&axis.place(index)))
            .collect();
        let state = match &self.source {
            Source::Sphere { sphere, at, energy } => {
                let (mut at, mut energy) = (*at, *energy);
                for (axis, index) in axes() {
                    let value = Pair::from_rational(&axis.value(index));
                    match axis.coordinate {
                        Coordinate::L => at[0] = value.hi,
                        Coordinate::Z => at[1] = value.hi,
                        Coordinate::Energy => energy = value,
                        Coordinate::Parameter { .. } => {}
                    }
                }
                sphere.state(at.map(Pair::from_f64), energy, &loose)?
            }
            Source::State(state) => {
                let mut state = state.clone();
                level.correct(&mut state, &loose)?;
                state
            }
        };
        Ok(Begin { state, loose })
    }
}
