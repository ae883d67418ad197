//! Merging by value: merged nodes have the same values, different ones stay apart, and the closed
//! formulas of the mechanics are proved equal to the definitions by the tool.

use crate::common::case;
use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::graph::{Evaluator, Expr, Graph, Points, Tape, record};
use liouville::mechanics::Phase;
use liouville::mechanics::calculus::DualPoint;
use liouville::number::float::Float;
use liouville::proof::{Group, GroupOutcome, Prover};
use liouville::scalar::Scalar;
use liouville::verdict::Sampler;
use liouville_lab::bench::{record_merged, record_residual, work_items};
use num_dual::DualNum;

/// Returns the operations before and after, and the values of both at a point.
fn merged<const N: usize>(
    point: [f64; N],
    build: impl FnOnce(&[Expr]) -> Vec<Expr>,
) -> (usize, usize, Vec<(f64, f64)>) {
    let (graph, outputs) = record(N, build).expect("records");
    let (short, merged) = graph.merged(&outputs, &[]).expect("merges");
    let value = |graph: &Graph, outputs: &[Expr]| -> Vec<f64> {
        let tape = Tape::new(graph, outputs);
        let mut evaluator = Evaluator::new(&tape, Float::<1>);
        evaluator.run(&point.map(|x| [x]));
        evaluator.outputs().map(|block| block[0]).collect()
    };
    let pairs = value(&graph, &outputs).into_iter().zip(value(&short, &merged)).collect();
    (graph.operations(&outputs), short.operations(&merged), pairs)
}

#[test]
fn equal_and_proportional_values_are_one_node() {
    let (before, after, pairs) = merged([0.7, -1.3], |x| {
        let (a, b) = (x[0], x[1]);
        // (a + b)² made twice, and its triple.
        let square = (a + b) * (a + b);
        let expanded = a * a + a * b * 2.0 + b * b;
        let triple = a * a * 3.0 + b * (a * 6.0 + b * 3.0);
        vec![square.exp(), expanded.exp() + 1.0, triple]
    });
    assert!(before >= 15 && after == 5, "a + b, its square, exp, + 1 and times 3: {after}");
    for (recorded, merged) in pairs {
        assert!((recorded - merged).abs() <= 4.0 * f64::EPSILON * recorded.abs(), "same values");
    }
}

#[test]
fn roots_merge_under_products_and_never_by_a_sign() {
    let (_, after, pairs) = merged([-0.7, 2.0], |x| vec![(x[0] * x[0]).sqrt() * x[1], x[0] * x[1]]);
    assert_eq!(after, 4, "√(x²) is not x");
    assert_eq!(pairs, [(1.4, 1.4), (-1.4, -1.4)], "at negative x least of all");
    let (_, after, _) =
        merged([0.7, 2.0], |x| vec![(x[0] * x[1]).sqrt() + 1.0, x[0].sqrt() * x[1].sqrt() + 2.0]);
    assert!(after <= 5, "√x √y is √(xy): {after}");
    let modulus = |x: &[Expr]| vec![x[0].modulus() + x[1], (x[0] * x[0]).sqrt() + x[1] * 2.0];
    let (_, _, pairs) = merged([-0.7, 2.0], modulus);
    assert!(pairs.iter().all(|(a, b)| (a - b).abs() < 1e-15), "|x| is √(x²), for every sign");
}

#[test]
fn constant_factors_are_left_to_the_end() {
    let (before, after, pairs) = merged([0.7, -1.3], |x| {
        let (a, b) = (x[0] * 3.0, x[1] * 3.0);
        vec![(a * a + b * b + 18.0) * a * b]
    });
    // a² + b² + 2, times a, times b, times 81.
    assert_eq!((before, after), (8, 7), "two products fewer, and one at the end");
    for (recorded, merged) in pairs {
        assert!((recorded - merged).abs() <= 4.0 * f64::EPSILON * recorded.abs(), "same values");
    }
    let (_, after, _) = merged([0.7, -1.3], |x| vec![x[0] * 2.0 + x[1] * 3.0, x[1] * -3.0]);
    assert!(after <= 4, "a sum of different multiples: {after}");
}

/// Values at points of the unit circle, and their operations before and after.
fn merged_on_circle(build: impl FnOnce(&[Expr]) -> Expr) -> (usize, Option<usize>) {
    let (circle, inputs) = record(2, |t| {
        let length = (t[0] * t[0] + 1.0).recip();
        vec![(-t[0] * t[0] + 1.0) * length, t[0] * length * 2.0, t[1]]
    })
    .expect("records");
    let (graph, output) = record(3, build).expect("records");
    let points = Points { graph: &circle, inputs: &inputs, signs: vec![false, true] };
    let merged = graph.merged_at(&[output], &[], &points).expect("merges");
    (graph.operations(&[output]), merged.map(|(graph, outputs)| graph.operations(&outputs)))
}

#[test]
fn values_that_are_equal_at_the_points_given_are_one_node() {
    let square = |x: &[Expr]| x[0] * x[0] + x[1] * x[1];
    let (before, after) = merged_on_circle(|x| x[0] / square(x).sqrt() + x[1] * square(x));
    assert!(before >= 8 && after == Some(1), "x + y on the circle: {after:?}");
    let (_, after) = merged_on_circle(|x| x[2] * x[2] * x[0] + x[2]);
    assert_eq!(after, Some(1), "x + s, as s² is 1 for a sign");
    let (_, after) = merged_on_circle(|x| x[2] + x[0] * x[0]);
    assert_eq!(after, Some(2), "but s is not");
    assert_eq!(merged_on_circle(|x| square(x) - 1.0).1, None, "nothing would be left of a zero");
}

#[test]
fn functions_merge_for_equal_arguments_only() {
    let (_, after, _) = merged([0.3], |x| vec![(x[0] + x[0]).sin(), (x[0] * 2.0).sin() * 3.0]);
    assert_eq!(after, 3, "one sine");
    let (_, after, _) = merged([0.3], |x| vec![x[0].sin() * 2.0, x[0].cos()]);
    assert_eq!(after, 3, "sine and cosine stay apart");
    let (_, after, _) = merged([0.3], |x| vec![x[0].sin() * x[0].sin() + x[0].cos() * x[0].cos()]);
    assert_eq!(after, 5, "what only functions know is not used");
}

#[test]
fn a_zero_that_was_not_folded_stays_computed() {
    let (_, after, pairs) =
        merged([0.7, -1.3], |x| vec![(x[0] + x[1]) * (x[0] - x[1]) - (x[0] * x[0] - x[1] * x[1])]);
    assert!(after >= 6, "both sides are computed: {after} operations");
    assert!(pairs[0].1.abs() < 1e-15, "and are equal but for rounding");
}

#[test]
fn a_division_by_zero_is_left_alone() {
    let (_, after, pairs) =
        merged([0.7], |x| vec![(x[0] + x[0] - x[0] * 2.0).recip() * x[0] + x[0]]);
    assert!(after >= 3, "no point has a value: nothing is merged");
    assert!(!pairs[0].1.is_finite(), "and it is as undefined as before");
}

/// Makes bodies on a plane, with the claims whose residuals contain the closed formulas.
fn bodies() -> Vec<Case> {
    let body = |parameters: &str, body: &str| {
        let claim = |name: &str, what: &str| {
            format!("[[claim]]\nname = '{name}'\n{what}\nexpect = 'open'\n")
        };
        let claims = [
            claim("momentum", "integral = 'Ĩ*ω'"),
            claim("energy", "integral = '(Ĩ*ω,ω)'"),
            claim("measure", "density = '(γ,adj(Ĩ)*γ)'"),
            claim("criterion", "analytic-density = 'exists'"),
        ];
        case(&format!(
            "title = 'x'\nsystem = 'rubber-plane'\ncheck-weights = false\n[parameters]\nm = '0.5..2'\n\
             I = 'full(0.5..5)'\nS = 'vector(-1..1)'\n{parameters}\n[body]\n{body}\n{}",
            claims.concat()
        ))
    };
    vec![
        body("R = '1..3'\nc = 'vector(-0.5..0.5)'", "shape = 'ball'"),
        body("B = 'diag(1..3)'", "shape = 'ellipsoid'\npotential = 'γ1*γ2²'"),
    ]
}

#[test]
fn short_formulas_are_proved_equal_to_the_definitions() {
    for case in bodies() {
        let everywhere = LevelSubset::everywhere(&case.model);
        let sampler = Sampler::new(&case, &everywhere, 1).expect("samples");
        let free = case.model.free_components();
        let (graph, differences) = record(free + case.model.dimension(), |inputs| {
            let (parameters, state) = inputs.split_at(free);
            let jet = DualPoint::new(Phase::new(&case.model, parameters, state));
            let system = &case.model.system;
            let claims = case.claims.iter();
            let mut long: Vec<Expr> =
                claims.flat_map(|claim| claim.kind.residual(&jet, &everywhere.kept)).collect();
            // The momentum has three formulas.
            let momentum_rate = long[..3].to_vec();
            long.splice(0..0, [&momentum_rate[..], &momentum_rate[..]].concat());
            long.push(jet.divergence());
            let short = system.shortcuts(&jet.phase);
            let [momentum @ .., energy, divergence, logarithm, rotation] = &short[..] else {
                panic!("a rubber body on the plane has them all")
            };
            let own = system.divergence(&jet.phase).expect("known on the plane");
            let sums = [*energy, *divergence + *logarithm, *rotation, own];
            let short = momentum.iter().chain(&sums);
            assert_eq!(momentum.len() + sums.len(), long.len(), "one for each");
            long.iter().zip(short).map(|(long, short)| *long - *short).collect::<Vec<Expr>>()
        })
        .expect("records");
        let fixed = vec![None; sampler.recipes().len()];
        let groups: Vec<Group> = differences.iter().map(|value| Group::of(vec![*value])).collect();
        let (graph, groups) = sampler.compose_groups(&graph, &groups, &fixed).expect("composes");
        let extents = sampler.extents();
        let prover = Prover { sources: &[], extents: &extents, seed: 1 };
        for (index, outcome) in prover.prove(&graph, &groups).expect("proves").iter().enumerate() {
            assert!(matches!(outcome, GroupOutcome::Zero(_)), "value {index}: {outcome:?}");
        }
    }
}

#[test]
fn the_work_items_take_few_operations() {
    // As counted; at most the counts for handwritten vectors, 236, 251 and 1032.
    for (item, most) in work_items().expect("cases").iter().zip([200, 220, 205]) {
        let claim = &item.case.claims[0];
        let (recorded, _) = record_residual(&item.case, claim).expect("records");
        let merged = record_merged(&item.case, claim).expect("merges");
        let (before, after) = (recorded.operations(), merged.operations());
        assert!(after <= most && after < before, "{}: {before} to {after}", item.name);
    }
}

#[test]
fn the_divergence_of_a_body_that_may_spin_is_its_closed_formula() {
    let body = |system: &str, parameters: &str, body: &str| {
        case(&format!(
            "title = 'x'\nsystem = '{system}'\ncheck-weights = false\n[parameters]\nm = '0.5..2'\n\
             I = 'full(0.5..5)'\nS = 'vector(-1..1)'\n{parameters}\n[body]\ngyrostat = 'S'\n{body}\n"
        ))
    };
    for case in [
        body("rolling-plane", "R = '1..3'\nc = 'vector(-0.5..0.5)'", "shape = 'ball'"),
        body("rolling-plane", "", "support = 'arbitrary'\npotential = 'γ1*γ2²'"),
        body("rolling-sphere", "B = 'diag(1..3)'\nk = '0.1..0.3'", "shape = 'ellipsoid'"),
    ] {
        let everywhere = LevelSubset::everywhere(&case.model);
        let sampler = Sampler::new(&case, &everywhere, 1).expect("samples");
        let free = case.model.free_components();
        let (graph, difference) = record(free + case.model.dimension(), |inputs| {
            let (parameters, state) = inputs.split_at(free);
            let jet = DualPoint::new(Phase::new(&case.model, parameters, state));
            let own = case.model.system.divergence(&jet.phase).expect("known");
            jet.divergence() - own
        })
        .expect("records");
        let fixed = vec![None; sampler.recipes().len()];
        let (graph, groups) = sampler
            .compose_groups(&graph, &[Group::of(vec![difference])], &fixed)
            .expect("composes");
        let extents = sampler.extents();
        let prover = Prover { sources: &[], extents: &extents, seed: 1 };
        let outcomes = prover.prove(&graph, &groups).expect("proves");
        assert!(matches!(outcomes.as_slice(), [GroupOutcome::Zero(_)]), "{outcomes:?}");
    }
    let driven = body("rolling-plane", "R = 1", "shape = 'ball'\nmoment = '(ω,γ)*γ'");
    let inputs = vec![0.5; driven.model.free_components() + driven.model.dimension()];
    let (parameters, state) = inputs.split_at(driven.model.free_components());
    let phase = Phase::new(&driven.model, parameters, state);
    assert!(driven.model.system.divergence(&phase).is_none(), "a moment that depends on ω");
}
