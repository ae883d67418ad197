//! Wrong inputs, and what the program says of each.
//!
//! `tests/mistakes/inputs.toml` lists the inputs, the files beside it what is printed. After a
//! message was changed on purpose, `LIOUVILLE_BLESS=1 cargo test -p liouville-cli --test cli mistakes`
//! writes these files anew; read the difference before you keep it.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

use assert_cmd::Command;
use serde_json::Value;

/// An input: its label, its text on standard input, and the arguments.
struct Input {
    label: String,
    text: String,
    arguments: Vec<String>,
}

fn home() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/mistakes")
}

fn inputs() -> Value {
    crate::values::read(
        &fs::read_to_string(home().join("inputs.toml")).expect("the list of inputs"),
    )
}

fn texts(value: Option<&Value>) -> Vec<String> {
    let items = value.and_then(Value::as_array).cloned().unwrap_or_default();
    // a literal string holds `\n` for the end of a line
    items.iter().filter_map(Value::as_str).map(|text| text.replace("\\n", "\n")).collect()
}

fn check(label: &str, text: String) -> Input {
    let label = label.replace('\n', "⏎");
    Input { label, text, arguments: vec!["check".into(), "-".into()] }
}

/// All inputs of a group, in the order of the list.
fn group(name: &str) -> Vec<Input> {
    let all = inputs();
    let base = |name: &str| all["base"][name].as_str().expect("a base").to_string();
    let own = &all["group"][name];
    let own_base = own.get("base").and_then(Value::as_str).map(base).unwrap_or_default();
    let mut found = Vec::new();
    for formula in own.get("integrals").and_then(Value::as_array).into_iter().flatten() {
        let formula = formula.as_str().expect("a formula");
        let quoted = formula.replace('\\', "\\\\").replace('"', "\\\"");
        found.push(check(formula, format!("{own_base}[[claim]]\nintegral = \"{quoted}\"\n")));
    }
    for claim in texts(own.get("claims")) {
        found.push(check(&claim, format!("{own_base}[[claim]]\n{claim}\n")));
    }
    for (name, claims) in own.get("claims-of").and_then(Value::as_object).into_iter().flatten() {
        for claim in texts(Some(claims)) {
            let text = format!("{}[[claim]]\n{claim}\n", base(name));
            found.push(check(&format!("{name}: {claim}"), text));
        }
    }
    for text in texts(own.get("texts")) {
        found.push(check(&text, text.clone()));
    }
    let changed = |base: &str, pair: &Value| {
        let [from, to] = &texts(Some(pair))[..] else { panic!("two texts") };
        assert!(base.contains(from.as_str()), "`{from}` is there to be replaced");
        let text = base.replace(from.as_str(), to);
        check(&format!("{from} → {to}"), format!("{text}[[claim]]\nintegral = \"1\"\n"))
    };
    for pair in own.get("changes").and_then(Value::as_array).into_iter().flatten() {
        found.push(changed(&own_base, pair));
    }
    for change in all["change"].as_array().into_iter().flatten() {
        if change["group"].as_str() == Some(name) {
            let base = base(change["base"].as_str().expect("a base"));
            found.push(changed(&base, &change["replace"]));
        }
    }
    for line in texts(own.get("arguments")) {
        let arguments = line.split_whitespace().map(String::from).collect();
        found.push(Input { label: line, text: String::new(), arguments });
    }
    found
}

/// Output of the program on an input, with its exit code.
fn printed(input: &Input, folder: &Path) -> String {
    let mut command = Command::cargo_bin("liouville").expect("the binary is built");
    command.current_dir(folder).env("NO_COLOR", "1").env("COLUMNS", "100");
    let output = command.args(&input.arguments).write_stdin(input.text.as_bytes()).output();
    let output = output.expect("it runs");
    let code = output.status.code().expect("no signal ended it");
    assert!([0, 1, 2, 3].contains(&code), "{}: exit code {code}", input.label);
    let both = [output.stdout, output.stderr].concat();
    let mut text = format!("=== {}\n[{code}]\n", input.label);
    for line in String::from_utf8_lossy(&both).lines() {
        let is_frame = line.trim().trim_matches(['|', '=', ' ']).is_empty();
        if !is_frame && !line.contains(" against expectation") {
            // a `String` takes all that is written to it
            _ = writeln!(text, "{}", line.trim_end());
        }
    }
    text
}

/// Compares what is printed with the file of the group; every refusal says what to write.
fn compare(name: &str) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("mistakes-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a scratch folder");
    let all = inputs();
    let base = |name: &str| all["base"][name].as_str().expect("a base").to_string();
    let claim = "[[claim]]\nintegral = \"energy\"\n";
    fs::write(folder.join("ball.toml"), base("ball") + claim).expect("a scratch file");
    fs::write(folder.join("flow.toml"), base("plane")).expect("a scratch file");
    let found: Vec<String> = group(name).iter().map(|input| printed(input, &folder)).collect();
    for text in found.iter().filter(|text| text.contains("\n[2]\n")) {
        let helps = [
            "help: ",
            "tip: ",
            "Usage: ",
            "possible values: ",
            " is not in ",
            "write ",
            "is required",
            ", such as ",
        ];
        assert!(helps.iter().any(|help| text.contains(help)), "no remedy:\n{text}");
    }
    let found = found.join("\n");
    let file = home().join(format!("{name}.txt"));
    if env::var_os("LIOUVILLE_BLESS").is_some() {
        fs::write(&file, &found).expect("the file is written");
    }
    let kept = fs::read_to_string(&file).unwrap_or_default();
    let differs = kept.lines().zip(found.lines()).find(|(kept, found)| kept != found);
    if let Some((kept, found)) = differs {
        panic!("{name}: `{kept}` is now `{found}`; see the head of this test");
    }
    assert_eq!(kept.lines().count(), found.lines().count(), "{name}: more or fewer lines");
}

#[test]
fn formulas() {
    compare("formulas");
}

#[test]
fn bodies() {
    compare("bodies");
}

#[test]
fn claims() {
    compare("claims");
}

#[test]
fn wholes() {
    compare("wholes");
}

#[test]
fn systems() {
    compare("systems");
}

#[test]
fn arguments() {
    compare("arguments");
}

#[test]
fn the_list_is_whole() {
    let names = ["formulas", "bodies", "claims", "wholes", "systems", "arguments"];
    let count: usize = names.iter().map(|name| group(name).len()).sum();
    assert!(count >= 250, "{count} inputs");
}
