//! States at which all that is written has a value, and at no state around: they refute nothing.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn verdict(claim: &str, seed: u64) -> Verdict {
    let text = format!(
        "title = 't'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = '0'\n\"y'\" = '0'\n[[claim]]\n\
         identity = '{claim}'\n"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let options = Options { seed, ..Options::default() };
    judge(&case, &options).unwrap_or_else(|error| panic!("{error}\n{text}")).claims[0].verdict
}

#[test]
fn a_state_alone_refutes_nothing() {
    // For y < 0 the root has a value on a line alone, where |y| is not y.
    for claim in [
        "abs(y) + sqrt(y*(x + 0.195)²) + 2*sin(π/6) = y + sqrt(y*(x + 0.195)²) + 1",
        "abs(y) + sqrt(y*(x + 0.5)²) + 2*sin(π/6) = y + sqrt(y*(x + 0.5)²) + 1",
        "abs(y) + sqrt(y*x²) + 2*sin(π/6) = y + sqrt(y*x²) + 1",
        "abs(y) + sqrt(y*(2*x - y - 0.449)²) + 2*sin(π/6) = y + sqrt(y*(2*x - y - 0.449)²) + 1",
    ] {
        for seed in 1..60 {
            assert_ne!(verdict(claim, seed), Verdict::Refuted, "{claim} with the seed {seed}");
        }
    }
    for seed in 1..60 {
        for claim in ["sqrt(-(x + 0.195)²) = 1", "sqrt(-(2*x - y - 0.449)²) = 1"] {
            assert_eq!(verdict(claim, seed), Verdict::Undecided, "no state of {claim} counts");
        }
    }
}

#[test]
fn a_state_at_the_edge_of_others_refutes() {
    for seed in 1..4 {
        assert_eq!(verdict("sqrt(x) = 1", seed), Verdict::Refuted, "values for x > 0");
        assert_eq!(verdict("abs(y) + sqrt(x²*y²) = y + sqrt(x²*y²)", seed), Verdict::Refuted);
    }
}
