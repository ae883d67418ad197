//! A homogeneous ball rolling, with spin, on a surface that is fixed or turns about e₃.
//!
//! Vectors are in the fixed frame. r is the centre of the ball, which moves on the surface Σ
//! parallel to the supporting one; γ is the normal of Σ from the point of contact to the centre, μ
//! the central moment of inertia, D = mR², Ω = Ωe₃ the angular velocity of the surface:
//!
//! ```text
//! M  = μω + Dγ×(ω×γ),    ω = (M + (D/μ)(M,γ)γ)/(μ + D)
//! r' = Rω×γ + Ω×(r - Rγ)
//! M' = Dγ'×(ω×γ) - mRγ×(Ω×(r' - Rγ')) - Rγ×∂U/∂r
//! ```
//!
//! Borisov, Mamaev, Nonholonomic dynamical systems, the ball on a surface; the sign of the moment
//! is the one for which the energy is conserved.

use nalgebra::Vector3;

use super::ball_surface::Surface;
use super::body::{Shape, axis, scalar, vector};
use super::chart::Chart;
use super::configuration::Configuration;
use super::dynamics::Dynamics;
use super::linear::{adjugate, determinant_with};
use super::phase::Phase;
use super::quantity::Quantity;
use super::rubber::{NORMAL, Potential};
use super::system::System;
use crate::formula::{Formula, Value};
use crate::scalar::Scalar;

/// A homogeneous ball on a surface.
#[derive(Clone, Debug)]
pub struct BallOnSurface {
    /// Mass m.
    pub mass: Formula,
    /// Radius R.
    pub radius: Formula,
    /// Central moment of inertia μ.
    pub moment: Formula,
    /// Surface Σ of the centre.
    pub surface: Surface,
    /// Potential U(r), where r takes the place of the second state variable.
    pub potential: Option<Potential>,
    /// Angular velocity Ω of the surface.
    pub rotation: Option<Formula>,
    /// Whether components are taken in the frame of the turning surface.
    pub rotating_frame: bool,
}

/// Intermediate results of the equations of motion.
pub struct BallMotion<T> {
    normal: Vector3<T>,
    centre: Vector3<T>,
    omega: Vector3<T>,
    centre_rate: Vector3<T>,
    normal_rate: Vector3<T>,
}

impl BallOnSurface {
    fn total_energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        let (at, motion) = (&phase.configuration, self.motion(phase));
        let kinetic = vector(at.variable(0)).dot(&motion.omega) / T::from(2.0);
        match &self.potential {
            None => kinetic,
            Some(potential) => kinetic + potential.value(&at_centre(at, &motion.centre)),
        }
    }

    /// Computes Ω(e₃ × r, n) of a surface that turns in the fixed frame, which is 0 exactly if it turns into itself.
    pub fn leaves_itself<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        let rate = self.rotation.as_ref().filter(|_| !self.rotating_frame)?;
        let BallMotion { normal, centre, .. } = self.motion(phase);
        let across = centre[0] * normal[1] - centre[1] * normal[0];
        Some(self.value(&phase.configuration, rate) * across)
    }

    fn value<T: Scalar>(&self, at: &Configuration<'_, T>, formula: &Formula) -> T {
        scalar(at.evaluate(formula))
    }

    /// Angular velocity Ωe₃ of the surface.
    fn turn<T: Scalar>(&self, at: &Configuration<'_, T>) -> Vector3<T> {
        let rate = self.rotation.as_ref().map_or_else(T::zero, |rate| self.value(at, rate));
        Vector3::new(T::zero(), T::zero(), rate)
    }

    fn slope_of_potential<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
        centre: &Vector3<T>,
    ) -> Option<Vector3<T>> {
        let potential = self.potential.as_ref()?;
        let at = at_centre(at, centre);
        Some(Vector3::from_fn(|i, _| potential.value(&at.lift(NORMAL, axis(i))).eps))
    }

    fn motion<'p, T: Scalar>(&self, phase: &'p Phase<'_, T>) -> &'p BallMotion<T> {
        phase.ball_motion(|| self.motion_at(&phase.configuration))
    }

    fn motion_at<T: Scalar>(&self, at: &Configuration<'_, T>) -> BallMotion<T> {
        let momentum = vector(at.variable(0));
        let (moment, radius) = (self.value(at, &self.moment), self.value(at, &self.radius));
        let rolling = self.value(at, &self.mass) * radius * radius;
        let spin = |normal: &Vector3<T>| {
            let along = normal * (momentum.dot(normal) * rolling / moment);
            (momentum + along).map(|x| x / (moment + rolling))
        };
        let turn = self.turn(at);
        let rolled = |omega: &Vector3<T>, normal: &Vector3<T>, centre: &Vector3<T>| match (
            &self.rotation,
            self.rotating_frame,
        ) {
            (None, _) => omega.cross(normal) * radius,
            (Some(_), true) => (omega - turn).cross(normal) * radius,
            (Some(_), false) => {
                omega.cross(normal) * radius + turn.cross(&(centre - normal * radius))
            }
        };
        match &self.surface {
            Surface::Level(_) | Surface::Arbitrary(_) => {
                let centre = vector(at.variable(NORMAL));
                let (slope, hessian) = self.surface.second_order(at);
                let length = slope.dot(&slope).sqrt();
                let normal = slope.map(|x| x / length);
                let omega = spin(&normal);
                let centre_rate = rolled(&omega, &normal, &centre);
                let change = hessian * centre_rate;
                let across = change - normal * normal.dot(&change);
                let normal_rate = across.map(|x| x / length);
                BallMotion { normal, centre, omega, centre_rate, normal_rate }
            }
            Surface::Support(shape) => {
                let normal = vector(at.variable(NORMAL));
                // The body's r = -∇h is the point with outward normal -γ; here r = ∇h.
                let (opposite, slope) = shape.contact(at);
                let centre = -opposite;
                let omega = spin(&normal);
                let centre_rate = rolled(&omega, &normal, &centre);
                let matrix = normal * normal.transpose() - slope;
                let adjugate = adjugate(&matrix);
                let determinant = determinant_with(&matrix, &adjugate);
                let normal_rate = (adjugate * centre_rate).map(|x| x / determinant);
                BallMotion { normal, centre, omega, centre_rate, normal_rate }
            }
        }
    }
}

impl Dynamics for BallOnSurface {
    fn functions(&self) -> Vec<&Formula> {
        self.surface.formula().into_iter().chain(self.dimensional()).collect()
    }

    fn constants(&self) -> Vec<&Formula> {
        [&self.mass, &self.radius, &self.moment].into_iter().chain(&self.rotation).collect()
    }

    fn dimensional(&self) -> Vec<&Formula> {
        self.potential.iter().filter_map(Potential::formula).collect()
    }

    fn chart(&self) -> Chart {
        match self.surface {
            Surface::Level(_) | Surface::Arbitrary(_) => Chart::Free,
            Surface::Support(_) => Chart::Sphere,
        }
    }

    /// Returns the rates (M', r') or (M', γ').
    fn field<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let at = &phase.configuration;
        let momentum = vector(at.variable(0));
        let BallMotion { normal, centre, omega, centre_rate, normal_rate } = *self.motion(phase);
        let (mass, radius) = (self.value(at, &self.mass), self.value(at, &self.radius));
        let turn = self.turn(at);
        let turned = self.rotating_frame;
        // Converts rates in a turning frame to the fixed frame.
        let absolute = |x: Vector3<T>, rate: Vector3<T>| {
            if turned { rate + turn.cross(&x) } else { rate }
        };
        let normal_moves = absolute(normal, normal_rate);
        let mut rate = normal_moves.cross(&omega.cross(&normal)) * (mass * radius * radius);
        if self.rotation.is_some() {
            let contact_moves = absolute(centre, centre_rate) - normal_moves * radius;
            rate -= normal.cross(&turn.cross(&contact_moves)) * (mass * radius);
        }
        if let Some(force) = self.slope_of_potential(at, &centre) {
            rate -= normal.cross(&force) * radius;
        }
        if turned {
            rate -= turn.cross(&momentum);
        }
        let second = match self.surface {
            Surface::Level(_) | Surface::Arbitrary(_) => centre_rate,
            Surface::Support(_) => normal_rate,
        };
        rate.iter().chain(second.iter()).copied().collect()
    }

    /// Energy (M,ω)/2 + U.
    fn energy<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        Some(self.total_energy(phase))
    }

    fn energy_is_inhomogeneous(&self) -> bool {
        self.potential.is_some() || self.rotation.is_some()
    }

    /// Returns μ(μ + D), by which ω is divided, and what the rate of γ is divided by: |∇F|² of a surface F = 0, or the
    /// determinant of γ ⊗ γ − ∂r of a support function.
    fn divisors<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let at = &phase.configuration;
        let (moment, radius) = (self.value(at, &self.moment), self.value(at, &self.radius));
        let inertia = moment * (moment + self.value(at, &self.mass) * radius * radius);
        let across = match &self.surface {
            Surface::Level(_) | Surface::Arbitrary(_) => {
                let (slope, _) = self.surface.second_order(at);
                slope.dot(&slope)
            }
            Surface::Support(shape) => {
                let normal = vector(at.variable(NORMAL));
                let (_, slope) = shape.contact(at);
                let matrix = normal * normal.transpose() - slope;
                determinant_with(&matrix, &adjugate(&matrix))
            }
        };
        vec![inertia, across]
    }

    fn without_forces(&self) -> Option<System> {
        let free = || System::Ball(Box::new(Self { potential: None, ..self.clone() }));
        self.rotation.is_none().then(free)
    }

    fn has_potential(&self) -> bool {
        self.potential.is_some()
    }

    fn potential_formula(&self) -> Option<&Formula> {
        self.potential.as_ref().and_then(Potential::formula)
    }

    fn has_arbitrary_function(&self) -> bool {
        self.surface.formula().is_none() || matches!(self.potential, Some(Potential::Arbitrary(_)))
    }

    fn quantity<T: Scalar>(&self, quantity: Quantity, phase: &Phase<'_, T>) -> Value<T> {
        let at = &phase.configuration;
        match (quantity, &self.surface) {
            (Quantity::Energy, _) => Value::Scalar(self.total_energy(phase)),
            (Quantity::Potential, _) => {
                let centre = at_centre(at, &self.motion(phase).centre);
                // Without a potential there are no forces, and U = 0.
                let value = |potential: &Potential| potential.value(&centre);
                Value::Scalar(self.potential.as_ref().map_or_else(T::zero, value))
            }
            (Quantity::AngularVelocity, _) => Value::Vector(self.motion(phase).omega),
            (Quantity::Normal, _) => Value::Vector(self.motion(phase).normal),
            (Quantity::NormalRate, _) => Value::Vector(self.motion(phase).normal_rate),
            (Quantity::Contact, _) => Value::Vector(self.motion(phase).centre),
            (Quantity::ContactRate, _) => Value::Vector(self.motion(phase).centre_rate),
            (Quantity::PotentialGradient, _) => {
                let slope = self.slope_of_potential(at, &self.motion(phase).centre);
                Value::Vector(slope.unwrap_or_else(|| Vector3::repeat(T::zero())))
            }
            (Quantity::SurfaceGradient, surface) => Value::Vector(surface.gradient(at)),
            (Quantity::SurfaceHessian, surface) => Value::Matrix(surface.second_order(at).1),
            (Quantity::Slope, Surface::Support(shape)) => Value::Matrix(-shape.contact(at).1),
            (
                Quantity::Profile | Quantity::ProfileRate | Quantity::ProfileSecond,
                Surface::Support(shape),
            ) => Value::Scalar(profile(shape, at, quantity)),
            _ => self.configuration_quantity(quantity, at),
        }
    }

    fn configuration_quantity<T: Scalar>(
        &self,
        quantity: Quantity,
        at: &Configuration<'_, T>,
    ) -> Value<T> {
        match (quantity, &self.surface) {
            (Quantity::RollingMoment, _) => {
                let radius = self.value(at, &self.radius);
                Value::Scalar(self.value(at, &self.mass) * radius * radius)
            }
            (Quantity::Support | Quantity::SurfaceFunction, surface) => {
                Value::Scalar(surface.value(at))
            }
            (Quantity::AxisCosine, _) => Value::Scalar(at.axis_cosine()),
            _ => Value::Scalar(T::undefined()),
        }
    }
}

/// Computes p, p' or p'' at γ₃/|γ|.
fn profile<T: Scalar>(shape: &Shape, at: &Configuration<'_, T>, quantity: Quantity) -> T {
    let [p, first, second] = shape.profile_jet(at, at.axis_cosine());
    match quantity {
        Quantity::Profile => p,
        Quantity::ProfileRate => first,
        _ => second,
    }
}

/// Replaces the second state variable by r, for the evaluation of U.
fn at_centre<'m, T: Scalar>(
    at: &Configuration<'m, T>,
    centre: &Vector3<T>,
) -> Configuration<'m, T> {
    at.moved(NORMAL, Value::Vector(*centre))
}
