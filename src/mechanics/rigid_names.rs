//! Evaluation of the names that a rolling body defines.

use nalgebra::Vector3;

use super::body::{matrix, scalar, vector};
use super::configuration::Configuration;
use super::linear::{isotropic, point_mass};
use super::phase::Phase;
use super::quantity::Quantity;
use super::rigid::RigidBody;
use super::rubber::normal;
use crate::formula::Value;
use crate::scalar::Scalar;

impl RigidBody {
    /// Evaluates a quantity named in a formula.
    pub(super) fn quantity<T: Scalar>(&self, quantity: Quantity, phase: &Phase<'_, T>) -> Value<T> {
        let at = &phase.configuration;
        match quantity {
            Quantity::Contact => Value::Vector(self.motion(phase).pose.r),
            Quantity::ContactRate => Value::Vector(self.motion(phase).contact_rate),
            Quantity::Slope => Value::Matrix(self.motion(phase).pose.slope),
            Quantity::InertiaAtContact => Value::Matrix(self.motion(phase).pose.inertia),
            Quantity::NormalRate => Value::Vector(self.motion(phase).normal_rate),
            Quantity::Gamma => Value::Matrix(match self.curvature_at(at) {
                None => isotropic(T::one()),
                Some(k) => self.gamma_matrix(&self.motion(phase).pose.slope, k),
            }),
            Quantity::GammaDeterminant => {
                Value::Scalar(match &self.motion(phase).pose.gamma_across {
                    None => T::one(),
                    Some(big_gamma) => big_gamma.determinant(),
                })
            }
            Quantity::Energy => Value::Scalar(self.energy(phase)),
            Quantity::Profile
            | Quantity::ProfileRate
            | Quantity::ProfileF1
            | Quantity::ProfileF2
            | Quantity::ProfileF1Rate
            | Quantity::ProfileF2Rate
            | Quantity::ProfileG1
            | Quantity::ProfileG1Rate
            | Quantity::ProfileG2 => Value::Scalar(self.profile_quantity(quantity, at)),
            _ => self.configuration_quantity(quantity, at),
        }
    }

    /// Evaluates a quantity that does not depend on velocities and needs no derivative.
    pub(super) fn configuration_quantity<T: Scalar>(
        &self,
        quantity: Quantity,
        at: &Configuration<'_, T>,
    ) -> Value<T> {
        let named = |name: &str| at.named(name);
        let radius = || named("R").map_or_else(T::undefined, scalar);
        let displacement = || named("c").map_or_else(|| Vector3::repeat(T::zero()), vector);
        let mass = || scalar(at.evaluate(&self.mass));
        let ball_inertia = || {
            let (m, radius) = (mass(), radius());
            matrix(at.evaluate(&self.inertia))
                + isotropic(m * radius * radius)
                + point_mass(m, &displacement())
        };
        match quantity {
            Quantity::Support => Value::Scalar(self.shape.support(at)),
            Quantity::BallInertia => Value::Matrix(ball_inertia()),
            Quantity::ScriptInertia => {
                let twice = T::from(2.0) * mass() * radius();
                let offset = normal(at).dot(&displacement());
                Value::Matrix(ball_inertia() + isotropic(twice * offset))
            }
            Quantity::Kappa => {
                let k = self.curvature.as_ref().map_or_else(T::zero, |k| scalar(at.evaluate(k)));
                Value::Scalar((T::one() + k * radius()).recip())
            }
            Quantity::Potential => {
                Value::Scalar(self.potential.as_ref().map_or_else(T::zero, |u| u.value(at)))
            }
            Quantity::AxisCosine => Value::Scalar(at.axis_cosine()),
            _ => Value::Scalar(T::undefined()),
        }
    }

    /// Computes f1, f2, g1, g2 of section 3.1 and their derivatives with respect to z, from the
    /// profile p(z).
    fn profile_quantity<T: Scalar>(&self, quantity: Quantity, at: &Configuration<'_, T>) -> T {
        let z = at.axis_cosine();
        let [p, p1, p2] = self.shape.profile_jet(at, z);
        let sine2 = T::one() - z * z;
        let mass = || scalar(at.evaluate(&self.mass));
        let inertia = || matrix(at.evaluate(&self.inertia));
        let f1 = z * p1 - p;
        match quantity {
            Quantity::Profile => p,
            Quantity::ProfileRate => p1,
            Quantity::ProfileF1 => f1,
            Quantity::ProfileF2 => -(z * p + sine2 * p1),
            Quantity::ProfileF1Rate => z * p2,
            Quantity::ProfileF2Rate => f1 - sine2 * p2,
            Quantity::ProfileG1 => {
                let inertia = inertia();
                inertia[(0, 0)] * z * z + inertia[(2, 2)] * sine2 + mass() * p * p
            }
            Quantity::ProfileG1Rate => {
                let inertia = inertia();
                let two = T::from(2.0);
                two * z * (inertia[(0, 0)] - inertia[(2, 2)]) + two * mass() * p * p1
            }
            // r² = p² + (1 - z²) p'²
            _ => inertia()[(0, 0)] + mass() * (p * p + sine2 * p1 * p1),
        }
    }
}
