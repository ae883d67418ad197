//! `liouville report`

use std::io::IsTerminal;

use indicatif::ProgressBar;
use liouville::report::diagnostic;
use liouville::survey;

use super::eval::open;
use super::{Answer, Report, colour};

pub fn run(options: &Report) -> Result<Answer, String> {
    let case = open(&options.case, &options.settings)?;
    let spinner = match std::io::stderr().is_terminal() {
        true => ProgressBar::new_spinner(),
        false => ProgressBar::hidden(),
    };
    let mut progress = |what: &str| {
        spinner.set_message(what.to_string());
        spinner.tick();
    };
    let found = survey::survey(&case, &options.sampling.options(), &mut progress);
    spinner.finish_and_clear();
    let found = found.map_err(|error| {
        let shown = options.case.display().to_string();
        let coloured = colour(std::io::stderr().is_terminal());
        diagnostic::of_file(&shown, &error.to_string(), error.help(), coloured).rendered
    })?;
    let text = serde_json::to_string_pretty(&found).map_err(|error| format!("error: {error}"))?;
    Ok(Answer { text: text + "\n", code: 0 })
}
