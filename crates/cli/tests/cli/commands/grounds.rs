//! Answers of the program to numbers that are too large, to limits that it passed, to bodies that are
//! none, to motions that are asked for nothing, and to orbits that are not proved.

use predicates::prelude::*;
use predicates::str::contains;

use crate::commands::{GOOD, folder, json, liouville};

const LARGE: &str = "title = 'large'\n[parameters]\na = 1\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\
    \"x'\" = 'a*x³'\n\"y'\" = '10²⁰⁰*x*exp(y)'\n[[claim]]\nname = 'F'\nintegral = '10³⁰⁰*x'\n";

#[test]
fn numbers_that_are_too_large_are_no_singularity() {
    let grows = LARGE.replace("a*x³", "x").replace("10²⁰⁰*x*exp(y)", "−y");
    let pole = grows.replace("= 'x'", "= 'x²'");
    let files = [("large.toml", LARGE), ("grows.toml", &grows), ("pole.toml", &pole)];
    let home = folder("large", &files);
    let [case, grows, pole] =
        ["large.toml", "grows.toml", "pole.toml"].map(|file| home.join(file).display().to_string());
    let eval = |state: &str| {
        let point = json(&["eval", &case, "--json", "--state", state], 0);
        (point["field"].clone(), point["errors"]["field"].clone())
    };
    let (field, errors) = eval("x=2 y=0");
    assert_eq!(field[0], "8.0", "a number with its bound");
    assert!(errors[0].as_str().is_some_and(|error| error.parse::<f64>().is_ok()), "{errors}");
    for state in ["x=1e200 y=1e3", "x=1e200 y=1e30"] {
        let (field, errors) = eval(state);
        assert_eq!((&field[0], &field[1]), (&"overflow".into(), &"overflow".into()), "{state}");
        assert!(errors[0].is_null() && errors[1].is_null(), "{state}: {errors}");
    }
    let digits = ["eval", &case, "--digits", "5", "--state"];
    let more = liouville(&[&digits[..], &["x=1e200 y=1e30"]].concat()).assert().success();
    more.stdout(contains("1.0000e600").and(contains("overflow")).and(contains("undefined").not()));
    for (case, start, when) in [
        (&case, "1e200,1", "at the start"),
        (&case, "1,1e3", "at the start"),
        (&grows, "1,1", "from t = 7"),
    ] {
        liouville(&["motion", "orbit", case, "--start", start, "--time", "1000"])
            .assert()
            .code(2)
            .stderr(contains("overflow").and(contains(when)).and(contains("singular").not()));
    }
    let pole = ["motion", "orbit", &pole, "--start", "1,1", "--time", "2"];
    liouville(&pole).assert().code(2).stderr(contains("overflow").not());
}

#[test]
fn memory_that_was_taken_beyond_a_limit_is_said() {
    let folder = folder("taken", &[("good.toml", GOOD)]);
    let case = folder.join("good.toml").display().to_string();
    let check = |most: &str| liouville(&["check", &case, "--megabytes", most]).assert();
    if cfg!(target_os = "linux") {
        check("1").code(3);
        check("4000").success().stderr(contains("megabytes").not());
        let eval = liouville(&["eval", &case, "--megabytes", "1"]).assert().code(3);
        eval.stderr(contains("megabytes"));
    }
}

#[test]
fn bodies_that_are_none_are_warned_of_in_a_table() {
    let files = [("good.toml", GOOD), ("bodies.csv", "m\n-1\n2\n")];
    let case = folder("bodies-warned", &files);
    let [case, table] =
        ["good.toml", "bodies.csv"].map(|file| case.join(file).display().to_string());
    let wish = ["check", &case, "--settings", &table];
    let text = liouville(&wish).assert().success();
    text.stdout(
        contains("warning: line 2: the mass is not positive").and(contains("line 3").not()),
    );
    let report = json(&[&wish[..], &["--json"]].concat(), 0);
    assert_eq!(report["bodies"][0]["warnings"][0], "the mass is not positive");
    assert_eq!(report["bodies"][1]["warnings"].as_array().map(Vec::len), Some(0));
    let rows = liouville(&[&wish[..], &["--format", "csv"]].concat()).assert().success();
    rows.stdout(contains(",warnings,error\n").and(contains(",the mass is not positive,\n")));
}

#[test]
fn nothing_is_not_computed_in_silence() {
    let surface = ["classical/flows/lorenz-equilibria", "--section", "z = 20"];
    let of_surface = |command: &str, more: &[&str]| {
        let wish = [&["motion", command], &surface[..], more].concat();
        liouville(&wish).assert().code(2).stderr(contains("1 or more"));
    };
    of_surface("section", &["--crossings", "0"]);
    of_surface("section", &["--orbits", "0"]);
    of_surface("diagram", &["--over", "r=20..28", "--orbits", "0"]);
    of_surface("diagram", &["--over", "r=20..28", "--crossings", "0"]);
    let ball = ["motion", "section", "plane/unbalanced-ball", "--g0", "0", "--energy", "50"];
    for (option, value, told) in [
        ("--orbits", "0", "no motion to follow"),
        ("--images", "0", "1 or more"),
        ("--classes=0", "--crossings=1", "a positive time"),
    ] {
        let wish = [&ball[..], &[option, value]].concat();
        liouville(&wish).assert().code(2).stderr(contains(told));
    }
    let still = ["motion", "orbit", "figures/fig-8", "--time", "0"];
    liouville(&still).assert().code(2).stderr(contains("nothing moves in no time"));
}

#[test]
fn a_closed_orbit_is_proved_or_numerical() {
    let pump = "title = 'pump'\n[parameters]\na = '0.5..1'\n[state]\nx = '-3..3'\np = '-3..3'\n[field]\n\
                \"x'\" = 'p'\n\"p'\" = 'a*(1 − x²)*p − x'\n";
    let folder = folder("pump", &[("pump.toml", pump)]);
    let case = folder.join("pump.toml").display().to_string();
    let cycle = ["motion", "periodic", &case, "--start", "2,0"];
    let near = [&cycle[..], &["--section", "p = 0", "--json"]].concat();
    let fixed = [&near[..], &["--set", "a=1"]].concat();
    let found = json(&fixed, 0);
    assert_eq!(found["points"][0]["status"], "proved");
    let theorem = found["points"][0]["theorem"].as_str().expect("a theorem");
    assert!(theorem.contains("a closed orbit goes through"), "{theorem}");
    let bare = json(&[&fixed[..], &["--numerical"]].concat(), 0);
    assert_eq!(bare["points"][0]["status"], "numerical");
    assert!(bare["points"][0].get("theorem").is_none());
    let drawn = json(&near, 0);
    assert_eq!(drawn["points"][0]["status"], "numerical");
    let reason = drawn["points"][0]["unproved"].as_str().expect("a reason");
    assert!(reason.contains("have ranges"), "{reason}");
}

#[test]
fn values_that_tell_nothing_are_said() {
    let flow = "classical/planar/henon-heiles-hamiltonian";
    let surface =
        ["motion", "section", flow, "--set", "ε=1/2", "--energy", "1/10", "--crossings", "5"];
    let section =
        |more: &[&str]| liouville(&[&surface[..], &["--orbits", "2"], more].concat()).assert();
    let none = section(&["--section", "x = 0", "--axes", "ln(−1−y²), y"]).success();
    none.stdout(contains("`ln(−1−y²)` has no value at any crossing"));
    let some = section(&["--section", "x = 0", "--axes", "√(y), py"]).success();
    some.stdout(contains("`√(y)` has no value at ").and(contains(" of 10 crossings")));
    let kept = section(&["--section", "energy = 1/10"]).code(2);
    kept.stderr(contains("the motion stays in the surface"));
    let forced = "classical/flows/duffing-forced";
    let forced = ["--set", "δ=1/5", "--set", "f=1/10", "--start", "0,0,0", forced];
    let plane = ["--x", "x=-2..2", "--y", "p=-2..2", "--size", "3x2", "--time", "40"];
    let basins = |more: &[&str]| {
        liouville(&[&["motion", "basins"], &forced[..], &plane, more].concat()).assert()
    };
    for constant in ["1", "f", "f, δ"] {
        let told = contains("is the same at all states, and tells no motions apart");
        basins(&["--by", constant]).code(2).stderr(told);
    }
    let lost = basins(&["--by", "ln(x), p"]).code(2);
    lost.stderr(contains("`ln(x)` has no value").and(contains("singular").not()));
    let over = |range: &str| {
        let wish = ["--section", "sin(t) = 0", "--over", range, "--axes", "x", "--count", "2"];
        let few = ["--crossings", "2", "--skip", "0"];
        liouville(&[&["motion", "diagram"], &forced[2..], &wish, &few].concat()).assert().code(2)
    };
    over("f=0.2..0.20000000000000000000001").stderr(contains("one number in f64"));
    over("f=-1e400..1e400").stderr(contains("too large for f64"));
    over("f=1e300..2e300").stderr(contains("overflow"));
}

#[test]
fn a_constraint_is_not_forgotten() {
    let text = "title = 'wall'\n[state]\nx = '0..2'\ny = '-1..1'\n[field]\n\"x'\" = 'y'\n\
                \"y'\" = '1 − x'\n[one-sided]\nfunction = 'x'\nreaction = '−1'\n[one-sided.field]\n\
                \"x'\" = '0'\n\"y'\" = '0'\n[[claim]]\nname = 'free'\ncontacts = []\n\
                state = { x = '1', y = '1/2' }\ntime = 20\n";
    let other = format!(
        "{text}[[claim]]\nname = 'order'\nexponent = 'zero'\nstate = {{ x = '1', y = '1/2' }}\ntime = 20\n"
    );
    let home = folder("wall", &[("wall.toml", text), ("other.toml", &other)]);
    let [wall, other] =
        ["wall.toml", "other.toml"].map(|file| home.join(file).display().to_string());
    let check =
        |file: &str, code| liouville(&["check", "--motion", "-v", file]).assert().code(code);
    let told = contains("no arrival, no leaving, under [one-sided]").and(contains("warning").not());
    check(&wall, 0).stdout(told);
    let told = contains("warning: verdicts speak of the field without [one-sided]");
    check(&other, 1).stdout(told.and(contains("leave out [one-sided]")));
    for wish in [
        &["exponents", &wall, "--start", "1,1/2", "--time", "20"][..],
        &["periodic", &wall, "--start", "1,1/2", "--time", "6.28"],
    ] {
        let told = contains("one-sided constraint");
        liouville(&[&["motion"], wish].concat()).assert().code(2).stderr(told);
    }
}

#[test]
fn a_state_off_the_level_is_said_to_be() {
    let eval = |state: &str| {
        let arguments = ["eval", "plane/unbalanced-ball", "--state", state];
        liouville(&arguments).assert().success()
    };
    let warning = "this state is off the level";
    eval("ω=[1,0,0] γ=[1,1,0]").stdout(contains(warning));
    eval("ω=[0.6,-0.8,1] γ=[0.8,0.6,0]").stdout(contains(warning).not());
    // Too near 0 for f64, and not undefined.
    let small = "title = 'small'\n[state]\nx = '0.5..1.5'\n[field]\n\"x'\" = '1'\n[[claim]]\n\
                 integral = 'x^1000000000000000000000'\n";
    let home = folder("small", &[("small.toml", small)]);
    let case = home.join("small.toml").display().to_string();
    let more = liouville(&["eval", &case, "--state", "x=1/2"]).assert().success();
    more.stdout(contains("is too large, or too near 0"));
}

#[test]
fn a_motion_that_ends_under_a_surface_with_functions_of_its_own_is_reported() {
    let field = "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x - 1/(x-1/2)'\n";
    let home = folder("ends", &[("ends.toml", field)]);
    let case = home.join("ends.toml").display().to_string();
    for surface in ["abs(y-1/7)=1/3", "1/(x-1/3)=2"] {
        liouville(&["motion", "section", &case, "--section", surface, "--axes", "x,y"])
            .args(["--start", "x=1 y=0", "--crossings", "400", "--direction", "both"])
            .assert()
            .stderr(contains("panicked").not().and(contains("the program failed").not()));
    }
}
