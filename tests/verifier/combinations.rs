//! Claims that follow from the equations of a level, each with a multiplier.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn judged(text: &str) -> Vec<Verdict> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    report.claims.into_iter().map(|claim| claim.verdict).collect()
}

fn with_claims(text: &str, claims: &[&str]) -> String {
    let claims = claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = \"open\"\n"));
    format!("title = \"t\"\n{text}{}", claims.collect::<String>())
}

#[test]
fn rods_may_have_lengths_of_a_range() {
    let text = "system = \"nonholonomic\"\n[parameters]\na = \"0.5..1\"\nb = \"1..2\"\n\
         [state]\np = \"vector(2, -1..1)\"\nq = \"vector(2, -2..2)\"\n\
         \"p'\" = \"vector(2, -1..1)\"\n\"q'\" = \"vector(2, -1..1)\"\n\
         [lagrangian]\nkinetic = \"(p',p')/2 + (q',q')/2\"\npotential = \"p2 + q2\"\n\
         constraints = [\"(p,p) = a²\", \"|q − p|² = b²\"]\n";
    let claims = ["integral = \"energy\"", "integral = \"energy + p1\""];
    assert_eq!(judged(&with_claims(text, &claims)), [Verdict::Proved, Verdict::Refuted]);
}

#[test]
fn what_follows_from_closed_rods_is_proved() {
    let text = "[state]\np = \"vector(2, -2..2)\"\nq = \"vector(2, -1..4)\"\n\
         [level]\nequations = [\"(p,p) = 1\", \"|q − p|² = 4\", \"|q − [2, 0]|² = 4\"]\n\
         [field]\n\"p'\" = \"[0, 0]\"\n\"q'\" = \"[0, 0]\"\n";
    let claims = [
        "identity = \"(q,q) − 4*q1 = 0\"",
        "identity = \"(q,q) − 2*(p,q) = 3\"",
        "identity = \"(q,q) − 2*(p,q) = 4\"",
    ];
    let found = judged(&with_claims(text, &claims));
    assert_eq!(found, [Verdict::Proved, Verdict::Proved, Verdict::Refuted]);
}

/// A level that is found numerically, as the graph of y + y⁵ = …, with a motion along it.
fn curve(field: &str) -> String {
    format!(
        "[state]\nx = \"-2..2\"\ny = \"-2..2\"\nz = \"-2..2\"\n\
         [field]\n{field}\n[level]\nequations = [\"y^5 + y + x^5 + x*z − 1/2 = 0\"]\n"
    )
}

#[test]
fn multiples_of_the_equation_are_proved_and_others_are_not() {
    let rest = "\"x'\" = \"0\"\n\"y'\" = \"0\"\n\"z'\" = \"0\"";
    let own = "(y^5 + y + x^5 + x*z − 1/2)";
    for (number, (factor, more)) in
        [("1", "0"), ("(2*x − z + 3)", "0"), ("sin(z)", "0"), ("x", "x^3/1000"), ("(y + 1)", "z^2")]
            .into_iter()
            .enumerate()
    {
        let claim = format!("identity = \"{factor}*{own} + {more} = 0\"");
        let found = judged(&with_claims(&curve(rest), &[&claim]));
        let is_proved = found[0] == Verdict::Proved;
        assert_eq!(is_proved, number < 3, "{claim}: {found:?}");
    }
}

#[test]
fn integrals_need_that_the_motion_stays() {
    // y (F_y, −F_x) keeps F; and so does any field, up to a multiple of F.
    let slopes = ["(5*x^4 + z)", "(5*y^4 + 1)"];
    let own = "(y^5 + y + x^5 + x*z − 1/2)";
    let along = format!(
        "\"x'\" = \"{}\"\n\"y'\" = \"−{} + {own}\"\n\"z'\" = \"x*{own}\"",
        slopes[1], slopes[0]
    );
    let claims = ["integral = \"z\"", "rate = \"z\"\nequals = \"0\"", "integral = \"x\""];
    let found = judged(&with_claims(&curve(&along), &claims));
    assert_eq!(found[..2], [Verdict::Proved, Verdict::Proved]);
    assert_eq!(found[2], Verdict::Refuted);
}
