//! Limits of exponentials that are smaller than every power of the parameter, or larger, and of waves.

use super::level_parts::Draws;
use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

#[test]
fn exponentials_of_poles_tend_to_0_on_one_side() {
    let mut counts = [0; 2];
    for index in 0..16 {
        let mut draws = Draws(500 + index);
        let number = |draws: &mut Draws| draws.below(7) as i64 - 3;
        let (a, b) = (number(&mut draws), number(&mut draws));
        let (power, from_below) = (1 + draws.below(2), draws.below(2) == 0);
        let ranges = if from_below { "-1..0" } else { "0..1" };
        // a/ε² or a/ε, with a term of lower order in between.
        let exponent = format!("({a})/ε^{power} + ({b})*ln(|ε|) + x");
        let claims = [format!("y + ε*exp({exponent})"), format!("y + exp({exponent})/ε^3")];
        let claims: String = claims
            .iter()
            .map(|own| {
                format!(
                    "[[claim]]\nlimit = \"{own}\"\nparameter = \"ε\"\nequals = \"y\"\nexpect = \"open\"\n"
                )
            })
            .collect();
        let text = format!(
            "title = \"t\"\n[parameters]\n\"ε\" = \"{ranges}\"\n[state]\nx = \"-1..1\"\ny = \"-1..1\"\n\
             [field]\n\"x'\" = \"0\"\n\"y'\" = \"0\"\n{claims}"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let found = judge(&case, &Options::default()).expect("judged").claims;
        let sign = if from_below && power == 1 { -a } else { a };
        for (own, extra) in found.iter().zip([1, -3]) {
            // Without a pole the value is |ε|^b, up to a factor.
            let tends = sign < 0 || sign == 0 && b + extra > 0;
            match tends {
                true => assert_eq!(own.verdict, Verdict::Proved, "{exponent} on {ranges}: {own:?}"),
                false => assert!(own.verdict != Verdict::Proved, "{exponent} on {ranges}: {own:?}"),
            }
            counts[usize::from(tends)] += 1;
        }
    }
    assert!(counts.iter().all(|count| *count > 5), "{counts:?}");
}

/// Judges limits for ε → 0 in a range, with x in another.
fn verdicts(epsilon: &str, x: &str, claims: &[(String, String)]) -> Vec<Verdict> {
    let claims: String = claims
        .iter()
        .map(|(own, to)| {
            format!("[[claim]]\nlimit = \"{own}\"\nparameter = \"ε\"\nequals = \"{to}\"\nexpect = \"open\"\n")
        })
        .collect();
    let text = format!(
        "title = \"t\"\n[parameters]\n\"ε\" = \"{epsilon}\"\n[state]\nx = \"{x}\"\n[field]\n\"x'\" = \"0\"\n{claims}"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let found = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    found.claims.into_iter().map(|own| own.verdict).collect()
}

#[test]
fn limits_by_size_are_proved_and_their_twins_are_not() {
    let (above, both, below) = ("0..1", "-1..1", "-1..0");
    let wide = "-2..2";
    let proved = [
        ("tanh(x/ε)", "sign(x)", above, wide),
        ("tanh(x/ε)", "-sign(x)", below, wide),
        ("x*tanh(x/ε)", "|x|", above, wide),
        ("x*tanh(x/|ε|)", "|x|", both, wide),
        ("ε*sin(1/ε)", "0", both, wide),
        ("√ε*cos(x/ε^2)", "0", above, wide),
        ("x + ε*sin(exp(1/ε))", "x", above, wide),
        ("ε*ln(1 + exp(x/ε))", "(x + |x|)/2", above, wide),
        ("atan(exp(x/ε))", "atan(1)*(1 + sign(x))", above, wide),
        ("exp(1/ε)/exp(2/ε)", "0", above, wide),
        ("exp(x/ε)/(1 + exp(x/ε))", "0", above, "-2..-1"),
        ("1/(1 + exp(x/ε + 1/ε^2))", "0", above, wide),
        // 0⁰ comes out as 1, where ln 0 has no value.
        ("ε^ε", "1", above, wide),
        ("x + ε^(x*ε)", "x + 1", above, wide),
        ("|ε|^ε", "1", both, wide),
        ("ε^(1 + ε)", "0", above, wide),
        ("(ε*x)^ε", "1", above, "1/2..2"),
    ];
    for (own, to, epsilon, x) in proved {
        let found = verdicts(epsilon, x, &[(own.to_string(), to.to_string())]);
        assert_eq!(found, [Verdict::Proved], "{own} → {to} for ε in {epsilon}, x in {x}");
    }
    let refuted = [
        ("tanh(x/ε)", "sign(x)", below, wide),
        ("tanh(x/ε)", "1", above, wide),
        ("x*tanh(x/ε)", "x", above, wide),
        ("exp(-1/ε)", "0", both, wide),
        ("exp(x/ε)", "0", above, wide),
        ("ε*ln(1 + exp(x/ε))", "x", above, wide),
        ("exp(1/ε)/exp(2/ε)", "1", above, wide),
        ("ε^ε", "0", above, wide),
        ("ε^(1 + ε)", "1", above, wide),
    ];
    for (own, to, epsilon, x) in refuted {
        let found = verdicts(epsilon, x, &[(own.to_string(), to.to_string())]);
        assert_eq!(found, [Verdict::Refuted], "{own} → {to} for ε in {epsilon}, x in {x}");
    }
    let open = [
        ("sin(1/ε)", "0", above, wide),
        ("cos(1/ε)^2 + sin(1/ε)^2 + sin(1/ε)", "1", above, wide),
        ("1/(ε*sin(1/ε))", "0", above, wide),
        ("ε/(2 + sin(1/ε) + ε)", "1", above, wide),
        ("exp(sin(1/ε))", "1", above, wide),
        // At 0 < x the value is 1, and elsewhere tanh 0.
        ("tanh((x + |x|)/ε)", "1", above, wide),
        ("exp(-(x + |x|)/ε)", "0", above, wide),
        // No value for small ε.
        ("ε^ε", "1", below, wide),
        ("(ε - x)^ε", "1", above, "1/2..2"),
    ];
    for (own, to, epsilon, x) in open {
        let found = verdicts(epsilon, x, &[(own.to_string(), to.to_string())]);
        assert_ne!(found, [Verdict::Proved], "{own} → {to} for ε in {epsilon}, x in {x}");
    }
}

/// Σ a e^(p x/ε) with different p.
fn sum_of_exponentials(draws: &mut Draws) -> Vec<(i64, i64)> {
    let mut terms: Vec<(i64, i64)> = Vec::new();
    for _ in 0..1 + draws.below(3) {
        let power = draws.below(5) as i64 - 2;
        if terms.iter().all(|(_, own)| *own != power) {
            terms.push(([-2, -1, 1, 3][draws.below(4) as usize], power));
        }
    }
    terms
}

#[test]
fn quotients_of_exponentials_tend_to_what_the_largest_say() {
    let mut counts = [0; 3];
    for index in 0..40 {
        let mut draws = Draws(9000 + index);
        let [above, below] = [(); 2].map(|()| sum_of_exponentials(&mut draws));
        let text = |terms: &[(i64, i64)]| {
            let all: Vec<String> =
                terms.iter().map(|(a, p)| format!("({a})*exp(({p})*x/ε)")).collect();
            all.join(" + ")
        };
        let largest = |terms: &[(i64, i64)], sign: i64| {
            terms.iter().copied().max_by_key(|(_, power)| sign * power).expect("a term")
        };
        // The limit for x of each sign, as a quotient of whole numbers.
        let tends = |sign: i64| {
            let ((a, p), (b, q)) = (largest(&above, sign), largest(&below, sign));
            match (sign * (p - q)).signum() {
                0 => Some((a, b)),
                -1 => Some((0, 1)),
                _ => None,
            }
        };
        let own = format!("({})/({})", text(&above), text(&below));
        let of = |(a, b): (i64, i64)| format!("({a})/({b})");
        let to = |(positive, negative): ((i64, i64), (i64, i64))| {
            format!("({})*(1 + sign(x))/2 + ({})*(1 - sign(x))/2", of(positive), of(negative))
        };
        match (tends(1), tends(-1)) {
            (Some(positive), Some(negative)) => {
                let claims = [
                    (own.clone(), to((positive, negative))),
                    (own.clone(), to((positive, (negative.0 + 1, negative.1)))),
                ];
                let found = verdicts("0..1", "-2..2", &claims);
                assert_eq!(found, [Verdict::Proved, Verdict::Refuted], "{claims:?}");
                counts[0] += 1;
                counts[1] += usize::from(positive.0 * negative.1 != negative.0 * positive.1);
            }
            (one, other) => {
                let known = one.or(other).unwrap_or((0, 1));
                let found = verdicts("0..1", "-2..2", &[(own.clone(), of(known))]);
                assert_ne!(found, [Verdict::Proved], "{own} → {}", of(known));
                counts[2] += 1;
            }
        }
    }
    assert!(counts.iter().all(|count| *count > 4), "{counts:?}");
}

#[test]
fn limits_do_not_depend_on_antiderivatives_beside_them() {
    let limit = "[[claim]]\nlimit = 'sin(eps*x)/eps'\nequals = 'x'\nparameter = 'eps'\n";
    let other = "[[claim]]\nidentity = '∫(exp(x),x) = ∫(exp(x),x)'\n";
    for claims in [format!("{other}{limit}"), format!("{limit}{other}")] {
        let text = format!(
            "title = 't'\n[parameters]\neps = '0..1'\n[state]\nx = '-1..1'\n[field]\nx = '0'\n{claims}"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let found = judge(&case, &Options::default()).expect("judged").claims;
        assert!(found.iter().all(|own| own.verdict == Verdict::Proved), "{found:?}");
    }
}
