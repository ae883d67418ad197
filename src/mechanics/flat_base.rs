//! A body with a flat part in rubber rolling on a sphere.
//!
//! The contact stays in the plane face: γ = e₃ in the body, ω = (ω₁,ω₂,0), and the point of contact
//! r = (r₁,r₂,z) moves with fixed z (the third coordinate of the vector from the mass centre):
//!
//! ```text
//! r₁' = ω₂/k,  r₂' = -ω₁/k
//! (Ĩω')₁,₂ = [(Ĩω + S)×ω - m r×(ω×r')]₁,₂ + (∂U/∂r₂, -∂U/∂r₁)/k,   Ĩ = I + m r²E - m r⊗r
//! ```
//!
//! The moment of a potential U(r₁,r₂) does the work -U' as the contact moves.
//! For a diagonal I these are (4.6), (4.7) of Borisov, Mamaev, Bizyaev 2013.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual;

use super::body::{matrix, scalar, vector};
use super::dynamics::Dynamics;
use super::linear::point_mass;
use super::phase::Phase;
use super::quantity::Quantity;
use super::system::System;
use crate::formula::{Formula, Value};
use crate::scalar::Scalar;

/// Index of the state variable r₁, before r₂.
const PLACE: usize = 2;

/// A body with a flat part on a sphere of curvature k.
#[derive(Clone, Debug)]
pub struct FlatBase {
    /// Mass m.
    pub mass: Formula,
    /// Central inertia tensor I.
    pub inertia: Formula,
    /// Curvature k of the sphere.
    pub curvature: Formula,
    /// Height z of the contact.
    pub height: Formula,
    /// Constant angular momentum S of a rotor.
    pub gyrostat: Option<Formula>,
    /// Potential U of the place (r₁,r₂) of the contact.
    pub potential: Option<Formula>,
}

/// Constants of the equations of motion over one scalar.
#[derive(Clone, Copy)]
struct Constants<T> {
    mass: T,
    inertia: Matrix3<T>,
    curvature: T,
    height: T,
    gyrostat: Vector3<T>,
}

impl FlatBase {
    fn constants<T: Scalar>(&self, phase: &Phase<'_, T>) -> Constants<T> {
        let at = &phase.configuration;
        let nothing = || Vector3::repeat(T::zero());
        Constants {
            mass: scalar(at.evaluate(&self.mass)),
            inertia: matrix(at.evaluate(&self.inertia)),
            curvature: scalar(at.evaluate(&self.curvature)),
            height: scalar(at.evaluate(&self.height)),
            gyrostat: self.gyrostat.as_ref().map_or_else(nothing, |s| vector(at.evaluate(s))),
        }
    }

    /// Computes ∂ξ₁/∂r₂ and ∂ξ₂/∂r₁.
    fn criterion_terms<T: Scalar>(&self, phase: &Phase<'_, T>) -> [T; 2] {
        let [_, _, r1, r2] = coordinates(phase);
        let constants = self.constants(phase).map(Dual::from_re);
        let still = Dual::from_re;
        let along = |x: T| Dual::new(x, T::one());
        [constants.xi1([still(r1), along(r2)]).eps, constants.xi2([along(r1), still(r2)]).eps]
    }

    fn total_energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        match self.potential {
            None => self.kinetic_energy(phase),
            Some(_) => self.kinetic_energy(phase) + self.potential_energy(phase),
        }
    }

    fn potential_energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        self.potential.as_ref().map_or_else(T::zero, |formula| phase.configuration.scalar(formula))
    }

    /// Moment of the potential about the axes in the face.
    fn moment<T: Scalar>(&self, phase: &Phase<'_, T>, curvature: T) -> [T; 2] {
        let Some(formula) = &self.potential else { return [T::zero(); 2] };
        let slope = |index: usize| {
            let moved = phase.configuration.lift(index, Value::Scalar(T::one()));
            moved.scalar(formula).eps / curvature
        };
        [slope(PLACE + 1), -slope(PLACE)]
    }

    fn kinetic_energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        let [w1, w2, r1, r2] = coordinates(phase);
        let omega = Vector3::new(w1, w2, T::zero());
        let inertia = self.constants(phase).inertia_at([r1, r2]);
        omega.dot(&(inertia * omega)) / T::from(2.0)
    }
}

impl Dynamics for FlatBase {
    fn functions(&self) -> Vec<&Formula> {
        self.potential.iter().collect()
    }

    fn constants(&self) -> Vec<&Formula> {
        let always = [&self.mass, &self.inertia, &self.curvature, &self.height];
        always.into_iter().chain(&self.gyrostat).collect()
    }

    /// Returns the rates (ω₁', ω₂', r₁', r₂').
    fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let [w1, w2, r1, r2] = coordinates(phase);
        let constants = self.constants(phase);
        let moment = self.moment(phase, constants.curvature);
        let [a1, a2] = constants.acceleration([w1, w2], [r1, r2], moment);
        vec![a1, a2, w2 / constants.curvature, -w1 / constants.curvature]
    }

    /// Returns Ĩ₁₁Ĩ₂₂ − Ĩ₁₂² and the curvature.
    fn divisors<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let [_, _, r1, r2] = coordinates(phase);
        let constants = self.constants(phase);
        vec![constants.determinant_at([r1, r2]), constants.curvature]
    }

    /// Energy ½(ω,Ĩω) + U.
    fn energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        Some(self.total_energy(phase))
    }

    fn energy_is_inhomogeneous(&self) -> bool {
        self.gyrostat.is_some() || self.potential.is_some()
    }

    fn without_forces(&self) -> Option<System> {
        let free = Self { gyrostat: None, potential: None, ..self.clone() };
        Some(System::FlatBase(Box::new(free)))
    }

    fn has_potential(&self) -> bool {
        self.potential.is_some()
    }

    fn potential_formula(&self) -> Option<&Formula> {
        self.potential.as_ref()
    }

    fn gyrostat(&self) -> Option<&Formula> {
        self.gyrostat.as_ref()
    }

    fn has_time_weights(&self) -> bool {
        true
    }

    fn is_curved(&self) -> bool {
        true
    }

    fn has_criterion(&self) -> bool {
        true
    }

    /// Computes ∂ξ₂/∂r₁ - ∂ξ₁/∂r₂, zero exactly when a density ρ(r₁,r₂) exists; ∂ln ρ/∂r_i = ξ_i,
    /// (4.8).
    fn criterion<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let [from_1, from_2] = self.criterion_terms(phase);
        vec![from_2 - from_1]
    }

    /// Computes (ξ₁, ξ₂) with div v = -(ξ,r').
    fn criterion_covector<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<Vec<T>> {
        let [_, _, r1, r2] = coordinates(phase);
        let constants = self.constants(phase);
        Some(vec![constants.xi1([r1, r2]), constants.xi2([r1, r2])])
    }

    /// Sum of the squares of both terms.
    fn criterion_scale<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        let [a, b] = self.criterion_terms(phase);
        a * a + b * b
    }

    fn conserves_level(&self) -> bool {
        true
    }

    fn quantity<T: Scalar>(&self, quantity: Quantity, phase: &Phase<'_, T>) -> Value<T> {
        let [w1, w2, r1, r2] = coordinates(phase);
        let constants = self.constants(phase);
        match quantity {
            Quantity::Contact => Value::Vector(Vector3::new(r1, r2, constants.height)),
            Quantity::AngularVelocity => Value::Vector(Vector3::new(w1, w2, T::zero())),
            Quantity::InertiaAtContact => Value::Matrix(constants.inertia_at([r1, r2])),
            Quantity::Potential => Value::Scalar(self.potential_energy(phase)),
            _ => Value::Scalar(self.total_energy(phase)),
        }
    }
}

impl<T: Scalar> Constants<T> {
    fn map<U: Scalar>(self, f: impl Fn(T) -> U + Copy) -> Constants<U> {
        Constants {
            mass: f(self.mass),
            inertia: self.inertia.map(f),
            curvature: f(self.curvature),
            height: f(self.height),
            gyrostat: self.gyrostat.map(f),
        }
    }

    fn inertia_at(&self, r: [T; 2]) -> Matrix3<T> {
        self.inertia + point_mass(self.mass, &Vector3::new(r[0], r[1], self.height))
    }

    fn determinant_at(&self, r: [T; 2]) -> T {
        in_face(&self.inertia_at(r))
    }

    /// Computes ω' with a further moment about the axes in the face.
    fn acceleration(&self, omega: [T; 2], r: [T; 2], moment: [T; 2]) -> [T; 2] {
        let inertia = self.inertia_at(r);
        let omega = Vector3::new(omega[0], omega[1], T::zero());
        let rate = Vector3::new(omega.y, -omega.x, T::zero()).map(|x| x / self.curvature);
        let r = Vector3::new(r[0], r[1], self.height);
        let torque = (inertia * omega + self.gyrostat).cross(&omega)
            - r.cross(&omega.cross(&rate)) * self.mass
            + Vector3::new(moment[0], moment[1], T::zero());
        let determinant = in_face(&inertia);
        [
            (inertia[(1, 1)] * torque.x - inertia[(0, 1)] * torque.y) / determinant,
            (inertia[(0, 0)] * torque.y - inertia[(0, 1)] * torque.x) / determinant,
        ]
    }

    /// Computes ξ₁: ω = (0,k) makes r' = (1,0).
    fn xi1(&self, r: [T; 2]) -> T {
        -self.divergence([T::zero(), self.curvature], r)
    }

    /// Computes ξ₂: ω = (-k,0) makes r' = (0,1).
    fn xi2(&self, r: [T; 2]) -> T {
        -self.divergence([-self.curvature, T::zero()], r)
    }

    /// Computes ∂ω₁'/∂ω₁ + ∂ω₂'/∂ω₂.
    fn divergence(&self, omega: [T; 2], r: [T; 2]) -> T {
        let lifted = self.map(Dual::from_re);
        let r = r.map(Dual::from_re);
        let along = |i: usize| {
            let mut seeded = omega.map(Dual::from_re);
            seeded[i].eps = T::one();
            lifted.acceleration(seeded, r, [Dual::from_re(T::zero()); 2])[i].eps
        };
        along(0) + along(1)
    }
}

/// Determinant of a matrix across the normal of the face.
fn in_face<T: Scalar>(a: &Matrix3<T>) -> T {
    a[(0, 0)] * a[(1, 1)] - a[(0, 1)] * a[(0, 1)]
}

fn coordinates<T: Scalar>(phase: &Phase<'_, T>) -> [T; 4] {
    [0, 1, 2, 3].map(|index| scalar(phase.configuration.variable(index)))
}
