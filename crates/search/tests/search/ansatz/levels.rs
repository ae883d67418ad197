//! Symmetry fields on levels, terms in many variables, and what a theorem of an ansatz says.

use liouville_search::{Ansatz, Effort, FoundKind};

use super::{case, effort};
use liouville_search::search;

fn fields(text: &str) -> Vec<String> {
    let effort = Effort { by_class: false, by_factors: false, ..effort(1) };
    let report = search(&case(text), &effort, &mut |_| {}).expect("it can be searched");
    report.formulas(FoundKind::SymmetryField).map(str::to_string).collect()
}

#[test]
fn fields_that_are_equal_on_a_level_are_told_once() {
    let sleigh = "title = 'sleigh'\nsystem = 'nonholonomic'\n[parameters]\nm = '0.5..2'\nJ = '0.5..2'\n\
                  a = '0.1..1'\n[state]\nv = '-2..2'\nu = '-2..2'\nw = '-2..2'\nx = '-1..1'\ny = '-1..1'\n\
                  \"φ\" = '-3..3'\n[field]\n\"x'\" = 'v*cos(φ) - u*sin(φ)'\n\"y'\" = 'v*sin(φ) + u*cos(φ)'\n\
                  \"φ'\" = 'w'\n[lagrangian]\nquasi-velocities = ['v', 'u', 'w']\n\
                  kinetic = 'm*(v² + (u + a*w)²)/2 + J*w²/2'\nconstraints = ['u = 0']\n";
    let found = fields(sleigh);
    assert!(found.iter().all(|own| !own.ends_with(": u")), "0 on the level: {found:?}");
    for own in ["x: 1", "y: 1"] {
        assert!(found.iter().any(|other| other == own), "{own}: {found:?}");
    }
    // The group of the plane: φ turns with x and y.
    assert!(found.iter().any(|own| own.contains("φ: 1") && own.contains("y: x")), "{found:?}");
}

#[test]
fn a_field_at_rest_has_no_symmetry_without_components() {
    let rest =
        "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\n[field]\n\"x'\" = '0'\n\"y'\" = '0'\n";
    assert!(fields(rest).iter().all(|own| !own.starts_with(';')), "{:?}", fields(rest));
}

#[test]
fn linear_integrals_of_many_bodies_are_found() {
    let bodies = "title = 'five bodies'\n[parameters]\nn = 5\nm = 'vector(n,0.5..2)'\n[state]\n\
                  q = 'matrix(n,3,-2..2)'\np = 'matrix(n,3,-1..1)'\n[hamiltonian]\nfunction = \
                  'sum(i,1..n,p[i]^2/(2*m[i])) - sum(i,1..n-1,j,i+1..n,m[i]*m[j]/|q[i]-q[j]|)'\n\
                  pairs = [['q','p']]\n";
    let report = search(&case(bodies), &effort(1), &mut |_| {}).expect("it can be searched");
    let found: Vec<&str> = report.formulas(FoundKind::Integral).collect();
    for k in 1..=3 {
        let momentum: Vec<String> = (1..=5).map(|i| format!("p[{i},{k}]")).collect();
        assert!(found.contains(&momentum.join(" + ").as_str()), "{found:?}");
    }
}

#[test]
fn the_theorem_of_an_ansatz_counts_products_of_what_is_known() {
    let two = "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nu = '0.5..2'\nv = '0.5..2'\n[field]\n\
               \"x'\" = 'u'\n\"u'\" = '-x'\n\"y'\" = 'v'\n\"v'\" = '-2*y'\n";
    let effort = Effort {
        ansatz: Ansatz { wanted: true, positions: 4, ..Ansatz::default() },
        ..Effort::default()
    };
    let report = search(&case(two), &effort, &mut |_| {}).expect("it can be searched");
    // 1, E, F, E², EF, F²
    let theorem = report.excluded.iter().map(|own| own.theorem.as_str());
    let own: Vec<&str> = theorem.filter(|own| own.contains("form a space")).collect();
    let [own] = own[..] else { panic!("one theorem: {own:?}") };
    assert!(own.contains("degree at most 4 in the variables of the state"), "{own}");
    assert!(own.contains("at most 6; constants and products of known integrals span all"), "{own}");
}
