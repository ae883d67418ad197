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
