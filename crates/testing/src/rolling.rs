//! Rubber rolling of a user-defined body.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual;

use super::body::{Body, euler_defect};
use super::notation::{Level, Quantity, VectorField};
use liouville::mechanics::{
    AcrossNormal, Pose, RollingTerms, contact_of, point_mass, rolling_point,
};
use liouville::scalar::Scalar;

/// A body rolling without slipping or spinning on a plane or a sphere: the field of (ω,γ) in ℝ⁶.
///
/// In the body frame ω is the angular velocity and γ the normal from the support to the body.
/// Borisov, Mamaev, Bizyaev, Rus. J. Nonlin. Dyn. 9 (2013), (1.4) on the plane, (1.12) on the
/// sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Rolling<B> {
    /// Shape of the body.
    pub body: B,
    /// Mass m.
    pub mass: f64,
    /// Central inertia tensor I, symmetric.
    pub inertia: [[f64; 3]; 3],
    /// Signed curvature k of the support: 0 for the plane, positive for a ball rolled on from
    /// outside.
    pub curvature: f64,
    /// Constant angular momentum S of a rotor.
    pub gyrostat: [f64; 3],
    /// Factor w of a potential U = w h(γ): on the plane, the weight.
    pub weight: f64,
}

/// Energy ½(ω,Ĩω) + U of a rolling body.
#[derive(Clone, Copy, Debug)]
pub struct Energy<'a, B>(&'a Rolling<B>);

/// The level γ² = 1, (ω,γ) = 0 in ℝ⁶, with the chart (u,v,a): γ = (2u, 2v, 1-u²-v²)/(1+u²+v²), ω =
/// γ×a.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RollingLevel;

impl<B: Body> Rolling<B> {
    /// Makes a body on a plane, without rotor and weight.
    pub fn on_plane(body: B, mass: f64, inertia: [[f64; 3]; 3]) -> Self {
        Self { body, mass, inertia, curvature: 0.0, gyrostat: [0.0; 3], weight: 0.0 }
    }

    /// Returns the energy, an integral.
    pub fn energy(&self) -> Energy<'_, B> {
        Energy(self)
    }

    /// Computes r, the point of contact relative to the mass centre.
    pub fn contact<T: Scalar>(&self, gamma: [T; 3]) -> [T; 3] {
        self.slope_of_support(gamma).map(|x| -x)
    }

    /// Computes Ĩ = I + m r²E - m r⊗r, the inertia tensor about the point of contact.
    pub fn moving_inertia<T: Scalar>(&self, gamma: [T; 3]) -> [[T; 3]; 3] {
        self.inertia_at(&self.contact(gamma).into()).transpose().into()
    }

    /// Computes ∇h.
    fn slope_of_support<T: Scalar>(&self, gamma: [T; 3]) -> [T; 3] {
        std::array::from_fn(|i| self.body.support(along(gamma, i)).eps)
    }

    fn inertia_at<T: Scalar>(&self, r: &Vector3<T>) -> Matrix3<T> {
        let central = Matrix3::from_fn(|i, j| T::from(self.inertia[i][j]));
        central + point_mass(T::from(self.mass), r)
    }

    fn motion<T: Scalar>(&self, [w1, w2, w3, g1, g2, g3]: [T; 6]) -> RollingTerms<T> {
        let gamma = [g1, g2, g3];
        let (r, slope) = contact_of(|i, j| self.body.support(along(along(gamma, i), j)));
        let normal = Vector3::from(gamma);
        let curvature = (self.curvature != 0.0).then(|| T::from(self.curvature));
        RollingTerms::of(Pose {
            omega: Vector3::new(w1, w2, w3),
            gamma: normal,
            mass: T::from(self.mass),
            curvature,
            gamma_across: curvature.map(|k| AcrossNormal::symmetric(&slope, k, &normal)),
            inertia: self.inertia_at(&r),
            r,
            slope,
        })
    }
}

/// Adds a derivative part along axis `index` to a vector.
fn along<T: Scalar>(gamma: [T; 3], index: usize) -> [Dual<T>; 3] {
    let part = |j: usize| if j == index { T::one() } else { T::zero() };
    std::array::from_fn(|j| Dual::new(gamma[j], part(j)))
}

impl<B: Body> VectorField<6> for Rolling<B> {
    fn rates<T: Scalar>(&self, x: [T; 6]) -> [T; 6] {
        let motion = self.motion(x);
        let slope = motion.pose.r.map(|x| x * -self.weight);
        let moment = motion.moment_of_potential(&slope);
        let gyrostat = Vector3::from(self.gyrostat).map(T::from);
        let (acceleration, _) =
            motion.acceleration(motion.torque(Some(gyrostat), std::iter::once(moment)));
        let [a, b] = [acceleration, motion.normal_rate];
        [a.x, a.y, a.z, b.x, b.y, b.z]
    }

    /// Returns the defects of Euler's relation for h and of the symmetry of I.
    fn conditions<T: Scalar>(&self, [_, _, _, g1, g2, g3]: [T; 6]) -> Vec<T> {
        let pairs = [(0, 1), (0, 2), (1, 2)];
        let entry = |i: usize, j: usize| T::from(self.inertia[i][j]);
        let skew = pairs.map(|(i, j)| entry(i, j) - entry(j, i));
        skew.into_iter().chain([euler_defect(&self.body, [g1, g2, g3])]).collect()
    }
}

impl<B: Body> Quantity<6> for Energy<'_, B> {
    fn value<T: Scalar>(&self, x: [T; 6]) -> T {
        let potential = self.0.body.support([x[3], x[4], x[5]]) * self.0.weight;
        self.0.motion(x).kinetic_energy() + potential
    }
}

impl Level<5, 6> for RollingLevel {
    fn point<T: Scalar>(&self, u: [T; 5]) -> [T; 6] {
        rolling_point(u)
    }

    fn functions<T: Scalar>(&self, [w1, w2, w3, g1, g2, g3]: [T; 6]) -> Vec<T> {
        vec![g1 * g1 + g2 * g2 + g3 * g3 - T::one(), w1 * g1 + w2 * g2 + w3 * g3]
    }
}
