//! The command `liouville merge`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::jobs::AnyJob;
use super::styles::Styles;
use super::{CommandOutput, out};
use crate::parts::{Set, from_folder};

#[derive(Debug, Args)]
pub struct Merge {
    /// Folder of the parts
    pub folder: PathBuf,
    /// Write what the job would write in one run: a picture or data, by the extension of the file
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Options of the report, in place of those that the parts were computed with: -- --colour
    /// exponent --width 85
    #[arg(last = true, value_name = "OPTIONS")]
    pub style: Vec<String>,
}

pub fn run(options: &Merge) -> Result<CommandOutput, String> {
    let files = from_folder(&options.folder)?;
    let mut set = Set::new(&files, &options.folder.display().to_string())?;
    if let Some(path) = &options.out {
        let parts: Vec<PathBuf> =
            files.iter().map(|file| options.folder.join(&file.name)).collect();
        let parts: Vec<&Path> = parts.iter().map(PathBuf::as_path).collect();
        out::check(path, "--out", &parts)?;
    }
    let styles = Styles::of(&set.header.job);
    styles.check(&options.style)?;
    set.header.arguments = styles.applied(&set.header.arguments, &options.style);
    AnyJob::of(&set.header, options.out.as_deref())?.report(&set)
}
