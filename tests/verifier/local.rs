//! Claims at fixed points, inequalities and forms: what proves them, and what must not.

use liouville::case::Case;
use liouville::verdict::Verdict::{self, Proved, Refuted, Undecided};
use liouville::verdict::{Options, judge};

/// The verdicts on claims about a field of x, y, z, with parameters.
#[track_caller]
fn verdicts(rates: [&str; 3], rest: &str, claims: &[&str]) -> Vec<Verdict> {
    let [x, y, z] = rates;
    let claims: String = claims.iter().map(|claim| format!("[[claim]]\n{claim}\n")).collect();
    let text = format!(
        "title = 't'\n[parameters]\na = '0.5..2'\nb = '-1..1'\nk = 'one of 1, 2'\n[state]\n\
         x = '-2..2'\ny = '-2..2'\nz = '-2..2'\n[field]\nx = '{x}'\ny = '{y}'\nz = '{z}'\n{rest}\n{claims}"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = judge(&case, &Options::default()).unwrap_or_else(|e| panic!("{e}\n{text}"));
    report.claims.iter().map(|claim| claim.verdict).collect()
}

/// The first mistake of a claim about a field of three variables, with its remedy.
#[track_caller]
fn mistake(claim: &str) -> (String, String) {
    let text = format!(
        "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n[field]\nx = 'y'\ny = '−x'\nz = 'z'\n\
         [[claim]]\n{claim}\n"
    );
    let error = Case::parse(&text, &[]).expect_err("the claim has a mistake");
    let first = &error.mistakes()[0];
    (first.message(), first.help().unwrap_or_default())
}

#[test]
fn a_divergence_at_a_fixed_point_excludes_densities() {
    let at = ["no-density-near = { x = '0' }", "no-density-near = { x = '1' }"];
    assert_eq!(verdicts(["a*x", "−b*y + x²", "b*z"], "", &at), [Proved, Refuted]);
    // div v = 0 there says nothing: here the density 1 exists, and there 1/x² does not count
    assert_eq!(verdicts(["y", "−x", "0*z"], "", &at[..1]), [Undecided]);
    assert_eq!(verdicts(["x²", "y*x", "x*z"], "", &at[..1]), [Undecided]);
    // a + b and a − 1 vanish for some parameters, a + b + 2 for none; of a list each value counts
    assert_eq!(verdicts(["a*x", "b*y", "z²"], "", &at[..1]), [Undecided]);
    assert_eq!(verdicts(["a*x", "−y", "z²"], "", &at[..1]), [Undecided]);
    assert_eq!(verdicts(["a*x", "b*y", "2*z"], "", &at[..1]), [Proved]);
    assert_eq!(verdicts(["(2 − k)*x", "y²", "z²"], "", &at[..1]), [Undecided]);
    assert_eq!(verdicts(["(3 − k)*x", "y²", "z²"], "", &at[..1]), [Proved]);
    // no derivative, no divergence
    assert_eq!(verdicts(["|x|", "y", "z"], "", &at[..1]), [Undecided]);
}

#[test]
fn on_a_level_the_divergence_is_that_of_the_level() {
    let sphere = "[level]\nequations = ['x² + y² + z² = 1']";
    let at = [
        "no-density-near = { z = '1' }",
        "no-density-near = { z = '2' }",
        "no-density-near = { z = '1' }\nwhere = 'everywhere'",
    ];
    // a rotation, with what is across the sphere pulled to it: the area is kept
    let rotation =
        ["−y + x*(1 − x² − y² − z²)", "x + y*(1 − x² − y² − z²)", "z*(1 − x² − y² − z²)"];
    assert_eq!(verdicts(rotation, sphere, &at), [Undecided, Refuted, Proved]);
    let falling = ["−x*z", "−y*z", "1 − z²"];
    assert_eq!(verdicts(falling, sphere, &at[..2]), [Proved, Refuted]);
    // −1 − 1 along the level, and 2 across it
    let plane = "[level]\nequations = ['z = 0']";
    let at =
        ["no-density-near = { x = '0' }", "no-density-near = { x = '0' }\nwhere = 'everywhere'"];
    assert_eq!(verdicts(["−x", "−y", "2*z"], plane, &at), [Proved, Undecided]);
    // a point off the level is none
    assert_eq!(
        verdicts(["−x", "−y", "z²*(z − 1)"], plane, &["no-density-near = { z = '1' }"]),
        [Refuted]
    );
}

#[test]
fn of_a_map_the_determinant_excludes_densities() {
    let verdict = |x: &str, y: &str| {
        let text = format!(
            "title = 't'\n[parameters]\na = '0.5..0.9'\n[state]\nx = '-2..2'\ny = '-2..2'\n[map]\n\
             x = '{x}'\ny = '{y}'\n[[claim]]\nno-density-near = {{ x = '0' }}\n"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        judge(&case, &Options::default()).expect("judged").claims[0].verdict
    };
    assert_eq!(verdict("a*y + x²", "x"), Proved);
    assert_eq!(verdict("−a*y", "x"), Proved);
    assert_eq!(verdict("y", "x + y²"), Undecided, "det DΦ = −1 keeps a measure");
    assert_eq!(verdict("2*a*y", "x"), Undecided, "2a is 1 for some a");
    assert_eq!(verdict("y + 1", "x"), Refuted);
}

#[test]
fn eigenvalues_come_in_conjugate_pairs() {
    let rates = ["b*x − a*y", "a*x + b*y", "2*z"];
    let at = |spectrum: &str| format!("fixed-point = {{ x = '0' }}\n{spectrum}");
    let claims = [
        "spectrum = ['b ± a*i', '2']",
        "spectrum = ['2', 'b +/- i*a']",
        "spectrum = ['b ± (−a) * i', '2']",
        "spectrum = ['−b ± a*i', '2']",
        "spectrum = ['b ± 2*a*i', '2']",
        "spectrum = ['b ± a*i', '−2']",
        "spectrum = ['b + a', 'b − a', '2']",
        "spectrum = ['b ± a*i']",
        "characteristic-polynomial = ['−2*b − 2', 'a² + b² + 4*b', '−2*(a² + b²)']",
        "characteristic-polynomial = ['2*b + 2', 'a² + b² + 4*b', '2*(a² + b²)']",
        "spectrum = ['b ± a*i', '2']\ncharacteristic-polynomial = ['0', '0', '0']",
    ]
    .map(at);
    let claims: Vec<&str> = claims.iter().map(String::as_str).collect();
    let [yes, no] = [Proved, Refuted];
    assert_eq!(verdicts(rates, "", &claims), [yes, yes, yes, no, no, no, no, no, yes, no, no]);
    let turn = ["−y", "x", "0*z"];
    let claims = [
        "fixed-point = { x = '0' }\nspectrum = ['± i']",
        "fixed-point = { x = '0' }\nspectrum = ['± 1*i', '0']",
    ];
    assert_eq!(verdicts(turn, "", &claims), [Proved, Proved]);
}

#[test]
fn mistakes_in_eigenvalues_are_told() {
    let at = |rest: &str| mistake(&format!("fixed-point = {{ x = '0' }}\n{rest}"));
    assert!(at("spectrum = ['1 ± 2']").0.contains("not a multiple of i"));
    assert!(at("spectrum = ['1 ± q*i']").0.contains('q'));
    for sum in ["1 + 2*i", "i*1 + 2", "5 - 2*i", "1 − a + 2*i", "(1) + (2)*i"] {
        let told = at(&format!("spectrum = ['± {sum}']")).0;
        assert!(told.contains("not a multiple of i"), "{sum}: {told}");
    }
    assert!(at("spectrum = ['± −(1 + q)*i']").0.contains('q'), "a product with a sum in brackets");
    assert!(at("spectrum = ['± i', '± 2*i']").0.contains("4 eigenvalues are too many"));
    assert!(at("spectrum = ['[1, 2]']").0.contains("vector"));
    assert!(at("characteristic-polynomial = ['1', '2']").0.contains("2 coefficients"));
    assert!(mistake("density = 'none'").1.contains("no-density-near"));
    assert!(mistake("no-density-near = { q = '1' }").0.contains('q'));
}

#[test]
fn a_lyapunov_function_falls_at_all_states() {
    let focus = ["−x + a*y", "−a*x − y", "−z³"];
    let found = verdicts(
        focus,
        "",
        &[
            "lyapunov = 'x² + y²'\nequals = '−2*x² − 2*y²'",
            "lyapunov = 'x² + y² + z²'\nequals = '−2*x² − 2*y² − 2*z⁴'",
            "lyapunov = '−x² − y²'",
            "lyapunov = 'x² + y²'\nequals = '−x² − y²'",
            "lyapunov = 'x²'",
            "lyapunov = 'z²'",
            // it falls, and the formula does not show it
            "lyapunov = 'x² + y²'\nequals = '−2*x² − 2*y² + 0*x'",
        ],
    );
    assert_eq!(found, [Proved, Proved, Refuted, Refuted, Refuted, Proved, Proved]);
    // −x² + xy − y² has no term to be seen by; the form that is found has
    let mixed = ["−x/2 + y/2", "−y/2", "0*z"];
    let found = verdicts(
        mixed,
        "",
        &[
            "lyapunov = 'x² + y²'\nequals = '−x² + x*y − y²'",
            "lyapunov = 'x² + y²'\nequals = '−(x − y/2)² − 3/4*y²'",
            "lyapunov = 'x² + y²'\nequals = '−(x − y/2)² − y²/4'",
        ],
    );
    assert_eq!(found, [Proved, Proved, Refuted]);
}

#[test]
fn what_grows_in_a_corner_of_the_ranges_is_not_proved_to_fall() {
    // F' = (x − 1.99)(…): positive for x > 1.99 alone, which few states meet
    let found = verdicts(["1", "0*y", "0*z"], "", &["lyapunov = 'x²/2 − 1.9999*x'"]);
    assert_ne!(found, [Proved]);
    let found = verdicts(["1", "0*y", "0*z"], "", &["lyapunov = 'x²/2 − 2*x'"]);
    assert_eq!(found, [Proved], "x − 2 is not positive up to the end of the range");
    let found = verdicts(["1", "0*y", "0*z"], "", &["lyapunov = 'x²/2 − 1.5*x'"]);
    assert_eq!(found, [Refuted]);
}

#[test]
fn a_function_falls_along_a_map() {
    let verdict = |claim: &str| {
        let text = format!(
            "title = 't'\n[parameters]\na = '0.5..0.9'\n[state]\nx = '-2..2'\ny = '-2..2'\n[map]\n\
             x = 'a*y'\ny = '−a*x'\n[[claim]]\n{claim}\n"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        judge(&case, &Options::default()).expect("judged").claims[0].verdict
    };
    assert_eq!(verdict("lyapunov = 'x² + y²'\nequals = '(a² − 1)*(x² + y²)'"), Proved);
    assert_eq!(verdict("lyapunov = 'x² + y²'\nequals = '−2*(x² + y²)'"), Refuted);
    assert_eq!(verdict("lyapunov = '−x² − y²'"), Refuted);
    assert_eq!(verdict("lyapunov = 'x²'"), Refuted);
}

#[test]
fn one_forms_are_carried_along() {
    // L_v(f dx) = v(f) dx + f dv_x
    let rates = ["x*y", "b*y", "a*z + x"];
    let found = verdicts(
        rates,
        "",
        &[
            "form = { x = '1' }\nfactor = 'y'",
            "form = { y = '1' }\nfactor = 'b'",
            "form = { y = '1' }\nfactor = '−b'",
            "form = { y = '1/y' }",
            "form = { y = 'y' }\nfactor = '2*b'",
            "form = { y = 'y' }",
            "form = { x = 'y', y = 'x' }\nfactor = 'y + b'",
            "form = { z = '1' }\nfactor = 'a'",
        ],
    );
    let [yes, no] = [Proved, Refuted];
    assert_eq!(found, [no, yes, no, yes, yes, no, no, no]);
}

#[test]
fn two_forms_are_carried_along() {
    // x' = y² z: L_v(dx∧dy) = 2yz dy∧dy + y² dz∧dy
    let found = verdicts(
        ["y²*z", "0*y", "0*z"],
        "",
        &[
            "form = { 'x,y' = '1' }",
            "form = { 'y,z' = '1' }",
            "form = { 'x,y' = '2*y*z', 'x,z' = 'y²' }",
            "form = { 'y,x' = '2*y*z', 'x,z' = 'y²' }",
            "form = { 'y,x' = '2*y*z', 'z,x' = 'y²' }",
        ],
    );
    assert_eq!(found, [Refuted, Proved, Proved, Refuted, Proved]);
    let found = verdicts(
        ["a*x", "b*y", "z²"],
        "",
        &[
            "form = { 'x,y' = '1' }\nfactor = 'a + b'",
            "form = { 'x,y' = '1' }\nfactor = '−a − b'",
            "form = { 'x,y' = '1/(x*y)' }",
            "form = { 'x,z' = '1' }\nfactor = 'a + 2*z'",
            "form = { 'x,x' = '1' }",
        ],
    );
    assert_eq!(found, [Proved, Refuted, Proved, Proved, Refuted]);
}

#[test]
fn on_a_level_forms_are_compared_along_it() {
    let plane = "[level]\nequations = ['z = 0']";
    let found = verdicts(
        ["−y", "x", "a*z"],
        plane,
        &[
            "form = { z = '1' }",
            "form = { z = '1' }\nwhere = 'everywhere'",
            "form = { 'x,y' = '1', 'x,z' = 'y' }",
            "form = { 'x,y' = '1', 'x,z' = 'y' }\nwhere = 'everywhere'",
            "form = { x = '1' }",
        ],
    );
    assert_eq!(found, [Proved, Refuted, Proved, Refuted, Refuted]);
}

#[test]
fn maps_pull_forms_back() {
    let verdict = |claim: &str| {
        let text = format!(
            "title = 't'\n[state]\nx = '1..2'\ny = '1..2'\nz = '1..2'\n[map]\nx = 'x*y'\ny = 'y'\n\
             z = '3*z + x'\n[[claim]]\n{claim}\n"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        judge(&case, &Options::default()).expect("judged").claims[0].verdict
    };
    assert_eq!(verdict("form = { y = '1' }"), Proved);
    assert_eq!(verdict("form = { y = 'x' }\nfactor = 'y'"), Proved);
    assert_eq!(verdict("form = { y = 'x' }\nfactor = '1/y'"), Refuted);
    assert_eq!(verdict("form = { x = '1' }"), Refuted);
    assert_eq!(verdict("form = { 'x,y' = '1' }\nfactor = 'y'"), Proved);
    assert_eq!(verdict("form = { 'x,y' = '1/x' }"), Proved);
    assert_eq!(verdict("form = { 'y,z' = '1' }\nfactor = '3'"), Refuted, "dy∧dx is left");
    assert_eq!(verdict("form = { 'x,y' = '1' }\nfactor = '−y'"), Refuted);
}

#[test]
fn mistakes_in_forms_are_told() {
    assert!(mistake("form = { x = '∫(exp(x²), x)' }").0.contains("cannot contain ∫"));
    assert!(mistake("lyapunov = 'x'\nequals = '∫(exp(x²), x)'").0.contains("cannot contain ∫"));
    assert!(mistake("form = { x = '1', 'x,y' = '1' }").0.contains("not of both"));
    assert!(mistake("form = { 'x,q' = '1' }").0.contains("`q` is not a state variable"));
    assert!(mistake("form = { 'x,y' = '1', 'y,x' = '1' }").0.contains("given already"));
    assert!(mistake("form = { 'x,y' = '[1, 2]' }").0.contains("compared"));
    assert!(mistake("form = { q = '1' }").0.contains('q'));
}
