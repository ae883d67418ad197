//! Systems with spin, and Veselova's, whose formulas were computed apart from the library: the
//! fields from Newton's and Euler's equations with the reaction as an unknown, derivatives by
//! differences.

use liouville::number::rational::Rational;
use liouville::verdict::{Options, evaluate_digits, judge};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Pow, Signed, Zero};
use serde_json::Value;

use crate::common::{case, exact, rational, strings, text};

const HELD_BACK: &str = include_str!("../../data/held_back.json");

/// Number of digits that must agree.
const DIGITS: i32 = 27;

/// Asserts that a number of the library has the digits of the reference; 0 is 0.
fn assert_digits(ours: Option<&str>, theirs: &Value, what: &str) {
    let ours = ours.unwrap_or_else(|| panic!("{what} is undefined"));
    let (found, golden) = (exact(ours), exact(text(theirs)));
    let ten = BigRational::from_integer(BigInt::from(10));
    let allowed = golden.abs() * ten.pow(-DIGITS);
    assert!((found - &golden).abs() <= allowed, "{what}: {ours} and {theirs}");
    assert_eq!(ours == "0", golden.is_zero(), "{what}: {ours} and {theirs}");
}

#[test]
fn formulas_held_back_have_the_same_digits_and_verdicts() {
    let data: Value = serde_json::from_str(HELD_BACK).expect("JSON");
    let (mut systems, mut compared, mut judged) = (0, 0, [0, 0]);
    for system in data["systems"].as_array().expect("systems") {
        let case = case(text(&system["case"]));
        systems += 1;
        for (i, point) in system["states"].as_array().expect("states").iter().enumerate() {
            let what = format!("{} at {i}", system["name"]);
            let numbers = strings(&point["state"]);
            let state: Vec<Rational> = numbers.into_iter().map(|x| rational(&exact(x))).collect();
            let found = evaluate_digits(&case, Some(&state), 1, 0, 30).expect("evaluated");
            for (k, rate) in point["field"].as_array().expect("a field").iter().enumerate() {
                assert_digits(found.field[k].as_deref(), rate, &format!("{what}, rate {k}"));
                compared += 1;
            }
            let divergence = found.level_divergence.as_deref();
            assert_digits(divergence, &point["divergence"], &format!("{what}, div v"));
            compared += 1;
            let claims = point["claims"].as_object().expect("claims");
            assert_eq!(claims.len(), found.claims.len(), "{what}: a value for each claim");
            for (name, value, residual) in &found.claims {
                let golden = &claims[name];
                let what = format!("{what}, {name}");
                if let Some(golden) = golden.get("value") {
                    assert_digits(value[0].as_deref(), golden, &what);
                    compared += 1;
                }
                let residual = residual[0].as_deref();
                assert_digits(residual, &golden["residual"], &format!("{what}, residual"));
                compared += 1;
            }
        }
        let report = judge(&case, &Options::default()).expect("judged");
        for claim in &report.claims {
            let what = format!("{}, {}: {:?}", system["name"], claim.name, claim.verdict);
            assert!(claim.agrees, "{what}");
            let is_proved = claim.verdict == liouville::verdict::Verdict::Proved;
            judged[usize::from(is_proved)] += 1;
        }
    }
    assert_eq!((systems, compared, judged), (12, 703, [36, 38]), "nothing was left out");
}
