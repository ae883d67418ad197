//! Tests of motions, one module a subject.

mod branches;
mod closed_orbits;
mod exponents;
mod integration;
mod map_points;
mod motion;
mod reaches;
