//! Tests of partial derivatives against dual numbers.

use num_dual::Dual;
use proptest::prelude::*;

use super::random::grown;
use super::*;
use crate::formula::SymbolOrigin;

/// The names of the tests as variables, and abbreviations made of them.
struct Calculus(Vec<(&'static str, Formula)>);

const FIRST: u32 = 100;

impl Scope for Calculus {
    fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
        let place = self.0.iter().position(|(known, _)| *known == name);
        match place {
            Some(place) => Some((Symbol(FIRST + place as u32), self.0[place].1.value_type())),
            None => Names.lookup(name),
        }
    }

    fn names(&self) -> Vec<String> {
        Names.names()
    }

    fn whole_number(&self, name: &str) -> Option<i64> {
        Names.whole_number(name)
    }

    fn origin(&self, symbol: Symbol) -> SymbolOrigin<'_> {
        match symbol.0.checked_sub(FIRST) {
            Some(place) => SymbolOrigin::Defined(&self.0[place as usize].1),
            None if NAMES[symbol.0 as usize].0 == "n" => SymbolOrigin::Constant,
            None if NAMES[symbol.0 as usize].0 == "r'" => SymbolOrigin::Computed,
            None => SymbolOrigin::Variable,
        }
    }
}

impl Calculus {
    /// Abbreviations H and L = f(H), and a vector w and a matrix M.
    fn new() -> Self {
        let mut scope = Self(Vec::new());
        for (name, text) in [
            ("H", "(ω,Ĩ*ω)/2 + m*(γ,c)² + √x*y"),
            ("L", "H²*exp(−k*x) + m"),
            ("w", "H*γ − x*ω"),
            ("M", "γ ⊗ w + x*B"),
        ] {
            let formula = Formula::parse(text, &scope).expect(text);
            scope.0.push((name, formula));
        }
        scope
    }

    fn value<T: crate::scalar::Scalar>(
        &self,
        symbol: Symbol,
        own: &dyn Fn(Symbol) -> Value<T>,
    ) -> Value<T> {
        match self.origin(symbol) {
            SymbolOrigin::Defined(formula) => {
                formula.evaluate(&mut |symbol| self.value(symbol, own))
            }
            _ => own(symbol),
        }
    }

    fn read(&self, text: &str) -> Formula {
        Formula::parse(text, self).unwrap_or_else(|error| panic!("`{text}`: {error}"))
    }

    fn components(&self, formula: &Formula) -> Vec<f64> {
        formula.evaluate(&mut |symbol| self.value(symbol, &value_of)).components()
    }

    /// Derivative of a formula along one component of a variable, by dual numbers.
    fn slope(&self, formula: &Formula, variable: &str, component: usize) -> Vec<f64> {
        let seeded = |own: Symbol| {
            let mut place = 0;
            value_of(own).map(|re| {
                let varied = own == symbol(variable) && place == component;
                place += 1;
                Dual::new(re, if varied { 1.0 } else { 0.0 })
            })
        };
        let value = formula.evaluate(&mut |symbol| self.value(symbol, &seeded));
        value.components().iter().map(|x| x.eps).collect()
    }
}

#[track_caller]
fn close(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= 1e-9 * (1.0 + b.abs()), "{what}: {a} instead of {b}");
    }
}

#[test]
fn every_rule_agrees_with_dual_numbers() {
    let texts = [
        "x*y + m − x",
        "7*x³/(y + x)",
        "(1 + x)^(−3/2)*x^y",
        "x^k*k^x",
        "2^x + e^(x*y)",
        "√(x*y)*ln(x)",
        "sin(x)*cos(x*y) + tan(x/9)",
        "asin(x/9) + acos(x/8) + atan(x)",
        "sinh(x)*cosh(x/2)*tanh(x)",
        "asinh(x) + acosh(x + 2) + atanh(x/9)",
        "|x − 9|*|x|",
        "atan2(x, y) + atan2(y, x*x)",
        "sum(i, 1..3, x^i*γ[i])*product(i, 1..3, x + i)",
        "max(m, k)*x",
        "H",
        "L + x*H",
        "(w,γ)*x",
        "det(M + 9*E)",
        "tr(M*M)",
        "(γ,M⁻¹*γ)",
        "(ω,solve(B + x*E, γ))",
        "(ω,adj(B + x*E)*γ)",
        "tr((x*B)³)",
        "∂L/∂y",
        "∂(x²*y³)/∂y*x",
        "[x, x*y, m]",
        "x*γ × w",
        "x*B + γ ⊗ w*x",
        "M",
        "adj([[x, y], [x*y, 1]])",
        "diag(x, y, x*y)*Ĩ*Bᵀ",
    ];
    let scope = Calculus::new();
    for text in texts {
        let formula = scope.read(text);
        let found = scope.read(&format!("∂({text})/∂x"));
        close(&scope.components(&found), &scope.slope(&formula, "x", 0), text);
        let found = scope.read(&format!("partial({text}, γ[2])"));
        close(&scope.components(&found), &scope.slope(&formula, "γ", 1), text);
    }
}

#[test]
fn gradients_and_jacobians() {
    let scope = Calculus::new();
    for (name, text) in [("H", "H"), ("H", "(H)"), ("L", "L")] {
        let formula = scope.read(name);
        let found = scope.read(&format!("∂{text}/∂γ"));
        assert_eq!(found.value_type(), Type::VECTOR, "the gradient is a vector");
        let expected: Vec<f64> = (0..3).flat_map(|k| scope.slope(&formula, "γ", k)).collect();
        close(&scope.components(&found), &expected, text);
    }
    let (w, jacobian) = (scope.read("w"), scope.read("∂w/∂ω"));
    let columns: Vec<Vec<f64>> = (0..3).map(|k| scope.slope(&w, "ω", k)).collect();
    let expected: Vec<f64> = (0..9).map(|k| columns[k % 3][k / 3]).collect();
    close(&scope.components(&jacobian), &expected, "the entry i, j is ∂wᵢ/∂ωⱼ");
    let (trace, gradient) = (scope.read("tr(B*Ĩ*B)"), scope.read("∂(tr(B*Ĩ*B))/∂B"));
    let expected: Vec<f64> = (0..9).flat_map(|k| scope.slope(&trace, "B", k)).collect();
    close(&scope.components(&gradient), &expected, "by a matrix");
    let length = scope.read("∂(|u|²*u[4])/∂u");
    assert_eq!(length.value_type(), Type::Vector(4), "of any length");
    assert_eq!(scope.components(&scope.read("∂γ3/∂γ")), [0.0, 0.0, 1.0], "of a component");
    assert_eq!(scope.components(&scope.read("∂x/∂y + 2*∂x/∂x")), [2.0], "one or nothing");
    assert_eq!(scope.components(&scope.read("∂n/∂x")), [0.0], "of a constant");
    let (m, gamma) = (scope.read("Ĩ*γ"), scope.read("∂(γ,Ĩ*ω)/∂ω"));
    let expected = scope.read("Ĩᵀ*γ");
    assert_ne!(scope.components(&m), scope.components(&expected), "Ĩ is not symmetric here");
    close(&scope.components(&gamma), &scope.components(&expected), "of a dot product");
    let unit = scope.read("∂|γ|/∂γ");
    close(&scope.components(&unit), &scope.components(&scope.read("γ/|γ|")), "of a norm");
    let even = scope.components(&scope.read("∂(|γ − γ|² + |x − x|^4)/∂x"));
    assert_eq!(even, [0.0], "even powers of norms are smooth where these are 0");
    let power = scope.read("∂(x*y)/∂x²");
    let y = scalar_of("y");
    assert_eq!(scope.components(&power), [y * y], "the power of the derivative");
}

#[test]
fn it_is_undefined_where_the_function_is() {
    let scope = Calculus::new();
    let derivative = scope.read("∂(x + √(−y))/∂x");
    assert!(scope.components(&derivative)[0].is_nan(), "y > 0 there");
    let zero = scope.read("∂(√(−y))/∂x");
    assert!(scope.components(&zero)[0].is_nan(), "although it does not depend on x");
}

#[test]
fn what_has_no_derivative_is_refused() {
    let scope = Calculus::new();
    for (text, place, message) in [
        ("2*∂H", 2..6, "this derivative is not complete"),
        ("∂H/x", 0..6, "this derivative is not complete"),
        ("∂H*∂x", 0..4, "this derivative is not complete"),
        ("∂/∂x", 0..3, "this derivative is not complete"),
        ("∂(x,y)/∂x", 4..5, "a dot product"),
        ("∂H/∂n", 8..9, "`n` is not a state variable"),
        ("∂x/∂H", 8..9, "`H` is not a state variable"),
        ("partial(H, x*y)", 11..14, "`x*y` is not a state variable"),
        ("∂Q/∂x", 3..4, "unknown name `Q`"),
        ("∂H/∂q", 8..9, "unknown name `q`"),
        ("∂B/∂γ", 0..0, "a matrix is not differentiated by a vector"),
        ("∂(max(x, y))/∂x", 0..0, "`min` and `max` have no derivative here"),
        ("∂(sign(x))/∂x", 0..0, "`sign` has no derivative"),
        ("∂((r',γ))/∂x", 0..0, "`r'` is computed by the system"),
        ("u[∂H/∂x]", 0..0, ""),
    ] {
        let error = Formula::parse(text, &scope).map(|_| ()).expect_err(text);
        assert!(error.to_string().contains(message), "`{text}`: {error}");
        assert!(text.get(error.span()).is_some(), "`{text}`: the place is in the text");
        if place.end > place.start {
            assert_eq!(error.span().start, place.start, "`{text}`: {error}");
        }
    }
    assert!(Formula::parse("∂(max(k, y))/∂x", &scope).is_ok(), "no x in it");
}

#[test]
fn deep_abbreviations_are_refused() {
    let mut scope = Calculus(Vec::new());
    let names: Vec<&'static str> =
        (0..150).map(|k| -> &'static str { Box::leak(format!("A_{k}_").into()) }).collect();
    let mut last = "x".to_string();
    for name in names {
        let formula = Formula::parse(&format!("{last}*{last}"), &scope).expect("a product");
        scope.0.push((name, formula));
        last = name.to_string();
    }
    let error = Formula::parse(&format!("partial({last}, x)"), &scope).expect_err("too deep");
    assert!(error.to_string().contains("nested too deeply"), "{error}");
}

#[test]
fn mutants_and_substitution_leave_the_rules_alone() {
    let scope = Calculus::new();
    let formula = scope.read("∂(x³*y)/∂x − 3*x²*y");
    for mutant in formula.mutants(&scope) {
        let text = mutant.formula.text();
        assert!(text.contains('∂') || text == "(3*x²*y)", "{text}: the derivative stays");
    }
    assert!(formula.substitute("x", &read("m")).is_err(), "nothing is put into it");
    let sum = &formula + &read("m");
    let again = scope.read(&sum.expect("a sum").to_string());
    close(&scope.components(&again), &[scalar_of("m")], "it is part of other formulas");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn random_formulas_are_differentiated(sample in grown()) {
        let scope = Calculus(Vec::new());
        let text = &sample.text;
        let Ok(derivative) = Formula::parse(&format!("∂({text})/∂x"), &scope) else { return Ok(()) };
        let expected = scope.slope(&scope.read(text), "x", 0);
        let found = scope.components(&derivative);
        for (a, b) in found.iter().zip(&expected) {
            let same = (a - b).abs() <= 1e-6 * (1.0 + b.abs());
            prop_assert!(same || !b.is_finite() || !a.is_finite(), "∂({text})/∂x: {a}, not {b}");
        }
    }
}
