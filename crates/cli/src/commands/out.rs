//! Files that options name: checked before any work, written whole or not at all.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Checks that a file can be written, before any work: its folder is there, it is no folder, and
/// it is none of the files that are read.
pub fn check(path: &Path, option: &str, read: &[&Path]) -> Result<(), String> {
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
    match read.iter().any(|own| is_same(own, path)) {
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
            "error: the ending of {} is not known to {option}\nhelp: use .{}",
            path.display(),
            known.join(", .")
        )),
    }
}

/// Writes a file: a new one beside it takes its place when it is complete.
pub fn write(path: &Path, option: &str, bytes: impl AsRef<[u8]>) -> Result<(), String> {
    let written = match fs::metadata(path) {
        // a device or a pipe has no place that could be taken
        Ok(metadata) if !metadata.is_file() => fs::write(path, bytes.as_ref()),
        _ => replace(path, bytes.as_ref()),
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

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // a link stays, and what it points to is replaced
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let new = beside(&target);
    let filled = File::create_new(&new).and_then(|mut file| {
        file.write_all(bytes)?;
        if let Ok(metadata) = fs::metadata(&target) {
            fs::set_permissions(&new, metadata.permissions())?;
        }
        file.sync_all()
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

/// Whether two paths lead to the same file.
fn is_same(one: &Path, other: &Path) -> bool {
    let real = |path: &Path| fs::canonicalize(path).ok();
    match (real(one), real(other)) {
        (Some(one), Some(other)) => one == other || is_linked(&one, &other),
        _ => false,
    }
}

/// Whether two names stand for one file.
#[cfg(unix)]
fn is_linked(one: &Path, other: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let number = |path: &Path| fs::metadata(path).ok().map(|file| (file.dev(), file.ino()));
    number(one).is_some_and(|own| number(other) == Some(own))
}

#[cfg(not(unix))]
fn is_linked(_: &Path, _: &Path) -> bool {
    false
}
