//! Commented cases to start from, one for each kind of system.

/// Rates of the state variables, typed.
pub const FIELD: &str = include_str!("../templates/field.toml");
/// Hamiltonian and bracket.
pub const HAMILTONIAN: &str = include_str!("../templates/hamiltonian.toml");
/// Lagrangian, with constraints or without.
pub const LAGRANGIAN: &str = include_str!("../templates/lagrangian.toml");
/// Images of the state variables under a map.
pub const MAP: &str = include_str!("../templates/map.toml");
/// Body that rolls on a plane without slipping or spinning.
pub const ROLLING: &str = include_str!("../templates/rolling.toml");
/// Ball that rolls on a surface.
pub const SURFACE: &str = include_str!("../templates/surface.toml");

/// All of them, by name.
pub const ALL: [(&str, &str); 6] = [
    ("field", FIELD),
    ("hamiltonian", HAMILTONIAN),
    ("lagrangian", LAGRANGIAN),
    ("map", MAP),
    ("rolling", ROLLING),
    ("surface", SURFACE),
];
