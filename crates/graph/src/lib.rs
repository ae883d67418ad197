//! Graphs of arithmetic: recorded once, run in any number domain, proved to vanish, compiled.
//!
//! [`scalar::Scalar`] is the number that user code is generic over; [`graph::record`] runs such code
//! and keeps its operations. A [`graph::Tape`] of them is evaluated in any [`number::Domain`], and
//! [`proof::Prover`] decides whether a value vanishes identically. [`engine`] runs tapes in f64 in
//! bulk, with code that [`assembler`] encodes. Nothing here knows mechanics.

pub mod assembler;
pub mod engine;
pub mod graph;
pub mod number;
pub mod order;
pub mod proof;
pub mod scalar;
