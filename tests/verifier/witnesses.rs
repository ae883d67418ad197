//! Witnesses of the catalogue: at each state, typed in again, the residual's enclosure excludes 0
//! and meets the reported one.

use std::path::{Path, PathBuf};

use liouville::case::{Case, Setting, is_case_file};
use liouville::verdict::{
    ClaimReport, Method, Options, Verdict, Witness, evaluate, judge, read_state,
};

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("the catalogue is a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            files(&path, found);
        } else if is_case_file(&path) {
            found.push(path);
        }
    }
}

/// Finds the component of a claim's residual at its witness that is nearest to the reported value:
/// midpoint and error bound.
fn again(path: &Path, claim: &str, witness: &Witness) -> Option<(f64, f64)> {
    let setting =
        |(name, value): (&String, &String)| Setting { name: name.clone(), value: value.clone() };
    let settings: Vec<Setting> = witness.parameters.iter().map(setting).collect();
    let case = Case::read(path, &settings).1.expect("the witness's parameters are accepted");
    let state = read_state(&case, &witness.state).expect("and so is its state");
    let point = evaluate(&case, Some(&state), 1, 0).expect("it can be evaluated");
    let (_, _, residual) = point.claims.iter().find(|(name, _, _)| name == claim)?;
    let apart = |value: &(f64, f64)| (value.0 - witness.residual).abs();
    residual.iter().flatten().copied().min_by(|a, b| apart(a).total_cmp(&apart(b)))
}

#[test]
fn all_witnesses_are_reproduced() {
    let mut paths = Vec::new();
    files(Path::new("cases"), &mut paths);
    let mut reproduced = 0;
    for path in paths {
        let case = Case::read(&path, &[]).1.expect("a case");
        let report = judge(&case, &Options::default()).expect("it can be judged");
        // Dependent functions, and residuals that are constant, are refuted without a state.
        let refuted = |claim: &&ClaimReport| {
            let by_a_state =
                claim.kind != "independent" && claim.evidence.method != Method::Folding;
            claim.verdict == Verdict::Refuted && by_a_state
        };
        for claim in report.claims.iter().filter(refuted) {
            let place = format!("{} :: {}", path.display(), claim.name);
            let witness = claim.evidence.witness.as_ref();
            let witness = witness.unwrap_or_else(|| panic!("{place} has no witness"));
            let (residual, bound) = again(&path, &claim.name, witness)
                .unwrap_or_else(|| panic!("{place} is undefined at its witness"));
            assert!(residual.abs() > bound, "{place}: {residual:e} ± {bound:e} does not refute");
            let apart = (residual - witness.residual).abs();
            assert!(
                apart <= bound + witness.error_bound,
                "{place}: {residual:e} against {:e}",
                witness.residual
            );
            reproduced += 1;
        }
    }
    assert!(reproduced > 200, "only {reproduced} witnesses");
}
