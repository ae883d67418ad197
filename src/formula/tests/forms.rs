//! Vectors and matrices of any size, and forms with indices.

use nalgebra::{DMatrix, DVector};

use super::*;
use crate::formula::{Layout, WeightSystem};

#[track_caller]
fn same(left: &str, right: &str) {
    let (a, b) = (evaluate(left), evaluate(right));
    assert_eq!(a.value_type(), b.value_type(), "`{left}` and `{right}`");
    assert!(close(&a, &b), "`{left}` is {a:?}, but `{right}` is {b:?}");
}

fn list_of(name: &str) -> DVector<f64> {
    DVector::from_vec(value_of(symbol(name)).components())
}

fn table_of(text: &str) -> DMatrix<f64> {
    let value = evaluate(text);
    match value.value_type() {
        Type::Matrix(rows, columns) => DMatrix::from_row_slice(rows, columns, &value.components()),
        other => panic!("`{text}` is a {other}"),
    }
}

#[track_caller]
fn is(text: &str, expected: f64) {
    let value = evaluate(text);
    assert!(close(&value, &Value::Scalar(expected)), "`{text}` is {value:?}, not {expected}");
}

#[test]
fn linear_algebra_of_any_size() {
    let (u, v, a, p) = (list_of("u"), list_of("v"), table_of("A"), table_of("P"));
    is("(u,v) + u²", u.dot(&v) + u.norm_squared());
    is("|u − 2*v|", (&u - 2.0 * &v).norm());
    is("det(A)", a.determinant());
    is("tr(A*A) + tr(A²)", 2.0 * (&a * &a).trace());
    assert!((table_of("A⁻¹*A") - DMatrix::identity(4, 4)).norm() < 1e-9, "inverse");
    assert!((table_of("P*A*Pᵀ") - &p * &a * p.transpose()).norm() < 1e-9, "products");
    assert!((table_of("u ⊗ γ") - &u * list_of("γ").transpose()).norm() < 1e-12, "outer");
    same("solve(A, u)", "inverse(A)*u");
    same("adj(A)/det(A)", "inv(A)");
    same("A^3 − A^n", "A*A*A − A*A*A*A");
    same("P*u", "[P11*u1 + P[1,2]*u[2] + P13*u3 + P[1,4]*u[4], (P[2],u)]");
    same("E(4)*u + zero(4)", "u");
    same("diag(1,2,3,4)*u", "[u1, 2*u2, 3*u3, 4*u4]");
    same("diag(u)", "mat([u1,0,0,0],[0,u2,0,0],[0,0,u3,0],[0,0,0,u4])");
    same("mat(1,2,3,4)", "[[1,2],[3,4]]");
    same("vec(1,2)/2 + zero(2)", "[1/2,1]");
    same("zero(2,4) + P", "P");
    same("Pᵀ[3]", "[P13, P23]");
    is("det([[x]])*max(1,2,x−x)", 2.0 * scalar_of("x"));
    is("[x][1]", scalar_of("x"));
}

#[test]
fn sums_are_written_out() {
    let (u, v) = (list_of("u"), list_of("v"));
    is("sum(i, 1..n, u[i]*v[i])", u.dot(&v));
    is("sum(i, 1..4, i)", 10.0);
    is("product(i, 1..n, u[i])", u.product());
    is("product(k, 1..5, k)", 120.0);
    is("sum(i, 1..n-1, (u[i+1] − u[i])²)", (0..3).map(|i| (u[i + 1] - u[i]).powi(2)).sum());
    is("sum(i, 1..n, u[i]*u[i+1 mod n])", (0..4).map(|i| u[i] * u[(i + 1) % 4]).sum());
    is("sum(i, 1..n, u[i−1 mod n])", u.sum());
    is("u[n/2 + 1] + x^n", u[2] + scalar_of("x").powi(4));
    let pairs = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
        (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j))).map(|(i, j)| f(u[i], v[j])).sum()
    };
    let product = pairs(&|a, b| a * b);
    is("sum(i, 1..n−1, sum(j, i+1..n, u[i]*v[j]))", product);
    is("sum(i, 1..n, j, i+1..n, u[i]*v[j])", product);
    is("sum(i, 1..n, j, 1..n, i < j, u[i]*v[j])", product);
    is("sum(i, 1..n, j, 1..n, 1 ≤ i < j ≤ n, u[i]*v[j])", product);
    is("sum(i, 1..n, j, 1..n, i ≠ j, i <= j, u[i]*v[j])", product);
    is("sum(i, 1..n, j, 1..n, |i − j| = 1, 1)", 6.0);
    is("sum(i, 1..n, if(i = 2, x, if(i != 3, 0, y)))", scalar_of("x") + scalar_of("y"));
    is("sum(i, 3..2, 1/x) + product(i, 3..2, x)", 1.0);
    same("sum(j, 1..n, j ≠ 2, (u[j] − u[2])*γ)", "(u1 + u3 + u4 − 3*u2)*γ");
    same("γ + sum(i, 2..1, γ) − sum(i, 2..1, i*γ)", "γ");
    same("sum(i, 1..0, γ) − γ", "−γ");
}

#[test]
fn vectors_and_matrices_are_comprehended() {
    same("vector(i, 1..n, i*u[i])", "[u1, 2*u2, 3*u3, 4*u4]");
    same("matrix(i, 1..2, j, 1..3, i + 10*j)", "[[11,21,31],[12,22,32]]");
    same("matrix(i, 1..3, i*γ)", "mat(γ, 2*γ, 3*γ)");
    same("matrix(i, 1..n, j, 1..n, if(i = j, 1, 0))", "E(n)");
    same("vector(i, 1..3, sum(j, i+1..3, x))", "[2*x, x, 0]");
    same("matrix(i, 1..2, sum(j, i+1..2, γ))", "mat(γ, [0,0,0])");
    same("(vector(k, 1..3, tr(A^k)), [1,1,1])", "tr(A) + tr(A²) + tr(A³)");
    same("vector(i, 1..3, γ[i])", "γ");
}

#[test]
fn indices_are_numbers_and_hide_names() {
    is("sum(x, 1..3, x²)", 14.0);
    is("x + sum(x, 1..2, x)", scalar_of("x") + 3.0);
    assert_eq!(read("sum(i, 1..3, i/2)").constant().map(|c| c.to_string()), Some("3".into()));
    let formula = read("sum(i, 1..n, u[i])");
    assert_eq!(formula.symbols().collect::<Vec<_>>(), [symbol("u")], "n is known when it is read");
}

#[test]
fn forms_have_weights_mutants_and_boxes() {
    let mut weights = WeightSystem::new("time");
    weights.set(symbol("u"), 1.into());
    let mut weight = |text: &str| read(text).check_weights(&mut weights);
    assert_eq!(weight("sum(i, 1..n, u[i]²)"), Ok(Some(2.into())), "of the terms");
    assert_eq!(weight("product(i, 1..n, u[i])"), Ok(Some(4.into())), "of the factors");
    assert_eq!(weight("det(u ⊗ u)"), Ok(Some(8.into())), "as many rows");
    assert!(weight("sum(i, 1..2, if(i = 1, u[1], u[2]²))").is_err(), "terms differ");
    let texts: Vec<String> = read("sum(i, 1..n, u[i]*i + x)")
        .mutants(&Names)
        .iter()
        .map(|mutant| mutant.formula.text().to_string())
        .collect();
    assert!(texts.contains(&"sum(i, 1..n, u[i]*i − x)".to_string()), "{texts:?}");
    assert!(texts.len() < 20, "each place is changed once for all indices: {texts:?}");
    let set = |text: &str| {
        let layout = read(text).layout(&|symbol| NAMES[symbol.0 as usize].0.to_string());
        plain(&layout)
    };
    assert_eq!(set("sum(i, 1..3, u[i]*x)"), "u1 x+u2 x+u3 x", "short sums are whole");
    assert_eq!(set("2*sum(i, 1..9, x^i)"), "2 (x^{1}+x^{2}+…+x^{9})", "long ones have a gap");
    assert_eq!(set("vector(i, 1..9, x^i)"), "(x^{1},x^{2},…,x^{9})", "and so have lists");
}

/// Plain text of the boxes that occur here.
fn plain(layout: &Layout) -> String {
    match layout {
        Layout::Name { letter, index, .. } => format!("{letter}{index}"),
        Layout::Number(text) => text.clone(),
        Layout::Sign(sign) => sign.to_string(),
        Layout::Space => " ".to_string(),
        Layout::Row(parts) => parts.iter().map(plain).collect(),
        Layout::Fenced(open, inner, close) => format!("{open}{}{close}", plain(inner)),
        Layout::Raised(base, power) => format!("{}^{{{}}}", plain(base), plain(power)),
        other => format!("{other:?}"),
    }
}

#[test]
fn long_sums_take_linear_time() {
    let start = std::time::Instant::now();
    let formula = read("sum(i, 1..100, j, 1..100, i ≠ j, x^2/(i − j)²)");
    assert!(formula.evaluate(&mut value_of).scalar().is_some_and(f64::is_finite), "a number");
    let nested = "sum(a, 1..2, ".repeat(12) + "x" + &")".repeat(12);
    is(&nested, 4096.0 * scalar_of("x"));
    assert!(start.elapsed() < std::time::Duration::from_secs(5), "{:?}", start.elapsed());
}
