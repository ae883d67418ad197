//! Case files of paths: collected in order, with the problems of those that cannot be read.

use std::io::{ErrorKind, IsTerminal};
use std::path::{Path, PathBuf};

use crate::report::{FileFailure, diagnostic};

use super::source;

pub(super) type Found = Result<PathBuf, (PathBuf, FileFailure)>;

/// Collects all case files under the paths, sorted within each folder; unreadable entries are kept
/// as failures.
pub(super) fn collect(paths: &[PathBuf]) -> Vec<Found> {
    let mut files = Vec::new();
    for path in paths {
        match std::fs::metadata(path) {
            Ok(metadata) if metadata.is_dir() => {
                let before = files.len();
                folder(path, &mut files);
                if files.len() == before {
                    let help = "a case file ends in .toml";
                    files.push(Err((
                        path.clone(),
                        plain(path, "no case file in this folder", help),
                    )));
                }
            }
            Ok(_) => files.push(Ok(path.clone())),
            Err(_) if source::is_standard_input(path) => files.push(Ok(path.clone())),
            Err(_) if !liouville_catalogue::inside(path).is_empty() => {
                for (name, _) in liouville_catalogue::inside(path) {
                    files.push(Ok(name.into()));
                }
            }
            Err(error) => {
                let message = format!("cannot read {}: {error}", path.display());
                let otherwise =
                    "give case files, folders of them, or cases of `liouville cases list`";
                let help = match error.kind() {
                    ErrorKind::NotFound => source::no_file(path, otherwise),
                    _ => otherwise.to_string(),
                };
                files.push(Err((path.clone(), plain(path, &message, &help))));
            }
        }
    }
    files
}

fn folder(path: &Path, files: &mut Vec<Found>) {
    let entries = match std::fs::read_dir(path) {
        Ok(entries) => entries,
        Err(error) => {
            let message = format!("cannot read the folder: {error}");
            files.push(Err((path.to_path_buf(), plain(path, &message, "check its permissions"))));
            return;
        }
    };
    let mut inside: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    inside.sort();
    for entry in inside {
        // Links are not followed: a folder may contain itself.
        let kind = std::fs::symlink_metadata(&entry).map(|metadata| metadata.file_type());
        if kind.as_ref().is_ok_and(|kind| kind.is_dir()) {
            folder(&entry, files);
        } else if liouville::case::is_case_file(&entry) {
            files.push(Ok(entry));
        }
    }
}

pub(super) fn plain(path: &Path, message: &str, help: &str) -> FileFailure {
    diagnostic::of_file(&path.display().to_string(), message, help, coloured())
}

pub(super) fn coloured() -> bool {
    super::colour(std::io::stderr().is_terminal())
}
