//! The command `liouville merge`.

use std::path::PathBuf;

use clap::Args;

use super::CommandOutput;
use super::jobs::AnyJob;
use crate::parts::{Set, from_folder};

#[derive(Debug, Args)]
pub struct Merge {
    /// Folder of the parts
    pub folder: PathBuf,
    /// Write what the job would write in one run: a picture or data, by the ending of the file
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Options of the picture, in place of those that the parts were computed with: -- --colour
    /// exponent --width 85
    #[arg(last = true, value_name = "OPTIONS")]
    pub style: Vec<String>,
}

/// Options of a job that change its report alone.
const STYLES: [&str; 15] = [
    "--colour",
    "--width",
    "--height",
    "--dpi",
    "--point-size",
    "--opacity",
    "--title",
    "--caption",
    "--dark",
    "--shade",
    "--no-marks",
    "--json",
    "--format",
    "--quiet",
    "--lines",
];

pub fn run(options: &Merge) -> Result<CommandOutput, String> {
    let files = from_folder(&options.folder)?;
    let mut set = Set::new(&files, &options.folder.display().to_string())?;
    let is_style = |word: &&String| {
        let name = word.split('=').next().unwrap_or_default();
        !word.starts_with("--") || STYLES.contains(&name)
    };
    if let Some(word) = options.style.iter().find(|word| !is_style(word)) {
        return Err(format!(
            "error: {word} is no option of the report\nhelp: after -- write any of {}",
            STYLES.join(", ")
        ));
    }
    set.header.arguments.extend(options.style.iter().cloned());
    AnyJob::of(&set.header, options.out.as_deref())?.report(&set)
}
