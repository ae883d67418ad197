//! Tables of bodies: one case, judged or reported on once for each row of parameter values.

mod job;
mod table;

use std::path::PathBuf;

use clap::Args;
use liouville_catalogue::inside;

use super::explore::share::{Share, Target, carry_out};
use super::{CheckArgs, CheckFormat, CommandOutput, eval};
use crate::commands::explore::motion::Threads;
use crate::commands::explore::report::{ReportArgs, ReportFormat};

pub use job::BodiesJob;

/// Table of the bodies.
#[derive(Clone, Debug, Default, Args)]
pub struct BodiesArgs {
    /// Take one body from each row of this table; its first line names parameters as --set does
    #[arg(long = "settings", id = "bodies_table", value_name = "FILE.csv")]
    pub settings: Option<PathBuf>,
    /// Text of that file, if it is at hand.
    #[arg(skip)]
    pub text: Option<String>,
}

/// Format of the rows on standard output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowFormat {
    /// Table for a terminal.
    Text,
    /// Counts alone.
    Summary,
    /// Row of CSV for each body.
    Csv,
    /// One document.
    Json,
    /// Line of JSON for each body.
    JsonLines,
}

impl RowFormat {
    /// Format that `check` is asked for.
    pub fn of_check(options: &CheckArgs) -> Result<Self, String> {
        let Some(format) = (!options.json).then_some(options.format) else {
            return Ok(Self::Json);
        };
        match format {
            CheckFormat::Text if options.quiet => Ok(Self::Summary),
            CheckFormat::Text => Ok(Self::Text),
            CheckFormat::Json => Ok(Self::Json),
            CheckFormat::Jsonl => Ok(Self::JsonLines),
            CheckFormat::Csv => Ok(Self::Csv),
            CheckFormat::Github => Err(wrong_format("github")),
            CheckFormat::Junit => Err(wrong_format("junit")),
            CheckFormat::Latex => Err(wrong_format("latex")),
            CheckFormat::Markdown => Err(wrong_format("markdown")),
            CheckFormat::Html => Err(wrong_format("html")),
        }
    }

    /// Format that `report` is asked for.
    pub fn of_report(options: &ReportArgs) -> Result<Self, String> {
        match options.format {
            _ if options.json => Ok(Self::Json),
            None | Some(ReportFormat::Text) => Ok(Self::Text),
            Some(ReportFormat::Csv) => Ok(Self::Csv),
            Some(ReportFormat::Jsonl) => Ok(Self::JsonLines),
            Some(ReportFormat::Markdown) => Err(wrong_format("markdown")),
            Some(ReportFormat::Latex) => Err(wrong_format("latex")),
            Some(ReportFormat::Html) => Err(wrong_format("html")),
        }
    }
}

fn wrong_format(name: &str) -> String {
    format!(
        "error: {name} is no format of a table of bodies\n\
         help: write --format text, csv or jsonl, or --json"
    )
}

/// Refuses what belongs to tables of bodies where there is none.
pub fn refuse(share: &Share, format: Option<&str>) -> Result<(), String> {
    let what = match (share.part, format) {
        (Some(_), _) => "--part".to_string(),
        (None, Some(format)) => format!("--format {format}"),
        (None, None) => return Ok(()),
    };
    Err(format!(
        "error: {what} is for a table of bodies\n\
         help: give the table with --settings bodies.csv, a line of names and a row for each body"
    ))
}

/// Judges a case for each row of a table.
pub fn check(options: &CheckArgs) -> Result<CommandOutput, String> {
    let [path] = &options.paths[..] else {
        return Err("error: --settings is for one case\nhelp: give one file".to_string());
    };
    if path.is_dir() || (!path.exists() && inside(path).len() > 1) {
        let shown = path.display();
        return Err(format!(
            "error: --settings is for one case, and {shown} is a folder of them\nhelp: give one file"
        ));
    }
    let opened = eval::open_text(path, &options.settings)?;
    let job = BodiesJob::of_check(options, opened)?;
    let threads = Threads { threads: options.sampling.threads }.count();
    carry_out(&job, &options.share, Target { out: options.out.as_deref(), threads })
}

/// Reports on a case for each row of a table.
pub fn report(options: &ReportArgs) -> Result<CommandOutput, String> {
    let opened = eval::open_text(&options.case, &options.settings)?;
    let job = BodiesJob::of_report(options, opened)?;
    let threads = Threads { threads: options.sampling.threads }.count();
    carry_out(&job, &options.share, Target { out: options.out.as_deref(), threads })
}
