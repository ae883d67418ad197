//! Involutions about a vector n of the case: the reflection in the plane normal to n, and the half
//! turn about n.
//!
//! Together with ±E these are all involutions in O(3). A tilted plane of symmetry is normal to a
//! vector of the case: a parameter, or a normal to two parameters.

use liouville::case::Case;
use liouville::formula::Type;
use liouville::mechanics::Model;

/// A reflection, E − 2 n⊗n/(n,n), or a half turn, which is its negative.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mirror {
    /// Vector n as a formula.
    normal: String,
    is_turn: bool,
}

impl Mirror {
    /// Lists the candidate reflections and half turns.
    pub fn all(case: &Case) -> Vec<Self> {
        let both =
            |normal: String| [false, true].map(|is_turn| Self { normal: normal.clone(), is_turn });
        normals(&case.model).into_iter().flat_map(both).collect()
    }

    /// Returns det Q.
    pub fn determinant(&self) -> i8 {
        if self.is_turn { 1 } else { -1 }
    }

    /// Returns the dimension of {x : sign Qx = x}.
    pub fn fixed_space(&self, sign: i8) -> usize {
        if self.is_turn == (sign > 0) { 1 } else { 2 }
    }

    /// Writes sign·Q x as a formula.
    pub fn image(&self, name: &str, sign: i8) -> String {
        let n = &self.normal;
        let along = format!("2*({name},{n})/({n},{n})*{n}");
        match self.is_turn == (sign > 0) {
            true => format!("{along} − {name}"),
            false => format!("{name} − {along}"),
        }
    }

    /// Returns the name in BMB 2013, A.1, with the vector instead of the number of an axis.
    pub fn name(&self, reverses: bool) -> String {
        let letter = if self.is_turn { 'Π' } else { 'Σ' };
        let tilde = if reverses { "\u{303}" } else { "" };
        format!("{letter}{tilde}({})", self.normal.trim_matches(['(', ')']))
    }
}

/// Lists possible normals of planes of symmetry, as formulas in brackets.
fn normals(model: &Model) -> Vec<String> {
    let named = model.parameters.iter().filter(|one| one.kind == Type::VECTOR);
    // The coefficients of an arbitrary function define no direction.
    let vectors: Vec<&str> =
        named.map(|one| one.name.as_str()).filter(|name| !name.contains('[')).collect();
    let mut normals: Vec<String> = vectors.iter().map(|name| name.to_string()).collect();
    for (k, a) in vectors.iter().enumerate() {
        normals.extend(vectors[k + 1..].iter().map(|b| format!("({a} × {b})")));
        // If only this vector is tilted, any plane through it will do.
        normals.push(format!("({a} × [0, 0, 1])"));
    }
    normals
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_half_turn_is_minus_a_reflection() {
        let [mirror, turn] =
            [false, true].map(|is_turn| Mirror { normal: "c".to_string(), is_turn });
        assert_eq!(mirror.image("γ", -1), turn.image("γ", 1), "−(γ − 2(γ,c)c/(c,c))");
        assert_eq!((mirror.fixed_space(1), mirror.fixed_space(-1)), (2, 1), "a plane, a line");
        assert_eq!((turn.fixed_space(1), turn.fixed_space(-1)), (1, 2), "the axis, and across it");
        assert_eq!(turn.name(true), "Π\u{303}(c)", "named by its axis");
    }
}
