//! Fields with functions: how many independent integrals are counted where functions are variables.

use liouville_search::{Effort, FoundKind, Remark, search};

use super::{any_field, field, searched};

#[test]
fn functions_of_the_state_add_no_integrals() {
    // Each field has at most one integral in two dimensions, and two in three.
    let fields = [
        ("roots", field("", &["√(1 + x²)", "√(1 + y²)"]), 1),
        ("roots of different orders", field("", &["(1 + x)^(1/3)", "√(1 + y)"]), 1),
        ("the same exponential of both", field("", &["exp(x)", "exp(x)"]), 1),
        ("exponentials of both", field("", &["exp(x + y)", "exp(x + y) + 0*exp(y)"]), 1),
        ("a root of high degree", field("", &["z", "z", "√((y - x)^4*(x² + 1))"]), 2),
        ("a pendulum and its copy", field("", &["y", "-sin(x)", "y"]), 2),
        ("inverses", field("", &["1/x", "1/(y + x)", "0"]), 2),
    ];
    for (name, text, most) in fields {
        let report = searched(&text, &Effort::default());
        let counted = report.orbits.last().map_or(0, |own| own.integrals);
        assert!(counted <= most, "{name}: {counted} are counted");
        let found = report.formulas(FoundKind::Integral).count();
        assert!(found <= most, "{name}: {found} are found");
    }
}

#[test]
fn roots_that_depend_on_others_are_not_counted() {
    // x² + y² is an integral where √(x²) is x, and none where it is −x.
    let text = field("", &["y + √(x²) - x", "-x", "z² + x*z + y"]);
    let report = searched(&text, &Effort::default());
    assert!(report.orbits.is_empty(), "{:?}", report.orbits);
    assert!(report.excluded.is_empty(), "{:?}", report.excluded);
    let says = |own: &Remark| own.starts_with("relations along orbits are not counted");
    assert!(report.remarks.iter().any(says), "{:?}", report.remarks);
    let free = searched(&field("", &["√x", "-x", "z² + x*z + y"]), &Effort::default());
    assert!(!free.orbits.is_empty(), "a root of its own is counted");
}

#[test]
fn planted_integrals_are_counted() {
    // x − y and exp(x) − z are integrals.
    let text = field("", &["y*z", "y*z", "y*z*exp(x)"]);
    let report = searched(&text, &Effort::default());
    assert_eq!(report.formulas(FoundKind::Integral).count(), 2, "{:?}", report.found);
    // y√(1 + x²) − x√(1 + y²), that is sinh(arsinh y − arsinh x).
    let text = field("", &["√(1 + x²)", "√(1 + y²)"]);
    let report = searched(&text, &Effort::default());
    assert_eq!(report.orbits.last().map(|own| own.integrals), Some(1), "{:?}", report.orbits);
    assert_eq!(report.formulas(FoundKind::Integral).count(), 1, "{:?}", report.found);
}

#[test]
fn roots_and_exponentials_are_written_simply() {
    let two = "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nu = '0.5..2'\nv = '0.5..2'\n[field]\n\
               \"x'\" = 'u'\n\"u'\" = '-x'\n\"y'\" = 'v'\n\"v'\" = '-2*y'\n";
    let texts =
        [two.to_string(), field("", &["exp(y)", "x*exp(y)"]), field("", &["exp(y)*y", "1"])];
    for text in texts {
        let case = liouville::case::Case::parse(&text, &[]).expect("a case");
        let report = search(&case, &Effort::default(), &mut |_| {}).expect("it can be searched");
        for found in &report.found {
            let own = &found.text();
            assert!(!own.contains("−−"), "{own}");
            assert!(!own.contains("ln(exp"), "{own}");
            assert!(!own.contains("ln(|exp"), "{own}");
        }
    }
}

#[test]
fn fields_with_a_modulus_have_no_theorem() {
    // y² + x|x| is an integral; the branches of |x| are those of a root that depends on x.
    let text = "title = 'x'\nsystem = 'field'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\
                \"x'\" = 'y'\n\"y'\" = '-|x|'";
    let report = searched(text, &Effort::default());
    let integrals: Vec<&str> = report.formulas(FoundKind::Integral).collect();
    assert!(matches!(integrals[..], [own] if own.contains("|x|")), "{integrals:?}");
    assert!(report.excluded.is_empty(), "{:?}", report.excluded);
    // Where x > 0 alone, x² + y² is an integral, and a fraction as |x|/x is 1.
    let text = text.replace("x = '-2..2'", "x = '1..2'");
    let report = searched(&text, &Effort::default());
    assert_eq!(report.formulas(FoundKind::Integral).count(), 1, "{:?}", report.found);
    assert!(report.excluded.is_empty(), "{:?}", report.excluded);
}

#[test]
fn fields_without_divergence_have_the_density_1() {
    let energies = [
        "1/(2 + cos(q)*p²)",
        "√(1 + p²*(2 + cos(q)))",
        "(p²/(2 + sin(q)) + cos(q))/(2 + p*cos(q))",
        "exp(p*sin(q))*ln(2 + q*p)",
    ];
    for energy in energies {
        let text = format!(
            "title = 'x'\n[state]\nq = '0.5..1'\np = '0.5..1'\n[hamiltonian]\n\
             function = '{energy}'\npairs = [['q', 'p']]\n"
        );
        let report = searched(&text, &Effort::default());
        assert_eq!(report.formulas(FoundKind::Density).collect::<Vec<_>>(), ["1"], "{energy}");
    }
    let growing = any_field(&[("x", "sin(x)/(2 + cos(y))"), ("y", "exp(x)")]);
    let report = searched(&growing, &Effort::default());
    assert!(report.formulas(FoundKind::Density).all(|own| own != "1"), "{:?}", report.found);
}

#[test]
fn names_of_a_file_are_not_taken_for_those_of_functions() {
    // Functions are variables with names of the program, such as aux3.
    for name in ["a", "aux3", "arcaux3"] {
        let text = format!(
            "title = 'x'\n[parameters]\n{name} = '1..2'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\
             x = 'y'\ny = '-{name}*sin(x)'\n"
        );
        let report = searched(&text, &Effort { degree: 2, ..Effort::default() });
        let integral = format!("y² − 2*{name}*cos(x)");
        assert_eq!(report.formulas(FoundKind::Integral).collect::<Vec<_>>(), [integral]);
        assert_eq!(report.excluded.len(), 1, "{name}: {:?}", report.remarks);
    }
}
