//! Claims about motion: those of the catalogue that take no long runs, wrong input, and reports.

use std::path::Path;

use liouville::case::{Case, Expect};
use liouville::claim::motion::{MOTIONS, MotionKind};
use liouville::verdict::{ClaimReport, Options, Verdict, judge};
use liouville_flow::observe::{evidence_against_density, observe};

fn catalogue(path: &str) -> Case {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("cases").join(path);
    Case::read(&path, &[]).1.unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Returns the reports on the claims of a case for which `wanted` holds.
fn reports(mut case: Case, wanted: impl Fn(&MotionKind) -> bool) -> Vec<ClaimReport> {
    case.motions.retain(|claim| wanted(&claim.kind));
    assert!(!case.motions.is_empty(), "{}: nothing to look at", case.title);
    observe(&case, &Options::default())
}

fn all_agree(path: &str, wanted: impl Fn(&MotionKind) -> bool) {
    for claim in reports(catalogue(path), wanted) {
        assert!(claim.agrees, "{path}: {} came out {:#?}", claim.name, claim.evidence);
    }
}

#[test]
fn fixed_points_that_are_soon_back() {
    fixed_points(&["3", "8", "14", "A1-d"]);
}

#[test]
#[ignore = "slow: as those of four figures above"]
fn fixed_points_of_more_figures_are_soon_back() {
    fixed_points(&["7", "10", "A1-a", "A1-h"]);
}

fn fixed_points(figures: &[&str]) {
    for figure in figures {
        let is_point = |claim: &MotionKind| matches!(claim, MotionKind::PeriodicPoint(_));
        all_agree(&format!("figures/fig-{figure}.toml"), is_point);
    }
}

#[test]
fn short_runs_of_the_first_figure() {
    let is_short = |claim: &MotionKind| !matches!(claim, MotionKind::PeriodicPoint(_));
    all_agree("figures/fig-3.toml", is_short);
}

#[test]
fn contacts_and_limits_of_motions() {
    all_agree("one-sided/motion.toml", |_| true);
    all_agree("one-sided/motion-examples.toml", |_| true);
    all_agree("suslov/limit-example.toml", |_| true);
}

#[test]
fn pulses_within_a_step_bring_contacts_and_limits() {
    let texts = [
        "title = 'a pulse downwards above a floor'\n[state]\nx = '0..2'\np = '-2..2'\nt = '0..60'\n[field]\n\
         \"x'\" = 'p'\n\"p'\" = '-exp(-(t - 20)^2)'\n[one-sided]\nfunction = 'x'\nreaction = '1'\n\
         [one-sided.field]\n\"x'\" = '0'\n\"p'\" = '0'\n\"t'\" = '1'\n\
         [[claim]]\nname = 'none'\ncontacts = []\nexpect = 'fails'\nstate = { x = '1', p = '0', t = '0' }\ntime = 50\n\
         [[claim]]\nname = 'one'\ncontacts = ['arrives at 20.45247']\nstate = { x = '1', p = '0', t = '0' }\ntime = 50\n",
        "title = 'an oscillator and a pulse'\n[state]\nx = '-2..2'\np = '-2..2'\nt = '0..60'\n\
         [parameters]\neps = '0..1/10'\n[field]\n\"x'\" = 'p'\n\"p'\" = '-x + eps*exp(-4*(t - 20)^2)'\n\
         [[claim]]\nlimit-of-motion = 'x'\nparameter = 'eps'\norder = 1\nstate = { x = '0', p = '0', t = '0' }\n\
         time = 40\nconstant = '0.760057186'\n",
    ];
    for text in texts {
        for claim in reports(Case::parse(text, &[]).expect("a case"), |_| true) {
            assert!(claim.agrees, "{} came out {:#?}", claim.name, claim.evidence);
        }
    }
}

#[test]
fn rounding_refutes_no_limit_of_a_high_order() {
    // x(1) = x(0) + 1 + ε^n y
    let verdict = |n: u32, order: u32| {
        let text = format!(
            "title = 'exact'\n[parameters]\nep = '1/2..1'\n[state]\nx = '-3..3'\ny = '-3..3'\n[field]\n\
             \"x'\" = '1 + ep^{n}*y'\n\"y'\" = '0'\n[[claim]]\nlimit-of-motion = 'x'\nparameter = 'ep'\n\
             order = {order}\nconstant = '1'\nstate = {{ x = '1/3', y = '1' }}\ntime = 1\n"
        );
        reports(Case::parse(&text, &[]).expect("a case"), |_| true).remove(0).verdict
    };
    for order in [1, 2, 6] {
        assert_eq!(verdict(order, order), Verdict::Confirmed, "order {order}");
    }
    for order in [7, 8, 9] {
        assert_ne!(verdict(order, order), Verdict::Refuted, "order {order}");
    }
    assert_eq!(verdict(3, 2), Verdict::Refuted, "of a higher order");
    assert_eq!(verdict(1, 2), Verdict::Refuted, "of a lower order");
}

#[test]
fn limits_of_motions_are_judged_by_what_has_settled() {
    // x(1) - x(1) at ε = 0 is g(ε)(1 - 1/e)
    let verdict = |g: &str, constant: &str| {
        let text = format!(
            "title = 'linear'\n[parameters]\nep = '1/2..1'\n[state]\nx = '-3..3'\n[field]\n\
             \"x'\" = '-x + {g}'\n[[claim]]\nlimit-of-motion = 'x'\nparameter = 'ep'\n{constant}\
             state = {{ x = '1' }}\ntime = 1\n"
        );
        reports(Case::parse(&text, &[]).expect("a case"), |_| true).remove(0).verdict
    };
    let (confirmed, refuted, open) = (Verdict::Confirmed, Verdict::Refuted, Verdict::Undecided);
    let known = "constant = '0.632121'\n";
    for (g, constant, expected) in [
        ("ep*(1 + 1000000*ep)", known, confirmed),
        ("ep/(1 + 1e10*ep)", known, confirmed),
        ("tanh(1e6*ep)", "constant = '632120.6'\n", confirmed),
        ("ep*(1 + ep)", "constant = '0.65'\n", refuted),
        ("sqrt(ep^2 + 1e-10) - 1e-5", "", refuted),
        ("ep^2", "", refuted),
        ("sqrt(ep)", "", refuted),
        ("ep*(1 + 1/10*sin(2*pi*log(ep)/log(10)))", "", open),
        ("ep*log(ep)", "", open),
    ] {
        assert_eq!(verdict(g, constant), expected, "{g}");
    }
}

#[test]
fn a_closed_orbit_speaks_against_a_density_where_there_is_none() {
    let options = Options::default();
    let found = evidence_against_density(&catalogue("figures/fig-8.toml"), &options);
    let found = found.expect("figure 8 has sinks");
    assert!(found.starts_with("proved: a closed orbit goes through"), "{found}");
    assert!(found.contains("no invariant measure has a density"), "{found}");
    let none = evidence_against_density(&catalogue("figures/fig-3.toml"), &options);
    assert_eq!(none, None, "a measure is kept");
}

#[test]
fn every_kind_is_used_and_fails_somewhere() {
    let mut seen = Vec::new();
    for folder in ["figures", "one-sided", "spin", "suslov"] {
        let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases")).join(folder);
        for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
            if entry.path().extension().is_some_and(|extension| extension == "toml") {
                let case = Case::read(&entry.path(), &[]).1.expect("a case");
                seen.extend(case.motions.iter().map(|claim| (claim.kind.name(), claim.expect)));
            }
        }
    }
    for kind in MOTIONS {
        assert!(seen.contains(&(*kind, Expect::Holds)), "{kind} holds somewhere");
        // A horseshoe is proved or undecided, never refuted.
        let fails = seen.contains(&(*kind, Expect::Fails));
        assert!(fails || *kind == "horseshoe", "{kind} fails somewhere");
    }
}

/// Reads a balanced ball, whose section map is integrable.
fn ball(claim: &str) -> Result<Case, String> {
    let text = format!(
        "title = \"balanced ball\"\nsystem = \"rubber-plane\"\n[parameters]\nm = 1\nR = 3\n\
         I = [1, 2, 3]\n[body]\nshape = \"ball\"\n[section]\ng0 = \"0\"\nenergy = 10\n\
         [[claim]]\n{claim}\n"
    );
    Case::parse(&text, &[]).map_err(|error| error.to_string())
}

#[test]
fn numbers_that_are_wrong_are_refuted() {
    let wrong = [
        "time = 4.442882939\nargument = 0.40007",
        "argument = 0.40009",
        "product = 0.99998",
        "stability = \"hyperbolic\"",
        "multiplier = 1.3",
        "period = 2",
    ];
    for companions in wrong {
        let case = ball(&format!("periodic-point = [\"π/2\", 0]\n{companions}"));
        let found = reports(case.expect("a case"), |_| true);
        let [claim] = &found[..] else { panic!("one claim") };
        let refuted = claim.verdict == Verdict::Refuted;
        // A return time with an error of one unit of the last digit agrees with the stated one.
        assert_eq!(refuted, !companions.starts_with("time"), "{companions}: {:?}", claim.evidence);
        assert!(!claim.evidence.measured.is_empty(), "a verdict shows its numbers");
    }
    let moved = ball("periodic-point = [1.59, 0]").expect("a case");
    let found = reports(moved, |_| true);
    assert_eq!(found[0].verdict, Verdict::Refuted, "the point is at π/2: {:?}", found[0].evidence);
}

#[test]
fn a_share_of_the_crossings_may_go_beyond() {
    // A curve around (π/2, 0) that is symmetric about l = π/2.
    for (share, verdict) in
        [("1", Verdict::Refuted), ("0.6", Verdict::Refuted), ("0.4", Verdict::Confirmed)]
    {
        let claim = format!(
            "confined = \"0 < l < π/2\"\nstart = [1.2, 0.1]\ncrossings = 300\nshare = {share}"
        );
        let found = observe(&ball(&claim).expect("a case"), &Options::default());
        assert_eq!(found[0].verdict, verdict, "{share}: {:?}", found[0].evidence);
    }
}

#[test]
fn nothing_is_proved_and_nothing_is_silent() {
    let case = ball("periodic-point = [\"π/2\", 0]").expect("a case");
    let report = judge(&case, &Options::default()).expect("it can be judged");
    assert_eq!((report.claims.len(), report.motions_left), (0, 1), "left alone, and counted");
    let strict = Options { trust: liouville::verdict::Trust::Proof, ..Options::default() };
    let found = observe(&case, &strict);
    assert_eq!(found[0].verdict, Verdict::Confirmed, "confirmed, never proved");
    assert!(!found[0].agrees, "where a proof is asked for, that is too little");
}

#[test]
fn a_start_that_has_no_state_leaves_a_claim_open() {
    let case = ball("exponent = \"zero\"\nstart = [1, 1.5]\ntime = 10").expect("a case");
    let found = observe(&case, &Options::default());
    assert_eq!(found[0].verdict, Verdict::Undecided, "no point of the sphere");
    let reason = found[0].evidence.reason.as_deref().unwrap_or_default();
    assert!(reason.contains("L/G"), "{reason}");
}

#[test]
fn a_fixed_parameter_has_no_limit() {
    let state = "state = { \"ω\" = \"[1,2,3]\", \"γ\" = \"[0,0,1]\" }";
    let case = ball(&format!("limit-of-motion = \"ω\"\nparameter = \"m\"\n{state}\ntime = 1"));
    let found = observe(&case.expect("a case"), &Options::default());
    assert_eq!(found[0].verdict, Verdict::Undecided, "m is 1");
    let reason = found[0].evidence.reason.as_deref().unwrap_or_default();
    assert!(reason.contains("give it a range"), "{reason}");
}

#[test]
fn wrong_input_is_refused_in_its_words() {
    let wrong = [
        ("exponent = \"large\"\nstart = [1, 0]\ntime = 10", "is not a value of"),
        ("exponent = \"zero\"\nstart = [1, 0]", "has no `time`"),
        ("exponent = \"zero\"\nstart = [1, 0]\ntime = -1", "cannot be followed"),
        ("exponent = \"zero\"\ntime = 10", "has no `start`"),
        ("exponent = \"zero\"\nstart = [1]\ntime = 10", "two coordinates"),
        ("exponent = \"zero\"\nstart = [1, 0]\nstate = {}\ntime = 10", "one start"),
        ("exponent = \"zero\"\nintegral = \"1\"\nstart = [1, 0]\ntime = 9", "makes 2 statements"),
        ("exponent = \"zero\"\nstart = [1, 0]\ntime = 10\nwhere = \"level\"", "`where`"),
        ("periodic-point = [\"x\", 0]", "is not a number"),
        ("periodic-point = [1, 0]\nmodulus = 1\nmultiplier = 2", "complex or real"),
        ("limit-cycle = 4\nstart = [1, 0]\ncrossings = 10", "do not show a cycle"),
        ("limit-cycle = 0\nstart = [1, 0]\ncrossings = 10", "is not a count"),
        ("confined = \"l > 2\"\nstart = [1, 0]\ncrossings = 10", "not a part of the section"),
        ("confined = \"0 < l < 2\"\nshare = 2\nstart = [1, 0]\ncrossings = 9", "is not a share"),
        ("contacts = [\"grazes at 2\"]\ntime = 10", "is not an event at a constraint"),
    ];
    for (claim, message) in wrong {
        let found = ball(claim).err().unwrap_or_else(|| panic!("accepted: {claim}"));
        assert!(found.contains(message), "{claim}: {found}");
    }
    let bare = "title = \"top\"\nsystem = \"field\"\ncheck-weights = false\n[state]\nx = \"1..2\"\n\
                [field]\n\"x'\" = \"-x\"\n[[claim]]\nexponent = \"zero\"\nstart = [1, 0]\ntime = 1\n";
    let found = Case::parse(bare, &[]).expect_err("there is no section").to_string();
    assert!(found.contains("the case has none"), "{found}");
}
