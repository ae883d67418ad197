//! Families of Hamiltonian systems over the energy.

use std::f64::consts::PI;

use liouville_flow::{Bifurcation, BranchEnd};

use crate::branches::{Wish, assert_at, assert_near, follow, marked, parse};

/// H = (p² + x²)/2 + x⁴/4.
const OSCILLATOR: &str = r#"
title = "an oscillator"
[state]
x = "-1..1"
p = "-1..1"
[hamiltonian]
function = "p²/2 + x²/2 + x⁴/4"
pairs = [["x", "p"]]
"#;

/// The same with a second one, coupled by x²y²/2; y = 0 stays.
const COUPLED: &str = r#"
title = "two oscillators"
[state]
x = "-1..1"
y = "-1..1"
px = "-1..1"
py = "-1..1"
[hamiltonian]
function = "px²/2 + py²/2 + x²/2 + x⁴/4 + 3/4*y² + x²*y²/2"
pairs = [["x", "px"], ["y", "py"]]
"#;

/// Complete elliptic integral of the first kind, by the arithmetic-geometric mean.
fn quarter(square: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - square).sqrt());
    for _ in 0..8 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    PI / (2.0 * a)
}

#[test]
fn periods_of_an_oscillator_are_elliptic_integrals_of_its_energy() {
    let wish = Wish {
        surface: "x = 0",
        axes: "p",
        start: "x=0 p=1",
        varied: "energy",
        range: ["1/100", "4"],
    };
    let found = follow(&parse(OSCILLATOR), &wish).expect("a branch");
    assert_eq!(found.ends, [BranchEnd::Range, BranchEnd::Range]);
    assert!(found.points.len() > 20 && marked(&found).is_empty());
    for point in &found.points {
        assert_near(point.at[0], (2.0 * point.value).sqrt(), 1e-14);
        // The amplitude A has A²/2 + A⁴/4 = E.
        let square = (1.0 + 4.0 * point.value).sqrt() - 1.0;
        let known = 4.0 * quarter(square / (2.0 + 2.0 * square)) / (1.0 + square).sqrt();
        assert_near(point.period.value, known, 1e-14);
        assert!(point.multipliers.is_empty(), "nothing is left besides the energy");
    }
}

#[test]
fn a_pair_that_collides_at_1_is_found_and_no_torus() {
    // x = A cn τ, and across y'' + (h - 2k² sn²)y = 0 with h = (3/2 + A²)/(1 + A²), Lamé's equation of
    // degree 1. Its solution sn τ has the period of x where h = 1 + k²: A = 1, at the energy 3/4.
    let wish = Wish {
        surface: "x = 0",
        axes: "px, y",
        start: "x=0 y=0 px=1 py=0",
        varied: "energy",
        range: ["1/4", "3/2"],
    };
    let found = follow(&parse(COUPLED), &wish).expect("a branch");
    let [(Bifurcation::BranchPoint, point)] = marked(&found)[..] else {
        panic!("{:?}", marked(&found))
    };
    assert_at(point, 0.75, 1e-6);
    assert!(found.keeps_area, "areas are kept");
    for point in &found.points {
        assert!((point.product.value - 1.0).abs() < 1e-13, "{:?}", point.product);
        assert!(point.at[1].abs() < 1e-15, "it stays in the plane: {:?}", point.at);
    }
}
