//! Equations of a level in which a factor is repeated: what is said of them is what is said of the same level with
//! each factor once.

use super::level_parts::{Draws, Polynomial};
use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

/// Ranges of the variables.
const STATE: &str = "x = \"-2..2\"\ny = \"-2..2\"\nz = \"-2..2\"\n\
                     w = \"-2..2\"\n";

/// Judges claims on a level, or says why the file is refused.
fn judged(levels: &[String], field: &[String; 3], claims: &[&str]) -> Result<Vec<Verdict>, String> {
    let claims: String =
        claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = \"open\"\n")).collect();
    let [x, y, z] = field;
    let levels: Vec<String> = levels.iter().map(|own| format!("\"{own} = 0\"")).collect();
    let text = format!(
        "title = \"t\"\n[state]\n{STATE}[field]\n\"x'\" = \"{x}\"\n\"y'\" = \"{y}\"\n\"z'\" = \"{z}\"\n\"w'\" = \"0\"\n\
         [level]\nequations = [{}]\n{claims}",
        levels.join(", ")
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = judge(&case, &Options::default()).map_err(|error| error.to_string())?;
    Ok(report.claims.into_iter().map(|claim| claim.verdict).collect())
}

fn at_rest() -> [String; 3] {
    [0; 3].map(|rate| rate.to_string())
}

/// A line a x + b y + c = 0 with a, b ≠ 0.
fn line(draws: &mut Draws) -> (Polynomial, [i64; 3]) {
    let sign = |draws: &mut Draws| [-2, -1, 1, 2][draws.below(4) as usize];
    let own = [sign(draws), sign(draws), draws.below(3) as i64 - 1];
    let [a, b, c] = own;
    (Polynomial(vec![(a, [1, 0, 0, 0]), (b, [0, 1, 0, 0]), (c, [0; 4])]), own)
}

#[test]
fn repeated_factors_say_what_simple_ones_do() {
    let (mut compared, mut decided) = (0, 0);
    for index in 0..6 {
        let mut draws = Draws(40 + index);
        let ((p, [a, b, _]), (q, [c, d, _])) = (line(&mut draws), line(&mut draws));
        if a * d == b * c {
            continue;
        }
        let [one, two] = [&p, &q].map(|own| format!("({})", own.text()));
        // Along the lines p q = 0, and more slowly where they meet.
        let field = [
            format!("({b})*{two} + ({d})*{one}"),
            format!("−(({a})*{two} + ({c})*{one})"),
            "x".to_string(),
        ];
        let claims = [
            format!("identity = \"{one}*{two}*z = 0\""),
            format!("identity = \"{one} = 0\""),
            format!("integral = \"{one}*{two}\""),
            "integral = \"x\"".to_string(),
            "independent = [\"x\", \"z\"]".to_string(),
            "independent = [\"x\", \"y\"]".to_string(),
        ];
        let claims: Vec<&str> = claims.iter().map(String::as_str).collect();
        let simple = judged(&[format!("{one}*{two}")], &field, &claims);
        for level in [
            format!("{one}^2*{two}"),
            format!("{one}*({two}^3*{one})/(1 + z^2)"),
            format!("|{one}|*{two}"),
            p.times(&p).times(&q).text(),
            format!("({})*{two}", p.times(&q).text()),
        ] {
            let found = judged(std::slice::from_ref(&level), &field, &claims);
            assert_eq!(found, simple, "{level}");
            compared += 1;
        }
        decided += simple.expect("the motion stays").len();
    }
    assert!(compared > 15 && decided > 15, "{compared} levels and {decided} verdicts");
}

#[test]
fn sums_of_squares_say_what_their_roots_do() {
    for index in 0..6 {
        let mut draws = Draws(90 + index);
        let ((p, [a, b, _]), (q, [c, d, _])) = (line(&mut draws), line(&mut draws));
        if a * d == b * c {
            continue;
        }
        let mut field = at_rest();
        field[2] = "x + 1/3".to_string();
        let claims = [
            "integral = \"x\"",
            "integral = \"z\"",
            "identity = \"x = y\"",
            "independent = [\"z\"]",
        ];
        let simple = judged(&[p.text(), q.text()], &field, &claims);
        let [one, two] = [&p, &q].map(|own| own.text());
        let sum = format!("({one})^2 + 3*({two})^2");
        assert_eq!(judged(std::slice::from_ref(&sum), &field, &claims), simple, "{sum}");
        let sum = Polynomial([p.times(&p).0, q.times(&q).0].concat()).text();
        assert_eq!(judged(std::slice::from_ref(&sum), &field, &claims), simple, "{sum}");
    }
}

#[test]
fn squares_of_half_angles_are_taken_once() {
    let rate = ["sin(x)", "x", "y"].map(str::to_string);
    let claims = ["identity = \"x = 0\"", "integral = \"y\"", "integral = \"z\""];
    let simple = judged(&["x".to_string()], &rate, &claims).expect("the motion stays");
    assert_eq!(simple, [Verdict::Proved, Verdict::Proved, Verdict::Refuted]);
    for level in
        ["1 − cos(x)", "sin(x)^2", "(1 − cos(x))*(1 + y^2)^2", "cosh(x) − 1", "(exp(x) − 1)^3"]
    {
        assert_eq!(judged(&[level.to_string()], &rate, &claims).as_ref(), Ok(&simple), "{level}");
    }
    // Only a number beside the sine makes a square.
    for (level, claim) in [
        ("y − sin(x)", "y = sin(x)"),
        ("y − cos(x)", "y = cos(x)"),
        ("1/2 − sin(x)", "sin(x) = 1/2"),
    ] {
        let found = judged(&[level.to_string()], &at_rest(), &[&format!("identity = \"{claim}\"")]);
        assert!(matches!(found.as_deref(), Ok([Verdict::Proved | Verdict::Confirmed])), "{level}");
    }
    let claims = ["identity = \"sin(x) = 1\"", "identity = \"x = y\""];
    let found = judged(&["1 − sin(x)".to_string()], &at_rest(), &claims);
    assert_eq!(found, Ok(vec![Verdict::Proved, Verdict::Refuted]));
}

#[test]
fn what_has_no_value_elsewhere_stays() {
    // The logarithm cancels, and has a value for y > 0 alone; a root ends where its square does not.
    for level in ["(x + ln(y) − ln(y))^2", "(x + √y − √y)^2*(x − 3)", "√y*√y*x^2*(x^2 + 1)"]
    {
        let found = judged(&[level.to_string()], &at_rest(), &["identity = \"|y| = y\""]);
        let is_wrong = |verdicts: &Vec<Verdict>| verdicts.contains(&Verdict::Refuted);
        assert!(!found.as_ref().is_ok_and(is_wrong), "{level}: {found:?}");
    }
    let found = judged(&["(√x − y)^2".to_string()], &at_rest(), &["identity = \"|y| = y\""]);
    assert_eq!(found, Ok(vec![Verdict::Proved]), "y = √x");
    // x − 1 is 0 where the first equation has no value.
    let found =
        judged(&["(x − 1)^2*(x − 2)/(x − 1)".to_string()], &at_rest(), &["identity = \"x = 2\""]);
    assert!(found.as_ref().is_ok_and(|own| own[0] != Verdict::Refuted) || found.is_err());
}

#[test]
fn equations_that_follow_from_others_say_nothing_more() {
    let parts = ["exp(x)", "sin(y)", "√(z + 3)", "x*y", "y^2*exp(x)"];
    for index in 0..8 {
        let mut draws = Draws(150 + index);
        let mut number = || [-2, -1, 1, 3][draws.below(4) as usize];
        let [a, b, c, d] = [(); 4].map(|()| number());
        let part = |k: u64| parts[((index + k) % 5) as usize];
        let f = format!("({a})*{} + ({b})*z − 1/3", part(0));
        let g = format!("({c})*{} + y", part(1));
        let both = [f.clone(), g.clone()];
        let claims = ["identity = \"x = 7\"", "identity = \"y^2*z = z*y*y\""];
        let simple = judged(&both, &at_rest(), &claims).ok();
        for third in [
            format!("({d})*({f}) − 3*({g})"),
            format!("({})*({g})", part(2)),
            format!("({d})*({f}) − 3*({g}) + √(z + 3) − √(z + 3)"),
        ] {
            let has_root = both.iter().any(|own| own.contains('√'));
            if third.contains('√') && !has_root {
                continue;
            }
            let levels = [f.clone(), g.clone(), third.clone()];
            assert_eq!(judged(&levels, &at_rest(), &claims).ok(), simple, "{levels:?}");
        }
    }
}
