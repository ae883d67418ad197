//! Files that commands write: endings known before any work, inputs never overwritten, and no file
//! that is half written.

use std::io::Write;
use std::path::{Path, PathBuf};

/// Format of a file, chosen by its ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    Svg,
    Png,
    Csv,
    Npy,
    Json,
}

impl Ending {
    /// Endings of pictures.
    pub const PICTURES: &'static [Self] = &[Self::Svg, Self::Png];
    /// Endings of pictures and of data.
    pub const ALL: &'static [Self] = &[Self::Svg, Self::Png, Self::Csv, Self::Npy, Self::Json];

    fn name(self) -> &'static str {
        match self {
            Self::Svg => ".svg",
            Self::Png => ".png",
            Self::Csv => ".csv",
            Self::Npy => ".npy",
            Self::Json => ".json",
        }
    }

    /// Whether the file is a picture.
    pub fn is_picture(self) -> bool {
        Self::PICTURES.contains(&self)
    }
}

/// File to write, with its format.
#[derive(Clone, Debug)]
pub struct Output {
    pub path: PathBuf,
    pub ending: Ending,
}

impl Output {
    /// Checks that a file may be written: its ending is one of these, and it is none of the inputs.
    pub fn new(path: &Path, allowed: &[Ending], inputs: &[&Path]) -> Result<Self, String> {
        let shown = path.display();
        let given = path.extension().and_then(|ending| ending.to_str());
        let given = given.map(|ending| format!(".{}", ending.to_ascii_lowercase()));
        let Some(ending) = allowed.iter().find(|ending| Some(ending.name()) == given.as_deref())
        else {
            let names: Vec<&str> = allowed.iter().map(|ending| ending.name()).collect();
            let message = match &names[..] {
                [a, b] => format!("is neither {a} nor {b}"),
                _ => format!("is none of {}", names.join(", ")),
            };
            return Err(format!(
                "error: {shown} {message}\nhelp: the ending of --out chooses the format"
            ));
        };
        let real = |path: &Path| std::fs::canonicalize(path).ok();
        if inputs.iter().any(|input| real(input).is_some_and(|input| real(path) == Some(input))) {
            return Err(format!(
                "error: --out {shown} is a file that the command reads\nhelp: give another name"
            ));
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        if folder.is_some_and(|folder| !folder.is_dir()) || path.is_dir() {
            return Err(unwritable(path, "--out", "there is no such folder, or it is one itself"));
        }
        Ok(Self { path: path.to_path_buf(), ending: *ending })
    }
}

fn unwritable(path: &Path, option: &str, reason: impl std::fmt::Display) -> String {
    format!(
        "error: cannot write {}: {reason}\nhelp: give {option} a file in a folder that exists",
        path.display()
    )
}

/// Writes a file requested by an option: first to a temporary one beside it, which then takes its
/// name.
pub fn write(path: &Path, option: &str, bytes: impl AsRef<[u8]>) -> Result<(), String> {
    let told = |error: std::io::Error| unwritable(path, option, error);
    // What a link points to is replaced, not the link.
    let real = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    // Devices and pipes are written to directly.
    if std::fs::metadata(&real).is_ok_and(|metadata| !metadata.is_file()) {
        return std::fs::write(&real, bytes).map_err(told);
    }
    let mut name = std::ffi::OsString::from(".");
    name.push(real.file_name().unwrap_or_default());
    name.push(format!(".{}.part", std::process::id()));
    let part = real.with_file_name(name);
    let written = std::fs::File::create(&part).and_then(|mut file| {
        file.write_all(bytes.as_ref())?;
        file.sync_all()
    });
    written.and_then(|()| std::fs::rename(&part, &real)).map_err(|error| {
        let _ = std::fs::remove_file(&part);
        told(error)
    })
}
