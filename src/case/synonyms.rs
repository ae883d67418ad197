//! Synonyms of keys.

/// Alternative names of keys.
const SYNONYMS: [(&str, &[&str]); 23] = [
    ("parameters", &["params", "param", "parameter", "constants", "constant"]),
    ("state", &["states", "vars", "phase", "coordinates", "unknowns"]),
    ("field", &["equations", "rates", "ode", "dynamics", "motion", "vector-field"]),
    ("let", &["definitions", "define", "abbreviations", "where", "aliases"]),
    ("variables", &["new-variables"]),
    ("claim", &["claims", "theorem", "statement"]),
    ("integral", &["first-integral", "conserved", "invariant", "constant-of-motion"]),
    ("density", &["measure", "invariant-measure", "jacobian-multiplier"]),
    ("identity", &["equation", "equality"]),
    ("invariant-relation", &["invariant-manifold", "darboux", "darboux-polynomial"]),
    ("no-invariant-relation", &["no-darboux", "no-darboux-polynomial", "no-invariant-manifold"]),
    ("expect", &["expected", "verdict", "result"]),
    ("where", &["place", "domain", "on"]),
    ("body", &["bodies", "rigid-body", "solid"]),
    ("lagrangian", &["lagrange", "L"]),
    ("hamiltonian", &["hamilton", "H"]),
    ("function", &["H", "energy", "hamiltonian"]),
    ("level", &["levels", "constraint", "constraints", "level-set"]),
    ("equations", &["equation", "constraints"]),
    ("constraints", &["nonholonomic", "equations"]),
    ("gyrostat", &["rotor", "gyro"]),
    ("kinetic", &["T", "kinetic-energy"]),
    ("potential", &["U", "V", "potential-energy"]),
];

/// Key meant by an alternative name, if it is one of `known`.
pub fn meant(name: &str, known: &[&'static str]) -> Option<&'static str> {
    let plain = name.to_lowercase().replace(['_', ' '], "-");
    let is_meant = |(key, all): &&(&'static str, &[&str])| {
        known.contains(key) && (all.contains(&name) || all.contains(&plain.as_str()))
    };
    SYNONYMS.iter().find(is_meant).map(|(key, _)| *key)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_names_are_understood_where_they_fit() {
        assert_eq!(meant("params", &["parameters", "state"]), Some("parameters"));
        assert_eq!(meant("First_Integral", &["integral"]), Some("integral"));
        assert_eq!(meant("measure", &["title"]), None, "not a key of this table");
    }
}
