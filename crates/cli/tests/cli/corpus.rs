//! Inputs that once failed: each is read and judged without a fault.

use std::path::Path;

use liouville::case::Case;
use liouville::verdict::Options;

#[test]
fn the_corpus_of_the_fuzzer_is_judged() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).expect("the corpus").flatten() {
        let text = std::fs::read_to_string(entry.path()).expect("UTF-8");
        match Case::parse(&text, &[]) {
            Ok(case) => {
                let report = liouville_search::judge(&case, &Options::default());
                assert!(report.is_ok_and(|report| !report.claims.is_empty()), "{entry:?}");
            }
            Err(error) => {
                let told = error.mistakes().iter().all(|mistake| mistake.help().is_some());
                assert!(told, "{entry:?}: {error}");
            }
        }
        count += 1;
    }
    assert!(count >= 4, "{count} files");
}
