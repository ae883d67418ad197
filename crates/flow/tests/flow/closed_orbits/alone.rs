//! Wrong claims about a closed orbit: refuted only where no other orbit can be meant.

use liouville::verdict::Verdict;

use super::judged;

#[test]
fn a_neighbour_of_the_claimed_orbit_refutes_nothing() {
    // A sink at r = 1, and a source at r = √1.001 of period 2π/1.001
    let claim = |claim: &str| {
        judged(&format!(
            "title = 'two cycles'\n[state]\nx = '-2..2'\ny = '-2..2'\n[let]\nr2 = 'x² + y²'\n[field]\n\
             \"x'\" = '−y*r2 + 10*x*(1 − r2)*(1.001 − r2)'\n\
             \"y'\" = 'x*r2 + 10*y*(1 − r2)*(1.001 − r2)'\n[[claim]]\n{claim}\n\
             state = {{ x = '1', y = '0' }}\n"
        ))
    };
    for text in ["closed-orbit = 6.276908399", "closed-orbit = 6.28\nstability = \"source\""] {
        let found = claim(text);
        assert_eq!(found.verdict, Verdict::Undecided, "{text}: {:?}", found.evidence);
        let reason = found.evidence.reason.unwrap_or_default();
        assert!(reason.contains("has period 6.2831853072"), "{text}: {reason}");
    }
    assert_eq!(claim("closed-orbit = 6.28319").verdict, Verdict::Proved, "the sink");
    assert_eq!(claim("closed-orbit = 6.283187").verdict, Verdict::Refuted, "alone within 3e-6");
    let circle = "title = 'circle'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\
        \"x'\" = '−y + x*(1 − x² − y²)'\n\"y'\" = 'x + y*(1 − x² − y²)'\n\
        [[claim]]\nclosed-orbit = 7\nstate = { x = '1', y = '0' }\n";
    let far = judged(circle).evidence.reason.unwrap_or_default();
    assert!(far.contains("period 6.2831853072, which is not within 1 % of 7"), "{far}");
}

#[test]
fn an_orbit_that_begins_nearer_to_the_start_refutes_nothing_about_another() {
    // Over the unit circle, A at z = 0, and B at z = g/10⁴ with the period 2π/(1 − 10⁻⁶).
    let claim = |z: &str| {
        judged(&format!(
            "title = 'two cycles'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n[let]\n\
             g = '1 - 0.7/(1 + 100*(1 - x))'\ngx = '-70/(1 + 100*(1 - x))^2'\ns = 'z/g'\n\
             w = '1 - s/100'\nxd = '-y*w + x*(1 - x^2 - y^2)'\n[field]\n\"x'\" = 'xd'\n\
             \"y'\" = 'x*w + y*(1 - x^2 - y^2)'\n\"z'\" = '5000*s*(s - 0.0001)*g + s*gx*xd'\n\
             [[claim]]\nclosed-orbit = 6.28319159\nstate = {{ x = '1', z = '{z}' }}\n"
        ))
    };
    let between = claim("0.0000165");
    assert_eq!(between.verdict, Verdict::Undecided, "{:?}", between.evidence);
    assert_eq!(claim("0.00003").verdict, Verdict::Proved, "B itself");
}

#[test]
fn closed_orbits_of_other_energies_count() {
    let claim = |period: &str, x: &str, y: &str| {
        judged(&format!(
            "title = 'two oscillators'\n[state]\nx = '-2..2'\ny = '-1/5..1/5'\np = '-3..3'\nq = '-1..1'\n[let]\n\
             H = '(p² + 100*q²)/2 + (x² + 100*y²)/2 + 50*x²*y²'\n[field]\n\"x'\" = 'p'\n\"y'\" = 'q'\n\
             \"p'\" = '−x − 100*x*y²'\n\"q'\" = '−y − x²*y'\n[[claim]]\nclosed-orbit = {period}\n\
             state = {{ x = '{x}', y = '{y}' }}\nintegrals = ['H']\n"
        ))
    };
    let meant = claim("4.7680220273", "1.00000000091", "0.100000000091");
    assert_eq!(meant.verdict, Verdict::Proved, "{:?}", meant.evidence.reason);
    // Five times as far from the orbit meant, and found on another one.
    let between = claim("4.7680220273", "1.000000001", "0.1");
    assert_eq!(between.verdict, Verdict::Undecided, "{:?}", between.evidence);
    // All energies near that of the start have periods near 4.768022.
    let wrong = claim("4.7685", "1.000000001", "0.1");
    assert_eq!(wrong.verdict, Verdict::Refuted, "{:?}", wrong.evidence.reason);
}

#[test]
fn orbits_of_a_family_may_be_of_another_kind() {
    // At F = x² + v² the volume along the orbit changes by a multiple of F₀ − F, F₀ = 1 + 10⁻⁶/6.
    let found = judged(
        "title = 'family'\n[state]\nx = '-2..2'\nv = '-2..2'\ny = '-2..2'\nw = '-2..2'\n[let]\nF = 'x² + v²'\n\
         Y = 'y - x - 3*(F - 1)'\nd = '(F - 1 - 1/6000000)/2'\n[field]\n\"x'\" = 'v'\n\"v'\" = '-x'\n\
         \"y'\" = 'v - d*Y - w/2'\n\"w'\" = 'Y/2 - d*w'\n[[claim]]\nclosed-orbit = 6.2831853\n\
         state = { x = '1', y = '1.000001' }\nintegrals = ['F']\ndivergence = 'negative'\n",
    );
    assert_ne!(found.verdict, Verdict::Refuted, "{:?}", found.evidence.reason);
}
