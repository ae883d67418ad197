//! The same report for any number of threads.

use rayon::ThreadPoolBuilder;

use super::*;

/// A chain of Lotka and Volterra, in which many classes have integrals; and waves on a level.
const CASES: [&str; 2] = [
    "title = 'x'\nsystem = 'field'\n[state]\nu = '1..2'\nv = '1..2'\nw = '1..2'\nx = '1..2'\ny = '1..2'\n\
     [field]\n\"u'\" = 'u*(v - y)'\n\"v'\" = 'v*(w - u)'\n\"w'\" = 'w*(x - v)'\n\
     \"x'\" = 'x*(y - w)'\n\"y'\" = 'y*(u - x)'\n",
    "title = 'x'\nsystem = 'field'\n[parameters]\na = '1..2'\n[state]\nx = '-1..1'\ny = '-1..1'\n\
     z = '-1..1'\nu = '-1..1'\n[field]\n\"x'\" = 'a*y*z'\n\"y'\" = '-a*x*z'\n\"z'\" = 'u'\n\
     \"u'\" = '-z'\n[level]\nequations = ['x² + y² = 1']\n",
];

#[test]
fn a_report_does_not_depend_on_the_number_of_threads() {
    for text in CASES {
        let report = |threads: usize| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            let effort = Effort { by_factors: false, ..Effort::default() };
            pool.install(|| format!("{:?}", searched(text, &effort)))
        };
        let alone = report(1);
        assert!(alone.contains("integral"), "something is found");
        for threads in [2, 5] {
            assert_eq!(report(threads), alone, "{threads} threads");
        }
    }
}
