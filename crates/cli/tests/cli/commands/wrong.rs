//! Wrong input: what the program says of it, and its exit code.

use predicates::str::contains;

use crate::commands::{GOOD, folder, liouville};

/// Each case: the mistake, the message, and the remedy it offers.
#[test]
fn wrong_input_gets_a_clear_message_and_exit_code_2() {
    let head = "title = 'x'\nsystem = 'rubber-plane'\n";
    let body = "[parameters]\nm = 1\nR = 2\nI = [1, 2, 2.5]\n[body]\nshape = 'ball'\n";
    let claim = |text: &str| format!("{head}{body}[[claim]]\nintegral = '{text}'\n");
    let field = |text: &str| format!("title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\n{text}");
    let lagrangian = |system: &str, text: &str| {
        let state = "x = '-1..1'\ny = '-1..1'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n";
        format!("title = 'x'\nsystem = '{system}'\n[state]\n{state}[lagrangian]\n{text}\n")
    };
    let turning = |claim: &str| field(&format!("[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n{claim}\n"));
    let skate = "kinetic = \"x'² + y'²\"\nconstraints = [\"x*y' = x'\"]";
    let quasi = "kinetic = 'y²'\nquasi-velocities = ['y']\nalgebra = 'so(4)'";
    let exists = |more: &str, kind: &str| {
        format!("{head}{body}{more}[[claim]]\n{kind}-density = 'exists'\n")
    };
    let moved = "[state]\ns = '-1..1'\n[field]\n\"s'\" = '2*s'\n";
    let twisted = exists("", "position")
        .replace("shape = 'ball'", "contact = 'vec(−γ2*(1 + γ1), γ1*(1 + γ1), 0)'");
    let bent = "title = 'x'\nsystem = 'nonholonomic'\n[state]\nx = '1..2'\nu = '1..2'\n[field]\n\"x'\" = 'u²'\n\
                [lagrangian]\nkinetic = 'u^4/2'\npotential = 'x'\nquasi-velocities = ['u']\n";
    let deep = format!("{}γ{}", "(".repeat(100_000), ")".repeat(100_000));
    let cases: Vec<(&str, String, &str, &str)> = vec![
        ("empty", String::new(), "the file is empty", "liouville new"),
        ("not-toml", "title = ".into(), "not-toml.toml:1", ""),
        ("no-system", "title = 'x'\n".into(), "has no `system`", "rubber-plane"),
        ("system", "title = 'x'\nsystem = 'rubber-plain'".into(), "unknown system", "rubber-plane"),
        (
            "system-hamiltonian",
            "title = 'x'\nsystem = 'hamiltonian'".into(),
            "unknown system",
            "the table [hamiltonian] is enough",
        ),
        (
            "key",
            format!("titel = 'x'\n{head}{body}"),
            "unknown key `titel`",
            "did you mean `title`",
        ),
        ("unknown-name", claim("Jtild*ω"), "unknown name", ""),
        ("times", claim("2*m*R(γ,ω)"), "missing `*`", "write `R*(γ,ω)`"),
        ("kinds", claim("ω3 + γ"), "scalar", ""),
        ("bracket", claim("((γ,ω)"), "bracket", ""),
        ("weights", claim("(γ,γ) + ω3"), "unequal weight", "check-weights"),
        (
            "vector",
            claim("γ").replace("integral", "density"),
            "should be a scalar, but this is a vector",
            "",
        ),
        ("deep", claim(&deep), "nested too deeply", ""),
        ("nan", format!("{head}{}", body.replace("m = 1", "m = nan")), "is not a number", ""),
        ("range", format!("{head}{}", body.replace("m = 1", "m = '2..1'")), "is empty", ""),
        (
            "singular",
            format!("{head}{}", body.replace("m = 1", "m = 0").replace("[1, 2, 2.5]", "[0, 0, 0]")),
            "equations of motion are undefined",
            "singular inertia",
        ),
        (
            "unreachable",
            field("[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n[level]\nequations = ['x² + y² = -1']\n"),
            "no state on the level set",
            "[level]",
        ),
        (
            "leaves",
            field("[field]\n\"x'\" = '1'\n\"y'\" = 'x'\n[level]\nequations = ['x² + y² = 1']\n"),
            "the level set is not invariant",
            "correct the equation",
        ),
        (
            "criterion",
            field("[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n[[claim]]\nanalytic-density = 'exists'\n"),
            "decided by a criterion",
            "",
        ),
        (
            "damped",
            exists("moment = '−ω'\n", "analytic"),
            "`moment` depends on `ω`",
            "state a density instead",
        ),
        ("added", exists(moved, "analytic"), "does not cover variables added by [state]", "without them"),
        ("growing", exists(moved, "position"), "leaves out the divergence", "without them"),
        ("twisted", twisted, "∂r is not symmetric across γ", "state a density instead"),
        (
            "bent",
            bent.into(),
            "the rate of `x` is not linear in the velocities",
            "other quasi-velocities",
        ),
        (
            "block",
            turning("[variables]\nX = 'x'\nY = 'y'\n[poisson]\n'X,Y' = '1'\n'Y,X' = '1'"),
            "the block Y,X is given already",
            "follows from skewness",
        ),
        (
            "own-potential",
            format!("{head}{body}potential = 'U'"),
            "`potential` depends on `U`, which it determines",
            "by γ, h and the parameters",
        ),
        (
            "own-surface",
            format!("{head}[let]\nw = '2*h'\n{body}").replace("shape = 'ball'", "support = 'w'"),
            "`support` depends on `h`, which it determines",
            "by γ and the parameters",
        ),
        (
            "own-surface-of-a-ball",
            "title = 'x'\nsystem = 'ball-on-surface'\n[parameters]\nm = 1\nR = 2\nmu = 1\n[body]\nsupport = 'h'"
                .into(),
            "`support` depends on `h`, which it determines",
            "by γ and the parameters",
        ),
        (
            "own-reaction",
            lagrangian("nonholonomic", "kinetic = \"x'² + y'²\"\nconstraints = ['μ = 0']"),
            "each side may depend on the state and parameters only, not on `μ`",
            "",
        ),
        ("nothing-moved", turning("[[claim]]\nreversor = {}"), "names no variable to transform", "image"),
        ("no-map", turning("[[claim]]\nmap = {}\nfield = {}"), "names no new variable", "give one"),
        (
            "no-time",
            turning("[[claim]]\nsymmetry = { x = '0*x', y = '0*y' }\ntime = '1 − 1'"),
            "`time` is 0",
            "t → λt",
        ),
        (
            "moving-time",
            turning("[[claim]]\nsymmetry = { x = 'x', y = 'y' }\ntime = '1 + x − x'"),
            "`time` depends on the state",
            "write λ by numbers and parameters",
        ),
        (
            "surface",
            "title = 'x'\nsystem = 'ball-on-surface'\n[parameters]\nm = 1\nR = 2\nmu = 1\n[body]\nsurface = '(r,γ)'"
                .into(),
            "may depend on r and parameters only, not on `γ`",
            "",
        ),
        (
            "own-energy",
            lagrangian("nonholonomic", "kinetic = \"x'² + y'²\"\npotential = 'energy'"),
            "may depend on the state and parameters only",
            "",
        ),
        (
            "feedback",
            format!("{head}{body}moment = \"ω'\""),
            "feedback.toml:9:10",
            "by the state, r, r' and γ'",
        ),
        (
            "tiny-range",
            field("[field]\n").replace("x = '-1..1'", "x = '-1e-400..1e-400'"),
            "beyond the range of f64",
            "-2..2",
        ),
        (
            "singular-level",
            turning("[level]\nequations = ['(x*exp(x) + y*exp(y))*(exp(x*exp(x) + y*exp(y)) − 1) = 0']"),
            "no state on the level set",
            "may not all vanish",
        ),
        (
            "left-squares",
            turning("[level]\nequations = ['x² + (y − 1)² = 0']"),
            "left-squares.toml:9:15",
            "the motion stays on it",
        ),
        ("no-level", turning("[level]\nequations = ['1 = 0']"), "contains no state variable", "leave it out"),
        (
            "open-level",
            turning("[level]\nequations = ['y = ∫(x, x)']"),
            "contains an ∫, whose constant is open",
            "write the antiderivative out",
        ),
        (
            "open-point",
            turning("[[claim]]\nfixed-point = { x = '∫(1, 2)' }"),
            "a point cannot contain ∫",
            "write the antiderivative out",
        ),
        (
            "open-slope",
            turning("[parameters]\ne = '1..2'\n[[claim]]\nlimit = '∫(e*x, x)'\nequals = '∫(0*x, x)'\nslope = '0'\nparameter = 'e'"),
            "the slope of an ∫ by a parameter is open",
            "write the antiderivative out",
        ),
        ("kinetic", lagrangian("nonholonomic", ""), "has no `kinetic`", "add kinetic"),
        ("multipliers", lagrangian("vakonomic", skate), "0 multipliers", "multipliers = [\"λ\"]"),
        ("algebra", lagrangian("nonholonomic", quasi), "is not a known algebra", "so(3)"),
        ("variables", turning("[[claim]]\ncasimir = 'x'"), "has none", "add [poisson]"),
        (
            "two",
            turning("[[claim]]\nintegral = 'x'\ndensity = '1'"),
            "this claim makes 2 statements",
            "a [[claim]] for each",
        ),
        ("rate", field("[field]\n\"x'\" = 'y'\n"), "has no rate for `y`", "y'"),
    ];
    for (name, text, message, remedy) in cases {
        let path = folder("wrong", &[(&format!("{name}.toml"), &text)]);
        liouville(&["check", path.to_str().expect("UTF-8")])
            .assert()
            .code(2)
            .stdout(contains(message))
            .stdout(contains(remedy));
    }
    liouville(&["check", "no-such-folder"]).assert().code(2).stdout(contains("cannot read"));
    let huge = format!("#{}", "x".repeat(5 << 20));
    let path = folder("huge", &[("huge.toml", &huge)]);
    liouville(&["check", path.to_str().expect("UTF-8")]).assert().code(2).stdout(contains("bytes"));
}

#[test]
fn eval_refuses_what_it_does_not_understand() {
    let path = folder("eval", &[("good.toml", GOOD)]).join("good.toml");
    let path = path.to_str().expect("UTF-8");
    let refused = [
        (vec!["--set", "q=1"], "there is no parameter `q`"),
        (vec!["--set", "m"], "not of the form name=value"),
        (vec!["--state", "ω=[1,2]"], "has 3 components"),
        (vec!["--state", "ω=[1,2,3]"], "no value for `γ`"),
        (vec!["--state", "ω=[1,2,x] γ=[0,0,1]"], "is not a number"),
        (vec!["--state", "v=[1,2,3]"], "is not a state variable"),
    ];
    for (options, message) in refused {
        let mut arguments = vec!["eval", path];
        arguments.extend(&options);
        liouville(&arguments).assert().code(2).stderr(contains(message));
    }
    let bare = "title = 'x'\n[state]\nx = '-1..1'\n[field]\n\"x'\" = '-x'\n";
    let path = folder("bare", &[("bare.toml", bare)]).join("bare.toml");
    liouville(&["eval", path.to_str().expect("UTF-8"), "--set", "x=1"])
        .assert()
        .code(2)
        .stderr(contains("this case has no parameters"));
}

#[test]
fn files_that_are_not_utf_8_have_a_place() {
    let place = folder(
        "latin",
        &[(
            "good.toml",
            "title = 'a'\n[state]\nx = '1..2'\n[field]\n\"x'\" = 'x'\n[[claim]]\nintegral = '1'\n",
        )],
    );
    let file = |name: &str| place.join(name).to_str().expect("UTF-8").to_string();
    let (good, bad, table) = (file("good.toml"), file("bad.toml"), file("bad.csv"));
    std::fs::write(&bad, b"title = 'a'\nsource = 'Poincar\xe9'\n").expect("a file");
    std::fs::write(&table, b"x\n1\n\xe9\n").expect("a file");
    liouville(&["check", &bad])
        .assert()
        .code(2)
        .stdout(contains("byte 0xE9 in line 2 is not UTF-8"))
        .stdout(contains("bad.toml:2:18"))
        .stdout(contains("with the encoding UTF-8"));
    for arguments in [
        ["motion", "orbit", &good, "--starts", &table],
        ["check", &good, "-q", "--settings", &table],
    ] {
        liouville(&arguments)
            .assert()
            .code(2)
            .stderr(contains("is not UTF-8"))
            .stderr(contains("with the encoding UTF-8"));
    }
}

#[test]
fn starts_without_a_value_are_told_alike_by_all_commands() {
    let field = "title = 'a'\n[parameters]\na = '1..2'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\
                 \"x'\" = 'a*y + 1/x'\n\"y'\" = '-x'\n";
    let folder = folder("no-value", &[("field.toml", field)]);
    let case = folder.join("field.toml").display().to_string();
    let set = ["--set", "a=1"];
    for command in [
        &["orbit", &case, "--start", "0,1", "--time", "1"][..],
        &["section", &case, "--start", "0,1", "--section", "y = 0"],
        &["exponents", &case, "--start", "0,1", "--time", "1"],
        &["periodic", &case, "--start", "0,1", "--section", "y = 0"],
        &["periodic", &case, "--start", "0,1", "--time", "1"],
    ] {
        let found = liouville(&[&["motion"], command, &set].concat()).assert().code(2);
        found
            .stderr(contains("`a*y + 1/x` has no value at the start, x = 0.0, y = 1.0"))
            .stderr(contains("choose another start"));
    }
    let level = field.replace("a*y + 1/x", "a*y") + "[level]\nequations = ['x² + 2*y² = 1']\n";
    let folder = crate::commands::folder("not-kept", &[("level.toml", &level)]);
    let case = folder.join("level.toml").display().to_string();
    for command in [
        &["orbit", &case, "--time", "1"][..],
        &["section", &case, "--section", "y = 0"],
        &["exponents", &case, "--time", "1"],
        &["periodic", &case, "--start", "1,0", "--section", "y = 0"],
        &["continue", &case, "--start", "1,0", "--section", "y = 0", "--parameter", "a"],
        &["diagram", &case, "--over", "a=1..2", "--section", "y = 0"],
        &["rotation", &case, "--section", "y = 0", "--from", "0,1", "--to", "0,2"],
        &["basins", &case, "--x", "x=-1..1", "--y", "y=-1..1"],
        &["chart", &case, "--x", "a=1..2", "--y", "a=1..2"],
    ] {
        let found = liouville(&[&["motion"], command].concat()).assert().code(2);
        found.stderr(contains("the motion leaves `x² + 2*y² = 1` at rate"));
    }
}

#[test]
fn values_that_are_not_of_the_form_declared_are_refused() {
    let text = "title = 'x'\n[parameters]\nJ = 'symmetric(2, 1..2)'\nK = 'skew(2, 1..2)'\n[state]\n\
        x = 'vector(2, -1..1)'\n[field]\n\"x'\" = 'K*(J*x)'\n";
    let home = folder("forms", &[("forms.toml", text)]);
    let path = home.join("forms.toml").display().to_string();
    for (set, message, remedy) in [
        ("J=[[1,2],[3,4]]", "J[1,2] and J[2,1] do not fit", "give a matrix of this form"),
        ("K=[[1,2],[-2,0]]", "K[1,1] is not 0", "give a matrix of this form"),
        ("J12=3", "`J12` is an entry of `J`, and is not set alone", "--set 'J=[[…], […]]'"),
    ] {
        let run = liouville(&["eval", &path, "--set", set]).assert().code(2);
        run.stderr(contains(message)).stderr(contains(remedy));
    }
    liouville(&["eval", &path, "--set", "J=[[1,2],[2,4]]"]).assert().code(0);
    let over = ["motion", "diagram", &path, "--over", "K1=0..1", "--section", "x1 = 0"];
    let run = liouville(&over).assert().code(2);
    run.stderr(contains("`K1` is 0 in all values of `K`")).stderr(contains("vary another entry"));
}
