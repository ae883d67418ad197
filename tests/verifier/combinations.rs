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
    for n in [2, 3] {
        let text = format!(
            "system = \"nonholonomic\"\n[parameters]\na = \"0.5..1\"\nb = \"1..2\"\n\
             [state]\np = \"vector({n}, -1..1)\"\nq = \"vector({n}, -2..2)\"\n\
             \"p'\" = \"vector({n}, -1..1)\"\n\"q'\" = \"vector({n}, -1..1)\"\n\
             [lagrangian]\nkinetic = \"(p',p')/2 + (q',q')/2\"\npotential = \"p2 + q2\"\n\
             constraints = [\"(p,p) = a²\", \"|q − p|² = b²\"]\n"
        );
        // A density asks that the parametrisation misses nothing.
        let claims = [
            "integral = \"energy\"",
            "integral = \"energy + p1\"",
            "density = \"2*a²*b² − (p, q − p)²\"",
        ];
        let found = judged(&with_claims(&text, &claims));
        assert_eq!(found, [Verdict::Proved, Verdict::Refuted, Verdict::Proved], "in ℝ^{n}");
    }
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

#[test]
fn chains_keep_their_energy_for_any_number_of_links() {
    let n = 5;
    let links = (2..=n).map(|i| format!(", \"|q[{i}] − q[{}]|² = 1\"", i - 1)).collect::<String>();
    let text = format!(
        "system = \"nonholonomic\"\n[state]\nq = \"matrix({n}, 2, -1..1)\"\n\"q'\" = \"matrix({n}, 2, -1..1)\"\n\
         [lagrangian]\nkinetic = \"sum(i, 1..{n}, (q'[i],q'[i]))/2\"\npotential = \"sum(i, 1..{n}, q[i,2])\"\n\
         constraints = [\"(q[1],q[1]) = 1\"{links}]\n"
    );
    let found = judged(&with_claims(&text, &["integral = \"energy\"", "integral = \"q'[1,1]\""]));
    assert_eq!(found, [Verdict::Proved, Verdict::Refuted]);
}

#[test]
fn reversors_of_linkages_are_proved_without_states() {
    let text = |kinetic: &str| {
        format!(
            "system = \"nonholonomic\"\n[state]\np = \"vector(2, -1..1)\"\nq = \"vector(2, -1..3)\"\n\
             \"p'\" = \"vector(2, -1..1)\"\n\"q'\" = \"vector(2, -1..1)\"\n\
             [lagrangian]\nkinetic = \"{kinetic}\"\npotential = \"p[2] + q[2]\"\n\
             constraints = [\"(p,p) = 1\", \"|q − p|² = 4\", \"|q − [5/4, 0]|² = 9/4\"]\n"
        )
    };
    let back = "reversor = { p' = \"-p'\", q' = \"-q'\" }".replace("p' =", "\"p'\" =");
    let back = back.replace("q' =", "\"q'\" =");
    // With one velocity turned alone the image is off the level.
    let half = "reversor = { \"p'\" = \"-p'\" }";
    let mirror = "symmetry = { p = \"[p[1], -p[2]]\", q = \"[q[1], -q[2]]\" }";
    let found = judged(&with_claims(&text("((p',p') + (q',q'))/2"), &[&back, mirror, half]));
    assert_eq!(found, [Verdict::Proved, Verdict::Refuted, Verdict::Refuted]);
}

/// A level that is found numerically, that of eˣ + x + eʸ + y, with a motion along it.
fn curve(field: &str) -> String {
    format!(
        "[state]\nx = \"-2..2\"\ny = \"-2..2\"\nz = \"-2..2\"\n\
         [field]\n{field}\n[level]\nequations = [\"exp(y) + y + exp(x) + x = 3\"]\n"
    )
}

#[test]
fn multiples_of_the_equation_are_proved_and_others_are_not() {
    let rest = "\"x'\" = \"0\"\n\"y'\" = \"0\"\n\"z'\" = \"0\"";
    let own = "(exp(y) + y + exp(x) + x − 3)";
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
    // (F_y, −F_x) keeps F, and a multiple of F is 0 on the level.
    let own = "(exp(y) + y + exp(x) + x − 3)";
    let along =
        format!("\"x'\" = \"exp(y) + 1\"\n\"y'\" = \"−exp(x) − 1 + {own}\"\n\"z'\" = \"x*{own}\"");
    let claims = ["integral = \"z\"", "rate = \"z\"\nequals = \"0\"", "integral = \"x\""];
    let found = judged(&with_claims(&curve(&along), &claims));
    assert_eq!(found[..2], [Verdict::Proved, Verdict::Proved]);
    assert_eq!(found[2], Verdict::Refuted);
}

/// Verdict on an identity of the four-bar linkage.
fn of_linkage(identity: &str) -> Verdict {
    let text = format!(
        "title = 't'\nsystem = 'nonholonomic'\n[parameters]\na = '1..1.2'\nb = '2..2.2'\nc = '2..2.2'\nd = '2..2.2'\n\
         [state]\n\"α\" = '-3..3'\n\"β\" = '-3..3'\n\"γ\" = '-3..3'\n\"α'\" = '-2..2'\n\"β'\" = '-2..2'\n\"γ'\" = '-2..2'\n\
         [lagrangian]\nkinetic = \"(α'^2 + β'^2 + γ'^2)/2\"\n\
         constraints = ['a*cos(α) + b*cos(β) - c*cos(γ) = d', 'a*sin(α) + b*sin(β) - c*sin(γ) = 0']\n\
         [[claim]]\nidentity = \"{identity}\"\nexpect = 'open'\n"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    report.claims[0].verdict
}

#[test]
fn linkages_are_judged_by_sines_of_sums() {
    let proved = [
        "a*α'*sin(α - γ) + b*β'*sin(β - γ) = 0",
        "(a*cos(α) + b*cos(β) - d)^2 + (a*sin(α) + b*sin(β))^2 = c^2",
        "a^2 + b^2 + d^2 + 2*a*b*cos(α - β) - 2*a*d*cos(α) - 2*b*d*cos(β) = c^2",
    ];
    for identity in proved {
        assert_eq!(of_linkage(identity), Verdict::Proved, "{identity}");
    }
    let wrong = [
        "a*α'*sin(α + γ) + b*β'*sin(β - γ) = 0",
        "a^2 + b^2 + d^2 + 2*a*b*cos(α + β) - 2*a*d*cos(α) - 2*b*d*cos(β) = c^2",
    ];
    for identity in wrong {
        assert_eq!(of_linkage(identity), Verdict::Refuted, "{identity}");
    }
}
