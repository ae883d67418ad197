//! What names mean: the surroundings of a formula, and how a written name is looked up in them.

use super::arena::Constant;
use super::names::canonical_name;
use super::value::Type;

/// A handle for what a name stands for; only the scope that gave it knows what it is.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(pub u32);

/// What names mean at the place where a formula stands.
pub trait Scope {
    /// The meaning of a name, given as written or in canonical form.
    fn lookup(&self, name: &str) -> Option<(Symbol, Type)>;

    /// Every known name, for suggestions.
    fn names(&self) -> Vec<String>;
}

/// What a written name turns out to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// A name of the scope.
    Whole(Symbol, Type),
    /// A component of a vector of the scope, counted from 0.
    Component(Symbol, usize),
    /// An entry of a matrix of the scope, row and column counted from 0.
    Entry(Symbol, usize, usize),
    /// The identity matrix.
    Identity,
    /// π or e.
    Constant(Constant),
    /// A component that does not exist, of the named vector or matrix.
    OutOfRange(String, Type),
}

/// Looks a written name up: as it stands, in canonical form, then as a component by its digits.
pub(super) fn resolve(written: &str, scope: &dyn Scope) -> Option<Meaning> {
    let whole = |name: &str| scope.lookup(name);
    if let Some((symbol, ty)) = whole(written) {
        return Some(Meaning::Whole(symbol, ty));
    }
    let name = canonical_name(written)?;
    if let Some((symbol, ty)) = whole(&name) {
        return Some(Meaning::Whole(symbol, ty));
    }
    match name.as_str() {
        "E" => return Some(Meaning::Identity),
        "π" => return Some(Meaning::Constant(Constant::Pi)),
        "e" => return Some(Meaning::Constant(Constant::Euler)),
        _ => {}
    }
    // the spelling as written may be the one in the scope: `gamma3` where `gamma` is declared
    component(&name, scope).or_else(|| component(written, scope))
}

/// Reads `γ3`, `I1`, `I12` as components of a known `γ`, `I`.
fn component(name: &str, scope: &dyn Scope) -> Option<Meaning> {
    let digits = name.bytes().rev().take_while(u8::is_ascii_digit).count();
    let mut out_of_range = None;
    for count in 1..=digits.min(2) {
        let (base, digits) = name.split_at(name.len() - count);
        let known = [base, base.trim_end_matches('_')].into_iter().find_map(|b| scope.lookup(b));
        let Some((symbol, ty)) = known else { continue };
        let indices: Vec<Option<usize>> = digits
            .bytes()
            .map(|digit| (b'1'..=b'3').contains(&digit).then(|| usize::from(digit - b'1')))
            .collect();
        match (ty, indices.as_slice()) {
            (Type::Vector, [Some(i)]) => return Some(Meaning::Component(symbol, *i)),
            (Type::Matrix, [Some(i)]) => return Some(Meaning::Entry(symbol, *i, *i)),
            (Type::Matrix, [Some(i), Some(j)]) => return Some(Meaning::Entry(symbol, *i, *j)),
            (Type::Scalar, _) => {}
            _ => out_of_range = Some(Meaning::OutOfRange(base.to_string(), ty)),
        }
    }
    out_of_range
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Names;

    impl Scope for Names {
        fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
            let (number, ty) = match name {
                "m" => (0, Type::Scalar),
                "γ" => (1, Type::Vector),
                "I" => (2, Type::Matrix),
                "γ2" => (3, Type::Scalar),
                "r'" => (4, Type::Vector),
                _ => return None,
            };
            Some((Symbol(number), ty))
        }

        fn names(&self) -> Vec<String> {
            Vec::new()
        }
    }

    #[test]
    fn names_resolve_whole_before_components() {
        let find = |name| resolve(name, &Names);
        assert_eq!(find("gamma"), Some(Meaning::Whole(Symbol(1), Type::Vector)), "canonical");
        assert_eq!(find("γ3"), Some(Meaning::Component(Symbol(1), 2)), "a component");
        assert_eq!(find("gamma_1"), Some(Meaning::Component(Symbol(1), 0)), "with underscore");
        assert_eq!(find("γ2"), Some(Meaning::Whole(Symbol(3), Type::Scalar)), "a whole name wins");
        assert_eq!(find("r'3"), Some(Meaning::Component(Symbol(4), 2)), "of a primed vector");
        assert_eq!(find("I1"), Some(Meaning::Entry(Symbol(2), 0, 0)), "a diagonal entry");
        assert_eq!(find("I₁₂"), Some(Meaning::Entry(Symbol(2), 0, 1)), "an entry");
        assert_eq!(find("E"), Some(Meaning::Identity), "E is the identity");
        assert_eq!(find("pi"), Some(Meaning::Constant(Constant::Pi)), "π by its name");
        assert_eq!(find("e"), Some(Meaning::Constant(Constant::Euler)), "Euler's number");
    }

    #[test]
    fn components_out_of_range_and_unknown_names_differ() {
        let out = Meaning::OutOfRange("γ".into(), Type::Vector);
        assert_eq!(resolve("γ4", &Names), Some(out), "γ has three components");
        assert_eq!(resolve("m1", &Names), None, "a scalar has none");
        assert_eq!(resolve("x", &Names), None, "unknown");
    }
}
