//! The command `liouville check`.

use std::io::IsTerminal;

#[cfg(feature = "explore")]
use liouville::case::Case;
use liouville::report::{diagnostic, json, terminal};
#[cfg(not(feature = "explore"))]
use liouville::verdict;
use liouville::verdict::Options;
#[cfg(feature = "explore")]
use liouville::verdict::{CaseReport, JudgeError};

use super::files::Judge;
use super::{Answer, Check, colour, files, width};

/// Judge of cases, including the claims of absence, and those about motion where requested.
#[cfg(feature = "explore")]
fn judge(options: &Check) -> Judge {
    if options.motion { with_motions } else { liouville::search::judge }
}

#[cfg(feature = "explore")]
fn with_motions(case: &Case, options: &Options) -> Result<CaseReport, JudgeError> {
    let mut report = liouville::search::judge(case, options)?;
    report.claims.extend(liouville::observe::observe(case, options));
    report.motions_left = 0;
    Ok(report)
}

#[cfg(not(feature = "explore"))]
fn judge(_: &Check) -> Judge {
    verdict::judge
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
