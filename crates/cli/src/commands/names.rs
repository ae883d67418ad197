//! The command `liouville names`: the names that formulas of a case may use.

use std::path::PathBuf;

use crate::report::names;
use clap::Args;

use super::Answer;
use super::eval::open;

#[derive(Debug, Args)]
pub struct Names {
    /// Case file; claims are not needed
    pub case: PathBuf,
}

pub fn run(options: &Names) -> Result<Answer, String> {
    let case = open(&options.case, &[])?;
    Ok(Answer { text: names::text(&case), code: 0 })
}
