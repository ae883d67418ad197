//! Finds as one would publish them.

use liouville::verdict::DensitySign;
use liouville_search::{Effort, FoundKind, SearchReport};

use super::maps::map;
use super::{field, searched};

fn told(report: &SearchReport, kind: FoundKind) -> Vec<&str> {
    report.formulas(kind).collect()
}

/// Functions of constant rate with their rates.
fn rates(report: &SearchReport) -> Vec<(&str, &str)> {
    let own = report.found.iter().filter(|own| own.kind == FoundKind::ConstantRate);
    own.map(|own| (own.text(), own.with[0].text())).collect()
}

#[test]
fn products_are_written_as_products() {
    // Lyness: the constant that makes it a product is not part of what is found.
    let report = searched(&map("a = '0.5..2'", &["y", "(a + y)/x"]), &Effort::default());
    assert_eq!(told(&report, FoundKind::Integral), ["(1 + x)*(1 + y)*(a + x + y)/(x*y)"]);
    assert_eq!(told(&report, FoundKind::Density), ["1/(x*y)"]);
}

#[test]
fn functions_are_those_of_the_file() {
    let report = searched(&field("", &["y", "−y²*tanh(x) − x"]), &Effort::default());
    let all = told(&report, FoundKind::Integral);
    assert!(all.len() == 1 && !all[0].contains("exp") && all[0].contains("cosh(2*x)"), "{all:?}");
    assert_eq!(told(&report, FoundKind::Density), ["1 + cosh(2*x)"]);
}

#[test]
fn rates_carry_the_factors() {
    let report = searched(&field("", &["x", "√(2)*y", "π*z"]), &Effort::default());
    assert_eq!(rates(&report), [("ln(x)", "1"), ("ln(y)", "√2"), ("ln(z)", "π")]);
    // y times an integral says no more than y.
    let report = searched(&field("a = '1..2'", &["exp(y)", "a", "x*exp(−y)"]), &Effort::default());
    assert_eq!(rates(&report), [("y", "a")]);
}

#[test]
fn distances_are_sums_of_squares() {
    let rate = |sign: &str, u: &str, k: usize, other: usize| {
        format!("\"{u}\" = '{sign}G{other}*(v{k} − v{other})/((x1 − x2)^2 + (y1 − y2)^2)'\n")
    };
    let rates: String = [(1, 2), (2, 1)]
        .into_iter()
        .flat_map(|(k, other)| {
            [
                rate("−", &format!("x{k}'"), k, other).replace('v', "y"),
                rate("", &format!("y{k}'"), k, other).replace('v', "x"),
            ]
        })
        .collect();
    let text = format!(
        "title = 'x'\n[parameters]\nG1 = '1..2'\nG2 = '1..2'\n[state]\nx1 = '-1..1'\nx2 = '-1..1'\n\
         y1 = '-1..1'\ny2 = '-1..1'\n[field]\n{rates}"
    );
    let report = searched(&text, &Effort::default());
    let long: Vec<&str> =
        report.found.iter().map(|own| own.text()).filter(|own| own.len() > 90).collect();
    assert!(long.is_empty(), "{long:?}");
}

#[test]
fn several_exponentials_become_hyperbolic_functions() {
    let text = "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\np = '-1..1'\nq = '-1..1'\n\
                [hamiltonian]\nfunction = '(p² + q²)/2 + cosh(x − y) + cosh(x + y)'\n\
                pairs = [['x', 'p'], ['y', 'q']]\n";
    let report = searched(text, &Effort::default());
    assert_eq!(told(&report, FoundKind::Integral), ["cosh(x + y) + p*q − cosh(x − y)"]);
}

#[test]
fn squares_of_sums_are_written_as_such() {
    let rates = "x = 'u'\ny = 'v'\nu = '−(w + t²)*x + 1/x³'\nv = '−(w + t²)*y'\n";
    let text = format!(
        "title = 'x'\n[parameters]\nw = '0.5..1'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nu = '-1..1'\n\
         v = '-1..1'\n[field]\n{rates}"
    );
    let report = searched(&text, &Effort::default());
    assert_eq!(told(&report, FoundKind::Integral), ["(x*v − y*u)² + y²/x²"]);
}

#[test]
fn constants_are_chosen_for_factors_that_darboux_polynomials_show() {
    let rate = |k: usize| {
        let [x, y, z] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| ["x", "y", "z"][k]);
        format!("{x}*(1 − {x} − a*{y} − (2 − a)*{z})")
    };
    let report =
        searched(&field("a = '0.5..0.9'", &[&rate(0), &rate(1), &rate(2)]), &Effort::default());
    assert_eq!(told(&report, FoundKind::Integral), ["(x + y + z)³/(x*y*z)"]);
    let all = told(&report, FoundKind::DarbouxPolynomial);
    assert!(all.iter().all(|own| own.len() < 20), "{all:?}");
}

#[test]
fn densities_are_positive_or_finite_where_they_can_be() {
    let halphen = "title = 'x'\n[state]\na = '-1..1'\nb = '1..2'\nc = '2..3'\n[field]\n\
                   a = 'b*c − a*(b + c)'\nb = 'c*a − b*(c + a)'\nc = 'a*b − c*(a + b)'\n";
    let report = searched(halphen, &Effort::default());
    let density =
        report.found.iter().find(|own| own.kind == FoundKind::Density).expect("a density");
    assert_eq!(density.evidence.sign, Some(DensitySign::Positive), "{density:?}");
    // 1/x² is infinite at x = 0, and x/y an integral.
    let falling = "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\nx = '−x'\ny = '−y'\n";
    let report = searched(falling, &Effort::default());
    assert_eq!(told(&report, FoundKind::Density), ["1/(x² + y²)"]);
}

#[test]
fn odd_functions_and_factors_of_rates_lose_their_signs() {
    let report = searched(&field("", &["−7/2*y", "7/2*x", "0*z"]), &Effort::default());
    assert!(rates(&report).contains(&("atan(x/y)", "−7/2")), "{:?}", rates(&report));
}

#[test]
fn the_masses_on_constraints_are_a_density() {
    // A sleigh with a mass on a spring across its blade.
    let text = "title = 'sleigh'\nsystem = 'nonholonomic'\n[parameters]\nM = '1..2'\nm = '0.2..0.5'\n\
                J = '0.5..1'\n[state]\nx = '-2..2'\ny = '-2..2'\nphi = '-3..3'\ns = '-1..1'\n\
                \"x'\" = '-2..2'\n\"y'\" = '-2..2'\n\"phi'\" = '-2..2'\n\"s'\" = '-1..1'\n[let]\n\
                U = \"x' - s'*sin(phi) - s*cos(phi)*phi'\"\nV = \"y' + s'*cos(phi) - s*sin(phi)*phi'\"\n\
                [lagrangian]\nkinetic = \"(M*(x'^2 + y'^2) + J*phi'^2 + m*(U^2 + V^2))/2\"\n\
                potential = 's^2'\nconstraints = [\"y'*cos(phi) = x'*sin(phi)\"]\n";
    let report = searched(text, &Effort { degree: 1, by_class: false, ..Effort::default() });
    let all = told(&report, FoundKind::Density);
    assert!(all.len() == 1 && all[0].contains("M*m*s²"), "{all:?}: {:?}", report.found);
}
