//! Absence in systems with exponentials of positions.

use liouville::verdict::Verdict;

use super::{Dice, absences, only, plants};

fn plane(potential: &str, claims: &str) -> String {
    format!(
        "title = 't'\nsystem = 'nonholonomic'\n[parameters]\nk = '0.5..2'\n[state]\nx = '-1..1'\ny = '-1..1'\n\
         \"x'\" = '-1..1'\n\"y'\" = '-1..1'\n[lagrangian]\nkinetic = \"(x'² + y'²)/2\"\n\
         potential = '{potential}'\n{claims}"
    )
}

/// Rational cosine and sine of an angle.
fn turn(plant: usize) -> (String, String) {
    let (a, b, c) = [(3, 4, 5), (5, 12, 13), (8, 15, 17)][plant % 3];
    (format!("{a}/{c}"), format!("{b}/{c}"))
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
    let all = plants(5);
    for plant in 0..all {
        let (m, n) = turn(plant);
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
    assert!(refuted * 5 >= all * 2, "{refuted} of {all} plants are exhibited");
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

#[test]
fn functions_outside_of_coordinates_are_counted() {
    // Each is in the potential by its argument as well, so that no coordinate takes its place.
    let proved = [
        "exp(−(x + 3)² − 2*y²) + x² + y²",
        "x*exp(k*x) + y*exp(x) + y³",
        "x*exp(x) + y*exp(2*x) + exp(3*x − y)*y",
        "x*sin(x) + x*sin(2*x)*y",
        "exp(√((x + 3)² + y²))*y + x²",
        "(x + 3)*(y + 3)^k + ((x + 3)² + y²)^k",
        "exp(x)*cos(y) + x*y",
        "x*exp(sin(y)) + x²*cos(y)",
    ];
    for potential in proved {
        let report = only(&plane(potential, DEGREE_2));
        assert_eq!(report.verdict, Verdict::Proved, "{potential}: {:?}", report.evidence.reason);
    }
    // Arguments in an irrational ratio, or with a number between them; roots of squares; functions of
    // functions and of parameters alone.
    let open = [
        "x*y*cos(√2*y) + cos(y)",
        "x*exp(x + 1) + y*exp(x)",
        "x*exp(√(x²)) + y*exp(x)",
        "x*exp(y*exp(x))",
        "x*y*sin(k) + k*x³",
        "x*y*(y + 3)^x",
        "(x + 3)*(y + 3)^k + (2*y + 6)^k*x²",
    ];
    for potential in open {
        let report = only(&plane(potential, DEGREE_2));
        assert_eq!(report.verdict, Verdict::Undecided, "{potential}: {:?}", report.evidence);
    }
    let centre = |claims: &str| plane("exp(−k*√((x + 3)² + y²))/√((x + 3)² + y²)", claims);
    let momentum = "[[claim]]\nintegral = \"(x + 3)*y' − y*x'\"\n";
    assert_eq!(only(&centre(DEGREE_2)).verdict, Verdict::Refuted, "the angular momentum");
    let report = only(&centre(&format!("{momentum}{DEGREE_2}")));
    assert_eq!(report.verdict, Verdict::Proved, "{:?}", report.evidence.reason);
}

#[test]
fn planted_integrals_with_functions_of_positions_are_never_excluded() {
    let mut dice = Dice(23);
    let mut refuted = 0;
    let all = plants(10);
    for plant in 0..all {
        let (m, n) = turn(plant);
        let (a, b, r, s) = (dice.unit(), dice.unit(), dice.unit(), dice.unit());
        let (u, w) = (format!("({m}*x + {n}*y)"), format!("({m}*y − {n}*x)"));
        // Separable in turned coordinates, about a centre, and of constant force.
        let potential = match plant % 6 {
            0 => format!("({a})*{u}*exp(({r})*{u}) + ({b})*{w}*sin(({s})*{w})"),
            1 => format!("({a})*{u}*exp(({r})*{u}) + ({b})*{w}*exp(2*({r})*{u} − 2*({r})*{u})"),
            2 => format!("({a})*exp(−(x² + y²)) + ({b})*(x² + y²)*cos(({r})*(x² + y²))"),
            3 => format!("({a})*(3 + {u})^k + ({b})*(3 + {w})^(2*k + 1) + ({r})*(3 + {u})^(k + 2)"),
            4 => format!("({a})*exp(({r})*√(9 + {u}²)) + ({b})*{w}*exp(({s})*{w})"),
            _ => format!("({a})*{u}*exp(({r})*{u}) + ({b})*{u}*sin(({s})*{u})"),
        };
        let report = only(&plane(&potential, DEGREE_2));
        assert_ne!(report.verdict, Verdict::Proved, "an integral is there: {potential}");
        refuted += usize::from(report.verdict == Verdict::Refuted);
    }
    assert!(refuted * 5 >= all * 2, "{refuted} of {all} plants are exhibited");
}
