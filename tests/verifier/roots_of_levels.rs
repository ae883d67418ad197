//! Levels that fall apart over real roots of numbers, and with powers of one exponential.

use super::level_parts::Draws;
use liouville::case::Case;
use liouville::verdict::{ClaimReport, Options, Verdict, judge};

fn judged(level: &str, claims: &[String]) -> Result<Vec<ClaimReport>, String> {
    let claims: String =
        claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = \"open\"\n")).collect();
    let text = format!(
        "title = \"t\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\nz = \"-2..2\"\n\
         [field]\n\"x'\" = \"0\"\n\"y'\" = \"0\"\n\"z'\" = \"0\"\n\
         [level]\nequations = [\"{level} = 0\"]\n{claims}"
    );
    let case = Case::parse(&text, &[]).map_err(|error| format!("{error}\n{text}"))?;
    judge(&case, &Options::default())
        .map(|report| report.claims)
        .map_err(|e| format!("{e}\n{text}"))
}

fn verdicts(level: &str, claims: &[String]) -> Vec<Verdict> {
    let found = judged(level, claims).unwrap_or_else(|error| panic!("{error}"));
    found.iter().map(|own| own.verdict).collect()
}

#[test]
fn odd_powers_have_one_real_root_and_even_ones_two() {
    for index in 0..16 {
        let mut draws = Draws(40 + index);
        let n = 3 + draws.below(4);
        let (k, l) = (1 + draws.below(4), 2 + draws.below(6));
        let sign = if n % 2 == 1 && draws.below(2) == 0 { "-" } else { "" };
        let definite = ["1", "(y^2 + 1)", "(x^2 − x*y + y^2 + 3)"][draws.below(3) as usize];
        let level = format!("({k}*x^{n} − ({sign}{l})*z^{n})*{definite}");
        let root = format!("{sign}({l}/{k})^(1/{n})*z");
        let claims = [
            format!("identity = \"x = {root}\""),
            format!("identity = \"{k}*x^{n} = ({sign}{l})*z^{n}\""),
            format!("identity = \"x = 11/10*({root})\""),
            format!("identity = \"|x| = |{root}|\""),
        ];
        let found = verdicts(&level, &claims);
        let own = if n % 2 == 1 { Verdict::Proved } else { Verdict::Refuted };
        assert_eq!(found[0], own, "{level}: {}", claims[0]);
        assert_eq!(found[1], Verdict::Proved, "{level}: {}", claims[1]);
        assert_eq!(found[2], Verdict::Refuted, "{level}: {}", claims[2]);
        assert!(matches!(found[3], Verdict::Proved | Verdict::Confirmed), "{level}: {found:?}");
    }
}

#[test]
fn powers_of_one_exponential_fall_apart() {
    for index in 0..12 {
        let mut draws = Draws(90 + index);
        let mut power = || [-2, -1, 1, 2][draws.below(4) as usize];
        let (p, q) = (power(), power());
        let (a, b) = (1 + draws.below(3), 1 + draws.below(3));
        let exponential = |factor: i64| format!("exp({factor}*x)");
        // (y − a e^(px)) (y − b e^(qx))
        let level = format!(
            "y^2 − {a}*y*{} − {b}*y*{} + {}*{}",
            exponential(p),
            exponential(q),
            a * b,
            exponential(p + q)
        );
        let claims = [
            format!("identity = \"y = {a}*{}\"", exponential(p)),
            format!("identity = \"y = {b}*{}\"", exponential(q)),
            format!("identity = \"(y − {a}*{})*(y − {b}*{}) = 0\"", exponential(p), exponential(q)),
            "identity = \"y = |y|\"".to_string(),
        ];
        let found = verdicts(&level, &claims);
        let own = if (p, a) == (q, b) { Verdict::Proved } else { Verdict::Refuted };
        assert_eq!(found[..2], [own, own], "{level}");
        assert_eq!(found[2], Verdict::Proved, "{level}");
        assert!(matches!(found[3], Verdict::Proved | Verdict::Confirmed), "{level}: {found:?}");
    }
}

#[test]
fn exponentials_of_sums_are_products() {
    let own = |claims: [&str; 2]| claims.map(|claim| format!("identity = \"{claim}\""));
    let found = verdicts("exp(x + y) − exp(x) − exp(y) + 1", &own(["x*y = 0", "x = 0"]));
    assert_eq!(found, [Verdict::Proved, Verdict::Refuted], "(e^x − 1)(e^y − 1)");
    let found = verdicts("2*exp(x − y) − exp(y + z)", &own(["2*y + z = x + log(2)", "x = 0"]));
    assert_eq!(found, [Verdict::Proved, Verdict::Refuted], "2e^(x − y) = e^(y + z)");
    let level = "exp(3*x − y) − 2*exp(x) − z*exp(2*x − y) + 2*z";
    let claims = own(["(z − exp(x))*(2*x − y − log(2)) = 0", "z = exp(x)"]);
    assert_eq!(
        verdicts(level, &claims),
        [Verdict::Proved, Verdict::Refuted],
        "(e^x − z)(e^(2x − y) − 2)"
    );
}

#[test]
fn levels_with_a_factor_that_is_nowhere_0_have_states() {
    let level = "(x^3 − 3*x + 1)*(y^2 + 1)";
    let claims = ["x^3 = 3*x − 1", "x = |x|"].map(|own| format!("identity = \"{own}\""));
    let found = verdicts(level, &claims);
    assert!(matches!(found[0], Verdict::Proved | Verdict::Confirmed), "{found:?}");
    assert_eq!(found[1], Verdict::Refuted, "x = −1.879…");
    // The line x = y = 0 is a part of lower dimension.
    let level = "(x^2 − 2*x*y + 2*y^2)*(x^3 − 2*z^3)";
    let claims = ["x*(x^3 − 2*z^3) = 0", "x^3 = 2*z^3"].map(|own| format!("identity = \"{own}\""));
    assert_eq!(verdicts(level, &claims), [Verdict::Proved, Verdict::Refuted]);
}

#[test]
fn sums_and_differences_of_products_are_their_products() {
    let (f, g) = ("x*(y − z)*(x + 1)*(y + z)", "y*(x − z)*(x + z)*(y − 1)");
    let text = |one: &str, two: &str| format!("{f} + {one}*{g} = 0\", \"{f} − {two}*{g}");
    let claims = [f, g].map(|own| format!("identity = \"{own} = 0\""));
    for (one, two) in [("1", "1"), ("2", "1/3")] {
        let found = verdicts(&text(one, two), &claims);
        assert_eq!(found, [Verdict::Proved, Verdict::Proved]);
    }
}

#[test]
fn zeros_at_which_another_equation_has_no_value_are_left_out() {
    for k in 1..6 {
        // One of the zeros of the second equation is a pole of the first.
        let level = format!("x/(y − {k}/4) = 0\", \"(y − {k}/4)*(y + {k}/8)*(1 + z^2)");
        let claims = [format!("y = −{k}/8"), format!("y = {k}/4"), "z = 0".to_string()];
        let claims = claims.map(|own| format!("identity = \"{own}\""));
        let found = verdicts(&level, &claims);
        assert_eq!(found, [Verdict::Proved, Verdict::Refuted, Verdict::Refuted], "{level}");
        let level = format!("x/(y − {k}/4) = 0\", \"y^2 − {k}/8*y − {}/32", k * k);
        assert_eq!(
            verdicts(&level, &claims),
            [Verdict::Proved, Verdict::Refuted, Verdict::Refuted]
        );
    }
}
