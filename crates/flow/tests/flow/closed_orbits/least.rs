//! Least periods: proved where they are least, refuted where the orbit is run through several times,
//! and open where neither is known.

use liouville::verdict::{ClaimReport, Verdict};
use liouville_flow::Doubt;

use super::{CYCLE, assert_known, catalogue, judged, of_figure, proved, replayed, van_der_pol};

/// The unit circle as a limit cycle, run through with the speed ω.
fn circle(omega: &str, claim: &str) -> String {
    format!(
        "title = \"circle\"\ncheck-weights = false\n[parameters]\n\"ω\" = \"{omega}\"\n[state]\n\
         x = \"-2..2\"\ny = \"-2..2\"\n[field]\n\"x'\" = \"ω*y + x*(1 − x² − y²)\"\n\
         \"y'\" = \"−ω*x + y*(1 − x² − y²)\"\n[[claim]]\n{claim}\n"
    )
}

fn theorem(found: &ClaimReport) -> &str {
    found.evidence.theorem.as_deref().unwrap_or_default()
}

fn reason(found: &ClaimReport) -> &str {
    found.evidence.reason.as_deref().unwrap_or_default()
}

#[test]
fn one_turn_of_a_circle_is_least_and_two_are_not() {
    let claim = |period: &str, further: &str| {
        let state = "state = { x = \"1\", y = \"0\" }";
        judged(&circle("1", &format!("closed-orbit = {period}\n{state}\n{further}")))
    };
    let one = claim("6.2831853072", "period = \"least\"");
    assert_eq!(one.verdict, Verdict::Proved, "{:?}", one.evidence);
    assert_known(&one, "period", 2.0 * std::f64::consts::PI, 1e-12);
    assert!(theorem(&one).contains("with least period 6.28318530717"), "{}", theorem(&one));
    assert!(one.formula.is_some_and(|text| text.contains("closed orbit of least period 6.28")));
    let two = claim("12.5663706144", "");
    assert_eq!(two.verdict, Verdict::Proved, "4π is a period: {:?}", two.evidence);
    assert!(theorem(&two).contains("2 times the least"), "{}", theorem(&two));
    assert!(!theorem(&two).contains("with least"), "{}", theorem(&two));
    let wrong = claim("12.5663706144", "period = \"least\"");
    assert_eq!(wrong.verdict, Verdict::Refuted, "{:?}", wrong.evidence);
    assert!(reason(&wrong).contains("2 times"), "{:?}", wrong.evidence);
    assert!(reason(&wrong).contains("least period is 6.2831853071"), "{:?}", wrong.evidence);
}

#[test]
#[ignore = "slow: as for those above, with up to twelve turns"]
fn turns_of_random_circles_are_counted() {
    let mut number: u64 = 17;
    let mut random = |below: u64| {
        number = number.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (number >> 33) % below
    };
    let trials = std::array::from_fn::<_, 3, _>(|_| {
        (1 + random(12), 1 + random(30), random(6283) as f64 / 1000.0)
    });
    are_counted(&trials);
}

#[test]
fn turns_of_circles_are_counted() {
    are_counted(&[(1, 13, 0.7), (3, 7, 2.5)]);
}

/// Asserts that turns are counted on circles, for turns, speed in tenths, and angle of the start.
fn are_counted(trials: &[(u64, u64, f64)]) {
    for (trial, (turns, speed, angle)) in trials.iter().copied().enumerate() {
        let period = 2.0 * std::f64::consts::PI * 10.0 / speed as f64 * turns as f64;
        let (x, y) = (angle.cos(), angle.sin());
        let claim =
            format!("closed-orbit = {period:.7}\nstate = {{ x = \"{x:.6}\", y = \"{y:.6}\" }}\n");
        let text = circle(&format!("{speed}/10"), &claim);
        let (case, found) = proved(&text);
        assert_eq!(found.turns, Ok(turns as usize), "{trial}: {text}");
        // Returns are not replayed, and so they are not stated.
        let again = replayed(&case, &found.data).expect("proved again");
        match turns {
            1 => assert_eq!(again.turns, Ok(1), "{trial}"),
            _ => assert!(matches!(again.turns, Err(Doubt::Part(_))), "{trial}: {:?}", again.turns),
        }
        let claimed = judged(&format!("{text}period = \"least\"\n"));
        let should = if turns == 1 { Verdict::Proved } else { Verdict::Refuted };
        assert_eq!(claimed.verdict, should, "{trial}: {text}");
    }
}

#[test]
fn a_motion_that_nearly_returns_halfway_has_not_closed() {
    // b = k sin t beside y = sin 2t: after half of the time all is as before but for k.
    for (k, turns) in
        [("1/10", 1), ("1/1000", 1), ("1/1000000", 1), ("1/1000", 2), ("1/1000000", 3)]
    {
        let period = 2.0 * std::f64::consts::PI * f64::from(turns);
        let text = format!(
            "title = \"figure eight\"\ncheck-weights = false\n[parameters]\nk = \"{k}\"\n[state]\n\
             a = \"-2..2\"\nb = \"-2..2\"\ny = \"-2..2\"\n[field]\n\
             \"a'\" = \"−b + a*(1 − (a² + b²)/k²)\"\n\"b'\" = \"a + b*(1 − (a² + b²)/k²)\"\n\
             \"y'\" = \"2*(a² − b²)/k² + 2*a*b/k² − y\"\n[[claim]]\nclosed-orbit = {period:.9}\n\
             state = {{ a = \"k\", b = \"0\", y = \"0\" }}\n"
        );
        let (case, found) = proved(&text);
        assert_eq!(found.turns, Ok(turns as usize), "{k}, {turns}");
        if turns == 1 {
            let again = replayed(&case, &found.data).expect("proved again");
            assert_eq!(again.turns, Ok(1), "{k}");
        }
    }
}

/// The doubling of a period: (p, q) = e^(2it), and beside it ζ = a + ib, which is 0 or ± √k e^(it).
fn doubling(k: &str, claim: &str) -> String {
    format!(
        "title = \"doubling\"\ncheck-weights = false\n[parameters]\nk = \"{k}\"\n[state]\n\
         p = \"-2..2\"\nq = \"-2..2\"\na = \"-2..2\"\nb = \"-2..2\"\n[field]\n\
         \"p'\" = \"−2*q + p*(1 − p² − q²)\"\n\"q'\" = \"2*p + q*(1 − p² − q²)\"\n\
         \"a'\" = \"−b + p*a + q*b − a + a*(k − a² − b²)\"\n\
         \"b'\" = \"a + q*a − p*b − b + b*(k − a² − b²)\"\n[[claim]]\n{claim}\n"
    )
}

#[test]
fn after_its_doubling_the_period_is_the_double() {
    for k in ["1/100", "1/10000"] {
        let claim = |a: &str, period: &str, further: &str| {
            let state = format!("state = {{ p = \"1\", q = \"0\", a = \"{a}\", b = \"0\" }}");
            judged(&doubling(k, &format!("closed-orbit = {period}\n{state}\n{further}")))
        };
        let least = "period = \"least\"";
        for (a, period) in [("√k", "6.2831853"), ("−√k", "6.2831853"), ("0", "3.14159265")] {
            let found = claim(a, period, least);
            assert_eq!(found.verdict, Verdict::Proved, "{k}, {a}: {:?}", found.evidence);
        }
        // The orbit between the two that are doubled, twice: they are near its boxes.
        let twice = claim("0", "6.2831853", least);
        assert_eq!(twice.verdict, Verdict::Refuted, "{k}: {:?}", twice.evidence);
        assert!(reason(&twice).contains("2 times"), "{:?}", twice.evidence);
        let fourfold = claim("√k", "12.5663706", least);
        assert_eq!(fourfold.verdict, Verdict::Refuted, "{k}: {:?}", fourfold.evidence);
        assert!(reason(&fourfold).contains("2 times"), "{:?}", fourfold.evidence);
    }
}

#[test]
fn cycles_of_rossler_are_least() {
    for (c, period, state) in [
        ("2.5", "5.74899118", ["-2.190965207", "2.715203322", "0.272595183"]),
        ("2.84", "11.53905075", ["5.025940354", "-1.877321214", "0.567866857"]),
        ("3", "11.53107414", ["4.906473351", "-0.391178585", "0.838526352"]),
        ("4", "23.177001056", ["-3.538445565", "-0.808114653", "0.026545676"]),
    ] {
        let [x, y, z] = state;
        let text = format!(
            "title = \"Rössler\"\ncheck-weights = false\n[state]\nx = \"-9..9\"\ny = \"-9..9\"\n\
             z = \"-1..9\"\n[field]\n\"x'\" = \"−y − z\"\n\"y'\" = \"x + y/5\"\n\
             \"z'\" = \"1/5 + z*(x − {c})\"\n[[claim]]\nclosed-orbit = {period}\n\
             state = {{ x = \"{x}\", y = \"{y}\", z = \"{z}\" }}\nperiod = \"least\"\n"
        );
        let found = judged(&text);
        assert_eq!(found.verdict, Verdict::Proved, "c = {c}: {:?}", found.evidence);
    }
}

#[test]
#[ignore = "slow: the same orbits are decided in catalogue.rs, and least periods of others above"]
fn orbits_of_the_catalogue_have_their_least_periods() {
    let van_der_pol = catalogue("classical/flows/van-der-pol-cycle.toml");
    for claim in [of_figure(8), of_figure(6), &van_der_pol].into_iter().flatten() {
        let should = match claim.name.contains("twice") {
            true => "2 times the least",
            false => "with least period",
        };
        assert!(theorem(claim).contains(should), "{}: {:?}", claim.name, claim.evidence);
    }
}

#[test]
fn for_all_parameters_a_return_may_be_open() {
    let claim = |turns: u32, half: &str, further: &str| {
        let digits = if half == "1e-9" { 5 } else { 1 };
        let period = 2.0 * std::f64::consts::PI * f64::from(turns);
        judged(&circle(
            "1",
            &format!(
                "closed-orbit = {period:.digits$}\nstate = {{ x = \"1\", y = \"0\" }}\n\
                 parameters = {{ \"ω\" = \"± {half}\" }}\n{further}"
            ),
        ))
    };
    let least = "period = \"least\"";
    assert_eq!(claim(1, "1e-9", least).verdict, Verdict::Proved, "one turn, for all ω");
    assert_eq!(claim(2, "1e-9", least).verdict, Verdict::Refuted, "two turns, for all ω");
    let mut open = 0;
    for half in ["1e-5", "1e-4", "1e-3", "2e-3", "4e-3"] {
        let (orbit, found) = (claim(2, half, ""), claim(2, half, least));
        assert_ne!(found.verdict, Verdict::Proved, "{half}: {:?}", found.evidence);
        if orbit.verdict == Verdict::Proved && found.verdict == Verdict::Undecided {
            let reason = reason(&found);
            // A return is proved, and not that no other orbit is meant.
            if reason.contains("not proved to be the only one") {
                continue;
            }
            open += 1;
            assert!(reason.contains("neither a return"), "{half}: {:?}", found.evidence);
            assert!(!theorem(&orbit).contains("least"), "{half}: {}", theorem(&orbit));
        }
    }
    assert!(open > 0, "in wide boxes a return is not proved");
}

#[test]
fn another_word_for_a_period_is_refused() {
    for word in ["\"short\"", "\"6.66\"", "2"] {
        let text = van_der_pol("(1 − x²)", &format!("{CYCLE}\nperiod = {word}"));
        let found = liouville::case::Case::parse(&text, &[]).err();
        let found = found.unwrap_or_else(|| panic!("accepted: {word}")).to_string();
        assert!(found.contains("is not a value of"), "{found}");
    }
}
