//! Tests of searches, one module a method.

mod ansatz;
mod growth;
mod orbits;
mod plants;
mod ratios;
mod shapes;
mod squares;
mod wording;
