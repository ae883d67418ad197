//! Guards the work of counts, which is limited in steps that are the same on every machine.

use liouville::case::Case;
use liouville_search::{Effort, search};

/// A chain of oscillators between walls.
fn chain(n: u32) -> String {
    format!(
        r#"title = "Chain"
system = "nonholonomic"
[parameters]
n = {n}
m = "1..2"
k = "1..3"
[state]
q = "vector(n, -1..1)"
"q'" = "vector(n, -1..1)"
[lagrangian]
kinetic = "sum(i, 1..n, m*q'[i]²)/2"
potential = "k*(q[1]² + q[n]² + sum(i, 1..n−1, (q[i+1] − q[i])²))/2"
"#
    )
}

#[test]
fn chains_are_counted_in_few_steps() {
    // Steps in thousand millions. The dimensions are those of polynomials in the energies of n
    // modes: with generic parameters there are no others.
    for (n, degree, seconds, dimension) in [(2, 6, 0.002, 10), (3, 4, 0.006, 10), (3, 5, 0.02, 10)]
    {
        let case = Case::parse(&chain(n), &[]).expect("a case");
        let effort = Effort { degree, seconds, ..Effort::default() };
        let report = search(&case, &effort, &mut |_| {}).expect("it can be searched");
        let counted = report.counts.iter().find(|count| count.degree == degree);
        let found = counted.map(|count| count.dimension);
        assert_eq!(found, Some(dimension), "n = {n}, degree {degree}: {:?}", report.remarks);
    }
}

#[test]
fn searches_of_many_terms_end_by_the_steps_they_take() {
    let variables = 90;
    let rate = |k: usize| {
        let at = |k: usize| k % variables + 1;
        format!("x[{}]*(x[{}] − x[{}])", at(k), at(k + 1), at(k + variables - 1))
    };
    let rates: Vec<String> = (0..variables).map(rate).collect();
    let text = format!(
        "title = \"Chain\"\nsystem = \"field\"\n[state]\nx = \"vector({variables}, 1..2)\"\n\
         [field]\n\"x'\" = \"[{}]\"\n",
        rates.join(", ")
    );
    let case = Case::parse(&text, &[]).expect("a case");
    let remarks = |seconds: f64| {
        let effort = Effort { seconds, by_factors: false, ..Effort::default() };
        let report = search(&case, &effort, &mut |_| {}).expect("it can be searched");
        assert!(report.unreached.is_empty(), "no clock stops it");
        report.remarks.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    // 90³/3 steps, in thousand millions, are enough for the relations, and 90²·122 for singular values.
    let all = remarks(0.003);
    let is_limited = all.contains("cross-check") || all.contains("take more");
    assert!(!is_limited, "no limit is reached: {all}");
    let no_opinion = remarks(0.0006);
    assert!(no_opinion.contains("no cross-check of 90 terms over 1"), "{no_opinion}");
    let none = remarks(0.00005);
    assert!(none.contains("not sought: 90 unknowns take more than 0.00005 s"), "{none}");
}

#[test]
fn searches_of_fields_of_many_terms_end_by_the_steps_of_their_series() {
    let rate = |shift: usize| {
        let term = |k: usize| format!("{}*x^{}*y^{}", k % 7 + shift, k % 12, 12 - k % 12);
        (0..12).map(term).collect::<Vec<_>>().join(" + ")
    };
    let text = format!(
        "title = 'x'\nsystem = 'field'\n[state]\nx = '1..2'\ny = '1..2'\n[field]\n\
         \"x'\" = '{} + 1'\n\"y'\" = '{} + x'\n",
        rate(1),
        rate(2)
    );
    let case = Case::parse(&text, &[]).expect("a case");
    let effort = Effort { seconds: 0.0001, by_class: false, ..Effort::default() };
    let report = search(&case, &effort, &mut |_| {}).expect("it can be searched");
    let remarks: Vec<String> = report.remarks.iter().map(ToString::to_string).collect();
    let expected = "no further Darboux polynomials: series of orbits take more than 0.0001 s; raise --count-seconds";
    assert!(remarks.iter().any(|own| own == expected), "{remarks:?}");
    assert!(!report.orbits.is_empty(), "relations along an orbit are reported");
}
