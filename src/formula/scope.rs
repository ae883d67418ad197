//! Meaning of names: the scope of a formula, and the lookup of written names in it.

use super::Formula;
use super::arena::Constant;
use super::kind::Type;
use super::names::canonical_name;

/// Handle for the meaning of a name; only the scope that issued it knows the meaning.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(pub u32);

/// Meanings of names at the place of a formula.
pub trait Scope {
    /// Meaning of a name, given as written or in canonical form.
    fn lookup(&self, name: &str) -> Option<(Symbol, Type)>;

    /// All known names, for suggestions.
    fn names(&self) -> Vec<String>;

    /// Whether a name, in canonical form, will be declared later: until then it has no other meaning.
    fn awaits(&self, _name: &str) -> bool {
        false
    }

    /// Whole number that a name stands for, if it is known when formulas are read: only such names
    /// may stand in indices and in the bounds of sums.
    fn whole_number(&self, _name: &str) -> Option<i64> {
        None
    }

    /// Origin of a symbol's value, which `∂F/∂x` has to know.
    fn origin(&self, _symbol: Symbol) -> SymbolOrigin<'_> {
        SymbolOrigin::Computed
    }
}

/// Origin of a symbol's value.
#[derive(Clone, Copy, Debug)]
pub enum SymbolOrigin<'s> {
    /// A variable, independent of all others.
    Variable,
    /// The same for all values of the variables.
    Constant,
    /// The value of a formula in the same scope.
    Defined(&'s Formula),
    /// Computed otherwise: it may depend on any variable.
    Computed,
}

/// Meaning of a written name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum NameMeaning {
    /// A name of the scope.
    Whole(Symbol, Type),
    /// A component of a vector of the scope, counted from 0.
    Component(Symbol, Type, usize),
    /// An entry of a matrix of the scope, row and column counted from 0.
    Entry(Symbol, Type, usize, usize),
    /// The identity matrix.
    Identity,
    /// π or e.
    Constant(Constant),
    /// Component that does not exist, of the named vector or matrix.
    OutOfRange(String, Type),
}

/// Looks up a written name: as it stands, in canonical form, then as a component by its digits.
pub(super) fn resolve(written: &str, scope: &dyn Scope) -> Option<NameMeaning> {
    let whole = |name: &str| scope.lookup(name);
    if let Some((symbol, ty)) = whole(written) {
        return Some(NameMeaning::Whole(symbol, ty));
    }
    let name = canonical_name(written)?;
    if let Some((symbol, ty)) = whole(&name) {
        return Some(NameMeaning::Whole(symbol, ty));
    }
    if scope.awaits(&name) {
        return None;
    }
    match name.as_str() {
        "E" => return Some(NameMeaning::Identity),
        "π" => return Some(NameMeaning::Constant(Constant::Pi)),
        "e" => return Some(NameMeaning::Constant(Constant::Euler)),
        _ => {}
    }
    // the spelling as written may be the one in the scope: `gamma3` where `gamma` is declared
    let both = component(&name, scope).or_else(|| component(written, scope));
    both.or_else(|| component(&with_digits_last(&name)?, scope))
}

/// Writes the rate of a component, as q1', as a component of a rate: q'1.
fn with_digits_last(name: &str) -> Option<String> {
    let bare = name.trim_end_matches('\'');
    let stem = bare.trim_end_matches(|c: char| c.is_ascii_digit());
    let (digits, primes) = (&bare[stem.len()..], &name[bare.len()..]);
    (!digits.is_empty() && !primes.is_empty()).then(|| format!("{stem}{primes}{digits}"))
}

/// Name under which the scope knows a symbol that is written by its name or a component's.
pub(super) fn name_of(written: &str, symbol: Symbol, scope: &dyn Scope) -> String {
    let canonical = canonical_name(written).unwrap_or_else(|| written.to_string());
    let moved = with_digits_last(&canonical);
    for name in [canonical.as_str(), written].into_iter().chain(moved.as_deref()) {
        let digits = name.bytes().rev().take_while(u8::is_ascii_digit).count();
        for count in 0..=digits.min(2) {
            let base = &name[..name.len() - count];
            let known = [base, base.trim_end_matches('_')].into_iter();
            let is_it = |base: &&str| scope.lookup(base).is_some_and(|(found, _)| found == symbol);
            if let Some(base) = known.into_iter().find(is_it) {
                return base.to_string();
            }
        }
    }
    canonical
}

/// Reads `γ3`, `I1`, `I12` as components of a known `γ`, `I`.
fn component(name: &str, scope: &dyn Scope) -> Option<NameMeaning> {
    let digits = name.bytes().rev().take_while(u8::is_ascii_digit).count();
    let mut out_of_range = None;
    for count in 1..=digits.min(2) {
        let (base, digits) = name.split_at(name.len() - count);
        let known = [base, base.trim_end_matches('_')].into_iter().find_map(|b| scope.lookup(b));
        let Some((symbol, ty)) = known else { continue };
        let place = |from: usize, count: usize| {
            let number: usize = digits[from..from + count].parse().unwrap_or_default();
            number.checked_sub(1)
        };
        match (ty, count) {
            (Type::Scalar, _) => continue,
            // two digits are one number where a vector is that long
            (Type::Vector(length), _) if count == 1 || length > 9 => {
                if let Some(i) = place(0, count).filter(|i| *i < length && !digits.starts_with('0'))
                {
                    return Some(NameMeaning::Component(symbol, ty, i));
                }
            }
            (Type::Matrix(rows, columns), 1) => {
                if let Some(i) = place(0, 1).filter(|i| *i < rows.min(columns)) {
                    return Some(NameMeaning::Entry(symbol, ty, i, i));
                }
            }
            (Type::Matrix(rows, columns), _) => {
                if let (Some(i), Some(j)) = (place(0, 1), place(1, 1))
                    && i < rows
                    && j < columns
                {
                    return Some(NameMeaning::Entry(symbol, ty, i, j));
                }
            }
            _ => {}
        }
        out_of_range = Some(NameMeaning::OutOfRange(base.to_string(), ty));
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
                "γ" => (1, Type::VECTOR),
                "I" => (2, Type::MATRIX),
                "γ2" => (3, Type::Scalar),
                "r'" => (4, Type::VECTOR),
                "x" => (5, Type::Vector(12)),
                "A" => (6, Type::Matrix(2, 3)),
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
        assert_eq!(find("gamma"), Some(NameMeaning::Whole(Symbol(1), Type::VECTOR)), "canonical");
        assert_eq!(
            find("γ3"),
            Some(NameMeaning::Component(Symbol(1), Type::VECTOR, 2)),
            "a component"
        );
        assert_eq!(
            find("gamma_1"),
            Some(NameMeaning::Component(Symbol(1), Type::VECTOR, 0)),
            "with underscore"
        );
        assert_eq!(
            find("γ2"),
            Some(NameMeaning::Whole(Symbol(3), Type::Scalar)),
            "a whole name wins"
        );
        assert_eq!(
            find("r'3"),
            Some(NameMeaning::Component(Symbol(4), Type::VECTOR, 2)),
            "of a primed vector"
        );
        assert_eq!(
            find("I1"),
            Some(NameMeaning::Entry(Symbol(2), Type::MATRIX, 0, 0)),
            "a diagonal entry"
        );
        assert_eq!(
            find("I₁₂"),
            Some(NameMeaning::Entry(Symbol(2), Type::MATRIX, 0, 1)),
            "an entry"
        );
        assert_eq!(find("E"), Some(NameMeaning::Identity), "E is the identity");
        assert_eq!(find("pi"), Some(NameMeaning::Constant(Constant::Pi)), "π by its name");
        assert_eq!(find("e"), Some(NameMeaning::Constant(Constant::Euler)), "Euler's number");
    }

    #[test]
    fn components_go_as_far_as_the_size() {
        let find = |name| resolve(name, &Names);
        let kind = Type::Vector(12);
        assert_eq!(find("x9"), Some(NameMeaning::Component(Symbol(5), kind, 8)), "one digit");
        assert_eq!(find("x12"), Some(NameMeaning::Component(Symbol(5), kind, 11)), "two digits");
        let out = |name: &str, kind| Some(NameMeaning::OutOfRange(name.into(), kind));
        assert_eq!(find("x13"), out("x", kind), "too far");
        let kind = Type::Matrix(2, 3);
        assert_eq!(find("A23"), Some(NameMeaning::Entry(Symbol(6), kind, 1, 2)), "row, column");
        assert_eq!(find("A2"), Some(NameMeaning::Entry(Symbol(6), kind, 1, 1)), "on the diagonal");
        assert_eq!((find("A31"), find("A3")), (out("A", kind), out("A", kind)), "too far");
    }

    #[test]
    fn components_out_of_range_and_unknown_names_differ() {
        let out = NameMeaning::OutOfRange("γ".into(), Type::VECTOR);
        assert_eq!(resolve("γ4", &Names), Some(out), "γ has three components");
        assert_eq!(resolve("m1", &Names), None, "a scalar has none");
        assert_eq!(resolve("y", &Names), None, "unknown");
    }
}
