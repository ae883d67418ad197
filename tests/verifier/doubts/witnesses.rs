//! States at which claims are refuted, evaluated again.

use liouville::case::Case;
use liouville::verdict::{Options, evaluate_digits, judge, read_state};

use super::claims;

#[test]
fn witnesses_are_as_exact_as_what_they_show() {
    let text = "title = 'x'\n[state]\nx = '-0.9..0.9'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n[level]\n\
                equations = ['x²+y² = 1']\n[level.chart]\ninputs = { u = '-0.9..0.9' }\nx = 'u'\ny = '√(1−u²)'\n\
                [[claim]]\nname = 'a'\nidentity = 'x²+y² = 1+1e-25'\n\
                [[claim]]\nname = 'b'\nidentity = 'x²+y² = 1+1e-70'\n";
    let case = Case::parse(text, &[]).expect("a case");
    let report = judge(&case, &Options::default()).expect("it can be judged");
    for (index, claim) in report.claims.iter().enumerate() {
        let witness = claim.evidence.witness.as_ref().expect("a witness");
        let state = read_state(&case, &witness.state).expect("its state is read");
        let point = evaluate_digits(&case, Some(&state), 1, 0, 3).expect("it can be evaluated");
        let again: f64 =
            point.claims[index].2[0].as_ref().expect("a value").parse().expect("digits");
        let found = witness.residual;
        assert!((again / found - 1.0).abs() < 1e-2, "{}: {again:e} against {found:e}", claim.name);
    }
}

#[test]
fn a_witness_beyond_f64_shows_its_residual() {
    let text = "title = 'x'\n[state]\nx = '1..2'\n[field]\n\"x'\" = 'x'\n[[claim]]\nintegral = '1e-400*x'\n\
                [[claim]]\nintegral = 'x^1e9'\n";
    for (claim, exponent) in claims(text).iter().zip(["e-400", "e146"]) {
        let digits = claim.evidence.witness.as_ref().and_then(|witness| witness.digits.clone());
        assert!(
            digits.as_ref().is_some_and(|d| d.contains(exponent)),
            "{}: {digits:?}",
            claim.name
        );
    }
}
