//! Theorems on fields with roots whose ratio is a number: √(9x) is 3√x, and not −3√x.

use std::ops::RangeInclusive;

use liouville::case::Case;
use liouville_search::{Ansatz, Effort, Hamiltonians, search};

/// A motion of x on a line or of x and y in a plane, with positive coordinates.
fn motion(more: &str) -> String {
    let state = match more.contains('y') {
        true => "x = '1..2'\ny = '1..2'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n",
        false => "x = '1..2'\n\"x'\" = '-1..1'\n",
    };
    let squares = if more.contains('y') { "x'² + y'²" } else { "x'²" };
    format!("title = 't'\n[state]\n{state}[lagrangian]\nkinetic = \"({squares})/2\"\n{more}\n")
}

/// The theorems, and what is found with its kind.
fn told(text: &str, effort: &Effort) -> (Vec<String>, Vec<String>) {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = search(&case, effort, &mut |_| {}).expect("it can be searched");
    let theorems = report.excluded.iter().map(|own| own.theorem.clone()).collect();
    let found = report.found.iter().map(|own| format!("{}: {}", own.kind, own.text())).collect();
    (theorems, found)
}

fn of_seed(seed: u64) -> Effort {
    let mut effort = Effort { degree: 2, by_class: false, ..Effort::default() };
    effort.options.seed = seed;
    effort
}

#[test]
fn friction_that_is_zero_excludes_no_density() {
    for seed in 1..=4 {
        for zero in ["√(9*x) − 3*√x", "√(2809*x) − 53*√x", "√(6 − 2*√5) − √5 + 1"]
        {
            let text =
                motion(&format!("potential = 'x'\nforces = {{ x = \"({zero})*(1 + x)*x'\" }}"));
            let (theorems, found) = told(&text, &of_seed(seed));
            assert!(found.contains(&"density: 1".to_string()), "{zero}: {found:?}");
            let is_false = |own: &String| own.contains("no invariant density");
            assert!(!theorems.iter().any(is_false), "{zero}, seed {seed}: {theorems:?}");
        }
    }
}

#[test]
fn forces_that_cancel_leave_all_integrals() {
    forces_cancel(1..=1);
}

#[test]
#[ignore = "slow: three more seeds"]
fn forces_that_cancel_leave_all_integrals_for_each_seed() {
    forces_cancel(2..=4);
}

fn forces_cancel(seeds: RangeInclusive<u64>) {
    for seed in seeds {
        for potential in [
            "(x² + y²)/2 + (√(121*x) − 11*√x)*y",
            "(√(3 + 2*√2) − √2)*x²/2 + y²/2",
            "|x + 1| + |y − 0*x| − √(1369*(x + 1)²)/37 − y + (x² + y²)/2",
            "√((1 + √2)^2*x) − (1 + √2)*√x + (x² + y²)/2",
            "√((2 + √3)*x) − (√6 + √2)/2*√x + (x² + y²)/2",
            "√(3*y + √8*y) − √y − √(2*y) + (x² + y²)/2",
            "√((1 + 2^(1/3))^2*y) − (1 + 2^(1/3))*√y + (x² + y²)/2",
        ] {
            let text = motion(&format!("potential = '{potential}'"));
            let (theorems, _) = told(&text, &of_seed(seed));
            let is_false = |own: &String| own.ends_with("is a polynomial in the energy");
            assert!(!theorems.iter().any(is_false), "{potential}, seed {seed}: {theorems:?}");
        }
    }
}

#[test]
fn brackets_and_sums_with_such_roots_are_not_excluded() {
    let field = |x: &str, y: &str| {
        format!(
            "title = 't'\n[state]\nx = '1..2'\ny = '1..2'\n[field]\n\"x'\" = '{x}'\n\"y'\" = '{y}'\n"
        )
    };
    for seed in 1..=4 {
        let effort =
            Effort { poisson: Some(Hamiltonians::Given("x".to_string())), ..of_seed(seed) };
        let (theorems, found) = told(&field("(√(121*x) − 11*√x)*y", "1"), &effort);
        assert!(!theorems.iter().any(|own| own.contains("no skew P")), "{theorems:?}");
        assert!(
            found.iter().any(|own| own.contains("{x, y}") || own.contains("bracket")),
            "{found:?}"
        );
        let effort = Effort {
            ansatz: Ansatz { wanted: true, positions: 2, ..Ansatz::default() },
            ..of_seed(seed)
        };
        let (theorems, _) = told(&field("√(25*x) − 5*√x", "√(3 + 2*√2) − √2 − 1"), &effort);
        let is_false = |own: &String| own.contains("dimension at most") && !own.contains("most 6");
        assert!(!theorems.iter().any(is_false), "x and y: {theorems:?}");
    }
}

#[test]
fn numbers_under_roots_that_are_no_ratio_leave_theorems() {
    // Kepler's problem with √2 in place of the mass: energy, angular momentum and Laplace's vector.
    let text = "title = 't'\n[state]\nx = '0.5..2'\ny = '0.5..2'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n\
                [lagrangian]\nkinetic = \"(x'² + y'²)/2\"\npotential = '-√2/√(x² + y²)'\n";
    let (theorems, _) = told(text, &of_seed(1));
    assert!(!theorems.is_empty(), "√2 is not under the root of the state");
}

#[test]
fn independent_roots_of_irrational_multiples_leave_theorems() {
    independent_roots(&ROOTS[2..4], 1..=1);
}

#[test]
#[ignore = "slow: all of these roots, at three seeds"]
fn independent_roots_of_irrational_multiples_leave_theorems_for_each_seed() {
    independent_roots(&ROOTS, 1..=3);
}

/// Potentials, and whether theorems remain: the roots of √2 x and of y have no ratio, and 1 + √2 is no
/// square.
const ROOTS: [(&str, bool); 6] = [
    ("√(√2*x) + (x² + y²)/2", true),
    ("√(√2*x) + √y*x", true),
    ("√((1 + √2)*x*y) + √((1 + √2)*x)", true),
    ("√(√2*x)*√(2*x) − 2^(3/4)*x + (x² + y²)/2", false),
    ("√(2 + √2)*√(2 − √2)*x²/2 + y²/√2", false),
    ("√(√2*x + √y) + x*y", false),
];

fn independent_roots(potentials: &[(&str, bool)], seeds: RangeInclusive<u64>) {
    for (potential, is_excluded) in potentials {
        for seed in seeds.clone() {
            let text = motion(&format!("potential = '{potential}'"));
            let (theorems, _) = told(&text, &of_seed(seed));
            assert_eq!(!theorems.is_empty(), *is_excluded, "{potential}, {seed}: {theorems:?}");
        }
    }
}

#[test]
fn a_variable_that_is_zero_on_the_level_hides_no_integral() {
    // The other variables turn; u and its rate are 0.
    let text = "title = 't'\n[state]\nu = '-1..1'\nx = '-1..1'\ny = '-1..1'\n[field]\n\"u'\" = 'u*x'\n\
                \"x'\" = 'y + u'\n\"y'\" = '−2*x'\n[level]\nequations = ['u = 0']\n";
    let (_, found) = told(text, &Effort { by_class: true, ..of_seed(1) });
    let is_integral = |own: &&String| own.starts_with("integral") && own.contains("x²");
    assert!(found.iter().any(|own| is_integral(&own)), "2x² + y²: {found:?}");
}
