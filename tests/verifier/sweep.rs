//! Sweeps: the same results for any number of threads and by every engine, at states that `eval`
//! reproduces, in agreement with the verdicts.

use liouville::case::Case;
use liouville::engine::Backend;
use liouville::sweep::{Extremes, Sweep, SweepError};
use liouville::verdict::{Options, Trust, Verdict, judge};

const BALL: &str = "title = 'Ball'\nsystem = 'rubber-plane'\n[parameters]\nm = '0.5..2'\n\
    R = '1..3'\nc = 'vector(-0.5..0.5)'\nI = 'inertia(0.5..5)'\n[body]\n\
    support = 'R*|γ| + (c,γ)'\n\
    [[claim]]\nintegral = '|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)'\n\
    [[claim]]\nintegral = '|Ĩ*ω × γ|² − (2 + 1/1000)*m*R*(γ,c)*(Ĩ*ω,ω)'\nexpect = 'fails'\n";

fn case() -> Case {
    Case::parse(BALL, &[]).expect("a case")
}

fn sweep(case: &Case, claim: usize, means: Backend) -> Sweep<'_> {
    Sweep::by(case, &case.claims[claim], 1, means).expect("a sweep")
}

#[test]
fn threads_and_engines_change_nothing() {
    let case = case();
    let states = 5..200_005;
    let found: Vec<Extremes> =
        [(1, Backend::Quickest), (2, Backend::Quickest), (3, Backend::Interpreter)]
            .into_iter()
            .map(|(threads, means)| {
                let pool =
                    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
                pool.install(|| sweep(&case, 0, means).run(states.clone(), f64::INFINITY))
            })
            .collect();
    assert_eq!(found[0].states, 200_000, "all were looked at");
    assert_eq!(found[0].defined, 200_000, "and have a value");
    assert!(found.iter().all(|other| *other == found[0]), "{found:?}");
}

#[test]
fn a_slip_shows_and_ends_the_sweep() {
    let case = case();
    let right = sweep(&case, 0, Backend::Quickest).run(0..100_000, f64::INFINITY);
    let peak = right.peak.expect("defined");
    assert!(peak.ratio < 1e-13, "rounding, at state {}: {}", peak.index, peak.ratio);
    let wrong = sweep(&case, 1, Backend::Quickest);
    let found = wrong.run(0..u64::MAX, 1e-6);
    assert_eq!(found.states, 1 << 20, "one look is enough");
    let peak = found.peak.expect("defined");
    let alone = wrong.run(peak.index..peak.index + 1, f64::INFINITY);
    assert_eq!(alone.peak, found.peak, "a state does not depend on those beside it");
    let (parameters, state) = wrong.state(peak.index);
    let names: Vec<&str> = parameters.iter().chain(&state).map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["m", "R", "c", "I", "ω", "γ"], "by name");
    let gamma: f64 = state[1].1.iter().map(|x| x.parse::<f64>().expect("a number").powi(2)).sum();
    assert!((gamma - 1.0).abs() < 1e-15, "on the level: {gamma}");
}

#[test]
fn states_without_a_value_do_not_count() {
    let text = "title = 'x'\n[state]\nx = '-1..1'\n[field]\n\"x'\" = '0'\n\
        [[claim]]\nidentity = '(√x)² = |x|'\n[[claim]]\nidentity = 'exp(log(x)) = x'\n\
        [[claim]]\nintegral = 'log(x)'\n";
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}"));
    for claim in 0..3 {
        let found = sweep(&case, claim, Backend::Quickest).run(0..10_000, f64::INFINITY);
        assert!((4800..5200).contains(&found.defined), "claim {claim}: x > 0 in {found:?}");
        let ratio = found.peak.map(|peak| peak.ratio);
        assert!(ratio.is_some_and(|x| x < 1e-13 && x.is_sign_positive()), "{claim}: {found:?}");
    }
}

#[test]
fn identities_whose_sides_cancel_are_as_small_as_rounding() {
    let text = "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\nx = 'y'\ny = '-x'\n\
        [[claim]]\nidentity = '(x+y)^2 - x^2 - 2*x*y - y^2 = 0'\n\
        [[claim]]\nidentity = '0.1*x + 0.2*x - 0.3*x = 0'\n\
        [[claim]]\nidentity = '(x+y)^2 - x^2 - 2*x*y - 1.001*y^2 = 0'\nexpect = 'fails'\n";
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}"));
    let peak = |claim| sweep(&case, claim, Backend::Quickest).run(0..10_000, f64::INFINITY).peak;
    for claim in 0..2 {
        let ratio = peak(claim).map(|peak| peak.ratio);
        assert!(ratio.is_some_and(|x| x < 1e-14), "claim {claim}: {ratio:?}");
    }
    assert!(peak(2).is_some_and(|peak| peak.ratio > 1e-4), "a slip is seen: {:?}", peak(2));
}

#[test]
fn a_level_without_a_chart_has_no_sweep() {
    let text = "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = '-y'\n\
        \"y'\" = 'x'\n[level]\nequations = ['x⁴ + y⁴ + 2*x²*y² = 1']\n[[claim]]\n\
        integral = 'x² + y²'\n";
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}"));
    let found = Sweep::new(&case, &case.claims[0], 1);
    assert!(matches!(found, Err(SweepError::NoChart)), "{found:?}");
}

#[test]
fn many_states_give_the_verdict_of_few() {
    let case = case();
    let judged = |states| {
        let options = Options { states, trust: Trust::Float, ..Options::default() };
        let report = judge(&case, &options).expect("judged");
        report
            .claims
            .iter()
            .map(|claim| (claim.verdict, claim.evidence.samples))
            .collect::<Vec<_>>()
    };
    let (few, many) = (judged(256), judged(20_000));
    assert_eq!((few[0].0, many[0].0), (Verdict::Confirmed, Verdict::Confirmed), "the integral");
    assert_eq!((few[0].1, many[0].1), (256, 20_032), "at all states, in blocks of 64");
    assert_eq!((few[1].0, many[1].0), (Verdict::Refuted, Verdict::Refuted), "the slip");
}

#[test]
fn solved_variables_keep_their_ranges() {
    let text = "title = 't'\n[state]\nx = '-1..1'\ny = '0.5..3'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n\
                [level]\nequations = ['x² + y² = 3']\n[[claim]]\nidentity = 'y = |y|'\n";
    let case = Case::parse(text, &[]).expect("a case");
    let found = sweep(&case, 0, Backend::Quickest).run(0..4096, f64::INFINITY);
    assert_eq!(found.states, 4096);
    assert!((1000..3000).contains(&found.defined), "half of the states have y < 0: {found:?}");
    assert_eq!(found.peak.map(|peak| peak.ratio), Some(0.0));
}

#[test]
fn a_scale_beyond_f64_hides_no_residual() {
    let peak = |field: &str, integral: &str| {
        let text = format!(
            "title = 'x'\n[state]\nx = '1..2'\ny = '1..2'\n[field]\n\"x'\" = '{field}*x'\n\
             \"y'\" = '{field}*y'\n[[claim]]\nintegral = '{integral}'\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        let found = sweep(&case, 0, Backend::Quickest).run(0..100, f64::INFINITY);
        assert_eq!(found.defined, 100, "{field}, {integral}: {found:?}");
        found.peak.expect("it has values").ratio
    };
    let near = peak("1", "x/y + x*y");
    for power in [150, 160, 250, 306, -150, -160, -250, -300] {
        let found = peak(&format!("1e{power}"), "x/y + x*y");
        assert!((found - near).abs() < 1e-13, "10^{power}: {found} and {near}");
        // The slope is as small as the field is large.
        let other = peak(&format!("1e{power}"), &format!("1e{}*(x/y + x*y)", -power));
        assert!((other - near).abs() < 1e-13, "10^{power}: {other} and {near}");
        let rounding = peak(&format!("1e{power}"), "x/y");
        assert!(rounding < 1e-15, "10^{power}: {rounding}");
    }
}
