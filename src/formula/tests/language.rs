//! Tests of the meaning of formulas: precedence, spellings, functions, constants, size.

use std::time::{Duration, Instant};

use nalgebra::Matrix3;

use super::*;
use crate::number::rational::Rational;

#[track_caller]
fn same(left: &str, right: &str) {
    let (a, b) = (evaluate(left), evaluate(right));
    assert!(close(&a, &b), "`{left}` is {a:?}, but `{right}` is {b:?}");
}

#[track_caller]
fn is(text: &str, expected: f64) {
    let value = evaluate(text);
    assert!(close(&value, &Value::Scalar(expected)), "`{text}` is {value:?}, not {expected}");
}

#[test]
fn operators_bind_as_in_the_papers() {
    let (m, x, y) = (scalar_of("m"), scalar_of("x"), scalar_of("y"));
    is("-x^2", -x * x);
    is("−x²", -x * x);
    is("2^-1", 0.5);
    is("2^3^2", 512.0);
    is("x^(1/2)", x.sqrt());
    is("½*x − ¾", x / 2.0 - 0.75);
    is("x^-1/2", 1.0 / x / 2.0);
    is("m - x - y", m - x - y);
    is("m / x / y", m / x / y);
    is("m*x^2*y", m * x * x * y);
    is("√g1*x", scalar_of("g1").sqrt() * x);
    is("√x^2", x);
    is("-√x", -x.sqrt());
    is("x*-y", -x * y);
    is("x--y", x + y);
    is("2*x²³", 2.0 * x.powi(23));
    same("2*γ × ω*3 + c", "6*(γ × ω) + c");
    same("Ĩ*ω × γ", "(Ĩ*ω) × γ");
    same("γ ⊗ ω − B", "outer(γ,ω) − B");
    same("|Ĩ*ω × γ|²", "norm(cross(Ĩ*ω, γ))^2");
}

#[test]
fn a_formula_of_the_papers_reads() {
    let (inertia, omega, gamma, c) =
        (matrix_of("Ĩ"), vector_of("ω"), vector_of("γ"), vector_of("c"));
    let (m, r) = (scalar_of("m"), scalar_of("R"));
    let momentum = inertia * omega;
    let expected =
        momentum.cross(&gamma).norm_squared() - 2.0 * m * r * gamma.dot(&c) * momentum.dot(&omega);
    is("|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)", expected);
    is("|Itilde*omega × gamma|^2 - 2·m·R·dot(γ,c)*(I\u{303}*ω,ω)", expected);
}

#[test]
fn components_have_many_spellings() {
    for text in ["gamma3", "γ₃", "γ[3]", "γ_3", "(γ)[3]", "(γ, [0,0,1])"] {
        same(text, "γ3");
    }
    is("r'2", vector_of("r'")[1]);
    is("r′2", vector_of("r'")[1]);
    is("I12", matrix_of("I")[(0, 1)]);
    is("I3", matrix_of("I")[(2, 2)]);
    is("(B*B)[2,3]", (matrix_of("B") * matrix_of("B"))[(1, 2)]);
    is("g1", scalar_of("g1"));
}

#[test]
fn bars_open_before_operands_and_close_after() {
    is("|γ|", vector_of("γ").norm());
    is("|-x|", scalar_of("x"));
    is("||γ|-|ω||", (vector_of("γ").norm() - vector_of("ω").norm()).abs());
    is("|γ × |x|*ω|", vector_of("γ").cross(&vector_of("ω")).norm() * scalar_of("x"));
    is("2*|x|*|y|^2", 2.0 * scalar_of("x") * scalar_of("y").powi(2));
    is("(|x|+1)*|y|", (scalar_of("x") + 1.0) * scalar_of("y"));
}

#[test]
fn matrices_follow_linear_algebra() {
    let b = matrix_of("B");
    assert!(close(&evaluate("B⁻¹*B"), &Value::Matrix(Matrix3::identity())), "inverse");
    same("inverse(B)*γ", "solve(B, γ)");
    same("inv(B)", "adj(B)/det(B)");
    same("B^3", "B*B*B");
    same("Bᵀ*γ", "transpose(B)*γ");
    same("tr(B) + Tr(B)", "2*trace(B)");
    same("[[1,2,3],[4,5,6],[7,8,9]]", "mat(1,2,3,4,5,6,7,8,9)");
    same("mat(γ,ω,c)ᵀ*[1,0,0]", "γ");
    same("diag(γ)", "diag(γ1,γ2,γ3)");
    same("E*γ", "vec(γ1,γ2,γ3)");
    is("det(B)", b.determinant());
    same("γ²", "(γ,γ)");
    same("γ^2", "dot(γ,γ)");
}

#[test]
fn functions_of_scalars() {
    let x = scalar_of("x");
    is("exp(ln(x)) + log(x)", x + x.ln());
    is("sin(x)^2 + cos(x)²", 1.0);
    is("tan(arctan(x)) + atan(x)", x + x.atan());
    is("abs(-x)*sqrt(x)", x * x.sqrt());
    is("x^((1+k*R)/2)", x.powf((1.0 + scalar_of("k") * scalar_of("R")) / 2.0));
}

#[test]
fn constants_have_names() {
    let x = scalar_of("x");
    is("π", std::f64::consts::PI);
    is("2*pi", std::f64::consts::TAU);
    is("e", std::f64::consts::E);
    is("e^x + e²", x.exp() + 1f64.exp().powi(2));
    is("e^-1", (-1f64).exp());
    assert_eq!(refuse("2π").help(), Some("write `2*π`"), "a product is written");
}

#[test]
fn hyperbolic_functions_and_inverses() {
    let x = scalar_of("x");
    is("sinh(x) + cosh(x)", x.exp());
    is("cosh(x)^2 − sinh(x)²", 1.0);
    is("tanh(x)*cosh(x)", x.sinh());
    is("asinh(sinh(x)) + arsinh(1)", x + 1f64.asinh());
    is("acosh(cosh(x)) + arcosh(2)", x + 2f64.acosh());
    is("atanh(tanh(x)/2)", (x.tanh() / 2.0).atanh());
    is("asin(1) + arcsin(1/2)", 1f64.asin() + 0.5f64.asin());
    is("acos(-1) + arccos(1/2)", std::f64::consts::PI + 0.5f64.acos());
    is("atan2(1, -2)", 1f64.atan2(-2.0));
    is("sign(-x) + sgn(x) + sign(3)", 1.0);
    is("min(x, 1 + x) + max(x, 1 + x)", 2.0 * x + 1.0);
}

#[test]
fn integrals_give_their_integrand_and_variable() {
    let formula = read("exp(∫(2*x, y) + integral(k, ω3))");
    assert!(formula.has_antiderivative(), "it contains integrals");
    let pairs = formula.antiderivatives(&mut value_of);
    let expected = [(2.0 * scalar_of("x"), scalar_of("y")), (scalar_of("k"), vector_of("ω")[2])];
    assert_eq!(pairs, expected, "in the order written");
    assert!(!read("x").has_antiderivative(), "x is no integral");
}

#[test]
fn plain_numbers_are_constants() {
    let constant = |text| read(text).constant();
    assert_eq!(constant("3/7"), Some(Rational::new(3, 7)), "a fraction");
    assert_eq!(constant("-0.5"), Some(Rational::new(-1, 2)), "a decimal");
    assert_eq!(constant("(1+2)*2^-2"), Some(Rational::new(3, 4)), "arithmetic");
    assert_eq!(constant("x/x"), None, "names are not constant");
    assert_eq!(constant("2^(1/2)"), None, "an irrational number");
    assert_eq!(constant("9^9^9^9"), None, "a number too large to write");
}

#[test]
fn symbols_are_listed_and_asked_for_once() {
    let formula = read("γ3*x + (γ,ω)*x");
    let symbols: Vec<Symbol> = formula.symbols().collect();
    assert_eq!(symbols, ["γ", "x", "ω"].map(symbol), "in the order written");
    let mut asked = Vec::new();
    formula.evaluate::<f64>(&mut |symbol| {
        asked.push(symbol);
        value_of(symbol)
    });
    assert_eq!(asked, symbols, "each once and no other");
    assert_eq!(formula.text(), "γ3*x + (γ,ω)*x", "the text is kept");
}

#[test]
fn a_name_of_the_scope_wins() {
    struct Odd;
    impl Scope for Odd {
        fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
            let place = ["E", "det", "gamma", "e"].iter().position(|known| *known == name)?;
            Some((Symbol(place as u32), Type::Scalar))
        }
        fn names(&self) -> Vec<String> {
            Vec::new()
        }
    }
    let formula = Formula::parse("E*det*gamma*e", &Odd).expect("four scalars");
    assert_eq!(formula.value_type(), Type::Scalar, "neither a matrix nor a function");
    assert_eq!(formula.symbols().count(), 4, "nor a constant");
    let error = Formula::parse("det(E)", &Odd).expect_err("det is a scalar here");
    assert_eq!(error.help(), Some("write `det*(E)`"));
}

#[test]
fn long_formulas_take_linear_time() {
    let terms = 100_000;
    let start = Instant::now();
    let sum = read(&vec!["γ3*x"; terms].join(" + "));
    let value = sum.evaluate(&mut value_of).scalar().expect("a scalar");
    let expected = terms as f64 * vector_of("γ")[2] * scalar_of("x");
    assert!((value / expected - 1.0).abs() < 1e-9, "the sum of {terms} terms");
    let product = read(&vec!["x"; terms].join("*"));
    assert!(product.evaluate(&mut value_of).scalar().is_some(), "the product of {terms} factors");
    let ones = read(&vec!["1"; terms].join("-"));
    assert_eq!(ones.constant(), Some(Rational::from(2 - terms as i64)), "a long constant");
    assert!(start.elapsed() < Duration::from_secs(5), "linear time: {:?}", start.elapsed());
}
