//! Claims of absence that a find of the search decides, or a count for each listed value.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict};

/// Verdict on the last claim of a case, with what is exhibited or the reason.
fn verdict(text: &str) -> (Verdict, String) {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = liouville_search::judge(&case, &Options::default()).expect("judged");
    let claim = report.claims.last().expect("a claim");
    let evidence = &claim.evidence;
    let said = evidence.exhibit.clone().or(evidence.theorem.clone()).or(evidence.reason.clone());
    (claim.verdict, said.unwrap_or_default())
}

fn listed(values: &str, rates: [&str; 2], claim: &str) -> (Verdict, String) {
    verdict(&format!(
        "title = 't'\ncheck-weights = false\n[parameters]\na = 'one of {values}'\n[state]\nx = '-2..2'\n\
         y = '-2..2'\n[field]\n\"x'\" = '{}'\n\"y'\" = '{}'\n[[claim]]\n{claim}\nexpect = 'open'\n",
        rates[0], rates[1]
    ))
}

#[test]
fn relations_are_excluded_for_each_listed_value() {
    // x = 0 is invariant for a = 2 alone.
    let rates = ["(a - 2)*y + x*(1 + y)", "1 + x^2 - y"];
    let claim = "no-invariant-relation = { degree = 1 }";
    let (found, said) = listed("1, 2", rates, claim);
    assert_eq!(found, Verdict::Refuted, "{said}");
    assert!(said.starts_with("for a = 2, ") && said.ends_with(": x"), "{said}");
    let (found, said) = listed("1, 3", rates, claim);
    assert_eq!(found, Verdict::Proved, "{said}");
    assert!(said.contains("each combination of the listed values"), "{said}");
    let (found, said) = listed("1, 3, 2", rates, claim);
    assert_eq!(found, Verdict::Refuted, "{said}");
}

#[test]
fn integrals_of_a_field_are_excluded_for_each_listed_value() {
    let rates = ["y", "(a - 1)*x^2*y - x"];
    let claim = "no-integral = { degree = 2 }";
    let (found, said) = listed("3, 1", rates, claim);
    assert_eq!(found, Verdict::Refuted, "{said}");
    assert!(said.starts_with("for a = 1, integral, proved: "), "{said}");
    let (found, said) = listed("2, 3", rates, claim);
    assert_eq!(found, Verdict::Proved, "{said}");
}

#[test]
fn what_the_search_finds_refutes() {
    // (M,M), whose coefficients are no fractions of the angles of Q.
    let (found, said) = verdict(
        "title = 't'\n[parameters]\nA = 'diag(1..4)'\nQ = 'rotation'\n[state]\nM = 'vector(-2..2)'\n[field]\n\
         \"M'\" = 'Q*(Qᵀ*M × A*Qᵀ*M)'\n[[claim]]\nintegral = '(M,Q*A*Qᵀ*M)'\n[[claim]]\n\
         no-integral = { degree = 2 }\nexpect = 'open'\n",
    );
    assert_eq!(found, Verdict::Refuted, "{said}");
    // A density of the positions, although y² − z² is an integral of degree 0, with all its functions.
    let (found, said) = verdict(
        "title = 't'\nsystem = 'nonholonomic'\n[state]\nx = '-1..1'\ny = '-1..1'\nz = '-1..1'\n\
         \"x'\" = '-1..1'\n\"y'\" = '-1..1'\n\"z'\" = '-1..1'\n[lagrangian]\n\
         kinetic = \"(x'^2 + y'^2 + z'^2)/2\"\npotential = 'z^2'\nconstraints = [\"y' = z*x'\", \"z' = y*x'\"]\n\
         [[claim]]\nno-density = { degree = 0 }\nexpect = 'open'\n",
    );
    assert_eq!(found, Verdict::Refuted, "{said}");
}

#[test]
fn densities_that_a_search_finds_refute() {
    // ρ = (3 − z)^(−1/2): the polynomial z − 3 is negative at all states.
    let field = |rate: &str| {
        format!(
            "title = 't'\n[state]\nx = '0.5..1'\ny = '0.5..1'\nz = '0.5..1'\n[field]\n\
             \"x'\" = '−4*x*z + 13*x + 3*y'\n\"y'\" = '4*y*z − 12*y − 10*z² + 18*z + 12'\n\
             \"z'\" = '{rate}'\n[[claim]]\nno-density = {{ degree = 3 }}\nexpect = 'open'\n"
        )
    };
    let (found, said) = verdict(&field("6 − 2*z"));
    assert_eq!(found, Verdict::Refuted, "{said}");
    assert!(said.contains("(3 − z)^(−1/2)"), "{said}");
    let (found, said) = verdict(&field("6 − 2*z + x*y*z²"));
    assert_eq!(found, Verdict::Proved, "{said}");
    // With a sine in the field no polynomials are counted: a find refutes all the same.
    let text = "title = 't'\n[state]\nx = '0.5..1'\ny = '0.5..1'\n[field]\n\"x'\" = 'x'\n\
                \"y'\" = 'sin(x)'\n[[claim]]\nno-density = { degree = 1 }\nexpect = 'open'\n";
    let (found, said) = verdict(text);
    assert_eq!(found, Verdict::Refuted, "{said}");
}

/// Verdict on the absence of further integrals of a turning motion, beside a known one.
fn beside(known: &str, degree: u32) -> (Verdict, String) {
    verdict(&format!(
        "title = 't'\ncheck-weights = false\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\
         \"y'\" = '-x'\n[[claim]]\nintegral = '{known}'\n[[claim]]\nno-integral = {{ degree = {degree} }}\n\
         expect = 'open'\n"
    ))
}

#[test]
fn a_find_may_be_a_polynomial_in_a_known_root_or_modulus() {
    for known in [
        "sqrt(x^2 + y^2)",
        "abs(x^2 + y^2)",
        "x^2 + y^2 + abs(x^2 + y^2)",
        "sqrt(x^2 + y^2) + 1",
        "(x^2 + y^2)/2 + ∫(0, x)",
        "max(x^2 + y^2, 0)",
    ] {
        let (found, said) = beside(known, 2);
        assert_ne!(found, Verdict::Refuted, "{known}: {said}");
    }
    assert_eq!(beside("(x^2 + y^2)^2", 2).0, Verdict::Refuted, "no polynomial in its square");
    assert_eq!(beside("x^2 + y^2", 4).0, Verdict::Proved);
}

#[test]
fn a_find_may_be_a_product_of_integrals_with_time() {
    let text = |second: &str| {
        format!(
            "title = 't'\ncheck-weights = false\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'x'\n\
             \"y'\" = '-2*y'\n[[claim]]\nintegral = 'x*exp(-t)'\n{second}[[claim]]\n\
             no-integral = {{ degree = 3 }}\nexpect = 'open'\n"
        )
    };
    let (found, said) = verdict(&text("[[claim]]\nintegral = 'y*exp(2*t)'\n"));
    assert_eq!(found, Verdict::Undecided, "{said}");
    assert!(said.contains("not counted"), "{said}");
    assert_eq!(verdict(&text("")).0, Verdict::Refuted, "x²y has no t");
}
