//! Energies that have a value where their slopes have none: nothing rests there, and nothing moves.

use liouville::case::Case;
use liouville::verdict::{CaseReport, Options, Verdict, judge};

fn report(text: &str) -> CaseReport {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn spring(potential: &str) -> Verdict {
    let text = format!(
        "title = 'spring'\n[parameters]\nk = '1..2'\nl = '1..2'\n[state]\nq = 'vector(2, -1..1)'\n\"q'\" = 'vector(2, -1..1)'\n\
         [lagrangian]\nkinetic = \"(q',q')/2\"\npotential = '{potential}'\n\
         [[claim]]\nfixed-point = {{ q = '[0,0]', \"q'\" = '[0,0]' }}\n"
    );
    report(&text).claims[0].verdict
}

#[test]
fn a_spring_of_some_length_has_no_rest_at_its_end() {
    assert_eq!(spring("k*(q,q)/2"), Verdict::Proved);
    assert_eq!(spring("k*sqrt(l² + (q,q))"), Verdict::Proved);
    // The force −k(|q| − l) q/|q| has no value at q = 0.
    assert_eq!(spring("k*(|q| - l)²/2"), Verdict::Undecided);
    assert_eq!(spring("-sqrt((q,q))"), Verdict::Undecided);
}

#[test]
fn a_hamiltonian_rests_where_its_slopes_exist() {
    let at_tip = |function: &str| {
        let text = format!(
            "title = 'cone'\n[state]\nx = '-1..1'\ny = '-1..1'\np = '-1..1'\ns = '-1..1'\n[hamiltonian]\n\
             function = '(p² + s²)/2 + {function}'\npairs = [['x', 'p'], ['y', 's']]\n\
             [[claim]]\nfixed-point = {{ x = '0', y = '0', p = '0', s = '0' }}\n"
        );
        report(&text).claims[0].verdict
    };
    assert_eq!(at_tip("sqrt(1 + x² + y²)"), Verdict::Proved);
    assert_eq!(at_tip("sqrt(x² + y²)"), Verdict::Undecided, "the tip of a cone");
}

#[test]
fn a_body_without_mass_does_not_move() {
    let text = "title = 'mass'\n[parameters]\nk = '-1..1'\nm = 'max(k,0)'\n[state]\nx = '-1..1'\n\"x'\" = '-1..1'\n\
                [lagrangian]\nkinetic = \"m*x'²/2\"\n[[claim]]\nintegral = \"x'\"\n[[claim]]\nidentity = '|k| = k'\n";
    let report = report(text);
    let told = report.warnings.join("\n");
    assert!(told.contains("the equations of motion have no value"), "{told}");
    assert_ne!(report.claims[1].verdict, Verdict::Refuted, "states with k < 0 do not count");
}

#[test]
fn a_rate_without_a_value_has_no_sign() {
    let lyapunov = |function: &str| {
        let text = format!(
            "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = '1'\n\"y'\" = '0'\n[[claim]]\n\
             lyapunov = '{function}'\n"
        );
        report(&text).claims[0].verdict
    };
    assert_eq!(lyapunov("-x"), Verdict::Proved);
    assert_eq!(lyapunov("-x*y²"), Verdict::Proved);
    assert_eq!(lyapunov("x - 2*max(x,0)"), Verdict::Refuted, "1 for x < 0");
    for function in [
        "x - 2*max(max(x,0),0)",
        "x - 2*abs(x + abs(x))",
        "x - 2*sqrt(max(x,0)²)",
        "x*y - 3*sqrt(x²*(abs(y) - y)²)",
    ] {
        assert_ne!(lyapunov(function), Verdict::Proved, "{function}");
    }
}
