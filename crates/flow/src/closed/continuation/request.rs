//! Request for a branch of closed orbits, and what is found.

use crate::closed::multiplier::{CycleKind, Multiplier};
use crate::closed::through::MeasuredNumber;
use crate::error::FlowError;
use crate::motion::columns::Columns;
use crate::motion::conserved::{Conserved, Fixed};
use crate::motion::start::Start;
use crate::section::coordinate::Coordinate;
use crate::section::surface::CrossingSurface;
use liouville::case::{Angle, Case};
use liouville::mechanics::{Draw, ParameterOrigin, SamplerSpec};
use liouville::number::rational::Rational;

/// Section through which the orbits of a branch go.
#[derive(Clone, Copy)]
pub enum BranchSection<'r> {
    /// Section g = g₀ of a rolling body.
    Andoyer(&'r Angle),
    /// Surface.
    Surface(&'r CrossingSurface),
}

/// Request for the branch of closed orbits through one of them.
pub struct BranchRequest<'r> {
    /// Case of the orbits.
    pub case: &'r Case,
    /// Section.
    pub section: BranchSection<'r>,
    /// Quantities reported at each point; l and L/G of a rolling body if none are given.
    pub columns: Option<Columns>,
    /// Quantity that varies: a component of a parameter, the energy, or an integral.
    pub varied: Coordinate,
    /// Ends of its range, the lower one first.
    pub range: [Rational; 2],
    /// Values of functions at the start, where they are known exactly.
    pub fixed: Vec<Fixed>,
    /// Integrals that are held, besides the energy.
    pub integrals: Vec<Conserved>,
    /// Point of a closed orbit on the section.
    pub start: Start,
    /// Time after which it closes.
    pub time: f64,
    /// Largest number of points each way from the start.
    pub count: usize,
    /// Longest step, as a part of the range.
    pub longest: f64,
}

/// Change of the orbits at a point of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bifurcation {
    /// A multiplier 1, where the quantity turns.
    Fold,
    /// A multiplier 1, where another branch crosses, and the quantity goes on.
    BranchPoint,
    /// A multiplier −1: the period doubles.
    Flip,
    /// Two complex multipliers cross the unit circle: an invariant torus begins.
    NeimarkSacker,
}

impl Bifurcation {
    /// Name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Bifurcation::Fold => "fold",
            Bifurcation::BranchPoint => "branch point",
            Bifurcation::Flip => "flip",
            Bifurcation::NeimarkSacker => "Neimark-Sacker",
        }
    }
}

/// A closed orbit of a branch.
#[derive(Clone, Debug)]
pub struct BranchPoint {
    /// Value of the quantity that varies.
    pub value: f64,
    /// Estimate of the error of the value, where it is that of a bifurcation.
    pub value_error: Option<f64>,
    /// Reported quantities.
    pub at: Vec<f64>,
    /// State on the section, with the values of the free parameters.
    pub state: Vec<f64>,
    /// Time after which it closes.
    pub period: MeasuredNumber,
    /// Distance between the state and its image, in double-double.
    pub residual: f64,
    /// Sum of the multipliers.
    pub trace: MeasuredNumber,
    /// Product of the multipliers.
    pub product: MeasuredNumber,
    /// Multipliers besides 1 along the orbit and 1 across the levels of what is kept.
    pub multipliers: Vec<Multiplier>,
    /// Stability, where the errors allow a statement.
    pub kind: Option<CycleKind>,
    /// Bifurcation at the point, if it was placed there.
    pub bifurcation: Option<Bifurcation>,
}

impl BranchPoint {
    /// Whether no multiplier lies outside the unit circle by more than its error.
    pub fn is_stable(&self) -> bool {
        self.multipliers.iter().all(|one| one.modulus() - 1.0 <= one.modulus_error)
    }
}

/// Reason why a branch ends.
#[derive(Clone, Debug, PartialEq)]
pub enum BranchEnd {
    /// The end of the range is reached.
    Range,
    /// There are as many points as were asked for.
    Count,
    /// The branch is back at its start.
    Closed,
    /// Steps are at their limit, and the next point is not found; the reason of the last attempt.
    Lost(Option<FlowError>),
    /// The orbit touches the section, so that it has no point on it further on.
    Touch,
    /// The orbit shrinks to a rest.
    Rest,
    /// The motion was stopped.
    Stopped,
}

/// A branch of closed orbits.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Points in the order of the branch, those of bifurcations among them.
    pub points: Vec<BranchPoint>,
    /// Index of the point at which the branch was begun.
    pub start: usize,
    /// Reasons why it ends at its first and at its last point.
    pub ends: [BranchEnd; 2],
    /// Whether the product of the multipliers is 1 at all points, up to its error.
    pub keeps_area: bool,
}

/// Range that a case declares for what varies, the lower end first.
pub fn declared_range(case: &Case, varied: Coordinate) -> Option<[Rational; 2]> {
    let parameter = case.model.parameters.get(varied.parameter()?.0)?;
    let ParameterOrigin::Free(recipe) = &parameter.origin else { return None };
    let draw = match recipe {
        SamplerSpec::Scalar(draw)
        | SamplerSpec::Vector(_, draw)
        | SamplerSpec::Matrix(_, _, draw)
        | SamplerSpec::Symmetric(_, draw)
        | SamplerSpec::Skew(_, draw)
        | SamplerSpec::Diagonal(_, draw)
        | SamplerSpec::Spherical(_, draw) => draw,
        _ => return None,
    };
    match draw {
        Draw::Within(range) => Some([range.low.clone(), range.high.clone()]),
        _ => None,
    }
}
