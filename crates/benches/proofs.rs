//! Time from a case in memory to a proof that L_vF₂ = 0, with an error below 2⁻¹⁰⁰.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::graph::{Expr, Graph, record};
use liouville::mechanics::Phase;
use liouville::mechanics::calculus::DualPoint;
use liouville::proof::{Group, GroupOutcome, Prover};
use liouville::verdict::Sampler;

const CLAIM: &str = "[body]\nshape = 'ball'\n[[claim]]\nname = 'F2'\n\
                     integral = '|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)'\n";

fn case(parameters: &str) -> Case {
    let text = format!("title = 'F2'\nsystem = 'rubber-plane'\n[parameters]\n{parameters}{CLAIM}");
    Case::parse(&text, &[]).expect("a case")
}

fn residual(case: &Case) -> (Graph, Vec<Expr>) {
    let free = case.model.free_components();
    record(free + case.model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(free);
        let jet = DualPoint::new(Phase::new(&case.model, parameters, state));
        case.claims[0].kind.residual(&jet, &LevelSubset::level(&case.model).kept)
    })
    .expect("records")
}

/// Substitutes the chart and tests the identity.
fn prove(sampler: &Sampler, graph: &Graph, residual: &[Expr]) -> GroupOutcome {
    let fixed = vec![None; sampler.recipes().len()];
    let composed = sampler.compose_groups(graph, &[Group::of(residual.to_vec())], &fixed);
    let (graph, groups) = composed.expect("composes");
    let extents = sampler.extents();
    let prover = Prover { sources: &[], extents: &extents, seed: 1 };
    prover.prove(&graph, &groups).expect("proves").remove(0)
}

fn proofs(criterion: &mut Criterion) {
    let fixed = "m = 1.3\nR = 3\nc = [0.7, -0.4, 1.1]\nI = [2.6, 1.2, 1.8]\n";
    let symbolic = "m = '0.5..2'\nR = '1..3'\nc = 'vector(-0.5..0.5)'\nI = 'inertia(0.5..5)'\n";
    for (name, parameters) in [("fixed parameters", fixed), ("symbolic parameters", symbolic)] {
        let case = case(parameters);
        let level = LevelSubset::level(&case.model);
        let sampler = Sampler::new(&case, &level, 1).expect("samples");
        let (graph, values) = residual(&case);
        let outcome = prove(&sampler, &graph, &values);
        println!("{name}: {outcome:?}");
        assert!(matches!(outcome, GroupOutcome::Zero(_)), "F2 is an integral");
        let mut group = criterion.benchmark_group(name);
        group.bench_function("prove", |bench| {
            bench.iter(|| prove(black_box(&sampler), &graph, &values));
        });
        group.bench_function("record and prove", |bench| {
            bench.iter(|| {
                let (graph, values) = residual(black_box(&case));
                prove(&sampler, &graph, &values)
            });
        });
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(30).without_plots();
    targets = proofs
}
criterion_main!(benches);
