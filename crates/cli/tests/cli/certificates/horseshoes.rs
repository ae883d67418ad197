//! Certificates of horseshoes: replayed as they are, refused with the place where they were changed.

use std::fs;
use std::sync::OnceLock;

use super::{ball, is_there, of_motions, run, text, verified};
use liouville_cli::report::motion_certificate::sealed;
use liouville_cli::report::sha256;
use serde_json::Value;

/// Writes the certificate of a horseshoe of a case.
fn of_a_horseshoe(folder: &str, case: &str) -> String {
    of_motions(folder, &format!("crates/cli/tests/certificates/{case}.toml")).remove(0)
}

/// Certificate of a horseshoe of Duffing's oscillator, which several tests read.
fn of_duffing() -> &'static str {
    static FILE: OnceLock<String> = OnceLock::new();
    FILE.get_or_init(|| of_a_horseshoe("horseshoe", "duffing"))
}

#[test]
fn horseshoes_are_proved_again_from_their_certificates() {
    let file = of_duffing();
    let output = run(env!("CARGO_BIN_EXE_liouville"), &["verify", file]);
    let told = text(&output.stdout);
    assert!(output.status.success(), "{told}{}", text(&output.stderr));
    assert!(told.ends_with("1 certificate: 1 proved, 0 refused\n"), "{told}");
    for part in ["two loops of covering relations", "entropy ≥ 0.", "every real-analytic integral"]
    {
        assert!(told.contains(part), "{told}");
    }
    if is_there() {
        let output = run("python3", &["docs/certificates/orbit.py", file]);
        let told = text(&output.stdout);
        assert!(
            !output.status.success() && told.contains("`liouville verify` checks it"),
            "{told}"
        );
    }
}

/// The last set of the short loop is wide against the set that it has to cover first: nearly all of
/// the image's extent comes from the width of the enclosure, so that the window counts.
#[test]
fn one_window_is_enough_for_both_rectangles_on_the_saddles_surface() {
    let file = of_a_horseshoe("horseshoe-slow", "duffing-slow");
    let whole: Value =
        serde_json::from_str(&fs::read_to_string(file).expect("a file")).expect("JSON");
    let report = verified(&whole).unwrap_or_else(|refusal| panic!("{refusal}"));
    let theorem = report.evidence.theorem.expect("stated");
    assert!(theorem.contains("two loops of covering relations"), "{theorem}");
    let last = last_of_the_short_loop(&whole);
    let window = format!("/proof/sets/{last}/time/1");
    let wider = changed(&whole, &window, &|own| number(valued(own) * 1.2));
    let refusal = verified(&wider).expect_err("a window that is wider than the room allows");
    assert!(refusal.contains(&format!("`proof.relations[{last}]`")), "{refusal}");
    let mut statement = whole["statement"].clone();
    let other = |value: &Value| value.as_str().expect("a text").replace("7.8540", "7.8640");
    let text = other(&statement["case"]["text"]);
    statement["case"]["sha256"] = sha256(&text).into();
    statement["case"]["text"] = text.into();
    statement["claim"]["formula"] = other(&statement["claim"]["formula"]).into();
    let refusal = verified(&sealed(statement, whole["proof"].clone())).expect_err("another period");
    assert!(refusal.contains("is not 7.8640"), "{refusal}");
}

/// The last set of the short loop, which covers the first set.
fn last_of_the_short_loop(certificate: &Value) -> usize {
    let relations = certificate["proof"]["relations"].as_array().expect("a list").iter();
    let back = relations.filter(|own| own[1] == 0).filter_map(|own| own[0].as_u64());
    back.min().expect("a last set") as usize
}

/// Number in hexadecimal.
fn number(x: f64) -> Value {
    let power = libm::floor(libm::log2(x.abs())) as i32;
    let digits = (x.abs() * 2f64.powi(52 - power)) as u64;
    let sign = if x < 0.0 { "-" } else { "" };
    format!("{sign}0x1.{:013x}p{power:+}", digits & ((1 << 52) - 1)).into()
}

/// Value of a number in hexadecimal.
fn valued(value: &Value) -> f64 {
    ball(&Value::Array(vec![value.clone(), value.clone()]))[0]
}

/// Certificate in which some numbers are replaced by others made of them, with a digest that fits.
fn changed(whole: &Value, pointer: &str, change: &dyn Fn(&Value) -> Value) -> Value {
    let mut other = whole.clone();
    let own = other.pointer_mut(pointer).expect("a part");
    let new = change(own);
    assert_ne!(*own, new, "{pointer} is left as it is");
    *own = new;
    sealed(other["statement"].clone(), other["proof"].clone())
}

#[test]
#[ignore = "slow: forty replays; `one_window_is_enough` has one refusal with its place"]
fn horseshoes_with_other_numbers_are_refused_with_the_place() {
    let file = of_duffing();
    let whole: Value =
        serde_json::from_str(&fs::read_to_string(file).expect("a file")).expect("JSON");
    let sets = whole["proof"]["sets"].as_array().expect("a list").clone();
    let last = last_of_the_short_loop(&whole);
    let set = |index: usize, part: &str| format!("/proof/sets/{index}/{part}");
    let plus = |x: f64| move |own: &Value| number(valued(own) + x);
    let times = |x: f64| move |own: &Value| number(valued(own) * x);
    let long = sets.len() - last - 1;
    assert!(last > 3 && long > 3, "{last} and {long} sets");

    // (pointer, change, words of the refusal)
    type Change<'c> = (String, Box<dyn Fn(&Value) -> Value + 'c>, String);
    let at = |index: usize| format!("`proof.sets[{index}]");
    let related = |index: usize| format!("`proof.relations[{index}]`");
    let any = "`proof.".to_string();
    let side = valued(&sets[1]["half"][0]);
    let window = valued(&sets[1]["time"][1]);
    let branch = last + 1;
    let mut cases: Vec<Change<'_>> = vec![
        ("/proof/orders/1".into(), Box::new(|_| 1.into()), "`proof.orders`".into()),
        ("/proof/orders/0".into(), Box::new(|_| 61.into()), "`proof.orders`".into()),
        ("/proof/functions".into(), Box::new(|_| vec![0; 0].into()), "`proof.functions`".into()),
        ("/proof/values".into(), Box::new(|_| vec![0; 0].into()), "`proof.values`".into()),
        ("/proof/sets".into(), Box::new(|_| vec![0; 0].into()), "`proof.sets`".into()),
        (set(1, "origin/0"), Box::new(plus(0.1)), at(0)),
        (set(1, "origin/2"), Box::new(|_| "1".into()), at(1)),
        (set(1, "normal"), Box::new(|_| sets[1]["rows"][0].clone()), at(1)),
        (set(1, "rows/1"), Box::new(|_| sets[1]["rows"][0].clone()), at(1)),
        (set(1, "centre/1"), Box::new(plus(0.1)), any.clone()),
        (set(1, "centre"), Box::new(|_| vec![0; 0].into()), at(1)),
        (set(1, "half/0"), Box::new(times(-1.0)), at(1)),
        (set(1, "time/0"), Box::new(plus(4.0 * window)), at(1)),
        (set(1, "time/1"), Box::new(times(1e-6)), at(1)),
        (set(1, "time/1"), Box::new(|_| number(0.2)), at(1)),
        (set(1, "tail"), Box::new(times(1e-3)), at(1)),
        (set(branch, "origin/1"), Box::new(plus(1e-9)), any.clone()),
        (set(branch, "normal/0"), Box::new(plus(1e-9)), any.clone()),
        (
            "/statement/claim/formula".into(),
            Box::new(|_| "horseshoe".into()),
            "claim.formula".into(),
        ),
        ("/statement/horseshoe/start/0/1".into(), Box::new(times(0.5)), "start[0]".into()),
        ("/statement/horseshoe/times/1/0".into(), Box::new(plus(1e-3)), "times[1]".into()),
        ("/statement/horseshoe/entropy".into(), Box::new(times(1.01)), "entropy".into()),
        // relations that are not those of the numbers
        (set(1, "rows"), Box::new(|own| vec![own[1].clone(), own[0].clone()].into()), related(0)),
        (set(2, "half/0"), Box::new(times(1.5)), related(1)),
        (set(1, "half/1"), Box::new(times(0.5)), related(0)),
        (set(1, "middle/0"), Box::new(move |_| number(side)), "`proof.relations[".into()),
        (set(branch + 2, "half/1"), Box::new(times(0.5)), related(branch + 1)),
        (set(branch + 2, "half/0"), Box::new(times(1.5)), related(branch + 1)),
    ];
    // the first set of the long loop moved on to that of the short one
    cases.push((set(branch, "middle"), Box::new(|_| sets[0]["middle"].clone()), at(branch)));
    for (pointer, change, place) in &cases {
        let refusal = verified(&changed(&whole, pointer, change)).expect_err(pointer);
        println!("{pointer}: {refusal}");
        assert!(refusal.contains(place.as_str()), "{pointer}: {refusal}, not {place}");
    }

    // Each kind of relation left out, added, turned round, led elsewhere.
    let count = sets.len();
    let other = |edit: &dyn Fn(&mut Vec<Value>)| {
        changed(&whole, "/proof/relations", &|own| {
            let mut all = own.as_array().expect("a list").clone();
            edit(&mut all);
            all.into()
        })
    };
    let pair = |from: usize, to: usize| Value::from(vec![from, to]);
    type Edit<'e> = Box<dyn Fn(&mut Vec<Value>) + 'e>;
    let edits: Vec<(&str, Edit<'_>)> = vec![
        ("one of the short loop left out", Box::new(|all| drop(all.remove(1)))),
        (
            "the end of the short loop left out",
            Box::new(move |all| {
                all.retain(|own| *own != pair(last, 0));
            }),
        ),
        (
            "the branch left out",
            Box::new(move |all| {
                all.retain(|own| *own != pair(last, branch));
            }),
        ),
        (
            "the end of the long loop left out",
            Box::new(move |all| {
                all.retain(|own| *own != pair(count - 1, 0));
            }),
        ),
        ("all left out", Box::new(|all| all.clear())),
        ("one more", Box::new(move |all| all.push(pair(1, 3)))),
        ("one twice", Box::new(|all| all.push(all[0].clone()))),
        ("one turned round", Box::new(|all| all[1] = pair(2, 1))),
        ("one that names no set", Box::new(move |all| all[1] = pair(1, count))),
        ("three sets", Box::new(|all| all[1] = vec![1, 2, 3].into())),
    ];
    for (name, edit) in &edits {
        let refusal = verified(&other(edit)).expect_err(name);
        println!("{name}: {refusal}");
        assert!(refusal.contains("`proof.relations"), "{name}: {refusal}");
    }
}
