//! Closed formulas for values that the definitions reach by longer computations.
//!
//! They are recorded together with a residual that is to be measured, and replace nodes of the same
//! value ([`Graph::merged`](crate::graph::Graph::merged)); a formula that does not hold has no
//! effect. For a rubber body, with D = ∂r/∂γ, f = K + λγ = Ĩω', b = Ĩ⁻¹γ/(γ,Ĩ⁻¹γ), P = Ĩ⁻¹ - b⊗Ĩ⁻¹γ
//! (so that ω' = PK on the plane, Pγ = 0, PĨ = E - b⊗γ), and J = γ×:
//!
//! ```text
//! K       = L - m((r,r')ω - (r,ω)r'),  L = Ĩω×ω + …
//! (Ĩω)'  = m(2(r,r')ω - (r,ω)r' - (r',ω)r) + f = m((r,r')ω - (r',ω)r) + L + λγ
//! (Ĩω,ω)' = ((Ĩω)',ω) + (f,ω)
//! X = (r,r') tr P - (Pr,r'),   Y = (Dᵀr×γ, Pω) - (r,ω) tr PDJ                           on the plane:
//! div v        = -(b,γ') - m(X + Y)
//! v(ln ρ₀)     = 2(b,γ') + 2mX,                      ρ₀ = (γ,adj(Ĩ)γ)
//! (γ, rot b)   = m(2(γ×Pb, Dᵀr) - (γ×Pr, Dᵀb) - (r,b) tr PDJ)
//! ```
//!
//! div v: ∂/∂ω of r×(ω×r') = (r,r')ω - (r,ω)r'; [Ĩω]× and [S]× have no trace with the symmetric P.
//! rot b: b minimises ½(b,Ĩb) on (γ,b) = 1, so b' = P(δγ/(γ,Ĩ⁻¹γ) - Ĩ'b) - (b,δγ)b.

use nalgebra::{Matrix3, Vector3};

use super::linear::{adjugate, determinant_with};
use super::phase::Phase;
use super::rolling::{Pose, RollingTerms};
use super::rubber::Rubber;
use crate::scalar::Scalar;

impl Rubber {
    /// Computes values that occur in claims about a body.
    pub(super) fn known_values<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let motion = self.0.motion(phase);
        let Pose { omega, gamma, mass, r, .. } = &motion.pose;
        let (_, multiplier) = self.acceleration(phase);
        let (torque, constraint) = (self.0.torque(phase), gamma * multiplier);
        let slide = &motion.contact_rate;
        let approach = r.dot(slide);
        // r×(ω×r')
        let sliding = (omega * approach - slide * r.dot(omega)) * *mass;
        let turning = torque + sliding;
        let short_torque = turning - sliding;
        let spin = (omega * approach - r * slide.dot(omega)) * *mass;
        let moved = spin + sliding;
        let force = torque + constraint;
        let momentum_rate = moved + force;
        let rates =
            [momentum_rate, moved + (short_torque + constraint), spin + turning + constraint];
        let energy_rate = momentum_rate.dot(omega) + force.dot(omega);
        let mut values: Vec<T> = rates.iter().flatten().copied().chain([energy_rate]).collect();
        if self.0.curvature.is_none() {
            let terms = OnPlane::of(motion);
            values.extend([terms.divergence(), terms.logarithmic_rate(), terms.rotation]);
        }
        values
    }

    /// Computes div v where a closed formula is known: on the plane, without a moment besides a
    /// potential.
    pub(super) fn known_divergence<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        let known = self.0.curvature.is_none() && self.0.moment.is_none();
        known.then(|| OnPlane::of(self.0.motion(phase)).divergence())
    }
}

/// Terms of the measure on the plane.
struct OnPlane<T> {
    /// Term (b,γ').
    along_rate: T,
    /// Term mX.
    spread: T,
    /// Term mY.
    shear: T,
    /// Rotation (γ, rot b).
    rotation: T,
}

impl<T: Scalar> OnPlane<T> {
    fn of(motion: &RollingTerms<T>) -> Self {
        let Pose { omega, gamma, mass, r, slope, inertia, .. } = &motion.pose;
        let (slide, rate) = (&motion.contact_rate, &motion.normal_rate);
        let adjugate = adjugate(inertia);
        let along = adjugate * gamma;
        let inverse = gamma.dot(&along).recip();
        let unit: Vector3<T> = along * inverse;
        let determinant = determinant_with(inertia, &adjugate);
        let across = (adjugate - along * unit.transpose()).map(|x| x / determinant);
        let image = across * r;
        let pull = slope.transpose() * r;
        let twist = turned_trace(&(across * slope), gamma);
        let spread = r.dot(slide) * across.trace() - image.dot(slide);
        let shear = pull.cross(gamma).dot(&(across * omega)) - r.dot(omega) * twist;
        let first = gamma.cross(&(across * unit)).dot(&pull);
        let second = gamma.cross(&image).dot(&(slope.transpose() * unit));
        Self {
            along_rate: unit.dot(rate),
            spread: spread * *mass,
            shear: shear * *mass,
            rotation: (first + first - second - r.dot(&unit) * twist) * *mass,
        }
    }

    fn divergence(&self) -> T {
        -(self.along_rate + self.spread + self.shear)
    }

    /// Computes v(ln ρ₀).
    fn logarithmic_rate(&self) -> T {
        let half = self.along_rate + self.spread;
        half + half
    }
}

/// Computes tr MJ with Ju = γ×u.
fn turned_trace<T: Scalar>(matrix: &Matrix3<T>, gamma: &Vector3<T>) -> T {
    let part = |i: usize, j: usize, k: usize| gamma[i] * (matrix[(j, k)] - matrix[(k, j)]);
    part(0, 1, 2) + part(1, 2, 0) + part(2, 0, 1)
}
