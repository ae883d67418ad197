//! The command `liouville table`.

use crate::report::{diagnostic, table};

use super::judging::{Work, judge};
use super::{Answer, Table, TableFormat, width};

pub fn run(options: &Table) -> Result<Answer, String> {
    let sampling = &options.sampling;
    let run = judge(Work {
        paths: options.paths.clone(),
        settings: Vec::new(),
        prepare: Box::new(|_| {}),
        options: sampling.options(),
        motions: false,
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
        }
    };
    Ok(Answer { text, code: run.exit_code() })
}
