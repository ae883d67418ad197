//! The command `liouville eval`.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::report::point;
use crate::report::{CaseDigest, diagnostic};
use liouville::case::{Case, Setting};
use liouville::formula::canonical_name;
use liouville::mechanics::Model;
use liouville::verdict;
use liouville_report::evidence::shell_quoted;

use super::{CommandOutput, LimitArgs, colour, source};

fn parse_digits(text: &str) -> Result<usize, String> {
    let digits: usize = text.parse().map_err(|_| "write a number of digits".to_string())?;
    (1..=verdict::MOST_DIGITS)
        .contains(&digits)
        .then_some(digits)
        .ok_or(format!("write a number from 1 to {}", verdict::MOST_DIGITS))
}

#[derive(Debug, Args)]
pub struct Eval {
    /// Case file
    pub case: PathBuf,
    /// Give a parameter a value: --set m=5/4 --set 'I=[2,2,3]'; others are drawn
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<String>,
    /// State by exact numbers: --state 'ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]'; drawn by default
    #[arg(long, value_name = "STATE")]
    pub state: Option<String>,
    /// Number of the state that is drawn
    #[arg(long, default_value_t = 0)]
    pub index: u64,
    /// Number of significant digits to print, all of them right (up to 2000); without it, numbers
    /// are rounded to f64 and come with a bound on their error
    #[arg(long, value_parser = parse_digits)]
    pub digits: Option<usize>,
    /// Seed of the draws
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub limits: LimitArgs,
}

pub fn run(options: &Eval) -> Result<CommandOutput, String> {
    let case = open(&options.case, &options.settings)?;
    let shown = options.case.display().to_string();
    let coloured = colour(std::io::stderr().is_terminal());
    let state = match &options.state {
        None => None,
        Some(text) => Some(verdict::read_state(&case, text).map_err(|error| wrong_state(&error))?),
    };
    let told = |error: verdict::JudgeError| {
        diagnostic::of_file(&shown, &error.to_string(), error.help(), coloured).rendered
    };
    let (seed, index, state) = (options.seed, options.index, state.as_deref());
    let text = match options.digits {
        None => written(
            &verdict::evaluate(&case, state, seed, index).map_err(told)?,
            &case.model,
            options.json,
        ),
        Some(digits) => written(
            &verdict::evaluate_digits(&case, state, seed, index, digits).map_err(told)?,
            &case.model,
            options.json,
        ),
    }?;
    Ok(CommandOutput { text, code: 0 })
}

/// Message about a state that cannot be read.
pub(super) fn wrong_state(error: &verdict::StateError) -> String {
    format!(
        "error: --state: {error}\n\
         help: give every state variable a value; `liouville eval` without --state shows how"
    )
}

/// A case with its text.
#[derive(Debug)]
pub struct Opened {
    pub case: Case,
    pub text: String,
}

/// Reads a case with the values given by `--set`.
pub(super) fn open(path: &Path, settings: &[String]) -> Result<Case, String> {
    open_text(path, settings).map(|opened| opened.case)
}

/// Reads a case with the values given by `--set`, and the digest of its text.
pub(super) fn open_signed(path: &Path, settings: &[String]) -> Result<(Case, CaseDigest), String> {
    open_text(path, settings).map(|Opened { case, text }| (case, CaseDigest::of(&text)))
}

/// Reads a case with the values given by `--set`, and keeps its text.
pub(super) fn open_text(path: &Path, settings: &[String]) -> Result<Opened, String> {
    let settings = read_settings(settings)?;
    let shown = path.display().to_string();
    let coloured = colour(std::io::stderr().is_terminal());
    let (text, case) = source::read(path, &settings);
    let case = case.map_err(|error| {
        diagnostic::rendered(&diagnostic::of_case(&shown, &text, &error, coloured))
    })?;
    Ok(Opened { case, text })
}

/// Reads a case from its text, with the values given by `--set`.
pub(super) fn read_text(path: &Path, text: &str, settings: &[String]) -> Result<Opened, String> {
    let coloured = colour(std::io::stderr().is_terminal());
    let case = Case::parse(text, &read_settings(settings)?).map_err(|error| {
        let shown = path.display().to_string();
        diagnostic::rendered(&diagnostic::of_case(&shown, text, &error, coloured))
    })?;
    Ok(Opened { case, text: text.to_string() })
}

/// Reads the values of `--set`.
pub(super) fn read_settings(settings: &[String]) -> Result<Vec<Setting>, String> {
    let settings =
        settings.iter().map(|text| setting(text)).collect::<Result<Vec<Setting>, String>>()?;
    for (index, setting) in settings.iter().enumerate() {
        if settings[..index].iter().any(|earlier| earlier.name == setting.name) {
            return Err(format!(
                "error: --set: `{}` is given twice\nhelp: give it one value",
                setting.name
            ));
        }
    }
    Ok(settings)
}

fn written<N: point::Decimal>(
    report: &verdict::PointReport<N>,
    model: &Model,
    json: bool,
) -> Result<String, String> {
    match json {
        true => Ok(point::json(report).map_err(|error| format!("error: {error}"))? + "\n"),
        false => Ok(point::text(report, model)),
    }
}

fn setting(text: &str) -> Result<Setting, String> {
    let (name, value) = text.split_once('=').ok_or_else(|| {
        format!("error: --set: `{text}` is not of the form name=value\nhelp: write --set m=5/4")
    })?;
    if let Some(separate) = several(text) {
        return Err(format!(
            "error: --set: `{text}` gives several values\nhelp: repeat the option: {separate}"
        ));
    }
    let name = canonical_name(name.trim()).unwrap_or_else(|| name.trim().to_string());
    Ok(Setting { name, value: value.to_string() })
}

/// Settings that were joined by commas, as options of their own.
fn several(text: &str) -> Option<String> {
    let mut depth = 0;
    let outside = |letter: char| {
        depth += i32::from(matches!(letter, '(' | '[')) - i32::from(matches!(letter, ')' | ']'));
        depth == 0 && matches!(letter, ',' | ';')
    };
    let parts: Vec<&str> = text.split(outside).map(str::trim).collect();
    let are_settings = parts.len() > 1 && parts.iter().all(|part| part.contains('='));
    let separate = || parts.iter().map(|part| format!("--set {}", shell_quoted(part)));
    are_settings.then(|| separate().collect::<Vec<_>>().join(" "))
}
