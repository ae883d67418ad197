//! The language of case files: families, sizes, forms with indices, time, lists, names in any
//! order.
//!
//! Each case is judged; a claim passes when its verdict is the one the case expects.

mod brackets;
mod derivatives;
mod holonomic;
mod matrices;
mod mistakes;
mod names;
mod order;
mod repeated_constraints;

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

/// Judges a case, asserts that all is as expected, and returns the verdicts.
#[track_caller]
fn judged(text: &str) -> Vec<Verdict> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report =
        judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    for claim in &report.claims {
        assert!(claim.agrees, "{} came out {}", claim.name, claim.verdict.word());
    }
    report.claims.iter().map(|claim| claim.verdict).collect()
}

/// Judges a case whose claims must all be decided by a proof or a witness.
#[track_caller]
fn settled(text: &str) {
    let verdicts = judged(text);
    assert!(!verdicts.is_empty(), "something is claimed");
    let is_settled = |verdict: &Verdict| matches!(verdict, Verdict::Proved | Verdict::Refuted);
    assert!(verdicts.iter().all(is_settled), "{verdicts:?}");
}

/// Returns line, message and remedy of each mistake in a file.
fn error(text: &str) -> Vec<(usize, String, String)> {
    let error = Case::parse(text, &[]).expect_err("the file has mistakes");
    let told = |mistake: &liouville::case::Mistake| {
        let help = mistake.help().unwrap_or_default();
        (mistake.line.unwrap_or(0) as usize, mistake.message(), help)
    };
    error.mistakes().iter().map(told).collect()
}

const TODA: &str = r#"
title = "Toda lattice with free ends, in Flaschka's variables"
[parameters]
n = 5
[state]
a = "vector(n-1, 0.5..2)"
b = "vector(n, -1..1)"
[field]
"a[i]'" = "a[i]*(b[i+1] − b[i])"
"b[i]', i = 2..n-1" = "2*(a[i]² − a[i−1]²)"
"b[1]'" = "2*a[1]²"
"b[n]'" = "−2*a[n−1]²"
[let]
L = "matrix(i, 1..n, j, 1..n, if(i = j, b[i], if(j = i+1, a[i], if(i = j+1, a[j], 0))))"
B = "matrix(i, 1..n, j, 1..n, if(j = i+1, a[i], if(i = j+1, −a[j], 0)))"
L1 = "matrix(i, 1..n, j, 1..n, if(i = j, b'[i], if(j = i+1, a'[i], if(i = j+1, a'[j], 0))))"
[[claim]]
identity = "L1 = B*L − L*B"
[[claim]]
integral = "vector(k, 1..n, tr(L^k))"
[[claim]]
integral = "det(L)"
[[claim]]
density = "1/product(i, 1..n-1, a[i])"
[[claim]]
integral = "sum(i, 1..n, b[i]³)"
expect = "fails"
"#;

#[test]
fn the_toda_lattice_is_typed_once_for_any_number() {
    settled(TODA);
    settled(&TODA.replace("n = 5", "n = 2"));
    let case = Case::parse(TODA, &[]).expect("a case");
    assert_eq!(case.model.dimension(), 9, "a₁ … a₄, b₁ … b₅");
    assert_eq!(case.model.component_name(4), "b1", "components have names");
}

#[test]
fn particles_vortices_and_species() {
    settled(
        r#"
title = "Calogero-Moser"
[parameters]
n = 4
g = "0.5..2"
[state]
q = "vector(n, -3..3)"
p = "vector(n, -1..1)"
[field]
"q'" = "p"
"p[i]'" = "sum(j, 1..n, j ≠ i, 2*g²/(q[i] − q[j])^3)"
[[claim]]
integral = "(p,p)/2 + sum(i, 1..n−1, sum(j, i+1..n, g²/(q[i]−q[j])²))"
[[claim]]
integral = "sum(i, 1..n, p[i]^3/3 + sum(j, 1..n, j ≠ i, g²*p[i]/(q[i]−q[j])²))"
[[claim]]
symmetry-field = { q = "vector(i, 1..n, 1)" }
[[claim]]
reversor = { p = "−p" }
"#,
    );
    settled(
        r#"
title = "Vortices in the plane"
[parameters]
n = 4
Gamma = "vector(n, 0.5..2)"
[state]
z = "matrix(n, 2, -2..2)"
[field]
"z[i]'" = "sum(j, 1..n, j ≠ i, Gamma[j]*[z[j,2] − z[i,2], z[i,1] − z[j,1]]/(z[i] − z[j])²)"
[[claim]]
integral = "sum(i, 1..n, j, i+1..n, Gamma[i]*Gamma[j]*log((z[i] − z[j])²))"
[[claim]]
integral = "sum(i, 1..n, Gamma[i]*z[i])"
[[claim]]
density = "1"
"#,
    );
    settled(
        r#"
title = "Closed chain of species"
[parameters]
n = 5
[state]
x = "vector(n, 0.5..2)"
[field]
"x[i]'" = "x[i]*(x[i+1 mod n] − x[i−1 mod n])"
[[claim]]
integral = "sum(i, 1..n, x[i])"
[[claim]]
integral = "product(i, 1..n, x[i])"
[[claim]]
density = "1/product(i, 1..n, x[i])"
[[claim]]
integral = "sum(i, 1..n, x[i]²)"
expect = "fails"
"#,
    );
    settled(
        r#"
title = "N bodies in space"
system = "nonholonomic"
[parameters]
n = 3
m = "vector(n, 0.5..2)"
[state]
q = "matrix(n, 3, -2..2)"
"q'" = "matrix(n, 3, -1..1)"
[lagrangian]
kinetic = "sum(i, 1..n, m[i]*q'[i]²)/2"
potential = "−sum(i, 1..n, j, i+1..n, m[i]*m[j]/|q[i] − q[j]|)"
[[claim]]
integral = "energy"
[[claim]]
integral = "sum(i, 1..n, m[i]*(q[i] × q'[i]))"
[[claim]]
integral = "sum(i, 1..n, m[i]*(q[i] − t*q'[i]))"
"#,
    );
}

#[test]
fn rates_of_components_and_rows() {
    let chain = |field: &str| {
        format!(
            "title = 't'\n[parameters]\nn = 4\n[state]\nx = 'vector(n, -1..1)'\n\
             A = 'matrix(2, 3, -1..1)'\n[field]\n{field}[[claim]]\nidentity = \"x' = [x[2], x[3], x[4], \
             −x[1]]\"\n[[claim]]\nidentity = \"A' = [[1,2,3],[x[1],x[1],x[1]]]\"\n"
        )
    };
    let rows = "\"A[i]'\" = '[x[1],x[1],x[1]]'\n\"A[1]'\" = '[1,2,3]'\n";
    let entries = "\"A[i,j]'\" = 'x[1]'\n\"A[1,j]'\" = 'j'\n";
    settled(&chain(&format!("\"x[i]'\" = 'x[i+1]'\n\"x[n]'\" = '−x[1]'\n{rows}")));
    settled(&chain(&format!("\"x'[i]\" = 'if(i = n, −x[1], x[i+1 mod n])'\n{entries}")));
    let ranges = "\"x[i]', i = 1..n-1\" = 'x[i+1]'\n\"x[i]', i = n..n\" = '−x[1]'\n";
    settled(&chain(&format!("{ranges}{rows}")));
    let twice = error(&chain(&format!("\"x[i]', i = 1..3\" = 'x[i]'\n\"x[i]'\" = 'x[i]'\n{rows}")));
    assert_eq!(twice[0].1, "`x[1]` cannot be a name here: the rate of `x[1]` is given twice");
    let missing = error(&chain(&format!("\"x[i]', i = 1..3\" = 'x[i]'\n{rows}")));
    assert_eq!(missing[0].1, "[field] has no rate for `x[4]`");
    let beyond = error(&chain(&format!("\"x[i]'\" = 'x[i+1]'\n{rows}")));
    assert_eq!((beyond[0].0, beyond[0].1.as_str()), (8, "there is no component 5"));
    assert!(beyond[0].2.contains("x[i+1 mod 4]"), "{}", beyond[0].2);
    let odd = error(&chain(&format!("\"x[i]'\" = 'x[i]) + (x[i]'\n{rows}")));
    assert_eq!(odd[0].1, "the brackets of this formula do not match");
}

#[test]
fn an_isospectral_flow_of_any_size() {
    settled(
        r#"
title = "Isospectral flow"
[parameters]
n = 4
S = "skew(n, -1..1)"
D = "diag(n, 1..3)"
Y = "symmetric(n, -1..1)"
F = [[1, 2], [3, 4], [5, 6]]
f = [1, 2, 3, 4, 5]
[state]
L = "matrix(n, n, -1..1)"
v = "vector(n, -1..1)"
[field]
"L'" = "S*L − L*S"
"v'" = "S*v"
[[claim]]
integral = "vector(k, 1..3, tr(L^k))"
[[claim]]
integral = "(v, L*v) + det(L)"
[[claim]]
identity = "adj(L)*L = det(L)*E(n)"
[[claim]]
identity = "L*solve(L, v) = v"
[[claim]]
identity = "Yᵀ + S*S = Y + (S*S)ᵀ"
[[claim]]
identity = "det(D) = D[1,1]*D[2,2]*D[3,3]*D[4,4]"
[[claim]]
identity = "(f,f) + det(F[1] ⊗ F[2]) = 55"
[[claim]]
identity = "Fᵀ*F = [[35, 44], [44, 56]]"
[[claim]]
integral = "L[1,1]"
expect = "fails"
[[claim]]
density = "1"
"#,
    );
}

#[test]
fn constants_and_functions_are_exact() {
    settled(
        r#"
title = "functions"
[state]
x = "0.2..0.9"
y = "-2..-1"
[field]
"x'" = "1"
"y'" = "0"
[[claim]]
identity = "e^(2*x) = exp(x)^2"
[[claim]]
identity = "cosh(x)^2 − sinh(x)^2 = 1"
[[claim]]
rate = "tanh(x)"
equals = "1 − tanh(x)^2"
[[claim]]
rate = "asin(x) + 3*acos(x)"
equals = "−2/√(1 − x²)"
[[claim]]
identity = "asin(x) + acos(x) = π/2"
[[claim]]
rate = "atan2(x, y)"
equals = "y/(x² + y²)"
[[claim]]
rate = "asinh(x) + atanh(x)"
equals = "1/√(1 + x²) + 1/(1 − x²)"
[[claim]]
identity = "sign(y) = −1"
[[claim]]
identity = "max(x, y, −3) − min(x, y, 5) = x − y"
[[claim]]
identity = "min(x, 1/2) = x"
expect = "fails"
[[claim]]
density = "exp(atan2(x, y)) + cosh(x)"
expect = "fails"
"#,
    );
}

#[test]
fn special_angles_are_those_of_pi_and_of_no_decimal() {
    let verdicts = judged(
        "title = 't'\n[state]\nx = '0..1'\n[field]\n\"x'\" = '1'\n[[claim]]\n\
         identity = 'sin(π/6 + x) = cos(x)/2 + √3*sin(x)/2'\n[[claim]]\n\
         identity = 'sin(3141592653589793/10^15 + x) = −sin(x)'\nexpect = 'fails'\n",
    );
    assert_eq!(verdicts, [Verdict::Proved, Verdict::Refuted], "π is no decimal");
}

#[test]
fn time_is_a_variable_where_it_is_used() {
    let lorenz = r#"
title = "Lorenz, b = 2 sigma"
[parameters]
sigma = "1..10"
r = "1..30"
[state]
x = "-2..2"
y = "-2..2"
z = "0..4"
[field]
"x'" = "sigma*(y − x)"
"y'" = "r*x − y − x*z"
"z'" = "x*y − 2*sigma*z"
[[claim]]
integral = "exp(2*sigma*t)*(x² − 2*sigma*z)"
[[claim]]
density = "exp(t*(3*sigma + 1))"
[[claim]]
integral = "exp(sigma*t)*(x² − 2*sigma*z)"
expect = "fails"
"#;
    settled(lorenz);
    let case = Case::parse(lorenz, &[]).expect("a case");
    assert_eq!(case.model.state[3].name, "t", "t stands behind the others");
    let state = liouville::verdict::read_state(&case, "x=1 y=2 z=1 t=0.5").expect("a state");
    let report = liouville::verdict::evaluate(&case, Some(&state), 1, 0).expect("a point");
    assert_eq!(report.field[3].map(|(mid, _)| mid), Some(1.0), "its rate is 1");
    let without = lorenz.split("[[claim]]").next().unwrap_or_default();
    assert_eq!(Case::parse(without, &[]).expect("a case").model.state.len(), 3, "only where used");
    let ranged = lorenz.replace("z = \"0..4\"", "z = \"0..4\"\nt = \"3..4\"");
    settled(&ranged);
    settled(
        r#"
title = "Driven oscillator on a turning line"
system = "nonholonomic"
[parameters]
w = "0.5..2"
[state]
x = "-2..2"
y = "-2..2"
"x'" = "-2..2"
"y'" = "-2..2"
[lagrangian]
kinetic = "(x'² + y'²)/2"
potential = "x*cos(w*t)"
constraints = ["x'*sin(w*t) − y'*cos(w*t) = 0"]
forces = { y = "−t" }
[[claim]]
rate = "energy"
equals = "−t*y' − w*x*sin(w*t)"
where = "level"
[[claim]]
invariant-relation = "x'*sin(w*t) − y'*cos(w*t)"
cofactor = "0"
"#,
    );
    settled(
        r#"
title = "a level that moves"
[state]
x = "-1..1"
y = "-1..1"
[field]
"x'" = "cos(t)"
"y'" = "x"
[level]
equations = ["x − sin(t) = 0"]
[level.chart]
inputs = { y = "-1..1" }
x = "sin(t)"
[[claim]]
identity = "x = sin(t)"
[[claim]]
integral = "y + cos(t)"
where = "level"
"#,
    );
    settled(
        r#"
title = "a body, and time"
system = "rubber-plane"
[parameters]
m = 1
R = 2
I = [1, 2, 2.5]
[body]
shape = "ball"
[[claim]]
rate = "t*energy"
equals = "energy"
"#,
    );
}
