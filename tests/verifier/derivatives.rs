//! Derivatives recorded through the graph against num-dual at f64, and against their definitions.
//!
//! Both computations carry out the same operations except those folded away exactly, so that each
//! has an error of about the running bound of the other: they differ by at most twice the radius of
//! the ball.

use crate::common::{assert_meet, case, claim, claim_text, exact, rational, report};
use liouville::case::Case;
use liouville::formula::{Scope, Value};
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::Phase;
use liouville::mechanics::calculus::DualPoint;
use liouville::number::Domain;
use liouville::number::ball::Ball;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use liouville::verdict::Enclosed;
use nalgebra::{Matrix3, Vector3};
use num_dual::Dual;

const TENSOR: &str = "I = [[2.5, 0.25, -0.125], [0.25, 3, 0.375], [-0.125, 0.375, 3.5]]";
const INTEGRAL: &str = "(Ĩ*ω,ω)*(γ,Ĩ*γ) + |r|*(ω,r') + ω1³";

/// Bodies of every shape: system, parameters besides m and I, lines of `[body]`.
const BODIES: [(&str, &str, &str); 10] = [
    ("rubber-plane", "R = 1.5\nc = [0.25, -0.5, 0.125]", "shape = \"ball\""),
    (
        "rubber-plane",
        "B = [1, 2, 3.5]\nS = [1, -0.5, 2]",
        "shape = \"ellipsoid\"\ngyrostat = \"S\"",
    ),
    ("rubber-plane", "", "profile = \"2 + z/4 + z²/5\"\npotential = \"γ3 + γ3²\""),
    ("rubber-plane", "", "support = \"3*|γ| + γ1*γ2*γ3/(5*|γ|²) + γ2/4\""),
    ("rubber-sphere", "k = 0.375\nR = 1.5\nc = [0.25, -0.5, 0.125]", "shape = \"ball\""),
    ("rubber-sphere", "k = -0.25\nR = 1.5\nc = [0.25, -0.5, 0.125]", "contact = \"−R*γ − c\""),
    ("rubber-sphere", "k = 0.5\nB = [1, 2, 3.5]", "shape = \"ellipsoid\"\npotential = \"γ1*γ2²\""),
    // Two extensions off |γ| = 1 for which Γ is not symmetric; the second leaves γ² = 1 behind.
    (
        "rubber-sphere",
        "k = 0.5\nB = [1, 2, 3.5]\nc = [0.25, -0.5, 0.125]",
        "contact = \"−B*γ*(1 + (γ,γ))/(2*√(γ,B*γ)) − c\"",
    ),
    (
        "rubber-sphere",
        "k = 0.375",
        "contact = \"[(γ3²/5 − 2)*γ1, (γ3²/5 − 2)*γ2, γ3³/5 − 12*γ3/5 − 1/4]\"",
    ),
    ("rubber-sphere", "k = 0.25", "support = \"3*|γ| + γ1*γ2*γ3/(5*|γ|²) + γ2/4\""),
];

/// Iterates over the bodies, each without spin and with it.
fn bodies() -> impl Iterator<Item = Case> {
    let ways = ["rubber", "rolling"].into_iter();
    let all = ways.flat_map(|way| BODIES.iter().map(move |body| (way, body)));
    all.map(|(way, (system, parameters, body))| {
        let system = system.replace("rubber", way);
        let claims = claim_text("F", "integral", INTEGRAL) + &claim_text("ρ", "density", INTEGRAL);
        case(&format!(
            "title = '{system}, {}'\nsystem = \"{system}\"\ncheck-weights = false\n\
             [parameters]\nm = 1.25\n{TENSOR}\n{parameters}\n[body]\n{body}\n{claims}",
            body.lines().next().unwrap_or_default()
        ))
    })
}

fn spins(case: &Case) -> bool {
    case.system.starts_with("rolling")
}

/// Makes exact states on the level: γ from Pythagorean quadruples, ω = γ×a, with 3γ/4 added where
/// the body of the case may spin.
fn states(case: &Case) -> Vec<Vec<Rational>> {
    let spin = exact(if spins(case) { "3/4" } else { "0" });
    let pairs = [
        (["2/7", "3/7", "6/7"], ["1", "-1/2", "3/5"]),
        (["-4/9", "4/9", "7/9"], ["2/3", "1", "-1/4"]),
        (["6/11", "-2/11", "-9/11"], ["-1", "3/4", "5/3"]),
    ];
    let cross = |g: &[num_rational::BigRational], a: &[num_rational::BigRational]| {
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &g[i] * &a[j] - &g[j] * &a[i])
    };
    pairs
        .iter()
        .map(|(gamma, a)| {
            let (gamma, a) = (gamma.map(exact), a.map(exact));
            let across = cross(&gamma, &a).into_iter().zip(&gamma);
            let omega: Vec<_> = across.map(|(x, g)| x + g * &spin).collect();
            omega.iter().chain(&gamma).map(rational).collect()
        })
        .collect()
}

fn floats(state: &[Rational]) -> Vec<f64> {
    state.iter().map(|x| x.to_f64().0).collect()
}

fn assert_near(direct: f64, recorded: Enclosed, what: &str) {
    let (mid, radius) = recorded.unwrap_or_else(|| panic!("{what} is defined on the tape"));
    let gap = (direct - mid).abs();
    // The tape was run in 160 bits; the difference is the rounding of the code in f64.
    let rounding = 2f64.powi(-36) * mid.abs().max(1.0);
    assert!(gap <= rounding, "{what}: {direct} at f64, {mid} ± {radius:e} on the tape");
    let coarsest = f64::EPSILON.sqrt() * mid.abs().max(1.0);
    assert!(radius <= coarsest, "{what}: ± {radius:e} compares nothing");
}

#[test]
fn the_graph_records_what_num_dual_computes() {
    for case in bodies() {
        let [integral, density] = [0, 1].map(|i| case.claims[i].kind.formula().expect("a formula"));
        for (index, state) in states(&case).iter().enumerate() {
            let found = report(&case, state);
            let jet = DualPoint::new(Phase::new(&case.model, &[], &floats(state)));
            let phase = &jet.phase;
            let near = |direct: f64, recorded, name: &str| {
                assert_near(direct, recorded, &format!("{} at {index}, {name}", case.title));
            };
            for (i, rate) in phase.field().iter().enumerate() {
                near(*rate, found.field[i], &format!("v[{i}]"));
            }
            let divergence = jet.divergence();
            near(divergence, found.divergence, "div v");
            let cofactor = jet.level_cofactor(&vec![true; case.model.level.len()]);
            near(divergence - cofactor, found.level_divergence, "div v on the level");
            let system = &case.model.system;
            for (i, chi) in system.chi(phase).expect("χ").into_iter().enumerate() {
                near(chi, found.chi.expect("χ")[i], &format!("χ[{i}]"));
            }
            let recorded = match found.conditions {
                Some(conditions) => conditions.to_vec(),
                None => vec![found.criterion.flatten()],
            };
            let direct = system.criterion(phase);
            assert_eq!(direct.len(), recorded.len(), "C, or C₁ and C₂");
            for (direct, recorded) in direct.into_iter().zip(recorded) {
                near(direct, recorded, "C");
            }
            near(system.energy(phase).expect("E"), found.energy.flatten(), "E");
            let rate = jet.lie_derivative(|at| at.scalar(integral));
            near(rate, claim(&found, "F").1, "L_v F");
            let value = phase.scalar(density);
            near(
                rate / value + divergence - cofactor,
                claim(&found, "ρ").1,
                "Liouville's equation",
            );
        }
    }
}

#[test]
fn the_divergence_is_linear_in_the_velocity_with_the_coefficients_chi() {
    for case in bodies() {
        for (index, state) in states(&case).iter().enumerate() {
            let found = report(&case, state);
            let chi = found.chi.expect("χ").map(|x| x.expect("χ is defined"));
            let (mut sum, mut radius) = (0.0, 0.0);
            for ((mid, rad), omega) in chi.iter().zip(floats(state)) {
                sum += mid * omega;
                // ω, the product and two sums are rounded.
                radius += rad * omega.abs() + 2.0 * f64::EPSILON * (mid * omega).abs();
            }
            let radius = radius * (1.0 + 8.0 * f64::EPSILON);
            let what = format!("{} at {index}: (χ,ω)", case.title);
            assert_meet(Some((sum, radius)), found.level_divergence, &what);
        }
    }
}

/// Computes χ̄ with div v = (χ̄,γ') on the level: Γᵀχ̂, χ̂_j minus the divergence at ω = γ×e_j.
fn covector<T: Scalar>(case: &Case, gamma: Vector3<T>) -> Vector3<T> {
    let at = |omega: Vector3<T>| {
        let state: Vec<T> = omega.iter().chain(gamma.iter()).copied().collect();
        Phase::new(&case.model, &[], &state)
    };
    let chi_hat = Vector3::from_fn(|j, _| {
        let mut unit = Vector3::repeat(T::zero());
        unit[j] = T::one();
        let jet = DualPoint::new(at(gamma.cross(&unit)));
        jet.level_cofactor(&vec![true; case.model.level.len()]) - jet.divergence()
    });
    let Some((symbol, _)) = case.model.vocabulary.lookup("Γ") else { return chi_hat };
    let Value::Matrix(turning): Value<T> = at(gamma).value(symbol) else {
        panic!("Γ is a matrix")
    };
    turning.transpose() * chi_hat
}

/// Computes (γ, rot χ̄) by definition.
fn criterion<T: Scalar>(case: &Case, gamma: Vector3<T>) -> T {
    let slopes: Matrix3<T> = Matrix3::from_columns(&[0, 1, 2].map(|j| {
        let mut lifted = gamma.map(Dual::from_re);
        lifted[j].eps = T::one();
        covector(case, lifted).map(|x| x.eps)
    }));
    let rotation = |i: usize, j: usize| slopes[(j, i)] - slopes[(i, j)];
    gamma[0] * rotation(1, 2) + gamma[1] * rotation(2, 0) + gamma[2] * rotation(0, 1)
}

/// Computes (γ, rot χ̄) in balls, at an exact γ.
fn criterion_in_balls(case: &Case, gamma: &[Rational]) -> Enclosed {
    let build = |inputs: &[Expr]| criterion(case, Vector3::from_column_slice(inputs));
    let (graph, value) = record(3, build).expect("it records");
    let tape = Tape::new(&graph, &[value]);
    let mut evaluator = Evaluator::new(&tape, Ball::<1>);
    let inputs: Vec<_> = gamma.iter().map(|x| Ball::<1>.values(std::slice::from_ref(x))).collect();
    evaluator.run(&inputs);
    let ball = evaluator.output(0);
    ball.is_defined(0).then(|| (ball.mid[0], ball.rad[0]))
}

#[test]
fn the_criterion_is_the_rotation_of_the_divergence() {
    for case in bodies() {
        let state = &states(&case)[0];
        let gamma = &state[3..];
        let defined = criterion_in_balls(&case, gamma);
        let found = report(&case, state);
        match found.conditions {
            None => assert_meet(defined, found.criterion.flatten(), &case.title),
            Some([along, across]) => {
                // C₁ is div v at ω = γ, and d ln ρ = -(χ̄,dγ).
                let turning = report(&case, &[gamma, gamma].concat()).level_divergence;
                assert_meet(turning, along, &format!("{}, C₁", case.title));
                let negative = across.map(|(mid, radius)| (-mid, radius));
                assert_meet(defined, negative, &format!("{}, C₂", case.title));
            }
        }
        let direct = criterion(&case, Vector3::from_column_slice(&floats(gamma)));
        assert_near(direct, defined, &case.title);
    }
}

#[test]
fn the_criterion_of_a_flat_base_is_the_rotation_of_the_divergence() {
    let case = case(&format!(
        "title = \"flat base\"\nsystem = \"flat-base\"\n[parameters]\nm = 1.25\n{TENSOR}\n\
         z = -0.5\nk = 0.75\n[body]\n"
    ));
    let state: Vec<Rational> =
        ["1", "-2/3", "1/2", "1/4"].map(|x| rational(&exact(x))).into_iter().collect();
    // div v = -(ξ,r') with r' = (ω₂,-ω₁)/k: ξ₁ at ω = (0,-k), ξ₂ at ω = (k,0).
    let xi = |i: usize, r: [Dual<f64>; 2]| {
        let k = Dual::from_re(0.75);
        let omega = [[Dual::from_re(0.0), -k], [k, Dual::from_re(0.0)]][i];
        DualPoint::new(Phase::new(&case.model, &[], &[omega, r].concat())).divergence()
    };
    let (still, along) = (|x: f64| Dual::new(x, 0.0), |x: f64| Dual::new(x, 1.0));
    let found = report(&case, &state).criterion.flatten();
    let curl = xi(1, [along(0.5), still(0.25)]).eps - xi(0, [still(0.5), along(0.25)]).eps;
    assert_near(curl, found, "∂ξ₂/∂r₁ - ∂ξ₁/∂r₂");
    assert!(
        crate::common::excludes_zero(found),
        "a full tensor has no density ρ(r₁,r₂): {found:?}"
    );
}
