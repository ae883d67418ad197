//! `liouville search`

use std::io::IsTerminal;
use std::sync::Arc;

use indicatif::ProgressBar;
use liouville::report::{diagnostic, search as written};
use liouville::search::{self, Effort, Halt, Wanted};
use signal_hook::consts::SIGINT;
use signal_hook::flag;

use super::eval::open;
use super::{Answer, Search, colour};

/// The exit code of a search that was stopped.
const STOPPED: u8 = 3;

/// The exit code of a program that Ctrl-C ends.
const INTERRUPTED: i32 = 130;

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
        poisson: options.poisson.as_ref().map(|formula| match formula.as_str() {
            "" => search::Hamiltonians::Known,
            formula => search::Hamiltonians::Given(formula.to_string()),
        }),
        halt: options.within.map_or_else(Halt::default, Halt::within),
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
    // A second Ctrl-C ends the program.
    let switch = effort.halt.switch();
    flag::register_conditional_shutdown(SIGINT, INTERRUPTED, Arc::clone(&switch))
        .and_then(|_| flag::register(SIGINT, switch))
        .map_err(|error| format!("error: cannot listen to Ctrl-C: {error}"))?;
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
    let code = if report.unreached.is_empty() { 0 } else { STOPPED };
    Ok(Answer { text: text + "\n", code })
}
