//! The shape of a body: its support function, and the point of contact r = -∇h that follows.
//!
//! h(γ) = -(r,γ) is the distance from the mass centre to the tangent plane with outward normal -γ.
//! Extended with degree 1 off |γ| = 1, it makes r homogeneous of degree 0; then Γ = E - k ∂r/∂γ is
//! symmetric with Γγ = γ, and γ² and (ω,γ) are conserved in all of R⁶.

use std::rc::Rc;

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual;

use super::configuration::Configuration;
use super::rubber::{NORMAL, normal};
use crate::formula::{Formula, Value};
use crate::scalar::Scalar;

/// Definition of a body's surface.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Support function h(γ), homogeneous of degree 1.
    Support(Formula),
    /// Support function h on the unit sphere, extended as |γ| h(γ/|γ|).
    SupportOnSphere(Formula),
    /// A body of revolution about e₃: h = |γ| p(z), z = γ₃/|γ|.
    Profile(Formula),
    /// Contact vector r(γ), extended off |γ| = 1 by its formula.
    Contact(Formula),
    /// Support function |γ| P(γ/|γ|) with a polynomial P whose coefficients are free parameters.
    Arbitrary(SurfacePolynomial),
    /// Profile |γ| P(z) with a polynomial P whose coefficients are free parameters.
    ArbitraryProfile(SurfacePolynomial),
}

/// A polynomial on the unit sphere, or on [-1,1], with free parameters as coefficients.
#[derive(Clone, Debug)]
pub struct SurfacePolynomial {
    /// Exponents of the variables, one triple for each coefficient.
    pub exponents: Vec<[u32; 3]>,
    /// Index of the first coefficient among the model's parameters.
    pub first_parameter: usize,
}

impl SurfacePolynomial {
    /// Makes all monomials of degrees `degree` and `degree - 1` in three variables.
    ///
    /// On the unit sphere these span all polynomials up to that degree, since γ² = 1 there.
    pub fn on_sphere(degree: u32, first_parameter: usize) -> Self {
        let mut exponents = Vec::new();
        for total in degree.saturating_sub(1)..=degree {
            for i in 0..=total {
                for j in 0..=total - i {
                    exponents.push([i, j, total - i - j]);
                }
            }
        }
        Self { exponents, first_parameter }
    }

    /// Makes all monomials up to `degree` in three variables.
    pub fn in_space(degree: u32, first_parameter: usize) -> Self {
        let mut exponents = Vec::new();
        for i in 0..=degree {
            for j in 0..=degree - i {
                exponents.extend((0..=degree - i - j).map(|k| [i, j, k]));
            }
        }
        Self { exponents, first_parameter }
    }

    /// Makes all powers of one variable up to `degree`.
    pub fn on_interval(degree: u32, first_parameter: usize) -> Self {
        Self { exponents: (0..=degree).map(|k| [0, 0, k]).collect(), first_parameter }
    }

    /// Evaluates the polynomial at x.
    pub fn evaluate<T: Scalar>(&self, at: &Configuration<'_, T>, x: Vector3<T>) -> T {
        let highest = self.exponents.iter().flatten().max().copied().unwrap_or(0);
        let powers: Vec<Vec<T>> = x
            .iter()
            .map(|x| {
                let next = |power: &T| Some(*power * *x);
                std::iter::successors(Some(T::one()), next).take(highest as usize + 1).collect()
            })
            .collect();
        // Products x^i y^j, each of which is a factor of several monomials.
        let mut pairs: Vec<Vec<Option<T>>> = vec![vec![None; powers[1].len()]; powers[0].len()];
        let times = |a: T, factors: &[T], exponent: usize| match exponent {
            0 => a,
            _ => a * factors[exponent],
        };
        let mut sum = T::zero();
        for (offset, exponents) in self.exponents.iter().enumerate() {
            let [i, j, k] = exponents.map(|exponent| exponent as usize);
            let pair = pairs[i][j].get_or_insert_with(|| match i {
                0 => powers[1][j],
                _ => times(powers[0][i], &powers[1], j),
            });
            let monomial = match (i, j) {
                (0, 0) => powers[2][k],
                _ => times(*pair, &powers[2], k),
            };
            sum += monomial * scalar(at.parameter(self.first_parameter + offset));
        }
        sum
    }
}

impl Shape {
    /// Returns the formula of the surface, unless it is an arbitrary function.
    pub fn formula(&self) -> Option<&Formula> {
        match self {
            Shape::Support(formula)
            | Shape::SupportOnSphere(formula)
            | Shape::Profile(formula)
            | Shape::Contact(formula) => Some(formula),
            Shape::Arbitrary(_) | Shape::ArbitraryProfile(_) => None,
        }
    }

    /// Evaluates h at a point of configuration space.
    pub fn support<T: Scalar>(&self, at: &Configuration<'_, T>) -> T {
        let gamma = normal(at);
        match self {
            Shape::Support(h) => scalar(at.evaluate(h)),
            Shape::SupportOnSphere(h) => {
                let length = gamma.dot(&gamma).sqrt();
                let on_sphere = at.moved(NORMAL, Value::Vector(gamma.map(|x| x / length)));
                length * scalar(on_sphere.evaluate(h))
            }
            Shape::Profile(_) | Shape::ArbitraryProfile(_) => {
                let length = gamma.dot(&gamma).sqrt();
                length * self.profile(at, gamma.z / length)
            }
            Shape::Contact(r) => -vector(at.evaluate(r)).dot(&gamma),
            Shape::Arbitrary(polynomial) => {
                // The 2 is one more free coefficient, fixed so that samples are convex.
                let length = gamma.dot(&gamma).sqrt();
                length * (polynomial.evaluate(at, gamma.map(|x| x / length)) + T::from(2.0))
            }
        }
    }

    /// Evaluates p(z), the support function of a body of revolution on the unit sphere.
    pub fn profile<T: Scalar>(&self, at: &Configuration<'_, T>, z: T) -> T {
        match self {
            Shape::Profile(p) => {
                // z is γ₃/|γ|: a profile uses γ through this cosine alone.
                scalar(at.with_axis_cosine(z).evaluate(p))
            }
            Shape::ArbitraryProfile(polynomial) => {
                polynomial.evaluate(at, Vector3::new(T::zero(), T::zero(), z)) + T::from(2.0)
            }
            _ => T::zero(),
        }
    }

    /// Returns r and ∂r/∂γ, where this is the shape of the model's body.
    pub fn contact<T: Scalar>(&self, at: &Configuration<'_, T>) -> (Vector3<T>, Matrix3<T>) {
        at.contact(|| self.derived_contact(at))
    }

    fn derived_contact<T: Scalar>(&self, at: &Configuration<'_, T>) -> (Vector3<T>, Matrix3<T>) {
        match self {
            Shape::Contact(r) => {
                let columns = [0, 1, 2].map(|j| vector(at.lift(NORMAL, axis(j)).evaluate(r)));
                (
                    columns[0].map(|x| x.re),
                    Matrix3::from_columns(&columns.map(|column| column.map(|x| x.eps))),
                )
            }
            _ => {
                let outer = [0, 1, 2].map(|i| at.lift(NORMAL, axis(i)));
                let parameters = outer[0].lifted_parameters();
                let second = |i: usize, j: usize| {
                    let direction = axis::<T>(j).map(Dual::from_re);
                    self.support(&outer[i].lift_with(Rc::clone(&parameters), NORMAL, &direction))
                };
                contact_of(second)
            }
        }
    }

    /// Returns p, p', p'' at z.
    pub fn profile_jet<T: Scalar>(&self, at: &Configuration<'_, T>, z: T) -> [T; 3] {
        let z = Dual::new(Dual::new(z, T::one()), Dual::from_re(T::one()));
        let lifted = at.lift_constant().lift_constant();
        let p = self.profile(&lifted, z);
        [p.re.re, p.re.eps, p.eps.eps]
    }
}

/// Computes r = -∇h and ∂r/∂γ from h with derivative parts along e_i and e_j, for i ≤ j.
pub fn contact_of<T: Scalar>(
    support: impl Fn(usize, usize) -> Dual<Dual<T>>,
) -> (Vector3<T>, Matrix3<T>) {
    let zero = T::zero();
    let mut r = Vector3::repeat(zero);
    let mut slope = Matrix3::repeat(zero);
    for i in 0..3 {
        for j in i..3 {
            let h = support(i, j);
            slope[(i, j)] = -h.eps.eps;
            slope[(j, i)] = -h.eps.eps;
            if i == j {
                r[i] = -h.re.eps;
            }
        }
    }
    (r, slope)
}

/// Returns the unit vector e_j as a value.
pub(super) fn axis<T: Scalar>(j: usize) -> Value<T> {
    let mut unit = Vector3::repeat(T::zero());
    unit[j] = T::one();
    Value::Vector(unit)
}

pub(super) fn scalar<T: Scalar>(value: Value<T>) -> T {
    value.scalar().unwrap_or_else(T::undefined)
}

pub(super) fn vector<T: Scalar>(value: Value<T>) -> Vector3<T> {
    value.vector().unwrap_or_else(|| Vector3::repeat(T::undefined()))
}

pub(super) fn matrix<T: Scalar>(value: Value<T>) -> Matrix3<T> {
    value.matrix().unwrap_or_else(|| Matrix3::repeat(T::undefined()))
}
