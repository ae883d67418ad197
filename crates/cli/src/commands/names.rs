//! The command `liouville names`: the names that formulas of a case may use.

use std::path::PathBuf;

use crate::report::names;
use clap::Args;

use super::CommandOutput;
use super::eval::open;

#[derive(Debug, Args)]
pub struct NamesArgs {
    /// Case file; claims are not needed
    pub case: PathBuf,
}

pub fn run(options: &NamesArgs) -> Result<CommandOutput, String> {
    let case = open(&options.case, &[])?;
    Ok(CommandOutput { text: names::text(&case), code: 0 })
}
