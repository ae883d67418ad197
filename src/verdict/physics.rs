//! What is physically impossible but mathematically meaningful runs, with a warning.

use nalgebra::{Matrix3, Vector3};
use num_traits::One;

use super::sampler::LANES;
use crate::formula::Value;
use crate::graph::Expr;
use crate::mechanics::{Phase, System};
use crate::number::ball::Balls;

/// The quantities that are looked at: m, I by rows, R₁ + R₂, R₁R₂, 1 + k(R₁+R₂) + k²R₁R₂, R, c.
pub fn outputs(phase: &Phase<'_, Expr>) -> Vec<Expr> {
    let at = &phase.configuration;
    let named = |name: &str| at.named(name);
    let body = match &phase.model().system {
        System::Rubber(body) => body,
        System::FlatBase(body) => {
            let mass = at.evaluate(&body.mass).scalar();
            return mass.into_iter().chain(at.evaluate(&body.inertia).components()).collect();
        }
        _ => return Vec::new(),
    };
    let mass = at.evaluate(&body.mass).scalar();
    let inertia = at.evaluate(&body.inertia).components();
    let (sum, product) = body.radii(at);
    let turning = body.curvature.as_ref().and_then(|k| at.evaluate(k).scalar());
    let determinant = turning.map_or(Expr::one(), |k| Expr::one() + k * sum + k * k * product);
    let mut outputs: Vec<Expr> = mass.into_iter().chain(inertia).collect();
    outputs.extend([sum, product, determinant]);
    if let (Some(Value::Scalar(radius)), Some(Value::Vector(offset))) = (named("R"), named("c")) {
        outputs.extend([radius, offset.x, offset.y, offset.z]);
    }
    outputs
}

/// Is I different from its transpose at some state? No equation of motion is meant then.
pub fn is_asymmetric(values: &[&Balls<LANES>]) -> bool {
    let pairs = [(2, 4), (3, 7), (6, 8)];
    values.len() > 9
        && pairs.iter().any(|(above, below)| {
            let (above, below) = (values[*above], values[*below]);
            (0..LANES).any(|lane| {
                let apart = (above.mid[lane] - below.mid[lane]).abs();
                apart > (above.rad[lane] + below.rad[lane]) * (1.0 + f64::EPSILON)
            })
        })
}

/// One warning for each kind of impossibility, with how often it occurred.
pub fn warnings(values: &[&Balls<LANES>]) -> Vec<String> {
    let mut counts = [0usize; KINDS.len()];
    let mut defined = 0;
    for lane in 0..LANES {
        let defined_here = values.iter().all(|block| block.is_defined(lane));
        if values.len() < 13 || !defined_here {
            continue;
        }
        defined += 1;
        for (count, holds) in counts.iter_mut().zip(impossibilities(values, lane)) {
            *count += usize::from(holds);
        }
    }
    KINDS
        .iter()
        .zip(counts)
        .filter(|(_, count)| *count > 0)
        .map(|(kind, count)| match count == defined {
            true => kind.to_string(),
            false => format!("{kind} (at {count} of {defined} states)"),
        })
        .collect()
}

/// Places among the outputs.
const SUM_OF_RADII: usize = 10;
const PRODUCT_OF_RADII: usize = 11;
const DETERMINANT: usize = 12;

const KINDS: [&str; 6] = [
    "the mass is not positive",
    "the inertia tensor is not positive definite",
    "the moments of inertia violate a triangle inequality: no body has them",
    "the body is not convex at the contact",
    "Γ reverses orientation (det Γ < 0): the contact is of the enclosing kind",
    "the mass centre lies outside the ball: |c| > |R|",
];

fn impossibilities(values: &[&Balls<LANES>], lane: usize) -> [bool; KINDS.len()] {
    let state: Vec<f64> = values.iter().map(|block| block.mid[lane]).collect();
    let below_zero = |index: usize| state[index] < 0.0 && values[index].excludes_zero(lane);
    let inertia = Matrix3::from_row_slice(&state[1..10]);
    let moments = ((inertia + inertia.transpose()) * 0.5).symmetric_eigenvalues();
    let outside = match state.get(13..17) {
        Some([radius, x, y, z]) => Vector3::new(*x, *y, *z).norm() > radius.abs(),
        _ => false,
    };
    // A moment may exceed the sum of the others by the rounding of an eigenvalue computation.
    let slack = 1.0 + 64.0 * f64::EPSILON;
    let largest = moments.max();
    [
        state[0] <= 0.0,
        moments.min() <= 0.0,
        moments.min() > 0.0 && largest > (moments.sum() - largest) * slack,
        below_zero(SUM_OF_RADII) || below_zero(PRODUCT_OF_RADII),
        below_zero(DETERMINANT),
        outside,
    ]
}
