//! Rolling without slipping of a rigid body that is free to spin, on a plane or on a sphere.
//!
//! Names and frame are those of [`rolling`](super::rolling); nothing acts against spinning, so that
//! λ = 0 and (ω,γ) is a free variable:
//!
//! ```text
//! Ĩω' = K = (Ĩω + S)×ω - m r×(ω×r') + M_P,   γ' = Γ⁻¹(γ×ω),   r' = Bω,   B = (∂r/∂γ)Γ⁻¹[γ]×
//! ```
//!
//! Chaplygin 1897, 1903; Borisov, Mamaev, Reg. Chaot. Dyn. 7 (2002) 177-200.
//!
//! Densities ρ(γ). On |γ| = 1, with u = Ĩ⁻¹γ and τ = tr Ĩ⁻¹B,
//!
//! ```text
//! div v = (χ,ω) - (ln D_T)',   χ = -m[tr(Ĩ⁻¹)Bᵀr + Ĩ⁻¹Bᵀr - BᵀĨ⁻¹r - τr]
//! C₁ = (χ,γ) = m[τ(r,γ) - (r,Bu)]
//! C₂ = (γ, rot θ),   θ = m(∂r/∂γ)ᵀ[(r,γ)u - (u,γ)r]
//! ```
//!
//! since [Ĩω]× and [S]× have no trace with a symmetric matrix, and r×(ω×Bω) = (r,Bω)ω - (r,ω)Bω.
//! ρ = D_T det Ĩ N(γ) is invariant exactly when C₁ = 0 and d ln N = (θ,dγ), so that some N exists
//! on the sphere exactly when C₁ = 0 and C₂ = 0 there. Neither U nor S enters.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual;

use super::chart::Chart;
use super::configuration::Configuration;
use super::dynamics::Dynamics;
use super::linear::{adjugate, determinant_with};
use super::phase::Phase;
use super::quantity::Quantity;
use super::rigid::RigidBody;
use super::rubber::{NORMAL, angular_velocity, normal};
use super::system::System;
use crate::formula::Value;
use crate::scalar::Scalar;

/// A body that rolls without slipping and may spin.
#[derive(Clone, Debug)]
pub struct Spinning(pub RigidBody);

/// The body at one γ, where its measure is concerned.
struct MeasurePose<T> {
    gamma: Vector3<T>,
    r: Vector3<T>,
    slope: Matrix3<T>,
    mass: T,
    /// Tensor Ĩ⁻¹.
    inverse: Matrix3<T>,
    determinant: T,
    /// Matrix B of r' = Bω.
    rolling: Matrix3<T>,
}

impl<T: Scalar> MeasurePose<T> {
    /// Computes τ.
    fn twist(&self) -> T {
        (self.inverse * self.rolling).trace()
    }

    /// Computes χ.
    fn chi(&self) -> Vector3<T> {
        let Self { r, mass, inverse, rolling, .. } = self;
        let back = rolling.transpose();
        let pull = back * r;
        let sum = pull * inverse.trace() + inverse * pull - back * (inverse * r) - r * self.twist();
        -sum * *mass
    }

    /// Computes C₁.
    fn along(&self) -> T {
        let Self { gamma, r, mass, inverse, rolling, .. } = self;
        *mass * (self.twist() * r.dot(gamma) - r.dot(&(rolling * (inverse * gamma))))
    }

    /// Computes θ.
    fn covector(&self) -> Vector3<T> {
        let Self { gamma, r, slope, mass, inverse, .. } = self;
        let u = inverse * gamma;
        slope.transpose() * (u * r.dot(gamma) - r * u.dot(gamma)) * *mass
    }
}

impl Spinning {
    fn pose<T: Scalar>(&self, at: &Configuration<'_, T>) -> MeasurePose<T> {
        let gamma = normal(at);
        let (r, slope) = self.0.shape.contact(at);
        let across = self.0.gamma_across(at, &slope);
        let turned = |j: usize| {
            let mut unit = Vector3::repeat(T::zero());
            unit[j] = T::one();
            let free = gamma.cross(&unit);
            slope * across.as_ref().map_or(free, |big_gamma| big_gamma.solve(&free))
        };
        let inertia = self.0.inertia_at(at, &r);
        let adjugate = adjugate(&inertia);
        let determinant = determinant_with(&inertia, &adjugate);
        MeasurePose {
            mass: at.scalar(&self.0.mass),
            inverse: adjugate.map(|x| x / determinant),
            rolling: Matrix3::from_columns(&[0, 1, 2].map(turned)),
            gamma,
            r,
            slope,
            determinant,
        }
    }

    /// Computes C₂.
    fn rotation<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        let gamma = normal(at);
        let slope = |j| self.pose(&at.lift_normal(j)).covector().map(|x: Dual<T>| x.eps);
        let slopes = [0, 1, 2].map(slope);
        [(0, 1, 2), (1, 2, 0), (2, 0, 1)]
            .into_iter()
            .map(|(i, j, k)| gamma[i] * (slopes[j][k] - slopes[k][j]))
            .sum()
    }

    /// Computes ω'.
    fn acceleration<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vector3<T> {
        let inertia = &self.0.motion(phase).pose.inertia;
        let adjugate = adjugate(inertia);
        let determinant = determinant_with(inertia, &adjugate);
        (adjugate * self.0.torque(phase)).map(|x| x / determinant)
    }
}

impl Dynamics for Spinning {
    fn chart(&self) -> Chart {
        Chart::Sphere
    }

    /// Returns the rates (ω', γ').
    fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let acceleration = self.acceleration(phase);
        let rate = self.0.motion(phase).normal_rate;
        acceleration.iter().chain(rate.iter()).copied().collect()
    }

    fn without_forces(&self) -> Option<System> {
        self.0.unloaded().map(|body| System::Spinning(Box::new(Self(body))))
    }

    fn body(&self) -> Option<&RigidBody> {
        Some(&self.0)
    }

    fn body_mut(&mut self) -> Option<&mut RigidBody> {
        Some(&mut self.0)
    }

    /// Computes (χ,ω) - (ln D_T)', for a support function and moments of γ alone.
    fn divergence<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        if self.0.moment.is_some() || !self.0.is_homogeneous() {
            return None;
        }
        let at = &phase.configuration;
        let spread = self.pose(at).chi().dot(&angular_velocity(at));
        if self.0.curvature.is_none() {
            return Some(spread);
        }
        let rate = self.0.motion(phase).normal_rate;
        let volume = self.0.gamma_determinant(&at.lift(NORMAL, Value::Vector(rate)));
        Some(spread - volume.eps / volume.re)
    }

    fn has_criterion(&self) -> bool {
        true
    }

    /// Returns C₁ and C₂.
    fn criterion<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let at = &phase.configuration;
        vec![self.pose(at).along(), self.rotation(at)]
    }

    /// Returns -θ, so that d ln N = -(w,dγ) as for a rubber body.
    fn criterion_covector<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<Vec<T>> {
        let covector = self.pose(&phase.configuration).covector();
        Some(covector.iter().map(|x| -*x).collect())
    }

    /// C₁ and C₂ are dimensionless, and so is χ.
    fn criterion_scale<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        let chi = self.pose(&phase.configuration).chi();
        T::one() + chi.dot(&chi)
    }

    /// Returns det Ĩ and D_T.
    fn divisors<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let at = &phase.configuration;
        vec![self.pose(at).determinant, self.0.gamma_determinant(at)]
    }

    fn reference_density<T: Scalar>(&self, at: &Configuration<'_, T>) -> Option<T> {
        Some(self.pose(at).determinant * self.0.gamma_determinant(at))
    }

    /// Returns χ less the covector of (ln D_T)'.
    fn chi<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<[T; 3]> {
        let at = &phase.configuration;
        let chi = self.pose(at).chi();
        let (_, slope) = self.0.shape.contact(at);
        let Some(big_gamma) = self.0.gamma_across(at, &slope) else { return Some(chi.into()) };
        let drift = Vector3::from_fn(|j, _| {
            let volume = self.0.gamma_determinant(&at.lift_normal(j));
            volume.eps / volume.re
        });
        Some((chi - big_gamma.solve_transposed(&drift).cross(&normal(at))).into())
    }

    fn rest_excludes_densities(&self) -> bool {
        true
    }

    fn turning_moment<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<[T; 3]> {
        self.0.moment.is_none().then(|| self.0.torque(phase).into())
    }

    fn quantity<T: Scalar>(&self, quantity: Quantity, phase: &Phase<'_, T>) -> Value<T> {
        match quantity {
            Quantity::AngularAcceleration => Value::Vector(self.acceleration(phase)),
            Quantity::DivergenceCovector => Value::Vector(self.pose(&phase.configuration).chi()),
            _ => self.0.quantity(quantity, phase),
        }
    }
}
