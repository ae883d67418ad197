//! The work items W1, W2, W3 of `liouville measure bench`, by each method in each domain, and beside
//! heyoka where Python has it. Times are per 64 states; only ratios within one run are significant.

#[path = "peers/hook.rs"]
mod peers;

use criterion::{Criterion, criterion_group, criterion_main};
use liouville::verdict::{Options, judge};
use liouville_lab::bench::{
    BenchClaim, BenchOptions as Amount, Selection, measure_item, record_residual, work_items,
};

fn tapes(criterion: &mut Criterion) {
    for item in work_items().expect("the work items are cases") {
        let claim = &item.case.claims[0];
        let subject = BenchClaim::new(&item, claim, 1, 1).expect("it records, and has states");
        let mut group = criterion.benchmark_group(&item.name);
        println!("{}: {} operations per state", item.name, subject.residual().operations());
        let measured = measure_item(&item, &Amount::default(), &|_| ()).expect("it is measured");
        if let [Some(ratio)] =
            measured.iter().map(|m| m.ratio_to_num_dual("f64")).collect::<Vec<_>>()[..]
        {
            println!("{}: merged tape / num-dual by hand: {ratio:.4}", item.name);
        }
        for mut entry in subject.entries(Selection::All) {
            let name = format!("{}, {}", entry.method.name(), entry.domain);
            group.bench_function(name, |bench| bench.iter(|| entry.candidate.run(0)));
        }
        group.bench_function("record and lay out", |bench| {
            bench.iter(|| record_residual(&item.case, claim).expect("records").0.operations());
        });
        group.bench_function("judge, 256 states", |bench| {
            bench.iter(|| judge(&item.case, &Options::default()).expect("judged"));
        });
        group.finish();
    }
    peers::print("items.py");
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).without_plots();
    targets = tapes
}
criterion_main!(benches);
