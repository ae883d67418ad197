//! Built-in fields compared with the raw Newton–Euler equations with multipliers.
//!
//! Energy, γ² and (ω,γ) are conserved also by a field with the central inertia tensor in its
//! gyroscopic term; only the equations themselves distinguish the two.

mod bodies;
mod multipliers;

use crate::common::case;
use crate::common::drawn::Drawn;
use bodies::{BODIES, Body, Load};
use multipliers::{Acceleration, Moment};
use nalgebra::{Matrix3, Vector3};

const STATES: u64 = 16;

/// Computes γ' of a rolling body. The contact moves equally fast along both surfaces: γ/k is the
/// vector from the centre of the fixed ball to the contact, so that (γ' + ω×γ)/k = r', with r' =
/// (∂r/∂γ)γ'.
fn rolling(
    slope: &Matrix3<f64>,
    k: f64,
    gamma: &Vector3<f64>,
    omega: &Vector3<f64>,
) -> Vector3<f64> {
    let turning = Matrix3::identity() - slope * k;
    turning.lu().solve(&gamma.cross(omega)).expect("the radii of curvature do not agree")
}

/// Computes the moment exerted by a potential: its power is that of U along every motion, so that
/// (M,ω) = -(∂U/∂γ,γ') for each ω. Its component along γ is taken up by the constraint.
fn moment(
    slope: &Matrix3<f64>,
    k: f64,
    gamma: &Vector3<f64>,
    force: &Vector3<f64>,
) -> Vector3<f64> {
    Vector3::from_fn(|i, _| -force.dot(&rolling(slope, k, gamma, &Vector3::ith(i, 1.0))))
}

fn moment_of(body: &Body, at: &Drawn) -> Moment {
    let (omega, gamma) = (at.vector("ω"), at.vector("γ"));
    let (r, slope) = body.contact(at);
    let k = if body.curved { at.scalar("k") } else { 0.0 };
    let gamma_rate = rolling(&slope, k, &gamma, &omega);
    let mass = at.scalar("m");
    let nothing = Vector3::zeros();
    let (force, torque) = match body.load {
        Load::Nothing => (nothing, nothing),
        Load::Weight => (-gamma * (mass * at.scalar("a_g")), nothing),
        Load::Potential => (nothing, moment(&slope, k, &gamma, &body.slope(at))),
    };
    Moment {
        mass,
        inertia: at.matrix("I"),
        rotor: at.vector_or_zero("S"),
        omega,
        gamma,
        gamma_rate,
        r,
        r_rate: slope * gamma_rate,
        force,
        torque,
    }
}

/// Asserts that the library's results agree within both errors.
fn assert_same(at: &Drawn, first: usize, ours: &[f64], error: f64, what: &str) {
    for (i, expected) in ours.iter().enumerate() {
        let (found, radius) = at.report.field[first + i].expect("the field is defined");
        let distance = (found - expected).abs();
        assert!(
            distance <= error + radius,
            "{what}, component {i}: {found} against {expected}, apart by {distance:e}, \
             where {error:e} + {radius:e} is allowed"
        );
    }
    let largest = ours.iter().fold(1.0, |a: f64, b| a.max(b.abs()));
    assert!(error <= f64::EPSILON.sqrt() * largest, "{what}: ± {error:e} leaves too few digits");
}

#[test]
fn every_rubber_field_solves_newtons_and_eulers_equations() {
    every_field_solves_the_equations(false);
}

#[test]
fn every_field_with_spin_solves_newtons_and_eulers_equations() {
    every_field_solves_the_equations(true);
}

fn every_field_solves_the_equations(spins: bool) {
    for body in &BODIES {
        let case = case(&body.case_text(spins));
        for index in 0..STATES {
            let at = Drawn::new(&case, index);
            let moment = moment_of(body, &at);
            let spin = moment.omega.dot(&moment.gamma).abs();
            assert_eq!(spin > 1e-6, spins, "{}: (ω,γ) = {spin:e}", body.name);
            let Acceleration { value, error } = moment.solve(spins);
            let what = format!("{} at {index}, spins: {spins}", body.name);
            assert_same(&at, 0, value.as_slice(), error, &format!("{what}, ω'"));
            let rate = moment.gamma_rate;
            let (_, slope) = body.contact(&at);
            let turning =
                Matrix3::identity() - slope * if body.curved { at.scalar("k") } else { 0.0 };
            let condition = turning.norm() / turning.singular_values().min();
            let error = multipliers::ROUNDINGS
                * f64::EPSILON
                * condition
                * rate.norm().max(moment.omega.norm());
            assert_same(&at, 3, rate.as_slice(), error, &format!("{what}, γ'"));
        }
    }
}

#[test]
fn the_flat_base_solves_newtons_and_eulers_equations() {
    let text = "title = \"flat base\"\nsystem = \"flat-base\"\n[parameters]\nm = \"0.5..2\"\n\
                I = \"full(0.5..5)\"\nz = \"one of -3/4, 2/3, -1/3\"\nk = \"one of 1/2, -2/3, 5/4\"\n\
                S = \"vector(-2..2)\"\n[body]\ngyrostat = \"S\"\n";
    let case = case(text);
    for index in 0..4 * STATES {
        let at = Drawn::new(&case, index);
        let omega = Vector3::new(at.scalar("ω1"), at.scalar("ω2"), 0.0);
        let gamma = Vector3::z();
        // γ stays e₃ in the body: 0 = γ×ω + k r'.
        let r_rate = -gamma.cross(&omega) / at.scalar("k");
        let moment = Moment {
            mass: at.scalar("m"),
            inertia: at.matrix("I"),
            rotor: at.vector("S"),
            omega,
            gamma,
            gamma_rate: Vector3::zeros(),
            r: Vector3::new(at.scalar("r1"), at.scalar("r2"), at.scalar("z")),
            r_rate,
            force: Vector3::zeros(),
            torque: Vector3::zeros(),
        };
        let Acceleration { value, error } = moment.solve(false);
        let what = format!("flat base at {index}");
        assert_same(&at, 0, &[value.x, value.y], error, &format!("{what}, ω'"));
        let error = 4.0 * f64::EPSILON * r_rate.norm();
        assert_same(&at, 2, &[r_rate.x, r_rate.y], error, &format!("{what}, r'"));
    }
}

/// The spin of a rubber body is held at 0 by λ; a body that may spin changes it.
#[test]
fn the_spin_of_a_free_body_changes() {
    let mut seen = 0;
    for body in &BODIES {
        let case = case(&body.case_text(true));
        let at = Drawn::new(&case, 0);
        let moment = moment_of(body, &at);
        let rate =
            moment.solve(true).value.dot(&moment.gamma) + moment.omega.dot(&moment.gamma_rate);
        seen += usize::from(rate.abs() > 1e-3);
    }
    assert_eq!(seen, BODIES.len(), "bodies with a rate of (ω,γ)");
}

/// Rates of a field with the tensor T in its gyroscopic term, with bounds on the errors.
struct Variant {
    rate: Vector3<f64>,
    rate_error: f64,
    power: f64,
    power_error: f64,
}

/// Computes Ĩω' = Tω×ω - m r×(ω×r') + λγ, and the rate of ½(ω,Ĩω).
fn variant(moment: &Moment, tensor: &Matrix3<f64>) -> Variant {
    let Moment { mass, omega, gamma, r, r_rate, .. } = moment;
    let at_contact = contact_inertia(moment);
    let slide = r.cross(&omega.cross(r_rate)) * *mass;
    let torque = (tensor * omega).cross(omega) - slide;
    let lu = at_contact.lu();
    let solve = |b: &Vector3<f64>| lu.solve(b).expect("Ĩ is positive");
    let along = solve(gamma);
    let multiplier = -(torque.dot(&along) + omega.dot(&moment.gamma_rate)) / gamma.dot(&along);
    let rate = solve(&(torque + gamma * multiplier));
    let changing = omega.norm_squared() * r.dot(r_rate) - omega.dot(r) * omega.dot(r_rate);
    // |δω'| ≤ |Ĩ⁻¹| (rounding errors of the terms of Ĩω' and of the solution).
    let sizes = tensor.norm() * omega.norm_squared()
        + slide.norm()
        + multiplier.abs()
        + at_contact.norm() * rate.norm();
    let rounding = multipliers::ROUNDINGS * f64::EPSILON;
    let rate_error = rounding * sizes / at_contact.singular_values().min();
    let swing = mass * omega.norm_squared() * r.norm() * r_rate.norm();
    Variant {
        rate,
        rate_error,
        power: omega.dot(&(at_contact * rate)) + mass * changing,
        power_error: omega.norm() * at_contact.norm() * rate_error + rounding * swing,
    }
}

fn contact_inertia(moment: &Moment) -> Matrix3<f64> {
    let r = moment.r;
    let spread = Matrix3::identity() * r.norm_squared() - r * r.transpose();
    moment.inertia + spread * moment.mass
}

#[test]
fn no_energy_test_sees_the_central_tensor_in_the_gyroscopic_term() {
    let free = |body: &&Body| {
        body.load == Load::Nothing && !body.parameters.iter().any(|p| p.starts_with('S'))
    };
    let mut seen = 0;
    for body in BODIES.iter().filter(free) {
        let case = case(&body.case_text(false));
        for index in 0..STATES {
            let moment = moment_of(body, &Drawn::new(&case, index));
            let Acceleration { value, error } = moment.solve(false);
            let what = format!("{} at {index}", body.name);
            for (tensor, right) in [(contact_inertia(&moment), true), (moment.inertia, false)] {
                let Variant { rate, rate_error, power, power_error } = variant(&moment, &tensor);
                assert!(
                    power.abs() <= power_error,
                    "{what}: both conserve energy, yet it changes at {power:e} > {power_error:e}"
                );
                let (gap, bound) = ((rate - value).norm(), error + rate_error);
                assert_eq!(gap <= bound, right, "{what}: apart by {gap:e}, errors {bound:e}");
            }
            seen += 1;
        }
    }
    assert_eq!(seen, 8 * STATES, "all bodies that nothing acts on");
}
