//! Progress of motions: shares that add up to one for each.

use std::sync::Mutex;

use liouville::number::rational::Rational;
use liouville_flow::{
    Columns, Lexicon, Precision, Sampling, Start, Variational, orbits, section, spectra,
};

use crate::integration::catalogue;

/// Shares told by a run, checked to be positive.
fn told(run: impl FnOnce(&(dyn Fn(f64) + Sync))) -> Vec<f64> {
    let told = Mutex::new(Vec::new());
    run(&|share| told.lock().expect("no panic").push(share));
    let told = told.into_inner().expect("no panic");
    assert!(told.iter().all(|share| *share > 0.0 && *share <= 1.0), "{told:?}");
    told
}

fn assert_sum(shares: &[f64], count: usize, what: &str) {
    let sum: f64 = shares.iter().sum();
    assert!((sum - count as f64).abs() < 1e-9, "{what}: {sum} of {count}");
    assert!(shares.len() > 4 * count, "{what}: {} shares of {count} motions", shares.len());
}

#[test]
fn shares_of_motions_add_up_to_their_number() {
    let case = catalogue("figures/fig-8.toml");
    let start = |index| Start::new(&case, None, 1, index);
    let starts: Vec<_> = (0..9).map(start).collect();
    assert!(starts.iter().all(Result::is_ok), "all start");
    let motions = Variational::all(&case.model, &[], &starts).expect("equations");
    for time in [30.0, -30.0] {
        let shares = told(|progress| {
            motions.all_exponents(time, 2, progress);
        });
        assert_sum(&shares, 9, "exponents");
    }
    let shares = told(|progress| {
        spectra(&case.model, &starts[..2], 30.0, 2, progress).expect("spectra");
    });
    assert_sum(&shares, 2, "spectra");
    let columns = Columns::read(Lexicon::new(&case), "t").expect("columns");
    let sampling = Sampling { columns: &columns, every: Rational::from(1), with_steps: false };
    for precision in [Precision::Float, Precision::Pair] {
        let followed = (&Rational::from(-20), precision);
        let shares = told(|progress| {
            orbits(&case, &starts[..3], followed, Some(&sampling), 2, progress);
        });
        assert_sum(&shares, 3, "orbits");
    }
    let plan = case.section.as_ref().expect("a section");
    let choice = liouville_flow::SectionChoice {
        crossings: Some(20),
        skip: Some(5),
        ..liouville_flow::SectionChoice::default()
    };
    let request = choice.request(&case).expect("a request");
    let shares = told(|progress| {
        section(&case, &request, 2, progress).expect("a section");
    });
    assert_sum(&shares, plan.starts.len(), "a section");
}
