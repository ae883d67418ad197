//! The keys of JSON reports, against those that docs/json.md names.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::commands::{folder, liouville};

/// Tables whose keys are names of the case.
const BY_NAME: [&str; 7] = ["parameters", "state", "start", "end", "level", "settings", "verdicts"];

const PENDULUM: &str = "title = 'pendulum'\n[parameters]\na = '1..2'\n[state]\nx = '-1..1'\n\
    p = '-1..1'\n[field]\n\"x'\" = 'p'\n\"p'\" = '-a*sin(x)'\n[[claim]]\nname = 'H'\n\
    integral = 'p^2/2 - a*cos(x)'\n[[claim]]\nname = 'wrong'\nintegral = 'p'\nexpect = 'fails'\n";

/// A section of the document: words in quotes of its blocks, and all words in quotes or
/// backticks.
fn documented(heading: &str) -> [BTreeSet<String>; 2] {
    let text = include_str!("../../../../../docs/json.md");
    let sections = text.split("\n## ");
    let own: String =
        sections.filter(|one| one.lines().next().unwrap_or("").contains(heading)).collect();
    assert!(!own.is_empty(), "docs/json.md has a section on {heading}");
    let words = |text: &str, sign: char| -> BTreeSet<String> {
        let inside = text.split(sign).skip(1).step_by(2);
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        inside.filter(|one| one.chars().all(is_word)).map(str::to_string).collect()
    };
    let blocks: String = own.split("```").skip(1).step_by(2).collect();
    let all = own.lines().flat_map(|line| [words(line, '"'), words(line, '`')]).flatten();
    [words(&blocks, '"'), all.collect()]
}

/// Adds the keys of all tables but those whose keys are names.
fn emitted(value: &Value, is_by_name: bool, of_eval: bool, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(table) => {
            for (key, inner) in table {
                if !is_by_name {
                    found.insert(key.clone());
                }
                let is_named = BY_NAME.contains(&key.as_str()) || of_eval && key == "claims";
                emitted(inner, !is_by_name && is_named && inner.is_object(), of_eval, found);
            }
        }
        Value::Array(all) => all.iter().for_each(|one| emitted(one, false, of_eval, found)),
        _ => {}
    }
}

#[test]
fn the_keys_of_reports_are_those_of_the_document() {
    let home = folder("keys", &[("pendulum.toml", PENDULUM), ("wrong.toml", "titel = 'x'\n")]);
    let pendulum = home.join("pendulum.toml").display().to_string();
    let wrong = home.join("wrong.toml").display().to_string();
    // Heading, commands, and whether they show all keys of the section's blocks.
    let reports: [(&str, &[&str], bool); 9] = [
        (
            "`eval --json`",
            &[
                "eval P",
                "eval classical/maps/standard",
                "eval plane/balanced-ball",
                "eval spin/rattleback",
            ],
            true,
        ),
        (
            "`check --json`",
            &["check P --mutants", "check W", "check classical/flows/van-der-pol-cycle --motion"],
            false,
        ),
        ("`sweep --json`", &["sweep P --states 1000"], true),
        (
            "`motion basins --json`",
            &["motion basins P --x x=0..1 --y p=0..1 --size 3x3 --time 50"],
            true,
        ),
        (
            "`motion diagram --json`",
            &["motion diagram P --over a=1..2 --section x=0 --count 2 --crossings 2"],
            false,
        ),
        ("`motion orbit --json`", &["motion orbit P --time 1"], false),
        ("`motion exponents --json`", &["motion exponents P --time 50"], false),
        ("`motion section --json`", &["motion section P --section x=0 --crossings 3"], false),
        ("`search --json`", &["search P --degree 2"], false),
    ];
    for (heading, commands, is_whole) in reports {
        let [quoted, all] = documented(heading);
        let mut known = all;
        if heading.contains("search") {
            known.extend(documented("`check --json`").into_iter().flatten());
        }
        if heading.contains("section") {
            known.extend(documented("`motion orbit --json`").into_iter().flatten());
        }
        let mut found = BTreeSet::new();
        for command in commands {
            let arguments: Vec<&str> = command
                .split(' ')
                .map(|word| match word {
                    "P" => &pendulum,
                    "W" => &wrong,
                    other => other,
                })
                .chain(["--json"])
                .collect();
            let output = liouville(&arguments).output().expect("it runs");
            let value: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|error| {
                panic!("{command}: {error}\n{}", String::from_utf8_lossy(&output.stderr))
            });
            emitted(&value, false, heading.contains("eval"), &mut found);
        }
        let unknown: Vec<&String> = found.difference(&known).collect();
        assert!(unknown.is_empty(), "{heading}: not in docs/json.md: {unknown:?}");
        if is_whole {
            let missing: Vec<&String> = quoted.difference(&found).collect();
            assert!(
                missing.is_empty(),
                "{heading}: in docs/json.md, and in no report: {missing:?}"
            );
        }
    }
}
