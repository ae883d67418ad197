//! Closed orbits of the catalogue: a proof that is lost shows here.

use liouville::verdict::Verdict;

use super::catalogue;

/// Cases with closed orbits; figures 6 and 8 have tests of their own.
const CASES: &[&str] = &[
    "classical/flows/van-der-pol-cycle.toml",
    "classical/kepler/closed-orbit.toml",
    "classical/oscillators/closed-orbits.toml",
    "figures/fig-7.toml",
    "figures/fig-A1-d.toml",
    "figures/fig-A1-e.toml",
    "figures/fig-A1-f.toml",
    "figures/fig-A1-g.toml",
    "figures/fig-A1-h.toml",
    "figures/fig-A1-i.toml",
    "figures/fig-A4-h.toml",
    "figures/fig-A4-i.toml",
];

#[test]
fn closed_orbits_of_the_catalogue_are_decided_as_claimed() {
    for path in CASES {
        let found = catalogue(path);
        for claim in &found {
            let (name, verdict) = (&claim.name, claim.verdict);
            assert!(claim.agrees, "{path}: {name}: {verdict:?}, {:?}", claim.evidence.reason);
        }
        let is_proved = found.iter().any(|claim| claim.verdict == Verdict::Proved);
        assert!(is_proved, "{path}: an orbit is proved");
    }
}
