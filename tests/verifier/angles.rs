//! Sines and cosines of multiples of π/12, and of sums with them.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn verdicts(head: &str, claims: &[&str]) -> Vec<Verdict> {
    let claims: String = claims.iter().map(|claim| format!("[[claim]]\n{claim}\n")).collect();
    let case = Case::parse(&format!("title = 'x'\n{head}\n{claims}"), &[]).expect("a case");
    judge(&case, &Options::default())
        .expect("a report")
        .claims
        .iter()
        .map(|own| own.verdict)
        .collect()
}

const FIELD: &str = "[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x'";

#[test]
fn special_angles_have_their_values() {
    let found = verdicts(
        FIELD,
        &[
            "identity = 'cos(pi/3) = 1/2'",
            "identity = 'sin(pi/3) = sqrt(3)/2'",
            "identity = 'cos(pi/4) = sqrt(2)/2'",
            "identity = 'sin(pi/12) = (sqrt(6) - sqrt(2))/4'",
            "identity = 'tan(pi/6) = 1/sqrt(3)'",
            "identity = 'cos(x + pi/3) = (cos(x) - sqrt(3)*sin(x))/2'",
            "identity = 'cos(x) + cos(x + 2*pi/3) + cos(x + 4*pi/3) = 0'",
            "identity = 'sin(2*x - 3*pi/4) = -(sin(2*x) + cos(2*x))/sqrt(2)'",
        ],
    );
    assert_eq!(found, vec![Verdict::Proved; 8]);
    // Parts of π that are no twelfths are related by their sums.
    let related = verdicts(
        FIELD,
        &[
            "identity = '4*cos(pi/9)^3 - 3*cos(pi/9) = cos(pi/3)'",
            "identity = '2*cos(x + pi/24)^2 - 1 = cos(2*x + pi/12)'",
            "identity = '2*sin(pi*x/6 + pi/12) = 2*sin(pi*(2*x + 1)/12)'",
        ],
    );
    assert_eq!(related, vec![Verdict::Proved; 3]);
    // Whole quarters, and parts of π that vary, are taken apart with the others.
    let whole = verdicts(
        FIELD,
        &[
            "identity = 'cos(2*(x + pi/4)) = 1 - 2*sin(x + pi/4)^2'",
            "identity = 'cos(2*(2*x + 17*pi/4)) = 1 - 2*sin(2*x + 17*pi/4)^2'",
            "identity = 'sin(3*(x - pi/6)) = 3*sin(x - pi/6) - 4*sin(x - pi/6)^3'",
            "identity = 'cos(2*x*pi) = 1 - 2*sin(x*pi)^2 + sin(7*pi/12)*sin(pi/12) - 1/4'",
            "identity = 'sin(x*pi)^2 + cos(x*pi)^2 = 2*cos(pi/3)'",
            "identity = 'sin(2*pi*x + pi/6) = sin(2*pi*x)*sqrt(3)/2 + cos(2*pi*x)/2'",
            "identity = 'sin(pi*(2*x + 1/3)) = sin(2*pi*x)/2 + cos(2*pi*x)*sqrt(3)/2'",
        ],
    );
    assert_eq!(whole, vec![Verdict::Proved; 7]);
    let wrong = verdicts(
        FIELD,
        &[
            "identity = 'cos(pi/3) = sqrt(3)/2'",
            "identity = 'cos(x + pi/3) = (cos(x) + sqrt(3)*sin(x))/2'",
            "identity = 'cos(x) + cos(x + pi/3) + cos(x + 2*pi/3) = 0'",
        ],
    );
    assert_eq!(wrong, vec![Verdict::Refuted; 3]);
}

#[test]
fn turns_by_a_third_are_symmetries() {
    let henon = "[state]\nx = '-1..1'\ny = '-1..1'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n[let]\nc = 'cos(2*pi/3)'\n\
                 s = 'sin(2*pi/3)'\n[lagrangian]\nkinetic = \"(x'² + y'²)/2\"\npotential = '(x² + y²)/2 + x²*y - y³/3'";
    let turn = |s: &str| {
        format!(
            "symmetry = {{ x = 'c*x - {s}*y', y = '{s}*x + c*y', \"x'\" = \"c*x' - {s}*y'\", \
             \"y'\" = \"{s}*x' + c*y'\" }}"
        )
    };
    assert_eq!(verdicts(henon, &[&turn("s"), &turn("(s/2)")]), [Verdict::Proved, Verdict::Refuted]);
    // Three oscillators in a ring, a third of a turn apart.
    let ring = "[parameters]\nn = 3\nK = '1..2'\n[state]\nθ = 'vector(3,-3..3)'\n[field]\n\
                \"θ[i]'\" = 'K*sum(j,1..n,sin(θ[j]-θ[i]))'";
    let ring = ring.replace("θ =", "\"θ\" =");
    let at = |second: &str| format!("fixed-point = {{ \"θ\" = '[0, {second}, 4*pi/3]' }}");
    let found = verdicts(&ring, &[&at("2*pi/3"), &at("pi/3")]);
    assert_eq!(found, [Verdict::Proved, Verdict::Refuted]);
}
