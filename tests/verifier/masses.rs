//! Lagrangians whose masses ∂²T/∂w² are not definite: the equations of motion have a value wherever
//! the matrix is regular, also where a leading minor of it is 0.

use liouville::case::Case;
use liouville::claim::PlaceName;
use liouville::mechanics::System;
use liouville::verdict::{Options, Verdict, judge};

/// Verdicts of claims about a Lagrangian; `None` if it has no equations of motion.
fn verdicts(
    parameters: &str,
    state: &[&str],
    lagrangian: &str,
    claims: &[&str],
) -> Option<Vec<Verdict>> {
    let state: String = state.iter().map(|name| format!("\"{name}\" = '-1..1'\n")).collect();
    let claims: String = claims.iter().map(|claim| format!("[[claim]]\n{claim}\n")).collect();
    let text = format!(
        "title = 'x'\n[parameters]\n{parameters}\n[state]\n{state}[lagrangian]\n{lagrangian}\n{claims}"
    );
    let case = Case::parse(&text, &[]).expect("a case");
    let reports = judge(&case, &Options::default()).ok()?;
    Some(reports.claims.into_iter().map(|report| report.verdict).collect())
}

const PLANE: [&str; 4] = ["x", "y", "x'", "y'"];
const SPACE: [&str; 6] = ["x", "y", "z", "x'", "y'", "z'"];

#[test]
fn regular_masses_of_any_sign_have_equations_of_motion() {
    use Verdict::{Proved, Refuted};
    let swapped =
        ["rate = \"x'\"\nequals = '-x'", "rate = \"y'\"\nequals = '-y'", "integral = 'energy'"];
    let own = "kinetic = \"x'*y'\"\npotential = 'x*y'";
    assert_eq!(verdicts("", &PLANE, own, &swapped), Some(vec![Proved; 3]), "x'' = −x, y'' = −y");
    let wrong = ["rate = \"x'\"\nequals = '-y'", "integral = 'x*y'"];
    assert_eq!(verdicts("", &PLANE, own, &wrong), Some(vec![Refuted; 2]));
    let own = "kinetic = \"x'*y' + z'²/2\"\npotential = 'x*y + z²'";
    let third =
        ["rate = \"z'\"\nequals = '-2*z'", "integral = 'energy'", "integral = \"z'² + 2*z²\""];
    assert_eq!(verdicts("", &SPACE, own, &third), Some(vec![Proved; 3]));
    // A pivot m − m·m/m that is 0 without being folded.
    let own = "kinetic = \"m*(x' + y')²/2 + (x' - y')*z' + z'²/2\"\npotential = 'x*y*z'";
    let energy = ["integral = 'energy'", "integral = \"x'² + y'²\""];
    let found = verdicts("m = '1..2'", &SPACE, own, &energy);
    assert_eq!(found, Some(vec![Proved, Refuted]), "a second minor that is 0");
    let own = "kinetic = \"-(x'² + y'²)/2\"\npotential = 'x*y'";
    let negative = ["rate = \"x'\"\nequals = 'y'", "integral = 'energy'"];
    assert_eq!(verdicts("", &PLANE, own, &negative), Some(vec![Proved; 2]), "all masses negative");
}

#[test]
fn equations_of_motion_hold_where_a_leading_minor_vanishes() {
    use Verdict::{Proved, Refuted};
    // The determinant is −1 everywhere, and the first minor x is 0 at the point of rest.
    let own = "kinetic = \"x*x'²/2 + x'*y'\"\npotential = 'x*y'";
    let rests = ["fixed-point = { x = '0' }", "fixed-point = { x = '1' }", "integral = 'energy'"];
    assert_eq!(verdicts("", &PLANE, own, &rests), Some(vec![Proved, Refuted, Proved]));
}

#[test]
fn singular_masses_are_refused() {
    for kinetic in ["(x' + y')²/2", "x'²/2", "x'*y' - x'*y'", "m*(x' + y')²/2"] {
        let own = format!("kinetic = \"{kinetic}\"\npotential = 'x*y'");
        let found = verdicts("m = '1..2'", &PLANE, &own, &["integral = 'energy'"]);
        assert_eq!(found, None, "{kinetic}");
    }
}

#[test]
fn reactions_are_those_of_masses_of_both_signs() {
    // With x' = y' the motion along the line has L = x'² − x², for any signs of the masses.
    let own = "kinetic = \"x'*y'\"\npotential = 'x*y'\nconstraints = [\"x' - y' = 0\"]";
    let text = format!(
        "title = 'x'\nsystem = 'nonholonomic'\n[state]\nx = '-1..1'\ny = '-1..1'\n\"x'\" = '-1..1'\n\
         \"y'\" = '-1..1'\n[lagrangian]\n{own}\n[[claim]]\nrate = \"x'\"\nequals = '-(x + y)/2'\n\
         [[claim]]\nintegral = 'energy'\n[[claim]]\nintegral = 'x - y'\n"
    );
    let case = Case::parse(&text, &[]).expect("a case");
    let reports = judge(&case, &Options::default()).expect("it has equations of motion");
    for report in &reports.claims {
        assert_eq!(report.verdict, Verdict::Proved, "{report:?}");
    }
}

#[test]
fn definite_masses_are_eliminated_as_before() {
    let needs_minors = |kinetic: &str, ranges: &str| {
        let text = format!(
            "title = 'x'\n[parameters]\nm = '{ranges}'\n[state]\nx = '0.1..1'\ny = '-1..1'\n\
             \"x'\" = '-1..1'\n\"y'\" = '-1..1'\n[lagrangian]\nkinetic = \"{kinetic}\"\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        let System::Lagrangian(own) = &case.model.system else { panic!("a Lagrangian") };
        own.solver.by_minors
    };
    for kinetic in ["m*(x'² + x²*y'²)/2", "m*x'² + x'*y' + y'²", "-m*(x'² + y'²)"] {
        assert!(!needs_minors(kinetic, "1..2"), "{kinetic}");
    }
    for (kinetic, ranges) in
        [("m*x'² + x'*y' + y'²", "-2..2"), ("x'²/2 + m*x'*y'", "1..2"), ("x'² - m*y'²", "1..2")]
    {
        assert!(needs_minors(kinetic, ranges), "{kinetic} for m in {ranges}");
    }
}

#[test]
fn masses_that_vanish_though_not_by_their_form_leave_no_equations_of_motion() {
    use Verdict::Proved;
    let claims = ["integral = \"x'\"", "rate = \"x'\"\nequals = '0'"];
    let of = |parameters: &str, state: &[&str], kinetic: &str| {
        verdicts(parameters, state, &format!("kinetic = \"{kinetic}\""), &claims)
    };
    let ranges = "a = '1..2'\nb = '1..2'\nc = '1..2'";
    for kinetic in [
        "(a*(x' - y')² + b*(y' - z')² + c*(z' - x')²)/2",
        "(a*x' + b*y')²/2 + z'²/2",
        "(a*x' + b*y' + c*z')²/2",
    ] {
        assert_eq!(of(ranges, &SPACE, kinetic), None, "{kinetic}");
    }
    // With a mass of its own for one of them there are accelerations.
    let regular = of(ranges, &SPACE, "(a*(x' - y')² + b*(y' - z')² + c*(z' - x')²)/2 + x'²/2");
    assert!(regular.is_some_and(|found| found[1] == Proved), "regular");
    let line = ["x", "x'"];
    for mass in ["(k + 1)² - k² - 2*k - 1", "2*sin(π/6) - 1"] {
        assert_eq!(of("k = '1..2'", &line, &format!("({mass})*x'²/2")), None, "{mass}");
    }
    assert_eq!(of("k = '1..2'", &line, "(k + 1)²*x'²/2"), Some(vec![Proved; 2]));
}

#[test]
fn nothing_rests_where_a_mass_is_0() {
    use Verdict::{Proved, Undecided};
    let kinetic = "kinetic = \"x'²/2 + y'²/2 + cos(x - y)*x'*y'\"";
    let rests = [
        "fixed-point = { x = '0', y = 'pi' }",
        "fixed-point = { x = 'pi/3', y = '-2*pi/3' }",
        "fixed-point = { x = '0', y = 'pi/2' }",
    ];
    let found = verdicts("", &PLANE, kinetic, &rests);
    assert_eq!(found, Some(vec![Undecided, Undecided, Proved]), "the determinant is sin²(x − y)");
    let kinetic = "kinetic = \"(x - a² - 2*a*b - b²)*x'²/2\"";
    let rests = ["fixed-point = { x = '(a + b)²' }", "fixed-point = { x = '(a + b)² + 1' }"];
    let found = verdicts("a = '1..2'\nb = '1..2'", &["x", "x'"], kinetic, &rests);
    assert_eq!(found, Some(vec![Undecided, Proved]));
    let kinetic = "kinetic = \"(x - y)*x'²/2 + y'²/2\"";
    let claim = |x: &str| {
        format!("symmetry = {{ x = '{x}', y = 'c', \"x'\" = \"0*x'\", \"y'\" = \"0*y'\" }}")
    };
    let images = [claim("(c³ + c)/(c² + 1)"), claim("c")];
    let images: Vec<&str> = images.iter().map(String::as_str).collect();
    let found = verdicts("c = '1..2'", &PLANE, kinetic, &images);
    assert_eq!(found, Some(vec![Undecided; 2]), "no motion at the image");
}

#[test]
fn a_ball_without_moment_of_inertia_has_no_equations_of_motion() {
    // ω is divided by μ, which no rate shows on a plane.
    let ball = |moment: &str| {
        let text = format!(
            "title = 'x'\nsystem = 'ball-on-surface'\n[parameters]\nm = '1..2'\nR = '1..2'\nk = '-1..1'\n\
             mu = '{moment}'\n[body]\nsurface = 'r3'\n[[claim]]\nintegral = 'M'\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        judge(&case, &Options::default()).map(|report| report.claims[0].verdict)
    };
    assert_eq!(ball("(k + 1)² - k² - 2*k").expect("a ball"), Verdict::Proved);
    assert!(ball("(k + 1)² - k² - 2*k - 1").is_err());
}

#[test]
fn masses_that_are_indefinite_for_few_parameters_have_equations_of_motion_there() {
    use Verdict::{Proved, Refuted};
    // For k < 0 the masses are [[0, 1], [1, 400]], and y'' = −1.
    let own = "kinetic = \"(|k| + k + {l})*x'^2/2 + x'*y' + 200*y'^2\"\npotential = 'x'";
    let found = |l: &str, claim: &str| {
        let lagrangian = own.replace("{l}", l);
        verdicts("k = '-0.001..1'", &PLANE, &lagrangian, &[claim]).expect("equations of motion")[0]
    };
    let rate = |right: &str| format!("rate = \"y'\"\nequals = '{right}'");
    assert_ne!(found("0", &rate("1/(800*k - 1)")), Proved, "it is false for k < 0");
    assert_eq!(found("0", &rate("1/(400*(|k| + k) - 1)")), Proved);
    assert_eq!(found("1", &rate("1/(400*(|k| + k) + 399)")), Proved);
    assert_eq!(found("1", &rate("1/(400*(|k| + k) + 398)")), Refuted);
    assert_eq!(found("0", "integral = 'energy'"), Proved);
}

/// Verdict of a claim on a case.
fn verdict(text: &str, claim: &str) -> Verdict {
    let case = Case::parse(&format!("{text}[[claim]]\n{claim}\n"), &[]).expect("a case");
    judge(&case, &Options::default()).expect("a report").claims[0].verdict
}

#[test]
fn reactions_exist_where_the_masses_with_the_constraints_are_regular() {
    // For k < 0 the matrix a M⁻¹ aᵀ is [[0, 1], [1, 2]], and x'' = −1.
    let indefinite = "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nk = '-0.001..1'\n[state]\nx = '-1..1'\n\
        y = '-1..1'\nz = '-1..1'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n\"z'\" = '-1..1'\n[lagrangian]\n\
        kinetic = \"(x'^2 + |k|/k*y'^2 + z'^2)/2\"\npotential = 'x'\nconstraints = [\"x' + y' = 0\", \"x' + z' = 0\"]\n";
    assert_ne!(verdict(indefinite, "rate = \"x'\"\nequals = '-1/3'"), Verdict::Proved);
    assert_eq!(verdict(indefinite, "rate = \"x'\"\nequals = '-1/(2 + |k|/k)'"), Verdict::Proved);
    // A constraint moves y, which has no mass.
    let massless = "title = 'x'\nsystem = 'nonholonomic'\n[state]\nx = '-1..1'\ny = '-1..1'\n\"x'\" = '-1..1'\n\
        \"y'\" = '-1..1'\n[lagrangian]\nkinetic = \"x'^2/2\"\npotential = 'y²/2'\nconstraints = [\"y' - x' = 0\"]\n";
    assert_eq!(verdict(massless, "integral = 'energy'"), Verdict::Proved);
    assert_eq!(verdict(massless, "rate = \"x'\"\nequals = '-y'"), Verdict::Proved);
    assert_eq!(verdict(massless, "rate = \"x'\"\nequals = 'y'"), Verdict::Refuted);
}

#[test]
fn geodesics_of_a_distribution_need_no_mass_across_it() {
    let heisenberg = "title = 'x'\nsystem = 'vakonomic'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n\
        \"x'\" = '-2..2'\n\"y'\" = '-2..2'\n\"z'\" = '-2..2'\nlambda = '-2..2'\n[lagrangian]\nkinetic = \"(x'²+y'²)/2\"\n\
        constraints = [\"z' = (x*y'-y*x')/2\"]\nmultipliers = ['lambda']\n";
    for claim in
        ["integral = 'lambda'", "integral = \"x'² + y'²\"", "integral = 'energy'", "density = '1'"]
    {
        assert_eq!(verdict(heisenberg, claim), Verdict::Proved, "{claim}");
    }
    assert_eq!(verdict(heisenberg, "integral = \"x'\""), Verdict::Refuted);
    let along = |sign: &str| verdict(heisenberg, &format!("identity = \"x'' = {sign}lambda*y'\""));
    assert_eq!([along(""), along("-")].iter().filter(|own| **own == Verdict::Proved).count(), 1);
}

#[test]
fn masses_are_asked_at_wider_places_too() {
    // For s < 0 the masses are [[0, 1], [1, 400]], and x'' = y'' = 0.
    let text = "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\ns = '-0.001..2'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n\
        \"s'\" = '-1..1'\n[lagrangian]\nkinetic = \"(|s| + s)*x'^2/2 + x'*y' + 200*y'^2 + s'^2/2\"\npotential = '0'\n\
        [level]\nequations = ['s = 1', \"s' = 0\", \"x' = 0\"]\n[[claim]]\nintegral = \"2*s*x' + y'\"\n";
    let case = Case::parse(text, &[]).expect("a case");
    let found = judge(&case, &Options::default()).expect("a report");
    assert_eq!(found.claims[0].verdict, Verdict::Proved);
    assert!(!found.claims[0].evidence.holds.contains(&PlaceName::Everywhere));
}

#[test]
fn minors_that_vanish_on_an_open_set_hide_no_states() {
    use Verdict::{Proved, Refuted, Undecided};
    // For k < 0 the masses are [[0, 1], [1, 400]], and y'' = −1.
    let rate = ["rate = \"y'\"\nequals = '1/(800*k - 1)'"];
    let names = ["x", "y", "z", "x'", "y'", "z'"];
    for (mass, parameters) in [
        ("exp(ln(k^2)/2) + k", "k = '-0.001..1'"),
        ("2*k + k*(atan(k) + atan(1/k) - pi/2)/(pi/2)", "k = '-0.001..1'"),
    ] {
        let own = format!(
            "kinetic = \"({mass})*x'^2/2 + x'*y' + 200*y'^2 + z'^2/2\"\npotential = \"x + |z|\""
        );
        let found = verdicts(parameters, &names, &own, &rate).expect("equations of motion");
        assert!(found != [Proved], "{mass}: {found:?}");
        let regular = verdicts("k = '1/2..1'", &names, &own, &rate).expect("equations of motion");
        assert!(regular != [Refuted] && regular != [Undecided], "{mass}: {regular:?}");
    }
    // Seven velocities are eliminated.
    let more = |mass: &str| {
        format!(
            "title = 'x'\n[parameters]\nk = '-0.001..1'\n[state]\nx = '-1..1'\ny = '-1..1'\n\
             z = 'vector(5, -1..1)'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n\"z'\" = 'vector(5, -1..1)'\n\
             [lagrangian]\nkinetic = \"({mass})*x'^2/2 + x'*y' + 200*y'^2 + (z',z')/2\"\n\
             potential = 'x'\n[[claim]]\nrate = \"y'\"\nequals = '1/(400*({mass}) - 1)'\n"
        )
    };
    let judged = |mass: &str| {
        let case = Case::parse(&more(mass), &[]).expect("a case");
        judge(&case, &Options::default()).expect("equations of motion").claims[0].verdict
    };
    assert_eq!(judged("|k| + k + 1"), Proved);
    let wrong =
        more("|k| + k").replace("equals = '1/(400*(|k| + k) - 1)'", "equals = '1/(800*k - 1)'");
    let case = Case::parse(&wrong, &[]).expect("a case");
    let found = judge(&case, &Options::default()).expect("equations of motion").claims[0].verdict;
    assert!([Undecided, Refuted].contains(&found), "it is −1 for k < 0: {found:?}");
}

#[test]
fn coordinates_without_mass_are_moved_by_many_constraints() {
    use Verdict::{Proved, Refuted};
    // A robot on two wheels with a castor: six velocities and four constraints.
    let text = |claims: &str| {
        let ranges = ["x", "y", "a", "p", "q", "b", "x'", "y'", "a'", "p'", "q'", "b'"];
        let state: String = ranges.iter().map(|name| format!("\"{name}\" = '-1..1'\n")).collect();
        format!(
            "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nm = '1..2'\nJ = '0.5..1'\n\
             R = '0.2..0.5'\nw = '0.3..0.5'\nd = '0.2..0.4'\n[state]\n{state}[let]\n\
             u = \"x'*cos(a) + y'*sin(a)\"\n[lagrangian]\n\
             kinetic = \"m*(x'^2 + y'^2)/2 + J*a'^2/2\"\n\
             constraints = [\"x'*sin(a) - y'*cos(a) = 0\", \"R*p' = u + w*a'\", \"R*q' = u - w*a'\",\n\
             \"d*(a' + b') = -u*sin(b) - a'*cos(b)\"]\n{claims}"
        )
    };
    let claims = "[[claim]]\nintegral = 'energy'\n[[claim]]\nidentity = \"a'' = 0\"\n\
                  [[claim]]\nrate = 'u'\nequals = '0'\n[[claim]]\nrate = \"b'\"\nequals = '0'\n";
    let case = Case::parse(&text(claims), &[]).expect("a case");
    let found = judge(&case, &Options::default()).expect("equations of motion").claims;
    let verdicts: Vec<Verdict> = found.into_iter().map(|own| own.verdict).collect();
    assert_eq!(verdicts, [Proved, Proved, Proved, Refuted]);
}

#[test]
fn listed_masses_that_are_0_are_moved_by_constraints() {
    use Verdict::{Proved, Refuted};
    let text = |claims: &str| {
        format!(
            "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nk = 'one of 1, 2, 0'\nm = 'one of 1, 3'\n\
             [state]\nx = '-1..1'\ny = '-1..1'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n[lagrangian]\n\
             kinetic = \"(k*x'^2 + m*y'^2)/2\"\npotential = 'x + y'\nconstraints = [\"x' + y' = 0\"]\n{claims}"
        )
    };
    let claims = "[[claim]]\nrate = \"x'\"\nequals = '0*k + (k - 1)*(k - 2)'\n\
                  [[claim]]\nrate = \"x'\"\nequals = '0'\n";
    let case = Case::parse(&text(claims), &[]).expect("a case");
    let found = judge(&case, &Options::default()).expect("equations of motion").claims;
    let verdicts: Vec<Verdict> = found.iter().map(|own| own.verdict).collect();
    assert_eq!(verdicts, [Refuted, Proved], "x'' = 0 also for k = 0");
}

#[test]
fn nothing_is_proved_where_the_determinant_is_0_though_not_by_its_form() {
    use Verdict::Undecided;
    let names = ["x", "z", "x'", "z'"];
    // D = −e(2 + e) l² k², and x'' → (k − 1)/(2lk).
    let own =
        "kinetic = \"(l*x'^2 + 2*l*k*(1 + e1)*x'*z' + l*k^2*z'^2)/2\"\npotential = 'e1*(x + z)'";
    let claims = [
        "limit = \"x''\"\nequals = '0'\nparameter = 'e1'",
        "limit = \"x''\"\nequals = '(k - 1)/(2*l*k)'\nparameter = 'e1'",
    ];
    let parameters = "l = '1/2..1'\nk = '5/4..2'\ne1 = '-1/4..1/4'";
    let found = verdicts(parameters, &names, own, &claims).expect("equations of motion");
    assert!(found[0] != Verdict::Proved && found[1] != Verdict::Refuted, "{found:?}");
    // No state with e = 0 counts.
    let listed = "l = '1/2..1'\nk = '5/4..2'\ne1 = 'one of 0, 1/4'";
    let found = verdicts(listed, &names, own, &["identity = 'e1 = 1/4'"]).expect("a report");
    assert!(found[0] != Verdict::Refuted, "{found:?}");
    // A pendulum on a cart without mass: D = l² sin² f.
    let own = "kinetic = \"((x' + l*cos(f)*f')^2 + (l*sin(f)*f')^2)/2\"\npotential = '-cos(f)'";
    let rests: Vec<String> = ["0", "π", "2*asin(1)", "4*atan(1)", "-π", "acos(-1)"]
        .iter()
        .map(|angle| format!("fixed-point = {{ f = '{angle}' }}"))
        .collect();
    let rests: Vec<&str> = rests.iter().map(String::as_str).collect();
    let found = verdicts("l = '1/2..1'", &["x", "f", "x'", "f'"], own, &rests);
    assert_eq!(found, Some(vec![Undecided; 6]));
}

#[test]
fn a_number_as_exponent_has_slopes_at_0() {
    use Verdict::{Proved, Refuted};
    let own = "kinetic = \"q'^2/2\"\npotential = 'q^n'";
    let claims = ["fixed-point = {}", "fixed-point = { q = '1' }", "integral = 'energy'"];
    let found = verdicts("n = 4", &["q", "q'"], own, &claims);
    assert_eq!(found, Some(vec![Proved, Refuted, Proved]));
    // |q|^1 has no slope.
    let found = verdicts("n = 1", &["q", "q'"], &own.replace("q^n", "abs(q)^n"), &claims[..1]);
    assert!(found.is_none_or(|own| own[0] != Proved));
}
