//! Places of bifurcations between two points of a branch.
//!
//! The function that vanishes there is evaluated at points of the branch in planes across the
//! direction of the first point; false position with halved ends (Illinois) closes in on its zero.

use liouville::order::StableOrder;

use super::family::Place;
use super::node::{KINDS, Node, tests};
use super::request::Bifurcation;
use super::solve::{Solved, Solver, Trouble, between};
use crate::error::FlowError;
use crate::taylor::stepper::Accuracy;

/// Iteration limit.
const MOST_STEPS: usize = 60;
/// Width of the bracket, as a part of the step, at which it is closed.
const CLOSED: f64 = 1e-13;
/// Width of the bracket at a branch point, where the equations become singular.
const SINGULAR: f64 = 1e-6;
/// Value of a function, in its errors, that is 0.
const ZERO: f64 = 1e-3;

/// A zero of a function along a step.
struct Zero {
    /// Share of the step, and the width of the bracket.
    share: f64,
    width: f64,
    /// Change of the function over the whole step.
    slope: f64,
    /// Places at the ends of the bracket.
    ends: [Place; 2],
}

impl Solver<'_> {
    /// Finds the bifurcations between two nodes, in their order; `signs` are the last ones that the
    /// functions had.
    pub fn bifurcations(
        &self,
        from: &Node,
        to: &Node,
        distance: f64,
        signs: &[Option<bool>; 4],
    ) -> Result<Vec<Node>, FlowError> {
        let mut found: Vec<(f64, Node)> = Vec::new();
        for (test, kind) in KINDS.iter().enumerate() {
            let (Some(before), Some(behind)) = (signs[test], to.sign(test)) else { continue };
            if before == behind {
                continue;
            }
            if from.sign(test).is_none() {
                // The first point is that of the bifurcation, up to the error of the function.
                if *kind != Bifurcation::NeimarkSacker || from.turns {
                    found.push((0.0, self.marked(from, test, to.tests[test], distance)));
                }
                continue;
            }
            let Some(zero) = self.zero(from, to, distance, test)? else { continue };
            let Some(node) = self.placed(from, to, distance, test, &zero)? else { continue };
            // A branch that turns where it crosses another one is no fold.
            let is_crossing = |(share, other): &(f64, Node)| {
                other.point.bifurcation == Some(Bifurcation::BranchPoint)
                    && (share - zero.share).abs() < 1e-3
            };
            if *kind == Bifurcation::Fold && found.iter().any(is_crossing) {
                continue;
            }
            if *kind == Bifurcation::NeimarkSacker && !node.turns {
                continue;
            }
            found.push((zero.share, node));
        }
        found.order_by(|a, b| a.0.total_cmp(&b.0));
        Ok(found.into_iter().map(|(_, node)| node).collect())
    }

    /// A node that is itself a bifurcation.
    fn marked(&self, node: &Node, test: usize, change: f64, distance: f64) -> Node {
        let mut node = node.clone();
        let shift = 2.0 * (node.blur[test] / change).abs() * distance;
        let error = shift * node.tangent.lambda().abs() * self.family.half();
        node.point.value_error = Some(error + 2.0 * f64::EPSILON * node.point.value.abs());
        node.point.bifurcation = Some(KINDS[test]);
        node
    }

    /// Point of the branch at a share of the step, with the values of the functions.
    fn at(
        &self,
        from: &Node,
        ends: [&(f64, Place); 2],
        share: f64,
        distance: f64,
    ) -> Result<(Solved, [f64; 4]), Trouble> {
        let [(a, first), (b, last)] = ends;
        let guess = between(first, last, (share - a) / (b - a));
        let plane = self.plane(&from.place, &from.tangent, share * distance);
        let solved = self.point(guess, &plane)?;
        let (tests, _) = tests(self, &solved, &solved.linear, &plane).ok_or(Trouble::Singular)?;
        Ok((solved, tests))
    }

    /// Closes in on the zero of a function.
    fn zero(
        &self,
        from: &Node,
        to: &Node,
        distance: f64,
        test: usize,
    ) -> Result<Option<Zero>, FlowError> {
        let closed = if KINDS[test] == Bifurcation::BranchPoint { SINGULAR } else { CLOSED };
        let mut low = (0.0, from.place.clone());
        let mut high = (1.0, to.place.clone());
        let (mut below, mut above) = (from.tests[test], to.tests[test]);
        let slope = above - below;
        let blur = from.blur[test].max(to.blur[test]);
        let mut side = 0i32;
        for _ in 0..MOST_STEPS {
            let width = high.0 - low.0;
            if width <= closed {
                break;
            }
            let mut share = (low.0 * above - high.0 * below) / (above - below);
            if !(share > low.0 && share < high.0) || side.abs() > 3 {
                share = (low.0 + high.0) / 2.0;
                side = 0;
            }
            let (solved, tests) = match self.at(from, [&low, &high], share, distance) {
                Ok(found) => found,
                Err(Trouble::Flow(FlowError::Stopped)) => return Err(FlowError::Stopped),
                // Nearer to a branch point there is no more to be had.
                Err(_) if width < 1e-2 => break,
                Err(_) => return Ok(None),
            };
            let value = tests[test];
            if value.abs() <= ZERO * blur && closed < SINGULAR {
                let place = solved.place;
                let ends = [place.clone(), place];
                return Ok(Some(Zero { share, width: 0.0, slope, ends }));
            }
            if (value > 0.0) == (below > 0.0) {
                (low, below) = ((share, solved.place), value);
                if side > 0 {
                    above /= 2.0;
                }
                side = side.max(0) + 1;
            } else {
                (high, above) = ((share, solved.place), value);
                if side < 0 {
                    below /= 2.0;
                }
                side = side.min(0) - 1;
            }
        }
        let share = (low.0 * above - high.0 * below) / (above - below);
        let share = if share.is_finite() { share.clamp(low.0, high.0) } else { low.0 };
        Ok(Some(Zero { share, width: high.0 - low.0, slope, ends: [low.1, high.1] }))
    }

    /// Node at a zero, with the error of what varies.
    fn placed(
        &self,
        from: &Node,
        to: &Node,
        distance: f64,
        test: usize,
        zero: &Zero,
    ) -> Result<Option<Node>, FlowError> {
        let plane = self.plane(&from.place, &from.tangent, zero.share * distance);
        let middle = between(&zero.ends[0], &zero.ends[1], 0.5);
        let is_branch = KINDS[test] == Bifurcation::BranchPoint;
        let solved = match is_branch {
            false => self.point(middle, &plane),
            // Newton's method would be singular: both ends are points of the branch, and near.
            true => self.unsolved(middle),
        };
        let node = solved.and_then(|solved| match is_branch {
            false => self.node(solved, &plane),
            true => self.rough(solved, &from.tangent),
        });
        let mut node = match node {
            Ok(node) => node,
            Err(Trouble::Flow(FlowError::Stopped)) => return Err(FlowError::Stopped),
            Err(_) => return Ok(None),
        };
        // By the value that is left in double-double, its rounding, the width, and the slope, which at
        // the zero may be half the mean one.
        let size = 1.0 + node.point.trace.value.abs() + node.point.product.value.abs();
        let value = node.tests[test].abs() + 4.0 * f64::EPSILON * size;
        let left = if is_branch { 0.0 } else { 2.0 * value / zero.slope.abs() };
        let shift = (left + zero.width) * distance;
        let turn = (to.tangent.lambda() - from.tangent.lambda()).abs();
        let change = node.tangent.lambda().abs() * shift + turn * (left + zero.width) * shift;
        let error = change * self.family.half() + 2.0 * f64::EPSILON * node.point.value.abs();
        node.point.value_error = Some(error);
        node.point.bifurcation = Some(KINDS[test]);
        Ok(Some(node))
    }

    /// A place with its map, taken as it is.
    fn unsolved(&self, mut place: Place) -> Result<Solved, Trouble> {
        self.family.project(&mut place)?;
        let frame = self.family.frame(&place)?;
        let linear = self.family.linear::<f64>(&place, &frame, Accuracy::FLOAT)?;
        Ok(Solved { place, frame, linear, iterations: 0 })
    }
}
