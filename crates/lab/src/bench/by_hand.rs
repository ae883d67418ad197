//! Work items written by hand with num-dual, without formulas or graphs: the yardstick for the cost
//! of the generic code. Plain code, not tuned; W3 has a second form, derived with pencil and paper.
//!
//! ```text
//! Ĩω' = K + λγ,  K = Ĩω×ω - m r×(ω×r'),  γ' = γ×ω,  Ĩ = I + m r²E - m r⊗r
//! ball: r = -Rγ - c      ellipsoid: r = -Bγ/√(γ,Bγ)
//! ```

use nalgebra::{Matrix3, Vector3};
use num_dual::{Dual, Dual64, DualNum};

/// Numbers of the residuals: f64 and its duals.
trait DualOrFloat: DualNum<Primitive = f64> + Copy {}

impl<T: DualNum<Primitive = f64> + Copy> DualOrFloat for T {}

const MASS: f64 = 1.3;
const RADIUS: f64 = 3.0;
const CENTRE: [f64; 3] = [0.7, -0.4, 1.1];
/// Central inertia of W1 and W3.
const INERTIA: [f64; 3] = [2.6, 1.2, 1.8];
const SQUARES: [f64; 3] = [1.0, 2.0, 3.5];
/// Central inertia mB + μE with μ = 2.
const INERTIA_MB_MU: [f64; 3] = [MASS + 2.0, 2.0 * MASS + 2.0, 3.5 * MASS + 2.0];

/// Residual W1: v at f64, then F₂ at `Dual64` along v.
pub fn second_integral_along_field(state: &[f64]) -> f64 {
    let (omega, gamma) = split(state);
    let rate = gamma.cross(&omega);
    let acceleration = acceleration(&omega, &gamma, &ball(&gamma), &(rate * -RADIUS), &INERTIA);
    let lift = |x: &Vector3<f64>, dx: &Vector3<f64>| x.zip_map(dx, Dual64::new);
    second_integral(&lift(&omega, &acceleration), &lift(&gamma, &rate)).eps
}

/// Residual W2: ρ at `Dual64` along v, and v at `Dual64` along each axis of ω.
pub fn liouville_residual(state: &[f64]) -> f64 {
    let (omega, gamma) = split(state);
    let rate = gamma.cross(&omega);
    let along = gamma.zip_map(&rate, Dual64::new);
    let inertia = inertia_at(&ellipsoid(&along), &INERTIA_MB_MU);
    let density = along.dot(&(adjugate(&inertia) * along));
    density.eps / density.re + divergence(&omega, &gamma, &INERTIA_MB_MU)
}

/// Residual W3: div v = (χ,ω), so χ by v at duals along each axis of ω, for each unit vector ω;
/// then (γ, rot(γ×χ)) by all of this at duals along each axis of γ.
pub fn criterion(state: &[f64]) -> f64 {
    let (_, gamma) = split(state);
    let slopes = [0, 1, 2].map(|axis| {
        let mut gamma = gamma.map(Dual64::from_re);
        gamma[axis].eps = 1.0;
        let chi = Vector3::from_fn(|k, _| {
            let mut omega = Vector3::repeat(Dual64::from_re(0.0));
            omega[k].re = 1.0;
            divergence(&omega, &gamma, &INERTIA)
        });
        gamma.cross(&chi).map(|x| x.eps)
    });
    rotation_about(&gamma, &slopes)
}

/// Residual W3 from a formula: a = Ĩ⁻¹γ/(γ,Ĩ⁻¹γ) at `Dual64` along each axis, and (γ, rot a).
pub fn criterion_in_closed_form(state: &[f64]) -> f64 {
    let (_, gamma) = split(state);
    let slopes = [0, 1, 2].map(|axis| {
        let mut gamma = gamma.map(Dual64::from_re);
        gamma[axis].eps = 1.0;
        let along = adjugate(&inertia_at(&ellipsoid(&gamma), &INERTIA)) * gamma;
        along.map(|x| (x / gamma.dot(&along)).eps)
    });
    rotation_about(&gamma, &slopes)
}

/// Returns (γ, rot w) from ∂w/∂γ₁, ∂w/∂γ₂, ∂w/∂γ₃.
#[inline]
fn rotation_about(gamma: &Vector3<f64>, slopes: &[Vector3<f64>; 3]) -> f64 {
    [(0, 1, 2), (1, 2, 0), (2, 0, 1)]
        .into_iter()
        .map(|(i, j, k)| gamma[i] * (slopes[j][k] - slopes[k][j]))
        .sum()
}

/// Returns Σ ∂ω'_i/∂ω_i of an ellipsoid; γ' has no divergence.
#[inline]
fn divergence<T: DualOrFloat>(omega: &Vector3<T>, gamma: &Vector3<T>, central: &[f64; 3]) -> T {
    let along = |axis: usize| {
        let mut omega = omega.map(Dual::from_re);
        omega[axis].eps = T::one();
        let gamma = gamma.map(Dual::from_re);
        let slide = ellipsoid_slide(&gamma, &gamma.cross(&omega));
        acceleration(&omega, &gamma, &ellipsoid(&gamma), &slide, central)[axis].eps
    };
    (0..3).map(along).sum()
}

#[inline]
fn split(state: &[f64]) -> (Vector3<f64>, Vector3<f64>) {
    let at = |k: usize| state.get(k).copied().unwrap_or(f64::NAN);
    (Vector3::new(at(0), at(1), at(2)), Vector3::new(at(3), at(4), at(5)))
}

#[inline]
fn ball<T: DualOrFloat>(gamma: &Vector3<T>) -> Vector3<T> {
    -(gamma.map(|x| x * RADIUS) + Vector3::from(CENTRE).map(T::from))
}

#[inline]
fn ellipsoid<T: DualOrFloat>(gamma: &Vector3<T>) -> Vector3<T> {
    let image = gamma.component_mul(&Vector3::from(SQUARES).map(T::from));
    let scale = -gamma.dot(&image).sqrt().recip();
    image.map(|x| x * scale)
}

/// Returns r' of the ellipsoid for γ' = `rate`.
#[inline]
fn ellipsoid_slide<T: DualOrFloat>(gamma: &Vector3<T>, rate: &Vector3<T>) -> Vector3<T> {
    let squares = Vector3::from(SQUARES).map(T::from);
    let (image, image_rate) = (gamma.component_mul(&squares), rate.component_mul(&squares));
    let square = gamma.dot(&image);
    let scale = -square.sqrt().recip();
    let along = gamma.dot(&image_rate) / square;
    image_rate.zip_map(&image, |dx, x| (dx - x * along) * scale)
}

#[inline]
fn inertia_at<T: DualOrFloat>(r: &Vector3<T>, central: &[f64; 3]) -> Matrix3<T> {
    let steiner = Matrix3::from_diagonal_element(r.dot(r)) - r * r.transpose();
    Matrix3::from_diagonal(&Vector3::from(*central).map(T::from)) + steiner.map(|x| x * MASS)
}

/// Adjugate of a symmetric matrix.
#[inline]
fn adjugate<T: DualOrFloat>(a: &Matrix3<T>) -> Matrix3<T> {
    let [x, y, z] = [0, 1, 2].map(|k| a.column(k).into_owned());
    Matrix3::from_columns(&[y.cross(&z), z.cross(&x), x.cross(&y)])
}

#[inline]
fn acceleration<T: DualOrFloat>(
    omega: &Vector3<T>,
    gamma: &Vector3<T>,
    r: &Vector3<T>,
    slide: &Vector3<T>,
    central: &[f64; 3],
) -> Vector3<T> {
    let inertia = inertia_at(r, central);
    let torque = (inertia * omega).cross(omega) - r.cross(&omega.cross(slide)).map(|x| x * MASS);
    let adjugate = adjugate(&inertia);
    let determinant = inertia.column(0).dot(&adjugate.column(0));
    let along = adjugate * gamma;
    let multiplier = torque.dot(&along) / gamma.dot(&along);
    let force = torque - gamma.map(|x| x * multiplier);
    (adjugate * force).map(|x| x / determinant)
}

/// Integral |Ĩω × γ|² - 2mR(γ,c)(Ĩω,ω).
#[inline]
fn second_integral<T: DualOrFloat>(omega: &Vector3<T>, gamma: &Vector3<T>) -> T {
    let momentum = inertia_at(&ball(gamma), &INERTIA) * omega;
    let turned = momentum.cross(gamma);
    let centre = Vector3::from(CENTRE).map(T::from);
    turned.dot(&turned) - gamma.dot(&centre) * momentum.dot(omega) * (2.0 * MASS * RADIUS)
}
