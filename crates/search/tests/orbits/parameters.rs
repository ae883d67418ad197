//! Values of parameters for which a field has more integrals.

use liouville_search::{ConditionTarget, Effort, SearchReport};

use super::{field, searched};

fn conditions(text: &str, degree: u32) -> SearchReport {
    let conditions = Some(ConditionTarget::Existence);
    searched(text, &Effort { conditions, degree, ..Effort::default() })
}

fn equations(report: &SearchReport) -> Vec<&str> {
    report.conditions.iter().flat_map(|own| &own.equations).map(String::as_str).collect()
}

/// Integrals that hold for special values, with these.
fn special(report: &SearchReport) -> Vec<(String, String)> {
    let own = report.found.iter().filter(|found| found.kind == "integral");
    own.flat_map(|found| found.with.iter().map(|(_, value)| (value.clone(), found.formula.clone())))
        .collect()
}

#[test]
fn henon_and_heiles_have_their_two_ratios() {
    let text = "title = 'x'\n[parameters]\nk = '-8..8'\n[state]\nx = '-1..1'\ny = '-1..1'\np = '-1..1'\n\
                q = '-1..1'\n[hamiltonian]\nfunction = '(p² + q² + x² + y²)/2 + x²*y + k*y³/3'\n\
                pairs = [['x', 'p'], ['y', 'q']]";
    let report = conditions(text, 4);
    assert_eq!(equations(&report), ["k = 1", "k = 6"], "{:?}", report.conditions);
    let special = special(&report);
    assert!(
        special.iter().any(|(value, own)| value == "k = 1" && own.contains("p*q")),
        "{special:?}"
    );
    assert!(special.iter().any(|(value, _)| value == "k = 6"), "{special:?}");
    assert!(report.conditions.iter().all(|own| own.grounds.contains("no other value")));
}

#[test]
fn a_top_on_the_level_of_goryachev_and_chaplygin_has_their_ratio() {
    let text = "title = 'x'\n[parameters]\nJ = '0.2..5'\n[state]\nM = 'vector(-2..2)'\nn = 'vector(-1..1)'\n\
                [field]\n\"M'\" = 'M × [M1, M2, J*M3] + n × [1, 0, 0]'\n\"n'\" = 'n × [M1, M2, J*M3]'\n\
                [level]\nequations = ['(M,n) = 0']";
    let report = conditions(text, 3);
    assert_eq!(equations(&report), ["J = 1", "J = 4"], "{:?}", report.conditions);
}

#[test]
fn planted_values_are_found() {
    // Along (F_y + (…) x, −F_x) with F = x² y + y³ the rate of F is (…) x F_x.
    let planted = |parameters: &str, factor: &str| {
        let rates = [format!("x² + 3*y² + ({factor})*x"), "-2*x*y".to_string()];
        conditions(&field(parameters, &[&rates[0], &rates[1]]), 3)
    };
    let a = "a = '0.5..2'";
    for (factor, expected) in
        [("a - 17/5", "a = 3.4"), ("a² - 2", "a² − 2 = 0"), ("a³ + a + 1/3", "a³ + a + 1/3 = 0")]
    {
        let report = planted(a, factor);
        assert_eq!(equations(&report), [expected], "{:?}", report.conditions);
    }
    let report = planted("a = '0.5..2'\nb = '0.5..2'", "a - 3*b");
    assert!(equations(&report).contains(&"a/b = 3"), "{:?}", report.conditions);
    let report = planted(a, "a² + 1");
    assert_eq!(special(&report), [], "no real value");
    let report = planted("a = '0.5..2'", "1 + 0*a");
    assert!(equations(&report).is_empty(), "{:?}", report.conditions);
}
