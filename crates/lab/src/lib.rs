//! Measurements of the verifier: run time against error, and numerical stability.

pub mod bench;
pub mod stress;
