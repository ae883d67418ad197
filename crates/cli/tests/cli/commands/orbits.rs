//! Motions of any system: samples as data, sections by surfaces, spectra, closed orbits.

use std::fs;
use std::path::Path;

use predicates::str::contains;
use serde_json::Value;

use crate::commands::{folder, json, liouville};

const LORENZ: &str = r#"
title = "Lorenz"
system = "field"
[parameters]
s = 10
r = 28
b = "8/3"
[state]
x = "-20..20"
y = "-20..20"
z = "0..40"
[field]
x = "s*(y - x)"
y = "x*(r - z) - y"
z = "x*y - b*z"
[[claim]]
name = "V"
integral = "x² + y² + z²"
expect = "fails"
"#;

const POLE: &str = r#"
title = "blows up"
system = "field"
[state]
x = "1..2"
[field]
x = "x²"
"#;

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().expect("UTF-8").to_string()
}

fn fails(arguments: &[&str], message: &'static str) {
    liouville(arguments).assert().code(2).stderr(contains(message));
}

#[test]
fn samples_are_written_as_csv_npy_and_json() {
    let folder = folder("samples", &[("pole.toml", POLE), ("starts.csv", "x\n1\n1/2\n")]);
    let (case, starts) = (path(&folder, "pole.toml"), path(&folder, "starts.csv"));
    let sampled = |name: &str, more: &[&str]| {
        let out = path(&folder, name);
        let arguments =
            ["motion", "orbit", &case, "--time", "3/4", "--every", "1/4", "--out", &out];
        liouville(&[&arguments, more].concat()).assert().success();
        fs::read(out).expect("a file")
    };
    // x = 1/(1/x₀ - t)
    let csv = sampled("one.csv", &["--start", "1", "--columns", "t, x, (x - 1)*1"]);
    let text = String::from_utf8(csv).expect("UTF-8");
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|x| x.parse().expect("a number")).collect())
        .collect();
    assert_eq!(text.lines().next(), Some("t,x,(x - 1)*1"));
    assert_eq!(rows.len(), 4, "0, 1/4, 1/2, 3/4");
    for row in &rows {
        assert!((row[1] * (1.0 - row[0]) - 1.0).abs() < 1e-14, "{row:?}");
        assert_eq!(row[2], row[1] - 1.0);
    }
    // as written: there is no √(1/2 − x)
    let unknown = sampled("none.csv", &["--start", "1", "--columns", "sqrt(1/2 − x)^2, 0*ln(−x)"]);
    let unknown = String::from_utf8(unknown).expect("UTF-8");
    assert!(unknown.lines().skip(1).all(|line| line == "NaN,NaN"), "{unknown}");
    let several = sampled("two.json", &["--starts", &starts]);
    let several: Value = serde_json::from_slice(&several).expect("JSON");
    assert_eq!(several["columns"], serde_json::json!(["start", "t", "x"]));
    let last = &several["rows"][7];
    assert!(last[0] == 1 && last[1] == 0.75, "the second start at the end: {last}");
    assert!((last[2].as_f64().expect("a number") - 0.8).abs() < 1e-15);
    let array = sampled("two.npy", &["--starts", &starts]);
    assert!(array.starts_with(b"\x93NUMPY") && array.len() % 64 == 8 * 8 * 3 % 64, "8 by 3");
    let digits = sampled("long.csv", &["--start", "1", "--precision", "double-double"]);
    let digits = String::from_utf8(digits).expect("UTF-8");
    assert!(digits.contains("1.3333333333333333333333333333"), "{digits}");
    let drawn = sampled("one.svg", &["--start", "1"]);
    let drawn = String::from_utf8(drawn).expect("UTF-8");
    assert!(drawn.contains("fill=\"none\" stroke=\"currentColor\""), "a line");
    let left: Vec<_> = fs::read_dir(&folder).expect("a folder").flatten().collect();
    assert!(
        left.iter().all(|entry| entry.path().extension().is_none_or(|ending| ending != "part")),
        "no temporary file"
    );
}

/// A harmonic oscillator with names that are easy to misread.
const SPRING: &str = r#"
title = "spring"
[state]
"q1" = "vector(2,-1..1)"
"q1'" = "vector(2,-1..1)"
[field]
"q1'" = "q1'"
"q1''" = "-q1"
[[claim]]
name = "twice the energy"
integral = "(q1,q1) + (q1',q1')"
"#;

#[test]
fn numbers_of_options_may_be_formulas_and_names_are_clear() {
    let folder = folder("formulas", &[("spring.toml", SPRING)]);
    let (case, out) = (path(&folder, "spring.toml"), path(&folder, "a.csv"));
    let orbit = ["motion", "orbit", &case, "--start", "1,0,0,sqrt(2)", "--time", "2*pi"];
    let columns = ["--columns", "t, q1, q1', twice the energy", "--out", &out];
    liouville(&[&orbit[..], &columns].concat()).assert().success();
    let text = fs::read_to_string(&out).expect("samples");
    let first = text.lines().next().expect("titles");
    assert_eq!(first, "t,q1[1],q1[2],q1'[1],q1'[2],twice the energy");
    let last: Vec<f64> = text
        .lines()
        .last()
        .expect("rows")
        .split(',')
        .map(|x| x.parse().expect("a number"))
        .collect();
    assert!((last[0] - std::f64::consts::TAU).abs() < 1e-12, "{last:?}");
    assert!((last[1] - 1.0).abs() < 1e-9 && (last[5] - 3.0).abs() < 1e-9, "{last:?}");
    fails(&["motion", "orbit", &case, "--start", "1 2 3 4"], "`1 2 3 4` is not a start");
}

const PLANAR: &str = r#"
title = "FitzHugh–Nagumo"
[state]
v = "-2..2"
w = "-2..2"
[field]
v = "v - v^3/3 - w + 1/2"
w = "(v + 7/10 - 8/10*w)/(25/2)"
"#;

#[test]
fn the_multiplier_of_a_planar_orbit_is_its_product() {
    let folder = folder("planar", &[("planar.toml", PLANAR)]);
    let case = path(&folder, "planar.toml");
    for section in ["w=0.5", "w=0.7", "w=0.9"] {
        let periodic = ["motion", "periodic", &case, "--start", "2,0.5", "--section", section];
        let found = json(&[&periodic[..], &["--direction", "up", "--json"]].concat(), 0);
        let text = found.to_string();
        let one = found["points"][0]["multipliers"][0].clone();
        let value = one["re"].as_f64().unwrap_or_else(|| panic!("{text}"));
        let error = one["error"].as_f64().unwrap_or_else(|| panic!("{text}"));
        // e^(-38.311264), below all roundings of the derivative.
        assert!((value / 2.299_479_02e-17 - 1.0).abs() < 1e-6, "{section}: {value}");
        assert!(error < 1e-6 * value, "{section}: {error}");
    }
}

#[test]
fn samples_that_cannot_be_written_say_why() {
    let folder = folder("no-samples", &[("pole.toml", POLE), ("starts.csv", "x\n1\nq\n")]);
    let case = path(&folder, "pole.toml");
    let orbit = |more: &[&str], message| {
        fails(&[&["motion", "orbit", &case, "--time", "1/2"], more].concat(), message);
    };
    let out = path(&folder, "x.csv");
    orbit(&["--out", "x.xyz"], "is none of .svg, .pdf, .png, .csv, .npy, .json");
    orbit(&["--out", "no/such/x.csv"], "in a folder that exists");
    orbit(&["--start", "1", "--columns", "t, y", "--out", &out], "unknown name `y`");
    orbit(&["--start", "1", "--columns", "t,,x", "--out", &out], "a column is empty");
    orbit(&["--start", "1,2"], "a start has 2 values, and the state has 1");
    orbit(&["--start", "1", "--every", "0", "--out", &out], "above 0");
    orbit(&["--start", "1", "--every", "1e-9", "--out", &out], "too many for one file");
    let starts = path(&folder, "starts.csv");
    orbit(&["--starts", &starts], "line 3: `q` is not a number");
    orbit(&["--starts", &starts, "--out", &starts], "a file that the command reads");
    let diagram = ["motion", "diagram", &case, "--over", "energy=1..2", "--starts", &starts];
    fails(&[&diagram[..], &["--out", &starts]].concat(), "a file that the command reads");
    let other = path(&folder, "./starts.csv");
    fails(&[&diagram[..], &["--out", &other]].concat(), "a file that the command reads");
    let branch = ["motion", "continue", &case, "--parameter", "energy", "--starts", &starts];
    fails(&[&branch[..], &["--out", &starts]].concat(), "a file that the command reads");
    let rotation = ["motion", "rotation", &case, "--from", "1", "--to", "2", "--out", &case];
    fails(&rotation, "is none of");
    fails(&["export", &case, "--to", "python", "--out", &case], "a file that the command reads");
    let bench = ["measure", "bench", &case, "--svg", &case];
    fails(&bench, "a file that the command reads");
    assert_eq!(fs::read_to_string(&case).expect("the case"), POLE, "it is as it was");
    let pole = ["motion", "orbit", &case, "--start", "1", "--time", "2", "--out", &out];
    fails(&pole, "has what comes before");
    let rows = fs::read_to_string(&out).expect("rows up to the pole");
    assert_eq!(rows.lines().count(), 501, "t < 1, by thousandths of 2");
}

#[test]
fn sections_by_a_surface_cross_it_to_rounding() {
    let folder = folder("surface", &[("lorenz.toml", LORENZ)]);
    let case = path(&folder, "lorenz.toml");
    let section = ["motion", "section", &case, "--section", "z = r - 1", "--start", "1,1,20"];
    let more = ["--axes", "z - 27, z', x", "--crossings", "50", "--direction", "down", "--json"];
    let report = json(&[&section[..], &more].concat(), 0);
    let crossings = report["orbits"][0]["crossings"].as_array().expect("crossings");
    assert_eq!(crossings.len(), 50);
    for met in crossings {
        let [off, rate] = [0, 1].map(|k| met["at"][k].as_f64().expect("a number"));
        assert!(off.abs() < 1e-13 && rate < 0.0 && met["rising"] == false, "{met}");
    }
    let drawn = |name: &str, threads: &str| {
        let out = path(&folder, name);
        let orbits = ["--orbits", "9", "--crossings", "20", "--threads", threads, "--out", &out];
        let arguments = [&section[..5], &orbits].concat();
        liouville(&arguments).assert().success();
        fs::read(out).expect("a file")
    };
    for ending in ["csv", "npy", "png", "svg"] {
        let [one, three] = ["1", "3"].map(|threads| drawn(&format!("{threads}.{ending}"), threads));
        assert!(one == three, "the same bytes with any threads: {ending}");
    }
    let wrong = |surface: &str, start: &str, message| {
        let arguments = ["motion", "section", &case, "--section", surface, "--start", start];
        fails(&arguments, message);
    };
    wrong("[x,y,z] = 0", "1,1,20", "a surface is given by a scalar");
    wrong("x = y = z", "1,1,20", "one equation");
    wrong("s = 10", "1,1,20", "does not depend on the state");
    wrong("z = q", "1,1,20", "unknown name `q`");
    wrong("z = -50", "1,1,20", "the motion never crosses the section");
    wrong("x = 0", "0,0,20", "stays in the surface");
    wrong("z = 1", "0,0,0", "is an equilibrium");
    wrong("z = 27", "1,2,3,4", "or the values of x, y");
}

#[test]
fn a_motion_that_leaves_for_good_does_not_meet_the_section_again() {
    let kepler = "title = 'Kepler'\n[state]\nx = '0.5..2'\ny = '-1..1'\nu = '-1..1'\nv = '-1..1'\n\
                  [hamiltonian]\nfunction = '(u²+v²)/2 - 1/sqrt(x²+y²)'\n\
                  pairs = [['x', 'u'], ['y', 'v']]\n";
    let folder = folder("leaves", &[("kepler.toml", kepler)]);
    let case = path(&folder, "kepler.toml");
    let section = ["motion", "section", &case, "--section", "x = 0", "--start", "1,0,3,0.1"];
    fails(&section, "the motion never crosses the section, up to t = 1.0000e15");
}

#[test]
fn sections_at_an_energy_start_from_their_axes() {
    let case = "classical/planar/henon-heiles-hamiltonian";
    let section = ["motion", "section", case, "--set", "ε=1/2", "--section", "x = 0"];
    // px follows from the energy.
    let more = ["--axes", "y, py, px", "--energy", "1/10", "--start", "0.1,0.2,0.9"];
    fails(&[&section[..], &more].concat(), "no state on the surface");
    let more = ["--axes", "y, py", "--energy", "1/10", "--start", "0.1,0.1", "--crossings", "20"];
    let report = json(&[&section[..], &more, &["--direction", "up", "--json"]].concat(), 0);
    let crossings = report["orbits"][0]["crossings"].as_array().expect("crossings");
    assert!(crossings.len() == 20 && report["orbits"][0]["others"].as_u64() >= Some(19));
    assert!(report["orbits"][0]["drift"].as_f64().expect("a number") < 1e-13);
    let energy = ["motion", "section", "classical/flows/van-der-pol-cycle", "--section", "p = 0"];
    fails(&[&energy[..], &["--energy", "1"]].concat(), "has no energy");
}

#[test]
fn spectra_sum_to_the_divergence() {
    let folder = folder("spectra", &[("lorenz.toml", LORENZ)]);
    let case = path(&folder, "lorenz.toml");
    let spectrum = |case: &str, start: &str, time: &str, bound: f64| {
        let arguments =
            ["motion", "exponents", case, "--start", start, "--spectrum", "--time", time, "--json"];
        let report = json(&arguments, 0);
        let found = &report["motions"][0];
        let exponents = found["exponents"].as_array().expect("exponents").iter();
        let exponents: Vec<f64> =
            exponents.map(|one| one["mean"].as_f64().expect("a number")).collect();
        let divergence = found["divergence"]["mean"].as_f64().expect("a number");
        let gap = exponents.iter().sum::<f64>() - divergence;
        assert!(gap.abs() < bound, "{exponents:?} against {divergence}");
        exponents
    };
    let lorenz = spectrum(&case, "1,1,20", "1000", 1e-9);
    assert!((lorenz[0] - 0.9056).abs() < 0.02 && lorenz[1].abs() < 0.01, "{lorenz:?}");
    // On a level of four dimensions the volumes differ by a function of the state, |∇F₀ ∧ ∇F₁|, whose
    // logarithm changes by less than 2.5 between the ends of 360 units of time.
    assert_eq!(spectrum("figures/fig-8", "3.4,0.3", "400", 2.5 / 360.0).len(), 4);
}

#[test]
fn multipliers_are_told_with_their_errors() {
    let points = |arguments: &[&str]| {
        let report = json(&[&["motion", "periodic"], arguments, &["--json"]].concat(), 0);
        report["points"].as_array().expect("points").clone()
    };
    let number = |point: &Value, key: &str| point[key].as_f64().expect("a number");
    let found = points(&["figures/fig-5", "--start", "pi/2,0", "--start", "0,0"]);
    for (point, larger) in found.iter().zip([503.536_151_124, 148.166_473_353_152_24]) {
        assert_eq!(point["kind"], "hyperbolic");
        let first = &point["multipliers"][0];
        assert!((number(first, "re") - larger).abs() < 1e-9, "{first}");
        assert!(number(first, "error") < 1e-10 && number(first, "error") > 0.0, "{first}");
        assert!((number(point, "product") - 1.0).abs() <= number(point, "product_error"));
    }
    let folder = folder("cycles", &[("lorenz.toml", LORENZ)]);
    let case = path(&folder, "lorenz.toml");
    // The shortest closed orbit of Lorenz' system (Viswanath 2003): T = 1.558652210716174764…
    let start = ["--start", "-13.76,-19.58,27"];
    let by_time = ["--time", "1.56"];
    let by_crossings = ["--section", "z = 27", "--period", "2"];
    for more in [&by_time[..], &by_crossings[..]] {
        let arguments = [&[case.as_str()], &start[..], more].concat();
        let found = points(&arguments);
        assert!((number(&found[0], "time") - 1.558_652_210_716_174_8).abs() < 1e-14);
        assert!((number(&found[0]["multipliers"][0], "re") - 4.712_947_273).abs() < 1e-8);
        assert_eq!(found[0]["kind"], "hyperbolic");
    }
    fails(
        &["motion", "periodic", &case, "--start", "1,1,20"],
        "the start does not determine a period",
    );
    fails(&["motion", "periodic", &case], "there is no start");
    // A separable system: closed orbits come in families.
    let family = ["motion", "periodic", "classical/planar/henon-heiles-hamiltonian"];
    let more = ["--set", "ε=1", "--section", "x = 0", "--energy", "1/12"];
    let start = ["--start", "x=0 y=0.1 px=0.3 py=0"];
    fails(&[&family[..], &more, &start].concat(), "degenerate");
}
