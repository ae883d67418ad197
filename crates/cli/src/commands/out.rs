//! Files that options name: checked before any work, written whole or not at all.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Files that a command reads, found by any of their names.
#[derive(Debug, Default)]
pub struct ReadFiles {
    paths: BTreeSet<PathBuf>,
    numbers: BTreeSet<(u64, u64)>,
}

impl ReadFiles {
    /// Looks up the files.
    pub fn new(read: &[&Path]) -> Self {
        let paths: BTreeSet<_> = read.iter().flat_map(fs::canonicalize).collect();
        let numbers = paths.iter().filter_map(|path| number(path)).collect();
        Self { paths, numbers }
    }

    /// Whether a path leads to one of them.
    fn contains(&self, path: &Path) -> bool {
        fs::canonicalize(path).is_ok_and(|real| {
            self.paths.contains(&real)
                || number(&real).is_some_and(|own| self.numbers.contains(&own))
        })
    }
}

/// Checks that a file can be written, before any work: its folder is there, it is no folder, and
/// it is none of the files that are read.
pub fn check(path: &Path, option: &str, read: &[&Path]) -> Result<(), String> {
    check_one(path, option, &ReadFiles::new(read))
}

/// Checks one of many files that a command writes, as `check`.
pub fn check_one(path: &Path, option: &str, read: &ReadFiles) -> Result<(), String> {
    let shown = path.display();
    if path.is_dir() {
        return Err(format!("error: {shown} is a folder\nhelp: give {option} a file in it"));
    }
    if !folder(path).is_dir() {
        return Err(format!(
            "error: the folder of {shown} does not exist\n\
             help: give {option} a file in a folder that exists"
        ));
    }
    match read.contains(path) {
        true => Err(format!(
            "error: {shown} is a file that the command reads\nhelp: give {option} another file, or it would be lost"
        )),
        false => Ok(()),
    }
}

/// Checks the ending of a file against those that are known.
pub fn check_ending(path: &Path, option: &str, known: &[&str]) -> Result<(), String> {
    let ending = path.extension().and_then(|ending| ending.to_str());
    match ending.is_some_and(|ending| known.contains(&ending)) {
        true => Ok(()),
        false => Err(format!(
            "error: {option}: the format of {} is unknown\nhelp: use .{}",
            path.display(),
            known.join(", .")
        )),
    }
}

/// Writes a file: a new one beside it takes its place when it is complete.
pub fn write(path: &Path, option: &str, bytes: impl AsRef<[u8]>) -> Result<(), String> {
    write_to(path, option, bytes.as_ref(), File::sync_all)
}

/// Writes one of many files, as `write`, without a wait for the disk: it takes longer than the work
/// on a small file, which can be done again.
pub fn write_one(path: &Path, option: &str, bytes: impl AsRef<[u8]>) -> Result<(), String> {
    write_to(path, option, bytes.as_ref(), |_| Ok(()))
}

fn write_to(
    path: &Path,
    option: &str,
    bytes: &[u8],
    finish: fn(&File) -> io::Result<()>,
) -> Result<(), String> {
    let written = match fs::metadata(path) {
        // a device or a pipe has no place that could be taken
        Ok(metadata) if !metadata.is_file() => fs::write(path, bytes),
        _ => replace(path, bytes, finish),
    };
    written.map_err(|error| {
        let shown = path.display();
        let help = match error.kind() {
            io::ErrorKind::StorageFull => "make room on the disk".to_string(),
            io::ErrorKind::PermissionDenied => format!("give {option} a file that you may write"),
            _ => format!("give {option} a file in a folder that exists"),
        };
        format!("error: cannot write {shown}: {error}\nhelp: {help}")
    })
}

fn replace(path: &Path, bytes: &[u8], finish: fn(&File) -> io::Result<()>) -> io::Result<()> {
    // a link stays, and what it points to is replaced
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let new = beside(&target);
    let filled = File::create_new(&new).and_then(|mut file| {
        file.write_all(bytes)?;
        if let Ok(metadata) = fs::metadata(&target) {
            fs::set_permissions(&new, metadata.permissions())?;
        }
        finish(&file)
    });
    let done = filled.and_then(|()| fs::rename(&new, &target));
    if done.is_err() {
        // the error is told already
        _ = fs::remove_file(&new);
    }
    done
}

/// Name of the file that is written first.
fn beside(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    folder(path).join(format!(".{name}.{}.new", std::process::id()))
}

fn folder(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

/// Number that all names of a file share.
#[cfg(unix)]
fn number(path: &Path) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    fs::metadata(path).ok().map(|file| (file.dev(), file.ino()))
}

#[cfg(not(unix))]
fn number(_: &Path) -> Option<(u64, u64)> {
    None
}
