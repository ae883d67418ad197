//! Poles that a cofactor shares with the field: they count where they hold on an open part of F = 0.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

#[test]
fn poles_of_the_field_count_where_they_are_on_few_zeros() {
    let of = |field: &[[&str; 2]], claim: &str| {
        let state = field.iter().map(|[name, _]| format!("{name} = '-1..1'\n")).collect::<String>();
        let rates = field.iter().map(|[name, rate]| format!("\"{name}'\" = \"{rate}\"\n"));
        let rates = rates.collect::<String>();
        let text = format!(
            "title = 't'\n[state]\n{state}[field]\n{rates}[[claim]]\n{claim}\nexpect = 'open'\n"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let found =
            judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
        found.claims[0].verdict
    };
    let relation = |function: &str, cofactor: &str| {
        format!("invariant-relation = \"{function}\"\ncofactor = \"{cofactor}\"")
    };
    // Planar motion in a central field.
    let central =
        [["x", "u"], ["y", "v"], ["u", "-x/sqrt(x^2 + y^2)^3"], ["v", "-y/sqrt(x^2 + y^2)^3"]];
    let plane = relation("[y, v]", "[[0, 1], [-1/sqrt(x^2 + y^2)^3, 0]]");
    assert_eq!(of(&central, &plane), Verdict::Proved);
    let turned = relation("[y - 2*x, v - 2*u]", "[[0, 1], [-1/sqrt(x^2 + y^2)^3, 0]]");
    assert_eq!(of(&central, &turned), Verdict::Proved);
    let wrong = relation("[y, v]", "[[0, 1], [1/sqrt(x^2 + y^2)^3, 0]]");
    assert_eq!(of(&central, &wrong), Verdict::Refuted);
    let scalar = [["x", "x*y/sqrt(x^2 + z^2)"], ["y", "1"], ["z", "x"]];
    assert_eq!(of(&scalar, &relation("x", "y/sqrt(x^2 + z^2)")), Verdict::Proved);
    let listed = "title = 't'\n[parameters]\na = 'one of 0, 1'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\
                  \"x'\" = 'sin(a*y^2 + x)/(a*y^2 + x)*(a*x + (1-a))'\n\"y'\" = '0'\n[[claim]]\n\
                  invariant-relation = 'x'\ncofactor = 'sin(a*y^2 + x)/(a*y^2 + x)*(a + (1-a)/(a*y^2 + x))'\n";
    let case = Case::parse(listed, &[]).expect("a case");
    let found = judge(&case, &Options::default()).expect("a report");
    assert_ne!(found.claims[0].verdict, Verdict::Proved, "for a = 0 the pole is F = 0");
    // All of F = 0, or a half of it, lies in a pole; and a pole that the field has not.
    for (field, function, cofactor) in [
        ([["x", "sin(x)/x"], ["y", "0"], ["z", "0"]], "x", "sin(x)/x^2"),
        ([["x", "sin(x)/x"], ["y", "0"], ["z", "0"]], "x", "sin(x)/(x*x)"),
        ([["x", "sin(x - y)/(x - y)"], ["y", "0"], ["z", "0"]], "x - y", "sin(x - y)/(x - y)^2"),
        ([["x", "x/(|y| - y + |x|)"], ["y", "0"], ["z", "0"]], "x", "1/(|y| - y + |x|)"),
        ([["x", "1 + x*y"], ["y", "0"], ["z", "1/(x^2 + y^2)"]], "x", "(1 + x*y)/x"),
    ] {
        let found = of(&field, &relation(function, cofactor));
        assert_ne!(found, Verdict::Proved, "{function}, {cofactor}");
    }
}
