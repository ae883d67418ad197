//! Integrals that are squares of others.

use liouville::case::Case;
use liouville_search::{Effort, FoundKind, search};

#[test]
fn an_integral_is_told_and_not_its_square() {
    let text = "title = 'top'\n[parameters]\nI = 'diag(1, 2, 5/2)'\n[state]\nw = 'vector(-2..2)'\n[field]\n\
                \"w'\" = 'solve(I, I*w × w)'\n";
    let case = Case::parse(text, &[]).expect("a case");
    let report = search(&case, &Effort::default(), &mut |_| ()).expect("a report");
    let all: Vec<&str> = report.found.iter().map(|own| own.text()).collect();
    assert!(all.contains(&"(I*w,w)") && !all.iter().any(|own| own.ends_with(")²")), "{all:?}");
    assert!(report.found.iter().all(|own| own.kind != FoundKind::FurtherIntegral), "{all:?}");
}
