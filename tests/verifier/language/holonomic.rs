//! Constraints on the coordinates of a Lagrangian.

use liouville::case::Case;

use super::settled;

fn pendulum(constraint: &str, claims: &str) -> String {
    format!(
        "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\ng = '0.5..2'\nl = '0.5..2'\n[state]\n\
         x = '-2..2'\ny = '-2..2'\nz = '-2..2'\n\"x'\" = '-2..2'\n\"y'\" = '-2..2'\n\"z'\" = '-2..2'\n\
         [let]\nr = 'x² + y² + z²'\n[lagrangian]\nkinetic = \"(x'² + y'² + z'²)/2\"\npotential = 'g*z'\n\
         constraints = [{constraint}]\n{claims}"
    )
}

/// Claims that hold for a pendulum of length l, and one that fails: 2μq is the pull of the rod.
const CLAIMS: &str = "[[claim]]\nidentity = \"x*x' + y*y' + z*z' = 0\"\n[[claim]]\nidentity = 'r = l²'\n\
                      [[claim]]\nintegral = 'energy'\n[[claim]]\nintegral = \"x*y' − y*x'\"\n\
                      [[claim]]\nidentity = \"2*μ*l² = g*z − (x'² + y'² + z'²)\"\n\
                      [[claim]]\nidentity = \"2*μ*l² = g*z + (x'² + y'² + z'²)\"\nexpect = 'fails'\n";

#[test]
fn a_constraint_on_the_coordinates_holds_with_its_rate() {
    for constraint in ["'x² + y² + z² = l²'", "'r = l²'", "'l² − r = 0'"] {
        let claims = match constraint.starts_with("'l²") {
            true => CLAIMS.replace("2*μ", "−2*μ"),
            false => CLAIMS.to_string(),
        };
        settled(&pendulum(constraint, &claims));
    }
    let text = pendulum("'x*y + z = l*y'", "");
    let case = Case::parse(&text, &[]).expect("a case");
    assert_eq!(case.model.level[1].text, "(x*y + z)' = (l*y)'");
    let text = pendulum("'r = l²', \"y' = x'\"", "");
    let case = Case::parse(&text, &[]).expect("a case");
    let texts: Vec<&str> = case.model.level.iter().map(|own| own.text.as_str()).collect();
    assert_eq!(texts, ["r = l²", "r' = 0", "y' = x'"]);
}

#[test]
fn entries_of_a_constraint_each_have_a_reaction() {
    settled(
        "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nD = 'diag(1..3)'\n[state]\n\
         Q = 'matrix(-1..1)'\n\"Q'\" = 'matrix(-1..1)'\n[lagrangian]\nkinetic = \"tr(Q'*D*Q'ᵀ)/2\"\n\
         constraints = ['Qᵀ*Q = E']\n[[claim]]\nintegral = 'energy'\n[[claim]]\n\
         integral = \"Q*D*Q'ᵀ − Q'*D*Qᵀ\"\n[[claim]]\nidentity = 'μ1 = μ6'\nexpect = 'fails'\n[[claim]]\n\
         identity = 'det(Q)² = 1'\n",
    );
}

#[test]
fn a_constraint_in_a_name_has_all_its_reactions() {
    let text = |names: &str, claims: &str| {
        format!(
            "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nD = 'diag(1..3)'\n[state]\n\
             Q = 'matrix(-1..1)'\n\"Q'\" = 'matrix(-1..1)'\n[lagrangian]\nkinetic = \"tr(Q'*D*Q'ᵀ)/2\"\n\
             constraints = ['S = E']\n[let]\n{names}S = 'Qᵀ*Q'\n{claims}"
        )
    };
    let claims = "[[claim]]\nintegral = 'energy'\n[[claim]]\nidentity = 'F = μ1 + μ6'\n[[claim]]\n\
                  identity = 'μ6 = μ1'\nexpect = 'fails'\n";
    settled(&text("F = 'μ6 + μ1'\n", claims));
    settled(&text("G = 'F/2'\nF = 'μ6 + μ1'\n", claims));
    let told = super::error(&text("F = 'μ7 + μ1'\n", ""));
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].1.contains("unknown name `μ7`"), "{told:?}");
    let told = super::error(&text("F = 'μ + 1'\n", ""));
    assert!(told[0].1.contains("unknown name `μ`"), "of one constraint alone: {told:?}");
}

#[test]
fn a_bead_on_a_moving_wire_gains_energy() {
    let wire = |claims: &str| {
        format!(
            "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\na = '0.5..2'\n[state]\nx = '-2..2'\n\
             y = '-2..2'\n\"x'\" = '-2..2'\n\"y'\" = '-2..2'\n[lagrangian]\nkinetic = \"(x'² + y'²)/2\"\n\
             constraints = ['y = a*t²/2']\n{claims}"
        )
    };
    let claims = "[[claim]]\nidentity = \"y' = a*t\"\n[[claim]]\nidentity = 'μ1 = a'\n[[claim]]\n\
                  rate = \"(x'² + y'²)/2\"\nequals = 'a²*t'\n[[claim]]\nintegral = \"(x'² + y'²)/2\"\nexpect = 'fails'\n";
    settled(&wire(claims));
}

#[test]
fn a_lagrangian_without_velocities_is_read_or_refused() {
    let text = "title = 'x'\nsystem = 'nonholonomic'\n[state]\nx = '0..1'\n[field]\n\"x'\" = '1'\n\
                [lagrangian]\nkinetic = 'x²'\nconstraints = []\n[[claim]]\nidentity = 'x = x'\n";
    if let Err(error) = Case::parse(text, &[]) {
        assert!(!error.mistakes().is_empty(), "with a reason");
    }
    let text = text.replace("constraints = []", "constraints = ['x = 1']");
    if let Err(error) = Case::parse(&text, &[]) {
        assert!(!error.mistakes().is_empty(), "with a reason");
    }
}

#[test]
fn the_apex_of_a_cone_is_no_state_of_a_motion() {
    let claims = "[[claim]]\nintegral = 'energy'\n[[claim]]\nintegral = \"x*y' − y*x'\"\n\
                  [[claim]]\nintegral = \"x*y' − 2*y*x'\"\nexpect = 'fails'\n";
    settled(&pendulum("'z² = x² + y²'", claims));
    // Two planes: a motion stays on one of them.
    let planes = "[[claim]]\nintegral = \"energy\"\n[[claim]]\nintegral = \"x'*y'\"\n\
                  [[claim]]\nintegral = \"x'\"\nexpect = 'fails'\n";
    settled(&pendulum("'x*y = 0'", &planes.replace("\"x'\"", "\"z'\"")));
}
