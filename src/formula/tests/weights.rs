//! Homogeneity in time: ω scales as time^-1, γ not at all.

use super::*;
use crate::formula::WeightSystem;
use crate::number::rational::Rational;

fn system() -> WeightSystem {
    let mut system = WeightSystem::new("time");
    for (name, weight) in [("ω", -1), ("γ", 0), ("m", 0), ("R", 0), ("I", 0), ("Ĩ", 0), ("B", -2)]
    {
        system.set(symbol(name), Rational::from(weight));
    }
    system
}

#[track_caller]
fn weighs(text: &str, expected: Option<Rational>) {
    let weight = read(text).check_weights(&mut system());
    assert_eq!(weight, Ok(expected), "the weight of `{text}`");
}

#[track_caller]
fn unequal(text: &str, message: &str, at: &str) {
    let error = read(text).check_weights(&mut system()).expect_err("unequal weights");
    assert_eq!(error.message(), message, "the message for `{text}`");
    assert_eq!(&text[error.span()], at, "the place in `{text}`");
}

#[test]
fn operations_carry_weights() {
    let whole = |n| Some(Rational::from(n));
    weighs("ω3", whole(-1));
    weighs("(Ĩ*ω,ω) + |ω|²", whole(-2));
    weighs("(Ĩ*ω,ω)^(1/4)*√|ω|", whole(-1));
    weighs("ω × (γ ⊗ ω)*ω", whole(-3));
    weighs("det(B)*tr(B)", whole(-8));
    weighs("adj(B)[1,2]*B⁻¹[1,1]", whole(-2));
    weighs("solve(B, ω)", whole(1));
    weighs("B² + diag(ω1^4, 0, 0)", whole(-4));
    weighs("2*E*ω3", whole(-1));
    weighs("[ω1,0,-ω3]", whole(-1));
    weighs("∫(ω1, ω2) + ω3²", whole(-2));
    weighs("ln(ω3) + 1", whole(0));
    weighs("exp(ω1/ω2)*sin(2)", whole(0));
    weighs("π*e*sign(ω1)*tanh(ω1/ω2)*atan2(ω1, ω2)", whole(0));
    weighs("max(ω1, ω2) − min(ω1, 0)", whole(-1));
    weighs("|ω1|^(3/2)", Some(Rational::new(-3, 2)));
}

#[test]
fn zero_fits_any_weight() {
    weighs("ω3 + 0", Some(Rational::from(-1)));
    weighs("0*ω3 + γ3", Some(Rational::from(0)));
    weighs("(1 - 1)*γ + ω + 0*c", Some(Rational::from(-1)));
    weighs("0", None);
}

#[test]
fn unequal_terms_are_named() {
    unequal(
        "m*(ω3 + 1)",
        "terms of unequal weight: `ω3` scales as time^-1, `1` as time^0",
        "(ω3 + 1)",
    );
    unequal(
        "0 + ω1 - (ω2 + ω3) + 2*γ1",
        "terms of unequal weight: `ω1` scales as time^-1, `2*γ1` as time^0",
        "0 + ω1 - (ω2 + ω3) + 2*γ1",
    );
    unequal(
        "B + m*E",
        "terms of unequal weight: `B` scales as time^-2, `m*E` as time^0",
        "B + m*E",
    );
    unequal(
        "vec(x, x*ω1, 0)",
        "terms of unequal weight: `x` scales as `x*ω1` times time^1",
        "vec(x, x*ω1, 0)",
    );
    unequal("exp(ω3)", "the argument of exp must have weight 0: `ω3` scales as time^-1", "ω3");
    let cosh = "the argument of cosh must have weight 0: `ω3` scales as time^-1";
    unequal("cosh(ω3)", cosh, "ω3");
    unequal(
        "max(ω3, γ3)",
        "terms of unequal weight: `ω3` scales as time^-1, `γ3` as time^0",
        "max(ω3, γ3)",
    );
    unequal("m^ω3", "an exponent must have weight 0: `ω3` scales as time^-1", "ω3");
}

#[test]
fn unknown_weights_are_inferred_across_formulas() {
    let mut weights = system();
    let check = |text: &str, weights: &mut WeightSystem| read(text).check_weights(weights);
    assert_eq!(check("x*y", &mut weights), Ok(None), "nothing says what x weighs");
    assert_eq!(check("x*ω1 + y²", &mut weights), Ok(None), "one equation, two unknowns");
    assert_eq!(check("x + √y", &mut weights), Ok(Some(Rational::new(-1, 3))), "the other equation");
    assert_eq!(weights.get(symbol("y")), Some(Rational::new(-2, 3)), "y follows");
    let error = check("x + y", &mut weights).expect_err("they differ");
    assert_eq!(
        error.message(),
        "terms of unequal weight: `x` scales as time^(-1/3), `y` as time^(-2/3)",
        "known by now"
    );
}

#[test]
fn symbolic_powers_stay_open() {
    weighs("|γ|^k", Some(Rational::from(0)));
    weighs("|ω|^k", None);
    weighs("|ω|^k + ω1", Some(Rational::from(-1)));
    weighs("(|ω|^k + 1)/m^x", Some(Rational::from(0)));
}

#[test]
fn long_formulas_are_checked_in_linear_time() {
    let text = vec!["x*|ω|^k"; 20_000].join(" + ");
    let start = std::time::Instant::now();
    assert_eq!(read(&text).check_weights(&mut system()), Ok(None), "consistent");
    assert!(start.elapsed() < std::time::Duration::from_secs(5), "{:?}", start.elapsed());
}
