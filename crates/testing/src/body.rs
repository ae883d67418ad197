//! Bodies given by support functions.

use num_dual::Dual;

use liouville::scalar::Scalar;

/// A convex body given by its support function.
///
/// h(γ) is the distance from the mass centre to the tangent plane with outward normal -γ, extended
/// by h(λγ) = λ h(γ) for λ > 0; then r = -∇h is the point of contact. A function on the unit sphere
/// alone is extended by [`OnUnitSphere`].
pub trait Body {
    /// Evaluates h(γ).
    fn support<T: Scalar>(&self, gamma: [T; 3]) -> T;
}

/// A ball with its mass centre at the centre: h = R|γ|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Radius R.
    pub radius: f64,
}

/// An ellipsoid with its mass centre at the centre: h = √(a²γ₁² + b²γ₂² + c²γ₃²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// Semi-axes a, b, c.
    pub axes: [f64; 3],
}

/// A polynomial support function on the unit sphere: h = |γ| Σ c Π (γᵢ/|γ|)^eᵢ.
#[derive(Clone, Debug, PartialEq)]
pub struct Polynomial {
    /// Exponents and coefficients.
    pub terms: Vec<([i32; 3], f64)>,
}

/// The Minkowski sum of two bodies, whose h is the sum of theirs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sum<A, B>(pub A, pub B);

/// A body with its mass centre moved by c: h + (c,γ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shifted<B> {
    /// Original body.
    pub body: B,
    /// Displacement c.
    pub by: [f64; 3],
}

/// A body whose h is defined on the unit sphere, and extended as |γ| h(γ/|γ|).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnUnitSphere<B>(pub B);

impl Body for Ball {
    fn support<T: Scalar>(&self, gamma: [T; 3]) -> T {
        length(gamma) * self.radius
    }
}

impl Body for Ellipsoid {
    fn support<T: Scalar>(&self, gamma: [T; 3]) -> T {
        let square = |(x, a): (T, f64)| (x * a) * (x * a);
        gamma.into_iter().zip(self.axes).map(square).sum::<T>().sqrt()
    }
}

impl Body for Polynomial {
    fn support<T: Scalar>(&self, gamma: [T; 3]) -> T {
        let length = length(gamma);
        let term = |(exponents, coefficient): &([i32; 3], f64)| {
            let degree: i32 = exponents.iter().sum();
            let powers = gamma.iter().zip(exponents).filter(|(_, e)| **e != 0);
            let monomial: T = powers.map(|(x, e)| x.powi(*e)).product();
            let homogeneous = match degree {
                0 => length,
                1 => monomial,
                _ => monomial * length.recip().powi(degree - 1),
            };
            homogeneous * *coefficient
        };
        self.terms.iter().map(term).sum()
    }
}

impl<A: Body, B: Body> Body for Sum<A, B> {
    fn support<T: Scalar>(&self, gamma: [T; 3]) -> T {
        self.0.support(gamma) + self.1.support(gamma)
    }
}

impl<B: Body> Body for Shifted<B> {
    fn support<T: Scalar>(&self, gamma: [T; 3]) -> T {
        let along: T = gamma.iter().zip(self.by).map(|(x, c)| *x * c).sum();
        self.body.support(gamma) + along
    }
}

impl<B: Body> Body for OnUnitSphere<B> {
    fn support<T: Scalar>(&self, gamma: [T; 3]) -> T {
        let length = length(gamma);
        length * self.0.support(gamma.map(|x| x / length))
    }
}

fn length<T: Scalar>(gamma: [T; 3]) -> T {
    gamma.into_iter().map(|x| x * x).sum::<T>().sqrt()
}

/// Computes h - (γ,∇h), which is 0 exactly when h is homogeneous of degree 1.
pub(super) fn euler_defect<T: Scalar>(body: &impl Body, gamma: [T; 3]) -> T {
    let h = body.support(gamma.map(|x| Dual::new(x, x)));
    h.re - h.eps
}
