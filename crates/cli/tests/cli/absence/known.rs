//! Known integrals: each is counted once, and polynomials in them refute nothing.

use liouville::verdict::Verdict;

use crate::absence::only;

const BALL: &str = r#"
title = "balanced ball"
system = "rubber-plane"
[parameters]
m = "0.5..2"
R = "1..2"
I = "inertia(1..4)"
[body]
shape = "ball"
"#;

#[test]
fn the_energy_counts_once_however_it_is_claimed() {
    let absence = "[[claim]]\nno-integral = { degree = 2 }\nexpect = \"open\"\n";
    for claim in ["", "energy", "(energy)", "2*energy", "(ω,Ĩ*ω)/2"] {
        let claimed = match claim {
            "" => String::new(),
            _ => format!("[[claim]]\nintegral = \"{claim}\"\n"),
        };
        let found = only(&format!("{BALL}{claimed}{absence}"));
        assert_eq!(found.verdict, Verdict::Refuted, "{claim}: {:?}", found.evidence);
    }
    let both = "[[claim]]\nintegral = \"energy\"\n[[claim]]\nintegral = \"|Ĩ*ω × γ|²\"\n";
    let found = only(&format!("{BALL}{both}{absence}"));
    assert_eq!(found.verdict, Verdict::Proved, "{:?}", found.evidence);
    let theorem = found.evidence.theorem.unwrap_or_default();
    assert!(theorem.contains("polynomial in the energy and |Ĩ*ω × γ|²."), "{theorem}");
}

/// A system of two oscillators with some integrals.
fn oscillators(integrals: &[&str], degree: u32) -> String {
    let claims: String =
        integrals.iter().map(|text| format!("[[claim]]\nintegral = \"{text}\"\n")).collect();
    format!(
        "title = \"two oscillators\"\n[state]\nx = \"0.5..1\"\ny = \"0.5..1\"\nu = \"-1..1\"\nv = \"-1..1\"\n\
         [field]\n\"x'\" = \"u\"\n\"y'\" = \"v\"\n\"u'\" = \"-x\"\n\"v'\" = \"-2*y\"\n{claims}\
         [[claim]]\nno-integral = {{ degree = {degree} }}\nexpect = \"open\"\n"
    )
}

#[test]
fn a_polynomial_in_the_known_integrals_refutes_nothing() {
    // 2y² + v² is the second less the square of the first: the squares cancel.
    let tangled = ["x^2 + u^2", "2*y^2 + v^2 + (x^2 + u^2)^2"];
    let found = only(&oscillators(&tangled, 2));
    assert_eq!(found.verdict, Verdict::Undecided, "{:?}", found.evidence);
    let reason = found.evidence.reason.unwrap_or_default();
    assert!(reason.contains("may cancel to it"), "{reason}");
    let plain = only(&oscillators(&["x^2 + u^2", "2*y^2 + v^2"], 2));
    assert_eq!(plain.verdict, Verdict::Proved, "{:?}", plain.evidence);
    // One that is independent of the known one, and one that is a function of it but no polynomial.
    for known in ["x^2 + u^2 + 2*y^2 + v^2", "(x^2 + u^2)^2"] {
        let found = only(&oscillators(&[known], 2));
        assert_eq!(found.verdict, Verdict::Refuted, "{known}: {:?}", found.evidence);
    }
}

#[test]
fn functions_of_a_known_integral_hide_no_other() {
    let pendula = |claims: &str| {
        only(&format!(
            "title = \"two pendula\"\n[state]\nx = \"-1..1\"\ny = \"-1..1\"\nu = \"-1..1\"\nv = \"-1..1\"\n\
             [hamiltonian]\nfunction = \"(u^2 + v^2)/2 - cos(x) - 2*cos(y)\"\n\
             pairs = [[\"x\", \"u\"], [\"y\", \"v\"]]\n{claims}\
             [[claim]]\nno-integral = {{ degree = 2 }}\nexpect = \"open\"\n"
        ))
    };
    for claimed in [vec!["energy", "energy^2"], vec!["exp(energy)"]] {
        let claims: String =
            claimed.iter().map(|own| format!("[[claim]]\nintegral = \"{own}\"\n")).collect();
        let found = pendula(&claims);
        assert_eq!(found.verdict, Verdict::Refuted, "{claimed:?}: {:?}", found.evidence);
    }
}

#[test]
fn an_integral_found_along_an_orbit_refutes_a_claim() {
    let kepler = |potential: &str| {
        format!(
            "title='t'\nsystem='nonholonomic'\n[state]\nx='0.5..2'\ny='0.5..2'\n\"x'\"='-1..1'\n\"y'\"='-1..1'\n\
             [lagrangian]\nkinetic=\"(x'² + y'²)/2\"\npotential='{potential}'\n[[claim]]\n\
             integral = \"x*y' − y*x'\"\n[[claim]]\nno-integral = {{ degree = 2 }}\n"
        )
    };
    let report = only(&kepler("−1/√(x² + y²)"));
    assert_eq!(report.verdict, Verdict::Refuted, "{:?}", report.evidence);
    let shown = report.evidence.exhibit.expect("an integral");
    assert!(shown.contains("√(x² + y²)"), "a component of Laplace's vector: {shown}");
    let report = only(&kepler("−1/(x² + y²)^2"));
    assert_eq!(report.verdict, Verdict::Proved, "{:?}", report.evidence);
}

#[test]
fn an_integral_that_changes_on_the_way_is_not_known() {
    let file = |integral: &str| {
        format!(
            "title = \"central force\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\n\"x'\" = \"-2..2\"\n\
             \"y'\" = \"-2..2\"\n[lagrangian]\nkinetic = \"(x'²+y'²)/2\"\npotential = \"(x²+y²)²\"\n\
             [[claim]]\nintegral = \"{integral}\"\n[[claim]]\nno-integral = {{ degree = 1 }}\n\
             expect = \"open\"\n"
        )
    };
    let theorem = |integral: &str| {
        let found = only(&file(integral));
        assert_eq!(found.verdict, Verdict::Proved, "{integral}: {:?}", found.evidence);
        found.evidence.theorem.expect("stated")
    };
    assert!(theorem("x*y' − y*x'").ends_with("is a polynomial in x*y' − y*x'."));
    let on_half = "(x*y' − y*x')*√(x − 1)/√(x − 1)";
    assert!(theorem(on_half).ends_with(&format!(", where {on_half} has a value.")));
    let squared = "(x*y' − y*x')*√(x − 1)*√(x − 1)/(x − 1)";
    assert!(theorem(squared).ends_with(&format!(", where {squared} has a value.")));
    for integral in [
        // 0 for x < 1, where the angular momentum is a further integral
        "(x*y' − y*x')*(1 + exp(ln((x − 1)²)/2)/(x − 1))",
        "(x*y' − y*x')*(π/2 + atan(x − 1) + atan(1/(x − 1)))",
        "(x*y' − y*x')*(1 + sign(x − 1))",
        "(x*y' − y*x')*(1 + exp(ln(exp(x)*(x − 1)²)/2)/(x − 1)/exp(x/2))",
        // |x y' − y x'|
        "exp(ln((x*y' − y*x')²)/2)",
    ] {
        let found = only(&file(integral));
        // The angular momentum is an integral, and might be a polynomial in such a one.
        assert_eq!(found.verdict, Verdict::Undecided, "{integral}: {:?}", found.evidence);
        let reason = found.evidence.reason.unwrap_or_default();
        assert!(reason.contains("not counted"), "{integral}: {reason}");
    }
}

#[test]
fn a_listed_value_with_an_integral_refutes_for_lagrangians() {
    let text = |listed: &str| {
        format!(
            "title = 't'\n[parameters]\nk = 'one of {listed}'\n[state]\nx = '-2..2'\ny = '-2..2'\n\"x'\" = '-2..2'\n\
             \"y'\" = '-2..2'\n[lagrangian]\nkinetic = \"(x'^2 + y'^2)/2\"\n\
             potential = '(x^2 + y^2)/2 + k*x^3*y'\n[[claim]]\nno-integral = {{ degree = 1 }}\nexpect = 'open'\n"
        )
    };
    let found = only(&text("0, 1"));
    assert_eq!(found.verdict, Verdict::Refuted, "{found:?}");
    assert!(format!("{:?}", found.evidence).contains("for k = 0"), "{:?}", found.evidence);
    assert_ne!(only(&text("1, 2")).verdict, Verdict::Refuted, "no turn is a symmetry");
}

#[test]
fn functions_that_claims_about_the_bracket_name_are_known() {
    let top = "title = 'x'\n[parameters]\nI = 'vector(0.5..2)'\n[state]\nx = 'vector(-1..1)'\n[hamiltonian]\n\
               function = 'x1²/(2*I1) + x2²/(2*I2) + x3²/(2*I3)'\nbracket = { 'x,x' = 'hat(x)' }\n";
    let absence = "[[claim]]\nno-integral = { degree = 2 }\nexpect = 'open'\n";
    let of = |claim: &str| only(&format!("{top}[[claim]]\n{claim}\n{absence}")).verdict;
    assert_eq!(of("casimir = '(x,x)'"), Verdict::Proved);
    assert_eq!(of("involution = ['energy', '(x,x)']"), Verdict::Proved);
    // A Casimir function that is refuted is none that is known.
    assert_eq!(of("casimir = '(x,x) + x1'\nexpect = 'fails'"), Verdict::Refuted);
    assert_eq!(of("casimir = '1'"), Verdict::Refuted);
}
