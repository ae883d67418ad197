//! Warnings for states that are physically impossible but mathematically meaningful.

use std::ops::Range;

use nalgebra::{Matrix3, Vector3};
use num_traits::One;

use super::sampler::TAPE_LANES;
use crate::formula::Value;
use crate::graph::Expr;
use crate::mechanics::{Phase, System};
use crate::number::ball::Balls;

/// Returns the quantities to be checked: m, I by rows, R₁ + R₂, R₁R₂, 1 + k(R₁+R₂) + k²R₁R₂, R, c.
/// A system may lack those at the end: no surface that rolls, no mass centre in a ball.
pub fn outputs(phase: &Phase<'_, Expr>) -> Vec<Expr> {
    let at = &phase.configuration;
    let named = |name: &str| at.named(name);
    let system = &phase.model().system;
    if let System::FlatBase(body) = system {
        let mass = at.evaluate(&body.mass).scalar();
        return mass.into_iter().chain(at.evaluate(&body.inertia).components()).collect();
    }
    let Some(body) = system.body() else { return Vec::new() };
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

/// Whether I differs from its transpose at some state, for which the equations of motion are not
/// meant.
pub fn is_asymmetric(values: &[&Balls<TAPE_LANES>]) -> bool {
    let pairs = [(2, 4), (3, 7), (6, 8)];
    values.len() >= INERTIA.end
        && pairs.iter().any(|(above, below)| {
            let (above, below) = (values[*above], values[*below]);
            (0..TAPE_LANES).any(|lane| {
                let apart = (above.mid[lane] - below.mid[lane]).abs();
                apart > (above.rad[lane] + below.rad[lane]) * (1.0 + f64::EPSILON)
            })
        })
}

/// Returns one warning for each kind of impossibility, with the number of states.
pub fn warnings(values: &[&Balls<TAPE_LANES>]) -> Vec<String> {
    let mut counts = [0usize; KINDS.len()];
    let mut defined = 0;
    for lane in 0..TAPE_LANES {
        let defined_here = values.iter().all(|block| block.is_defined(lane));
        if values.len() < INERTIA.end || !defined_here {
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
const MASS: usize = 0;
const INERTIA: Range<usize> = 1..10;
const SUM_OF_RADII: usize = 10;
const PRODUCT_OF_RADII: usize = 11;
const DETERMINANT: usize = 12;
const RADIUS_AND_OFFSET: Range<usize> = 13..17;

const KINDS: [&str; 6] = [
    "the mass is not positive",
    "the inertia tensor is not positive definite",
    "the moments of inertia violate a triangle inequality: no body has them",
    "the body is not convex at the contact",
    "Γ reverses orientation (det Γ < 0): the contact is of the enclosing kind",
    "the mass centre lies outside the ball: |c| > |R|",
];

fn impossibilities(values: &[&Balls<TAPE_LANES>], lane: usize) -> [bool; KINDS.len()] {
    let state: Vec<f64> = values.iter().map(|block| block.mid[lane]).collect();
    let below_zero = |place: usize| {
        values.get(place).is_some_and(|block| block.mid[lane] < 0.0 && block.excludes_zero(lane))
    };
    let inertia = Inertia::of(&Matrix3::from_row_slice(&state[INERTIA]));
    let outside = match state.get(RADIUS_AND_OFFSET) {
        Some([radius, x, y, z]) => Vector3::new(*x, *y, *z).norm() > radius.abs(),
        _ => false,
    };
    [
        state[MASS] <= 0.0,
        inertia == Inertia::Indefinite,
        inertia == Inertia::NoBody,
        below_zero(SUM_OF_RADII) || below_zero(PRODUCT_OF_RADII),
        below_zero(DETERMINANT),
        outside,
    ]
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Inertia {
    Possible,
    Indefinite,
    NoBody,
}

impl Inertia {
    /// Classifies the symmetric part of `tensor`: whether some body has it as its inertia.
    fn of(tensor: &Matrix3<f64>) -> Self {
        let inertia = (tensor + tensor.transpose()) * 0.5;
        if inertia.cholesky().is_none() {
            return Self::Indefinite;
        }
        // I_k ≤ tr I - I_k for each k: tr I - 2I = 2∫ρρᵀdm has no negative eigenvalue. That of a
        // plate or a rod has an eigenvalue 0, which rounding may make negative.
        let sum = inertia.trace() * (1.0 + 64.0 * f64::EPSILON);
        match (Matrix3::from_diagonal_element(sum) - inertia * 2.0).cholesky() {
            Some(_) => Self::Possible,
            None => Self::NoBody,
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation3, Vector3};

    use super::*;

    #[test]
    fn the_triangle_inequality_tells_bodies_from_other_tensors() {
        let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
        let of = |a: f64, b: f64, c: f64| {
            let tensor = Matrix3::from_diagonal(&Vector3::new(a, b, c));
            let turned = turn.matrix() * tensor * turn.matrix().transpose();
            [Inertia::of(&tensor), Inertia::of(&turned)]
        };
        assert_eq!(of(2.0, 2.5, 3.0), [Inertia::Possible; 2], "any three sides of a triangle");
        assert_eq!(of(1.0, 1.0, 2.0), [Inertia::Possible; 2], "a disc");
        assert_eq!(of(0.1, 0.2, 0.3), [Inertia::Possible; 2], "a plate, rounded");
        assert_eq!(of(1.0, 1.0, 1e-9), [Inertia::Possible; 2], "a rod");
        assert_eq!(of(1.0, 1.0, 2.0 + 1e-9), [Inertia::NoBody; 2], "a little too much");
        assert_eq!(of(1.0, 2.0, -1e-9), [Inertia::Indefinite; 2], "a negative moment");
        assert_eq!(of(0.0, 0.0, 0.0), [Inertia::Indefinite; 2], "no inertia at all");
    }
}
