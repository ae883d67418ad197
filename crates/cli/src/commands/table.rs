//! The command `liouville table`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::report::{diagnostic, table};
use liouville::case::Case;

use super::judging::{JudgingJob, judge};
use super::{CommandOutput, LimitArgs, SamplingArgs, width};

#[derive(Debug, Args)]
pub struct TableArgs {
    /// Number of the table: 1 for the plane, 2 for the sphere, 3 for a ball on a surface, 4 for
    /// rolling with and without spin
    #[arg(value_parser = parse_table)]
    pub number: u32,
    /// Case files, or folders of them
    #[arg(default_value = "cases")]
    pub paths: Vec<PathBuf>,
    /// Print JSON
    #[arg(long, conflicts_with = "format")]
    pub json: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t = TableFormat::Text)]
    pub format: TableFormat,
    #[command(flatten)]
    pub limits: LimitArgs,
    #[command(flatten)]
    pub sampling: SamplingArgs,
}

fn parse_table(text: &str) -> Result<u32, String> {
    let number = text.parse().ok().filter(|number| (1..=4).contains(number));
    number.ok_or("write 1, 2, 3 or 4".to_string())
}

/// Format of a table.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum TableFormat {
    /// Text for a terminal
    Text,
    /// Markdown
    Markdown,
    /// A LaTeX document, for any LaTeX
    Latex,
    /// A web page
    Html,
}

pub fn run(options: &TableArgs) -> Result<CommandOutput, String> {
    let (sampling, number) = (&options.sampling, options.number);
    let run = judge(JudgingJob {
        paths: options.paths.clone(),
        settings: Vec::new(),
        prepare: Box::new(move |case| keep_table(case, number)),
        options: sampling.options(),
        motions: false,
        sizes: false,
        statements: false,
        threads: sampling.threads,
        limits: options.limits,
    })?;
    for outcome in &run.outcomes {
        if let Err(failures) = &outcome.result {
            anstream::eprintln!("{}", diagnostic::rendered(failures));
        }
    }
    let table = table::regenerate(&run, options.number);
    if table.is_empty() {
        return Err(format!(
            "error: no case belongs to table {}\n\
             help: a case names its column by table = {{ number = {0}, column = 1 }}",
            options.number
        ));
    }
    let text = if options.json {
        table.json().map_err(|error| format!("error: {error}"))? + "\n"
    } else {
        match options.format {
            TableFormat::Text => table.text(width()),
            TableFormat::Markdown => table.markdown(),
            TableFormat::Latex => table.latex(),
            TableFormat::Html => table.html(),
        }
    };
    Ok(CommandOutput { text, code: run.exit_code() })
}

/// Keeps the claims that a table needs: those in its cells, and all of a case with claims of
/// absence, which count what the others state.
fn keep_table(case: &mut Case, number: u32) {
    let has_absences = case.homes().any(|own| !own.absences.is_empty());
    case.change_claims(&|case| {
        case.motions.clear();
        if case.column.as_ref().is_none_or(|column| column.table != number) {
            case.claims.clear();
            case.absences.clear();
        } else if !has_absences {
            case.claims.retain(|claim| claim.cell.is_some());
        }
    });
}
