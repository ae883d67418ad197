//! Tests of motions, one module a subject.

mod branches;
mod closed_orbits;
mod integration;
mod motion;
mod reaches;
