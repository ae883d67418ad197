//! Sentences of a report that say what they are about.

use liouville::case::Case;
use liouville_search::{Effort, SearchReport, search};

fn searched(text: &str, degree: u32) -> SearchReport {
    let case = Case::parse(text, &[]).expect("a case");
    let effort = Effort { degree, ..Effort::default() };
    search(&case, &effort, &mut |_| {}).expect("it can be searched")
}

fn theorems(report: &SearchReport) -> Vec<&str> {
    report.excluded.iter().map(|own| own.theorem.as_str()).collect()
}

fn field(parameters: &str, state: &str, rates: &str) -> String {
    format!("title = 'x'\n[parameters]\n{parameters}\n[state]\n{state}\n[field]\n{rates}\n")
}

const SLEIGH: &str = "title = 'a sleigh on a slope'
system = 'nonholonomic'
[parameters]
g = '1..10'
J = '0.5..2'
[state]
x = '-2..2'
y = '-2..2'
\"φ\" = '-3..3'
\"x'\" = '-2..2'
\"y'\" = '-2..2'
\"φ'\" = '-2..2'
[lagrangian]
kinetic = \"(x'² + y'² + J*φ'²)/2\"
potential = 'FORCE'
constraints = [\"x'*sin(φ) − y'*cos(φ) = 0\"]
";

#[test]
fn integrals_that_are_functions_of_those_told_are_not_missing() {
    // With four independent integrals in five coordinates (F₁² − 2φ'²E + Jφ'⁴)/g is the one that is counted.
    let report = searched(&SLEIGH.replace("FORCE", "−g*x"), 2);
    let missing = report.counts.iter().any(|own| own.dimension > own.known);
    assert!(missing && report.is_complete, "{:?}", report.counts);
    // x y'² + a y − c asinh y is missing where z' = y x', and no function of those told.
    let open = searched(
        "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\na = '0.5..2'\n[state]\nx = '-2..2'\ny = '-2..2'\n\
         z = '-2..2'\n\"x'\" = '-2..2'\n\"y'\" = '-2..2'\n\"z'\" = '-2..2'\n[lagrangian]\n\
         kinetic = \"(x'² + y'² + z'²)/2\"\npotential = 'a*z'\nconstraints = [\"z' = y*x'\"]\n",
        2,
    );
    let missing = open.counts.iter().any(|own| own.dimension > own.known);
    assert!(missing && !open.is_complete, "{:?}", open.counts);
}

#[test]
fn a_theorem_that_says_less_than_another_is_left_out() {
    let text = field(
        "e = '0.1..1'",
        "x = '-1..1'\ny = '-1..1'\nu = '-1..1'\nv = '-1..1'",
        "\"x'\" = 'u'\n\"y'\" = 'v'\n\"u'\" = '-x - 2*e*x*y²'\n\"v'\" = '-y - 2*e*x²*y'",
    );
    let report = searched(&text, 2);
    let all = theorems(&report);
    assert!(all.iter().any(|own| own.contains("every integral P/Q")), "{all:?}");
    assert!(all.iter().all(|own| !own.contains("no fraction P/Q")), "{all:?}");
    // Where nothing is known the weaker one is all there is.
    let text = field(
        "a = '1..2'",
        "x = '1..2'\ny = '1..2'",
        "\"x'\" = 'x*(1 − x − a*y)'\n\"y'\" = 'x² + y'",
    );
    let report = searched(&text, 2);
    let all = theorems(&report);
    assert!(all.iter().any(|own| own.contains("no fraction P/Q")), "{all:?}");
}

#[test]
fn factors_that_are_not_told_are_explained() {
    let sleigh = field(
        "a = '0.5..2'",
        "u = '0.3..0.6'\nw = '0.7..1.1'",
        "\"u'\" = 'a*w²'\n\"w'\" = '-a*u*w/(1 + a²)'",
    );
    let report = searched(&sleigh, 2);
    let all = theorems(&report);
    let says = |text: &str| all.iter().any(|own| own.contains(text));
    assert!(says("factors of w, u² + (1 + a²)*w²; u² + (1 + a²)*w² is an integral."), "{all:?}");
    let pole = field(
        "M = '0.5..2'",
        "r = '0.3..0.6'\n\"φ\" = '0.7..1.1'\nu = '1.2..1.6'\nw = '1.6..2.1'",
        "\"r'\" = 'u'\n\"φ'\" = 'w'\n\"u'\" = '-M/r² + (r - 3*M)*w²'\n\"w'\" = '-2*u*w/r'",
    );
    let report = searched(&pole, 2);
    let all = theorems(&report);
    let of_factors =
        all.iter().find(|own| own.contains("is a constant times a product of factors of"));
    let own = of_factors.expect("a theorem on Darboux polynomials");
    assert!(own.ends_with(" w, r; r is a factor of the denominator."), "{own}");
}

#[test]
fn a_note_names_the_cause_that_applies() {
    let map = "title = 'x'\nsystem = 'map'\n[parameters]\nK = '0.5..2'\n[state]\nq = '-3..3'\np = '-2..2'\n\
               [map]\np = 'p + K*sin(q)'\nq = 'q + p + K*sin(q)*exp(p)'\n";
    let report = searched(map, 2);
    let cause = "no relations along orbits: the map has no values modulo a prime, as it contains sin and exp";
    assert!(report.remarks.iter().any(|own| &**own == cause), "{:?}", report.remarks);
    let vakonomic = "title = 'x'\nsystem = 'vakonomic'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n\
                     \"x'\" = '-2..2'\n\"y'\" = '-2..2'\n\"z'\" = '-2..2'\n\"λ\" = '-1..1'\n[lagrangian]\n\
                     kinetic = \"(x'² + y'² + z'²)/2\"\nconstraints = [\"z' = y*x'\"]\nmultipliers = ['λ']\n";
    let report = searched(vakonomic, 2);
    let is_cause =
        |own: &str| own.contains("the constraints of a vakonomic system are a level set");
    assert!(report.remarks.iter().any(|own| is_cause(own)), "{:?}", report.remarks);
}

#[test]
fn values_of_lists_are_no_given_values() {
    let text = field(
        "a = 'one of 1, 2'",
        "x = '0.5..2'\ny = '0.5..2'",
        "\"x'\" = 'x*(1 − y)'\n\"y'\" = 'y*(a*x − 1)'",
    );
    let report = searched(&text, 2);
    let all = theorems(&report);
    assert!(all.iter().all(|own| !own.contains("given values")), "{all:?}");
    assert!(all.iter().any(|own| own.starts_with("For each of the listed values, ")), "{all:?}");
    // What is counted for each is not told as that of the first.
    assert!(report.remarks.iter().all(|own| !own.contains("the first of")), "{:?}", report.remarks);
}

#[test]
fn functions_of_several_claims_are_known() {
    let spring = field(
        "A = '1..2'",
        "x = '-1..1'\ny = '-1..1'\nz = '-1..1'",
        "x = 'y'\ny = '-A*x'\nz = '0'",
    );
    let claims = "[[claim]]\nname = 'En'\nintegral = 'y^2/2 + A*x^2/2 - z'\n\
                  [[claim]]\nname = 'height'\nintegral = 'z'\n";
    let report = searched(&format!("{spring}{claims}"), 2);
    let own = report.found.iter().find(|own| own.text().contains("A*x²")).expect("found");
    assert_eq!(own.known.as_deref(), Some("En, height"), "it is 2 (En + z)");
}

#[test]
fn an_integral_that_is_rewritten_is_compared_with_the_claims_again() {
    let satellite = "title = 'a satellite'\n[parameters]\nA = '1..2'\nB = '1..2'\nC = '1..2'\n[state]\n\
                     M = 'vector(-1..1)'\na = 'vector(-1..1)'\nb = 'vector(-1..1)'\nc = 'vector(-1..1)'\n\
                     [let]\nJ = 'diag(A,B,C)'\nw = 'inverse(J)*M'\n[field]\n\
                     M = 'M × w + 3*c × (J*c)'\na = 'a × (w - b)'\nb = 'b × (w - b)'\n\
                     c = 'c × (w - b)'\n[[claim]]\nname = 'Jacobi'\n\
                     integral = '(M,w)/2 - (M,b) + 3/2*(c,J*c)'\n";
    let report = searched(satellite, 2);
    let own = report.found.iter().find(|own| own.text().contains("(M,b)")).expect("found");
    assert_eq!(own.known.as_deref(), Some("Jacobi"), "{}", own.text());
}
