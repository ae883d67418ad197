//! Searches: the results of the papers are found with their formulas hidden, counted, excluded, and
//! bounded by conditions on the parameters.

use std::path::Path;

use liouville::case::{Case, Setting};
use liouville::verdict::Verdict;
use liouville_search::{Effort, Halt, Hamiltonians, Report, Wanted, search};

fn effort(degree: u32) -> Effort {
    Effort { degree, ..Effort::default() }
}

fn searched(path: &str, effort: &Effort) -> Report {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases"))
        .join(path)
        .with_extension("toml");
    let case = Case::read(&path, &[]).1.expect("a case of the catalogue");
    search(&case, effort, &mut |_| {}).expect("it can be searched")
}

fn case(text: &str) -> Case {
    Case::parse(text, &[]).expect("a case")
}

#[test]
fn integrals_of_the_papers_are_found_and_proved() {
    let cases = [
        ("plane/balanced-ball", "F2"),
        ("plane/unbalanced-ball", "F2"),
        ("plane/ellipsoid-mb-mu", "F2"),
        ("plane/balanced-ball-gyrostat", "F2"),
        ("plane/balanced-ball-brun", "F2"),
        ("plane/revolution", "F2"),
        ("sphere/borisov-mamaev-ball", "F2"),
        ("sphere/borisov-mamaev-ball-potential", "F2"),
        ("sphere/symmetric-ball", "F2"),
        ("flat-base/base-through-centre", "F2"),
        ("flat-base/symmetric-base", "F2"),
        ("surface/ellipsoid", "F2"),
        ("surface/ellipsoid-potential", "F2"),
    ];
    for (path, name) in cases {
        let report = searched(path, &effort(2));
        let found: Vec<_> = report.found.iter().filter(|found| found.kind == "integral").collect();
        assert_eq!(found.len(), 1, "{path}: {found:?}");
        assert_eq!(found[0].verdict, Verdict::Proved, "{path}: {}", found[0].formula);
        // The library contains neither the claim nor its form: the two are shown to be dependent.
        let known = found[0].known.as_deref().unwrap_or("");
        assert!(known.starts_with(name), "{path}: {} comes from `{known}`", found[0].formula);
        assert!(report.opinions.iter().all(|opinion| opinion.agrees()), "{path}: singular values");
        let last = report.counts.last().expect("integrals were counted");
        assert_eq!(last.dimension, last.known, "{path}: all that are counted are found");
        assert!(report.excluded[0].theorem.contains("is a polynomial in"), "{path}: a theorem");
    }
}

#[test]
fn densities_of_the_papers_are_found_and_proved() {
    let cases = [
        ("plane/revolution", "g1^(1/2)*g2"),
        ("plane/spherical-inertia", "(I1*γ3² + I3*(γ1² + γ2²) + m*(r,γ)²)^(1/2)*(I1 + m*r²)"),
        ("plane/ellipsoid", "X0^(−1/2)*det(Ĩ)*(γ,Ĩ⁻¹*γ)"),
        ("plane/balanced-ball", "(γ,J⁻¹*γ)^(1/2)"),
        ("sphere/balanced-ball", "(γ,J⁻¹*γ)^((1 + k*R)/2)"),
        ("sphere/ellipsoid", "det(Ĩ)*(γ,Ĩ⁻¹*γ)*D_T"),
        ("sphere/equal-sphere", "det(Ĩ)*(γ,Ĩ⁻¹*γ)"),
        ("sphere/symmetric-ball", "(I1*γ3² + I3*(γ1² + γ2²) + m*(r,γ)²)^((1 + k*R)/2)*(I1 + m*r²)"),
    ];
    for (path, formula) in cases {
        let report = searched(path, &effort(0));
        let found: Vec<&str> = report.formulas("density").collect();
        assert_eq!(found, [formula], "{path}");
        let density = report.found.iter().find(|found| found.kind == "density");
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
        (
            "plane/revolution",
            &["ω: [ω[2], −ω[1], 0], γ: [γ[2], −γ[1], 0]", "ω: [ω[1], ω[2], ω[3]]; [u,v] = 1 v"],
        ),
        ("plane/balanced-ball", &["ω: [ω[1], ω[2], ω[3]]; [u,v] = 1 v"]),
        ("plane/balanced-ball-gyrostat", &[]),
        (
            "flat-base/symmetric-base",
            &["ω1: ω2, ω2: −ω1, r1: r2, r2: −r1", "ω1: ω1, ω2: ω2; [u,v] = 1 v"],
        ),
    ];
    for (path, expected) in cases {
        let report = searched(path, &effort(0));
        let found: Vec<&str> = report.formulas("symmetry-field").collect();
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
        assert_eq!(report.formulas("integral").collect::<Vec<_>>(), [integral], "{potential}");
    }
    // A generating function of them, with a user's term.
    let text = format!("{body}'a/(γ,inverse(J − l*E)*γ)'");
    let mut effort = effort(2);
    effort.terms = vec!["U*(γ,adj(J)*(inverse(J − l*E)*γ))".to_string()];
    let report = search(&case(&text), &effort, &mut |_| {}).expect("it can be searched");
    assert_eq!(report.formulas("integral").count(), 1, "{:?}", report.found);
    effort.terms = vec!["U*ω".to_string()];
    let error = search(&case(&text), &effort, &mut |_| {}).expect_err("a vector is no term");
    assert!(error.to_string().contains("U*ω"), "{error}");
}

#[test]
fn nothing_is_found_where_there_is_nothing() {
    let report = searched("plane/ellipsoid-generic", &effort(4));
    assert_eq!(report.formulas("integral").count() + report.formulas("density").count(), 0);
    let theorem = &report.excluded[0].theorem;
    assert!(theorem.contains("of degree at most 4 is a polynomial in energy"), "{theorem}");
}

#[test]
fn a_field_without_series_makes_no_theorem() {
    let report = searched("sphere/constant-curvature", &effort(2));
    assert!(report.counts.is_empty() && report.excluded.is_empty(), "{:?}", report.excluded);
    assert!(report.remarks.iter().any(|remark| remark.contains('∫')), "{:?}", report.remarks);
    assert_eq!(report.formulas("density").collect::<Vec<_>>(), ["det(Ĩ)*(γ,Ĩ⁻¹*γ)*D_T"]);
}

#[test]
fn a_false_claim_makes_no_theorem() {
    let body = "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = '0.5..2'\nI = 'inertia(0.5..5)'\n\
                B = 'diag(1..3)'\n[body]\nshape = 'ellipsoid'\n[[claim]]\nname = 'F'\nintegral = '(Ĩ*ω,ω1*γ)'\n";
    let report = search(&case(body), &effort(2), &mut |_| {}).expect("it can be searched");
    assert!(
        report.excluded[0].theorem.contains("a polynomial in energy."),
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
    let found: Vec<&str> = report.formulas("integral").collect();
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(report.excluded.iter().all(|excluded| !excluded.theorem.contains("energy")));
}

#[test]
fn conditions_on_parameters_are_found() {
    let mut wanted = effort(0);
    wanted.conditions = Some(Wanted::Existence);
    let ellipsoid = case(
        "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = '0.5..2'\nB = 'diag(1..3)'\n\
         I = 'inertia(0.5..5)'\n[body]\nshape = 'ellipsoid'\n",
    );
    let report = search(&ellipsoid, &wanted, &mut |_| {}).expect("it can be searched");
    // (3.8), expanded.
    let condition = "B11*I1*I2 − B11*I1*I3 − B22*I1*I2 + B22*I2*I3 + B33*I1*I3 − B33*I2*I3 − m*B11*B22*I1 + \
                     m*B11*B22*I2 + m*B11*B33*I1 − m*B11*B33*I3 − m*B22*B33*I2 + m*B22*B33*I3 = 0";
    let equations = &report.conditions[0].equations;
    assert!(equations.iter().any(|equation| equation == condition), "{equations:?}");

    let report = searched("sphere/unbalanced-ball", &wanted);
    let equations = &report.conditions[0].equations;
    assert!(equations.iter().any(|equation| equation == "1 − R*k = 0"), "{equations:?}");

    let flat = case(
        "title = 'x'\nsystem = 'flat-base'\n[parameters]\nm = '0.5..2'\nk = '0.2..1'\nz = '0.2..1'\n\
         I = 'inertia(0.5..5)'\n[body]\nheight = 'z'\n",
    );
    let report = search(&flat, &wanted, &mut |_| {}).expect("it can be searched");
    let mut equations = report.conditions[0].equations.clone();
    equations.sort();
    assert_eq!(equations, ["I1 = I2", "k = 0", "m = 0", "z = 0"], "the base of (4.5)");

    wanted.degree = 2;
    let report = searched("sphere/balanced-ball", &wanted);
    let by_k =
        report.conditions.iter().find(|c| c.of == "more integrals of degree 2, by the value of k");
    let equations = &by_k.expect("there are two values").equations;
    // κ = 1/(1 + kR) = 1, a plane, and κ = −1
    assert_eq!(equations, &["k = 0", "k*R = -2"]);
}

#[test]
fn conditions_of_codimension_two_are_met_in_small_fields() {
    let mut wanted = effort(0);
    wanted.conditions = Some(Wanted::Existence);
    let ellipsoid = case(
        "title = 'x'\nsystem = 'rubber-sphere'\n[parameters]\nm = '0.5..2'\nk = '0.1..0.3'\n\
         B = 'diag(1..3)'\nI = 'inertia(0.5..5)'\n[body]\nshape = 'ellipsoid'\n",
    );
    let report = search(&ellipsoid, &wanted, &mut |_| {}).expect("it can be searched");
    let equations = &report.conditions[0].equations;
    // I = mB + μE, and the bodies of revolution
    let homogeneous = "I1 − I2 − m*B11 + m*B22 = 0 and I1 − I3 − m*B11 + m*B33 = 0";
    assert!(equations.iter().any(|equation| equation.contains(homogeneous)), "{equations:?}");
    assert!(equations.iter().any(|equation| equation == "B11 = B22 and I1 = I2"), "{equations:?}");
}

#[test]
fn a_claim_that_fails_in_general_is_given_its_condition() {
    let mut wanted = effort(0);
    wanted.conditions = Some(Wanted::Claim("F2 of κ = −1".to_string()));
    let report = searched("sphere/balanced-ball", &wanted);
    assert_eq!(report.conditions[0].equations, ["2 + R*k = 0"]);
    wanted.conditions = Some(Wanted::Claim("no such claim".to_string()));
    let path =
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/sphere/balanced-ball.toml"));
    let read = Case::read(path, &[]).1.expect("a case of the catalogue");
    let error = search(&read, &wanted, &mut |_| {}).expect_err("there is none");
    assert!(error.to_string().contains("no such claim"), "{error}");
}

#[test]
fn potentials_and_rotors_that_keep_an_integral_are_found_and_proved() {
    // Numbers of potentials and rotors in the ansatz.
    let cases = [
        ("plane/balanced-ball", 6, 3),
        ("plane/ellipsoid-mb-mu", 6, 0),
        ("sphere/borisov-mamaev-ball", 5, 0),
        ("open/parallel-ellipsoid", 6, 0),
    ];
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
            let found = report.found.iter().find(|one| one.with.iter().any(|(w, _)| *w == what));
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
        let found: Vec<&str> = with.map(|(_, formula)| formula.as_str()).collect();
        assert_eq!(found.len(), expected, "{rotor}: {found:?}");
        assert!(found.iter().all(|formula| *formula == "ε1*(1/γ3²)"), "{found:?}");
    }
}

#[test]
fn what_takes_no_forces_is_told_so() {
    let mut wanted = effort(1);
    (wanted.ansatz.potentials, wanted.ansatz.gyrostats) = (true, true);
    let report = searched("surface/ellipsoid", &wanted);
    for what in ["no potential", "no rotor"] {
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
    assert!(report.unreached.iter().any(|part| part == "integrals among the terms"));
    let theorem = &report.excluded[0].theorem;
    assert!(theorem.contains("of degree at most 2 is a polynomial in energy and"), "{theorem}");

    let none = Effort { halt: Halt::within(std::time::Duration::ZERO), ..effort };
    let report = search(&case, &none, &mut |_| {}).expect("it can be searched");
    assert!(report.found.is_empty() && report.counts.is_empty() && report.excluded.is_empty());
    assert_eq!(report.unreached[0], "the number of integrals");
}

#[test]
fn densities_that_depend_on_the_velocities_are_counted_and_found() {
    let damped = case(
        "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nc = '0.5..2'\n[state]\nx = '1..2'\n\
         \"x'\" = '1..2'\n[lagrangian]\nkinetic = \"x'²/2\"\nforces = { x = \"−c*x'\" }\n",
    );
    let report = search(&damped, &effort(2), &mut |_| {}).expect("it can be searched");
    let density: Vec<&str> = report.formulas("density").collect();
    assert_eq!(density, ["(x')^(−1)"], "div v = −c, and no density of x alone");
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

/// Searches a field of two or more variables for brackets; returns the report and the brackets.
fn bracketed(body: &str, hamiltonians: Hamiltonians) -> (Report, Vec<String>) {
    let wanted = Effort { poisson: Some(hamiltonians), ..effort(0) };
    let case = case(&format!("title = 'x'\nsystem = 'field'\ncheck-weights = false\n{body}"));
    let report = search(&case, &wanted, &mut |_| {}).expect("it can be searched");
    let own = report.found.iter().filter(|found| found.kind == "bracket");
    assert!(own.clone().all(|found| found.verdict == Verdict::Proved), "{:?}", report.found);
    let texts = own.map(|found| found.formula.clone()).collect();
    (report, texts)
}

#[test]
fn a_top_has_two_brackets() {
    let top = "[parameters]\na = '1..2'\nb = '1..2'\nc = '1..2'\n[state]\nM = 'vector(-1..1)'\n[field]\n\
               M = 'M × [a*M1, b*M2, c*M3]'\n[[claim]]\nintegral = '(a*M1² + b*M2² + c*M3²)/2'\n\
               [[claim]]\nintegral = '(M,M)/2'\n";
    let (report, brackets) = bracketed(top, Hamiltonians::Given("(a*M1²+b*M2²+c*M3²)/2".into()));
    assert_eq!(brackets, ["{M1,M2} = −M3, {M1,M3} = M2, {M2,M3} = −M1"]);
    let with: Vec<_> = report.found.iter().flat_map(|found| &found.with).collect();
    assert!(with.contains(&&("Casimir", "(M,M)/2".to_string())), "{with:?}");
    // The integrals change places: the coefficients are parameters, up to multiples of hat(M).
    let (_, brackets) = bracketed(top, Hamiltonians::Given("(M,M)/2".into()));
    assert_eq!(brackets, ["{M1,M3} = −b*M2 + c*M2, {M2,M3} = a*M1 − c*M1"]);
}

#[test]
fn canonical_and_quadratic_brackets_are_found() {
    let state = "[state]\nx = '1..2'\ny = '1..2'\npx = '1..2'\npy = '1..2'\n";
    let henon_heiles = format!(
        "{state}[field]\nx = 'px'\ny = 'py'\npx = '−x − 2*x*y'\npy = '−y − x² + y²'\n[[claim]]\n\
         integral = '(px² + py² + x² + y²)/2 + x²*y − y³/3'\n"
    );
    let (_, brackets) = bracketed(&henon_heiles, Hamiltonians::Known);
    assert_eq!(brackets, ["{x,px} = 1, {y,py} = 1"]);
    let volterra = "[parameters]\na = '1..2'\nb = '1..2'\n[state]\nx = '1..2'\ny = '1..2'\n[field]\n\
                    x = 'x*(a − y)'\ny = 'y*(x − b)'\n";
    let hamiltonian = Hamiltonians::Given("a*log(y) + b*log(x) − x − y".into());
    let (_, brackets) = bracketed(volterra, hamiltonian);
    assert_eq!(brackets, ["{x,y} = x*y"]);
}

#[test]
fn brackets_are_excluded() {
    let damped = "[parameters]\nc = '1..2'\n[state]\nx = '1..2'\ny = '1..2'\n[field]\nx = 'y'\ny = '−x − c*y'\n";
    // Of degree 4 alone; and in three variables, where P ∂H = 0 has solutions.
    let quartic = "[state]\nx = '1..2'\ny = '1..2'\n[field]\nx = 'x²*y²'\ny = '−x²*y²'\n";
    let spatial = "[state]\nx = '1..2'\ny = '1..2'\nz = '1..2'\n[field]\nx = 'x²*y²'\ny = '−x²*y²'\nz = '0'\n";
    for (body, hamiltonian) in [(damped, "(x² + y²)/2"), (quartic, "x + y"), (spatial, "x + y")] {
        let (report, brackets) = bracketed(body, Hamiltonians::Given(hamiltonian.into()));
        assert!(brackets.is_empty(), "{hamiltonian}: {brackets:?}");
        let theorem = report.excluded.iter().find(|one| one.ansatz.starts_with("brackets"));
        let theorem = &theorem.expect("a theorem").theorem;
        assert!(theorem.contains("no skew P") && theorem.contains(hamiltonian), "{theorem}");
    }
}

#[test]
fn a_tensor_that_fails_jacobi_is_mended() {
    // {x,z} = z, {y,z} = 1 alone fails Jacobi's identity; {x,y} is free, as P ∂z does not contain
    // it.
    let body = "[state]\nx = '1..2'\ny = '1..2'\nz = '1..2'\n[field]\nx = 'z'\ny = '1'\nz = '0'\n";
    let (_, brackets) = bracketed(body, Hamiltonians::Given("z".into()));
    assert_eq!(brackets, ["{x,y} = −y, {x,z} = z, {y,z} = 1"]);
}
