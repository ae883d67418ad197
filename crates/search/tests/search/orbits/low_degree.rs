//! Integrals of degree 1 in the velocities, which come before others that are functions of them.

use super::{Effort, SearchReport, field, searched};
use liouville_search::FoundKind;

fn effort(degree: u32) -> Effort {
    Effort { degree, ..Effort::default() }
}

fn lagrangian(parameters: &str, state: &str, rest: &str) -> String {
    let all = |names: &str| -> String {
        names.split_whitespace().map(|name| format!("\"{name}\" = '0.5..2'\n")).collect()
    };
    let (parameters, state) = (all(parameters), all(state));
    format!(
        "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\n{parameters}\n[state]\n{state}[lagrangian]\n{rest}"
    )
}

fn all(report: &SearchReport, kind: FoundKind) -> Vec<&str> {
    report.found.iter().filter(|own| own.kind == kind).map(|own| own.text()).collect()
}

/// Whether as many integrals of each degree are known as are counted.
fn is_counted(report: &SearchReport) -> bool {
    let is_bound = report.counts.iter().all(|own| own.known <= own.dimension);
    assert!(is_bound, "more are known than counted");
    report.counts.iter().all(|own| own.known == own.dimension)
}

#[test]
fn a_charge_in_crossed_fields_drifts() {
    let kinetic = "kinetic = \"(x'² + y'²)/2 + B*(x*y' - y*x')/2\"\n";
    let text = |potential: &str| {
        let rest = format!("{kinetic}potential = '{potential}'\n");
        lagrangian("B K N", "x y x' y'", &rest)
    };
    let found = searched(&text("-K*x"), &effort(2));
    assert!(
        all(&found, FoundKind::Integral).contains(&"B*x + y'"),
        "{:?}",
        all(&found, FoundKind::Integral)
    );
    assert!(is_counted(&found));
    let rates = all(&found, FoundKind::ConstantRate);
    assert!(rates.contains(&"B*y − x'"), "{rates:?}");
    let found = searched(&text("-K*x - N*y"), &effort(2));
    let drift = "B*K*x + B*N*y − N*x' + K*y'";
    assert!(
        all(&found, FoundKind::Integral).contains(&drift),
        "{:?}",
        all(&found, FoundKind::Integral)
    );
}

#[test]
fn a_linear_integral_takes_the_place_of_its_square() {
    // The equations of z' = y x' without z.
    let rest = "kinetic = \"((1 + y²)*x'² + y'²)/2\"\npotential = 'l*y²/2'\n\
                forces = { x = \"y*y'*x'\", y = \"−y*x'²\" }\n";
    let found = searched(&lagrangian("l", "x y x' y'", rest), &effort(1));
    assert_eq!(all(&found, FoundKind::Integral), ["x'*√(1 + y²)"]);
    assert_eq!(all(&found, FoundKind::Density), ["√(1 + y²)"], "without velocities");
    assert!(is_counted(&found));
    // Two of three components of a velocity determine the third by the energy, up to its sign.
    let frame = "kinetic = '(x²*u² + (u*y + v)²)/2'\nquasi-velocities = ['u', 'v']\n\
                 [field]\n\"x'\" = 'x*u'\n\"y'\" = 'u*y + v'\n";
    let found = searched(&lagrangian("", "x y u v", frame), &effort(2));
    assert!(all(&found, FoundKind::FurtherIntegral).contains(&"y*u + v"));
    assert!(is_counted(&found));
}

#[test]
fn positions_on_constraints_and_rates_with_cosines_are_linear_forms() {
    let effort = Effort { by_factors: false, ..effort(1) };
    let rest = "kinetic = \"(f'² + a'² + b'²)/2\"\npotential = 'f'\nconstraints = [\"2*L*f' = a' - b'\"]\n";
    let found = searched(&lagrangian("L", "f a b f' a' b'", rest), &effort);
    assert!(
        all(&found, FoundKind::Integral).contains(&"2*L*f − a + b"),
        "{:?}",
        all(&found, FoundKind::Integral)
    );
    let rest = "kinetic = \"(x'² + f'²)/2\"\npotential = '−g*x'\nforces = { x = \"−f'*sin(f)\" }\n";
    let found = searched(&lagrangian("g", "x f x' f'", rest), &effort);
    let rates = all(&found, FoundKind::ConstantRate);
    assert!(rates.contains(&"x' − cos(f)"), "{rates:?}");
}

#[test]
fn carried_axes_have_momenta() {
    let text = "
title = 'a ball on a plane'
system = 'nonholonomic'
[parameters]
I = 'inertia(0.5..3)'
R = '0.5..2'
[state]
a = 'vector(-1..1)'
b = 'vector(-1..1)'
w = 'vector(-1..1)'
x = '-2..2'
y = '-2..2'
\"x'\" = '-1..1'
\"y'\" = '-1..1'
[field]
\"a'\" = 'a × w'
\"b'\" = 'b × w'
[level]
equations = ['(a,a) = 1', '(b,b) = 1', '(a,b) = 0']
[lagrangian]
kinetic = \"(I*w,w)/2 + (x'² + y'²)/2\"
quasi-velocities = ['w']
algebra = 'so(3)'
constraints = [\"x' = R*(b,w)\", \"y' = -R*(a,w)\"]
";
    let found = searched(text, &effort(1));
    assert_eq!(
        found.functions(FoundKind::Integral).count(),
        3,
        "{:?}",
        all(&found, FoundKind::Integral)
    );
}

#[test]
fn variables_that_divide_their_rates_are_factors_beside_denominators() {
    // A pursuit curve.
    let text = "title = 'x'\nsystem = 'field'\n[parameters]\nk = '1..2'\n[state]\nr = '0.5..2'\nf = '-1..1'\n\
                [field]\n\"r'\" = 'k*sin(f) - 1'\n\"f'\" = 'k*cos(f)/r'\n";
    let found = searched(text, &effort(1));
    let integrals = all(&found, FoundKind::Integral);
    assert_eq!(integrals, ["(k − 1)*ln(cos(f)) + k*ln(r) + ln(1 + sin(f))"]);
}

#[test]
fn the_rational_part_of_a_field_is_searched_by_itself() {
    let text = "title = 'x'\nsystem = 'field'\n[parameters]\nc = '0.1..0.5'\n[state]\nx = '-1..1'\n\
                f = '-3..3'\nu = '-1..1'\nw = '-1..1'\n[field]\n\"x'\" = 'u*cos(f)'\n\
                \"f'\" = 'w'\n\"u'\" = '2*w² - c*u'\n\"w'\" = '-u*w - c*w'\n";
    let found = searched(text, &effort(1));
    let has_angle = all(&found, FoundKind::Integral).iter().any(|own| own.contains("atan"));
    assert!(has_angle, "{:?}", all(&found, FoundKind::Integral));
    let rates = all(&found, FoundKind::ConstantRate);
    assert_eq!(rates.len(), 1, "each is told once: {rates:?}");
}

#[test]
fn quotients_of_constant_rate_are_found_besides_all_integrals() {
    let found = searched(&field("", &["y", "-3*x*y - x³"]), &effort(1));
    assert_eq!(all(&found, FoundKind::Integral).len(), 1);
    assert_eq!(all(&found, FoundKind::ConstantRate), ["x/(y + x²)"]);
}

#[test]
fn roots_of_squares_are_written_without_roots() {
    let rest = "kinetic = \"(x'² + y'²)/2 + B*(x*y' - y*x')/2\"\npotential = '-K*x - N*y'\n";
    let found = searched(&lagrangian("B K N", "x y x' y'", rest), &effort(1));
    let angles = all(&found, FoundKind::ConstantRate);
    assert!(angles.contains(&"atan((N − B*x')/(K + B*y'))"), "{angles:?}");
}

#[test]
fn a_longitude_gives_all_components_of_the_angular_momentum() {
    let rest = "kinetic = \"(h'² + sin(h)²*f'²)/2\"\n";
    let found = searched(&lagrangian("", "h f h' f'", rest), &effort(1));
    let linear =
        [all(&found, FoundKind::Integral), all(&found, FoundKind::FurtherIntegral)].concat();
    assert_eq!(linear.len(), 3, "{linear:?}");
}

#[test]
fn polar_coordinates_have_the_cartesian_momenta() {
    let found =
        searched(&lagrangian("", "r f r' f'", "kinetic = \"(r'² + r²*f'²)/2\"\n"), &effort(1));
    let linear =
        [all(&found, FoundKind::Integral), all(&found, FoundKind::FurtherIntegral)].concat();
    let is_momentum = |own: &&&str| own.contains("cos(f)") && own.contains("sin(f)");
    assert_eq!(linear.iter().filter(is_momentum).count(), 2, "{linear:?}");
    assert!(is_counted(&found), "{:?}", found.counts);
}
