//! Lagrangian systems with nonholonomic constraints and angles: counts in independent velocities.

use liouville::verdict::{ClaimReport, Verdict};

use super::{Dice, only, plants};

/// A system with these variables, each with a velocity, and one claim of absence.
fn lagrangian(variables: &[&str], text: &str, claim: &str) -> String {
    let ranges: String = variables
        .iter()
        .flat_map(|name| [format!("\"{name}\" = '-2..2'\n"), format!("\"{name}'\" = '-2..2'\n")])
        .collect();
    format!(
        "title = 't'\nsystem = 'nonholonomic'\n[parameters]\nm = '0.5..2'\nJ = '0.5..2'\na = '0.5..1'\n\
         g = '1..2'\n\"α\" = '0.1..1'\n[state]\n{ranges}[lagrangian]\n{text}\n[[claim]]\n{claim}\n\
         expect = 'open'\n"
    )
}

fn sleigh(potential: &str, claim: &str) -> ClaimReport {
    let text = format!(
        "kinetic = \"m*((x' − a*sin(φ)*φ')² + (y' + a*cos(φ)*φ')²)/2 + J*φ'²/2\"\n\
         potential = \"{potential}\"\nconstraints = [\"x'*sin(φ) − y'*cos(φ) = 0\"]"
    );
    only(&lagrangian(&["x", "y", "φ"], &text, claim))
}

fn theorem(report: &ClaimReport) -> String {
    assert_eq!(report.verdict, Verdict::Proved, "{:?}", report.evidence);
    report.evidence.theorem.clone().unwrap_or_default()
}

#[test]
fn a_sleigh_on_an_incline_has_the_energy_and_no_measure() {
    let slope = "−m*g*sin(α)*(x + a*cos(φ))";
    let found = theorem(&sleigh(slope, "no-integral = { degree = 2 }"));
    assert!(found.contains("is a polynomial in the energy."), "{found}");
    let found = theorem(&sleigh(slope, "no-density = { degree = 2 }"));
    assert!(found.contains("no invariant density of the positions alone"), "{found}");
}

#[test]
fn a_sleigh_on_a_plane_has_two_linear_integrals_and_a_density() {
    // φ' cos κφ + c v sin κφ and φ' sin κφ − c v cos κφ, κ² = ma²/(J + ma²).
    let found = sleigh("0*x", "no-integral = { degree = 1 }");
    let reason = found.evidence.reason.unwrap_or_default();
    assert!(reason.contains("at most 3 linearly independent integrals"), "{reason}");
    let found = sleigh("0*x", "no-density = { degree = 1 }");
    assert_eq!(found.verdict, Verdict::Refuted, "{:?}", found.evidence);
    assert!(found.evidence.exhibit.unwrap_or_default().contains("φ'"));
}

#[test]
fn a_double_pendulum_has_the_energy_alone() {
    let text = "kinetic = \"(m + 1)*φ'²/2 + a²*θ'²/2 + a*φ'*θ'*cos(φ − θ)\"\n\
                potential = \"−g*((m + 1)*cos(φ) + a*cos(θ))\"";
    let judged = |claim: &str| only(&lagrangian(&["φ", "θ"], text, claim));
    let found = theorem(&judged("no-integral = { degree = 4 }"));
    assert!(found.contains("is a polynomial in the energy."), "{found}");
    // Without gravity the sum of the momenta is kept.
    let free = text.replace("g*", "0*");
    let found = only(&lagrangian(&["φ", "θ"], &free, "no-integral = { degree = 1 }"));
    assert_eq!(found.verdict, Verdict::Refuted, "{:?}", found.evidence);
}

#[test]
fn a_constraint_that_can_be_integrated_is_not_counted() {
    let text = "kinetic = \"(x'² + y'² + z'²)/2\"\npotential = \"x*y³ + z³*x\"\n\
                constraints = [\"z' = 2*y*y'\"]";
    for claim in ["no-integral = { degree = 1 }", "no-density = { degree = 0 }"] {
        // z − y² is kept, and every function of it.
        let found = only(&lagrangian(&["x", "y", "z"], text, claim));
        assert_ne!(found.verdict, Verdict::Proved, "{claim}: {:?}", found.evidence);
    }
    let text = text.replace("z' = 2*y*y'", "z'² = x'² + y'²");
    let found = only(&lagrangian(&["x", "y", "z"], &text, "no-integral = { degree = 1 }"));
    let reason = found.evidence.reason.unwrap_or_default();
    assert!(reason.contains("not linear in the velocities"), "{reason}");
}

#[test]
fn planted_integrals_of_constrained_motion_are_never_excluded() {
    // Z' = f(Y) X' pushes along X and Z alone, so that Y'²/2 + h(Y) is kept for U = g(X) + h(Y).
    let mut dice = Dice(11);
    let (mut refuted, mut proved) = (0, 0);
    let all = plants(5);
    for plant in 0..all {
        let rows = loop {
            let rows: [[i64; 3]; 3] =
                std::array::from_fn(|_| std::array::from_fn(|_| dice.roll(-2, 2)));
            let [a, b, c] = rows;
            let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
            if a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1) != 0 {
                break rows;
            }
        };
        let form = |k: usize, mark: &str| {
            let [a, b, c] = rows[k];
            format!("(({a})*x{mark} + ({b})*y{mark} + ({c})*z{mark})")
        };
        let [[x, dx], [y, dy], [_, dz]] = [0, 1, 2].map(|k| [form(k, ""), form(k, "'")]);
        let slope = [format!("(1 + {y})"), format!("{y}²")][plant % 2].clone();
        let degree = 1 + plant % 2;
        let (h, kept) = match degree {
            1 => ("0".to_string(), dy.clone()),
            _ => (format!("({y}⁴ + ({})*{y})", dice.unit()), format!("{dy}²/2 + {y}⁴")),
        };
        let (u, v) = (dice.unit(), dice.unit());
        let text = format!(
            "kinetic = \"({dx}² + {dy}² + {dz}²)/2\"\npotential = \"({u})*{x}³ + ({v})*{x} + {h}\"\n\
             constraints = [\"{dz} = {slope}*{dx}\"]"
        );
        let claim = format!("no-integral = {{ degree = {degree} }}");
        let found = only(&lagrangian(&["x", "y", "z"], &text, &claim));
        assert_ne!(found.verdict, Verdict::Proved, "{kept} is kept:\n{text}");
        refuted += usize::from(found.verdict == Verdict::Refuted);
        // With another force along Y, none is left.
        let mixed = text.replace("potential = \"", &format!("potential = \"{x}²*{y}³ + "));
        let found = only(&lagrangian(&["x", "y", "z"], &mixed, &claim));
        proved += usize::from(found.verdict == Verdict::Proved);
    }
    assert!(refuted * 5 >= all * 2, "{refuted} of {all} plants are exhibited");
    assert!(
        proved * 5 >= all * 3,
        "{proved} of {all} systems without the integral are proved to have none"
    );
}

#[test]
fn a_density_of_a_constrained_particle_refutes_that_there_is_none() {
    // Rosenberg's particle: (1 + y²)^(−1/2) in the momenta, (1 + y²)^(1/2) in the velocities x', y'.
    let text = "kinetic = \"(x'² + y'² + z'²)/2\"\nconstraints = [\"z' = y*x'\"]";
    let found = only(&lagrangian(&["x", "y", "z"], text, "no-density = { degree = 0 }"));
    assert_eq!(found.verdict, Verdict::Refuted, "{:?}", found.evidence);
    let exhibit = found.evidence.exhibit.unwrap_or_default();
    assert!(exhibit.contains("1 + y²"), "{exhibit}");
}

#[test]
fn roots_of_known_integrals_are_read_in_the_names_of_the_independent_velocities() {
    for slope in ["exp(x)", "sin(x)"] {
        let text = format!(
            "kinetic = \"(x'² + y'² + z'²)/2\"\nconstraints = [\"z' = y'*{slope}\"]\n[[claim]]\n\
             integral = \"√(1 + {slope}^2)*y'\""
        );
        let claim = "no-integral = { degree = 1 }";
        let found = only(&lagrangian(&["x", "y", "z"], &text, claim));
        // x' is one, too.
        assert_ne!(found.verdict, Verdict::Proved, "{slope}: {:?}", found.evidence);
    }
}
