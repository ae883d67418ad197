//! Tests of the logarithmic derivative against derivative over value.

use num_dual::Dual;

use super::*;

/// A direction in which every component changes at a different rate.
fn seeded(symbol: Symbol) -> Value<Dual<f64>> {
    let mut speed = 0.3 + 0.1 * f64::from(symbol.0);
    value_of(symbol).map(|re| {
        speed = 1.7 - 0.9 * speed;
        Dual::new(re, speed)
    })
}

#[test]
fn it_is_derivative_over_value() {
    let texts = [
        "x",
        "m*x/y",
        "-x*|γ3 - 2*ω1|/k",
        "x^3*y^-2",
        "x^(1/3)/√y",
        "√(x*y + 1)*sqrt(γ1)",
        "x^((1+k*R)/2)*y",
        "(x*y)^x/γ2^ω2",
        "exp(-x*y)*x^2",
        "exp(sin(x))/(1 + x²)",
        "(γ,Ĩ*ω)*det(B)/|γ|",
        "|γ × ω|^k",
        "x^0*y",
        "7*ln(x)*tan(y)",
        "(√x)^(2*k)/exp(x)^y",
    ];
    for text in texts {
        let formula = read(text);
        let direct = formula.evaluate(&mut seeded).scalar().expect("a scalar");
        let expected = direct.eps / direct.re;
        let found = formula.logarithmic_derivative(&mut seeded);
        let error = (found - expected).abs() / expected.abs().max(1.0);
        assert!(error < 1e-12, "`{text}`: {found} instead of {expected}");
    }
}

#[test]
fn constants_and_overflowing_densities() {
    let found = read("√2*3/7").logarithmic_derivative(&mut seeded);
    assert_eq!(found, 0.0, "a constant does not change");
    let rate = read("exp(1000*x)^100").logarithmic_derivative(&mut seeded);
    let expected = 1e5 * seeded(symbol("x")).scalar().expect("a scalar").eps;
    assert!((rate / expected - 1.0).abs() < 1e-12, "{rate}: the value itself overflows");
    let of_vector = read("γ").logarithmic_derivative(&mut seeded);
    assert!(!of_vector.is_finite(), "{of_vector}: a vector has no logarithm");
}

#[test]
fn a_negative_factor_needs_no_logarithm() {
    let rate = read("(1 - 5*x)^2*√(-(1 - 5*x))").logarithmic_derivative(&mut seeded);
    let x = seeded(symbol("x")).scalar().expect("a scalar");
    let expected = 2.5 * -5.0 * x.eps / (1.0 - 5.0 * x.re);
    assert!((rate - expected).abs() < 1e-12, "{rate} instead of {expected}");
}
