//! Constraints of a nonholonomic system with repeated factors: what is said of them is what is said of the simple ones.

use liouville::case::Case;
use liouville::verdict::{JudgeError, Options, Verdict, judge};

use super::super::level_parts::Draws;

/// The file of a particle with constraints.
fn text(constraints: &[String], claims: &[&str]) -> String {
    let claims: String =
        claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = \"open\"\n")).collect();
    let constraints: Vec<String> = constraints.iter().map(|own| format!("\"{own}\"")).collect();
    format!(
        "title = \"t\"\nsystem = \"nonholonomic\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\nz = \"-2..2\"\n\
         \"x'\" = \"-2..2\"\n\"y'\" = \"-2..2\"\n\"z'\" = \"-2..2\"\n[lagrangian]\n\
         kinetic = \"(x'^2 + y'^2 + 2*z'^2)/2\"\npotential = \"x*z\"\nconstraints = [{}]\n{claims}",
        constraints.join(", ")
    )
}

/// Judges claims on such a particle.
fn judged(constraints: &[String], claims: &[&str]) -> Result<Vec<Verdict>, JudgeError> {
    let text = text(constraints, claims);
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default())
        .map(|report| report.claims.into_iter().map(|own| own.verdict).collect())
}

const CLAIMS: [&str; 5] = [
    "integral = \"energy\"",
    "integral = \"y'\"",
    "identity = \"x' = y*z'\"",
    "identity = \"x = 2*y\"",
    "density = \"1/√(2 + y^2)\"",
];

fn one(constraint: &str) -> Vec<String> {
    vec![constraint.to_string()]
}

#[test]
fn repeated_constraints_say_what_simple_ones_do() {
    let mut proved = 0;
    for index in 0..3 {
        let mut draws = Draws(70 + index);
        let mut number = || [-2, -1, 1, 3][draws.below(4) as usize];
        let (a, b) = (number(), number());
        for simple in [format!("x' - ({a})*y*z'"), format!("x' - ({a})*z*y' - ({b})*z'")] {
            let expected = judged(&one(&format!("{simple} = 0")), &CLAIMS).expect("a motion");
            proved += expected.iter().filter(|own| **own == Verdict::Proved).count();
            for repeated in [
                format!("({simple})^2 = 0"),
                format!("({b})*({simple})^3*(1 + y^2) = 0"),
                format!("|{simple}| = 0"),
            ] {
                let found = judged(&one(&repeated), &CLAIMS);
                assert_eq!(found.as_ref().ok(), Some(&expected), "{repeated}: {found:?}");
            }
        }
    }
    assert!(proved >= 9, "{proved}");
}

#[test]
fn sums_of_squares_are_constraints_for_each() {
    let [one, two] = ["x' - y*z'", "y' - 2*x'"];
    let simple = [format!("{one} = 0"), format!("{two} = 0")];
    let expected = judged(&simple, &CLAIMS).expect("a motion");
    assert!(expected.contains(&Verdict::Proved));
    let found = judged(&[format!("({one})^2 + 3*({two})^2 = 0")], &CLAIMS).expect("a motion");
    assert_eq!(found, expected);
}

#[test]
fn repeated_constraints_on_coordinates_say_what_simple_ones_do() {
    let mut proved = 0;
    for simple in ["x - 2*y", "x - y*z", "x^2 + y^2 - 1", "(x - y)*(x - z)", "exp(x) - y"] {
        let expected = judged(&one(&format!("{simple} = 0")), &CLAIMS).expect("a motion");
        proved += expected.iter().filter(|own| **own == Verdict::Proved).count();
        for repeated in [
            format!("({simple})^2 = 0"),
            format!("-3*({simple})^3*(1 + y^2) = 0"),
            format!("|{simple}| = 0"),
        ] {
            let found = judged(&one(&repeated), &CLAIMS);
            assert_eq!(found.as_ref().ok(), Some(&expected), "{repeated}: {found:?}");
        }
    }
    assert!(proved >= 6, "{proved}");
    // A factor that is repeated has a part of its own.
    let claims = ["identity = \"x = z\"", "identity = \"(x - y)*(x - z) = 0\""];
    let found = judged(&one("(x - y)^2*(x - z) = 0"), &claims).expect("a motion");
    assert_eq!(found, [Verdict::Refuted, Verdict::Proved]);
    let simple = ["x - y = 0".to_string(), "z - 2*y = 0".to_string()];
    let expected = judged(&simple, &CLAIMS).expect("a motion");
    let found = judged(&one("(x - y)^2 + 3*(z - 2*y)^2 = 0"), &CLAIMS).expect("a motion");
    assert_eq!(found, expected);
    // One of the squares may be that of a velocity.
    let simple = ["x' = 0".to_string(), "y = 0".to_string()];
    let expected = judged(&simple, &CLAIMS).expect("a motion");
    let found = judged(&one("x'^2 + y^2 = 0"), &CLAIMS).expect("a motion");
    assert_eq!(found, expected);
}

#[test]
fn factors_without_velocities_are_remarked() {
    let is_remarked = |constraint: &str| {
        let text = text(&one(constraint), &["identity = \"x' = x'\""]);
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let report = judge(&case, &Options::default()).expect("a motion");
        let all = report.warnings.iter().chain(&report.remarks);
        all.into_iter().any(|own| own.contains("a factor without velocities"))
    };
    assert!(is_remarked("(x - y)*x' = 0"));
    assert!(is_remarked("x*(x' - y*z') = 0"));
    for simple in ["x' = 0", "(1 + y^2)*x' = 0", "exp(x)*(x' - y*z') = 0", "x - y = 0"] {
        assert!(!is_remarked(simple), "{simple}");
    }
}

#[test]
fn a_constraint_without_slopes_is_named() {
    for constraint in ["atan(x^2 + y^2) = 0", "ln(1 + x^2 + y^2) = 0"] {
        let error = judged(&one(constraint), &CLAIMS).expect_err("no slope");
        assert!(matches!(error, JudgeError::Slopeless(..)), "{error}");
        let rate = format!("({})' = 0", constraint.trim_end_matches(" = 0"));
        assert!(error.to_string().contains(&rate), "{error}");
    }
}
