//! Property tests for Rust code: strategies, and assertions about vector fields.
//!
//! A field, a quantity or a body is code generic over num-dual's `DualNum`. An assertion runs it
//! over the recording scalar, differentiates by num-dual, and evaluates the residual in balls: an
//! enclosure that excludes 0 fails, and there is no tolerance to choose.
//!
//! ```
//! use liouville_testing::{VectorField, field, quantity};
//! use num_dual::DualNum;
//! use proptest::prelude::*;
//!
//! fn euler_top<T: DualNum<Primitive = f64> + Copy>([p, q, r]: [T; 3], [a, b, c]: [f64; 3]) -> [T; 3] {
//!     [q * r * (b - c) / a, r * p * (c - a) / b, p * q * (a - b) / c]
//! }
//!
//! fn square<T: DualNum<Primitive = f64> + Copy>(x: [T; 3], moments: [f64; 3]) -> T {
//!     x.iter().zip(moments).map(|(x, a)| (*x * a) * (*x * a)).sum()
//! }
//!
//! proptest! {
//!     # #![proptest_config(ProptestConfig { cases: 8, ..Default::default() })]
//!     # /*
//!     #[test]
//!     # */
//!     fn the_momentum_is_conserved(
//!         moments in liouville_testing::principal_moments(0.5..2.0),
//!         omega in liouville_testing::state::<3>(-2.0..2.0),
//!     ) {
//!         let top = field!(|x: [_; 3]| euler_top(x, moments), moments: [f64; 3]);
//!         top.conserves(&quantity!(|x: [_; 3]| square(x, moments), moments: [f64; 3])).at(&omega)?;
//!     }
//! }
//! # the_momentum_is_conserved();
//! ```
//!
//! # Bodies
//!
//! A body outside the catalogue is a type with a support function; [`Rolling`] provides its field:
//!
//! ```
//! use liouville::scalar::Scalar;
//! use liouville_testing::{AssertionFailure, Body, On, Rolling, RollingLevel, VectorField, quantity};
//!
//! /// Everything within `margin` of an ellipsoid with semi-axes a, ½, ½.
//! struct Rounded {
//!     margin: f64,
//!     a: f64,
//! }
//!
//! impl Body for Rounded {
//!     fn support<T: Scalar>(&self, [x, y, z]: [T; 3]) -> T {
//!         (x * x * (self.a * self.a) + (y * y + z * z) / 4.0).sqrt()
//!             + (x * x + y * y + z * z).sqrt() * self.margin
//!     }
//! }
//!
//! let body = Rounded { margin: 0.25, a: 1.5 };
//! let inertia = [[1.0, 0.0, 0.25], [0.0, 2.0, 0.0], [0.25, 0.0, 2.25]];
//! let rolling = Rolling { weight: 2.0, ..Rolling::on_plane(body, 1.0, inertia) };
//! let state = On { level: RollingLevel, coordinates: [0.5, -0.25, 1.0, 0.75, -0.5] };
//!
//! // On the whole level, not at this state alone:
//! let proof = rolling.conserves(&rolling.energy()).prove(&state)?;
//! assert!(proof.0.error_log2 < -100.0);
//!
//! // And the assertion can fail:
//! let first = quantity!(|x: [_; 6]| x[0] * x[0]);
//! let failure = rolling.conserves(&first).at(&state).expect_err("ω₁² is no integral");
//! assert!(failure.is_refutation());
//! # Ok::<(), AssertionFailure>(())
//! ```
//!
//! # Assertions
//!
//! | | vanishes |
//! |---|---|
//! | [`conserves`](VectorField::conserves) | L_vF |
//! | [`has_density`](VectorField::has_density), [`has_log_density`](VectorField::has_log_density) | v(ln ρ) + div v, minus the cofactors of the level functions |
//! | [`commutes_with`](VectorField::commutes_with) | \[v,u\] |
//! | [`is_reversed_by`](VectorField::is_reversed_by) | dσ·v + v∘σ and σ∘σ - id |
//!
//! [`at`](FieldClaim::at) asserts the property at a state, [`prove`](FieldClaim::prove) on the whole chart.
//! On a [`Level`] both also check that the chart's point lies on it and that the field preserves
//! it. The theory is in docs/soundness.md, the usage in docs/testing.md.

mod body;
mod claim;
mod failure;
mod macros;
mod notation;
mod recorded;
mod rolling;
mod settle;
mod strategies;

pub use liouville::scalar;

pub use body::{Ball, Body, Ellipsoid, OnUnitSphere, Polynomial, Shifted, Sum};
pub use claim::FieldClaim;
pub use failure::{AssertionFailure, ChartProof, DrawnState, FieldWitness};
pub use notation::{Involution, Level, On, Quantity, TestState, VectorField};
pub use rolling::{Energy, Rolling, RollingLevel};
pub use strategies::{
    body_of_revolution, convex_body, ellipsoid, inertia_tensor, number, principal_moments,
    rolling_state, state,
};
