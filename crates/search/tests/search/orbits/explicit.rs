//! Lagrangian systems that are searched as fields of their positions and independent velocities.

use super::{Effort, searched};
use liouville_search::FoundKind;

const TOP: &str = "
title = 'a body with a fixed point'
system = 'nonholonomic'
[parameters]
A = '0.5..2'
B = '0.5..2'
C = '0.5..2'
[state]
w = 'vector(3, -1..1)'
[lagrangian]
quasi-velocities = ['w']
algebra = 'so(3)'
";

fn effort(degree: u32) -> Effort {
    Effort { degree, ..Effort::default() }
}

#[test]
fn a_body_with_scalar_moments_keeps_its_angular_momentum() {
    let kinetic = "kinetic = '(A*w1² + B*w2² + C*w3²)/2'";
    let euler = searched(&format!("{TOP}{kinetic}"), &effort(2));
    assert_eq!(euler.formulas(FoundKind::Integral).count(), 1, "besides the energy");
    assert!(euler.excluded.iter().any(|own| own.theorem.contains("is a function of")));
    // Suslov's problem: constraints remove the third velocity.
    let kinetic = "kinetic = '(A*w1² + B*w2² + C*w3²)/2 + w1*w3/4 + w2*w3/5'";
    let text = format!("{TOP}{kinetic}\nconstraints = ['w3 = 0']");
    let suslov = searched(&text, &effort(2));
    let density: Vec<&str> = suslov.formulas(FoundKind::Density).collect();
    assert_eq!(density, ["1/(5*w1 + 4*w2)"]);
}

#[test]
fn areas_of_a_heavy_top_are_found_with_scalar_moments() {
    let text = "
title = 'Lagrange'
system = 'nonholonomic'
[parameters]
A = '0.5..2'
C = '0.5..2'
P = '0.5..2'
[state]
w = 'vector(3, -1..1)'
g = 'vector(3, -1..1)'
[lagrangian]
kinetic = '(A*(w1² + w2²) + C*w3²)/2'
potential = 'P*g3'
quasi-velocities = ['w']
algebra = 'so(3)'
[field]
\"g'\" = 'g × w'
";
    for level in ["", "[level]\nequations = ['(g,g) = 1']\n"] {
        let found = searched(&format!("{text}{level}"), &effort(2));
        let all: Vec<&str> = found.formulas(FoundKind::Integral).collect();
        assert!(all.contains(&"A*w1*g1 + A*w2*g2 + C*w3*g3"), "{level}: {all:?}");
    }
}

#[test]
fn a_rolling_disk_has_a_measure() {
    let text = "
title = 'Rolling disk'
system = 'nonholonomic'
[parameters]
m = '0.5..2'
R = '0.5..2'
A = '0.5..2'
C = '0.5..2'
g = '0.5..2'
[state]
a = '0.5..2.5'
b = '-3..3'
c = '-3..3'
x = '-2..2'
y = '-2..2'
\"a'\" = '-2..2'
\"b'\" = '-2..2'
\"c'\" = '-2..2'
\"x'\" = '-2..2'
\"y'\" = '-2..2'
[lagrangian]
kinetic = \"m*(x'² + y'² + R²*cos(a)²*a'²)/2 + A*(a'² + b'²*sin(a)²)/2 + C*(c' + b'*cos(a))²/2\"
potential = 'm*g*R*sin(a)'
constraints = [
    \"x' − R*(a'*sin(a)*sin(b) − (c' + b'*cos(a))*cos(b)) = 0\",
    \"y' + R*(a'*sin(a)*cos(b) + (c' + b'*cos(a))*sin(b)) = 0\",
]
";
    let found = searched(text, &Effort { by_class: false, ..effort(1) });
    assert_eq!(found.formulas(FoundKind::Density).collect::<Vec<_>>(), ["sin(a)²"]);
    let translations = ["x: 1", "y: 1", "c: 1"];
    let symmetries: Vec<&str> = found.formulas(FoundKind::SymmetryField).collect();
    assert!(translations.iter().all(|own| symmetries.contains(own)), "{symmetries:?}");
}

#[test]
fn a_ball_in_a_vertical_cylinder_has_an_integral_of_degree_two() {
    let text = "
title = 'a ball in a vertical cylinder'
system = 'ball-on-surface'
[parameters]
m = '0.5..2'
R = '0.5..2'
'μ' = '0.5..2'
g = '0.5..2'
[body]
surface = 'r1² + r2²'
potential = 'm*g*r3'
";
    let found = searched(text, &effort(1));
    let all: Vec<&str> = found.formulas(FoundKind::Integral).collect();
    assert!(all.contains(&"(μ + m*R²)*M1*r1 + (μ + m*R²)*M2*r2 + μ*M3*r3"), "{all:?}");
}
