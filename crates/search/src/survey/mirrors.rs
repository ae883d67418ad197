//! Involutions about a vector n of the case: the reflection in the plane normal to n, and the half
//! turn about n.
//!
//! Together with ±E these are all involutions in O(3). A tilted plane of symmetry is normal to a
//! vector of the case: a parameter, or a normal to two parameters.

use liouville::case::Case;
use liouville::formula::{Formula, FormulaResult, Type};
use liouville::mechanics::Model;

/// A reflection, E − 2 n⊗n/(n,n), or a half turn, which is its negative.
#[derive(Clone, Debug)]
pub struct Mirror {
    /// Vector n.
    normal: Formula,
    is_turn: bool,
}

impl Mirror {
    /// Lists the candidate reflections and half turns.
    pub fn all(case: &Case) -> Vec<Self> {
        let both =
            |normal: Formula| [false, true].map(|is_turn| Self { normal: normal.clone(), is_turn });
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

    /// sign·Q x as a formula, x a variable.
    pub fn image(&self, x: &Formula, sign: i8) -> FormulaResult {
        let n = &self.normal;
        let along = (Formula::number(2) * &x.dot(n)? / &n.dot(n)? * n)?;
        match self.is_turn == (sign > 0) {
            true => &along - x,
            false => x - &along,
        }
    }

    /// Returns the name in BMB 2013, A.1, with the vector instead of the number of an axis.
    pub fn name(&self, reverses: bool) -> String {
        let letter = if self.is_turn { 'Π' } else { 'Σ' };
        let tilde = if reverses { "\u{303}" } else { "" };
        format!("{letter}{tilde}({})", self.normal.text().trim_matches(['(', ')']))
    }
}

/// Lists possible normals of planes of symmetry, as formulas in brackets.
fn normals(model: &Model) -> Vec<Formula> {
    let named = model.parameters.iter().filter(|one| one.kind == Type::VECTOR);
    // The coefficients of an arbitrary function define no direction.
    let named = named.filter(|one| !one.name.contains('['));
    let read = |name: &str| Formula::name(name, &model.vocabulary).ok();
    let vectors: Vec<Formula> = named.filter_map(|one| read(&one.name)).collect();
    let mut normals = vectors.clone();
    let across = |a: &Formula, b: &Formula| Some(a.cross(b).ok()?.bracketed());
    let (zero, one) = (Formula::number(0), Formula::number(1));
    let axis = Formula::vector(&[&zero, &zero, &one]).ok();
    for (k, a) in vectors.iter().enumerate() {
        normals.extend(vectors[k + 1..].iter().filter_map(|b| across(a, b)));
        // If only this vector is tilted, any plane through it will do.
        normals.extend(axis.as_ref().and_then(|axis| across(a, axis)));
    }
    normals
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_half_turn_is_minus_a_reflection() {
        let text = "title='t'\nsystem='field'\n[parameters]\nc='vector(1..2)'\n[state]\n\
                    x='vector(1..2)'\n[field]\nx='c'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let [normal, x] = ["c", "x"].map(|name| case.formula(name).expect("a name"));
        let [mirror, turn] =
            [false, true].map(|is_turn| Mirror { normal: normal.clone(), is_turn });
        let text = |one: &Mirror, sign| one.image(&x, sign).expect("a vector").to_string();
        assert_eq!(text(&mirror, -1), text(&turn, 1), "−(γ − 2(γ,c)c/(c,c))");
        assert_eq!(text(&mirror, 1), "x − 2*(x,c)/(c,c)*c");
        assert_eq!((mirror.fixed_space(1), mirror.fixed_space(-1)), (2, 1), "a plane, a line");
        assert_eq!((turn.fixed_space(1), turn.fixed_space(-1)), (1, 2), "the axis, and across it");
        assert_eq!(turn.name(true), "Π\u{303}(c)", "named by its axis");
    }
}
