//! Limits of a search: its order within them, and the notes on the rest.

use liouville::formula::Formula;
use liouville_search::{
    Ansatz, ConditionTarget, Effort, FoundKind, Halt, ParameterCondition, SearchReport, search,
};
use std::sync::atomic::Ordering;
use std::time::Duration;

use crate::ansatz::{case, effort, searched, whole};

fn of(text: &str, effort: &Effort) -> SearchReport {
    search(&case(text), effort, &mut |_| {}).expect("it can be searched")
}

fn existence(degree: u32) -> Effort {
    Effort { conditions: Some(ConditionTarget::Existence), ..effort(degree) }
}

fn plane(parameters: &str, potential: &str) -> String {
    format!(
        "title = 'x'\n[parameters]\n{parameters}\n[state]\nx = '-2..2'\ny = '-2..2'\n\"x'\" = '-2..2'\n\
         \"y'\" = '-2..2'\n[lagrangian]\nkinetic = \"(x'²+y'²)/2\"\npotential = '{potential}'\n"
    )
}

#[test]
fn coefficients_that_depend_on_parameters_are_bounded_by_steps() {
    let cubics = "title = 'x'\n[parameters]\na = '1..2'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n[field]\n\
        \"x'\" = '9*a*x^2 - 9*a*x*y + 27*a*x*z - 9*a*x - 9*a*y + 3*x^3 + 3*x^2 - 3*x - 3'\n\
        \"y'\" = '9*a*x*y - 27*a*y^2 + 3*x^3 + 9*x^2*y + 18*x^2*z - 6*x^2 + 3*x - 9*y'\n\
        \"z'\" = '-6*a*x*y - 27*a*y*z + 12*a*y + x^3 + 6*x^2*z - x^2 + 6*x*z - x + 1'\n";
    // Without a bound it takes minutes.
    let report = of(cubics, &Effort { seconds: 0.5, ..whole(1) });
    assert!(report.remarks.iter().any(|own| own.contains("are not all sought")), "it is told");
    assert_eq!(report.formulas(FoundKind::Integral).count(), 1, "{:?}", report.found);
}

#[test]
fn conditions_on_many_parameters_are_bounded_by_steps() {
    let quadratic = "title = 'x'\n[parameters]\na='1..2'\nb='1..2'\nc='1..2'\nd='1..2'\ne='1..2'\nf='1..2'\n\
        g='1..2'\nh='1..2'\nk='1..2'\n[state]\nx='-2..2'\ny='-2..2'\nz='-2..2'\n[field]\n\
        \"x'\"='a*y*z+b*x*z+c*x*y'\n\"y'\"='d*y*z+e*x*z+f*x*y'\n\"z'\"='g*y*z+h*x*z+k*x*y'\n";
    // Without a bound it takes minutes.
    let report = of(quadratic, &Effort { seconds: 0.2, ..existence(1) });
    let is_of_integrals = |own: &&ParameterCondition| !own.of.starts_with("the density 1");
    let own = report.conditions.iter().find(is_of_integrals).expect("it is told");
    assert!(own.grounds.contains("may give more"), "{own:?}");
}

#[test]
fn what_was_asked_for_comes_before_higher_degrees() {
    let field = "title = 'x'\n[parameters]\nb = '1..20'\n[state]\nx = '-2..2'\ny = '-2..2'\np = '-2..2'\n\
                 q = '-2..2'\n[hamiltonian]\nfunction = '(p²+q²)/2+x²/2+8*y²+x²*y+b*y^3/3'\n\
                 pairs = [['x','p'], ['y','q']]\n";
    let conditions = Some(ConditionTarget::Existence);
    let wanted = Effort { conditions, halt: Halt::within(Duration::from_secs(1000)), ..whole(1) };
    let switch = wanted.halt.switch();
    let mut parts: Vec<String> = Vec::new();
    let report = search(&case(field), &wanted, &mut |part| {
        let is_relation = part.starts_with("relations of degree 1 ");
        // The second search along orbits is that which grows.
        let before = parts.iter().filter(|own| own.starts_with("relations of degree 1 ")).count();
        if is_relation && before == 1 {
            switch.store(true, Ordering::Relaxed);
        }
        parts.push(part.to_string());
    });
    let report = report.expect("it can be searched");
    let place = |start: &str| parts.iter().position(|own| own.starts_with(start));
    let asked = place("values of b").expect("values are sought");
    assert!(parts[..asked].iter().all(|own| !own.contains("degree 9 ")), "{parts:?}");
    assert_eq!(report.unreached[0], "relations of higher degree along an orbit");
    assert!(!report.orbits.is_empty() && !report.conditions.is_empty());
    let theorems: Vec<&str> = report.excluded.iter().map(|own| own.theorem.as_str()).collect();
    let mut once = theorems.clone();
    once.dedup();
    assert_eq!(theorems, once);
}

#[test]
fn conditions_of_a_lagrangian_go_to_the_degree_asked_for() {
    let report = of(&plane("a = '1..10'", "x²+a*y²"), &existence(3));
    let own = report
        .conditions
        .iter()
        .find(|own| own.of == "more integrals of degree 3, by the value of a")
        .expect("the frequencies 1 and 3");
    // Others have more of a lower degree.
    let mut equations = own.equations.clone();
    equations.sort();
    assert_eq!(equations, ["a = 1/9", "a = 9"]);
    // What is not sought is told, and so is that there is none.
    let short = Effort { seconds: 0.05, ..existence(4) };
    let report = of(&plane("a = '1..10'", "x²+a*y²"), &short);
    assert!(report.remarks.iter().any(|own| own.contains("and what comes after")), "it is told");
    let quartic = plane("a = '1..2'\nb = '1..2'\nc = '1..2'", "x^4+2*x²*y²+y^4+a*x²+b*y²+c*x*y");
    let report = of(&quartic, &existence(1));
    let own = report.conditions.first().expect("it is told");
    assert_eq!(
        (own.of.as_str(), own.equations.len()),
        ("more integrals of degree at most 1, by the value of a, or of b, or of c", 0)
    );
    let report = of(&plane("n = 'one of 1, 2'", "x²+n*y²"), &existence(1));
    assert!(report.remarks.iter().any(|own| own.contains("none is a scalar from a range")));
}

#[test]
fn integrals_that_depend_on_others_are_noted_once() {
    let isotropic = "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nu = '0.5..2'\nv = '0.5..2'\n[field]\n\
                     \"x'\" = 'u'\n\"u'\" = '-x'\n\"y'\" = 'v'\n\"v'\" = '-y'\n";
    let ansatz = Ansatz { wanted: true, positions: 4, ..Ansatz::default() };
    let report = of(isotropic, &Effort { ansatz, ..effort(1) });
    let notes: Vec<&str> = report
        .remarks
        .iter()
        .map(|own| &**own)
        .filter(|own| own.contains("independence of those"))
        .collect();
    assert_eq!(
        notes,
        ["4 integrals, whose independence of those listed is refuted; the shortest is x*y + u*v"]
    );
}

#[test]
fn large_numbers_have_one_sign() {
    let fast = "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-10^20*x'\n";
    let report = of(fast, &whole(1));
    let angles: Vec<&str> =
        report.found.iter().map(|own| own.text()).filter(|own| own.contains("atan")).collect();
    assert!(!angles.is_empty(), "{:?}", report.found);
    assert!(angles.iter().all(|own| !own.contains("−−")), "{angles:?}");
    let two = -&Formula::number(-2);
    assert_eq!(two.text(), "2", "the negative of a number");
}

#[test]
fn theorems_say_that_an_arbitrary_function_is_a_generic_one() {
    let says = |path: &str| {
        let report = searched(path, &effort(2));
        assert!(!report.excluded.is_empty(), "{path}");
        report
            .excluded
            .iter()
            .all(|own| own.theorem.ends_with("for special ones there may be more."))
    };
    assert!(says("sphere/e3-energy"), "the support function is arbitrary");
    // These hold for every potential.
    assert!(!says("sphere/ellipsoid-potential"));
    let potential = "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 1\nI = [1,2,3]\n[body]\n\
                     shape = 'ball'\npotential = 'arbitrary'\n";
    let report = of(potential, &effort(2));
    let own: Vec<&str> = report.excluded.iter().map(|own| own.theorem.as_str()).collect();
    assert!(own.iter().any(|own| own.ends_with("for special ones there may be more.")), "{own:?}");
}
