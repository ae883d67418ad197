//! Points of a branch in both precisions, with what is told of them.

use super::family::Place;
use super::linear::{Linear, Plane};
use super::request::{Bifurcation, BranchPoint};
use super::solve::{Solved, Solver, Tangent, Trouble};
use crate::closed::multiplier;
use crate::closed::through::MeasuredNumber;
use crate::error::FlowError;
use crate::taylor::stepper::Accuracy;
use liouville::number::double_double::DoubleDouble;

/// Differences of both precisions below which a function that vanishes at bifurcations has no sign,
/// and roundings that it has at least.
const BLUR: f64 = 16.0;
const LEAST: f64 = 1e-10;

/// Functions that vanish at bifurcations, in the order of `KINDS`.
pub type Tests = [f64; 4];

/// Bifurcations of the functions.
pub const KINDS: [Bifurcation; 4] =
    [Bifurcation::BranchPoint, Bifurcation::Fold, Bifurcation::Flip, Bifurcation::NeimarkSacker];

/// Point of a branch.
#[derive(Clone, Debug)]
pub struct Node {
    pub place: Place,
    pub tangent: Tangent,
    /// Functions in double-double, and their errors.
    pub tests: Tests,
    pub blur: Tests,
    /// Whether the pair of multipliers nearest to the unit circle is complex.
    pub turns: bool,
    pub velocity: Vec<f64>,
    /// Rate of the section's function.
    pub rate: f64,
    pub point: BranchPoint,
}

impl Node {
    /// Sign of a function, beyond its error.
    pub fn sign(&self, test: usize) -> Option<bool> {
        (self.tests[test].abs() > self.blur[test]).then_some(self.tests[test] > 0.0)
    }

    /// Whether the product of two multipliers is 1 within its error.
    pub fn keeps_area(&self) -> bool {
        self.sign(3).is_none()
    }
}

/// Functions that vanish at bifurcations, with the direction of the branch.
pub fn tests(
    solver: &Solver<'_>,
    solved: &Solved,
    linear: &Linear,
    plane: &Plane,
) -> Option<(Tests, Tangent)> {
    let tangent = solver.tangent(&solved.frame, linear, plane)?;
    let own = solver.plane(&solved.place, &tangent, 0.0);
    let row = own.row(&solved.frame);
    // Lengths of rows are left out of the determinant.
    let matrix = linear.bordered(&row);
    let sizes: f64 = matrix.row_iter().map(|row| row.norm()).product();
    let branch = matrix.determinant() / sizes;
    Some(([branch, tangent.lambda(), linear.flip(), linear.torus()], tangent))
}

impl Solver<'_> {
    /// Makes a node of a point: the last digits, and what is told of it.
    pub fn node(&self, mut solved: Solved, plane: &Plane) -> Result<Node, Trouble> {
        let float_time = solved.place.time.hi;
        let residual = self.refine(&mut solved, plane)?;
        if !self.is_supported(&solved, plane, residual) {
            return Err(FlowError::NearReturn(float_time, residual).into());
        }
        solved.frame = self.family.frame(&solved.place)?;
        let [float, pair] = self.both(&solved)?;
        let (rough, _) = tests(self, &solved, &float, plane).ok_or(Trouble::Singular)?;
        let (tests, tangent) = tests(self, &solved, &pair, plane).ok_or(Trouble::Singular)?;
        let blur = std::array::from_fn(|k| BLUR * (tests[k] - rough[k]).abs() + LEAST);
        let mut point = self.told(&solved.place, [&float, &pair]);
        point.residual = residual;
        point.period = MeasuredNumber::twice(float_time, solved.place.time.hi);
        let (turns, velocity, rate) = (pair.turns(), pair.velocity, pair.rate);
        Ok(Node { place: solved.place, tangent, tests, blur, turns, velocity, rate, point })
    }

    /// Makes a node of a point at which Newton's method is singular, with a direction of the branch.
    pub fn rough(&self, solved: Solved, tangent: &Tangent) -> Result<Node, Trouble> {
        let [float, pair] = self.both(&solved)?;
        let point = self.told(&solved.place, [&float, &pair]);
        let (turns, velocity, rate) = (pair.turns(), pair.velocity, pair.rate);
        let tests = [0.0, tangent.lambda(), 0.0, 0.0];
        let tangent = tangent.clone();
        Ok(Node {
            place: solved.place,
            tangent,
            tests,
            blur: [LEAST; 4],
            turns,
            velocity,
            rate,
            point,
        })
    }

    /// The map in both precisions.
    fn both(&self, solved: &Solved) -> Result<[Linear; 2], Trouble> {
        let (family, place, frame) = (self.family, &solved.place, &solved.frame);
        Ok([
            family.linear::<f64>(place, frame, Accuracy::FLOAT)?,
            family.linear::<DoubleDouble>(place, frame, Accuracy::PAIR)?,
        ])
    }

    /// Properties of a point that are reported.
    fn told(&self, place: &Place, [float, pair]: [&Linear; 2]) -> BranchPoint {
        let family = self.family;
        let trace = MeasuredNumber::twice(float.trace(), pair.trace());
        let product = MeasuredNumber::twice(float.product(), pair.product());
        let (multipliers, kind) = match pair.map.nrows() {
            2 => multiplier::two(trace, product),
            // The only multiplier is known best by the volume.
            1 => multiplier::all(
                &float.map.map(|_| float.product()),
                &pair.map.map(|_| pair.product()),
                &[],
            ),
            _ => multiplier::all(&float.map, &pair.map, &[]),
        };
        let time = place.time.hi;
        let late = pair.late.abs() + f64::EPSILON * time;
        BranchPoint {
            value: family.value(place.lambda),
            value_error: None,
            at: family.gauge(place),
            state: place.state.iter().map(|x| x.hi).collect(),
            period: MeasuredNumber { value: time, error: late },
            residual: pair.gap,
            trace,
            product,
            multipliers,
            kind,
            bifurcation: None,
        }
    }
}
