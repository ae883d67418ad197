//! Tests of formulas made of others: each reads as itself, and has the value it should.

use super::*;
use crate::number::rational::Rational;

const SCALARS: [&str; 22] = [
    "m",
    "−m",
    "2",
    "−3",
    "1/2",
    "0.25",
    "m + R",
    "m − R*k",
    "−m + R",
    "m*R",
    "−m*R",
    "2*m/R",
    "m/(R*k)",
    "m²",
    "m^(1/2)",
    "(m + R)^k",
    "√(m + R)",
    "(γ,ω)",
    "|γ × ω|²",
    "γ3",
    "  (m)*R ",
    "exp(−m)*I12",
];
const VECTORS: [&str; 9] =
    ["γ", "−γ", "γ + ω", "γ × ω", "2*γ", "I*γ", "I⁻¹*(γ × ω)", "[m, −R, 2]", "(γ,ω)*γ/m"];
const MATRICES: [&str; 6] = ["I", "I + B", "m*I", "I*B", "Bᵀ", "I⁻¹"];

fn read(text: &str) -> Formula {
    Formula::parse(text, &Names).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn values(formula: &Formula) -> Vec<f64> {
    formula.evaluate(&mut value_of).components()
}

/// Asserts that a formula reads as itself.
fn reads_back(formula: &Formula) {
    let again = read(&formula.to_string());
    let operations = |formula: &Formula| {
        formula.arena.nodes.iter().map(|node| node.operation.clone()).collect::<Vec<_>>()
    };
    assert_eq!(operations(formula), operations(&again), "{formula} reads as itself");
    assert!(formula.symbols().eq(again.symbols()), "{formula}: its symbols");
    assert!(formula.names().eq(again.names()), "{formula}: its names");
    for (own, read) in formula.arena.nodes.iter().zip(&again.arena.nodes) {
        let text = |from: &Formula, span: &std::ops::Range<usize>| {
            from.text.get(span.clone()).unwrap_or_default().trim().to_string()
        };
        let (own, read) = (text(formula, &own.span), text(&again, &read.span));
        assert_eq!(own, read, "{formula}: the texts of its parts");
    }
}

fn close(found: &[f64], expected: &[f64], what: &Formula) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (a, b) in found.iter().zip(expected) {
        let same = (a - b).abs() <= 1e-9 * (1.0 + b.abs()) || (a.is_nan() && b.is_nan());
        assert!(same, "{what} is {a}, and should be {b}");
    }
}

#[test]
fn operators_keep_their_meaning_and_read_back() {
    for a in SCALARS.map(read) {
        reads_back(&-&a);
        close(&values(&-&a), &[-values(&a)[0]], &-&a);
        for b in SCALARS.map(read) {
            let (x, y) = (values(&a)[0], values(&b)[0]);
            let all = [(&a + &b, x + y), (&a - &b, x - y), (&a * &b, x * y), (&a / &b, x / y)];
            for (made, expected) in all {
                let made = made.expect("scalars");
                reads_back(&made);
                close(&values(&made), &[expected], &made);
            }
        }
        for b in VECTORS.into_iter().chain(MATRICES).map(read) {
            let made = (&a * &b).expect("a scalar times anything");
            reads_back(&made);
            let expected: Vec<f64> = values(&b).iter().map(|y| values(&a)[0] * y).collect();
            close(&values(&made), &expected, &made);
            let made = (&b / &a).expect("anything over a scalar");
            reads_back(&made);
        }
    }
}

#[test]
fn components_have_the_names_that_mean_them() {
    /// A vector x of length 12, and one with a name in the way of a component.
    struct Long;
    impl Scope for Long {
        fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
            match name {
                "x" => Some((Symbol(0), Type::Vector(12))),
                "H_" => Some((Symbol(1), Type::VECTOR)),
                "γ" => Some((Symbol(2), Type::VECTOR)),
                "γ3" => Some((Symbol(3), Type::Scalar)),
                _ => None,
            }
        }

        fn names(&self) -> Vec<String> {
            ["x", "H_", "γ", "γ3"].map(String::from).to_vec()
        }
    }
    let element = |name: &str, index: usize| {
        let own = Formula::parse(name, &Long).expect("a vector").element(index, &Long);
        own.map(|own| own.to_string()).ok()
    };
    let named = |text: &str| Some(text.to_string());
    assert_eq!(element("x", 1), named("x1"));
    assert_eq!(element("x", 12), named("x12"), "not x1 and a 2");
    assert_eq!(element("H_", 2), named("H_2"), "a name may end so");
    assert_eq!(element("γ", 2), named("γ2"));
    assert_eq!(element("γ", 3), named("γ[3]"), "γ3 is another variable");
    assert_eq!(element("(γ × H_)", 1), named("(γ × H_)[1]"), "it has no name");
    assert_eq!([element("x", 0), element("x", 13)], [None, None], "there is none");
}

#[test]
fn vectors_and_matrices_compose() {
    for a in VECTORS.map(read) {
        for b in VECTORS.map(read) {
            let made = [&a + &b, &a - &b, a.dot(&b), a.cross(&b), a.outer(&b)];
            for made in made {
                reads_back(&made.expect("vectors"));
            }
            assert!((&a * &b).is_err(), "two vectors have no product without a sign");
        }
        reads_back(&a.modulus().expect("a norm"));
        reads_back(&a.component(&[2]).expect("a component"));
        reads_back(&Formula::call("hat", &[&a]).expect("a matrix"));
        for m in MATRICES.map(read) {
            let made = (&m * &a).expect("a vector");
            reads_back(&made);
        }
    }
    for m in MATRICES.map(read) {
        reads_back(&m.component(&[1, 2]).expect("an entry"));
        reads_back(&Formula::call("det", &[&m]).expect("a number"));
    }
    let (m, r) = (read("m"), read("R + k"));
    reads_back(&Formula::vector(&[&m, &r, &m]).expect("a vector"));
    reads_back(&Formula::rows(&[vec![&m, &r], vec![&r, &m]]).expect("a matrix"));
    assert!(Formula::vector(&[]).is_err(), "a vector has components");
}

#[test]
fn powers_and_roots_read_back() {
    for base in SCALARS.map(read) {
        for exponent in ["2", "1/2", "−1", "k", "k + m", "−k/2"].map(read) {
            let Ok(made) = base.power(&exponent) else { continue };
            reads_back(&made);
            close(&values(&made), &[values(&base)[0].powf(values(&exponent)[0])], &made);
        }
        for exponent in [2, 3, -1, 12] {
            let made = base.raised(exponent).expect("a power");
            reads_back(&made);
            close(&values(&made), &[values(&base)[0].powi(exponent)], &made);
        }
        reads_back(&base.sqrt().expect("a root"));
        reads_back(&base.bracketed());
    }
    assert_eq!(read("m").raised(-12).expect("a power").to_string(), "m⁻¹²");
}

#[test]
fn brackets_stand_where_they_are_needed_alone() {
    let [m, r, sum, product] = ["m", "R", "m + R", "m*R"].map(read);
    let texts = [
        (&m + &r, "m + R"),
        (&m - &sum, "m − (m + R)"),
        (&sum - &m, "m + R − m"),
        (&m * &sum, "m*(m + R)"),
        (&m * &product, "m*m*R"),
        (&m / &product, "m/(m*R)"),
        ((-&m) * &r, "−m*R"),
        (&m * (-&r), "m*(−R)"),
        (Formula::number(3) * &product, "3*m*R"),
        (Formula::number(Rational::new(1, 2)) * &m, "1/2*m"),
        (product.power(&m), "(m*R)^m"),
    ];
    for (made, text) in texts {
        assert_eq!(made.expect("scalars").to_string(), text);
    }
    assert_eq!((-product).to_string(), "−m*R");
    assert_eq!((-sum).to_string(), "−(m + R)");
}

#[test]
fn names_are_found_whole_and_by_components() {
    let formula = read("k*γ3 + I12*g1 + |r'|");
    assert!(formula.uses("γ") && formula.uses("gamma"), "by a component, in any spelling");
    assert!(formula.uses("g1") && !formula.uses("g"), "a name that ends in a digit");
    assert!(formula.uses("I") && formula.uses("r'"), "an entry, and a prime");
    assert!(!formula.uses("m") && !formula.uses("k2"), "others are not used");
    assert!(formula.names().eq(["k", "γ", "I", "g1", "r'"]), "each once");
}

#[test]
fn substitution_keeps_meaning_and_reads_back() {
    let texts = [
        "k",
        "(k)",
        "2*k",
        "k*m",
        "m − k",
        "−k",
        "k²",
        "m^k",
        "√k",
        "m/k",
        "k/m",
        "m*−k",
        "|k|",
        "max(k, m, 1)",
        "exp(k)*k",
        "[k, 2*k, −k]",
        "(k*γ,ω)/k",
        "m - k - k",
        "2^(-k)",
        "3*k^2",
        "k*γ",
    ];
    for by in ["m", "2", "−2", "1/2", "m + R", "−m", "m*R", "m²", "γ1", "(m + R)", " m*R "] {
        let by = read(by);
        let put = |symbol: Symbol| match NAMES[symbol.0 as usize].0 {
            "k" => by.evaluate(&mut value_of),
            _ => value_of(symbol),
        };
        for text in texts.map(read) {
            let made = text.substitute("k", &by).expect("a scalar for a scalar");
            reads_back(&made);
            assert!(!made.uses("k"), "{made}");
            let expected = text.evaluate(&mut |symbol| put(symbol)).components();
            close(&values(&made), &expected, &made);
        }
    }
    for by in ["ω", "γ × ω", "I*c", "−c", "2*c"].map(read) {
        for text in ["γ3", "γ × c", "(γ,γ)", "I*γ − γ", "γ²", "gamma_1*γ[2]", "hat(γ)"].map(read)
        {
            let made = text.substitute("γ", &by).expect("a vector for a vector");
            reads_back(&made);
            let expected = text.evaluate(&mut |symbol| match NAMES[symbol.0 as usize].0 {
                "γ" => by.evaluate(&mut value_of),
                _ => value_of(symbol),
            });
            close(&values(&made), &expected.components(), &made);
        }
    }
}

#[test]
fn substitution_refuses_what_it_cannot_do() {
    let [m, gamma] = ["m", "γ"].map(read);
    assert!(read("k*γ").substitute("k", &gamma).is_err(), "of another type");
    assert!(read("m/k").substitute("k", &Formula::number(0)).is_err(), "a division by zero");
    assert!(read("sum(i, 1..2, k*u[i])").substitute("k", &m).is_err(), "an index may catch it");
    assert!(read("u[n]").substitute("n", &m).is_ok(), "n is only an index here");
    assert!(read("n*u[n]").substitute("n", &m).is_err(), "an index is written in");
    assert_eq!(read("m*R").substitute("k", &m).expect("unused").to_string(), "m*R");
}
