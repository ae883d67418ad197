//! A site of reports: a page for each case, two indices, the same bytes each time.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;

use crate::commands::{GOOD, folder, liouville};

const MAP: &str = include_str!("../../../../catalogue/templates/map.toml");
const BAD: &str = "title = 'bad'\n[state]\nx = '1..2'\n[field]\n\"x'\" = 'y < 1'\n";

/// All files under a folder, with their bytes.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = PathBuf::from(path.file_name().expect("a name"));
        match path.is_dir() {
            true => found.extend(files(&path).into_iter().map(|(own, b)| (name.join(own), b))),
            false => _ = found.insert(name, fs::read(&path).expect("a file")),
        }
    }
    found
}

/// Targets of the links of a page that lead to other files.
fn links(page: &str) -> Vec<&str> {
    let targets = page.split("href=\"").skip(1).filter_map(|rest| rest.split('"').next());
    targets.filter(|target| !target.starts_with('#')).collect()
}

fn site(cases: &Path, name: &str, options: &[&str]) -> (assert_cmd::assert::Assert, PathBuf) {
    let out = folder(name, &[]).join("public");
    let [cases, shown] = [cases, &out].map(|path| path.to_str().expect("UTF-8"));
    (liouville(&[&["site", cases, "--out", shown], options].concat()).assert(), out)
}

#[test]
fn a_site_has_a_page_for_each_case_and_names_those_that_fail() {
    let cases = folder("site-cases", &[("50% good.toml", GOOD), ("index.toml", GOOD)]);
    fs::create_dir(cases.join("sub")).expect("a folder");
    fs::write(cases.join("sub/map.toml"), MAP).expect("a file");
    fs::write(cases.join("sub/bad.toml"), BAD).expect("a file");
    let (done, out) = site(&cases, "site", &[]);
    done.code(2).stdout(contains("3 pages; 1 without a report"));
    let made = files(&out);
    let names: Vec<&str> = made.keys().filter_map(|path| path.to_str()).collect();
    let expected =
        ["50% good.html", "folders.html", "index-case.html", "index.html", "sub/map.html"];
    assert_eq!(names, expected, "pages, and nothing else");
    let text = |name: &str| String::from_utf8(made[Path::new(name)].clone()).expect("UTF-8");
    for index in ["index.html", "folders.html"] {
        let text = text(index);
        for words in ["y &lt; 1", "sub/bad.toml", "3 reports", "balanced ball"] {
            assert!(text.contains(words), "{index}: {words}");
        }
        let reached: Vec<String> =
            links(&text).iter().map(|link| link.replace("%20", " ").replace("%25", "%")).collect();
        for name in names.iter().filter(|name| **name != index) {
            assert!(reached.iter().any(|link| link == name), "{index} leads to {name}");
        }
        assert!(reached.iter().all(|link| out.join(link).is_file()), "{index}: {reached:?}");
    }
    assert_eq!(links(&text("sub/map.html")), ["../index.html"], "the way back");
    assert_eq!(links(&text("50% good.html")), ["index.html"]);
    assert!(text("50% good.html").contains("Its motion"), "the page of `report`");
    assert!(text("sub/map.html").contains("Claims of the case"), "a map has verdicts");
    let (again, other) = site(&cases, "site-again", &["--threads", "1"]);
    again.code(2);
    assert!(files(&other) == made, "the same bytes with another number of threads");
}

#[test]
fn a_site_that_is_stopped_lists_what_was_not_reached() {
    let cases = folder("site-limit", &[("a.toml", GOOD), ("b.toml", super::limits::LONG)]);
    let (done, out) = site(&cases, "site-stopped", &["--within", "4"]);
    done.code(3)
        .stdout(contains("1 page; 1 not reached"))
        .stderr(contains("not finished: stopped after 4 s"));
    let index = fs::read_to_string(out.join("index.html")).expect("an index");
    assert!(index.contains("not reached") && index.contains("<p>b.toml</p>"), "{index}");
    assert_eq!(files(&out).len(), 3, "no file is left half written");
}

#[test]
fn a_site_needs_cases_and_a_folder_to_write_to() {
    let cases = folder("site-file", &[("a.toml", GOOD), ("taken", "")]);
    let taken = cases.join("taken");
    let shown = cases.to_str().expect("UTF-8");
    liouville(&["site", shown, "--out", taken.to_str().expect("UTF-8")])
        .assert()
        .code(2)
        .stderr(contains("error: cannot make").and(contains("taken")));
    liouville(&["site", shown]).assert().code(2).stderr(contains("--out"));
    let out = folder("site-nothing", &[]);
    let arguments = ["site", "no/such/folder", "--out", out.to_str().expect("UTF-8")];
    liouville(&arguments).assert().code(2).stdout(contains("0 pages; 1 without a report"));
}

#[test]
fn long_sums_and_products_are_abridged() {
    let claim = |first: &str, more: &str| {
        format!("[[claim]]\nname = \"long\"\nintegral = \"{first}{}\"\n", more.repeat(3000))
    };
    let field = "title = \"long\"\n[state]\nx = \"-1..1\"\ny = \"-1..1\"\n\
                 [field]\n\"x'\" = \"y\"\n\"y'\" = \"-x\"\n";
    let sum = format!("{field}{}", claim("x^2 + y^2", " + x − x"));
    let product = format!("{field}{}expect = \"open\"\n", claim("x", "*(y + 1)"));
    let cases = folder("site-long", &[("product.toml", &product), ("sum.toml", &sum)]);
    let (done, out) = site(&cases, "site-of-long", &[]);
    done.success().stdout(contains("2 pages"));
    for name in ["sum.html", "product.html"] {
        let page = fs::read_to_string(out.join(name)).expect("a page");
        assert!(page.contains("<mo>…</mo>"), "{name}");
    }
    let sum = cases.join("sum.toml");
    for format in ["text", "latex", "html"] {
        let arguments = ["report", sum.to_str().expect("UTF-8"), "--format", format];
        liouville(&arguments).assert().success();
    }
}
