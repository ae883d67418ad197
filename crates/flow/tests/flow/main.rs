//! Tests of motions, one module a subject.

mod branches;
mod closed_orbits;
mod exponents;
mod integration;
mod motion;
mod reaches;
