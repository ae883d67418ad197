//! A plane of motions, each classified: two of the parameters, the energy, or the start on a section.

use super::andoyer::Sphere;
use super::error::FlowError;
use super::lyapunov::Exponents;
use super::motion::Loose;
use super::shadow::{Begin, Shadowed};
use super::start::{Level, Start, fixed_parameters};
use crate::case::{Angle, Case};
use crate::formula::Type;
use crate::mechanics::{Draw, Model, Origin, Range, Recipe, components};
use crate::number::pair::Pair;
use crate::number::rational::Rational;

/// What varies along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// A component of a parameter of the case.
    Parameter {
        /// Which of the model's parameters.
        index: usize,
        /// Which of its components, row by row.
        component: usize,
    },
    /// l of the start on the section.
    L,
    /// L/G of the start on the section.
    Z,
    /// The energy of the start on the section.
    Energy,
}

/// One axis of the plane.
#[derive(Clone, Debug)]
pub struct Axis {
    /// What varies.
    pub coordinate: Coordinate,
    /// Where it begins.
    pub from: Rational,
    /// Where it ends.
    pub to: Rational,
    /// How many points; the first and the last are half a step inside.
    pub count: usize,
}

impl Axis {
    /// The place of a point between -1 and 1.
    fn place(&self, index: usize) -> Rational {
        Rational::new(2 * index as i64 + 1 - self.count as i64, self.count as i64)
    }

    /// The component of the free parameters that varies, where each parameter's begin.
    fn loose(&self, places: &[usize]) -> Option<Loose> {
        let Coordinate::Parameter { index, component } = self.coordinate else { return None };
        let half = Rational::new(1, 2);
        Some(Loose {
            component: places[index] + component,
            centre: &(&self.from + &self.to) * &half,
            half: &(&self.to - &self.from) * &half,
        })
    }

    /// The value at a point.
    pub fn value(&self, index: usize) -> Rational {
        let share = Rational::new(2 * index as i64 + 1, 2 * self.count as i64);
        &self.from + &(&(&self.to - &self.from) * &share)
    }
}

/// Where the motions of a plane start, where the axes do not say.
#[derive(Clone, Debug)]
pub enum Launch {
    /// On the section g = g₀.
    Section {
        /// g₀
        g0: Angle,
        /// The energy.
        energy: Rational,
        /// l and L/G.
        at: [f64; 2],
    },
    /// At a state, moved to the level set; at one that is drawn where there is none.
    State(Option<Vec<Rational>>),
}

/// Which motions.
#[derive(Clone, Debug)]
pub struct PlaneRequest {
    /// The horizontal and the vertical axis.
    pub axes: [Axis; 2],
    /// Where the motions start.
    pub launch: Launch,
    /// How long each is followed; negative: backwards.
    pub time: f64,
    /// Seed of what is drawn.
    pub seed: u64,
}

/// The motions of a plane, row by row from the least value of the second axis.
///
/// A motion that cannot start, or runs into a singularity, is told by its error.
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

/// The model with those parameters free that vary.
struct Free {
    model: Model,
    /// The components of all free parameters.
    parameters: Vec<Rational>,
    /// Where those of each parameter begin.
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

/// A recipe for any value of a kind; nothing is drawn by it.
fn open(kind: Type) -> Recipe {
    let draw = Draw::Within(Range { low: Rational::from(-1), high: Rational::from(1) });
    match kind {
        Type::Scalar => Recipe::Scalar(draw),
        Type::Vector(length) => Recipe::Vector(length, draw),
        Type::Matrix(rows, columns) => Recipe::Matrix(rows, columns, draw),
    }
}

/// Makes the starts.
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

    /// The start at a point of the plane.
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
