//! Certificates of proofs: the checker accepts all, and refuses those that were tampered with.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::OnceLock;

use liouville::verdict::{ClaimReport, Options};
use liouville_cli::report::motion_certificate::{sealed, verify};
use serde_json::Value;

mod catalogue;
mod horseshoes;
mod nearby;

const TOP: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn scratch(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("certificates").join(name);
    let _ = fs::remove_dir_all(&path);
    path
}

fn run(program: &str, arguments: &[&str]) -> Output {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(TOP).output().expect("it starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Writes the certificates of some cases.
fn certified(folder: &str, cases: &[&str]) -> (PathBuf, Vec<String>) {
    let path = scratch(folder);
    let shown = path.display().to_string();
    let arguments = [&["check", "-q", "--certificate", &shown], cases].concat();
    let output = run(env!("CARGO_BIN_EXE_liouville"), &arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let entries = fs::read_dir(&path).expect("a folder").flatten();
    let mut files: Vec<String> = entries.map(|own| own.path().display().to_string()).collect();
    files.sort();
    let told = text(&output.stderr);
    let noun = if files.len() == 1 { "certificate" } else { "certificates" };
    assert!(told.contains(&format!("{} {noun} in {shown}", files.len())), "{told}");
    (path, files)
}

/// Whether there is a Python; says so if not.
fn is_there() -> bool {
    let found = Command::new("python3").arg("--version").output().is_ok();
    if !found {
        println!("not run: there is no python3 on this machine");
    }
    found
}

#[test]
fn certificates_that_were_tampered_with_are_refused() {
    let cases = [
        "cases/classical/planar",
        "cases/classical/fluid",
        "cases/classical/maps",
        "cases/plane/balanced-ball.toml",
    ];
    let (folder, _) = certified("tampered", &cases);
    if !is_there() {
        return;
    }
    let script = "crates/cli/tests/certificates/tamper.py";
    let output = run("python3", &[script, "docs/certificates", &folder.display().to_string()]);
    let told = text(&output.stdout);
    println!("{told}");
    assert!(output.status.success(), "{told}{}", text(&output.stderr));
    let words: Vec<&str> = told.lines().last().unwrap_or_default().split_whitespace().collect();
    let tampered: usize = words[2].parse().expect("a number");
    assert!(tampered >= 200 && words[4] == "0", "{tampered} tampered");
}

#[test]
fn forged_certificates_are_refused_with_their_place() {
    let (folder, _) = certified("forged", &["cases/classical/planar"]);
    let orbits = of_the_limit_cycle();
    let orbit = orbits.iter().find(|file| !file.contains("for-all")).expect("at one value");
    let text = fs::read_to_string(orbit).expect("a certificate");
    let twice = text.replacen("\"settings\"", "\"settings\": [\"μ=2\"], \"settings\"", 1);
    assert_ne!(text, twice);
    let refused = verify(&twice, &Options::default(), &|_| Ok(Vec::new())).expect_err("twice");
    assert!(refused.contains("the key `settings` is there twice"), "{refused}");
    are_refused(&[&folder.display().to_string()], 70);
}

#[test]
#[ignore = "slow: seventeen proofs in Python; `orbits_with_other_numbers_are_refused` makes such forgeries in Rust"]
fn forged_orbits_are_refused_with_their_place() {
    let (folder, _) = certified("forged-orbits", &["cases/classical/planar"]);
    let orbits = of_the_limit_cycle();
    let orbit = orbits.iter().find(|file| !file.contains("for-all")).expect("at one value");
    are_refused(&[&folder.display().to_string(), orbit], 130);
}

/// Forges certificates, of which more than `least` are refused.
fn are_refused(files: &[&str], least: usize) {
    if !is_there() {
        return;
    }
    let script = ["crates/cli/tests/certificates/forge.py", "docs/certificates"];
    let output = run("python3", &[&script[..], files].concat());
    let answers = text(&output.stdout);
    assert!(output.status.success(), "{answers}{}", text(&output.stderr));
    assert!(answers.lines().count() > least, "{answers}");
}

/// Certificates to try, and one whose program was changed.
fn with_a_wrong_one(folder: &str) -> (Vec<String>, String) {
    let (path, files) =
        certified(folder, &["cases/classical/planar", "cases/plane/balanced-ball.toml"]);
    let mut wrong: Value =
        serde_json::from_str(&fs::read_to_string(&files[0]).expect("a file")).expect("JSON");
    let program = &mut wrong["statement"]["programs"][0];
    let input = program["steps"].as_array().expect("steps").iter().position(|s| s[0] == "input");
    program["zero"]["residual"] = serde_json::json!([input.expect("an input")]);
    let changed = path.with_extension("json");
    fs::write(&changed, wrong.to_string()).expect("written");
    (files, changed.display().to_string())
}

#[test]
fn certificates_hold_over_the_rational_numbers() {
    let flint = Command::new("python3").args(["-c", "import flint"]).output();
    let (files, wrong) = with_a_wrong_one("exact");
    if !flint.is_ok_and(|output| output.status.success()) {
        println!("not run: there is no python-flint on this machine");
        return;
    }
    let files: Vec<&str> = files.iter().map(String::as_str).chain([wrong.as_str()]).collect();
    let script = ["docs/certificates/exact.py", "--seconds", "1"];
    let output = run("python3", &[&script[..], &files[..]].concat());
    let told = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{told}{}", text(&output.stderr));
    let refused: Vec<&str> = told.lines().filter(|line| line.starts_with("REFUSED")).collect();
    assert!(refused.len() == 1 && refused[0].contains("is not 0"), "{refused:?}");
    let exact = told.lines().filter(|line| line.starts_with("exact ")).count();
    assert!(exact * 4 > files.len() * 3, "{told}");
}

#[test]
fn certificates_become_goals_of_proof_assistants() {
    let (files, _) = with_a_wrong_one("goals");
    if !is_there() {
        return;
    }
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    for (to, heads) in [("coq", ["Theorem ", "field"]), ("lean", ["theorem ", "field_simp"])] {
        let output = run("python3", &[&["docs/certificates/goals.py", to], &files[..]].concat());
        let goals = text(&output.stdout);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let count = goals.lines().filter(|line| line.starts_with(heads[0])).count();
        assert!(count > 20 && goals.matches(heads[1]).count() >= count, "{count} goals");
    }
}

#[test]
fn what_cannot_be_certified_is_told() {
    let folder = scratch("none").display().to_string();
    let program = env!("CARGO_BIN_EXE_liouville");
    let output =
        run(program, &["check", "-q", "classical/lattices/toda-open-2", "--certificate", &folder]);
    let told = text(&output.stderr);
    assert!(output.status.success() && told.contains("moduli or functions"), "{told}");
    let output = run(program, &["check", "plane/balanced-ball", "--certificate", "README.md"]);
    let told = text(&output.stderr);
    assert!(output.status.code() == Some(2) && told.contains("cannot make the folder"), "{told}");
}

/// Writes the certificates of the motions of a case.
fn of_motions(folder: &str, case: &str) -> Vec<String> {
    let path = scratch(folder);
    let shown = path.display().to_string();
    let arguments = ["check", "-q", "--motion", "--certificate", &shown, case];
    let output = run(env!("CARGO_BIN_EXE_liouville"), &arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let entries = fs::read_dir(&path).expect("a folder").flatten();
    let mut files: Vec<String> = entries.map(|own| own.path().display().to_string()).collect();
    files.sort();
    files
}

/// Certificates of van der Pol's limit cycle, which several tests read.
fn of_the_limit_cycle() -> &'static [String] {
    static FILES: OnceLock<Vec<String>> = OnceLock::new();
    FILES.get_or_init(|| of_motions("orbits", "cases/classical/flows/van-der-pol-cycle.toml"))
}

#[test]
fn closed_orbits_are_proved_again_from_their_certificates() {
    let files = of_the_limit_cycle();
    assert_eq!(files.len(), 2, "at one value of μ, and in a box: {files:?}");
    let program = env!("CARGO_BIN_EXE_liouville");
    let named: Vec<&str> = files.iter().map(String::as_str).collect();
    let output = run(program, &[&["verify"], &named[..]].concat());
    let told = text(&output.stdout);
    assert!(output.status.success(), "{told}{}", text(&output.stderr));
    assert!(told.ends_with("2 certificates: 2 proved, 0 refused\n"), "{told}");
    assert!(told.contains("for all parameters with μ ± 1e-3, a closed orbit"), "{told}");
    if is_there() {
        let narrow = named.iter().copied().find(|file| !file.contains("for-all"));
        let narrow = narrow.expect("at one value");
        let output = run("python3", &["docs/certificates/orbit.py", narrow]);
        let told = text(&output.stdout);
        assert!(output.status.success(), "{told}{}", text(&output.stderr));
        assert!(told.ends_with("1 certificate: 1 proved, 0 refused\n"), "{told}");
        let output = run("python3", &["docs/certificates/check.py", narrow]);
        let told = text(&output.stdout);
        assert!(told.contains("which `liouville verify` checks"), "{told}");
        assert!(told.starts_with("other ") && told.ends_with(" 0 refused\n"), "{told}");
    }
    // One digit of the text of the case.
    let changed = fs::read_to_string(&files[0]).expect("a certificate").replace("= 1\\n", "= 2\\n");
    let other = scratch("changed").with_extension("json");
    fs::write(&other, changed).expect("written");
    let output = run(program, &["verify", &other.display().to_string(), named[0]]);
    let told = text(&output.stdout);
    assert!(output.status.code() == Some(1) && told.contains("REFUSED"), "{told}");
    assert!(told.ends_with("2 certificates: 1 proved, 1 refused\n"), "{told}");
    let output = run(program, &["verify", "no-such-file.json"]);
    assert_eq!(output.status.code(), Some(2), "a file that is not there");
}

/// Pointers to all texts and numbers of a certificate.
fn leaves(value: &Value, path: &str, found: &mut Vec<String>) {
    match value {
        Value::Array(all) => {
            for (index, own) in all.iter().enumerate() {
                leaves(own, &format!("{path}/{index}"), found);
            }
        }
        Value::Object(all) => {
            all.iter().for_each(|(key, own)| leaves(own, &format!("{path}/{key}"), found));
        }
        _ => found.push(path.to_string()),
    }
}

/// Changes one digit of a text, or a number by one.
fn spoilt(value: &Value, place: usize) -> Value {
    match value {
        Value::Number(number) => (number.as_u64().unwrap_or(0) + 1).into(),
        Value::String(text) => {
            let mut letters: Vec<char> = text.chars().collect();
            let place = place % letters.len().max(1);
            if let Some(letter) = letters.get_mut(place) {
                *letter = match letter.to_digit(16) {
                    Some(digit) => char::from_digit((digit + 5) % 16, 16).unwrap_or('x'),
                    None => 'x',
                };
            }
            letters.into_iter().collect::<String>().into()
        }
        _ => Value::Null,
    }
}

fn verified(certificate: &Value) -> Result<ClaimReport, String> {
    verify(&certificate.to_string(), &Options::default(), &|_| Ok(Vec::new()))
}

/// Midpoint and radius of a ball.
fn ball(value: &Value) -> [f64; 2] {
    let number = |text: &Value| {
        let text = text.as_str().expect("a text");
        let (sign, rest) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
        let (digits, power) = rest.strip_prefix("0x").and_then(|r| r.split_once('p')).expect("hex");
        let digits = u64::from_str_radix(&digits.replace('.', ""), 16).expect("hex") as f64;
        sign * digits * 2f64.powi(power.parse::<i32>().expect("a power") - 52)
    };
    [number(&value[0]), number(&value[1])]
}

#[test]
fn orbits_with_other_numbers_are_refused() {
    let files = of_the_limit_cycle();
    let file = files.iter().find(|file| !file.contains("for-all")).expect("at one value");
    let whole: Value =
        serde_json::from_str(&fs::read_to_string(file).expect("a file")).expect("JSON");
    assert!(verified(&whole).is_ok(), "as it was written");
    let mut all = Vec::new();
    leaves(&whole, "", &mut all);
    let random = |k: usize| k.wrapping_mul(6_364_136_223_846_793_005).rotate_left(23) % 1_000_003;
    let (mut refused, mut kept) = (0, 0);
    for trial in 1..=40 {
        let path = &all[random(trial) % all.len()];
        let mut other = whole.clone();
        let own = other.pointer_mut(path).expect("a leaf");
        let new = spoilt(own, random(trial + 1000));
        if *own == new {
            continue;
        }
        *own = new;
        assert!(verified(&other).is_err(), "{path} was changed");
        let is_proof = path.starts_with("/proof") || path.starts_with("/statement/orbit");
        if !is_proof || trial % 4 != 0 {
            continue;
        }
        // With a digest that fits, what is accepted has to be true.
        let sealed = sealed(other["statement"].clone(), other["proof"].clone());
        match verified(&sealed) {
            Err(_) => refused += 1,
            Ok(report) => {
                kept += 1;
                assert!(report.evidence.theorem.is_some(), "{path}");
                let orbit = &sealed["statement"]["orbit"];
                for (key, known) in
                    [("period", 6.663_286_859_323_13), ("volume", -7.058_932_808_799)]
                {
                    let [mid, rad] = ball(&orbit[key]);
                    assert!((mid - known).abs() <= rad + 1e-11, "{path}: {key}");
                }
            }
        }
    }
    println!("{refused} refused, {kept} proved nevertheless");
    // A digit far behind the point changes an approximation, and the proof still holds.
    assert!(refused > 0 && kept > 0, "{refused} refused, {kept} kept");
    for (path, place) in [
        ("/statement/orbit/period/0", 6),
        ("/statement/orbit/period/1", 3),
        ("/statement/orbit/volume/0", 6),
        ("/statement/orbit/start/0/0", 7),
        ("/statement/claim/name", 2),
        ("/statement/claim/formula", 20),
        ("/statement/claim/verdict", 0),
        ("/statement/claim/kind", 0),
        ("/proof/nodes/3/1", 8),
        ("/proof/shares/2", 8),
        ("/proof/period", 8),
        ("/proof/order", 0),
    ] {
        let mut other = whole.clone();
        let own = other.pointer_mut(path).expect("a leaf");
        *own = if path == "/proof/order" { 2.into() } else { spoilt(own, place) };
        let sealed = sealed(other["statement"].clone(), other["proof"].clone());
        assert!(verified(&sealed).is_err(), "{path} was changed, with a new digest");
    }
}

/// The unit circle, with a claim about twice its least period.
const TWICE: &str = "title = \"circle\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\n[field]\n\
    \"x'\" = \"y + x*(1 − x² − y²)\"\n\"y'\" = \"−x + y*(1 − x² − y²)\"\n[[claim]]\n\
    name = \"twice\"\nclosed-orbit = 12.5663706144\nstate = { x = \"1\", y = \"0\" }\n";

#[test]
fn least_periods_are_stated_only_where_they_are_proved_again() {
    let of_least = |file: &str, stated: Value| {
        let text = fs::read_to_string(file).expect("a certificate");
        let mut whole: Value = serde_json::from_str(&text).expect("JSON");
        let orbit = whole["statement"]["orbit"].as_object_mut().expect("a table");
        let own = orbit.remove("least").expect("stated");
        if !stated.is_null() {
            orbit.insert("least".to_string(), stated);
        }
        (own, sealed(whole["statement"].clone(), whole["proof"].clone()))
    };
    let cycle = of_the_limit_cycle();
    let cycle = cycle.iter().find(|file| !file.contains("for-all")).expect("at one value");
    let (own, again) = of_least(cycle, true.into());
    assert_eq!(own, Value::Bool(true), "proved");
    let theorem = verified(&again).expect("proved again").evidence.theorem.unwrap_or_default();
    assert!(theorem.contains("with least period"), "{theorem}");
    assert!(verified(&of_least(cycle, Value::Null).1).is_ok(), "a file that does not state it");
    assert!(verified(&of_least(cycle, 1.into()).1).is_err(), "neither true nor false");

    let path = scratch("twice");
    fs::create_dir_all(&path).expect("a folder");
    let case = path.join("case.toml");
    fs::write(&case, TWICE).expect("written");
    let twice = of_motions("twice/certificates", &case.display().to_string()).remove(0);
    let (own, again) = of_least(&twice, false.into());
    assert_eq!(own, Value::Bool(false), "a period, and not the least");
    let theorem = verified(&again).expect("proved again").evidence.theorem.unwrap_or_default();
    assert!(!theorem.contains("least"), "returns are not replayed: {theorem}");
    let (_, wrong) = of_least(&twice, true.into());
    let refused = verified(&wrong).expect_err("stated, and wrong");
    assert!(refused.contains("not proved to be the least"), "{refused}");
    if is_there() {
        let other = path.join("wrong.json");
        fs::write(&other, wrong.to_string()).expect("written");
        let arguments = ["docs/certificates/orbit.py", &twice, &other.display().to_string()];
        let told = text(&run("python3", &arguments).stdout);
        assert!(told.contains("REFUSED") && told.contains("least is not proved"), "{told}");
        assert!(told.ends_with("2 certificates: 1 proved, 1 refused\n"), "{told}");
    }
}
