//! The raw equations of motion with multipliers, as one linear system.
//!
//! In body axes, v is the velocity of the mass centre, Λ the force at the contact r, λγ the moment
//! that prevents spinning (λ = 0 where the body may spin), F and M the applied force and moment:
//!
//! ```text
//! m(v' + ω×v) = Λ + F                    Iω' + ω×(Iω + S) = r×Λ + λγ + M
//! v + ω×r = 0  ⇒  v' + ω'×r + ω×r' = 0   (ω,γ) = 0  ⇒  (ω',γ) + (ω,γ') = 0
//! ```

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

/// A state with the load on the body there.
pub struct Moment {
    pub mass: f64,
    pub inertia: Matrix3<f64>,
    pub rotor: Vector3<f64>,
    pub omega: Vector3<f64>,
    pub gamma: Vector3<f64>,
    pub gamma_rate: Vector3<f64>,
    pub r: Vector3<f64>,
    pub r_rate: Vector3<f64>,
    pub force: Vector3<f64>,
    pub torque: Vector3<f64>,
}

/// Angular acceleration ω' with a bound on its error.
pub struct Acceleration {
    pub value: Vector3<f64>,
    pub error: f64,
}

/// Number of roundings in any term of the equations, inputs included: the longest chain is that of
/// r' for an ellipsoid, some thirty operations.
pub const ROUNDINGS: f64 = 64.0;

impl Moment {
    /// Solves for (v', ω', Λ, λ), with λ = 0 in place of the last equation if the body `spins`.
    pub fn solve(&self, spins: bool) -> Acceleration {
        type Square = SMatrix<f64, 10, 10>;
        type Column = SVector<f64, 10>;
        let v = -self.omega.cross(&self.r);
        let mut a = Square::zeros();
        let identity = Matrix3::identity();
        a.fixed_view_mut::<3, 3>(0, 0).copy_from(&(identity * self.mass));
        a.fixed_view_mut::<3, 3>(0, 6).copy_from(&-identity);
        a.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.inertia);
        a.fixed_view_mut::<3, 3>(3, 6).copy_from(&-self.r.cross_matrix());
        a.fixed_view_mut::<3, 1>(3, 9).copy_from(&-self.gamma);
        a.fixed_view_mut::<3, 3>(6, 0).copy_from(&identity);
        a.fixed_view_mut::<3, 3>(6, 3).copy_from(&-self.r.cross_matrix());
        match spins {
            true => a[(9, 9)] = 1.0,
            false => a.fixed_view_mut::<1, 3>(9, 3).copy_from(&self.gamma.transpose()),
        }
        let momentum = self.inertia * self.omega + self.rotor;
        let mut b = Column::zeros();
        b.fixed_rows_mut::<3>(0).copy_from(&(self.force - self.omega.cross(&v) * self.mass));
        b.fixed_rows_mut::<3>(3).copy_from(&(self.torque - self.omega.cross(&momentum)));
        b.fixed_rows_mut::<3>(6).copy_from(&-self.omega.cross(&self.r_rate));
        b[9] = if spins { 0.0 } else { -self.omega.dot(&self.gamma_rate) };

        let x = a.lu().solve(&b).expect("the constraints determine the motion");
        let spread = a.singular_values();
        // |x - x*| ≤ |A⁻¹| (|b - Ax| + |δb| + |δA||x|): the residual, and the rounding errors of b
        // and A, measured by the sizes of the terms before they cancel.
        let sizes = self.force.norm()
            + self.torque.norm()
            + self.omega.norm()
                * (v.norm() * self.mass
                    + self.inertia.norm() * self.omega.norm()
                    + self.rotor.norm()
                    + self.r_rate.norm()
                    + self.gamma_rate.norm());
        let formed = ROUNDINGS * f64::EPSILON * (sizes + a.norm() * x.norm());
        let error = ((b - a * x).norm() + formed) / spread.min();
        Acceleration { value: x.fixed_rows::<3>(3).into(), error }
    }
}
