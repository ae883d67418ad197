//! Polynomial fields whose terms cancel, as those of an orbit far from 0 that is written out.

use liouville::verdict::Verdict;

use super::judged;

/// The unit circle about (c, 0), with the period 2π, multiplied out.
fn circle(c: i64) -> String {
    let (c2, c3) = (c * c, c * c * c);
    format!(
        "title = 'circle'\n[state]\nx = '{}..{}'\ny = '-2..2'\n[field]\n\
         \"x'\" = '-x^3 + {}*x^2 - x*y^2 + {}*x + {c}*y^2 - y + {}'\n\
         \"y'\" = '-x^2*y + {}*x*y + x - y^3 + {}*y - {c}'\n\
         [[claim]]\nclosed-orbit = 6.283185\nstability = 'sink'\nstate = {{ x = '{}' }}\n",
        c - 2,
        c + 2,
        3 * c,
        1 - 3 * c2,
        c3 - c,
        2 * c,
        1 - c2,
        c + 1
    )
}

#[test]
fn an_orbit_far_from_0_is_proved_though_the_terms_of_its_field_cancel() {
    let found = judged(&circle(3));
    assert_eq!(found.verdict, Verdict::Proved, "{:?}", found.evidence.reason);
    // So far away that steps become too short.
    let found = judged(&circle(1000));
    let reason = found.evidence.reason.unwrap_or_default();
    assert_eq!(found.verdict, Verdict::Undecided, "{reason}");
    assert!(reason.contains("the terms of the field are large there and cancel"), "{reason}");
}
