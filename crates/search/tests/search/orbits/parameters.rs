//! Values of parameters for which a field has more integrals.

use liouville::verdict::Options;
use liouville_search::{ConditionTarget, Effort, FoundKind, SearchReport};

use super::{field, searched};

fn conditions(text: &str, degree: u32) -> SearchReport {
    let conditions = Some(ConditionTarget::Existence);
    let effort = Effort { by_class: false, by_factors: false, ..Effort::default() };
    searched(text, &Effort { conditions, degree, ..effort })
}

fn equations(report: &SearchReport) -> Vec<&str> {
    report.conditions.iter().flat_map(|own| &own.equations).map(String::as_str).collect()
}

/// Integrals that hold for special values, with these.
fn special(report: &SearchReport) -> Vec<(String, String)> {
    let own = report.found.iter().filter(|found| found.kind == FoundKind::Integral);
    own.flat_map(|found| {
        found.with.iter().map(|own| (own.text().to_string(), found.text().to_string()))
    })
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
    let report = planted(a, "a² + 1");
    assert_eq!(special(&report), [], "no real value");
    let report = planted("a = '0.5..2'", "1 + 0*a");
    assert!(equations(&report).is_empty(), "{:?}", report.conditions);
}

/// A field with a further integral where a polynomial in the parameters vanishes, in linear coordinates
/// of the state: with F = x² y + y³ the field (F_y + P x, −F_x) has F' = P x F_x.
fn planted_in(parameters: &[&str], polynomial: &str) -> SearchReport {
    let ranges: Vec<String> = parameters.iter().map(|name| format!("{name} = '0.5..2'")).collect();
    // x = u + 2 v, y = 3 u − v; u = (x + 2 y)/7, v = (3 x − y)/7
    let [x, y] = ["(u + 2*v)", "(3*u - v)"];
    let (dx, dy) = (format!("{x}² + 3*{y}² + ({polynomial})*{x}"), format!("-2*{x}*{y}"));
    let text = format!(
        "title = 'x'\n[parameters]\n{}\n[state]\nu = '-1..1'\nv = '-1..1'\n[field]\n\
         \"u'\" = '({dx} + 2*({dy}))/7'\n\"v'\" = '(3*({dx}) - ({dy}))/7'\n",
        ranges.join("\n")
    );
    conditions(&text, 3)
}

#[test]
fn planted_equations_between_parameters_are_found() {
    let cases: [(&[&str], &str, &[&str]); 8] = [
        (&["a", "b"], "a - 3*b", &["a = 3*b"]),
        (&["a", "b"], "a*b - 1", &["a*b − 1 = 0"]),
        (&["a", "b"], "(a - b² - 1)*(2*a + 3*b)", &["2*a + 3*b = 0", "b² − a + 1 = 0"]),
        (&["a", "b"], "a² - 2*b²", &["a² − 2*b² = 0"]),
        (&["a", "b"], "(a - 7)*(b² - 5)/(a + b)", &["a = 7", "b² − 5 = 0"]),
        (&["a", "b", "c"], "(a - b)²*(a*b + c² - 3)", &["a = b", "a*b + c² − 3 = 0"]),
        (&["a", "b", "c"], "b*(a² + b² + c² - 1)", &["b = 0", "a² + b² + c² − 1 = 0"]),
        (
            &["a", "b", "c", "d"],
            "(a*d - b*c)*(a + b + c + d)",
            &["a + b + c + d = 0", "a*d − b*c = 0"],
        ),
    ];
    for (parameters, polynomial, expected) in cases {
        let report = planted_in(parameters, polynomial);
        let own: Vec<&str> = equations(&report);
        assert_eq!(own, expected, "{polynomial}: {:?}", report.conditions);
        assert!(
            report.conditions.iter().all(|own| own.grounds.contains("no other")),
            "{polynomial}: {:?}",
            report.conditions
        );
        let proved: Vec<String> = special(&report).into_iter().map(|(value, _)| value).collect();
        for equation in
            expected.iter().filter(|own| !own.contains("² − 5") && !own.contains("− 2*b²"))
        {
            let is_linear = *equation != "a² + b² + c² − 1 = 0";
            assert_eq!(
                proved.iter().any(|own| own == equation),
                is_linear,
                "{equation}: {proved:?}"
            );
        }
    }
    let report = conditions(&field("a = '0.5..2'\nb = '0.5..2'", &["a*y - 2*b*y", "0"]), 3);
    let grounds = &report.conditions[0].grounds;
    assert!(grounds.ends_with("none is added up to degree 3"), "{:?}", report.conditions);
    let report = planted_in(&["a", "b"], "1 + 0*a*b");
    assert_eq!(equations(&report), [""; 0]);
    assert!(report.conditions[0].grounds.contains("no equation gives"), "{:?}", report.conditions);
}

#[test]
fn values_at_which_one_choice_of_columns_fails_are_no_values() {
    // z drops out of the second integral where a² + a = 1, and as many are left.
    let rates = ["y*z", "a*x*z + (a² + a − 1)*x", "x*y*(a − 3)"];
    for seed in 1..=6 {
        let effort = Effort {
            conditions: Some(ConditionTarget::Existence),
            degree: 4,
            options: Options { seed, ..Options::default() },
            ..Effort::default()
        };
        let report = searched(&field("a = '-2..2'", &rates), &effort);
        assert_eq!(equations(&report), ["a = 3"], "seed {seed}: {:?}", report.conditions);
    }
}

#[test]
fn values_that_are_known_come_but_once() {
    // At degree 3 a further factor has no real root.
    let report = conditions(&field("a = '-3..3'", &["y", "−x − (a² − 2)*y"]), 3);
    assert_eq!(equations(&report), ["a² − 2 = 0"], "{:?}", report.conditions);
    let report = conditions(&field("a = '-3..3'", &["x*(a − 2)", "y*(a² − 3)"]), 3);
    let all = equations(&report);
    assert_eq!(all.iter().filter(|own| own.contains("a² − 3")).count(), 1, "{all:?}");
    assert!(all.iter().all(|own| !own.contains("a⁴ + a³ − 8")), "{all:?}");
}

#[test]
fn values_at_which_a_level_falls_apart_are_left_open() {
    let text = "title = 'x'\n[parameters]\nc = '-1..1'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n\
                [field]\n\"x'\" = 'x*(z + y)'\n\"y'\" = '-y*(z + y)'\n\"z'\" = 'x + 2*y'\n\
                [level]\nequations = ['x*y = c']";
    let report = conditions(text, 4);
    assert_eq!(equations(&report), [""; 0], "{:?}", report.conditions);
    let remark = "where c = 0 is not known";
    assert!(report.remarks.iter().any(|own| own.contains(remark)), "{:?}", report.remarks);
}

#[test]
fn the_absence_of_conditions_is_told_as_such() {
    let rates = ["y*z + (b²*a³ − 2)*x²", "x*z + (a² − a − 1)*(a − 5*b)*y*z", "x*y + (a² + 1)*z*x"];
    let report = conditions(&field("a = '0.5..1.3'\nb = '1..2'", &rates), 2);
    assert_eq!(equations(&report), [""; 0]);
    let grounds = &report.conditions[0].grounds;
    assert!(grounds.ends_with("modulo a prime of 61 bits no equation gives more"), "{grounds}");
}

#[test]
fn equations_that_are_not_written_are_counted() {
    // Coefficients too long to be told from accidents.
    let report = planted_in(&["a", "b"], "(a - 12345678910111213*b)*(a + b - 1)");
    assert_eq!(report.conditions[0].equations, ["a + b − 1 = 0"], "{:?}", report.conditions);
    let grounds = &report.conditions[0].grounds;
    assert!(grounds.contains("of degree 1 together") && !grounds.contains("no other"), "{grounds}");
    // Of too high a degree along a line: one parameter at a time.
    let report = planted_in(&["a", "b"], "a^9*b^9 + a^15 + b^17 + 7");
    assert!(
        report.conditions.iter().all(|own| !own.grounds.contains("no other")),
        "{:?}",
        report.conditions
    );
}

#[test]
fn components_of_tensors_are_parameters() {
    // A heavy top with free J = I⁻¹ and its centre of mass in the plane of two axes.
    let text = "title = 'x'\n[parameters]\nJ = 'diag(0.2..5)'\nx = '-1..1'\nz = '-1..1'\n[state]\n\
                M = 'vector(-2..2)'\nn = 'vector(-1..1)'\n[field]\n\
                \"M'\" = 'M × (J*M) + n × [x, 0, z]'\n\"n'\" = 'n × (J*M)'\n";
    let report = conditions(text, 2);
    let expected = [
        "x = 0 and J1 = J2",
        "z = 0 and J2 = J3",
        "J1 = 0 and J2 = 0",
        "J1 = 0 and J3 = 0",
        "J2 = 0 and J3 = 0",
        "J1 = J2 = J3",
        "x = 0 and z = 0",
    ];
    assert_eq!(equations(&report), expected, "{:?}", report.conditions);
    let special = special(&report);
    let lagrange = special.iter().find(|(value, _)| value == expected[0]);
    assert_eq!(lagrange.map(|(_, own)| own.as_str()), Some("M3"));
    assert_eq!(special.len(), expected.len(), "{special:?}");
    assert!(report.remarks.iter().any(|own| own.contains("only where one or two of these hold")));
}

#[test]
fn roots_of_parameters_stay_at_random_values() {
    let rates = ["x² + 3*y² + (a - √c*b)*x*(1 + √c)", "-2*x*y"];
    let parameters = "a = '0.5..2'\nb = '0.5..2'\nc = '0.5..2'";
    let report = conditions(&field(parameters, &rates), 3);
    let first = &report.conditions[0];
    assert!(first.equations.is_empty(), "it contains √c: {first:?}");
    assert!(first.grounds.contains("of degree 1 together"), "{first:?}");
    assert!(report.conditions.iter().all(|own| !own.grounds.contains("no other")));
    assert!(
        report.conditions.iter().all(|own| own.grounds.contains("random values of c")),
        "{:?}",
        report.conditions
    );
    let rates = ["x² + 3*y² + (a - b)*x*(1 + √c)", "-2*x*y"];
    let report = conditions(&field(parameters, &rates), 3);
    assert_eq!(report.conditions[0].equations, ["a = b"], "{:?}", report.conditions);
    let rates = ["x² + 3*y² + (a - b)*|x|", "-2*x*y"];
    let report = conditions(&field("a = '0.5..2'\nb = '0.5..2'", &rates), 3);
    assert!(report.conditions.is_empty(), "{:?}", report.conditions);
    assert!(report.remarks.iter().any(|own| own.contains("contain a modulus")));
}
