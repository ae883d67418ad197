//! Decides which tensor invariants a mechanical system has.
//!
//! A case file names a system (a rigid body rolling without slipping or spinning, or any vector
//! field), its parameters, and claims: first integrals, invariant densities, the existence of a
//! density. The library differentiates, and answers each claim with a [`verdict::Verdict`] and its
//! evidence. A claim passes through the modules in this order:
//!
//! ```text
//! text ─ case ─▶ model and claims ─ record ─▶ graph ─▶ tape ─ number domains ─▶ verdict ─▶ report
//! ```
//!
//! # From a case to verdicts
//!
//! ```
//! use liouville::case::Case;
//! use liouville::verdict::{Options, Verdict, judge};
//!
//! let case = Case::parse(
//!     r#"
//!     title  = "Balanced ball on a plane"
//!     system = "rubber-plane"
//!     [parameters]
//!     m = "0.5..2"
//!     R = "1..3"
//!     I = "inertia(0.5..5)"
//!     [body]
//!     shape = "ball"
//!     [[claim]]
//!     integral = "|J*ω × γ|²"
//!     [[claim]]
//!     density = "(γ,J⁻¹*γ)"        # the root is missing
//!     "#,
//!     &[],
//! )?;
//! let report = judge(&case, &Options::default()).expect("the equations are regular");
//! assert_eq!(report.claims[0].verdict, Verdict::Proved);
//! assert_eq!(report.claims[1].verdict, Verdict::Refuted);
//! # Ok::<(), liouville::case::CaseError>(())
//! ```
//!
//! # A system and claims as values
//!
//! The same without a file: formulas are made of formulas, and a system takes them as they are.
//!
//! ```
//! use liouville::prelude::*;
//!
//! let names = Model::field()
//!     .parameter("a", "0.5..2")
//!     .parameter("b", "0.5..2")
//!     .variable("x", "0.5..3")
//!     .variable("y", "0.5..3");
//! let [a, b] = [names.formula("a")?, names.formula("b")?];
//! let [x, y] = [names.formula("x")?, names.formula("y")?];
//! let meetings = (&x * &y)?;
//! let case = names
//!     .rate("x", &a * &x - &meetings)
//!     .rate("y", &meetings - (&b * &y)?)
//!     .build()?;
//!
//! let logarithm = |of: &Formula| Formula::call("log", &[of]);
//! let volterra = (&x - (&b * logarithm(&x)?)? + &y - &(&a * logarithm(&y)?)?)?;
//! assert_eq!(volterra.to_string(), "x − b*log(x) + y − a*log(y)");
//! let claims = [
//!     Claim::integral(&volterra),
//!     Claim::integral(volterra.substitute("b", &a)?).expected(Expect::Fails),
//!     Claim::density((Formula::number(1) / &meetings)?),
//! ];
//! let report = case.judge(&claims, &Options::default())?;
//! assert!(report.claims.iter().all(|claim| claim.agrees));
//! assert_eq!(report.claims[0].verdict, Verdict::Proved);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Recording user code
//!
//! Any function generic over num-dual's `DualNum` can be recorded, differentiated and run:
//!
//! ```
//! use liouville::graph::{Evaluator, Tape, record};
//! use liouville::number::float::Float;
//! use num_dual::{Dual, DualNum};
//!
//! fn energy<T: DualNum<Primitive = f64> + Copy>(x: T, v: T) -> T {
//!     v * v / 2.0 - x.cos()
//! }
//!
//! let (graph, slope) = record(2, |input| {
//!     let x = Dual::from_re(input[0]).derivative();
//!     energy(x, Dual::from_re(input[1])).eps
//! })?;
//! let tape = Tape::new(&graph, &[slope]);
//! assert_eq!(tape.operations(), 1, "of all that was recorded, sin x is needed");
//! let mut evaluator = Evaluator::new(&tape, Float::<1>);
//! evaluator.run(&[[0.5], [1.0]]);
//! assert!((evaluator.output(0)[0] - 0.5f64.sin()).abs() < 1e-16);
//! # Ok::<(), liouville::graph::Fault>(())
//! ```

pub use liouville_graph::{assembler, engine, graph, number, order, proof, scalar};

pub mod case;
pub mod claim;
pub mod formula;
pub mod level;
pub mod mechanics;
pub mod part;
pub mod program;
mod requirement;
pub mod sweep;
pub mod verdict;

/// The names that most programs need.
///
/// ```
/// use liouville::prelude::*;
///
/// let case = Case::parse(
///     "title = \"oscillator\"\nsystem = \"field\"\n[state]\nx = \"-2..2\"\nv = \"-2..2\"\n\
///      [field]\n\"x'\" = \"v\"\n\"v'\" = \"-x\"\n[[claim]]\nintegral = \"x^2 + v^2\"\n",
///     &[],
/// )?;
/// let report = judge(&case, &Options::default())?;
/// assert_eq!(report.claims[0].verdict, Verdict::Proved);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub mod prelude {
    pub use crate::case::{Case, CaseError, ClaimError, Expect, Setting};
    pub use crate::claim::{Claim, Locus};
    pub use crate::formula::{Formula, FormulaError};
    pub use crate::graph::{Evaluator, Expr, Graph, Tape, record};
    pub use crate::mechanics::Model;
    pub use crate::number::rational::Rational;
    pub use crate::scalar::Scalar;
    pub use crate::verdict::{
        CaseReport, ClaimReport, ClaimsError, Evidence, JudgeError, Options, Verdict, evaluate,
        judge,
    };
}
