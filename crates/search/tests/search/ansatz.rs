//! Searches: the results of the papers are found with their formulas hidden, counted, excluded, and
//! bounded by conditions on the parameters.

mod bodies;
mod brackets;
mod conditions;
mod forces;
mod gyroscopic;
mod levels;
mod limits;
mod lists;

use std::path::Path;

use liouville::case::{Case, Setting};
use liouville::verdict::Verdict;
use liouville_search::{Effort, FoundKind, Given, Halt, SearchReport, search};

/// Counts and ansätze alone: searches along orbits have tests of their own.
fn effort(degree: u32) -> Effort {
    Effort { degree, by_class: false, by_factors: false, ..Effort::default() }
}

/// Searches along orbits as well.
fn whole(degree: u32) -> Effort {
    Effort { degree, ..Effort::default() }
}

fn searched(path: &str, effort: &Effort) -> SearchReport {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases"))
        .join(path)
        .with_extension("toml");
    let case = Case::read(&path, &[]).1.expect("a case of the catalogue");
    search(&case, effort, &mut |_| {}).expect("it can be searched")
}

/// Integrals with the potentials, forces or terms that they survive; all are proved.
fn told(report: &SearchReport) -> Vec<(&str, &str)> {
    let own = report.found.iter().filter(|found| !found.with.is_empty());
    let own = own.filter(|found| found.kind == FoundKind::Integral);
    own.inspect(|found| assert_eq!(found.verdict, Verdict::Proved, "{found:?}"))
        .map(|found| (found.text(), found.with[0].text()))
        .collect()
}

fn case(text: &str) -> Case {
    Case::parse(text, &[]).expect("a case")
}

#[test]
fn integrals_of_the_papers_are_found_and_proved() {
    second_integrals(&[
        "plane/unbalanced-ball",
        "plane/balanced-ball-gyrostat",
        "plane/revolution",
        "sphere/borisov-mamaev-ball-potential",
        "flat-base/symmetric-base",
        "surface/ellipsoid",
    ]);
}

#[test]
#[ignore = "slow: as one of each kind above"]
fn more_integrals_of_the_papers_are_found_and_proved() {
    second_integrals(&[
        "plane/balanced-ball",
        "plane/ellipsoid-mb-mu",
        "plane/balanced-ball-brun",
        "sphere/borisov-mamaev-ball",
        "sphere/symmetric-ball",
        "flat-base/base-through-centre",
        "surface/ellipsoid-potential",
    ]);
}

fn second_integrals(paths: &[&str]) {
    for path in paths {
        let report = searched(path, &effort(2));
        let found: Vec<_> =
            report.found.iter().filter(|found| found.kind == FoundKind::Integral).collect();
        assert_eq!(found.len(), 1, "{path}: {found:?}");
        assert_eq!(found[0].verdict, Verdict::Proved, "{path}: {}", found[0].text());
        // The library contains neither the claim nor its form: the two are shown to be dependent.
        let known = found[0].known.as_deref().unwrap_or("");
        assert!(known.starts_with("F2"), "{path}: {} comes from `{known}`", found[0].text());
        assert!(report.opinions.iter().all(|opinion| opinion.agrees()), "{path}: singular values");
        let last = report.counts.last().expect("integrals were counted");
        assert_eq!(last.dimension, last.known, "{path}: all that are counted are found");
        assert!(report.excluded[0].theorem.contains("is a polynomial in"), "{path}: a theorem");
    }
}

#[test]
fn densities_of_the_papers_are_found_and_proved() {
    let cases = [
        ("plane/revolution", "g2*√g1"),
        ("plane/spherical-inertia", "(I1*γ3² + I3*(γ1² + γ2²) + m*(r,γ)²)^(1/2)*(I1 + m*r²)"),
        ("plane/ellipsoid", "X0^(−1/2)*det(Ĩ)*(γ,Ĩ⁻¹*γ)"),
        ("plane/balanced-ball", "√(γ,J⁻¹*γ)"),
        ("sphere/balanced-ball", "(γ,J⁻¹*γ)^((1 + k*R)/2)"),
        ("sphere/ellipsoid", "det(Ĩ)*(γ,Ĩ⁻¹*γ)*D_T"),
        ("sphere/equal-sphere", "det(Ĩ)*(γ,Ĩ⁻¹*γ)"),
        ("sphere/symmetric-ball", "(I1*γ3² + I3*(γ1² + γ2²) + m*(r,γ)²)^((1 + k*R)/2)*(I1 + m*r²)"),
    ];
    for (path, formula) in cases {
        let report = searched(path, &effort(0));
        let found: Vec<&str> = report.formulas(FoundKind::Density).collect();
        assert_eq!(found, [formula], "{path}");
        let density = report.found.iter().find(|found| found.kind == FoundKind::Density);
        assert_eq!(density.map(|found| found.verdict), Some(Verdict::Proved), "{path}");
    }
}

#[test]
fn integrals_are_counted() {
    // By degree 1, 2, 3, 4; with a gyrostat or a potential all degrees up to it together.
    let cases: [(&str, [usize; 4]); 8] = [
        ("plane/balanced-ball", [0, 2, 0, 3]),
        ("plane/unbalanced-ball", [0, 2, 0, 3]),
        ("plane/ellipsoid-mb-mu", [0, 2, 0, 3]),
        ("plane/spherical-inertia", [0, 1, 0, 1]),
        ("plane/revolution", [1, 2, 2, 3]),
        ("sphere/balanced-ball", [0, 1, 0, 1]),
        ("sphere/borisov-mamaev-ball", [0, 2, 0, 3]),
        ("flat-base/symmetric-base", [1, 2, 2, 3]),
    ];
    for (path, expected) in cases {
        let report = searched(path, &effort(4));
        let counts: Vec<usize> = report.counts.iter().map(|count| count.dimension).collect();
        assert_eq!(counts, expected, "{path}");
    }
    let report = searched("plane/balanced-ball-gyrostat", &effort(4));
    let mixed: Vec<(u32, usize)> =
        report.counts.iter().filter(|c| !c.free).map(|c| (c.degree, c.dimension)).collect();
    assert_eq!(mixed, [(2, 3), (3, 3), (4, 6)], "1, E, F; and their products");
}

#[test]
fn symmetry_fields_are_found_and_proved() {
    let cases: [(&str, &[&str]); 4] = [
        ("plane/revolution", &["ω: [ω2, −ω1, 0], γ: [γ2, −γ1, 0]", "ω: [ω1, ω2, ω3]; [u,v] = v"]),
        ("plane/balanced-ball", &["ω: [ω1, ω2, ω3]; [u,v] = v"]),
        ("plane/balanced-ball-gyrostat", &[]),
        (
            "flat-base/symmetric-base",
            &["ω1: ω2, ω2: −ω1, r1: r2, r2: −r1", "ω1: ω1, ω2: ω2; [u,v] = v"],
        ),
    ];
    for (path, expected) in cases {
        let report = searched(path, &effort(0));
        let found: Vec<&str> = report.formulas(FoundKind::SymmetryField).collect();
        assert_eq!(found, expected, "{path}");
        assert!(report.found.iter().all(|found| found.verdict == Verdict::Proved), "{path}");
    }
}

#[test]
fn potentials_that_separate_keep_an_integral() {
    let body = "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = '0.5..2'\nR = '1..2'\n\
                I = 'inertia(0.5..5)'\na = '0.5..2'\nl = '0.1..0.3'\n[body]\nshape = 'ball'\npotential = ";
    for (potential, integral) in [
        ("'a/γ1²'", "(Ĩ*ω,Ĩ*ω) − (Ĩ*ω,γ)² − 2*a/γ1²*(J)[1,1] + 2*a/γ1²*tr(J) − 2*a/γ1²*(γ,J*γ)"),
        ("'a*((J*γ,J*γ) − (γ,J*γ)²)'", "(Ĩ*ω,Ĩ*ω) − (Ĩ*ω,γ)² + 2*a*(γ,J*γ)*(γ,adj(J)*γ)"),
    ] {
        let report = search(&case(&format!("{body}{potential}")), &effort(2), &mut |_| {});
        let report = report.expect("it can be searched");
        assert_eq!(
            report.formulas(FoundKind::Integral).collect::<Vec<_>>(),
            [integral],
            "{potential}"
        );
    }
    // A generating function of them, with a user's term.
    let text = format!("{body}'a/(γ,inverse(J − l*E)*γ)'");
    let mut effort = effort(2);
    effort.terms = vec!["U*(γ,adj(J)*(inverse(J − l*E)*γ))".into()];
    let report = search(&case(&text), &effort, &mut |_| {}).expect("it can be searched");
    assert_eq!(report.formulas(FoundKind::Integral).count(), 1, "{:?}", report.found);
    effort.terms = vec!["U*ω".into()];
    let error = search(&case(&text), &effort, &mut |_| {}).expect_err("a vector is no term");
    assert!(error.to_string().contains("U*ω"), "{error}");
}

#[test]
fn nothing_is_found_where_there_is_nothing() {
    let report = searched("plane/ellipsoid-generic", &effort(4));
    assert_eq!(
        report.formulas(FoundKind::Integral).count() + report.formulas(FoundKind::Density).count(),
        0
    );
    let theorem = &report.excluded[0].theorem;
    assert!(theorem.contains("of degree at most 4 is a polynomial in the energy"), "{theorem}");
}

#[test]
fn a_field_without_series_makes_no_theorem() {
    let report = searched("sphere/constant-curvature", &effort(2));
    assert!(report.counts.is_empty() && report.excluded.is_empty(), "{:?}", report.excluded);
    assert!(report.remarks.iter().any(|remark| remark.contains('∫')), "{:?}", report.remarks);
    assert_eq!(report.formulas(FoundKind::Density).collect::<Vec<_>>(), ["det(Ĩ)*(γ,Ĩ⁻¹*γ)*D_T"]);
}

#[test]
fn a_false_claim_makes_no_theorem() {
    let body = "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = '0.5..2'\nI = 'inertia(0.5..5)'\n\
                B = 'diag(1..3)'\n[body]\nshape = 'ellipsoid'\n[[claim]]\nname = 'F'\nintegral = '(Ĩ*ω,ω1*γ)'\n";
    let report = search(&case(body), &effort(2), &mut |_| {}).expect("it can be searched");
    assert!(
        report.excluded[0].theorem.contains("a polynomial in the energy."),
        "{:?}",
        report.excluded
    );
}

#[test]
fn a_force_that_is_no_potential_makes_no_false_theorem() {
    let oscillator = case(
        "title = 'x'\nsystem = 'nonholonomic'\n[state]\nx = '1..2'\n\"x'\" = '1..2'\n[lagrangian]\n\
         kinetic = \"x'²/2\"\npotential = 'x²/2'\nforces = { x = '-x' }\n",
    );
    let report = search(&oscillator, &effort(2), &mut |_| {}).expect("it can be searched");
    // The energy is not an integral, 2x² + x'² is.
    let found: Vec<&str> = report.formulas(FoundKind::Integral).collect();
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(report.excluded.iter().all(|excluded| !excluded.theorem.contains("energy")));
}

#[test]
fn potentials_and_rotors_that_keep_an_integral_are_found_and_proved() {
    // Numbers of potentials and rotors in the ansatz.
    let cases = [("plane/balanced-ball", 6, 3), ("sphere/borisov-mamaev-ball", 5, 0)];
    let mut wanted = effort(2);
    (wanted.ansatz.potentials, wanted.ansatz.gyrostats) = (true, true);
    for (path, potentials, rotors) in cases {
        let report = searched(path, &wanted);
        for (what, form, count) in
            [("potential", "potentials U", potentials), ("gyrostat", "rotors", rotors)]
        {
            let excluded = report.excluded.iter().find(|one| one.ansatz.starts_with(form));
            let excluded = excluded.expect("they were looked for");
            assert_eq!((excluded.dimension, excluded.known), (count, count), "{path}: {what}");
            let found =
                report.found.iter().find(|one| one.with.iter().any(|own| own.name() == what));
            assert_eq!(found.is_some(), count > 0, "{path}: {what}");
            assert!(found.is_none_or(|one| one.verdict == Verdict::Proved), "{path}: {what}");
        }
    }
}

#[test]
fn a_rotor_leaves_the_potentials_that_depend_on_its_cosine() {
    let mut wanted = effort(2);
    wanted.ansatz.potentials = true;
    for (rotor, expected) in [("[0,0,1]", 1), ("[1,0,2]", 0)] {
        let setting = Setting { name: "S".to_string(), value: rotor.to_string() };
        let path = Path::new(concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../cases/plane/balanced-ball-gyrostat.toml"
        ));
        let case = Case::read(path, &[setting]).1.expect("a case of the catalogue");
        let report = search(&case, &wanted, &mut |_| {}).expect("it can be searched");
        let with = report.found.iter().flat_map(|found| &found.with);
        let found: Vec<&str> = with.map(Given::text).collect();
        assert_eq!(found.len(), expected, "{rotor}: {found:?}");
        assert!(found.iter().all(|formula| *formula == "ε1*(1/γ3²)"), "{found:?}");
    }
}

#[test]
fn what_takes_no_forces_is_told_so() {
    let mut wanted = effort(1);
    (wanted.ansatz.potentials, wanted.ansatz.gyrostats) = (true, true);
    let report = searched("surface/ellipsoid", &wanted);
    for what in ["no search for potentials", "no search for rotors"] {
        assert!(report.remarks.iter().any(|one| one.starts_with(what)), "{:?}", report.remarks);
    }
}

#[test]
fn a_search_that_is_stopped_tells_what_it_reached() {
    let path =
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/plane/unbalanced-ball.toml"));
    let case = Case::read(path, &[]).1.expect("a case of the catalogue");
    let effort = effort(4);
    let switch = effort.halt.switch();
    let mut progress = |what: &str| {
        if what.starts_with("integrals of degree 3") {
            switch.store(true, std::sync::atomic::Ordering::Relaxed);
        }
    };
    let report = search(&case, &effort, &mut progress).expect("it can be searched");
    let degrees: Vec<u32> = report.counts.iter().map(|count| count.degree).collect();
    assert_eq!(degrees, [1, 2], "what was counted before");
    assert_eq!(report.unreached[0], "integrals of degree 3 and more");
    assert!(report.unreached.iter().any(|part| part == "a global ansatz"));
    assert!(
        !report.unreached.iter().any(|part| part == "integrals among the terms"),
        "these are quick"
    );
    let theorem = &report.excluded[0].theorem;
    assert!(theorem.contains("of degree at most 2 is a polynomial in the energy and"), "{theorem}");

    let none = Effort { halt: Halt::within(std::time::Duration::ZERO), ..effort };
    let report = search(&case, &none, &mut |_| {}).expect("it can be searched");
    assert!(report.found.is_empty() && report.counts.is_empty() && report.excluded.is_empty());
    assert_eq!(report.unreached[0], "products of factors");
}

#[test]
fn densities_that_depend_on_the_velocities_are_counted_and_found() {
    let damped = case(
        "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nc = '0.5..2'\n[state]\nx = '1..2'\n\
         \"x'\" = '1..2'\n[lagrangian]\nkinetic = \"x'²/2\"\nforces = { x = \"−c*x'\" }\n",
    );
    let report = search(&damped, &effort(2), &mut |_| {}).expect("it can be searched");
    let density: Vec<&str> = report.formulas(FoundKind::Density).collect();
    assert_eq!(density, ["1/x'"], "div v = −c, and no density of x alone");
    let last = report.multipliers.last().expect("they were counted");
    assert_eq!((last.degree, last.alpha, last.dimension), (1, Some(-1), 1));
    assert!(report.excluded.iter().all(|one| !one.theorem.contains("P^(1/α)")), "no theorem");

    // (3.15) is a density of the configuration; the unbalanced ball and an ellipsoid have none at
    // all.
    let balanced = searched("plane/balanced-ball", &effort(1));
    let counted: Vec<(u32, usize)> =
        balanced.multipliers.iter().map(|one| (one.degree, one.dimension)).collect();
    assert_eq!(counted, [(0, 1)], "others are its products with integrals");
    let unbalanced = searched("plane/unbalanced-ball", &effort(2));
    assert!(unbalanced.multipliers.iter().all(|one| one.dimension == 0), "none");
    let theorem = &unbalanced.excluded.last().expect("a theorem").theorem;
    assert!(theorem.contains("no invariant density P^(1/α)"), "{theorem}");
    let forced = searched("plane/ellipsoid-generic", &effort(1));
    let theorem = &forced.excluded.last().expect("a theorem").theorem;
    assert!(theorem.contains("for every gyrostat and every potential"), "{theorem}");
}
