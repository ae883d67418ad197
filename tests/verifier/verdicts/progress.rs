//! Progress of a judgement, and its independence of the number of threads.

use std::sync::Mutex;

use liouville::case::Case;
use liouville::verdict::{CaseReport, Options, Trust, Verdict, judge, judge_telling};

/// Judges a case, and returns the shares told meanwhile with the report.
fn told(text: &str, options: &Options) -> (Vec<f64>, CaseReport) {
    let case = Case::parse(text, &[]).expect("a case");
    let told = Mutex::new(Vec::new());
    let progress = |share: f64| told.lock().expect("no panic").push(share);
    let report = judge_telling(&case, options, &progress).expect("judged");
    let silent = judge(&case, options).expect("judged");
    assert_eq!(format!("{silent:?}"), format!("{report:?}"), "who watches changes nothing");
    (told.into_inner().expect("no panic"), report)
}

const TOP: &str = "title = 'top'\n[parameters]\nA = '1..2'\nB = '3..4'\nC = '5..6'\n[state]\n\
    p = '-1..1'\nq = '-1..1'\nr = '-1..1'\n[field]\n\"p'\" = '(B − C)*q*r/A'\n\
    \"q'\" = '(C − A)*r*p/B'\n\"r'\" = '(A − B)*p*q/C'\n[[claim]]\nname = 'energy'\n\
    integral = 'A*p² + B*q² + C*r²'\n[[claim]]\nname = 'momentum'\n\
    integral = 'A²*p² + B²*q² + C²*r²'\n[[claim]]\nname = 'wrong'\nintegral = 'p²'\n\
    expect = 'fails'\n";

#[test]
fn all_claims_are_told_once() {
    for trust in [Trust::Best, Trust::Float] {
        let options = Options { trust, states: 1 << 18, ..Options::default() };
        let (shares, _) = told(TOP, &options);
        assert!(shares.iter().all(|share| *share >= 0.0), "{shares:?}");
        let sum: f64 = shares.iter().sum();
        assert!((sum - 3.0).abs() < 1e-9, "{sum}: {shares:?}");
        assert!(shares.len() >= 3, "not all at the end: {shares:?}");
        let last = shares.last().expect("told");
        assert!(*last > 0.0, "the end is told at the end: {shares:?}");
    }
    let (shares, _) = told(&TOP[..TOP.find("[[claim]]").expect("a claim")], &Options::default());
    let sum: f64 = shares.iter().sum();
    assert_eq!(sum, 0.0, "no claims: {shares:?}");
}

/// Claims about roots of their own, which are proved apart from one another.
fn many_roots() -> String {
    let mut text =
        "title = 'roots'\n[state]\nx = 'vector(40, 1..2)'\n[field]\n\"x'\" = 'x'\n".to_string();
    for i in 1..=40 {
        let (a, b) = (i, i % 40 + 1);
        let radicand = format!("x[{a}]² + x[{b}]⁴ + {i}*x[{a}]*x[{b}]");
        let sum = format!("(√({radicand}) + x[{a}])² − 2*x[{a}]*√({radicand})");
        text.push_str(&format!(
            "[[claim]]\nname = 'root {i}'\nidentity = '{sum} = {radicand} + x[{a}]²'\n"
        ));
    }
    text
}

#[test]
fn proofs_on_several_threads_are_those_on_one() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| told(&many_roots(), &Options::default()).1)
    };
    let alone = on(1);
    assert!(alone.claims.iter().all(|claim| claim.verdict == Verdict::Proved), "{alone:?}");
    assert_eq!(alone.claims.len(), 40);
    assert_eq!(format!("{:?}", on(4)), format!("{alone:?}"));
}
