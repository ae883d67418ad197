//! Use of `liouville_testing`: user-defined fields and bodies, and assertions that can fail.

#[path = "../../../tests/common/mod.rs"]
mod common;
#[path = "testing/levels.rs"]
mod levels;
#[path = "../../../tests/common/random.rs"]
mod random;

use common::case;
use liouville::scalar::Scalar;
use liouville_testing::{
    AssertionFailure, Ball, Body, Ellipsoid, Level, On, OnUnitSphere, Polynomial, Rolling,
    RollingLevel, Shifted, Sum, VectorField, body_of_revolution, convex_body, ellipsoid,
    inertia_tensor, number, principal_moments, rolling_state, state,
};
use liouville_testing::{field, involution, quantity};
use nalgebra::Matrix3;
use num_dual::{Dual, DualNum};
use proptest::prelude::*;
use proptest::test_runner::{TestError, TestRunner};
use random::config;

/// A body outside the case files: a smooth relative of the superellipsoid, h = ⁴√(Σ (aᵢγᵢ)⁴) and a
/// margin.
#[derive(Clone, Debug)]
struct Pillow {
    axes: [f64; 3],
    margin: f64,
}

impl Body for Pillow {
    fn support<T: Scalar>(&self, gamma: [T; 3]) -> T {
        let fourth: T = gamma.iter().zip(self.axes).map(|(x, a)| (*x * a).powi(4)).sum();
        let square: T = gamma.iter().map(|x| *x * *x).sum();
        fourth.sqrt().sqrt() + square.sqrt() * self.margin
    }
}

fn pillow() -> impl Strategy<Value = Pillow> {
    (state(0.5..2.0), number(0.25..1.0)).prop_map(|(axes, margin)| Pillow { axes, margin })
}

/// Computes |Ĩω × γ|², an integral of a balanced ball and of few other bodies.
fn turned_momentum<B: Body, T: Scalar>(rolling: &Rolling<B>, x: [T; 6]) -> T {
    let [w1, w2, w3, g1, g2, g3] = x;
    let [a, b, c] =
        rolling.moving_inertia([g1, g2, g3]).map(|row| row[0] * w1 + row[1] * w2 + row[2] * w3);
    let turned = [b * g3 - c * g2, c * g1 - a * g3, a * g2 - b * g1];
    turned.into_iter().map(|x| x * x).sum()
}

proptest! {
    #![proptest_config(config(24))]

    #[test]
    fn a_body_of_ones_own_conserves_its_energy(
        body in pillow(),
        inertia in inertia_tensor(0.25..2.0),
        (mass, weight, curvature) in (number(0.5..2.0), number(-2.0..2.0), number(0.0..1.0)),
        gyrostat in state(-2.0..2.0),
        state in rolling_state(),
    ) {
        let plane = Rolling { weight, gyrostat, ..Rolling::on_plane(body, mass, inertia) };
        plane.conserves(&plane.energy()).at(&state)?;
        let sphere = Rolling { curvature, ..plane };
        sphere.conserves(&sphere.energy()).at(&state)?;
    }

    #[test]
    fn every_body_drawn_conserves_its_energy(
        body in convex_body(1.0..2.0),
        spindle in body_of_revolution(1.0..2.0),
        inertia in inertia_tensor(0.25..2.0),
        curvature in number(0.0..1.0),
        state in rolling_state(),
    ) {
        let rolling = Rolling { curvature, ..Rolling::on_plane(body, 1.0, inertia) };
        rolling.conserves(&rolling.energy()).at(&state)?;
        let rolling = Rolling { curvature, ..Rolling::on_plane(spindle, 1.0, inertia) };
        rolling.conserves(&rolling.energy()).at(&state)?;
    }

    #[test]
    fn balanced_balls_have_a_density_on_the_level(
        radius in number(0.5..2.0),
        moments in principal_moments(0.25..2.0),
        state in rolling_state(),
    ) {
        let ball = balanced(radius, moments);
        let turned = quantity!(
            |x: [_; 6]| turned_momentum(&ball, x), ball: Rolling<Ball>
        );
        ball.conserves(&turned).at(&state)?;
        let root = quantity!(
            |x: [_; 6]| inverse_form(&x, moments, radius).sqrt(), moments: [f64; 3], radius: f64
        );
        ball.has_density(&root).at(&state)?;
    }

    #[test]
    fn moments_of_inertia_obey_the_triangle_inequalities(
        moments in principal_moments(0.25..2.0),
        tensor in inertia_tensor(0.25..2.0),
    ) {
        let tensor = Matrix3::from_fn(|i, j| tensor[i][j]);
        prop_assert_eq!(tensor, tensor.transpose());
        for [a, b, c] in [moments, tensor.symmetric_eigenvalues().into()] {
            prop_assert!(a < b + c && b < c + a && c < a + b, "{} {} {}", a, b, c);
        }
    }

    #[test]
    fn bodies_are_convex_and_homogeneous(
        general in convex_body(0.5..2.0),
        spindle in body_of_revolution(0.5..2.0),
        ellipsoid in ellipsoid(0.5..2.0),
        at in rolling_state(),
    ) {
        let x: [f64; 6] = RollingLevel.point(at.coordinates);
        let gamma = [x[3], x[4], x[5]];
        for (smallest, defect) in [radii(&general, gamma), radii(&spindle, gamma), radii(&ellipsoid, gamma)] {
            prop_assert!(smallest > 0.04, "the smallest radius of curvature is {smallest}");
            prop_assert!(defect.abs() < 1e-12, "Euler's relation is off by {defect}");
        }
    }
}

#[test]
fn without_its_root_it_is_no_density() {
    let (radius, moments) = (1.25, [1.0, 2.0, 2.5]);
    let form = quantity!(
        |x: [_; 6]| inverse_form(&x, moments, radius), moments: [f64; 3], radius: f64
    );
    let state = On { level: RollingLevel, coordinates: [0.5, -0.25, 1.0, 0.75, -0.5] };
    let failure = balanced(radius, moments).has_density(&form).at(&state).expect_err("(γ,J⁻¹γ)");
    assert!(failure.to_string().contains("v(ln ρ) + div v"), "{failure}");
}

fn balanced(radius: f64, [a, b, c]: [f64; 3]) -> Rolling<Ball> {
    let inertia = [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]];
    Rolling::on_plane(Ball { radius }, 1.0, inertia)
}

/// Computes (γ,J⁻¹γ) with J = I + mR²E.
fn inverse_form<T: Scalar>(x: &[T; 6], moments: [f64; 3], radius: f64) -> T {
    let added = T::from(radius) * radius;
    x[3..].iter().zip(moments).map(|(g, a)| *g * *g / (added + a)).sum()
}

/// Computes the smaller principal radius of curvature at γ, and h - (γ,∇h).
fn radii(body: &impl Body, gamma: [f64; 3]) -> (f64, f64) {
    let second = |i: usize, j: usize| {
        let part = |j: usize, k: usize| if j == k { 1.0 } else { 0.0 };
        let at = |k: usize| Dual::new(Dual::new(gamma[k], part(i, k)), Dual::from_re(part(j, k)));
        body.support([at(0), at(1), at(2)])
    };
    let slope = Matrix3::from_fn(|i, j| second(i, j).eps.eps);
    // γ is an eigenvector with eigenvalue 0, which is shifted to a large value.
    let normal = nalgebra::Vector3::from(gamma);
    let across = slope + normal * normal.transpose() * 1e3;
    let along: f64 = (0..3).map(|i| gamma[i] * second(i, i).re.eps).sum();
    (across.symmetric_eigenvalues().min(), second(0, 0).re.re - along)
}

/// The smallest counterexample that proptest finds to a wrong integral of a user-defined body.
#[test]
fn a_wrong_integral_is_refuted_and_shrinks() {
    let strategy = (pillow(), inertia_tensor(0.25..2.0), rolling_state());
    let refuses = |body: Pillow, inertia, state| {
        let rolling = Rolling::on_plane(body, 1.0, inertia);
        let turned = quantity!(|x: [_; 6]| turned_momentum(&rolling, x), rolling: Rolling<Pillow>);
        rolling.conserves(&turned).at(&state)
    };
    let run = TestRunner::new(ProptestConfig { max_shrink_iters: 512, ..config(16) })
        .run(&strategy, |(body, inertia, state)| Ok(refuses(body, inertia, state)?));
    let Err(TestError::Fail(reason, (body, inertia, state))) = run else {
        panic!("it is no integral of this body: {run:?}");
    };
    let reason = reason.to_string();
    assert!(reason.contains("L_vF") && reason.contains("excludes 0"), "{reason}");
    assert!(reason.contains(&format!("{:?}", state.coordinates)), "the state is shown: {reason}");
    let failure = refuses(body, inertia, state).expect_err("the counterexample is one");
    assert!(failure.is_refutation(), "{failure}");
    let zeros = state.coordinates.iter().filter(|x| **x == 0.0).count();
    assert!(zeros >= 1, "shrunk towards 0: {:?}", state.coordinates);
}

#[test]
fn energy_is_proved_on_the_level_and_a_wrong_integral_is_not() {
    let inertia = [[2.0, 0.25, 0.0], [0.25, 3.0, -0.5], [0.0, -0.5, 2.5]];
    let body = Sum(Ball { radius: 0.5 }, Ellipsoid { axes: [1.0, 1.5, 0.75] });
    let body = Shifted { body, by: [0.25, 0.0, -0.125] };
    let rolling = Rolling { weight: 2.0, ..Rolling::on_plane(body, 1.5, inertia) };
    let state = On { level: RollingLevel, coordinates: [0.5, -0.25, 1.0, 0.75, -0.5] };
    let proof = rolling.conserves(&rolling.energy()).prove(&state).expect("energy is conserved");
    assert!(proof.0.error_log2 < -100.0, "{proof}");
    assert!(proof.to_string().contains("random primes"), "{proof}");

    // At rest nothing moves, and every quantity is conserved there, but not on the level.
    let rest = On { level: RollingLevel, coordinates: [0.5, -0.25, 0.0, 0.0, 0.0] };
    let square = quantity!(|x: [_; 6]| x[0] * x[0]);
    rolling.conserves(&square).at(&rest).expect("true at this state");
    let failure = rolling.conserves(&square).prove(&rest).expect_err("but no integral");
    let AssertionFailure::Refuted(witness) = failure else {
        panic!("a witness near it: {failure}")
    };
    assert_ne!(witness.at.coordinates, rest.coordinates);
    assert!(witness.enclosure.0.abs() > witness.enclosure.1, "{witness}");
}

#[test]
fn a_body_of_ones_own_moves_as_that_of_a_case_file() {
    let text = "title = \"the same body\"\nsystem = \"rubber-sphere\"\n[parameters]\nm = 1.5\n\
        k = 0.25\nI = [[2, 0.25, 0], [0.25, 3, -0.5], [0, -0.5, 2.5]]\nS = [0.5, -1, 0.75]\n[body]\n\
        support = \"√(γ1² + 2.25*γ2² + 0.5625*γ3²) + |γ|/2 + γ1/4\"\ngyrostat = \"S\"\n\
        potential = \"2*(√(γ1² + 2.25*γ2² + 0.5625*γ3²) + |γ|/2 + γ1/4)\"\n";
    let body = Sum(Ellipsoid { axes: [1.0, 1.5, 0.75] }, Ball { radius: 0.5 });
    let rolling = Rolling {
        body: Shifted { body, by: [0.25, 0.0, 0.0] },
        mass: 1.5,
        inertia: [[2.0, 0.25, 0.0], [0.25, 3.0, -0.5], [0.0, -0.5, 2.5]],
        curvature: 0.25,
        gyrostat: [0.5, -1.0, 0.75],
        weight: 2.0,
    };
    let case = case(text);
    for index in 0..8 {
        let report = liouville::verdict::evaluate(&case, None, 1, index).expect("regular");
        let numbers: Vec<f64> = report
            .state
            .iter()
            .flat_map(|(_, list)| list)
            .map(|x| num_traits::ToPrimitive::to_f64(&common::exact(x)).expect("finite"))
            .collect();
        let x: [f64; 6] = numbers.try_into().expect("ω and γ");
        for (found, expected) in rolling.rates(x).into_iter().zip(&report.field) {
            let (expected, _) = expected.expect("defined");
            assert!((found - expected).abs() < 1e-12, "{found} against {expected} at {x:?}");
        }
    }
}

fn euler_top<T: DualNum<Primitive = f64> + Copy>([p, q, r]: [T; 3], [a, b, c]: [f64; 3]) -> [T; 3] {
    [
        q * r * T::from(b - c) / T::from(a),
        r * p * T::from(c - a) / T::from(b),
        p * q * T::from(a - b) / T::from(c),
    ]
}

/// Computes Σ aᵏ ωᵢ²: twice the energy for k = 1, the square of the momentum for k = 2.
fn moment<T: DualNum<Primitive = f64> + Copy>(x: [T; 3], moments: [f64; 3], power: i32) -> T {
    x.iter().zip(moments).map(|(x, a)| *x * *x * T::from(a).powi(power)).sum()
}

#[test]
fn a_field_of_ones_own_has_integrals_a_density_and_a_reversor() {
    let (moments, at) = ([1.0, 2.0, 2.5], [0.5, -0.75, 1.25]);
    let top = field!(|x: [_; 3]| euler_top(x, moments), moments: [f64; 3]);
    for power in [1, 2] {
        let integral =
            quantity!(|x: [_; 3]| moment(x, moments, power), moments: [f64; 3], power: i32);
        top.conserves(&integral).prove(&at).expect("energy and momentum");
    }
    let cubes = quantity!(|x: [_; 3]| moment(x, moments, 3), moments: [f64; 3]);
    let failure = top.conserves(&cubes).at(&at).expect_err("Σ a³ω² is not conserved");
    assert!(failure.to_string().contains("x = [0.5, -0.75, 1.25]"), "{failure}");
    let nothing = quantity!(|x: [_; 3]| (x[0] - x[0]).exp());
    top.has_density(&nothing).prove(&at).expect("div v = 0");
    let wrong = quantity!(|x: [_; 3]| x[0] * x[0]);
    assert!(top.has_density(&wrong).at(&at).is_err(), "p² is no density");
    let opposite = involution!(|x: [_; 3]| x.map(|x| -x));
    top.is_reversed_by(&opposite).prove(&at).expect("v is quadratic");
    let mirror = involution!(|x: [_; 3]| [-x[0], -x[1], x[2]]);
    let failure = top.is_reversed_by(&mirror).at(&at).expect_err("this is a symmetry");
    assert!(failure.to_string().contains("dσ·v + v∘σ"), "{failure}");
    let shear = involution!(|x: [_; 3]| [-x[0] * 2.0, -x[1], -x[2]]);
    assert!(top.is_reversed_by(&shear).at(&at).is_err(), "no involution");
    top.commutes_with(&top).prove(&at).expect("[v,v] = 0");
    let scaling = field!(|x: [_; 3]| x);
    let failure = top.commutes_with(&scaling).at(&at).expect_err("[v,x] = -v");
    assert!(failure.to_string().contains("[v,u]"), "{failure}");
}

fn hunting<T: DualNum<Primitive = f64> + Copy>([x, y]: [T; 2]) -> [T; 2] {
    [x * (-y + 3.0), y * (x - 2.0)]
}

#[test]
fn logarithms_of_densities_and_transcendental_integrals() {
    let (field, at) = (field!(|x: [_; 2]| hunting(x)), [1.5, 0.25]);
    let logarithm = quantity!(|x: [_; 2]| -(x[0] * x[1]).ln());
    field.has_log_density(&logarithm).prove(&at).expect("ρ = 1/xy");
    let density = quantity!(|x: [_; 2]| (x[0] * x[1]).recip());
    field.has_density(&density).prove(&at).expect("ρ = 1/xy");
    assert!(field.has_density(&logarithm).at(&at).is_err(), "ln ρ is not ρ");
    let volterra = quantity!(|x: [_; 2]| x[0] + x[1] - x[0].ln() * 2.0 - x[1].ln() * 3.0);
    field.conserves(&volterra).prove(&at).expect("Volterra's integral");
    let near =
        quantity!(|x: [_; 2]| x[0] + x[1] - x[0].ln() * 2.0 - x[1].ln() * 3.0 + x[0] * 1e-40);
    let failure = field.conserves(&near).at(&at).expect_err("off by 1e-40");
    assert!(failure.is_refutation(), "{failure}");
    let outside = field.conserves(&volterra).at(&[-1.0, 1.0]);
    outside.expect("the logarithm drops out of the derivative");
    let root = quantity!(|x: [_; 2]| x[0].sqrt());
    let failure = field.conserves(&root).at(&[-1.0, 1.0]).expect_err("√-1");
    assert!(matches!(failure, AssertionFailure::Undefined { .. }), "{failure}");
}

/// A support function h of degree 2, such as the square of a radius typed by mistake.
struct Squared;

impl Body for Squared {
    fn support<T: Scalar>(&self, gamma: [T; 3]) -> T {
        gamma.iter().map(|x| *x * *x).sum::<T>() + gamma[2] * gamma[2]
    }
}

#[test]
fn a_support_function_that_is_not_homogeneous_is_noticed() {
    let inertia = [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 2.5]];
    let state = On { level: RollingLevel, coordinates: [0.5, -0.25, 1.0, 0.75, -0.5] };
    let rolling = Rolling::on_plane(Squared, 1.0, inertia);
    let failure = rolling.conserves(&rolling.energy()).at(&state).expect_err("degree 2");
    assert!(failure.to_string().contains("condition of the field"), "{failure}");
    let rolling = Rolling::on_plane(OnUnitSphere(Squared), 1.0, inertia);
    rolling.conserves(&rolling.energy()).at(&state).expect("continued from the sphere");
    let skew = [[2.0, 0.5, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 2.5]];
    let rolling = Rolling::on_plane(Polynomial { terms: vec![([0; 3], 1.0)] }, 1.0, skew);
    assert!(rolling.conserves(&rolling.energy()).at(&state).is_err(), "I is not symmetric");
}
