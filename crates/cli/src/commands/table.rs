//! The command `liouville table`.

use crate::report::{diagnostic, table};
use liouville::case::Case;

use super::judging::{JudgingJob, judge};
use super::{CommandOutput, TableArgs, TableFormat, width};

pub fn run(options: &TableArgs) -> Result<CommandOutput, String> {
    let (sampling, number) = (&options.sampling, options.number);
    let run = judge(JudgingJob {
        paths: options.paths.clone(),
        settings: Vec::new(),
        prepare: Box::new(move |case| keep_table(case, number)),
        options: sampling.options(),
        motions: false,
        sizes: false,
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
    case.motions.clear();
    if case.column.as_ref().is_none_or(|column| column.table != number) {
        case.claims.clear();
        case.absences.clear();
    } else if case.absences.is_empty() {
        case.claims.retain(|claim| claim.cell.is_some());
    }
}
