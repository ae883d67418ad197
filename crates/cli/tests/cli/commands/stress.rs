//! Numerically hard cases.

use liouville_lab::stress::{SCENARIOS, Tally, digits_lost, verdicts};

use crate::commands::json;

#[test]
fn verdicts_on_hard_cases_are_right() {
    let mut found = Tally::default();
    for scenario in SCENARIOS.iter().step_by(4) {
        for exponent in (scenario.from..=scenario.to).step_by(7) {
            let lost = digits_lost(scenario, exponent, 1).expect("states");
            assert!(lost.field.is_finite(), "{} at 1e{exponent}", scenario.name);
            if scenario.changes_case() {
                found = found.and(verdicts(scenario, exponent, 1).expect("judged"));
            }
        }
    }
    assert!(found.judged > 50 && found.wrong == 0, "{found:?}");
}

#[test]
#[ignore = "slow: a part of the same cases is judged above"]
fn stress_reports_no_wrong_verdict() {
    let report = json(&["stress", "--json"], 0);
    let verdicts = &report["verdicts"];
    assert!(verdicts["judged"].as_u64().expect("a count") > 3000, "{verdicts}");
    assert_eq!(verdicts["wrong"], 0, "{verdicts}");
    let points = report["scenarios"][0]["points"].as_array().expect("points");
    assert!(points.iter().all(|point| point["field"].is_number()), "digits lost at each x");
}
