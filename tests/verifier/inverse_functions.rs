//! Functions that undo each other, and signs of differences of increasing functions.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

use super::level_parts::Draws;

/// Judges identities with x and y in ranges.
fn judged(x: &str, y: &str, identities: &[String]) -> Vec<Verdict> {
    let claims: String = identities
        .iter()
        .map(|own| format!("[[claim]]\nidentity = \"{own}\"\nexpect = \"open\"\n"))
        .collect();
    let text = format!(
        "title = \"t\"\n[state]\nx = \"{x}\"\ny = \"{y}\"\n[field]\n\"x'\" = \"0\"\n\"y'\" = \"0\"\n{claims}"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let found = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    found.claims.into_iter().map(|own| own.verdict).collect()
}

#[test]
fn functions_undo_each_other_where_their_ranges_say_so() {
    let (near, wide) = ("-1.5..1.5", "2..4");
    let cases = [
        (near, "asinh(sinh(x))", "x", "-x"),
        (near, "asinh(-sinh(2*x))", "-2*x", "2*x"),
        (near, "acosh(cosh(x))", "|x|", "x"),
        (near, "atanh(tanh(x))", "x", "2*x"),
        (near, "ln(exp(x))", "x", "|x|"),
        (near, "atan(tan(x))", "x", "-x"),
        (near, "asin(sin(x))", "x", "2*x"),
        (near, "acos(cos(x))", "|x|", "x"),
        (near, "atan2(sin(x), cos(x))", "x", "|x|"),
        (near, "sqrt(1 - sin(x)^2)", "cos(x)", "-cos(x)"),
        (near, "sqrt(1 + sinh(x)^2)", "cosh(x)", "-cosh(x)"),
        ("0.1..3", "atan(cos(x)/sin(x))", "pi/2 - x", "x - pi/2"),
        (wide, "atan(tan(x))", "x - pi", "x"),
        (wide, "asin(sin(x))", "pi - x", "x"),
        ("-6..-5", "atan(tan(x))", "x + 2*pi", "x + pi"),
        ("-2..-1", "sqrt(x^4 + 2*x^3 + x^2)", "x^2 + x", "-x^2 - x"),
        ("1..3", "sqrt((x^2 - x)^2)", "x^2 - x", "x - x^2"),
        ("0..1", "sqrt((x^2 - x)^2)", "x - x^2", "x^2 - x"),
    ];
    for (x, own, value, other) in cases {
        let claims = [format!("{own} = {value}"), format!("{own} = {other}")];
        let found = judged(x, "-1..1", &claims);
        assert_eq!(found, [Verdict::Proved, Verdict::Refuted], "{own} on {x}");
    }
    // Beyond the ends the same is false.
    for (x, own, value) in [
        ("-2..2", "atan(tan(x))", "x"),
        ("-2..2", "asin(sin(x))", "x"),
        ("-4..4", "acos(cos(x))", "|x|"),
        ("-2..2", "sqrt(x^4 + 2*x^3 + x^2)", "x^2 + x"),
        ("-2..2", "sqrt(1 - sin(x)^2)", "cos(x)"),
    ] {
        let found = judged(x, "-1..1", &[format!("{own} = {value}")]);
        assert_eq!(found, [Verdict::Refuted], "{own} on {x}");
    }
}

#[test]
fn differences_of_increasing_functions_have_the_sign_of_the_difference() {
    let (mut increasing, mut others) = (0, 0);
    for index in 0..24 {
        let mut draws = Draws(4200 + index);
        let mut text = String::new();
        let (mut signs, count) = (Vec::new(), 1 + draws.below(3));
        for _ in 0..count {
            let sign = if draws.below(4) == 0 { -1 } else { 1 };
            let factor = sign * (1 + draws.below(3) as i64);
            // With the sign of its slope; x² has none.
            let (function, slope) = [
                ("v^3", 1),
                ("v^5", 1),
                ("v", 1),
                ("exp(v)", 1),
                ("exp(-v)", -1),
                ("sinh(v)", 1),
                ("atan(v)", 1),
                ("v^2", 0),
            ][draws.below(8) as usize];
            text += &format!(" + ({factor})*{function}");
            signs.push(sign * slope);
        }
        let text = text.trim_start_matches(" + ");
        let at = |name: &str| text.replace('v', name);
        let claims = ["x - y", "y - x"]
            .map(|difference| format!("sign({} - ({})) = sign({difference})", at("x"), at("y")));
        let found = judged("-2..2", "-2..2", &claims);
        let one = signs.iter().all(|sign| *sign == 1);
        let two = signs.iter().all(|sign| *sign == -1);
        for (is_true, verdict) in [one, two].into_iter().zip(found) {
            match is_true {
                true => assert_eq!(verdict, Verdict::Proved, "{claims:?}"),
                // Terms with other slopes may still add up to an increasing function.
                false if one || two => assert_eq!(verdict, Verdict::Refuted, "{claims:?}"),
                false => others += usize::from(verdict != Verdict::Proved),
            }
        }
        increasing += usize::from(one || two);
    }
    assert!(increasing >= 6 && others >= 6, "{increasing} {others}");
    let sums = [
        ("sign(x^3 + y^3) = sign(x + y)", true),
        ("sign(x^3 - 8*y^3) = sign(x - 2*y)", true),
        ("|x^3 - y^3| = |x - y|*(x^2 + x*y + y^2)", true),
        ("sign(x^3 - x*y^2 + 2*x^2*y - 2*y^3) = sign((x - y)*(x + y)*(x + 2*y))", true),
        ("sign(x^3 + y^3) = sign(x - y)", false),
        ("sign(x^3 - y^2) = sign(x - y)", false),
        ("sign(x^3 - 8*y^3) = sign(x - 3*y)", false),
        ("sign(x^2*y^3 - y) = sign(x - y)", false),
        ("sign(exp(x) + exp(y)) = sign(x + y)", false),
    ];
    for (own, is_true) in sums {
        let expected = if is_true { Verdict::Proved } else { Verdict::Refuted };
        assert_eq!(judged("-2..2", "-2..2", &[own.to_string()]), [expected], "{own}");
    }
}

#[test]
fn arctangents_are_sums_of_others_where_their_ranges_say_so() {
    let (low, wide) = ("0.1..3", "-3..3");
    let cases = [
        (wide, "atan((x + y) - y)", "atan(x)", "-atan(x)"),
        (wide, "atan((x + 1)*(x - 1))", "atan(x^2 - 1)", "atan(1 - x^2)"),
        (wide, "atan(sin(x + 2*pi))", "atan(sin(x))", "atan(sin(2*x))"),
        (wide, "atan(y + 2*atan((x + y) - y))", "atan(y + 2*atan(x))", "atan(y + atan(x))"),
        (
            wide,
            "atan(x^2/sqrt(1 + x^2) - sqrt(1 + x^2))",
            "-atan(1/sqrt(1 + x^2))",
            "atan(1/sqrt(1 + x^2))",
        ),
        ("-0.9..0.9", "asin((x + y) - y)", "asin(x)", "acos(x)"),
        ("-0.9..0.9", "asin(x) + acos(x)", "pi/2", "pi"),
        (low, "atan2(y*x, x^2)", "atan2(y, x)", "atan2(x, y)"),
        (low, "atan(x) + atan(1/x)", "pi/2", "-pi/2"),
        ("-3..-0.1", "atan(x) + atan(1/x)", "-pi/2", "pi/2"),
        ("-0.9..0.9", "2*atan(x)", "atan(2*x/(1 - x^2))", "atan(2*x/(1 - x^2)) + pi"),
        ("1.1..3", "2*atan(x)", "atan(2*x/(1 - x^2)) + pi", "atan(2*x/(1 - x^2))"),
        ("-3..0.9", "atan((1 + x)/(1 - x))", "atan(x) + pi/4", "atan(x) - pi/4"),
        ("1.1..3", "atan((1 + x)/(1 - x))", "atan(x) - 3*pi/4", "atan(x) + pi/4"),
        (low, "atan(x) - atan(y)", "atan((x - y)/(1 + x*y))", "atan((x - y)/(1 - x*y))"),
        (wide, "atan(1/2) + atan(1/3)", "pi/4", "pi/3"),
        (wide, "atan(2) + atan(3)", "3*pi/4", "-pi/4"),
    ];
    for (x, own, value, other) in cases {
        let y = if x == low { low } else { "-1..1" };
        let claims = [format!("{own} = {value}"), format!("{own} = {other}")];
        let found = judged(x, y, &claims);
        assert_eq!(found, [Verdict::Proved, Verdict::Refuted], "{own} on {x}");
    }
    // Beyond these ranges the same is false.
    for (x, own, value) in [
        (wide, "atan(x) + atan(1/x)", "pi/2"),
        (wide, "2*atan(x)", "atan(2*x/(1 - x^2))"),
        (wide, "atan((1 + x)/(1 - x))", "atan(x) + pi/4"),
        (wide, "atan(x) - atan(2*x - 4)", "atan((4 - x)/(1 + x*(2*x - 4)))"),
        (wide, "atan2(y*x, x^2)", "atan2(y, x)"),
    ] {
        let found = judged(x, "-1..1", &[format!("{own} = {value}")]);
        assert_eq!(found, [Verdict::Refuted], "{own} on {x}");
    }
}

#[test]
fn arguments_of_functions_are_compared_by_the_functions_inside_of_them() {
    let cases = [
        ("exp(exp(y)^2)", "exp(exp(2*y))", "exp(exp(3*y))"),
        ("exp(-(x*exp(y))^2)", "exp(-x^2*exp(2*y))", "exp(-x*exp(2*y))"),
        ("sin((x*exp(y))^2)", "sin(x^2*exp(2*y))", "cos(x^2*exp(2*y))"),
        ("cos(exp(y)*exp(x))", "cos(exp(x + y))", "cos(exp(x - y))"),
        ("exp(sin(2*y))", "exp(2*sin(y)*cos(y))", "exp(sin(y)*cos(y))"),
        ("exp(sin(y)^2)*exp(cos(y)^2)", "e", "1"),
        ("exp(sin(exp(y)^2))", "exp(sin(exp(2*y)))", "exp(sin(exp(y)))"),
        ("atan(exp(2*y))", "atan(exp(y)^2)", "atan(exp(y))"),
        ("exp(sqrt(3)*(sqrt(3)*x + y))", "exp(3*x + sqrt(3)*y)", "exp(3*x - sqrt(3)*y)"),
        ("cos(sqrt(3)*(sqrt(3)*x + y))", "cos(3*x + sqrt(3)*y)", "cos(3*x - sqrt(3)*y)"),
        ("exp(sqrt(2)*x)*exp(sqrt(3)*x)", "exp((sqrt(2) + sqrt(3))*x)", "exp(sqrt(6)*x)"),
        ("exp(sqrt(6)*x)", "exp(sqrt(2)*sqrt(3)*x)", "exp(-sqrt(2)*sqrt(3)*x)"),
    ];
    for (own, value, other) in cases {
        let claims = [format!("{own} = {value}"), format!("{own} = {other}")];
        assert_eq!(
            judged("0.1..2", "-1..1", &claims),
            [Verdict::Proved, Verdict::Refuted],
            "{own}"
        );
    }
}
