//! Solution of level sets in closed form: equations solved one after another, each for variables
//! that enter linearly or quadratically.
//!
//! ```text
//! quadric     one equation of degree 2 with numbers as coefficients and a rational point x₀:
//!             x = x₀ − 2B(x₀,u)/q(u) · u, without a root
//! frame       vectors whose products are numbers: reflections of unit vectors, without a root
//! linear      j equations jointly linear in j unknowns, given the rest: Cramer's rule
//! quadratic   the same, and one of degree 2 on the line left by the others: both roots
//! parameter   F(x) = c for a free parameter c that occurs nowhere else: c = F(x)
//! ```
//!
//! Each step uses the results of the steps before it. docs/soundness-levels.md, "Level sets", states when
//! no part of a level is missed.

mod analysis;
mod branches;
mod cover;
mod derivatives;
mod equation;
mod frame;
mod newton;
mod orientation;
mod quadric;
mod solution;
mod steps;

pub use analysis::{Order, solve};
pub use branches::branches;
pub use cover::{Cover, Part};
pub use newton::{Newton, has_moduli};
pub use orientation::{OfFrame, of_frames, signs};
pub use solution::{Solution, Solved};
pub use steps::Pivot;
