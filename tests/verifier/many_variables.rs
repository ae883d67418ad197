//! Derivatives of systems of many variables: the sweeps of a recording against lifts of f64 along
//! each coordinate, which the same code does where nothing is recorded.

use crate::common::case;
use liouville::case::Case;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::Phase;
use liouville::mechanics::calculus::DualPoint;
use liouville::number::float::Float;
use liouville::scalar::Scalar;
use liouville::verdict::{Options, Verdict, judge};

/// Systems of 22 to 48 variables: Lagrangians with dense and sparse mass matrices, constraints,
/// forces, multipliers and matrices of coordinates, a Hamiltonian with a level, and a field.
const SYSTEMS: [&str; 6] = [
    r#"title = "pendulum"
system = "nonholonomic"
[parameters]
n = 11
[state]
q = "vector(n, -1..1)"
"q'" = "vector(n, -1..1)"
[lagrangian]
kinetic = "sum(i, 1..n, sum(j, 1..i, q'[j]*cos(q[j]))² + sum(j, 1..i, q'[j]*sin(q[j]))²)/2"
potential = "−sum(i, 1..n, (n + 1 − i)*cos(q[i]))"
forces = { q = "vector(i, 1..n, −i*q'[i])" }
[[claim]]
integral = "energy + q[1]*q'[2]"
[[claim]]
density = "√(2 + q[1]²)*exp(q[3])/(3 + q[2])^(1/3)"
"#,
    r#"title = "bodies"
system = "nonholonomic"
[parameters]
n = 4
[state]
q = "matrix(n, 3, -2..2)"
"q'" = "matrix(n, 3, -1..1)"
[lagrangian]
kinetic = "sum(i, 1..n, i*q'[i]²)/2"
potential = "−sum(i, 1..n−1, sum(j, i+1..n, i*j/|q[i] − q[j]|))"
[[claim]]
integral = "sum(i, 1..n, i*q[i] × q'[i])"
[[claim]]
density = "1"
"#,
    r#"title = "train of carts"
system = "nonholonomic"
[parameters]
n = 11
[state]
q = "vector(n, -1..1)"
"q'" = "vector(n, -1..1)"
[lagrangian]
kinetic = "sum(i, 1..n, (1 + q[i]²)*q'[i]²)/2"
potential = "sum(i, 1..n−1, (q[i+1] − q[i])^4)/4"
constraints = ["q'[1] − q[2]*q'[3] = 0", "q'[4]*cos(q[5]) − q'[6] = 0"]
[[claim]]
integral = "energy"
[[claim]]
density = "1 + q[1]²"
"#,
    r#"title = "vakonomic chain"
system = "vakonomic"
[parameters]
n = 11
[state]
q = "vector(n, -1..1)"
"q'" = "vector(n, -1..1)"
"λ" = "-1..1"
[lagrangian]
kinetic = "sum(i, 1..n, q'[i]²)/2"
constraints = ["q'[1] − q[2]*q'[3] = 0"]
multipliers = ["λ"]
[[claim]]
integral = "energy"
[[claim]]
density = "1"
"#,
    r#"title = "particles, by Hamilton"
[parameters]
n = 12
[state]
q = "vector(n, 0..1)"
p = "vector(n, -1..1)"
[hamiltonian]
function = "sum(i, 1..n, p[i]²)/2 + sum(i, 1..n−1, 1/(q[i] − q[i+1] − 2)²)"
pairs = [["q", "p"]]
[level]
equations = ["sum(i, 1..n, p[i]) = 0"]
[[claim]]
integral = "energy"
[[claim]]
density = "1"
"#,
    r#"title = "field"
[parameters]
n = 24
[state]
x = "vector(n, 1..2)"
[field]
"x[i]'" = "x[i]*sum(j, 1..n, (i − j)/(i + j)*√(1 + x[j]))"
[[claim]]
integral = "vector(k, 1..3, sum(i, 1..n, atan(x[i])^k))"
[[claim]]
density = "x[1]^x[2]/product(i, 1..n, x[i])"
"#,
];

/// All derivatives that claims are made of.
fn derivatives<T: Scalar>(case: &Case, state: &[T]) -> Vec<T> {
    let jet = DualPoint::new(Phase::new(&case.model, &[], state));
    let formula = |k: usize| case.claims[k].kind.formula().expect("a formula");
    let all = vec![true; case.model.level.len()];
    let mut values = jet.phase.field().to_vec();
    values.push(jet.divergence());
    values.push(jet.level_cofactor(&all));
    values.extend(jet.gradients(formula(0)).concat());
    values.extend(jet.logarithmic_gradient(formula(1)));
    values.extend(jet.level_gradients(&all).concat());
    values.extend(jet.energy_gradient().into_iter().flatten());
    values
}

#[test]
fn sweeps_compute_what_lifts_do() {
    for text in SYSTEMS {
        let case = case(text);
        let dimension = case.model.dimension();
        assert!(dimension >= 22, "{}: sweeps are for many variables", case.title);
        let state: Vec<f64> = (0..dimension).map(|k| 1.0 + 0.5 * (1.7 * k as f64).sin()).collect();
        let (graph, recorded) =
            record(dimension, |x: &[Expr]| derivatives(&case, x)).expect("records");
        let tape = Tape::new(&graph, &recorded);
        let mut evaluator = Evaluator::new(&tape, Float::<1>);
        evaluator.run(&state.iter().map(|x| [*x]).collect::<Vec<_>>());
        let direct = derivatives(&case, &state);
        assert_eq!(direct.len(), recorded.len(), "{}", case.title);
        for (k, (found, expected)) in evaluator.outputs().zip(&direct).enumerate() {
            let gap = (found[0] - expected).abs();
            let most = 1e-9 * expected.abs().max(1.0);
            assert!(gap <= most, "{}, value {k}: {} for {expected}", case.title, found[0]);
        }
    }
}

#[test]
fn twenty_functions_are_compared() {
    let text = |last: &str| {
        let own: Vec<String> = (1..=19).map(|k| format!("\"x{k}² + {k}*p{k}²\"")).collect();
        format!(
            "title = \"Oscillators\"\n[state]\nx = \"vector(20, 1..2)\"\np = \"vector(20, 1..2)\"\n\
             [field]\n\"x[i]'\" = \"i*p[i]\"\n\"p[i]'\" = \"−x[i]\"\n\
             [[claim]]\nindependent = [{}, \"{last}\"]",
            own.join(", ")
        )
    };
    let verdict = |last: &str| {
        let report = judge(&case(&text(last)), &Options::default()).expect("a report");
        report.claims[0].verdict
    };
    assert_eq!(verdict("x20² + 20*p20²"), Verdict::Proved, "another oscillator");
    assert_eq!(
        verdict("x19² + 19*p19² − 3*(x1² + p1²)*(x2² + 2*p2²)"),
        Verdict::Refuted,
        "dependent"
    );
}

/// n bodies on a line with the potentials √(1 + (qᵢ − qⱼ)²), and their energy with a factor.
fn springs(bodies: usize, factor: &str) -> String {
    let all = 0..bodies;
    let root = |i: usize, j: usize| format!("√(1 + (q{i} - q{j})^2)");
    let mut text = String::from("title = 'springs'\n[state]\n");
    for i in all.clone() {
        text += &format!("q{i} = '-2..2'\np{i} = '-2..2'\n");
    }
    text += "[field]\n";
    for i in all.clone() {
        let forces = all.clone().filter(|j| *j != i);
        let forces: Vec<String> = forces.map(|j| format!("(q{i} - q{j})/{}", root(i, j))).collect();
        text += &format!("\"q{i}'\" = 'p{i}'\n\"p{i}'\" = '-({})'\n", forces.join(" + "));
    }
    let kinetic: Vec<String> = all.clone().map(|i| format!("p{i}^2/2")).collect();
    let pairs = all.clone().flat_map(|i| (0..i).map(move |j| (i, j)));
    let potential: Vec<String> = pairs.map(|(i, j)| root(i, j)).collect();
    text + &format!(
        "[[claim]]\nintegral = '{} + {factor}*({})'\n",
        kinetic.join(" + "),
        potential.join(" + ")
    )
}

#[test]
fn the_energy_of_many_bodies_with_roots_is_proved() {
    let verdict = |text: &str| {
        let report = judge(&case(text), &Options::default()).expect("it is judged");
        report.claims[0].verdict
    };
    // 120 roots: more than can be told apart.
    assert_eq!(verdict(&springs(16, "1")), Verdict::Proved);
    assert_eq!(verdict(&springs(16, "1.000001")), Verdict::Refuted);
}
