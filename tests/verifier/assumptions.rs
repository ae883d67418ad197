//! Proofs that rest on a hypothesis say so, and are not enough where a proof is required.

use liouville::case::Case;
use liouville::claim::Assumption;
use liouville::verdict::{ClaimReport, Flaw, Options, Trust, Verdict, judge};

/// Report on the only claim of a case.
fn report(text: &str, trust: Trust) -> ClaimReport {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error:?}\n{text}"));
    let options = Options { trust, ..Options::default() };
    judge(&case, &options).expect("a report").claims.remove(0)
}

fn map(image: &str) -> String {
    format!(
        "title = 'x'\nsystem = 'map'\n[state]\nx = '0..1'\ny = '0..1'\n[map]\nx = '{image}'\ny = 'y'\n\
         [[claim]]\ndensity = '1'\n"
    )
}

#[test]
fn a_density_of_a_map_that_may_take_two_states_to_one_assumes_that_it_does_not() {
    // Takes 0.98 < x < 1 onto 0 < x < 0.02, where the map is the identity.
    let folded = map("x - 49/100 + 49/100*sgn(49/50 - x)");
    let found = report(&folded, Trust::Best);
    assert_eq!((found.verdict, found.agrees), (Verdict::Proved, true));
    assert_eq!(found.evidence.assumes, [Assumption::OneToOne]);
    let strict = report(&folded, Trust::Proof);
    assert!(!strict.agrees);
    let reason = strict.evidence.reason.expect("a reason");
    assert!(reason.contains("assumes that Φ is one-to-one"), "{reason}");
    let shifted = report(&map("x + y²"), Trust::Proof);
    assert_eq!((shifted.verdict, shifted.agrees), (Verdict::Proved, true));
    assert_eq!(shifted.evidence.assumes, []);
}

#[test]
fn a_criterion_on_a_surface_that_may_have_kinks_assumes_that_it_has_none() {
    let body = |support: &str| {
        format!(
            "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nI = 'diag(2, 2, 3)'\n[body]\n\
             support = '{support}'\n[[claim]]\nanalytic-density = 'exists'\n"
        )
    };
    let smooth = report(&body("|γ|"), Trust::Proof);
    assert_eq!((smooth.verdict, smooth.agrees), (Verdict::Proved, true));
    assert_eq!(smooth.evidence.assumes, []);
    let kinked = report(&body("|γ| + |γ3|^3"), Trust::Proof);
    assert_eq!(kinked.verdict, Verdict::Proved, "{:?}", kinked.evidence.reason);
    assert!(kinked.evidence.assumes.contains(&Assumption::SmoothSurface));
    assert!(!kinked.agrees);
}

#[test]
fn claims_that_say_nothing_are_marked() {
    let field = |claim: &str| {
        format!(
            "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\nx = 'y'\ny = '-x'\n[[claim]]\n{claim}\n"
        )
    };
    let flaws = |claim: &str| {
        let found = report(&field(claim), Trust::Best);
        assert_eq!(found.verdict, Verdict::Proved, "{claim}");
        found.evidence.flaws
    };
    assert_eq!(flaws("invariant-relation = 'x² + y² + 1'\ncofactor = '0'"), [Flaw::NoState]);
    assert_eq!(flaws("invariant-relation = 'x² + y² - 1'\ncofactor = '0'"), []);
    assert_eq!(flaws("lyapunov = '3'"), [Flaw::SaysNothing]);
    assert_eq!(flaws("symmetry = { x = '0', y = '0' }"), [Flaw::NotInvertible]);
    assert_eq!(flaws("symmetry = { x = 'y', y = '-x' }"), []);
}
