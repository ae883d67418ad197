//! Limits of time and memory, files that are written, and faults of single files.

use std::fs;
use std::time::{Duration, Instant};

use predicates::str::contains;

use crate::commands::{GOOD, folder, json, liouville};

/// A system that keeps a judge busy for minutes.
pub const LONG: &str = "title = 'long'\n[parameters]\nn = 16\n[state]\nx = 'matrix(n, n, -1..1)'\n[field]\n\
                    \"x'\" = 'x*inverse(x + E(n))*x*inverse(x − 2*E(n))*x'\n[[claim]]\n\
                    integral = 'det(x*x + x)'\n[[claim]]\nname = 'other'\ndensity = '1'\n";

#[test]
fn claims_beyond_a_limit_are_undecided_and_told() {
    let path = folder("limits", &[("a-good.toml", GOOD), ("b-long.toml", LONG)]);
    let path = path.to_str().expect("UTF-8");
    let started = Instant::now();
    let report = json(&["check", "--json", path, "--within", "2"], 3);
    assert!(started.elapsed() < Duration::from_secs(15), "the limit is kept");
    let claims = |case: usize| report["cases"][case]["claims"].as_array().expect("claims").clone();
    assert!(claims(0).iter().all(|claim| claim["verdict"] != "undecided"), "the other file");
    assert_eq!(claims(1).len(), 2, "no claim is lost");
    for claim in claims(1) {
        assert_eq!(claim["verdict"], "undecided");
        assert_eq!(claim["evidence"]["reason"], "not reached: stopped after 2 s");
    }
    let summary = &report["summary"];
    assert_eq!((&summary["unreached"], &summary["disagreements"]), (&2.into(), &0.into()));
    liouville(&["check", path, "--within", "1"])
        .assert()
        .code(3)
        .stdout(contains("2 claims not reached"));
    for (option, amount) in [("--within", "0.2"), ("--megabytes", "1")] {
        liouville(&["report", &format!("{path}/b-long.toml"), option, amount])
            .assert()
            .code(3)
            .stderr(contains("not finished: stopped"));
    }
}

#[test]
fn memory_is_limited_where_it_is_known() {
    let path = folder("memory", &[("long.toml", LONG)]);
    let path = path.to_str().expect("UTF-8");
    let output = liouville(&["check", path, "--megabytes", "1"]).output().expect("it runs");
    let told = [output.stdout, output.stderr].concat();
    let told = String::from_utf8_lossy(&told);
    match cfg!(target_os = "linux") {
        true => {
            assert_eq!(output.status.code(), Some(3), "{told}");
            assert!(told.contains("stopped at 1 megabytes of memory"), "{told}");
        }
        false => assert_eq!(output.status.code(), Some(2), "{told}"),
    }
}

#[test]
fn a_search_ends_at_its_limit_of_memory() {
    let path = "plane/unbalanced-ball";
    if cfg!(target_os = "linux") {
        let told = liouville(&["search", path, "--megabytes", "1"]).assert().code(3);
        let told = String::from_utf8_lossy(&told.get_output().stdout).into_owned();
        assert!(told.contains("the search was stopped; it did not reach:"), "{told}");
    }
    // The limits of a count have names of their own, and the older one of its time is known.
    for option in ["--count-seconds", "--seconds", "--count-megabytes"] {
        liouville(&["search", path, option, "none"]).assert().code(2).stderr(contains("--count-"));
    }
}

#[test]
fn files_are_written_whole_or_not_at_all() {
    let place = folder("out", &[("good.toml", GOOD), ("old.html", "old")]);
    let file = |name: &str| place.join(name).to_str().expect("UTF-8").to_string();
    let case = file("good.toml");
    let refuse = |name: &str, message: &'static str| {
        liouville(&["report", &case, "--out", &file(name)])
            .assert()
            .code(2)
            .stderr(contains(message))
            .stderr(contains("help: "));
    };
    refuse("good.toml", "is a file that the command reads");
    assert_eq!(fs::read_to_string(&case).expect("the case"), GOOD, "it is as it was");
    refuse("k.pdf", "the format of");
    refuse("k", "the format of");
    refuse("none/k.html", "does not exist");
    refuse("", "is a folder");
    liouville(&["report", &case, "--out", &file("old.html")]).assert().code(0);
    let page = fs::read_to_string(file("old.html")).expect("the page");
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>\n"), "all of it");
    assert!(page.contains("sha256:"), "with the digest of the case");
    assert!(page.contains("Equations of motion:"), "and the system");
    let mut names: Vec<_> = fs::read_dir(&place)
        .expect("the folder")
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert_eq!(names, ["good.toml", "old.html"], "nothing else is left");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&case, file("link.html")).expect("a link");
        refuse("link.html", "is a file that the command reads");
        fs::hard_link(&case, file("hard.html")).expect("a link");
        refuse("hard.html", "is a file that the command reads");
    }
}

#[test]
fn reports_name_the_program_and_the_case() {
    let place = folder("digest", &[("good.toml", GOOD)]);
    let case = place.join("good.toml");
    let case = case.to_str().expect("UTF-8");
    let report = json(&["check", "--json", case], 0);
    let digest = report["cases"][0]["digest"].as_str().expect("a digest").to_string();
    assert!(digest.starts_with("sha256:") && digest.len() == 71, "{digest}");
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    for command in ["report", "search"] {
        let found = json(&[command, case, "--json"], 0);
        assert_eq!(found["digest"].as_str(), Some(digest.as_str()), "{command}");
        assert_eq!(found["version"], env!("CARGO_PKG_VERSION"), "{command}");
    }
    liouville(&["report", case]).assert().code(0).stdout(contains(&*digest));
}

#[test]
fn shells_editors_and_manuals_are_served() {
    for shell in ["bash", "zsh", "fish"] {
        let script = liouville(&["completions", shell]).output().expect("it runs").stdout;
        let script = String::from_utf8_lossy(&script).into_owned();
        assert!(script.contains("liouville") && script.contains("within"), "{shell}");
    }
    let place = folder("man", &[]);
    liouville(&["man", place.to_str().expect("UTF-8")]).assert().code(0);
    let page = fs::read_to_string(place.join("liouville-check.1")).expect("a page");
    assert!(page.contains("within") && page.contains("megabytes"), "options of check");
    let schema = liouville(&["schema"]).output().expect("it runs").stdout;
    let schema: serde_json::Value = serde_json::from_slice(&schema).expect("JSON");
    let claims = &schema["properties"]["claim"]["items"]["properties"];
    assert!(claims["integral"]["description"].is_string(), "with the words of the guide");
}

#[test]
fn remarks_are_told_in_text_and_in_json() {
    let text = GOOD.replace("m = \"0.5..2\"", "m = \"0.5..2\"\nspare = 2");
    let path = folder("remarks", &[("case.toml", &text)]);
    let path = path.to_str().expect("UTF-8");
    let remark = "the parameter `spare` stands in no formula";
    liouville(&["check", path]).assert().code(0).stdout(contains(remark));
    let report = json(&["check", "--json", path], 0);
    assert_eq!(report["cases"][0]["remarks"][0], remark);
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_there_is() {
    use std::process::{Command, Stdio};
    let path = folder("interrupt", &[("a-good.toml", GOOD), ("b-long.toml", LONG)]);
    for signal in ["-INT", "-TERM"] {
        let child = Command::new(env!("CARGO_BIN_EXE_liouville"))
            .args(["check", path.to_str().expect("UTF-8"), "-v"])
            .stdout(Stdio::piped())
            .spawn()
            .expect("it runs");
        std::thread::sleep(Duration::from_secs(1));
        let sent = Command::new("kill").args([signal, &child.id().to_string()]).status();
        assert!(sent.is_ok_and(|status| status.success()), "the signal is sent");
        let output = child.wait_with_output().expect("it ends");
        let told = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(output.status.code(), Some(3), "{told}");
        assert!(told.contains("not reached: stopped by a signal"), "{told}");
        assert!(told.contains("proved   holds     integral  F2"), "{told}");
    }
}
