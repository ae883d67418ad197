//! Absence in systems with exponentials of positions.

use liouville::verdict::Verdict;

use super::{Dice, absences, only};

fn plane(potential: &str, claims: &str) -> String {
    format!(
        "title = 't'\nsystem = 'nonholonomic'\n[parameters]\nk = '0.5..2'\n[state]\nx = '-1..1'\ny = '-1..1'\n\
         \"x'\" = '-1..1'\n\"y'\" = '-1..1'\n[lagrangian]\nkinetic = \"(x'² + y'²)/2\"\n\
         potential = '{potential}'\n{claims}"
    )
}

const DEGREE_2: &str = "[[claim]]\nno-integral = { degree = 2 }\n";

#[test]
fn potentials_of_exponentials_are_counted() {
    for potential in [
        "exp(x) + exp(2*y) + exp(x + y)",
        "exp(k*x) + exp(2*k*y) + exp(k*(x + y))",
        "k*exp(−2*x) − 2*exp(−x) + y²*exp(−x)",
        "exp(x/2) + exp(y/3) + exp(x + y)",
        "cos(x)*exp(y) + exp(2*y)",
        "cosh(x) + sinh(y)*exp(x)",
    ] {
        let report = only(&plane(potential, DEGREE_2));
        assert_eq!(report.verdict, Verdict::Proved, "{potential}: {:?}", report.evidence.reason);
    }
}

#[test]
fn planted_integrals_with_exponentials_are_never_excluded() {
    let mut dice = Dice(11);
    let mut refuted = 0;
    for plant in 0..24 {
        let (m, n) = [(3, 4, 5), (5, 12, 13), (8, 15, 17)]
            .map(|(a, b, c)| (format!("{a}/{c}"), format!("{b}/{c}")))[plant % 3]
            .clone();
        let (a, b, r, s) = (dice.unit(), dice.unit(), dice.unit(), dice.unit());
        // Separable in turned coordinates; Toda's two particles with any rate; and what is refused.
        let potential = match plant % 4 {
            0 => format!("({a})*exp(({r})*({m}*x + {n}*y)) + ({b})*exp(({s})*({m}*y − {n}*x)/2)"),
            1 => format!("({a})*exp(k*({r})*(x − y)) + ({b})*exp(2*k*({r})*(x − y))"),
            2 => format!("({a})*exp(({r})*x) + ({b})*x² + ({s})*y^4"),
            _ => format!("({a})*exp(x) + ({b})*exp(√(2)*x) + ({s})*exp(k*x) + exp(({r})*y)"),
        };
        let text = plane(&potential, DEGREE_2);
        let report = only(&text);
        assert_ne!(report.verdict, Verdict::Proved, "an integral is there:\n{text}");
        refuted += usize::from(report.verdict == Verdict::Refuted);
    }
    assert!(refuted >= 10, "{refuted} of 24 plants are exhibited");
}

#[test]
fn the_integrals_of_a_chain_are_all_that_there_are() {
    let chain = |claims: &str| {
        format!(
            "title = 't'\nsystem = 'nonholonomic'\n[state]\nx = '-1..1'\ny = '-1..1'\nz = '-1..1'\n\
             \"x'\" = '-1..1'\n\"y'\" = '-1..1'\n\"z'\" = '-1..1'\n[lagrangian]\n\
             kinetic = \"(x'² + y'² + z'²)/2\"\npotential = 'exp(x − y) + exp(y − z)'\n\
             [[claim]]\nintegral = \"x' + y' + z'\"\n{claims}"
        )
    };
    let verdicts = |claims: &str| -> Vec<Verdict> {
        absences(&chain(claims)).into_iter().map(|own| own.verdict).collect()
    };
    let degree_3 = "[[claim]]\nno-integral = { degree = 3 }\n";
    let both = format!("{DEGREE_2}{degree_3}");
    assert_eq!(verdicts(&both), [Verdict::Proved, Verdict::Refuted]);
    let third = "[[claim]]\nname = 'third'\n\
                 integral = \"x'*y'*z' − x'*exp(y − z) − z'*exp(x − y)\"\n";
    assert_eq!(verdicts(&format!("{third}{degree_3}")), [Verdict::Proved]);
    let free = plane("exp(x − y)", "[[claim]]\nno-integral = { degree = 1 }\n");
    assert_eq!(only(&free).verdict, Verdict::Refuted, "the momentum");
}
