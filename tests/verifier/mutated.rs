//! Files with random changes: they never cause a panic, and their mistakes have places in the text.

use std::path::{Path, PathBuf};

use liouville::case::Case;
use proptest::prelude::*;

use crate::CASES;
use crate::files::files;

fn catalogue() -> Vec<String> {
    let found = files(Path::new(CASES));
    let read = |path: &PathBuf| std::fs::read_to_string(path).expect("UTF-8");
    found.iter().map(read).chain([FAMILY.to_string()]).collect()
}

const FAMILY: &str = r#"
title = "a family"
[parameters]
n = 3
A = [1, 2, 3]
k = "n + 1"
[state]
x = "vector(n, 0.5..2)"
L = "matrix(n, 2, -1..1)"
[field]
"x[i]'" = "x[i]*(x[i+1 mod n] − x[i−1 mod n])"
"L[i,j]'" = "sum(l, 1..n, l ≠ i, L[l,j]*t)"
"L[1,2]'" = "0"
[let]
M = "matrix(i, 1..n, j, 1..n, if(i = j, x[i], A[j]))"
[[claim]]
integral = "product(i, 1..n, x[i]) + 0*tr(M)"
"#;

/// Inserted pieces: of the language, and odd ones.
const PIECES: [&str; 44] = [
    "\"",
    "'",
    "=",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "\n",
    ",",
    "(",
    ")",
    "|",
    "..",
    "i",
    "1..n",
    "sum(",
    "n",
    "vector(",
    "matrix(i, 1..n, j, 1..n, ",
    "if(",
    "mod",
    "≠",
    "²",
    "^",
    "*",
    "√",
    "×",
    "⊗",
    "γ",
    "ω",
    "e",
    "π",
    "-1",
    "0",
    "9999999999999",
    "1e400",
    "[parameters]",
    "[let]",
    "[state]",
    "\u{301}",
    "x'",
    "#",
];

#[derive(Clone, Debug)]
enum Change {
    Insert(prop::sample::Index, usize),
    Delete(prop::sample::Index, usize),
    Swap(prop::sample::Index, prop::sample::Index),
    Repeat(prop::sample::Index),
}

fn change() -> impl Strategy<Value = Change> {
    prop_oneof![
        4 => (any::<prop::sample::Index>(), 0..PIECES.len()).prop_map(|(at, what)| Change::Insert(at, what)),
        4 => (any::<prop::sample::Index>(), 1..12usize).prop_map(|(at, count)| Change::Delete(at, count)),
        1 => any::<(prop::sample::Index, prop::sample::Index)>().prop_map(|(a, b)| Change::Swap(a, b)),
        1 => any::<prop::sample::Index>().prop_map(Change::Repeat),
    ]
}

fn changed(text: &str, change: &Change) -> String {
    let places: Vec<usize> = text.char_indices().map(|(at, _)| at).chain([text.len()]).collect();
    let lines: Vec<&str> = text.lines().collect();
    match change {
        Change::Insert(at, what) => {
            let (before, after) = text.split_at(*at.get(&places));
            format!("{before}{}{after}", PIECES[*what])
        }
        Change::Delete(at, count) => {
            let first = at.index(places.len());
            let last = (first + count).min(places.len() - 1);
            format!("{}{}", &text[..places[first]], &text[places[last]..])
        }
        Change::Swap(a, b) if !lines.is_empty() => {
            let mut lines = lines;
            let (a, b) = (a.index(lines.len()), b.index(lines.len()));
            lines.swap(a, b);
            lines.join("\n")
        }
        Change::Repeat(at) if !lines.is_empty() => {
            let mut lines = lines;
            let place = at.index(lines.len());
            lines.insert(place, lines[place]);
            lines.join("\n")
        }
        _ => text.to_string(),
    }
}

#[test]
fn changed_files_are_read_or_refused() {
    let catalogue = catalogue();
    let mut runner = proptest::test_runner::TestRunner::new(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(5000)
    });
    let strategy = (any::<prop::sample::Index>(), prop::collection::vec(change(), 1..5));
    runner
        .run(&strategy, |(file, changes)| {
            let text = file.get(&catalogue).clone();
            let text = changes.iter().fold(text, |text, change| changed(&text, change));
            if let Err(error) = Case::parse(&text, &[]) {
                prop_assert!(!error.mistakes().is_empty(), "a reason is given");
                for mistake in error.mistakes() {
                    let place = mistake.span.clone();
                    prop_assert!(place.is_none_or(|span| text.get(span).is_some()), "{mistake}");
                }
            }
            Ok(())
        })
        .unwrap_or_else(|failure| panic!("{failure}"));
}
