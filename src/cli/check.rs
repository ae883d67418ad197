//! The command `liouville check`.

use std::io::IsTerminal;

use liouville::report::{diagnostic, json, terminal};
use liouville::verdict::{self, Options};

use super::files::Judge;
use super::{Answer, Check, colour, files, width};

/// Judge of cases, including the claims about motion where they are requested.
#[cfg(feature = "explore")]
fn judge(options: &Check) -> Judge {
    if options.motion { liouville::observe::judge } else { verdict::judge }
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
