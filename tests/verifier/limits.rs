//! Limits of exponentials that are smaller than every power of the parameter, or larger.

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
