//! Reports keep the restrictions under which their findings hold.

use liouville::case::Case;
use liouville::verdict::{Flaw, Options};
use liouville_cli::report::survey::markdown;
use liouville_search::Halt;
use liouville_search::survey::{HierarchyClass, Integrals, MeasureStatus, Survey, survey};

fn surveyed(text: &str) -> Survey {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error:?}\n{text}"));
    survey(&case, &Options::default(), &Halt::default(), &mut |_| {}).expect("a survey")
}

/// The report on Hamilton's equations in x, y, p, q.
fn hamiltonian(parameters: &str, function: &str, rest: &str) -> Survey {
    surveyed(&format!(
        "title = 't'\n[parameters]\n{parameters}\n[state]\nx = '-2..2'\ny = '-2..2'\np = '-2..2'\n\
         q = '-2..2'\n[hamiltonian]\nfunction = '{function}'\npairs = [['x', 'p'], ['y', 'q']]\n{rest}"
    ))
}

/// The report on a field.
fn field(head: &str, rates: &[(&str, &str)], rest: &str) -> Survey {
    let rates: String = rates.iter().map(|(x, rate)| format!("{x} = '{rate}'\n")).collect();
    surveyed(&format!("title = 't'\n{head}\n[field]\n{rates}{rest}"))
}

const FOUR: &str = "[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\nw = '-2..2'";
const TWO: &str = "[state]\nx = '-2..2'\ny = '-2..2'";

#[test]
fn integrals_for_one_listed_value_do_not_count_for_all() {
    let found = hamiltonian("a = 'one of 1, 2'", "(p²+q²)/2 + x²*y*(a−1) + x² + y²", "");
    assert_eq!(found.hierarchy.class, HierarchyClass::ByValue);
    assert_eq!(found.independence.independent, ["energy"], "a = 2 has no other");
    assert!(found.hierarchy.typical.is_empty(), "{:?}", found.hierarchy.typical);
    let classes: Vec<(&str, HierarchyClass)> =
        found.by_value.iter().map(|one| (one.values.as_str(), one.hierarchy.class)).collect();
    let (both, measure) = (HierarchyClass::IntegralAndMeasure, HierarchyClass::MeasureOnly);
    assert_eq!(classes, [("a = 1", both), ("a = 2", measure)]);
    assert!(!found.for_values.is_empty(), "oscillators have more integrals");
    for one in &found.for_values {
        assert_eq!(one.values.as_deref(), Some("a = 1"), "{}", one.formula());
    }
    let page = markdown(&found, "x");
    assert!(page.contains("with the value a = 1"), "{page}");
    assert!(page.contains("None is known for all listed values"), "{page}");
}

#[test]
fn integrals_for_different_values_are_not_added_up() {
    let rates = [("x", "y"), ("y", "−x − a*x²*z"), ("z", "w"), ("w", "−z − (1−a)*z*x² − a*x³/3")];
    let found = field(&format!("[parameters]\na = 'one of 0, 1'\n{FOUR}"), &rates, "");
    assert!(found.independence.independent.is_empty(), "{:?}", found.independence);
    assert_eq!(found.for_values.iter().filter(|one| one.is("integral")).count(), 2);
    assert_eq!(
        found.hierarchy.integrals,
        Integrals::Some,
        "one integral for each, and two are needed"
    );
}

#[test]
fn a_body_with_listed_parameters_stands_where_each_value_puts_it() {
    let found = surveyed(
        "title = 't'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 1\nc = [0.1, 0.2, 0.3]\n\
         a = 'one of 0, 1'\nI = 'diag(1, 1 + a/5, 1 + a/2)'\n[body]\nsupport = 'R*|γ| + (c,γ)'\n",
    );
    let classes: Vec<HierarchyClass> =
        found.by_value.iter().map(|one| one.hierarchy.class).collect();
    assert_eq!(classes, [HierarchyClass::IntegralAndMeasure, HierarchyClass::IntegralOnly]);
    assert_eq!(found.hierarchy.class, HierarchyClass::ByValue);
    assert_eq!(found.hierarchy.measure, MeasureStatus::NotKnown, "a = 0 has one");
    let page = markdown(&found, "x");
    assert!(page.contains("Not true for all parameter values"), "{page}");
    assert!(!page.contains("Ruled out"), "{page}");
}

#[test]
fn listed_values_are_those_of_charts_and_new_variables_too() {
    let list = format!("[parameters]\na = 'one of 1, 2'\n{TWO}");
    let level = "[level]\nequations = ['x² + y² = a²']\n[level.chart]\ninputs = { u = '-3..3' }\n\
                 x = 'a*(1 − u²)/(1 + u²)'\ny = '2*a*u/(1 + u²)'\n[[claim]]\nintegral = 'a*x² + a*y²'\n";
    let circle = field(&list, &[("x", "y"), ("y", "−x")], level);
    assert_eq!(circle.by_value.len(), 2, "one place for each value");
    let related = "[variables]\nu = 'x'\nv = '2*x'\n[poisson]\n\"u,v\" = 'a'\n\
                   [[claim]]\nbracket = ['u', 'v']\nequals = 'a'\n";
    let still = field(&list, &[("x", "0"), ("y", "0")], related);
    assert_eq!(still.by_value.len(), 2, "one place for each value");
}

#[test]
fn an_energy_that_the_level_fixes_is_no_integral_there() {
    let energy = "(p²+q²)/2 + (x²+y²)/2 + x²*y − y³/3";
    let level = format!("[level]\nequations = ['{energy} = 1/12']\n");
    let found = hamiltonian("", energy, &level);
    assert_eq!((found.independence.dimension, found.independence.independent.len()), (3, 0));
    assert_eq!(hamiltonian("", energy, "").independence.independent, ["energy"]);
    assert!(hamiltonian("", "5", "").independence.independent.iter().all(|own| own != "energy"));
}

#[test]
fn functions_that_are_independent_on_a_part_are_told_as_such() {
    let claim = "[[claim]]\nname = 'J'\nintegral = '(1 + a/|a|)*(x*q − y*p)'\n";
    let found = hamiltonian("a = '-1..1'", "(p²+q²+x²+y²)/2 + x²*y*(|a|−a)", claim);
    assert_eq!(found.hierarchy.integrals, Integrals::EnoughOnAPart);
    let is_restricted = |line: &String| line.starts_with("where the integrals are independent");
    let is_open = |line: &&String| line.contains("chaos") && !is_restricted(line);
    assert_eq!(found.hierarchy.typical.iter().find(is_open), None, "J is 0 for a < 0");
    let count =
        found.independence.claim.as_ref().expect("J is independent of the energy for a > 0");
    assert!(count.evidence.has(Flaw::OnAPart));
    let page = markdown(&found, "x");
    assert!(page.contains("shown on a part of the states only"), "{page}");
    // The same without the modulus.
    let claim = "[[claim]]\nname = 'J'\nintegral = 'x*q − y*p'\n";
    let found = hamiltonian("", "(p²+q²+x²+y²)/2", claim);
    assert_eq!(found.hierarchy.integrals, Integrals::Enough);
}

#[test]
fn densities_with_poles_are_no_measures_and_jumping_integrals_do_not_count() {
    let sink = field(TWO, &[("x", "y"), ("y", "−x − y/3")], "");
    assert_eq!(sink.hierarchy.measure, MeasureStatus::Singular, "the pole is the sink");
    assert!(sink.independence.independent.is_empty(), "the logarithm's angle jumps");
    assert!(sink.integrals.iter().any(|one| one.jumps()), "it is listed");
    let inside = "[state]\nx = '0.5..2'\ny = '-2..2'";
    let rates = [("x", "x*(1 − x)"), ("y", "−y")];
    assert_eq!(field(inside, &rates, "").hierarchy.measure, MeasureStatus::Singular, "x = 1");
}

#[test]
fn densities_that_contain_the_time_are_no_measures_of_the_state() {
    // exp(t/5) is kept by a forced oscillator with friction, whose volumes shrink.
    let rates = [("x", "y"), ("y", "x − x^3 − y/5 + 3/10*cos(t)")];
    let forced = field(TWO, &rates, "[[claim]]\ndensity = 'exp(t/5)'\n");
    assert_eq!(forced.hierarchy.measure, MeasureStatus::WithTime);
    assert_eq!(forced.hierarchy.class, HierarchyClass::NotKnown);
    let rates = [("x", "y"), ("y", "x − x^3 + 3/10*cos(t)")];
    assert_eq!(field(TWO, &rates, "").hierarchy.measure, MeasureStatus::ClosedForm);
}

#[test]
fn remarks_on_claims_are_in_the_report() {
    let claims = "[[claim]]\nintegral = '(x² + y²)/a'\n[[claim]]\nsymmetry = { x = '0', y = '0' }\n\
                  [[claim]]\nform = { 'x,y' = '0' }\n";
    let head = format!("[parameters]\na = 'one of 0, 1'\n{TWO}");
    let page = markdown(&field(&head, &[("x", "y"), ("y", "−x")], claims), "x");
    for remark in ["nothing is said for a = 0", "cannot be inverted", "the form is 0"] {
        assert!(page.contains(remark), "{remark} in\n{page}");
    }
}

#[test]
fn a_listed_value_without_motion_is_left_out() {
    let head = format!("[parameters]\na = 'one of 0, 2'\n{TWO}");
    let found = field(&head, &[("x", "y/a"), ("y", "−x/a")], "");
    assert_eq!(found.hierarchy.class, HierarchyClass::IntegralAndMeasure);
    assert!(found.remarks[0].starts_with("nothing is said for a = 0"), "{:?}", found.remarks);
    // D_T = 0 for R = 1, and the integral of a ball for the others.
    let ball = surveyed(
        "title = 't'\nsystem = 'rubber-sphere'\n[parameters]\nm = 1\nR = 'one of 1/2, 1'\n\
         I = 'inertia(0.5..3)'\nk = -1\n[body]\nshape = 'ball'\n",
    );
    assert!(ball.remarks[0].starts_with("nothing is said for R = 1"), "{:?}", ball.remarks);
}

#[test]
fn a_body_of_two_parts_is_no_ball() {
    let found = surveyed(
        "title = 't'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 1\nI = 'spherical(0.5..3)'\n\
         [body]\nsupport = 'R*|γ| + |γ3|/3'\n",
    );
    assert!(found.sentence.contains("part by part"), "{}", found.sentence);
}
