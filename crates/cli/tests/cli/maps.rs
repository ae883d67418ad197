//! Maps: what is claimed of them, what their claims do not say, and what refuses them.

use std::fs;
use std::path::PathBuf;

use assert_cmd::Command;
use liouville::case::Case;
use liouville::verdict::Verdict::{self, Proved, Refuted};
use liouville::verdict::{CaseReport, JudgeError, Options, judge};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;

fn judged(text: &str) -> Result<CaseReport, JudgeError> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default())
}

/// The verdicts on claims about a map of x, y, z.
fn verdicts(images: [&str; 3], level: &str, claims: &[&str]) -> Vec<Verdict> {
    let [x, y, z] = images;
    let claims: String = claims.iter().map(|claim| format!("[[claim]]\n{claim}\n")).collect();
    let text = format!(
        "title = 't'\n[parameters]\nk = '1.5..2'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n\
         [map]\nx = '{x}'\ny = '{y}'\nz = '{z}'\n{level}\n{claims}"
    );
    let report = judged(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    report.claims.iter().map(|claim| claim.verdict).collect()
}

#[test]
fn an_integral_is_compared_at_the_image_and_not_along_a_field() {
    // x' = −x has the integral x², which grows along the field −x; and xy is no integral of it.
    let found = verdicts(
        ["−x", "y + x²", "z"],
        "",
        &["integral = 'x²'", "integral = 'x*z'", "integral = '[x², z]'", "integral = 'x*sin(x)'"],
    );
    assert_eq!(found, [Proved, Refuted, Proved, Proved]);
}

#[test]
fn a_density_is_kept_with_either_orientation() {
    let claims = ["density = '1'", "density = 'x'", "density = '2 + x'", "density = '1 + x²'"];
    assert_eq!(verdicts(["−x", "y", "z"], "", &claims), [Proved, Proved, Refuted, Proved]);
    assert_eq!(verdicts(["x", "y + x²", "z"], "", &claims), [Proved, Proved, Proved, Proved]);
    assert_eq!(
        verdicts(["2*x", "y", "z"], "", &claims),
        [Refuted; 4],
        "no determinant is forgotten"
    );
    // ρ∘Φ det DΦ = ρ, and not its inverse
    let stretched = verdicts(["2*x", "y", "z"], "", &["density = '1/x'", "density = 'x'"]);
    assert_eq!(stretched, [Proved, Refuted]);
    let turned = verdicts(
        ["y", "x", "z*x"],
        "",
        &["density = '1/(z*x*y)'", "density = '1/z'", "density = 'z'"],
    );
    assert_eq!(turned, [Proved, Proved, Refuted]);
}

#[test]
fn on_a_level_the_volume_is_that_of_the_level() {
    let level = "[level]\nequations = ['z = 0']";
    let claims = ["density = '1'", "density = '1'\nwhere = 'everywhere'"];
    assert_eq!(verdicts(["x + y²", "y", "3*z"], level, &claims), [Proved, Refuted]);
    assert_eq!(verdicts(["3*x", "y", "z/3"], level, &claims), [Refuted, Proved]);
    // two equations, exchanged and stretched: the factor across the level is −6
    let level = "[level]\nequations = ['y = 0', 'z = 0']";
    assert_eq!(verdicts(["−x", "2*z", "3*y"], level, &claims), [Proved, Refuted]);
    assert_eq!(verdicts(["−x/6", "2*z", "3*y"], level, &claims), [Refuted, Proved]);
}

#[test]
fn what_a_map_does_across_the_level_does_not_matter() {
    let level = "[level]\nequations = ['z = 0']";
    let claims = ["density = '1'", "density = '1 + y²'", "density = '2 + x'"];
    for z in ["z²", "0*z", "z*(3 + x)"] {
        assert_eq!(verdicts(["x + y²", "y", z], level, &claims), [Proved, Proved, Refuted], "{z}");
        assert_eq!(verdicts(["2*x", "y", z], level, &claims), [Refuted; 3], "{z}");
    }
    // a circle, turned: its length is kept, whatever becomes of the radius
    let level = "[level]\nequations = ['x² + y² = 1']";
    let claims = ["density = '1'", "density = '2 + x'"];
    let turned = ["(3*x − 4*y)/5", "(4*x + 3*y)/5", "z + x"];
    assert_eq!(verdicts(turned, level, &claims), [Proved, Refuted]);
    let pulled = ["(3*x − 4*y)/5/(x² + y²)", "(4*x + 3*y)/5/(x² + y²)", "z + x"];
    assert_eq!(verdicts(pulled, level, &claims), [Proved, Refuted]);
}

#[test]
fn a_level_that_the_map_leaves_is_an_error() {
    let text = "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\n[map]\nx = '2*x'\ny = 'y'\n[level]\n\
                equations = ['x − y = 0']\n[[claim]]\nintegral = 'y'\n";
    assert!(matches!(judged(text), Err(JudgeError::NotMapped { .. })));
    assert!(judged(&text.replace("'2*x'", "'x'")).is_ok(), "the identity keeps every level");
    assert!(judged(&text.replace("x − y = 0", "x = 0")).is_ok(), "it changes along the field 2x");
}

#[test]
fn symmetries_commute_and_reversors_turn_around() {
    let shear = ["x + y", "y", "k*z"];
    let found = verdicts(
        shear,
        "",
        &[
            "symmetry = { x = 'x + 3*y' }",
            "symmetry = { x = '−x', y = '−y' }",
            "symmetry = { x = '−x' }",
            "symmetry = { y = '2*y', x = '2*x' }",
            "symmetry = { k = '2*k' }",
            "symmetry = { z = 'z²', k = 'k²' }",
        ],
    );
    assert_eq!(found, [Proved, Proved, Refuted, Proved, Refuted, Proved]);
    let found = verdicts(
        shear,
        "",
        &[
            "reversor = { x = '−x', k = '1/k' }",
            "reversor = { x = '−x' }",
            "reversor = { y = '−y', k = '1/k' }",
            // Φ∘R∘Φ = R, and R∘R ≠ 1
            "reversor = { x = '−2*x', y = '2*y', k = '1/k' }",
            "reversor = { k = '1/k' }",
        ],
    );
    assert_eq!(found, [Proved, Refuted, Proved, Refuted, Refuted]);
}

#[test]
fn a_parameter_does_not_become_a_function_of_the_state() {
    // x' = 2x, z' = kz: the image k + x would move with the state.
    let found = verdicts(
        ["2*x", "y", "z"],
        "",
        &["symmetry = { k = 'k + x' }", "symmetry = { k = 'k + y' }", "symmetry = { k = 'k + 1' }"],
    );
    assert_eq!(found, [Refuted, Proved, Proved]);
    let flow = "title = 't'\n[parameters]\nk = '1..2'\n[state]\nx = '-2..2'\n[field]\nx = 'x'\n\
                [[claim]]\nsymmetry = { k = 'k + x' }\n";
    assert_eq!(judged(flow).expect("judged").claims[0].verdict, Refuted, "nor along a flow");
}

#[test]
fn fixed_points_and_multipliers_are_those_of_the_map() {
    let found = verdicts(
        ["k*x", "y/k", "z + x*y"],
        "",
        &[
            "fixed-point = { z = 'k' }\nspectrum = ['k', '1/k', '1']",
            "fixed-point = { z = 'k' }\nspectrum = ['k − 1', '1/k − 1']",
            "fixed-point = { x = '1' }",
        ],
    );
    assert_eq!(found, [Proved, Refuted, Refuted]);
}

#[test]
fn cofactors_multiply() {
    let found = verdicts(
        ["x*(1 + y)", "y", "z"],
        "",
        &[
            "invariant-relation = 'x'\ncofactor = '1 + y'",
            "invariant-relation = 'x'\ncofactor = 'y'",
        ],
    );
    assert_eq!(found, [Proved, Refuted]);
}

/// The first mistake of a file, with its remedy.
#[track_caller]
fn mistake(text: &str) -> (String, String, usize) {
    let error = Case::parse(text, &[]).expect_err("the file has a mistake");
    let first = &error.mistakes()[0];
    (first.message(), first.help().unwrap_or_default(), first.line.unwrap_or(0) as usize)
}

const TURN: &str = "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\n[map]\nx = 'y'\ny = '−x'\n";

#[test]
fn what_speaks_of_a_flow_is_refused_at_its_place() {
    let claims = [
        "rate = 'x'\nequals = 'y'",
        "lax = { L = '[[x,y],[y,x]]', A = '[[x,y],[y,x]]' }",
        "symmetry-field = { x = 'x' }",
        "commutator = { of = { x = 'x' }, with = { x = 'y' } }",
        "map = { u = 'x' }\nfield = { u = 'u' }",
        "analytic-density = 'exists'",
        "position-density = 'exists'",
        "exponent = 'zero'\nstate = { x = '1' }\ntime = 10",
    ];
    for claim in claims {
        let (message, help, line) = mistake(&format!("{TURN}[[claim]]\n{claim}\n"));
        assert!(message.contains("the case is a map"), "{claim}: {message}");
        assert!(help.contains("claim"), "{claim}: {help}");
        assert_eq!(line, 9, "{claim}");
    }
    let poisson = "[variables]\nx = 'x'\ny = 'y'\n[poisson]\n'x,y' = '1'\n";
    for (claim, refused) in [("hamiltonian = 'x'", true), ("density-in-variables = '1'", true)] {
        let text = format!("{TURN}{poisson}[[claim]]\n{claim}\n");
        assert_eq!(mistake(&text).0.contains("the case is a map"), refused, "{claim}");
    }
    let bracket = format!("{TURN}{poisson}[[claim]]\nbracket = ['x', 'y']\nequals = '1'\n");
    assert_eq!(judged(&bracket).expect("judged").claims[0].verdict, Proved, "no flow is in it");
    let scaled = format!("{TURN}[[claim]]\nsymmetry = {{ x = '−x', y = '−y' }}\ntime = '2'\n");
    assert!(mistake(&scaled).0.contains("no time"));
}

#[test]
fn a_file_has_rates_or_images() {
    let both = format!("{TURN}[field]\nx = 'y'\ny = '−x'\n");
    assert!(mistake(&both).0.contains("[map] defines a discrete map"), "[field] comes first");
    let named = both.replace("title = 't'", "title = 't'\nsystem = 'map'");
    assert!(mistake(&named).0.contains("no rates"), "unless the system is named");
    let missing = TURN.replace("y = '−x'\n", "");
    let (message, help, _) = mistake(&missing);
    assert!(message.contains("no image of `y`") && help.contains("where it stays"), "{message}");
    let none = TURN.replace("[map]\nx = 'y'\ny = '−x'\n", "");
    let named = none.replace("title = 't'", "title = 't'\nsystem = 'map'");
    assert!(mistake(&named).1.contains("[map]"));
    let timed = format!("{TURN}[[claim]]\nintegral = 'x + t'\n");
    assert!(mistake(&timed).0.contains('t'), "a map has no time");
    let one_sided = format!("{TURN}[one-sided]\nfunction = 'x'\nreaction = 'y'\n");
    assert!(mistake(&one_sided).0.contains("needs a vector field"));
}

#[test]
fn an_antiderivative_has_no_place_at_two_points() {
    let open = "∫(exp(x²), x)";
    for claim in [
        format!("integral = '{open} + y'"),
        format!("density = '2 + {open}'"),
        format!("lyapunov = '{open}'"),
        format!("identity = 'x' = {open}'").replace("'x' =", "'x ="),
        format!("symmetry = {{ x = '{open}' }}"),
        format!("form = {{ x = '{open}' }}"),
    ] {
        let (message, _, line) = mistake(&format!("{TURN}[[claim]]\n{claim}\n"));
        assert!(message.contains("cannot contain ∫") && line == 9, "{claim}: {message}");
    }
    let image = TURN.replace("y = '−x'", &format!("y = '−x + {open}'"));
    assert!(mistake(&image).0.contains("cannot contain ∫"));
    let named = TURN.replace("y = '−x'", "y = '−x + I'") + &format!("[let]\nI = '{open}'\n");
    assert!(mistake(&named).0.contains("cannot contain ∫"), "nor by a name");
}

#[test]
fn commands_that_need_a_flow_refuse_a_map() {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("maps");
    fs::create_dir_all(&path).expect("a scratch folder");
    let file = path.join("turn.toml");
    let text = format!("{TURN}[[claim]]\nintegral = 'x² + y²'\n[section]\ng0 = 0\nenergy = 1\n");
    fs::write(&file, text).expect("a scratch file");
    let file = file.to_str().expect("UTF-8");
    let run = |arguments: &[&str]| {
        let mut command = Command::cargo_bin("liouville").expect("the binary is built");
        command.args(arguments);
        command.assert()
    };
    let out = path.join("out.png");
    let out = out.to_str().expect("UTF-8");
    for arguments in [
        &["section", file, "--out", out][..],
        &["periodic", file, "--start", "1,0.1", "--time", "4"],
        &["report", file],
        &["bench", file],
        &["chart", file, "--x", "x=0..1", "--y", "y=0..1", "--out", out],
    ] {
        run(arguments).code(2).stderr(contains("is a map"));
    }
    run(&["periodic", file, "--start", "1,0.1"]).code(0).stdout(
        contains("fixed point: elliptic").and(contains("proved: one point of least period 1")),
    );
    run(&["periodic", file, "--box", "x=-1..1", "--box", "y=-1..1"])
        .code(0)
        .stdout(contains("1 point of period 1").and(contains("proved: these are all")));
    run(&["periodic", file, "--box", "z=-1..1"]).code(2).stderr(contains("`z` is not a component"));
    run(&["exponents", file, "--start", "1,0.1"]).code(0).stdout(contains("n = 10000: regular"));
    run(&["search", file]).code(0).stdout(contains("x² + y²"));
    run(&["eval", file, "--state", "x=3 y=5"])
        .code(0)
        .stdout(contains("image").and(contains("det DΦ")));
    run(&["check", file, "--mutants"]).code(0);
}

#[test]
fn a_search_states_the_hypothesis_of_a_density() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("folded");
    fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("fold.toml");
    let text =
        "title = 't'\n[state]\nx = '-0.001..1'\ny = '0.5..1'\n[map]\nx = 'x²'\ny = 'y/(2*x)'\n";
    fs::write(&file, text).expect("written");
    Command::cargo_bin("liouville")
        .expect("the program")
        .arg("search")
        .arg(&file)
        .assert()
        .stdout(contains("density proved").and(contains("only where Φ is one-to-one")));
}
