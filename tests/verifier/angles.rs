//! Sines and cosines of multiples of π/60, and of sums with them.

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
            "identity = 'cos(2*pi/5) = (sqrt(5) - 1)/4'",
            "identity = 'sin(pi/10) = (sqrt(5) - 1)/4'",
            "identity = 'sin(pi/5)*sin(2*pi/5) = sqrt(5)/4'",
            "identity = 'sum(i,1..5,cos(x + 2*pi*i/5)) = 0'",
            "identity = 'cos(x + pi/5)*cos(x + 2*pi/15) = (cos(2*x + pi/3) + cos(pi/15))/2'",
        ],
    );
    assert_eq!(found, vec![Verdict::Proved; 13]);
    // Parts of π that are no sixtieths are related by their sums.
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
            "identity = 'sin(pi/5)*sin(2*pi/5) = -sqrt(5)/4'",
            "identity = 'cos(x + pi/5)*cos(x + 2*pi/15) = (cos(2*x + pi/3) + cos(2*pi/15))/2'",
        ],
    );
    assert_eq!(wrong, vec![Verdict::Refuted; 5]);
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

#[test]
fn five_vortices_in_a_ring_are_at_rest() {
    let ring = |of: &str| {
        format!(
            "[parameters]\nn = 5\nG = '0.5..1'\na = '1..2'\n[state]\nx = 'vector(n,-2..2)'\ny = 'vector(n,-2..2)'\n\
             [field]\n\"x[i]'\" = '-G*sum(j,1..n,j≠i,(y[i]-y[j])/((x[i]-x[j])^2+(y[i]-y[j])^2))+G*(n-1)/(2*a^2)*y[i]'\n\
             \"y[i]'\" = 'G*sum(j,1..n,j≠i,(x[i]-x[j])/((x[i]-x[j])^2+(y[i]-y[j])^2))-G*(n-1)/(2*a^2)*x[i]'\n\
             [[claim]]\nfixed-point = {{ x = 'vector(i,1..n,{of}*cos(2*pi*i/n))', y = 'vector(i,1..n,{of}*sin(2*pi*i/n))' }}"
        )
    };
    assert_eq!(verdicts(&ring("a"), &[]), [Verdict::Proved]);
    assert_eq!(verdicts(&ring("2*a"), &[]), [Verdict::Refuted]);
}
