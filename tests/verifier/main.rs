//! Tests of the verifier through its public interface, one module a subject.

mod angles;
mod arbitrary;
mod assumptions;
mod bodies;
mod cofactor_poles;
mod cofactors;
mod combinations;
#[path = "../common/mod.rs"]
mod common;
mod definite_sums;
mod derivatives;
mod dissipation;
mod divisors;
mod documents;
mod domains;
mod doubts;
mod elimination;
mod ends_of_ranges;
mod expanded_levels;
#[path = "../common/files.rs"]
mod files;
mod free_energies;
mod functional_equations;
mod geometry;
mod golden;
mod halves;
mod hamiltonian;
mod inverse_functions;
mod involution;
mod kept_levels;
mod labels;
mod lanes;
mod language;
mod level_cells;
mod level_parts;
mod limits;
mod listed_conditions;
mod listed_levels;
mod listed_powers;
mod local;
mod lone_states;
mod lowest_terms;
mod many_variables;
mod masses;
mod merge;
mod missing_slopes;
mod mutated;
mod nesting;
mod newton_euler;
mod numerical_levels;
mod open_constants;
mod poles;
mod program;
mod proofs;
#[path = "../common/random.rs"]
mod random;
mod regular_parts;
mod remarks;
mod repeated_factors;
mod roots_of_levels;
mod samples;
mod signs_of_rates;
mod silent_states;
mod singular_bodies;
mod small_values;
mod states_that_count;
#[path = "../common/stream.rs"]
mod stream;
mod sweep;
mod systems;
mod textbook;
mod ties;
mod time_neighbours;
mod turning;
mod user_fields;
mod values;
mod verdicts;
mod wide_balls;
mod wider_places;

/// Folder of the catalogue, from that of this package.
const CASES: &str = "../cases";
