//! Measurements of the verifier: run time against error, and numerical stability, and growth with
//! the size of a problem.

pub mod bench;
pub mod growth;
pub mod stress;

mod clock;
