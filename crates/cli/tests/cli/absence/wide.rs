//! Fields of many variables.

use super::only;
use liouville::verdict::Verdict;

#[test]
fn monomials_are_counted_before_they_are_listed() {
    // In forty variables there are 2·10¹¹ monomials up to degree 12.
    let text = "title = 'wide'\n[parameters]\nn = 20\n[state]\nq = 'vector(n, -1..1)'\n\
                p = 'vector(n, -1..1)'\n[field]\n\"q'\" = 'p'\n\"p'\" = '-q'\n[[claim]]\n";
    let report = only(&format!("{text}no-integral = {{ degree = 12 }}\n"));
    assert_eq!(report.verdict, Verdict::Undecided);
    let reason = report.evidence.reason.unwrap_or_default();
    let says = "degree 12 has 206379406870 unknowns, and may take ";
    assert!(reason.starts_with(says) && reason.ends_with("ask for a lower one"), "{reason}");
}
