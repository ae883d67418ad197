//! Textbook systems that were written from the documentation alone, each claim with a wrong twin.

use std::path::Path;

use crate::files::files;
use liouville::case::Case;
use liouville::verdict::Options;
use liouville_search::judge;
use rayon::prelude::*;

#[test]
#[ignore = "slow: judges 171 files; the catalogue takes the same paths"]
fn textbook_claims_are_proved_and_their_twins_refuted() {
    let paths = files(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/textbook")));
    assert_eq!(paths.len(), 171);
    let wrong = paths.par_iter().flat_map_iter(|path| {
        let name = path.display();
        let case = Case::read(path, &[]).1.unwrap_or_else(|error| panic!("{name}: {error}"));
        let report =
            judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{name}: {error}"));
        let wrong = report.claims.into_iter().filter(|claim| !claim.agrees);
        wrong
            .map(|claim| format!("{name}: {}: {}", claim.name, claim.verdict.word()))
            .collect::<Vec<_>>()
    });
    let wrong: Vec<String> = wrong.collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
