//! Shapes of answers: inner products in place of long polynomials, vectors behind their components.

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::verdict::{Options, Verdict};
use liouville_search::{Effort, FoundKind, SearchReport, search};

fn searched(text: &str) -> SearchReport {
    let case = Case::parse(text, &[]).expect("a case");
    search(&case, &Effort::default(), &mut |_| {}).expect("it can be searched")
}

fn vectors(report: &SearchReport) -> Vec<&str> {
    assert!(report.found.iter().all(|found| found.verdict == Verdict::Proved), "{report:?}");
    let own = report.found.iter().filter(|found| found.kind == FoundKind::VectorIntegral);
    own.inspect(|found| assert!(found.with.len() > 1, "{found:?}"))
        .map(|found| found.text())
        .collect()
}

#[test]
fn integrals_of_a_body_are_inner_products() {
    let brun = "title = 'x'\nsystem = 'field'\n[parameters]\nI = 'inertia(0.5..5)'\ne = '0.3..1'\nc = '0.5..1'\n\
                [state]\nM = 'vector(-2..2)'\nn = 'vector(-1..1)'\n[let]\nw = 'I⁻¹*M'\n\
                [field]\n\"M'\" = 'M × w + e*(n × I*n)'\n\"n'\" = 'n × w'\n\
                [level]\nequations = ['(n,n) = 1', '(M,n) = c']";
    let report = searched(brun);
    let mut found: Vec<&str> = report.formulas(FoundKind::Integral).collect();
    found.sort_by_key(|text| text.len());
    assert_eq!(found, ["(M,w) + e*(n,I*n)", "(M,M) − I1*I2*I3*e*(n,I⁻¹*n)"]);
    assert!(report.found.iter().all(|found| found.verdict == Verdict::Proved));
    // They are independent, so nothing was lost.
    let case = Case::parse(brun, &[]).expect("a case");
    let all = report.functions(FoundKind::Integral).cloned().collect();
    let judged = case.judge(&[Claim::independent(all)], &Options::default()).expect("judged");
    assert_eq!(judged.claims[0].verdict, Verdict::Proved);
}

#[test]
fn what_is_no_inner_product_stays_as_it_is() {
    // A vector, and no tensor that its moments belong to.
    let text = "title = 'x'\n[parameters]\na = '0.5..2'\n[state]\nM = 'vector(-2..2)'\n[field]\n\
                \"M'\" = '[(1 + a)*M2*M3, a²*M3*M1, −(2*a + 3)*M1*M2]'\n";
    let report = searched(text);
    let found: Vec<&str> = report.formulas(FoundKind::Integral).collect();
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found.iter().all(|text| !text.contains("(M,")), "{found:?}");
}

#[test]
fn components_of_vectors_are_gathered() {
    let two = "title = 'x'\n[parameters]\nm = '0.5..2'\nn = '0.5..2'\n[state]\nr = 'vector(-2..2)'\n\
               s = 'vector(-2..2)'\np = 'vector(-2..2)'\nq = 'vector(-2..2)'\n[field]\n\"r'\" = 'p/m'\n\
               \"s'\" = 'q/n'\n\"p'\" = '(s − r)*(r − s,r − s)'\n\"q'\" = '(r − s)*(r − s,r − s)'\n";
    assert_eq!(vectors(&searched(two)), ["p + q", "r × p + s × q"]);
    let particle = |force: &str| {
        format!(
            "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nz = '0.5..2'\nu = '-1..1'\nv = '-1..1'\n\
             w = '-1..1'\n[hamiltonian]\nfunction = '(u² + v² + w²)/2 + {force}'\n\
             pairs = [['x','u'],['y','v'],['z','w']]\n"
        )
    };
    let central = searched(&particle("(x² + y² + z²)²"));
    assert_eq!(vectors(&central), ["[x, y, z] × [u, v, w]"]);
    // One component alone makes no vector.
    let axial = searched(&particle("(x² + y² + 2*z²)²"));
    assert_eq!(axial.formulas(FoundKind::Integral).count(), 1, "{:?}", axial.found);
    assert!(vectors(&axial).is_empty());
}

#[test]
fn the_surface_of_a_ball_and_what_follows_from_it_are_no_finds() {
    let bowl = "title = 'x'\nsystem = 'ball-on-surface'\n[parameters]\nm = 1\nR = 0.5\n\"μ\" = 0.1\ng = 9.81\n\
                [body]\nsurface = '(r1² + r2²)/2 − r3'\npotential = 'm*g*r3'\n[[claim]]\nintegral = 'energy'\n";
    let report = searched(bowl);
    let case = Case::parse(bowl, &[]).expect("a case");
    let formula = |text: &str| case.formula(text).expect("a formula");
    let mut known = vec![formula("energy"), formula("(r1² + r2²)/2 − r3")];
    let is_integral =
        |kind: FoundKind| matches!(kind, FoundKind::Integral | FoundKind::FurtherIntegral);
    let own = report.found.iter().filter(|found| is_integral(found.kind));
    known.extend(own.map(|found| found.function().cloned().expect("a function")));
    assert!(known.len() > 2, "one is found");
    let judged = case.judge(&[Claim::independent(known)], &Options::default()).expect("judged");
    assert_eq!(judged.claims[0].verdict, Verdict::Proved, "{:?}", report.found);
    let words = "the function of the surface is an integral of the positions alone";
    assert!(report.remarks.iter().any(|own| own.contains(words)), "{:?}", report.remarks);
}
