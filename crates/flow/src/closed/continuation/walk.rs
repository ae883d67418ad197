//! Steps along a branch.

use super::family::Place;
use super::linear::Plane;
use super::node::Node;
use super::request::{BranchEnd, BranchPoint};
use super::solve::{Solver, Tangent, Trouble, ahead, between};
use crate::error::FlowError;
use liouville::number::double_double::DoubleDouble;

/// Shortest step, as a part of the longest.
const SHORTEST: f64 = 1e-5;
/// First step, as a part of the longest.
const FIRST: f64 = 0.25;
/// Iterations of Newton's method below which steps grow, and above which they shrink.
const EASY: usize = 3;
const HARD: usize = 5;
/// Least cosine between the directions at neighbouring points.
const STRAIGHT: f64 = 0.9;
/// Distance of a point from where it was expected, as a part of the step.
const NEAR: f64 = 0.4;
/// Longest step over which the side of a rest or of a touch is left open, as a part of the longest.
const CLOSE: f64 = 1.0 / 64.0;

/// Half of a branch, from its start in one direction.
pub struct Half {
    pub nodes: Vec<Node>,
    pub end: BranchEnd,
}

/// Walk along a branch.
pub struct Walk<'w> {
    pub solver: &'w Solver<'w>,
    /// Longest step, in the units of distances.
    pub longest: f64,
    /// Largest number of points.
    pub count: usize,
    pub progress: &'w dyn Fn(&BranchPoint),
}

/// Outcome of an attempt to step.
enum Step {
    Taken(Box<Node>, usize),
    Ended(BranchEnd),
    Refused(Option<FlowError>),
}

impl Walk<'_> {
    /// Follows the branch from a node in a direction.
    pub fn follow(&self, first: &Node, tangent: Tangent) -> Half {
        let mut nodes: Vec<Node> = Vec::new();
        let mut last = Node { tangent, ..first.clone() };
        if last.tangent.lambda() != first.tangent.lambda() {
            // Functions with the direction in them change their sign with it.
            for test in [0, 1] {
                last.tests[test] = -last.tests[test];
            }
        }
        let begin = last.clone();
        if last.place.lambda.hi * last.tangent.lambda().signum() >= 1.0 {
            return Half { nodes, end: BranchEnd::Range };
        }
        let mut signs: [Option<bool>; 4] = std::array::from_fn(|test| last.sign(test));
        let (mut step, mut taken) = (self.longest * FIRST, 0);
        let end = loop {
            if taken + 1 >= self.count {
                break BranchEnd::Count;
            }
            let reason = match self.step(&begin, &last, step, taken) {
                Step::Taken(node, iterations) => {
                    match self.solver.bifurcations(&last, &node, step, &signs) {
                        Ok(found) => nodes.extend(found),
                        Err(_) => break BranchEnd::Stopped,
                    }
                    for (test, sign) in signs.iter_mut().enumerate() {
                        *sign = node.sign(test).or(*sign);
                    }
                    (self.progress)(&node.point);
                    nodes.push((*node).clone());
                    last = *node;
                    taken += 1;
                    if last.place.lambda.hi.abs() >= 1.0 {
                        break BranchEnd::Range;
                    }
                    let factor = match iterations {
                        0..=EASY => 1.6,
                        HARD.. => 0.6,
                        _ => 1.0,
                    };
                    step = (step * factor).min(self.longest);
                    continue;
                }
                Step::Ended(end) => break end,
                Step::Refused(reason) => reason,
            };
            step /= 2.0;
            if step < SHORTEST * self.longest {
                break BranchEnd::Lost(reason);
            }
        };
        Half { nodes, end }
    }

    fn step(&self, begin: &Node, last: &Node, step: f64, taken: usize) -> Step {
        let solver = self.solver;
        let plane = solver.plane(&last.place, &last.tangent, step);
        let guess = ahead(&last.place, &last.tangent, step);
        let (node, iterations) = match self.node(&guess, &plane) {
            Ok(found) => found,
            Err(refused) => return refused,
        };
        let moved = solver.distance(&node.place, &guess);
        let along = solver.plane(&last.place, &node.tangent, 0.0).normal;
        let cosine: f64 = along.iter().zip(&last.tangent.row).map(|(x, y)| x * y).sum();
        let shortest = step < 2.0 * SHORTEST * self.longest;
        if moved > NEAR * step || (cosine < STRAIGHT && !shortest) {
            return Step::Refused(None);
        }
        if taken > 2 && self.passes(begin, last, &node, step) {
            return Step::Ended(BranchEnd::Closed);
        }
        if node.rate * last.rate <= 0.0 {
            // On the other side of a rest the motion runs the other way.
            let forward: f64 = node.velocity.iter().zip(&last.velocity).map(|(x, y)| x * y).sum();
            return match step > CLOSE * self.longest {
                true => Step::Refused(None),
                false if forward < 0.0 => Step::Ended(BranchEnd::Rest),
                false => Step::Ended(BranchEnd::Touch),
            };
        }
        if node.place.lambda.hi.abs() <= 1.0 {
            return Step::Taken(Box::new(node), iterations);
        }
        self.last(last, &node)
    }

    /// Node in a plane near a guess.
    fn node(&self, guess: &Place, plane: &Plane) -> Result<(Node, usize), Step> {
        let found = self.solver.point(guess.clone(), plane);
        let found = found.and_then(|solved| {
            let iterations = solved.iterations;
            Ok((self.solver.node(solved, plane)?, iterations))
        });
        found.map_err(|trouble| match trouble {
            Trouble::Flow(FlowError::Stopped) => Step::Ended(BranchEnd::Stopped),
            Trouble::Flow(error) => Step::Refused(Some(error)),
            Trouble::Lost | Trouble::Singular => Step::Refused(None),
        })
    }

    /// The point at the end of the range, between the last one within and the first one beyond.
    fn last(&self, last: &Node, beyond: &Node) -> Step {
        let sign = if beyond.place.lambda.hi > 0.0 { 1.0 } else { -1.0 };
        let end = DoubleDouble::from_f64(sign);
        let length = (beyond.place.lambda - last.place.lambda).hi;
        let share = (end - last.place.lambda).hi / length;
        let guess = between(&last.place, &beyond.place, share);
        let dimension = self.solver.family.dimension();
        let mut plane = Plane::of_lambda(dimension, end);
        if sign < 0.0 {
            plane.normal[dimension] = -1.0;
        }
        match self.node(&guess, &plane) {
            Ok((mut node, iterations)) => {
                node.place.lambda = end;
                Step::Taken(Box::new(node), iterations)
            }
            Err(Step::Refused(_)) => Step::Ended(BranchEnd::Range),
            Err(other) => other,
        }
    }

    /// Whether a step passes the first node again.
    fn passes(&self, begin: &Node, last: &Node, node: &Node, step: f64) -> bool {
        let solver = self.solver;
        let along = solver.plane(&last.place, &last.tangent, 0.0).value(&begin.place);
        let share = along / step;
        if !(0.0..=1.0).contains(&share) {
            return false;
        }
        let there = between(&last.place, &node.place, share);
        let aligned: f64 = solver
            .plane(&begin.place, &begin.tangent, 0.0)
            .normal
            .iter()
            .zip(&node.tangent.row)
            .map(|(x, y)| x * y)
            .sum();
        solver.distance(&there, &begin.place) < 0.2 * step && aligned > 0.0
    }
}
