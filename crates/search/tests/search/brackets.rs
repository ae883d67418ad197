//! Poisson brackets: found, excluded, mended.

use liouville::verdict::Verdict;
use liouville_search::{Effort, Hamiltonians, SearchReport, search};

use crate::{case, effort};

/// Searches a field of two or more variables for brackets; returns the report and the brackets.
fn bracketed(body: &str, hamiltonians: Hamiltonians) -> (SearchReport, Vec<String>) {
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
