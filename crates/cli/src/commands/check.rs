//! The command `liouville check`.

use std::io::IsTerminal;

use liouville::case::Case;
use liouville::verdict::Options;
use liouville::verdict::{CaseReport, JudgeError};
use liouville_cli::report::{diagnostic, json, terminal};

use super::files::Judge;
use super::{Answer, Check, colour, files, width};

/// Judge of cases, including the claims of absence, and those about motion where requested.
fn judge(options: &Check) -> Judge {
    if options.motion { with_motions } else { liouville_search::judge }
}

fn with_motions(case: &Case, options: &Options) -> Result<CaseReport, JudgeError> {
    let mut report = liouville_search::judge(case, options)?;
    report.claims.extend(liouville_flow::observe::observe(case, options));
    report.motions_left = 0;
    Ok(report)
}

pub fn run(options: &Check) -> Result<Answer, String> {
    let run = files::judge(
        &options.paths,
        &Options { mutants: options.mutants, ..options.sampling.options() },
        judge(options),
        options.sampling.threads,
    )?;
    let text = if options.json {
        json::render(&run).map_err(|error| format!("error: {error}"))? + "\n"
    } else {
        let style = terminal::Style {
            verbose: options.verbose,
            colour: colour(std::io::stdout().is_terminal()),
            width: width(),
        };
        terminal::render(&run, style)
    };
    if options.json {
        for outcome in &run.outcomes {
            if let Err(failures) = &outcome.result {
                anstream::eprintln!("{}", diagnostic::rendered(failures));
            }
        }
    }
    Ok(Answer { text, code: run.exit_code() })
}
