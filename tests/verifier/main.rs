//! Tests of the verifier through its public interface, one module a subject.

mod bodies;
#[path = "../common/mod.rs"]
mod common;
mod derivatives;
mod dissipation;
mod documents;
mod domains;
mod doubts;
mod ends_of_ranges;
mod expanded_levels;
mod functional_equations;
mod geometry;
mod golden;
mod hamiltonian;
mod labels;
mod lanes;
mod language;
mod level_cells;
mod level_parts;
mod local;
mod many_variables;
mod masses;
mod mutated;
mod newton_euler;
mod poles;
#[path = "../common/random.rs"]
mod random;
mod regular_parts;
mod roots_of_levels;
mod silent_states;
mod sweep;
mod systems;
mod user_fields;
mod values;
mod verdicts;
mod wide_balls;
