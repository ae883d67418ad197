//! Closed orbits of the catalogue: a proof that is lost shows here.

use liouville::verdict::Verdict;

use super::catalogue;

/// Cases with closed orbits; figures 6 and 8 have tests of their own.
const CASES: &[&str] = &[
    "classical/flows/van-der-pol-cycle.toml",
    "classical/kepler/closed-orbit.toml",
    "classical/oscillators/closed-orbits.toml",
    "figures/fig-5.toml",
    "figures/fig-7.toml",
    "figures/fig-11.toml",
    "figures/fig-A1-c.toml",
    "figures/fig-A1-d.toml",
    "figures/fig-A1-e.toml",
    "figures/fig-A1-f.toml",
    "figures/fig-A1-g.toml",
    "figures/fig-A1-h.toml",
    "figures/fig-A1-i.toml",
    "figures/fig-A4-h.toml",
    "figures/fig-A4-i.toml",
    "spin/rattleback-reversal.toml",
    "spin/spin-friction-motion.toml",
];

#[test]
fn closed_orbits_of_the_catalogue_are_decided_as_claimed() {
    let mut proved = 0;
    for path in CASES {
        for claim in catalogue(path) {
            let (name, verdict) = (&claim.name, claim.verdict);
            assert!(claim.agrees, "{path}: {name}: {verdict:?}, {:?}", claim.evidence.reason);
            let is_decided = matches!(verdict, Verdict::Proved | Verdict::Refuted);
            assert!(is_decided, "{path}: {name}: {verdict:?}, {:?}", claim.evidence.reason);
            proved += usize::from(verdict == Verdict::Proved);
        }
    }
    assert!(proved >= CASES.len(), "{proved} proved");
}
