//! Tests of the layout of formulas.

use super::on_a_large_stack;
use crate::formula::{Formula, Layout, Scope, Symbol, SymbolOrigin, Type};

struct Letters;

impl Scope for Letters {
    fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
        let kinds =
            [("m", Type::Scalar), ("k", Type::Scalar), ("ω", Type::VECTOR), ("J", Type::MATRIX)];
        let place = kinds.iter().position(|(known, _)| *known == name)?;
        Some((Symbol(place as u32), kinds[place].1))
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }

    fn origin(&self, _symbol: Symbol) -> SymbolOrigin<'_> {
        SymbolOrigin::Variable
    }
}

/// Plain text of the boxes, with every bracket.
fn plain(layout: &Layout) -> String {
    match layout {
        Layout::Number(text) => text.clone(),
        Layout::Name { letter, index, primes, .. } => {
            format!("{letter}{index}{}", "'".repeat(*primes))
        }
        Layout::Word(word) => word.to_string(),
        Layout::Sign(sign) => sign.to_string(),
        Layout::Space => " ".to_string(),
        Layout::Row(parts) => parts.iter().map(plain).collect(),
        Layout::Fenced(open, inner, close) => format!("{open}{}{close}", plain(inner)),
        Layout::Fraction(above, below) => format!("{{{}/{}}}", plain(above), plain(below)),
        Layout::Root(inner) => format!("√{{{}}}", plain(inner)),
        Layout::Raised(base, power) => format!("{}^{{{}}}", plain(base), plain(power)),
        Layout::Lowered(base, index) => format!("{}_{{{}}}", plain(base), plain(index)),
        Layout::Matrix(rows) => format!("{} rows", rows.len()),
    }
}

fn name(symbol: Symbol) -> String {
    ["m", "k", "ω", "J"][symbol.0 as usize].to_string()
}

fn read(text: &str) -> Formula {
    Formula::parse(text, &Letters).expect(text)
}

fn set(text: &str) -> String {
    plain(&read(text).layout(&name))
}

#[test]
fn what_stands_next_to_others_has_the_brackets_it_needs() {
    let rate = |text: &str| plain(&Layout::rate(read(text).layout_of_factor(&name)));
    assert_eq!(rate("m + k"), "{d (m+k)/dt}", "a sum");
    assert_eq!(rate("−m"), "{d (−m)/dt}", "a minus");
    assert_eq!(rate("m*k"), "{d (m k)/dt}", "a product");
    assert_eq!(rate("m²"), "{d m^{2}/dt}", "a power");
    assert_eq!(plain(&read("m*k").layout_of_product(&name)), "m k");
    assert_eq!(plain(&read("m − k").layout_of_product(&name)), "(m−k)");
    let parts = ["1", "−m*k", "m + k", "−(m − k)", "2*ω"].map(read);
    let parts = ["x", "y", "z", "u", "v"].into_iter().zip(&parts);
    let derivation = plain(&Layout::derivation(parts, &name));
    assert_eq!(derivation, "∂_{x}−m k ∂_{y}+(m+k) ∂_{z}−(m−k) ∂_{u}+2 ω·∂_{v}");
}

#[test]
fn long_chains_are_abridged() {
    let many = |first: &str, more: &str, count: usize| format!("{first}{}", more.repeat(count));
    assert_eq!(set(&many("m", " + k − 1", 10_000)), "m+k−…−1", "a sum");
    assert_eq!(set(&many("m", "*(k + 1)*m", 10_000)), "m·(k+1)·…·m", "a product");
    assert_eq!(set(&many("J", "*k", 10_000)), "k·J·…·k", "numbers and a matrix");
    assert_eq!(set(&many("J", "*J", 10_000)), "J·J·…·J", "matrices");
    assert_eq!(set(&many("m", "/k", 10_000)), "m/k/…/k", "quotients of quotients");
    let within = format!("2*(m + k)^2 + |{}|", many("m*k", " + k", 5_000));
    assert_eq!(set(&within), "2 (m+k)^{2}+|m k+k+…+k|", "only the chain that is long");
    assert_eq!(set(&many("m", "+k", 20)), many("m", "+k", 20), "what is not deep is whole");
    on_a_large_stack(|| {
        let nested = format!("{}m{}", "(m + k*".repeat(190), ")".repeat(190));
        assert_eq!(set(&nested).matches('(').count(), 189, "brackets nest less");
    });
}

#[test]
fn brackets_are_those_that_the_tree_needs() {
    assert_eq!(set("|J*ω × ω|²"), "|J ω×ω|^{2}", "a vector product is looser than a product");
    assert_eq!(set("m*(k + 1)²"), "m (k+1)^{2}", "a sum under an exponent");
    assert_eq!(set("m − (k − 1)"), "m−(k−1)", "a difference on the right");
    assert_eq!(set("(m − k) − 1"), "m−k−1", "and on the left");
    assert_eq!(set("−(1 − k)*m"), "−(1−k) m", "a minus before a product");
    assert_eq!(set("m*(−k)"), "m (−k)", "a minus inside one");
    assert_eq!(set("(m/k)²"), "({m/k})^{2}", "a quotient under an exponent");
    assert_eq!(set("m^((1 + k)/2)"), "m^{(1+k)/2}", "quotients in exponents stand in line");
    assert_eq!(set("m^(1/2)"), "m^{1/2}", "and so do numbers");
    assert_eq!(set("m*2"), "m·2", "digits are kept apart");
    assert_eq!(set("(ω,J⁻¹*ω)*det(J)"), "(ω,J^{−1} ω) det J", "the dot product has its own");
    assert_eq!(set("ω2*J13*J1"), "ω2 J13 J1", "components and entries");
    assert_eq!(set("m*∂(k² + m)/∂k"), "m {∂(k^{2}+m)/∂k}", "derivatives");
    assert_eq!(set("m^∂k/∂k"), "m^{∂k/∂k}", "in line under an exponent");
    assert_eq!(set("(J*ω)[3]"), "(J ω)_{3}", "of an expression");
    assert_eq!(set("√(m + k)*exp(−m)"), "√{m+k} exp(−m)", "functions");
    assert_eq!(set("2*π*e^m"), "2 π exp(m)", "constants");
    assert_eq!(set("max(m, k)*sinh(2*m)"), "max(m,k) sinh(2 m)", "of several arguments");
}
