//! Strategies of `proptest` for bodies and states.
//!
//! All draw numbers of a grid, so that failures print briefly and proofs have low height. Shrinking
//! moves towards the middle of a range.

use std::ops::Range;

use proptest::prelude::{Strategy, prop};

use super::body::{Ellipsoid, Polynomial};
use super::notation::On;
use super::rolling::RollingLevel;

/// Half the number of steps in a range.
const STEPS: i32 = 128;
/// Largest fraction of a body's radius by which its polynomial may reduce the radii of curvature.
const MOST_REDUCTION: f64 = 0.9;

/// Draws a number strictly inside a range, in 256 steps; dyadic if the range's ends are.
pub fn number(range: Range<f64>) -> impl Strategy<Value = f64> + Clone {
    let (middle, half) = ((range.start + range.end) / 2.0, (range.end - range.start) / 2.0);
    (1 - STEPS..STEPS).prop_map(move |n| middle + half * (f64::from(n) / f64::from(STEPS)))
}

/// Draws a point of ℝᴺ with every component inside a range.
pub fn state<const N: usize>(range: Range<f64>) -> impl Strategy<Value = [f64; N]> + Clone {
    prop::array::uniform(number(range))
}

/// Draws principal moments of inertia (B+C, C+A, A+B) of a body with ∫x²dm = A, ∫y²dm = B, ∫z²dm =
/// C in a range of positive numbers: the triangle inequalities hold strictly.
pub fn principal_moments(range: Range<f64>) -> impl Strategy<Value = [f64; 3]> + Clone {
    state(range).prop_map(|[a, b, c]: [f64; 3]| [b + c, c + a, a + b])
}

/// Draws the inertia tensor of such a body about arbitrary axes, exactly symmetric.
pub fn inertia_tensor(range: Range<f64>) -> impl Strategy<Value = [[f64; 3]; 3]> + Clone {
    (state(range), state(-1.0..1.0)).prop_map(|(masses, turn): ([f64; 3], [f64; 3])| {
        let axes = rotation(turn);
        // ∫x⊗x dm, and I = (tr) E - ∫x⊗x dm
        let second = |i: usize, j: usize| -> f64 {
            (0..3).map(|k| masses[k] * (axes[i][k] * axes[j][k])).sum()
        };
        let total: f64 = (0..3).map(|i| second(i, i)).sum();
        let entry = |i: usize, j: usize| if i == j { total - second(i, i) } else { -second(i, j) };
        std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
    })
}

/// Computes Cayley's rotation by the quaternion (1, q).
fn rotation([x, y, z]: [f64; 3]) -> [[f64; 3]; 3] {
    let square = x * x + y * y + z * z;
    let norm = 1.0 + square;
    let [a, b, c] = [x, y, z].map(|q| 1.0 - square + 2.0 * q * q);
    [
        [a, 2.0 * (x * y - z), 2.0 * (x * z + y)],
        [2.0 * (x * y + z), b, 2.0 * (y * z - x)],
        [2.0 * (x * z - y), 2.0 * (y * z + x), c],
    ]
    .map(|row| row.map(|entry| entry / norm))
}

/// Draws an ellipsoid with semi-axes in a range of positive numbers.
pub fn ellipsoid(axes: Range<f64>) -> impl Strategy<Value = Ellipsoid> + Clone {
    state(axes).prop_map(|axes| Ellipsoid { axes })
}

/// Draws a convex body of revolution about e₃ with mean radius in a range: h = |γ| p(γ₃/|γ|), p of
/// degree 4.
pub fn body_of_revolution(radius: Range<f64>) -> impl Strategy<Value = Polynomial> + Clone {
    let weights = prop::array::uniform(number(-1.0..1.0));
    (number(radius), weights).prop_map(|(radius, weights): (f64, [f64; 4])| {
        polynomial(radius, (1..=4).map(|k| [0, 0, k]).zip(weights))
    })
}

/// Draws a convex body without symmetries, with its mass centre off the middle: a polynomial of
/// degree 3 on the sphere.
pub fn convex_body(radius: Range<f64>) -> impl Strategy<Value = Polynomial> + Clone {
    let weights = prop::array::uniform(number(-1.0..1.0));
    (number(radius), weights).prop_map(|(radius, weights): (f64, [f64; 19])| {
        let exponents = (1..=3).flat_map(|degree: i32| {
            (0..=degree).flat_map(move |i| (0..=degree - i).map(move |j| [i, j, degree - i - j]))
        });
        polynomial(radius, exponents.zip(weights))
    })
}

/// Makes R|γ| plus weighted monomials, small enough for all radii of curvature to stay above R/10.
///
/// Across γ, on |γ| = 1, the second derivatives of P|γ|^(1-d) are those of P minus (d-1)P; for a
/// monomial of degree d they are at most d(d-1) and d-1, together d²-1. A linear term only moves
/// the mass centre.
fn polynomial(radius: f64, weighted: impl Iterator<Item = ([i32; 3], f64)>) -> Polynomial {
    let weighted: Vec<([i32; 3], f64)> = weighted.filter(|(_, weight)| *weight != 0.0).collect();
    let degree = |exponents: &[i32; 3]| f64::from(exponents.iter().sum::<i32>());
    let curved = weighted.iter().filter(|(exponents, _)| degree(exponents) > 1.0);
    let total: f64 = curved.map(|(_, weight)| weight.abs()).sum();
    let scale = radius * MOST_REDUCTION / total.max(1.0);
    let sized = weighted.into_iter().map(|(exponents, weight)| {
        let size = (degree(&exponents).powi(2) - 1.0).max(2.0);
        (exponents, weight * scale / size)
    });
    Polynomial { terms: std::iter::once(([0; 3], radius)).chain(sized).collect() }
}

/// Draws a state of a rolling body: γ on the sphere and off its lower pole, ω across γ, |ω| below
/// 4.
pub fn rolling_state() -> impl Strategy<Value = On<RollingLevel, 5>> + Clone {
    (state(-2.0..2.0), state(-2.0..2.0)).prop_map(|([u, v], [a, b, c]): ([f64; 2], [f64; 3])| On {
        level: RollingLevel,
        coordinates: [u, v, a, b, c],
    })
}
