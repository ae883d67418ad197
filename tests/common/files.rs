//! Files of the catalogue.

use std::path::{Path, PathBuf};

use liouville::case::is_case_file;

/// Returns the case files of a folder and of those inside it, in order.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the catalogue is a folder");
    let mut entries: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    entries.sort();
    let mut found = Vec::new();
    for entry in entries {
        if entry.is_dir() {
            found.extend(files(&entry));
        } else if is_case_file(&entry) {
            found.push(entry);
        }
    }
    found
}
