//! Criteria for densities of bodies whose inertia tensor, or whose D_T, may be singular.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn verdicts(system: &str, parameters: &str, shape: &str) -> Vec<Verdict> {
    let kinds = ["smooth", "analytic", "position"];
    let claims: String =
        kinds.iter().map(|kind| format!("[[claim]]\n{kind}-density = 'exists'\n")).collect();
    let text = format!(
        "title = 't'\nsystem = '{system}'\n[parameters]\nm = 1\nR = 1\n{parameters}\n[body]\n\
         shape = '{shape}'\n{claims}"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let found = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    found.claims.into_iter().map(|own| own.verdict).collect()
}

#[test]
fn nothing_is_proved_of_bodies_of_which_some_have_no_motion() {
    let ellipsoid = "B = [4, 4, 1]\nI = 'm*B + E'";
    for (system, parameters, shape) in [
        ("rolling-plane", "j = 'one of 1, 0'\nI = 'diag(1, 1, j)'", "ball"),
        ("rolling-plane", "k = '-1..1'\nI = 'diag(1, 1, max(k, 0))'", "ball"),
        ("rolling-plane", "I = [[1, -1, 0], [-1, 1, 0], [0, 0, 1]]", "ball"),
        ("rolling-sphere", "k = 1\nj = 'one of 0, 1'\nI = 'diag(1, 2, j)'", "ball"),
        ("rubber-sphere", &format!("{ellipsoid}\nk = 'one of 1, -1/4'"), "ellipsoid"),
        ("rubber-sphere", &format!("{ellipsoid}\nk = -1/4").replace("-1/4", "'-1/4'"), "ellipsoid"),
    ] {
        let found = verdicts(system, parameters, shape);
        assert_eq!(found, [Verdict::Undecided; 3], "{system}, {parameters}");
    }
}

#[test]
fn bodies_with_a_definite_tensor_have_densities() {
    for (system, parameters, shape) in [
        ("rolling-plane", "j = 'one of 1, 2'\nI = 'diag(1, 1, j)'", "ball"),
        ("rolling-plane", "I = [[2, -1, 0], [-1, 1, 0], [0, 0, 1]]", "ball"),
        ("rubber-sphere", "B = [4, 4, 1]\nI = 'm*B + E'\nk = 'one of 1, 2'", "ellipsoid"),
    ] {
        let found = verdicts(system, parameters, shape);
        assert_eq!(found, [Verdict::Proved; 3], "{system}, {parameters}");
    }
}
