//! Coverage of the papers' formulas by claims: each folder of the catalogue lists the labels of its
//! formulas in `labels.txt`, and each label occurs in the source of a claim.
//!
//! An erratum is a pair: the printed formula fails, the intended one holds. Every kind of claim is
//! used both ways, so that none can hold by accident.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use liouville::case::{Case, Expect};
use liouville::claim::STATEMENTS;

/// Returns the source of each claim in a folder, with its expectation.
fn claims(folder: &Path) -> Vec<(String, Expect, &'static str)> {
    let mut found = Vec::new();
    for path in entries(folder) {
        if path.is_dir() {
            found.extend(claims(&path));
        } else if path.extension().is_some_and(|extension| extension == "toml") {
            let case = Case::read(&path, &[]).1.unwrap_or_else(|e| panic!("{path:?}: {e}"));
            let claim = |claim: liouville::case::PlacedClaim| {
                (claim.source, claim.expect, claim.kind.name())
            };
            found.extend(case.claims.into_iter().map(claim));
        }
    }
    found
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    entries.flatten().map(|entry| entry.path()).collect()
}

/// Whether a source names this label, and not a longer one such as `erratum 10` for `erratum 1`.
fn names(source: &str, label: &str) -> bool {
    source.match_indices(label).any(|(start, _)| {
        let next = source[start + label.len()..].chars().next();
        !next.is_some_and(|c| c.is_ascii_digit())
    })
}

/// Returns folders with their labels: the text of a line before two spaces.
fn folders() -> Vec<(PathBuf, Vec<String>)> {
    let listed = |folder: PathBuf| {
        let text = std::fs::read_to_string(folder.join("labels.txt")).ok()?;
        let lines = text.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
        let label = |line: &str| line.split("  ").next().unwrap_or(line).trim().to_string();
        let labels = lines.map(label).collect();
        Some((folder, labels))
    };
    entries(Path::new("cases")).into_iter().filter_map(listed).collect()
}

#[test]
fn every_label_is_a_claim() {
    let mut count = 0;
    for (folder, labels) in folders() {
        let claims = claims(&folder);
        let unique: BTreeSet<&String> = labels.iter().collect();
        assert_eq!(unique.len(), labels.len(), "{folder:?} lists a label twice");
        for label in labels {
            let own: Vec<_> = claims.iter().filter(|(source, ..)| names(source, &label)).collect();
            let expected = |expect: Expect| own.iter().any(|(_, found, _)| *found == expect);
            assert!(!own.is_empty(), "{folder:?}: no claim has {label} in its source");
            if label.starts_with("erratum") {
                assert!(expected(Expect::Holds), "{folder:?}: {label} has no corrected form");
                assert!(expected(Expect::Fails), "{folder:?}: {label} has no printed form");
            }
            count += 1;
        }
    }
    assert!(count > 190, "{count} labels are listed");
}

#[test]
fn every_kind_of_claim_is_seen_to_hold_and_to_fail() {
    let all = claims(Path::new("cases"));
    for statement in STATEMENTS {
        for expect in [Expect::Holds, Expect::Fails] {
            let count = all.iter().filter(|(_, e, kind)| kind == statement && *e == expect).count();
            assert!(count > 0, "no `{statement}` of the catalogue {}", expect.word());
        }
    }
}
