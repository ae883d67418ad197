//! Densities of the file: those of the class that is excluded refute a claim, and no others do.

use liouville::verdict::{ClaimReport, Verdict};

use crate::absence::{Dice, only};

/// A field on the plane with the density ρ, and Hamilton's function H.
fn with_density(density: &str, slopes: [&str; 2], degree: u32) -> ClaimReport {
    let [along_x, along_y] = slopes;
    only(&format!(
        "title = 't'\n[state]\nx = '0.5..1'\ny = '0.5..1'\n[field]\n\"x'\" = '({along_y})/({density})'\n\
         \"y'\" = '-({along_x})/({density})'\n[[claim]]\ndensity = '{density}'\n\
         [[claim]]\nno-density = {{ degree = {degree} }}\nexpect = 'open'\n"
    ))
}

#[test]
fn a_claimed_density_refutes_what_it_contradicts() {
    let mut dice = Dice(3);
    // The density, and the least degree of a class that contains it.
    let densities = [
        ("x² + y + 3", Some(2)),
        ("1/(x² + y + 3)", Some(2)),
        ("√(x*y² + 3)", Some(3)),
        ("(x + 2*y)^(-1/3)", Some(1)),
        ("(x + y + 1)^(3/4)", Some(3)),
        ("exp(x*y)", Some(2)),
        ("exp(-x^3)", Some(3)),
        ("(x + y + 1)^(1/5)", None),
        ("exp(x)*(y + 3)", None),
        ("exp(1/x)", None),
        ("(x + 2)/(y + 1)", None),
        ("ln(x + 3)", None),
        ("x + √(x + y)", None),
    ];
    for (density, least) in densities {
        let (a, b, c) = (dice.unit(), dice.unit(), dice.roll(1, 5));
        // H = a x³/3 + b x y + c y³/3 + y
        let slopes = [format!("{a}*x² + {b}*y"), format!("{b}*x + {c}*y² + 1")];
        for degree in 0..=4 {
            let report = with_density(density, [&slopes[0], &slopes[1]], degree);
            let exhibit = report.evidence.exhibit.unwrap_or_default();
            let own = exhibit == format!("density, proved: {density}");
            match least {
                Some(least) if least <= degree => {
                    assert_eq!(report.verdict, Verdict::Refuted, "{density}, {degree}");
                }
                _ => assert!(!own, "{density} is not of degree {degree}: {exhibit}"),
            }
        }
    }
}

#[test]
fn a_claimed_density_of_the_positions_refutes() {
    let moving = |density: &str, degree: u32| {
        only(&format!(
            "title = 't'\nsystem = 'nonholonomic'\n[state]\nx = '0.5..1'\n\"x'\" = '0.5..1'\n\
             [lagrangian]\nkinetic = \"x'^2/2\"\nforces = {{ x = \"-x'^2\" }}\n[[claim]]\n\
             density = \"{density}\"\nexpect = 'open'\n\
             [[claim]]\nno-density = {{ degree = {degree} }}\nexpect = 'open'\n"
        ))
    };
    let found = moving("exp(2*x)", 0);
    assert_eq!(found.verdict, Verdict::Refuted, "{:?}", found.evidence);
    assert_eq!(found.evidence.exhibit.as_deref(), Some("density, proved: exp(2*x)"));
    // A claim that is refuted is no density; nor is one proved elsewhere.
    let wrong = moving("exp(3*x)", 0).evidence.exhibit.unwrap_or_default();
    assert!(!wrong.contains("exp(3*x)"), "{wrong}");
}

#[test]
fn a_density_off_the_level_refutes_nothing_on_it() {
    // In the plane x y² is a density near no level; on x = 1 the volume is that of y.
    let text = "title = 't'\n[state]\nx = '0.5..1'\ny = '0.5..1'\n[level]\nequations = ['x = 1']\n[field]\n\
                \"x'\" = 'x - 1'\n\"y'\" = '-y'\n[[claim]]\ndensity = '1'\nwhere = 'everywhere'\n\
                [[claim]]\nno-density = { degree = 0 }\nexpect = 'open'\n";
    assert_ne!(only(text).verdict, Verdict::Refuted);
}

#[test]
fn the_determinant_of_the_masses_is_a_density_without_constraints() {
    let lagrangian = |kinetic: &str, rest: &str| {
        only(&format!(
            "title = 't'\nsystem = 'nonholonomic'\n[state]\nr = '1..2'\ns = '0.5..1'\n\"r'\" = '-1..1'\n\
             \"s'\" = '0.5..1'\n[lagrangian]\nkinetic = \"{kinetic}\"\n{rest}\
             [[claim]]\nno-density = {{ degree = 0 }}\nexpect = 'open'\n"
        ))
    };
    for kinetic in ["(r'² + r²*s'²)/2", "(2 + s)*r'² + r'*s' + r*s'²", "√(1 + r'²) + r*s'²"]
    {
        let found = lagrangian(kinetic, "potential = 'r²*s'\n");
        let exhibit = found.evidence.exhibit.clone().unwrap_or_default();
        let is_linear = !kinetic.contains('√');
        if is_linear {
            assert_eq!(found.verdict, Verdict::Refuted, "{kinetic}: {:?}", found.evidence);
        }
        assert_eq!(exhibit.contains("det(["), is_linear, "{kinetic}: {exhibit}");
    }
    // Friction that depends on the velocity leaves none.
    let damped = lagrangian("(r'² + r²*s'²)/2", "forces = { r = \"-r'\" }\n");
    assert_eq!(damped.verdict, Verdict::Proved, "{:?}", damped.evidence);
}
