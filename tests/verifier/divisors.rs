//! Divisors of equations of motion: on levels, for listed values, at limits and images, and in built-in bodies.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

use Verdict::{Proved, Refuted, Undecided};

fn verdicts(text: &str) -> Vec<Verdict> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report =
        judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    report.claims.iter().map(|claim| claim.verdict).collect()
}

/// Writes a Lagrangian with coordinates and some free ones more, all in −2..2 but for those given with ranges.
fn lagrangian(
    (before, coordinates, free): (&str, &[&str], usize),
    kinetic: &str,
    (potential, after): (&str, &str),
) -> String {
    let names: Vec<String> = coordinates
        .iter()
        .map(ToString::to_string)
        .chain((0..free).map(|k| format!("u{k}")))
        .collect();
    let with_range = |name: &String| {
        let (name, range) = name.split_once('=').unwrap_or((name, "-2..2"));
        format!("\"{name}\" = '{range}'\n\"{name}'\" = '-2..2'\n")
    };
    let state: String = names.iter().map(with_range).collect();
    let more: String = (0..free).map(|k| format!(" + u{k}'^2/2")).collect();
    format!(
        "title = 'x'\ncheck-weights = false\n[parameters]\n{before}\n[state]\n{state}[lagrangian]\n\
         kinetic = \"{kinetic}{more}\"\npotential = \"{potential}\"\n{after}"
    )
}

fn rate(name: &str, value: &str) -> String {
    format!("[[claim]]\nrate = \"{name}\"\nequals = \"{value}\"\nexpect = 'open'\n")
}

fn claim(text: &str) -> String {
    format!("[[claim]]\n{text}\nexpect = 'open'\n")
}

#[test]
fn a_minor_that_is_0_on_a_part_of_a_level_hides_no_state() {
    for range in ["-0.001..2", "-1..2"] {
        let level = "[level]\nequations = [\"s*(s - 1) = 0\", \"s' = 0\", \"x' = 0\"]\n";
        let claims = [
            rate("y'", "-1"),
            rate("y'", "s - 2"),
            claim("integral = \"(y'^2/2 + y)*s + (s - 1)*y'\""),
        ];
        let s = format!("s={range}");
        let text = lagrangian(
            ("", &[&s, "x", "y"], 0),
            "s*x'^2/2 + x'*y' + 200*y'^2 + s'^2/2",
            ("x + 400*y", &(level.to_string() + &claims.concat())),
        );
        // For s = 1 the masses are [[1, 1], [1, 400]], and −400 y'' = 0 for x' = 0.
        let found = verdicts(&text);
        assert!(found[1] == Refuted && found[2] == Refuted, "{range}: {found:?}");
    }
    let only = "[level]\nequations = [\"s = 0\", \"s' = 0\", \"x' = 0\"]\n";
    let text = lagrangian(
        ("", &["s=-0.001..2", "x", "y"], 0),
        "s*x'^2/2 + x'*y' + 200*y'^2 + s'^2/2",
        ("0*x", &(only.to_string() + &rate("y'", "0") + &rate("y'", "s - 1"))),
    );
    assert_eq!(verdicts(&text), [Proved, Refuted]);
}

#[test]
fn a_minor_that_is_0_where_one_of_several_equations_holds_hides_no_state() {
    // For γ1 < 0 on |γ| = 1 the first mass is 0, and the determinant −1.
    let text = "title = 'x'\nsystem = 'nonholonomic'\ncheck-weights = false\n[state]\n'ω' = 'vector(-2..2)'\n\
                'γ' = 'vector(-2..2)'\n[field]\n\"γ'\" = 'γ × ω'\n[lagrangian]\nquasi-velocities = ['ω']\n\
                algebra = 'so(3)'\nkinetic = '(((γ,γ)-1+γ1+|γ1|)*ω1^2 + 2*ω1*ω2 + 400*ω2^2 + ω3^2)/2'\n[level]\n\
                equations = ['|γ| = 1', 'γ1 = 1/2', 'ω = 0']\n[[claim]]\n\
                identity = \"ω1'*(|γ1|-γ1) = ω1'*(|γ1|-γ1) + γ1 - |γ1|\"\nwhere = '|γ| = 1'\nexpect = 'open'\n";
    assert_eq!(verdicts(text), [Refuted]);
}

#[test]
fn holonomic_constraints_leave_divisors_known() {
    // |q|² is a divisor that is 0 in space, and l² on the level.
    let text = lagrangian(
        ("l = '1/2..1'\ng = '1..2'", &["x", "y", "z"], 5),
        "(x'^2 + y'^2 + z'^2)/2",
        (
            "g*z",
            &("constraints = [\"x^2 + y^2 + z^2 = l^2\"]\n".to_string()
                + &claim("integral = \"energy\"")
                + &claim("integral = \"x*y' - y*x'\"")
                + &claim("integral = \"x*z' - z*x'\"")),
        ),
    );
    let text = text.replace("title = 'x'\n", "title = 'x'\nsystem = 'nonholonomic'\n");
    assert_eq!(verdicts(&text), [Proved, Proved, Refuted]);
    // A parallelogram: the first minor of the reactions is 0 where all rods lie in one line.
    let linkage = "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\na = '0.5..1'\nb = '1.5..2'\n[state]\nA = '-3..3'\n\
                   B = '-3..3'\nC = '-3..3'\n\"A'\" = '-1..1'\n\"B'\" = '-1..1'\n\"C'\" = '-1..1'\n[lagrangian]\n\
                   kinetic = \"(A'^2+B'^2+C'^2)/2\"\nconstraints = ['a*cos(A) + b*cos(B) - a*cos(C) = b', \
                   'a*sin(A) + b*sin(B) - a*sin(C) = 0']\n";
    let claims = claim("integral = 'energy'") + &claim("identity = \"A' = C'\"");
    assert_eq!(verdicts(&(linkage.to_string() + &claims)), [Proved, Refuted]);
}

#[test]
fn a_listed_value_for_which_a_minor_is_0_counts() {
    for (mass, free) in [("10", 5), ("10", 12), ("10^16", 5)] {
        let wrong = format!("(a-1)/(1-{mass}*(a-1)) + (a-3)");
        let claims = rate("z'", &wrong)
            + &claim("identity = \"x'' + y'' = a - 3\"")
            + &claim("integral = 'energy'");
        let kinetic = format!("x'^2/2 + x'*y' + a*y'^2/2 + y'*z' + {mass}*z'^2/2");
        let text =
            lagrangian(("a = 'one of 1, 3'", &["x", "y", "z"], free), &kinetic, ("z", &claims));
        assert_eq!(verdicts(&text), [Refuted, Refuted, Proved], "{mass}, {free}");
    }
}

#[test]
fn divisors_are_asked_at_limits_and_images() {
    let parameters = "eps = '0..1'\nk = '-1..1'";
    for (kinetic, free) in
        [("(eps + k + |k|)*x'^2/2", 1), ("(eps + k + |k|)*x'^2/2 + (2 + e^(|k|))*y'^2/2", 6)]
    {
        // x'' = −1 for k < 0.
        let limit = claim("limit = \"x''\"\nparameter = 'eps'\nequals = '0'");
        let text = lagrangian((parameters, &["x", "y"], free), kinetic, ("eps*x", &limit));
        let text = if free == 1 { text.replace("k|)*x'^2/2", "k|)*x'^2/2 + y'^2/2") } else { text };
        assert_eq!(verdicts(&text), [Undecided], "{kinetic}");
        let images = claim("symmetry = { eps = '0' }")
            + &claim("symmetry = { x = 'x + 1', eps = 'eps*0' }")
            + &claim("symmetry = { x = 'x + 1' }");
        let text = lagrangian((parameters, &["x", "y"], free), kinetic, ("0*x", &images));
        let text = if free == 1 { text.replace("k|)*x'^2/2", "k|)*x'^2/2 + y'^2/2") } else { text };
        assert_eq!(verdicts(&text)[..2], [Undecided, Undecided], "{kinetic}");
    }
    // 2 + e^|k| is positive at sight.
    let text = lagrangian(
        ("k = '-1..1'", &["x"], 8),
        "(2 + e^(|k|))*x'^2/2",
        ("x", &(claim("integral = 'energy'") + &rate("x'", "-1/(2 + e^(|k|))"))),
    );
    assert_eq!(verdicts(&text), [Proved, Proved]);
}

#[test]
fn rates_are_asked_on_cells_that_no_drawn_state_meets() {
    // For k > b the first mass is 0, and the determinant −1.
    for (parameters, k) in [("k = '-1..1'\nb = '9999/10000'", "k"), ("b = 3", "t")] {
        let claims = claim(&format!("identity = \"x''*(|{k}-b| + {k} - b) = 0\""))
            + &claim("integral = 'energy'");
        let kinetic = format!("(|{k}-b| - {k} + b)*x'^2/2 + x'*y' + 200*y'^2");
        let text = lagrangian((parameters, &["x", "y"], 7), &kinetic, ("y", &claims));
        let found = verdicts(&text);
        assert_ne!(found[0], Proved, "{k}: {found:?}");
    }
}

#[test]
fn bodies_have_no_states_where_their_rates_have_no_value() {
    // A ball as large as its cavity, D_T = 0.
    let cavity = "title = 'x'\nsystem = 'rubber-sphere'\n[parameters]\nm = '0.5..2'\nR = 'one of 1/2, 1, 3/2'\n\
                  I = 'inertia(0.5..3)'\nk = -1\n[body]\nshape = 'ball'\n";
    let claims = claim("identity = '|R-1| = 1/2'") + &claim("integral = 'energy'");
    let found = verdicts(&(cavity.to_string() + &claims));
    assert!(found[0] != Refuted && found[1] == Proved, "{found:?}");
    // A surface that is a point.
    let surface = "title = 'x'\nsystem = 'ball-on-surface'\n[parameters]\nm = '0.5..2'\nR = '0.5..1'\n\
                   'μ' = '0.5..1'\na = 'one of 0, 1'\n[body]\nprofile = 'a'\n";
    let claims = claim("identity = 'a = 1'") + &claim("integral = '(M,M)'");
    assert_eq!(verdicts(&(surface.to_string() + &claims)), [Proved, Proved]);
    // A body without moments of inertia.
    let light = "title = 'x'\nsystem = 'rolling-plane'\n[parameters]\nm = '0.5..2'\nR = '0.5..2'\n\
                 mu = 'one of 0, 1'\nI = 'mu*E'\n[body]\nshape = 'ball'\n";
    let claims = claim("identity = 'mu = 1'") + &claim("density = '1'");
    assert_eq!(verdicts(&(light.to_string() + &claims)), [Proved, Proved]);
    // A plate without inertia in its face, whose face is at the height of its centre.
    let plate = "title = 'x'\nsystem = 'flat-base'\n[parameters]\nm = '0.5..2'\nk = '0.5..1'\nz = 'one of 0, 1'\n\
                 c = '0.5..1'\nI = 'diag(0,0,c)'\n[body]\nheight = 'z'\n";
    let claims = claim("identity = 'z = 1'") + &claim("integral = 'energy'");
    assert_eq!(verdicts(&(plate.to_string() + &claims)), [Proved, Proved]);
    // D_T = 0 at the image alone.
    let image = "title = 'x'\nsystem = 'rolling-sphere'\n[parameters]\nm = '0.5..2'\nb1 = '0.5..2'\nb2 = '0.5..2'\n\
                 b3 = '0.5..2'\nB = 'diag(b1,b2,b3)'\nI = 'inertia(0.5..3)'\nk = '-sqrt(b3)/b1'\n[body]\n\
                 shape = 'ellipsoid'\n";
    let claims = claim("symmetry = {'ω' = '[0,0,0]', 'γ' = '[0,0,1]'}")
        + &claim("symmetry = {'ω' = '[0,0,0]', 'γ' = '[0,0,2*sin(pi/6)]'}");
    let found = verdicts(&(image.to_string() + &claims));
    assert!(found.iter().all(|own| *own != Proved), "{found:?}");
}
