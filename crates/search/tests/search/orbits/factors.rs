//! Darboux polynomials, and what follows from their cofactors.

use liouville_search::{Effort, FoundKind, Given, SearchReport};

use super::{any_field, excluded, field, searched};

/// Cofactor of a Darboux polynomial that was found.
pub fn cofactor<'r>(report: &'r SearchReport, formula: &str) -> Option<&'r str> {
    let own = report
        .found
        .iter()
        .find(|found| found.kind == FoundKind::DarbouxPolynomial && found.text() == formula)?;
    own.with.iter().find(|own| matches!(own, Given::Cofactor(_))).map(Given::text)
}

#[test]
fn darboux_polynomials_of_lorenz_are_found_at_their_parameters() {
    let parametric = [
        (
            "s = '0.5..2'\nr = '0.5..2'",
            ["s*(y - x)", "r*x - y - x*z", "x*y - 2*s*z"],
            ("x² − 2*s*z", "−2*s"),
        ),
        ("s = '0.5..2'", ["s*(y - x)", "-y - x*z", "x*y - z"], ("y² + z²", "−2")),
    ];
    for (parameters, rates, (formula, own)) in parametric {
        let report = searched(&field(parameters, &rates), &Effort::default());
        assert_eq!(cofactor(&report, formula), Some(own), "{:?}", report.found);
        assert!(excluded(&report).is_some(), "no rational integral");
    }
    // b = 4σ, r = 2σ: one of degree 4, with the cofactor −4.
    let report = searched(&field("", &["y - x", "2*x - y - x*z", "x*y - 4*z"]), &Effort::default());
    let formula = "16*z − 8*x² + 8*x*y − 4*y² − 4*x²*z + x⁴";
    assert_eq!(cofactor(&report, formula), Some("−4"), "{:?}", report.found);
    assert!(excluded(&report).is_some(), "no rational integral");
}

#[test]
fn cofactors_give_logarithms_and_densities() {
    let parameters = "a = '0.5..2'\nb = '0.5..2'\nc = '0.5..2'\nd = '0.5..2'";
    let report = searched(&field(parameters, &["x*(a - b*y)", "y*(c*x - d)"]), &Effort::default());
    assert_eq!(cofactor(&report, "x"), Some("a − b*y"), "x' = (a − b y) x");
    assert_eq!(cofactor(&report, "y"), Some("c*x − d"), "y' = (c x − d) y");
    let integrals: Vec<&str> = report.formulas(FoundKind::Integral).collect();
    assert!(integrals.len() == 1 && integrals[0].contains("ln(x)"), "{integrals:?}");
    assert_eq!(report.formulas(FoundKind::Density).count(), 1, "Π f^α e^g");
    assert!(excluded(&report).is_some_and(|degree| degree >= 8), "no rational integral");
}

#[test]
fn conjugate_factors_give_angles() {
    let fields = [
        // ln(x² + y²) − 2a atan(y/x)
        ("a = '0.5..2'", ["a*x - y", "x + a*y"], "atan("),
        // A damped oscillator: c² − 1 under the root, of either sign.
        ("c = '0.5..0.9'", ["y", "-x - 2*c*y"], "atan("),
        ("c = '1.5..2'", ["y", "-x - 2*c*y"], "ln(|"),
        // A saddle with eigenvalues (1 ± √13)/2.
        ("", ["x + y", "3*x"], "ln(|"),
        // The normal form of Hopf's bifurcation.
        ("m = '0.5..2'", ["m*x - y - x*(x² + y²)", "x + m*y - y*(x² + y²)"], "atan("),
    ];
    for (parameters, rates, form) in fields {
        let report = searched(&field(parameters, &rates), &Effort::default());
        let integrals: Vec<&str> = report.formulas(FoundKind::Integral).collect();
        assert!(matches!(integrals[..], [own] if own.contains(form)), "{rates:?}: {integrals:?}");
    }
}

#[test]
fn factors_of_the_whole_field_are_found() {
    // Susceptible and infected: where no one is infected, all is at rest.
    let report =
        searched(&field("b = '1..3'\ng = '1..3'", &["-b*x*y", "b*x*y - g*y"]), &Effort::default());
    assert_eq!(cofactor(&report, "y"), Some("b*x − g"), "{:?}", report.found);
    assert_eq!(report.formulas(FoundKind::Integral).count(), 1, "x + y − (g/b) ln x");
    // A circle of points of rest, and two lines of them.
    let circle = searched(
        &field("", &["(x² + y² − 1)*(x*y + 2)", "(x² + y² − 1)*(x − y² + 3)"]),
        &Effort::default(),
    );
    assert!(cofactor(&circle, "x² + y² − 1").is_some(), "{:?}", circle.found);
    let lines = searched(
        &field("", &["(x − 2*y)*(x + y − 1)*(y² + 2)", "(x − 2*y)*(x + y − 1)*(x − 3)"]),
        &Effort::default(),
    );
    for line in ["x − 2*y", "x + y − 1"] {
        assert!(cofactor(&lines, line).is_some(), "{line}: {:?}", lines.found);
    }
}

#[test]
fn variables_that_divide_their_rates_are_found_at_any_degree() {
    let fields = [
        ("", ["x^1000000007*y", "y"], ("x", "x^1000000006*y"), "1/(x^1000000007*y)"),
        ("", ["x^30*y", "y"], ("x", "x²⁹*y"), "1/(x³⁰*y)"),
        ("", ["(2*x)^1000000007*y", "y"], ("y", "1"), "1/(x^1000000007*y)"),
        ("", ["x^4000000000*x^4000000000*y", "y"], ("y", "1"), "1/(x^8000000000*y)"),
        ("", ["(x + y + 1)^300", "y*(x + y + 1)^7"], ("y", "(x + y + 1)⁷"), ""),
        ("", ["(x + 1)^1000000007*y", "y - 3*y"], ("y", "−2"), ""),
        ("a = '1..2'", ["a*x^31*(y + x^40)", "1 + y²"], ("x", "x³⁰*a*(y + x⁴⁰)"), ""),
    ];
    for (parameters, rates, (variable, own), density) in fields {
        let report = searched(&field(parameters, &rates), &Effort::default());
        assert_eq!(cofactor(&report, variable), Some(own), "{rates:?}: {:?}", report.found);
        assert_eq!(report.formulas(FoundKind::Density).next().unwrap_or(""), density, "{rates:?}");
    }
    // x² + x y − y divides nothing, and 1/x has a pole where x is 0.
    for rates in [["x^30 + y", "y^40 + x"], ["y^30/x", "x^30/y"]] {
        let report = searched(&field("", &rates), &Effort::default());
        for variable in ["x", "y"] {
            assert_eq!(cofactor(&report, variable), None, "{rates:?}: {:?}", report.found);
        }
    }
}

#[test]
fn planes_on_which_the_motion_has_integrals_are_found() {
    // On z = 0 of a homogeneous field of Lotka and Volterra x − c y is kept, a further relation.
    for rates in
        [["x*(c*y + z)", "y*(a*z + x)", "z*(b*x + y)"], ["x*(3*y)", "y*(5*z + x)", "z*(7*x + 2*y)"]]
    {
        let text = field("a = '0.5..2'\nb = '0.5..2'\nc = '0.5..2'\n", &rates);
        let report = searched(&text, &Effort { degree: 2, ..Effort::default() });
        for formula in ["x", "y", "z"] {
            assert!(cofactor(&report, formula).is_some(), "{formula} of {rates:?}");
        }
    }
}

#[test]
fn fields_of_fractions_have_those_of_the_field_times_the_denominator() {
    let chemostat = field("d = '0.1..0.5'", &["x*(y/(1 + y) - d)", "d*(1 - y) - x*y/(1 + y)"]);
    let report = searched(&chemostat, &Effort::default());
    assert_eq!(cofactor(&report, "x"), Some("(−d + (1 − d)*y)/(1 + y)"), "{:?}", report.found);
    // The total x + y − 1 decays.
    let total = report
        .found
        .iter()
        .find(|own| own.with.iter().any(|own| (own.name(), own.text()) == ("cofactor", "−d")));
    assert!(
        total.is_some_and(|own| own.kind == FoundKind::DarbouxPolynomial),
        "{:?}",
        report.found
    );
    let says = |own: &String| own.contains("for the field times 1 + y, every Darboux polynomial");
    let theorems: Vec<&String> = report.excluded.iter().map(|own| &own.theorem).collect();
    assert!(theorems.iter().any(|own| says(own)), "{theorems:?}");
}

#[test]
fn fractions_with_factors_in_exponents_are_found() {
    let fields: [(&str, [&str; 2], &str); 8] = [
        ("", ["y", "-2*y - x"], "x/(x + y) + ln(x + y)"),
        ("", ["x", "x + y"], "ln(x) − y/x"),
        ("", ["x²", "y"], "1/x + ln(y)"),
        ("", ["x³", "y"], "1/x² + 2*ln(y)"),
        ("", ["x*y", "x² + y²"], "2*ln(x) − y²/x²"),
        ("", ["(x² + 1)²", "y"], "2*ln(y) + atan(1/x) − x/(1 + x²)"),
        ("a = '0.5..2'\nb = '0.5..2'", ["a*x²", "b*y"], "b/x + a*ln(y)"),
        ("a = '0.5..2'", ["y", "-2*a*y - a²*x"], "a*x/(a*x + y) + ln(a*x + y)"),
    ];
    for (parameters, rates, integral) in fields {
        let report = searched(&field(parameters, &rates), &Effort::default());
        let integrals: Vec<&str> = report.formulas(FoundKind::Integral).collect();
        assert_eq!(integrals, [integral], "{rates:?}");
        assert!(excluded(&report).is_some(), "no rational integral: {rates:?}");
    }
    let report = searched(&field("", &["x²", "-2*x*y + y + 1"]), &Effort::default());
    assert_eq!(report.formulas(FoundKind::Density).collect::<Vec<_>>(), ["exp(1/x)"]);
    // One with a logarithm, in y and z alone, does not take the place of a rational one.
    let report = searched(&field("", &["y", "z - 1", "z²"]), &Effort::default());
    let with_logarithm = report.formulas(FoundKind::Integral).filter(|own| own.contains("ln("));
    assert_eq!(with_logarithm.count(), 1, "{:?}", report.found);
    assert_eq!(report.formulas(FoundKind::Integral).count(), 2, "{:?}", report.found);
    // What needs no fraction is written without one.
    let report = searched(&field("", &["x²", "y"]), &Effort::default());
    assert_eq!(report.formulas(FoundKind::Density).collect::<Vec<_>>(), ["1/(x²*y)"]);
}

#[test]
fn darboux_polynomials_beside_functions_with_relations_are_found() {
    type Known<'k> = ([(&'k str, &'k str); 2], &'k str, &'k str, &'k str);
    let fields: [Known<'_>; 7] = [
        ([("x", "x*cos(t)"), ("t", "1")], "x", "cos(t)", "ln(x) − sin(t)"),
        ([("x", "x*cos(y)"), ("y", "1")], "x", "cos(y)", "ln(x) − sin(y)"),
        ([("x", "x*√t"), ("t", "1")], "x", "√t", "3*ln(x) − 2*t^(3/2)"),
        ([("x", "x*ln(t)"), ("t", "1")], "x", "ln(t)", "t + ln(x) − t*ln(t)"),
        (
            [("x", "-x + cos(y)"), ("y", "1")],
            "2*x − sin(y) − cos(y)",
            "−1",
            "y + ln(|2*x − sin(y) − cos(y)|)",
        ),
        (
            [("x", "y"), ("y", "-sin(x) - y²")],
            "4*sin(x) − 2*cos(x) + 5*y²",
            "−2*y",
            "2*x + ln(|4*sin(x) − 2*cos(x) + 5*y²|)",
        ),
        (
            [("x", "x*(exp(t) + exp(-t))"), ("t", "1")],
            "x",
            "exp(t) + exp(−t)",
            "exp(−t) + ln(x) − exp(t)",
        ),
    ];
    for (rates, formula, own, integral) in fields {
        let report = searched(&any_field(&rates), &Effort::default());
        assert_eq!(cofactor(&report, formula), Some(own), "{rates:?}: {:?}", report.found);
        let integrals: Vec<&str> = report.formulas(FoundKind::Integral).collect();
        assert_eq!(integrals, [integral], "{rates:?}");
        // Neither a relation between the functions nor a function alone is told.
        let told = report.found.iter().filter(|found| found.kind == FoundKind::DarbouxPolynomial);
        assert_eq!(told.count(), 1, "{rates:?}: {:?}", report.found);
    }
}

#[test]
fn integrals_in_the_plane_follow_from_a_density() {
    let report = searched(&any_field(&[("x", "y"), ("y", "-x*sin(x) - y²")]), &Effort::default());
    let integral = "2*x + ln(|6*sin(x) − 8*cos(x) − 20*x*sin(x) + 10*x*cos(x) − 25*y²|)";
    assert_eq!(report.formulas(FoundKind::Integral).collect::<Vec<_>>(), [integral]);
    // Without a Darboux polynomial, which has too many terms.
    let report = searched(&any_field(&[("x", "y"), ("y", "-x²*sin(x) - y²")]), &Effort::default());
    let own: Vec<&str> = report.formulas(FoundKind::Integral).collect();
    let [integral] = own[..] else { panic!("{own:?}") };
    assert!(integral.starts_with("exp(2*x)*("), "{integral}");
    let only = |own: &liouville_search::Excluded| own.theorem.contains(integral);
    assert!(report.excluded.iter().all(only), "no other is excluded: {:?}", report.excluded);
}

#[test]
fn logarithms_are_those_of_moduli_unless_the_ranges_say_otherwise() {
    let text = |range: &str, a: &str| {
        format!(
            "title = 'x'\nsystem = 'field'\n[parameters]\na = '{a}'\n[state]\nx = '{range}'\n\
             y = '{range}'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x³ - a*y²'\n"
        )
    };
    let first = |text: &str| {
        let report = searched(text, &Effort::default());
        let own = report.formulas(FoundKind::Integral).next().expect("an integral");
        own.to_string()
    };
    let own = "6*a*x + 4*a⁴*y² + 4*a³*x³ − 3 − 6*a²*x²";
    assert_eq!(first(&text("-2..2", "0.1..0.5")), format!("2*a*x + ln(|{own}|)"));
    assert_eq!(first(&text("5..6", "1..2")), format!("2*a*x + ln({own})"), "positive there");
    let powers = |range: &str| {
        let text = field("a = '0.5..0.9'", &["x", "-a*y"]).replace("0.5..2", range);
        first(&text)
    };
    for (range, signs) in [("0.5..2", ["x", "y"]), ("-2..-0.5", ["|x|", "|y|"])] {
        let [x, y] = signs;
        assert_eq!(powers(range), format!("a*ln({x}) + ln({y})"), "{range}");
    }
}

#[test]
fn factors_with_parameters_are_told_one_by_one() {
    let found = |parameters: &str, rates: &[&str]| -> Vec<String> {
        let report = searched(&field(parameters, rates), &Effort::default());
        let own = report.found.iter().filter(|own| own.kind == FoundKind::DarbouxPolynomial);
        own.map(|own| own.text().to_string()).collect()
    };
    // x ± a y.
    let own = found("a = '1..2'", &["x + a²*y", "x + y"]);
    assert_eq!(own.len(), 2, "{own:?}");
    assert!(own.iter().all(|one| !one.contains('²')), "{own:?}");
    // (x + a y)(x² + a x y + b y²), of which the second factor has no rational coefficients.
    let rate = "(x + a*y)*(x² + a*x*y + b*y²)";
    let own = found("a = '1..2'\nb = '3..4'", &[rate, "0"]);
    assert!(own.iter().any(|one| one == "x + a*y"), "{own:?}");
    assert!(own.iter().all(|one| !one.contains("a²")), "{own:?}");
    // Irreducible ones stay.
    let own = found("a = '1..2'", &["x + a*y", "x + y"]);
    assert_eq!(own.len(), 1, "{own:?}");
}
