//! Levels that are missed, fall apart, or have dependent equations.

use liouville::case::Case;
use liouville::verdict::{JudgeError, Options, Verdict, judge};

use crate::doubts::judged;

/// Writes a rotation about e₃ on the unit sphere, with a chart.
fn on_sphere(chart: &str, rest: &str) -> String {
    format!(
        "title = 'x'\n[state]\nx = 'vector(-1..1)'\n[field]\n\"x'\" = '[0,0,1] × x'\n[level]\n\
         equations = ['(x,x) = 1']\n[level.chart]\n{chart}\n{rest}"
    )
}

#[test]
fn a_chart_has_to_lie_on_the_level_and_to_fill_it() {
    let inputs = "inputs = { u = '-2..2', v = '-2..2' }";
    let good = format!("{inputs}\nx = 'vec(2*u, 2*v, 1 − u² − v²)/(1 + u² + v²)'");
    let off = format!("{inputs}\nx = 'vec(2*u, 2*v, 1 − u² − v²)/(2 + u² + v²)'");
    let part = "inputs = { u = '-2..2' }\nx = 'vec(2*u, 0, 1 − u²)/(1 + u²)'";
    let claim = "[[claim]]\nintegral = 'x3'\n";
    assert!(judged(&on_sphere(&good, claim)).is_ok(), "the stereographic chart is one");
    assert!(matches!(judged(&on_sphere(&off, claim)), Err(JudgeError::OffLevel { .. })));
    let partial = judged(&on_sphere(part, claim));
    assert!(matches!(partial, Err(JudgeError::PartialChart { found: 1, dimension: 2, .. })));
}

#[test]
fn a_witness_that_is_looked_for_lies_on_the_level() {
    // The claim fails for z > 2 - 1e-7 only, and says nothing about the sign of y = ±√(2 - x²).
    let text = "title = 'x'\n[state]\nx = '-2..2'\ny = '-20..20'\nz = '-2..2'\n[field]\n\"x'\" = '0'\n\
                \"y'\" = '0'\n\"z'\" = '0'\n[level]\nequations = ['x² + y² = 2']\n[[claim]]\n\
                identity = '2 = 2 + (z - (2 - 1e-7) + |z - (2 - 1e-7)|)'\nexpect = 'fails'\n";
    let found = judged(text).expect("it can be judged").claims.remove(0);
    assert_eq!(found.verdict, Verdict::Refuted);
    let state = found.evidence.witness.expect("a state was found").state;
    let number = |text: &str| -> f64 {
        let (above, below) = text.split_once('/').unwrap_or((text, "1"));
        let [above, below] = [above, below].map(|part| part.parse::<f64>().expect("a number"));
        above / below
    };
    let value = |name: &str| {
        let part = state.split(' ').find_map(|part| part.strip_prefix(name));
        number(part.expect("each variable is printed"))
    };
    let off = value("x=").powi(2) + value("y=").powi(2) - 2.0;
    assert!(off.abs() < 1e-12, "{state} is off the level by {off}");
}

#[test]
fn a_witness_with_a_root_of_nothing_is_printed() {
    let text = "title = 'x'\n[state]\nx = '-20..20'\ny = '-20..20'\nz = '-2..2'\n[field]\n\"x'\" = '0'\n\
                \"y'\" = '0'\n\"z'\" = '0'\n[level]\n\
                equations = ['x - |[sqrt(z + sqrt(y² - 2*y*y + y²)), 7, 5]| = 0']\n[[claim]]\n\
                identity = '0 = y'\nexpect = 'fails'\n";
    for seed in [1, 2, 627_816] {
        let case = Case::parse(text, &[]).expect("a case");
        let options = Options { seed, ..Options::default() };
        let found = judge(&case, &options).expect("it can be judged").claims.remove(0);
        assert_eq!(found.verdict, Verdict::Refuted);
        let state = found.evidence.witness.expect("a state was drawn").state;
        assert!(!state.contains("NaN"), "{state}");
    }
}

#[test]
fn dependent_level_equations_are_told() {
    for second in ["exp(x) = e", "0*x = 0"] {
        let text = format!(
            "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = '0*x'\n\"y'\" = 'x'\n\
             [level]\nequations = ['x = 1', '{second}']\n"
        );
        assert!(matches!(judged(&text), Err(JudgeError::Dependent(_))), "{second}");
    }
}

#[test]
fn level_equations_that_follow_from_others_are_left_out() {
    let text = |second: &str| {
        format!(
            "title = 'x'\n[parameters]\na = '1..2'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\
             \"x'\" = '0*x'\n\"y'\" = 'x'\n[level]\nequations = ['x = 1', '{second}']\n\
             [[claim]]\nidentity = 'x² = x'\n"
        )
    };
    for second in
        ["x = 1", "2*x = 2", "a*x + 2*x = a*x + 2", "(x + 1)² − x² = 3", "x² = 1", "y*a*x = a*y"]
    {
        let case = Case::parse(&text(second), &[]).expect("a case");
        let remark = "follows from the other equations of the level, and is left out";
        assert!(
            case.remarks.iter().any(|own| own.to_string().contains(remark)),
            "{second}: {:?}",
            case.remarks
        );
        assert_eq!(case.model.level.len(), 1);
        let found = judge(&case, &Options::default()).expect("it can be judged").claims.remove(0);
        assert_eq!(found.verdict, Verdict::Proved, "{second}");
    }
    for second in ["x = 2", "x + 1/10^30 = 1", "a*x + x = a*x + 2"] {
        assert!(Case::parse(&text(second), &[]).is_err(), "{second}");
    }
    for second in ["y = 1", "a*x = a + 1/10^30", "x*y = y + 1"] {
        let case = Case::parse(&text(second), &[]).expect("a case");
        assert_eq!(case.model.level.len(), 2, "{second}");
    }
}

#[test]
fn a_level_that_falls_apart_is_told() {
    let text = |equation: &str| {
        format!(
            "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'x*(x − 1)'\n\"y'\" = 'cos(y) − y'\n[level]\n\
             equations = ['{equation}']\n[[claim]]\nidentity = 'x = 1'\nexpect = 'open'\n"
        )
    };
    for (equation, apart) in
        [("(x − 1)*(cos(y) − y) = 0", true), ("x*(x − 1) = 0", false), ("x − 1 = 0", false)]
    {
        let warnings = judged(&text(equation)).expect("it can be judged").warnings;
        assert_eq!(warnings.iter().any(|w| w.contains("may fall apart")), apart, "{equation}");
    }
    let inputs = "inputs = { u = '-2..2', v = '-2..2' }";
    let chart = format!("{inputs}\nx = 'vec(2*u, 2*v, 1 − u² − v²)/(1 + u² + v²)'");
    let warnings = judged(&on_sphere(&chart, "")).expect("it can be judged").warnings;
    assert!(warnings.iter().any(|w| w.contains("image of [level.chart]")), "{warnings:?}");
}

#[test]
fn a_level_that_is_missed_by_little_is_missed() {
    let chart = |off: &str| {
        format!(
            "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '1..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '−x'\n\
             \"z'\" = '0*z'\n[level]\nequations = ['x² + y² = 1']\n[level.chart]\n\
             inputs = {{ t = '-2..2', s = '1..2' }}\nx = '(1 − t²)/(1 + t²){off}'\ny = '2*t/(1 + t²)'\nz = 's'\n\
             [[claim]]\nintegral = 'x² + y²'\n"
        )
    };
    assert!(judged(&chart("")).is_ok(), "a point of the circle");
    for off in ["+1e-40", "+1e-400"] {
        let found = judged(&chart(off));
        assert!(matches!(found, Err(JudgeError::OffLevel { .. })), "{off}: {found:?}");
    }
    let left = judged(
        "title = 'x'\n[state]\nx = '1..2'\ny = '1..2'\n[field]\n\"x'\" = 'x'\n\"y'\" = 'y + 1e-40'\n\
         [level]\nequations = ['x*(1+y-y) = y+(x-x)']\n[[claim]]\nidentity = 'x = y'\n",
    );
    assert!(matches!(left, Err(JudgeError::NotInvariant { .. })), "{left:?}");
}
