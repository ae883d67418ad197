//! Elimination with leading minors that vanish where the determinant does not: no state is lost by it, and none gained.

use liouville::case::Case;
use liouville::verdict::{CaseReport, Options, Verdict, judge};

use Verdict::{Proved, Refuted, Undecided};

fn judged(text: &str) -> CaseReport {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn verdicts(text: &str) -> Vec<Verdict> {
    judged(text).claims.iter().map(|claim| claim.verdict).collect()
}

/// Writes a Lagrangian with a chain of seven coordinates, of which the first is tied to y: one block of masses of more
/// rows than are solved by minors; with no `chain`, these are free.
fn lagrangian(
    (parameters, coordinates): (&str, &[&str]),
    (kinetic, potential, chain): (&str, &str, bool),
    (sections, claims): (&str, &[&str]),
) -> String {
    let links: Vec<String> = (1..=7).map(|k| format!("u{k}")).collect();
    let names = coordinates.iter().map(ToString::to_string).chain(links.iter().cloned());
    let with_range = |name: String| {
        let (name, range) = name.split_once('=').unwrap_or((&name, "-2..2"));
        format!("{name} = '{range}'\n\"{name}'\" = '-2..2'\n")
    };
    let state: String = names.map(with_range).collect();
    let pair = |k: usize| match (chain, k) {
        (true, 0) => "(y' - u1')^2/2".to_string(),
        (true, 7) => "u7'^2/2".to_string(),
        (true, _) => format!("(u{k}' - u{}')^2/2", k + 1),
        (false, 0) => "0".to_string(),
        (false, _) => format!("u{k}'^2/2"),
    };
    let springs: Vec<String> = (0..=7).map(pair).collect();
    let claims: String =
        claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = 'open'\n")).collect();
    format!(
        "title = 'x'\ncheck-weights = false\n[parameters]\n{parameters}\n[state]\n{state}[lagrangian]\n\
         kinetic = \"{kinetic} + {}\"\npotential = \"{potential}\"\n{sections}{claims}",
        springs.join(" + ")
    )
}

#[test]
fn formulas_with_rates_are_asked_for_values() {
    // √z has no value for z < 0, where the residual is not 0.
    let claims = ["identity = \"0*sqrt(z) + u1''*(|z| - z) = 0\""];
    for chain in [false, true] {
        let text = lagrangian(
            ("k = '-1..1'\nb = '9999/10000'", &["x", "y", "z"]),
            ("(|k-b| - k + b)*x'^2/2 + x'*y' + 200*y'^2 + z'^2/2", "y + u1", chain),
            ("", &claims),
        );
        assert_ne!(verdicts(&text), [Refuted], "{chain}");
    }
}

#[test]
fn slopes_of_energies_are_asked_for_values() {
    // A potential without slope for z < 0.
    for chain in [false, true] {
        let text = lagrangian(
            ("k = '-1..1'\nb = '9999/10000'", &["x", "y", "z"]),
            ("(|k-b| - k + b)*x'^2/2 + x'*y' + 200*y'^2 + z'^2/2", "y + sqrt(max(z,0))", chain),
            ("", &["identity = '|z| = z'", "identity = '|k-b| = b-k'"]),
        );
        let found = judged(&text);
        let warned = found.warnings.iter().any(|own| own.contains("have no value"));
        assert!(warned, "{chain}: {:?}", found.warnings);
        let found: Vec<Verdict> = found.claims.iter().map(|claim| claim.verdict).collect();
        assert_eq!(found, [Proved, Refuted], "{chain}");
    }
}

#[test]
fn no_part_of_a_level_is_lost() {
    // On the part s = 0 the first mass is 0, D = −1, and w is free.
    let level = "forces = { x = \"x'*s'\", s = \"-x'^2/2\" }\n[level]\nequations = ['s*w = 0', \"s' = 0\", \"w' = 0\"]\n";
    for (chain, wrong) in [(false, Refuted), (true, Undecided)] {
        let text = lagrangian(
            ("", &["x", "y", "s=-0.001..2", "w"]),
            ("s*x'^2/2 + x'*y' + 200*y'^2 + s'^2/2 + w'^2/2", "x + 200*y", chain),
            (level, &["identity = 'w = 0'", "integral = \"w*y'\""]),
        );
        let found = verdicts(&text);
        assert!(found.iter().all(|own| *own == wrong || *own == Refuted), "{chain}: {found:?}");
    }
}

#[test]
fn no_multiplier_divides_by_a_minor() {
    let level = "forces = { x = \"x'*s'\", s = \"-x'^2/2\" }\n[level]\nequations = ['s*(s-1) = 0', \"s' = 0\"]\n";
    for chain in [false, true] {
        let text = lagrangian(
            ("", &["x", "y", "s=-0.001..2"]),
            ("s*x'^2/2 + x'*y' + 200*y'^2 + s'^2/2", "x + 200*y", chain),
            (level, &["integral = \"(s-1)*y'\"", "identity = 's = 1'"]),
        );
        let found = verdicts(&text);
        assert!(!found.contains(&Proved), "{chain}: {found:?}");
    }
}

#[test]
fn no_cofactor_divides_by_a_minor() {
    for chain in [false, true] {
        let text = lagrangian(
            ("", &["x", "y", "s=-0.0001..2"]),
            ("s*x'^2/2 + x'*y' + 200*y'^2 + s'^2/2", "200*y", chain),
            ("", &["invariant-relation = '2*s'\ncofactor = \"s'/s\""]),
        );
        assert_ne!(verdicts(&text), [Proved], "{chain}");
    }
}

#[test]
fn masses_may_vanish_at_a_limit_and_at_a_rest() {
    let wheel = "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nm = '0.5..2'\nR = '0.5..2'\ng = '0.5..2'\n\
                 J = '0.5..1'\n'ε' = '0..1'\n[state]\nx = '-2..2'\ny = '-2..2'\nf = '-3..3'\np = '-3..3'\n\
                 \"x'\" = '-2..2'\n\"y'\" = '-2..2'\n\"f'\" = '-2..2'\n\"p'\" = '-2..2'\n[lagrangian]\n\
                 kinetic = \"m*(x'^2+y'^2)/2 + J*f'^2/2 + ε*p'^2/2\"\npotential = 'g*x'\n\
                 constraints = [\"x' = R*p'*cos(f)\", \"y' = R*p'*sin(f)\"]\n\
                 [[claim]]\nlimit = \"p''\"\nparameter = 'ε'\nequals = '-g*cos(f)/(m*R)'\n\
                 [[claim]]\nlimit = \"p''\"\nparameter = 'ε'\nequals = 'g*cos(f)/(m*R)'\nexpect = 'fails'\n\
                 [[claim]]\nlimit = \"μ1\"\nparameter = 'ε'\nequals = \"g*sin(f)^2 - m*R*p'*sin(f)*f'\"\n";
    assert_eq!(verdicts(wheel), [Proved, Refuted, Proved]);
}
