//! Files of pictures and data that commands write, with the formats that their endings choose.

use std::path::{Path, PathBuf};

use super::out;

/// Format of a file, chosen by its ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    Svg,
    Pdf,
    Png,
    Csv,
    Npy,
    Json,
    Jsonl,
}

impl Ending {
    /// Endings of pictures.
    pub const PICTURES: &'static [Self] = &[Self::Svg, Self::Pdf, Self::Png];
    /// Endings of charts.
    pub const CHARTS: &'static [Self] = &[Self::Svg, Self::Pdf, Self::Png, Self::Csv, Self::Json];
    /// Endings of tables.
    pub const TABLES: &'static [Self] = &[Self::Json];
    /// Endings of rows.
    pub const ROWS: &'static [Self] = &[Self::Csv, Self::Json, Self::Jsonl];
    /// Endings of pictures and of data.
    pub const ALL: &'static [Self] =
        &[Self::Svg, Self::Pdf, Self::Png, Self::Csv, Self::Npy, Self::Json];

    fn name(self) -> &'static str {
        match self {
            Self::Svg => ".svg",
            Self::Pdf => ".pdf",
            Self::Png => ".png",
            Self::Csv => ".csv",
            Self::Npy => ".npy",
            Self::Json => ".json",
            Self::Jsonl => ".jsonl",
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
    /// Checks that a file may be written: its ending is one of these, and it is not an input.
    pub fn new(path: &Path, allowed: &[Ending], inputs: &[&Path]) -> Result<Self, String> {
        let shown = path.display();
        let given = path.extension().and_then(|ending| ending.to_str());
        let given = given.map(|ending| format!(".{}", ending.to_ascii_lowercase()));
        let Some(ending) = allowed.iter().find(|ending| Some(ending.name()) == given.as_deref())
        else {
            let names: Vec<&str> = allowed.iter().map(|ending| ending.name()).collect();
            let message = match &names[..] {
                [one] => format!("does not end in {one}"),
                [a, b] => format!("is neither {a} nor {b}"),
                _ => format!("is none of {}", names.join(", ")),
            };
            return Err(format!(
                "error: {shown} {message}\nhelp: the extension of --out chooses the format"
            ));
        };
        out::check(path, "--out", inputs)?;
        Ok(Self { path: path.to_path_buf(), ending: *ending })
    }
}
