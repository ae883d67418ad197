//! The command `liouville table`.

use liouville_cli::report::{diagnostic, table};
use liouville_search::judge;

use super::{Answer, Table, TableFormat, files, width};

pub fn run(options: &Table) -> Result<Answer, String> {
    let sampling = &options.sampling;
    let run =
        files::judge(&options.paths, &[], &|_| {}, &sampling.options(), judge, sampling.threads)?;
    for outcome in &run.outcomes {
        if let Err(failures) = &outcome.result {
            anstream::eprintln!("{}", diagnostic::rendered(failures));
        }
    }
    let table = table::regenerate(&run, options.number);
    if table.is_empty() {
        return Err(format!("error: no case belongs to table {}", options.number));
    }
    let text = if options.json {
        table.json().map_err(|error| format!("error: {error}"))? + "\n"
    } else {
        match options.format {
            TableFormat::Text => table.text(width()),
            TableFormat::Markdown => table.markdown(),
            TableFormat::Latex => table.latex(),
        }
    };
    Ok(Answer { text, code: run.exit_code() })
}
