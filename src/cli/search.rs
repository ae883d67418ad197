//! `liouville search`

use std::io::IsTerminal;

use indicatif::ProgressBar;
use liouville::report::{diagnostic, search as written};
use liouville::search::{self, Effort, Wanted};

use super::eval::open;
use super::{Answer, Search, colour};

pub fn run(options: &Search) -> Result<Answer, String> {
    let case = open(&options.case, &options.settings)?;
    let effort = Effort {
        degree: options.degree,
        blind: options.blind,
        terms: options.terms.clone(),
        conditions: options.conditions.as_ref().map(|name| match name.as_str() {
            "" => Wanted::Existence,
            name => Wanted::Claim(name.to_string()),
        }),
        seconds: options.seconds,
        ansatz: search::Ansatz {
            wanted: options.ansatz.is_some(),
            positions: options.ansatz.unwrap_or(search::Ansatz::default().positions),
            potentials: options.potentials,
            gyrostats: options.gyrostats,
            megabytes: options.megabytes,
        },
        options: liouville::verdict::Options {
            seed: options.seed,
            ..liouville::verdict::Options::default()
        },
    };
    if let Some(plan) = search::plan(&case, &effort).filter(|plan| plan.seconds >= 1.0) {
        let search::Plan { unknowns, seconds, megabytes } = plan;
        eprintln!("up to {unknowns} unknowns: at most {seconds:.0} s and {megabytes} MB");
    }
    let spinner = match std::io::stderr().is_terminal() {
        true => ProgressBar::new_spinner(),
        false => ProgressBar::hidden(),
    };
    let mut progress = |what: &str| {
        spinner.set_message(what.to_string());
        spinner.tick();
    };
    let report = search::search(&case, &effort, &mut progress);
    spinner.finish_and_clear();
    let report = report.map_err(|error| {
        let shown = options.case.display().to_string();
        let coloured = colour(std::io::stderr().is_terminal());
        diagnostic::of_file(&shown, &error.to_string(), error.help(), coloured).rendered
    })?;
    let text = match options.json {
        true => written::json(&case.title, &report).map_err(|error| format!("error: {error}"))?,
        false => written::text(&case.title, &report),
    };
    Ok(Answer { text: text + "\n", code: 0 })
}
