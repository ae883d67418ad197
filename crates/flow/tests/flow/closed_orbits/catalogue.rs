//! Closed orbits of the catalogue: a proof that is lost shows here.

use liouville::verdict::Verdict;

use super::catalogue;

/// Figures with closed orbits that are soon followed; figures 6 and 8 and the classical cases have tests
/// of their own.
const FEW: &[&str] = &["A1-d", "A4-h", "A4-i"];

/// The others.
const MORE: &[&str] = &["7", "A1-e", "A1-f", "A1-g", "A1-h", "A1-i"];

#[test]
fn closed_orbits_of_the_catalogue_are_decided_as_claimed() {
    are_decided(FEW);
}

#[test]
#[ignore = "slow: as those of the figures above"]
fn closed_orbits_of_more_figures_are_decided_as_claimed() {
    are_decided(MORE);
}

fn are_decided(figures: &[&str]) {
    for figure in figures {
        let path = format!("figures/fig-{figure}.toml");
        let found = catalogue(&path);
        for claim in &found {
            let (name, verdict) = (&claim.name, claim.verdict);
            assert!(claim.agrees, "{path}: {name}: {verdict:?}, {:?}", claim.evidence.reason);
        }
        let is_proved = found.iter().any(|claim| claim.verdict == Verdict::Proved);
        assert!(is_proved, "{path}: an orbit is proved");
    }
}
