//! The surface on which the centre of a ball moves.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual;

use super::body::{Shape, SurfacePolynomial, axis, scalar, vector};
use super::configuration::Configuration;
use super::rubber::NORMAL;
use crate::formula::Formula;
use crate::scalar::Scalar;

/// Definition of the surface of the centre.
#[derive(Clone, Debug)]
pub enum Surface {
    /// Level surfaces of F(r); the state is (M, r).
    Level(Formula),
    /// Level surfaces of F = P(r) + r² with a polynomial P whose coefficients are free parameters;
    /// the state is (M, r).
    Arbitrary(SurfacePolynomial),
    /// A support function; the state is (M, γ).
    Support(Shape),
}

impl Surface {
    /// Whether the surface is a level of a function, so that the state is (M, r).
    pub fn is_level(&self) -> bool {
        !matches!(self, Surface::Support(_))
    }

    /// Returns the formula of the surface, unless it is an arbitrary function.
    pub fn formula(&self) -> Option<&Formula> {
        match self {
            Surface::Level(formula) => Some(formula),
            Surface::Arbitrary(_) => None,
            Surface::Support(shape) => shape.formula(),
        }
    }

    /// Evaluates F, or h of a support function.
    pub(super) fn value<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        match self {
            Surface::Level(formula) => scalar(at.evaluate(formula)),
            // r² has free coefficients too; it is added so that ∇F seldom vanishes at samples.
            Surface::Arbitrary(polynomial) => {
                let r = vector(at.variable(NORMAL));
                polynomial.evaluate(at, r) + r.dot(&r)
            }
            Surface::Support(shape) => shape.support(at),
        }
    }

    /// Computes the gradient ∂F/∂r.
    pub(super) fn gradient<T: Scalar>(&self, at: &Configuration<'_, T>) -> Vector3<T> {
        Vector3::from_fn(|i, _| self.value(&at.lift(NORMAL, axis(i))).eps)
    }

    /// Computes the gradient ∂F/∂r and the Hessian ∂²F/∂r².
    pub(super) fn second_order<T: Scalar>(
        &self,
        at: &Configuration<'_, T>,
    ) -> (Vector3<T>, Matrix3<T>) {
        let zero = T::zero();
        let (mut slope, mut hessian) = (Vector3::repeat(zero), Matrix3::repeat(zero));
        for i in 0..3 {
            let outer = at.lift(NORMAL, axis(i));
            for j in i..3 {
                let direction = axis::<T>(j).map(Dual::from_re);
                let value = self.value(&outer.lift(NORMAL, direction));
                hessian[(i, j)] = value.eps.eps;
                hessian[(j, i)] = value.eps.eps;
                slope[i] = value.re.eps;
            }
        }
        (slope, hessian)
    }
}
