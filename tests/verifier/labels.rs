//! Coverage of the papers by claims: `cases/papers.toml` lists every number, theorem, cell of a
//! table and figure of four papers with the claims that state it, or says why no claim does.
//!
//! An erratum is a pair: the printed formula fails, the intended one holds. Every kind of claim is
//! used both ways, so that none can hold by accident.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use liouville::case::{Case, Expect, labels};
use liouville::claim::STATEMENTS;
use serde::Deserialize;

use crate::CASES;
use crate::files::files;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Papers {
    paper: Vec<Paper>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Paper {
    name: String,
    title: String,
    original: String,
    authors: Vec<String>,
    journal: String,
    doi: Option<String>,
    /// What the paper's labels begin with in the sources of claims.
    prefix: String,
    /// Folders of the catalogue that are about the paper.
    folders: Vec<String>,
    item: Vec<Item>,
    #[serde(default)]
    erratum: Vec<Item>,
    #[serde(default)]
    beyond: Vec<Item>,
}

impl Paper {
    fn items(&self) -> impl Iterator<Item = &Item> {
        self.item.iter().chain(&self.erratum).chain(&self.beyond)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Item {
    label: String,
    states: String,
    reason: Option<String>,
    #[serde(default)]
    claims: Vec<String>,
    #[serde(default)]
    wrong: Vec<String>,
}

/// A claim of the catalogue: what it is called, where it is, what is expected, its kind.
struct Stated {
    name: String,
    folder: String,
    labels: BTreeSet<String>,
    expect: Expect,
    kind: &'static str,
}

fn papers() -> Papers {
    let text = std::fs::read_to_string("../cases/papers.toml").expect("the list of papers");
    toml::from_str(&text).expect("papers with items")
}

/// Returns all claims of the catalogue, those about motion and of absence among them.
fn claims() -> Vec<Stated> {
    let of = |path: PathBuf| {
        let case = Case::read(&path, &[]).1.unwrap_or_else(|e| panic!("{path:?}: {e}"));
        claims_of(&case, &path)
    };
    files(Path::new(CASES)).into_iter().flat_map(of).collect()
}

fn claims_of(case: &Case, path: &Path) -> Vec<Stated> {
    let inside = path.strip_prefix(CASES).expect("a path of the catalogue").with_extension("");
    let inside = inside.display().to_string().replace('\\', "/");
    let stated = |name: &str, source: &str, cell: Option<&str>, expect, kind| Stated {
        name: format!("{inside} # {name}"),
        folder: inside.split('/').next().unwrap_or_default().to_string(),
        labels: labels(source, case.column.as_ref(), cell)
            .into_iter()
            .chain(labels(&case.source, None, None))
            .collect(),
        expect,
        kind,
    };
    let claims = case.claims.iter().map(|own| {
        stated(&own.name, &own.source, own.cell.as_deref(), own.expect, own.kind.name())
    });
    let absent = case.absences.iter().map(|own| {
        stated(&own.name, &own.source, own.cell.as_deref(), own.expect, own.kind.name())
    });
    let motions = case
        .motions
        .iter()
        .map(|own| stated(&own.name, &own.source, None, own.expect, own.kind.name()));
    claims.chain(absent).chain(motions).collect()
}

/// Whether a label is a number, theorem, cell, figure or erratum of a paper, and not a section.
fn is_statement(label: &str) -> bool {
    let named =
        ["Theorem ", "Proposition ", "Lemma ", "Conjecture ", "Table ", "fig. ", "erratum "];
    let is_number = label.strip_prefix('(').is_some_and(|rest| {
        rest.starts_with(|c: char| c.is_ascii_digit()) || rest.starts_with("A.")
    });
    is_number || label.contains(": ") || named.iter().any(|name| label.starts_with(name))
}

#[test]
fn every_statement_of_the_papers_is_a_claim_or_has_a_reason() {
    let all = claims();
    let by_name: BTreeMap<&str, &Stated> = all.iter().map(|own| (own.name.as_str(), own)).collect();
    let mut count = 0;
    for paper in papers().paper {
        let mut seen = BTreeSet::new();
        for item in paper.items() {
            let Item { label, states, reason, claims, wrong } = item;
            let place = format!("{}, {label}", paper.name);
            assert!(seen.insert(label), "{place} is listed twice");
            assert!(!states.is_empty(), "{place} is described");
            assert!(label.starts_with(&paper.prefix) || label.contains(": "), "{place}: prefix");
            match reason {
                Some(reason) => {
                    assert!(reason.ends_with('.'), "{place}: the reason is a sentence");
                    assert!(claims.is_empty() && wrong.is_empty(), "{place}: a reason and claims");
                }
                None => assert!(!claims.is_empty(), "{place} has neither a claim nor a reason"),
            }
            for name in claims.iter().chain(wrong) {
                let own = by_name.get(name.as_str());
                let own = own.unwrap_or_else(|| panic!("{place}: no claim {name}"));
                assert!(own.labels.contains(label), "{place}: {name} has {:?}", own.labels);
            }
            for name in wrong {
                let own = by_name[name.as_str()];
                assert_eq!(own.expect, Expect::Fails, "{place}: {name} is expected to hold");
            }
            count += 1;
        }
    }
    assert!(count > 300, "{count} statements are listed");
}

#[test]
fn every_label_of_the_catalogue_is_listed() {
    let all = claims();
    for paper in papers().paper {
        let listed: BTreeSet<&str> = paper.items().map(|item| item.label.as_str()).collect();
        for own in all.iter().filter(|own| paper.folders.contains(&own.folder)) {
            for label in own.labels.iter().filter(|label| !label.starts_with("Table")) {
                let short = label.strip_prefix(&paper.prefix).unwrap_or(label);
                assert!(
                    listed.contains(label.as_str()) || !is_statement(short),
                    "{} has the source {label}, which {} does not list",
                    own.name,
                    paper.name
                );
            }
        }
    }
}

#[test]
fn every_erratum_is_explained_and_decided() {
    let page = std::fs::read_to_string("../docs/errata.md").expect("the page of errata");
    let all = claims();
    for paper in papers().paper {
        for erratum in &paper.erratum {
            let label = &erratum.label;
            assert!(
                page.contains(&format!("| {label} |")) || page.contains(&format!("| {label} † |")),
                "docs/errata.md does not explain {label}"
            );
            let expected =
                |expect| all.iter().any(|own| own.labels.contains(label) && own.expect == expect);
            assert!(expected(Expect::Holds), "{label} has no corrected form");
            assert!(expected(Expect::Fails), "{label} has no printed form");
        }
    }
}

#[test]
fn the_papers_are_named_in_full() {
    let papers = papers().paper;
    assert_eq!(papers.len(), 4, "four papers");
    for paper in papers {
        let Paper { name, title, original, authors, journal, doi, .. } = paper;
        let are_named = [&title, &original, &journal].into_iter().all(|text| text.len() > 10);
        assert!(are_named && !authors.is_empty(), "{name} has a title, a journal and authors");
        assert!(doi.is_none_or(|doi| doi.starts_with("10.")), "{name}: a DOI begins with 10.");
    }
}

#[test]
fn every_kind_of_claim_is_seen_to_hold_and_to_fail() {
    let all = claims();
    for statement in STATEMENTS {
        for expect in [Expect::Holds, Expect::Fails] {
            let count = all.iter().filter(|own| own.kind == *statement && own.expect == expect);
            assert!(count.count() > 0, "no `{statement}` of the catalogue {}", expect.word());
        }
    }
}
