//! Poisson brackets: found, excluded, mended; on levels, and with multipliers of time.

use liouville::verdict::Verdict;
use liouville_search::{Effort, FoundKind, Hamiltonians, SearchReport, search};

use crate::ansatz::{case, effort, whole};

/// Data of the finds, with their kinds.
fn with(report: &SearchReport) -> Vec<(&str, &str)> {
    let all = report.found.iter().flat_map(|found| &found.with);
    all.map(|own| (own.name(), own.text())).collect()
}

/// Searches a field of two or more variables for brackets; returns the report and the brackets.
fn bracketed(body: &str, hamiltonians: Hamiltonians) -> (SearchReport, Vec<String>) {
    let wanted = Effort { poisson: Some(hamiltonians), ..whole(0) };
    let case = case(&format!("title = 'x'\nsystem = 'field'\ncheck-weights = false\n{body}"));
    let report = search(&case, &wanted, &mut |_| {}).expect("it can be searched");
    let own = report.found.iter().filter(|found| found.kind == FoundKind::Bracket);
    assert!(own.clone().all(|found| found.verdict == Verdict::Proved), "{:?}", report.found);
    let texts = own.map(|found| found.text().to_string()).collect();
    (report, texts)
}

#[test]
fn a_top_has_two_brackets() {
    let top = "[parameters]\na = '1..2'\nb = '1..2'\nc = '1..2'\n[state]\nM = 'vector(-1..1)'\n[field]\n\
               M = 'M × [a*M1, b*M2, c*M3]'\n[[claim]]\nintegral = '(a*M1² + b*M2² + c*M3²)/2'\n\
               [[claim]]\nintegral = '(M,M)/2'\n";
    let (report, brackets) = bracketed(top, Hamiltonians::Given("(a*M1²+b*M2²+c*M3²)/2".into()));
    assert_eq!(brackets, ["{M1,M2} = −M3, {M1,M3} = M2, {M2,M3} = −M1"]);
    let with = with(&report);
    assert!(with.contains(&("Casimir", "(M,M)/2")), "{with:?}");
    // The integrals change places: the coefficients are parameters, up to multiples of hat(M).
    let (_, brackets) = bracketed(top, Hamiltonians::Given("(M,M)/2".into()));
    assert_eq!(brackets, ["{M1,M3} = −b*M2 + c*M2, {M2,M3} = a*M1 − c*M1"]);
}

#[test]
fn log_canonical_brackets_of_four_variables_are_found() {
    let state = "[parameters]\nc = '1..2'\n[state]\nx = '1..2'\ny = '1..2'\nz = '1..2'\nw = '1..2'\n[field]\n";
    let volterra = |sign: &str| {
        format!(
            "{state}x = 'x*(y − c*z)'\ny = 'y*(z − x)'\nz = 'z*(c*x − y)'\nw = 'w*(x {sign} y)'\n[[claim]]\n\
             integral = 'x + y + z'\n"
        )
    };
    for sign in ["+", "−"] {
        let (_, brackets) = bracketed(&volterra(sign), Hamiltonians::Known);
        let is_own = |own: &String| own.contains("{x,y} = x*y") && own.contains("{x,w} =");
        assert!(brackets.iter().any(is_own), "{brackets:?}");
    }
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
    // In three variables P ∂H = 0 has solutions.
    let spatial =
        "[state]\nx = '1..2'\ny = '1..2'\nz = '1..2'\n[field]\nx = 'y'\ny = '−x − y'\nz = '0'\n";
    for body in [damped, spatial] {
        let hamiltonian = "(x² + y²)/2";
        let (report, brackets) = bracketed(body, Hamiltonians::Given(hamiltonian.into()));
        assert!(brackets.is_empty(), "{hamiltonian}: {brackets:?}");
        let theorem = report.excluded.iter().find(|one| one.ansatz.starts_with("brackets"));
        let theorem = &theorem.expect("a theorem").theorem;
        assert!(theorem.contains("no skew P") && theorem.contains(hamiltonian), "{theorem}");
    }
}

#[test]
fn entries_of_high_degree_are_found_from_a_density() {
    let quartic = "[state]\nx = '1..2'\ny = '1..2'\n[field]\nx = 'x²*y²'\ny = '−x²*y²'\n";
    let (_, brackets) = bracketed(quartic, Hamiltonians::Given("x + y".into()));
    let [own] = &brackets[..] else { panic!("one bracket: {brackets:?}") };
    assert!(["{x,y} = x²*y²", "{x,y} = y²*x²"].contains(&own.as_str()), "{own}");
}

#[test]
fn a_tensor_that_fails_jacobi_is_mended() {
    // {x,z} = z, {y,z} = 1 alone fails Jacobi's identity; {x,y} is free, as P ∂z does not contain
    // it.
    let body = "[state]\nx = '1..2'\ny = '1..2'\nz = '1..2'\n[field]\nx = 'z'\ny = '1'\nz = '0'\n";
    let (_, brackets) = bracketed(body, Hamiltonians::Given("z".into()));
    assert_eq!(brackets, ["{x,y} = −y, {x,z} = z, {y,z} = 1"]);
}

#[test]
fn diracs_bracket_is_found_on_a_level() {
    let pendulum = "[parameters]\ng = '0.5..1'\n[state]\nq = 'vector(-1..1)'\np = 'vector(-1..1)'\n\
                    [field]\nq = 'p'\np = '−g*[0,0,1] + (g*q3 − (p,p))*q'\n[level]\nequations = \
                    ['(q,q) = 1', '(q,p) = 0']\n";
    let neumann = "[parameters]\na1 = '0.5..1'\na2 = '1.2..1.8'\na3 = '2..3'\n[state]\nq = \
                   'vector(-1..1)'\np = 'vector(-1..1)'\n[let]\nA = 'diag(a1, a2, a3)'\n[field]\nq = 'p'\n\
                   p = '−A*q + ((q,A*q) − (p,p))*q'\n[level]\nequations = ['(q,q) = 1', '(q,p) = 0']\n";
    for (body, hamiltonian) in [(pendulum, "(p,p)/2 + g*q3"), (neumann, "((p,p) + (q,A*q))/2")] {
        let (report, brackets) = bracketed(body, Hamiltonians::Given(hamiltonian.into()));
        let [own] = &brackets[..] else { panic!("one bracket: {brackets:?} {:?}", report.remarks) };
        assert!(own.starts_with("{q1,p1} = 1 − q1², {q1,p2} = −q1*q2"), "{own}");
        assert!(own.ends_with("{p2,p3} = −q2*p3 + q3*p2"), "{own}");
        let with = with(&report);
        for casimir in ["(q,q)", "(q,p)"] {
            assert!(with.contains(&("Casimir", casimir)), "{with:?}");
        }
    }
}

#[test]
fn a_bracket_on_a_level_has_its_functions_as_casimirs() {
    // In the plane {x,y} = −1 serves; on the circle P ∂F = 0 leaves 0 alone.
    let state = "[state]\nx = '-1..1'\ny = '-1..1'\n[field]\nx = '−y'\ny = 'x'\n";
    let hamiltonian = || Hamiltonians::Given("(x² + y²)/2".into());
    let (_, brackets) = bracketed(state, hamiltonian());
    assert_eq!(brackets, ["{x,y} = −1"]);
    let circle = format!("{state}[level]\nequations = ['x² + y² = 1']\n");
    let (report, brackets) = bracketed(&circle, hamiltonian());
    assert!(brackets.is_empty(), "{brackets:?}");
    let theorem = report.excluded.iter().find(|one| one.ansatz.starts_with("brackets"));
    let theorem = &theorem.expect("a theorem").theorem;
    assert!(theorem.contains("P ∂F = 0 for F = x² + y², all on the level"), "{theorem}");
}

#[test]
fn chaplygins_ball_is_hamiltonian_in_another_time() {
    let ball = "[parameters]\nD = 1\na1 = 0.2\na2 = 0.3\na3 = 0.5\n[let]\nA = 'diag(a1,a2,a3)'\n\
                X = '1 − D*(γ,A*γ)'\nw = 'A*M + D*(A*M,γ)/X*A*γ'\n[state]\nM = 'vector(-1..1)'\n\
                \"γ\" = 'vector(-1..1)'\n[field]\nM = 'M × w'\n\"γ\" = 'γ × w'\n[level]\nequations = \
                ['(γ,γ) = 1']\n[[claim]]\nintegral = '(M,γ)'\n";
    let energy = "(M,A*M)/2 + D*(A*M,γ)²/(2*X)";
    let (report, brackets) = bracketed(ball, Hamiltonians::Given(energy.into()));
    assert_eq!(brackets.len(), 1, "{:?} {:?}", report.remarks, report.excluded);
    let with = with(&report);
    let multiplier = with.iter().find(|(what, _)| *what == "multiplier").expect("a multiplier");
    assert!(multiplier.1.ends_with("^(1/2)") && multiplier.1.starts_with("1/"), "{multiplier:?}");
    assert!(with.contains(&("Casimir", "(M,γ)")), "{with:?}");
}

#[test]
fn a_denominator_of_the_field_is_one_of_the_bracket() {
    let body = "[state]\nx = '1..2'\ny = '1..2'\n[field]\nx = 'y/(1 + x²)'\ny = '−x/(1 + x²)'\n";
    let (report, brackets) = bracketed(body, Hamiltonians::Given("(x² + y²)/2".into()));
    assert_eq!(brackets, ["{x,y} = 1/(1 + x²)"]);
    let with = with(&report);
    assert!(with.iter().all(|(what, _)| *what != "multiplier"), "{with:?}");
}

#[test]
fn the_energy_of_a_lagrangian_is_a_known_hamiltonian() {
    let pendulum = |claim: &str| {
        let text = format!(
            "title = 'x'\n[state]\na = '-3..3'\n\"a'\" = '-2..2'\n[lagrangian]\nkinetic = \"a'²/2\"\n\
             potential = '−cos(a)'\n[[claim]]\nintegral = \"{claim}\"\n"
        );
        let wanted = Effort { poisson: Some(Hamiltonians::Known), ..effort(0) };
        search(&case(&text), &wanted, &mut |_| {}).expect("it can be searched")
    };
    for claim in ["energy", "a'²/2 − cos(a)"] {
        let report = pendulum(claim);
        let brackets: Vec<_> =
            report.found.iter().filter(|own| own.kind == FoundKind::Bracket).collect();
        assert_eq!(brackets.len(), 1, "{claim}: {:?}", report.remarks);
        assert_eq!(brackets[0].text(), "{a,a'} = 1", "{claim}");
    }
}
