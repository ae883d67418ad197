//! The command `liouville cases`: the catalogue inside the program.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use super::{CommandOutput, write_new};
use liouville_catalogue::{CATALOGUE, inside, title};

#[derive(Debug, Args)]
pub struct Cases {
    #[command(subcommand)]
    pub action: Action,
}

#[derive(Debug, Subcommand)]
pub enum Action {
    /// List the cases whose path or title contains all of the words
    #[command(after_help = "Example:\n  liouville cases list kovalevskaya")]
    List {
        /// Words to look for, in upper or lower case
        words: Vec<String>,
    },
    /// Print a case
    #[command(after_help = "Example:\n  liouville cases show plane/balanced-ball > ball.toml")]
    Show {
        /// Case, such as plane/balanced-ball
        name: PathBuf,
    },
    /// Write cases to a folder, to change them
    #[command(after_help = "Example:\n  liouville cases copy classical/tops tops")]
    Copy {
        /// Case or folder of the catalogue, such as plane/balanced-ball or plane
        name: PathBuf,
        /// Folder to write to
        #[arg(default_value = ".", conflicts_with = "out")]
        folder: PathBuf,
        /// Folder to write to; the same as [FOLDER]
        #[arg(long, value_name = "FOLDER")]
        out: Option<PathBuf>,
    },
}

pub fn run(options: &Cases) -> Result<CommandOutput, String> {
    let text = match &options.action {
        Action::List { words } => list(words)?,
        Action::Show { name } => match found(name)?.as_slice() {
            [(_, text)] => text.to_string(),
            several => several.iter().map(|(name, _)| format!("{name}\n")).collect(),
        },
        Action::Copy { name, folder, out } => copy(name, out.as_ref().unwrap_or(folder))?,
    };
    Ok(CommandOutput { text, code: 0 })
}

fn list(words: &[String]) -> Result<String, String> {
    let words: Vec<String> = words.iter().map(|word| word.to_lowercase()).collect();
    let mut out = String::new();
    for (name, text) in CATALOGUE {
        let title = title(text);
        let searched = format!("{name} {title}").to_lowercase();
        if words.iter().all(|word| searched.contains(word)) {
            let short = name.trim_start_matches("cases/").trim_end_matches(".toml");
            // a `String` takes all that is written to it
            _ = writeln!(out, "{short:<52} {title}");
        }
    }
    match out.is_empty() {
        true => Err(format!(
            "error: no case contains {}\nhelp: `liouville cases list` lists all of them",
            words.join(" and ")
        )),
        false => Ok(out),
    }
}

fn found(name: &Path) -> Result<Vec<(&'static str, &'static str)>, String> {
    match inside(name) {
        none if none.is_empty() => Err(format!(
            "error: the catalogue has no case {}\nhelp: `liouville cases list WORD` lists the cases \
             whose path or title contains a word",
            name.display()
        )),
        found => Ok(found),
    }
}

fn copy(name: &Path, folder: &Path) -> Result<String, String> {
    let mut out = String::new();
    for (name, text) in found(name)? {
        let file = folder.join(name.trim_start_matches("cases/"));
        if let Some(parent) = file.parent() {
            std::fs::create_dir_all(parent)
                .map_err(|error| format!("error: cannot make {}: {error}", parent.display()))?;
        }
        write_new(&file, text)?;
        _ = writeln!(out, "{}", file.display());
    }
    Ok(out)
}
