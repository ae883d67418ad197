//! The commands `liouville completions` and `liouville man`.

use std::path::PathBuf;

use clap::Args;
use clap_complete::Shell;

use super::{Arguments, CommandOutput};

#[derive(Debug, Args)]
pub struct Completions {
    /// Shell to complete commands in
    #[arg(value_enum)]
    pub shell: Shell,
}

#[derive(Debug, Args)]
pub struct Man {
    /// Folder to write the pages to
    #[arg(required_unless_present = "out", conflicts_with = "out")]
    pub folder: Option<PathBuf>,
    /// Folder to write to; the same as [FOLDER]
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
}

/// Name of the program.
const PROGRAM: &str = "liouville";

pub fn completions(options: &Completions) -> Result<CommandOutput, String> {
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut Arguments::described(), PROGRAM, &mut script);
    Ok(CommandOutput { text: String::from_utf8_lossy(&script).into_owned(), code: 0 })
}

pub fn man(options: &Man) -> Result<CommandOutput, String> {
    let given = options.out.as_ref().or(options.folder.as_ref());
    let path = given.ok_or("error: no folder is given\nhelp: add --out FOLDER")?;
    let folder = path.display();
    std::fs::create_dir_all(path)
        .and_then(|()| clap_mangen::generate_to(Arguments::described(), path))
        .map_err(|error| format!("error: cannot write to {folder}: {error}"))?;
    Ok(CommandOutput { text: format!("{folder}\nnext: man -l {folder}/{PROGRAM}.1\n"), code: 0 })
}
