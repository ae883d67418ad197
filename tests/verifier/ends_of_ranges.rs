//! The ends of declared ranges belong to them: levels may hold there alone, and what is said of all states is
//! said of them, though no state is drawn there.

use super::level_parts::Draws;
use liouville::case::Case;
use liouville::verdict::{ClaimReport, Options, Verdict, judge};

fn judged(range: &str, level: &str, claims: &[String]) -> Option<Vec<ClaimReport>> {
    let claims: String =
        claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = \"open\"\n")).collect();
    let text = format!(
        "title = \"t\"\n[state]\nx = \"{range}\"\ny = \"-1..1\"\n[field]\n\"x'\" = \"0\"\n\"y'\" = \"0\"\n\
         {level}{claims}"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).ok().map(|report| report.claims)
}

#[test]
fn ends_belong_to_ranges() {
    for index in 0..10 {
        let mut draws = Draws(500 + index);
        let low = draws.below(9) as i64 - 4;
        let high = low + 1 + draws.below(3) as i64;
        let range = format!("{low}/4..{high}/4");
        for (end, inside) in [(low, 1), (high, -1)] {
            let level = |at: i64| format!("[level]\nequations = [\"x = {at}/400\"]\n");
            let claim = [format!("identity = \"4*x = {end}\"")];
            let found = judged(&range, &level(100 * end), &claim).expect("the end is a state");
            assert_eq!(found[0].verdict, Verdict::Proved, "x = {end}/4 with x in {range}");
            let beyond = judged(&range, &level(100 * end - inside), &claim);
            assert!(beyond.is_none(), "x = {}/400 with x in {range}", 100 * end - inside);
            // Formulas that have no value at the end are judged inside.
            let (near, sign) = (format!("(x − ({end}/4))"), if inside > 0 { "" } else { "−" });
            let claims = [
                format!("identity = \"1/{near} − {near}/{near}^2 = 0\""),
                format!("identity = \"√({sign}{near})^2 = |{near}|\""),
                format!("density = \"{near}\""),
                format!("density = \"{near} + ({inside}/100)\""),
            ];
            let found = judged(&range, "", &claims).expect("judged");
            for own in &found {
                assert_eq!(own.verdict, Verdict::Proved, "{own:?}");
                let remark = own.evidence.remark.clone().unwrap_or_default();
                assert!(!remark.contains("nothing is said"), "{own:?}");
            }
            assert!(found[2].evidence.sign_is_proved && found[2].evidence.sign_may_vanish);
            assert!(found[3].evidence.sign_is_proved && !found[3].evidence.sign_may_vanish);
        }
    }
}

#[test]
fn sines_keep_their_signs_up_to_multiples_of_pi() {
    let judged = |ends: [&str; 3]| {
        let [y, x, t] = ends;
        let text = format!(
            "title = 't'\n[state]\ny = '{y}'\nx = '{x}'\nt1 = '{t}'\n[field]\n\"y'\" = '-sin(y)'\n\
             \"x'\" = '0'\n\"t1'\" = '0'\n[[claim]]\nlyapunov = 'y^2/2'\n\
             [[claim]]\nidentity = 'atan(tan(x)) = x'\n\
             [[claim]]\nidentity = 'sqrt(1 - sin(x)^2) = cos(x)'\n\
             [[claim]]\nidentity = 'sqrt(1 - cos(t1)^2) = sin(t1)'\n\
             [[claim]]\nidentity = 'asin(sin(x)) = x'\n[[claim]]\nidentity = 'acos(cos(t1)) = t1'\n"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let found = judge(&case, &Options::default()).expect("judged").claims;
        found.into_iter().map(|own| own.verdict).collect::<Vec<_>>()
    };
    assert_eq!(judged(["-pi..pi", "-pi/2..pi/2", "0..pi"]), [Verdict::Proved; 6]);
    let beyond = judged(["-3.3..3.3", "-1.7..1.7", "0..3.3"]);
    assert_eq!(beyond, [Verdict::Refuted; 6]);
}
