//! Work items written by hand with num-dual, without formulas or graphs: the yardstick for the cost
//! of the generic code. Plain code over arrays, not tuned; W3 has a second form, derived with
//! pencil and paper. All is inlined, so that a caller compiled for wider vectors gets code for them.
//!
//! ```text
//! Ĩω' = K + λγ,  K = Ĩω×ω - m r×(ω×r'),  γ' = γ×ω,  Ĩ = I + m r²E - m r⊗r
//! ball: r = -Rγ - c      ellipsoid: r = -Bγ/√(γ,Bγ)
//! ```

use std::array::from_fn;

use num_dual::{Dual, Dual64, DualNum};

/// Numbers of the residuals: f64 and its duals.
trait DualOrFloat: DualNum<Primitive = f64> + Copy {}

impl<T: DualNum<Primitive = f64> + Copy> DualOrFloat for T {}

type Vector<T> = [T; 3];
/// A symmetric matrix, row by row.
type Matrix<T> = [[T; 3]; 3];

const MASS: f64 = 1.3;
const RADIUS: f64 = 3.0;
const CENTRE: [f64; 3] = [0.7, -0.4, 1.1];
/// Central inertia of W1 and W3.
const INERTIA: [f64; 3] = [2.6, 1.2, 1.8];
const SQUARES: [f64; 3] = [1.0, 2.0, 3.5];
/// Central inertia mB + μE with μ = 2.
const INERTIA_MB_MU: [f64; 3] = [MASS + 2.0, 2.0 * MASS + 2.0, 3.5 * MASS + 2.0];

/// Residual W1: v at f64, then F₂ at `Dual64` along v.
#[inline(always)]
pub fn second_integral_along_field(state: &[f64]) -> f64 {
    let (omega, gamma) = split(state);
    let rate = cross(gamma, omega);
    let acceleration = acceleration(omega, gamma, ball(gamma), scaled(rate, -RADIUS), INERTIA);
    let lift = |x: Vector<f64>, dx: Vector<f64>| from_fn(|k| Dual64::new(x[k], dx[k]));
    second_integral(lift(omega, acceleration), lift(gamma, rate)).eps
}

/// Residual W2: ρ at `Dual64` along v, and v at `Dual64` along each axis of ω.
#[inline(always)]
pub fn liouville_residual(state: &[f64]) -> f64 {
    let (omega, gamma) = split(state);
    let rate = cross(gamma, omega);
    let along: Vector<Dual64> = from_fn(|k| Dual64::new(gamma[k], rate[k]));
    let inertia = inertia_at(ellipsoid(along), INERTIA_MB_MU);
    let density = dot(along, image(adjugate(inertia), along));
    density.eps / density.re + divergence(omega, gamma, INERTIA_MB_MU)
}

/// Residual W3: div v = (χ,ω), so χ by v at duals along each axis of ω, for each unit vector ω;
/// then (γ, rot(γ×χ)) by all of this at duals along each axis of γ.
#[inline(always)]
pub fn criterion(state: &[f64]) -> f64 {
    let (_, gamma) = split(state);
    let slopes = [0, 1, 2].map(|axis| {
        let mut gamma = gamma.map(Dual64::from_re);
        gamma[axis].eps = 1.0;
        let chi = from_fn(|k| {
            let mut omega = [Dual64::from_re(0.0); 3];
            omega[k].re = 1.0;
            divergence(omega, gamma, INERTIA)
        });
        cross(gamma, chi).map(|x| x.eps)
    });
    rotation_about(gamma, slopes)
}

/// Residual W3 from a formula: a = Ĩ⁻¹γ/(γ,Ĩ⁻¹γ) at `Dual64` along each axis, and (γ, rot a).
#[inline(always)]
pub fn criterion_in_closed_form(state: &[f64]) -> f64 {
    let (_, gamma) = split(state);
    let slopes = [0, 1, 2].map(|axis| {
        let mut gamma = gamma.map(Dual64::from_re);
        gamma[axis].eps = 1.0;
        let along = image(adjugate(inertia_at(ellipsoid(gamma), INERTIA)), gamma);
        let length = dot(gamma, along);
        along.map(|x| (x / length).eps)
    });
    rotation_about(gamma, slopes)
}

/// Returns (γ, rot w) from ∂w/∂γ₁, ∂w/∂γ₂, ∂w/∂γ₃.
#[inline(always)]
fn rotation_about(gamma: Vector<f64>, slopes: [Vector<f64>; 3]) -> f64 {
    gamma[0] * (slopes[1][2] - slopes[2][1])
        + gamma[1] * (slopes[2][0] - slopes[0][2])
        + gamma[2] * (slopes[0][1] - slopes[1][0])
}

/// Returns Σ ∂ω'_i/∂ω_i of an ellipsoid; γ' has no divergence.
#[inline(always)]
fn divergence<T: DualOrFloat>(omega: Vector<T>, gamma: Vector<T>, central: [f64; 3]) -> T {
    let along = |axis: usize| {
        let mut omega = omega.map(Dual::from_re);
        omega[axis].eps = T::one();
        let gamma = gamma.map(Dual::from_re);
        let slide = ellipsoid_slide(gamma, cross(gamma, omega));
        acceleration(omega, gamma, ellipsoid(gamma), slide, central)[axis].eps
    };
    along(0) + along(1) + along(2)
}

#[inline(always)]
fn split(state: &[f64]) -> (Vector<f64>, Vector<f64>) {
    let at = |k: usize| state.get(k).copied().unwrap_or(f64::NAN);
    ([at(0), at(1), at(2)], [at(3), at(4), at(5)])
}

#[inline(always)]
fn dot<T: DualOrFloat>(a: Vector<T>, b: Vector<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross<T: DualOrFloat>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn scaled<T: DualOrFloat>(a: Vector<T>, factor: f64) -> Vector<T> {
    a.map(|x| x * factor)
}

#[inline(always)]
fn image<T: DualOrFloat>(matrix: Matrix<T>, a: Vector<T>) -> Vector<T> {
    matrix.map(|row| dot(row, a))
}

#[inline(always)]
fn ball<T: DualOrFloat>(gamma: Vector<T>) -> Vector<T> {
    from_fn(|k| gamma[k] * -RADIUS - CENTRE[k])
}

#[inline(always)]
fn ellipsoid<T: DualOrFloat>(gamma: Vector<T>) -> Vector<T> {
    let image: Vector<T> = from_fn(|k| gamma[k] * SQUARES[k]);
    let scale = -dot(gamma, image).sqrt().recip();
    image.map(|x| x * scale)
}

/// Returns r' of the ellipsoid for γ' = `rate`.
#[inline(always)]
fn ellipsoid_slide<T: DualOrFloat>(gamma: Vector<T>, rate: Vector<T>) -> Vector<T> {
    let image: Vector<T> = from_fn(|k| gamma[k] * SQUARES[k]);
    let image_rate: Vector<T> = from_fn(|k| rate[k] * SQUARES[k]);
    let square = dot(gamma, image);
    let scale = -square.sqrt().recip();
    let along = dot(gamma, image_rate) / square;
    from_fn(|k| (image_rate[k] - image[k] * along) * scale)
}

#[inline(always)]
fn inertia_at<T: DualOrFloat>(r: Vector<T>, central: [f64; 3]) -> Matrix<T> {
    let square = dot(r, r);
    let entry = |i: usize, j: usize| {
        let product = r[i] * r[j];
        if i == j { (square - product) * MASS + central[i] } else { product * -MASS }
    };
    let (xy, xz, yz) = (entry(0, 1), entry(0, 2), entry(1, 2));
    [[entry(0, 0), xy, xz], [xy, entry(1, 1), yz], [xz, yz, entry(2, 2)]]
}

/// Adjugate of a symmetric matrix.
#[inline(always)]
fn adjugate<T: DualOrFloat>(a: Matrix<T>) -> Matrix<T> {
    let minor = |i: usize, j: usize, k: usize, l: usize| a[i][j] * a[k][l] - a[i][l] * a[k][j];
    let (xy, xz, yz) = (minor(0, 2, 2, 1), minor(0, 1, 1, 2), minor(0, 2, 1, 0));
    [[minor(1, 1, 2, 2), xy, xz], [xy, minor(0, 0, 2, 2), yz], [xz, yz, minor(0, 0, 1, 1)]]
}

#[inline(always)]
fn acceleration<T: DualOrFloat>(
    omega: Vector<T>,
    gamma: Vector<T>,
    r: Vector<T>,
    slide: Vector<T>,
    central: [f64; 3],
) -> Vector<T> {
    let inertia = inertia_at(r, central);
    let turning = cross(image(inertia, omega), omega);
    let sliding = cross(r, cross(omega, slide));
    let torque: Vector<T> = from_fn(|k| turning[k] - sliding[k] * MASS);
    let adjugate = adjugate(inertia);
    let determinant = dot(inertia[0], adjugate[0]);
    let along = image(adjugate, gamma);
    let multiplier = dot(torque, along) / dot(gamma, along);
    image(adjugate, from_fn(|k| torque[k] - gamma[k] * multiplier)).map(|x| x / determinant)
}

/// Integral |Ĩω × γ|² - 2mR(γ,c)(Ĩω,ω).
#[inline(always)]
fn second_integral<T: DualOrFloat>(omega: Vector<T>, gamma: Vector<T>) -> T {
    let momentum = image(inertia_at(ball(gamma), INERTIA), omega);
    let turned = cross(momentum, gamma);
    let height = gamma[0] * CENTRE[0] + gamma[1] * CENTRE[1] + gamma[2] * CENTRE[2];
    dot(turned, turned) - height * dot(momentum, omega) * (2.0 * MASS * RADIUS)
}
