//! The command `liouville motion basins`.

use clap::Args;
use liouville::case::Case;
use liouville::mechanics::TIME;
use liouville::number::rational::Rational;
use liouville_flow::{BasinRequest, Columns, Destiny, FlowError, Lexicon, StateAxis, basins};

use super::CommandOutput;
use super::Progress;
use super::chart::parse_size;
use super::ink::{Ink, Sheet};
use super::motion::{MotionArgs, Threads, check_time, parse_float, parse_number, wrong_formula};
use super::output::Ending;
use super::starts::{GivenStart, example, given, misfit};
use super::watching::watched;
use crate::report::basins::BasinReport;

/// Largest number of motions.
const MOST_MOTIONS: usize = 1_000_000;

#[derive(Clone, Debug, Args)]
pub struct BasinArgs {
    #[command(flatten)]
    pub subject: MotionArgs,
    /// Horizontal axis NAME=a..b, where NAME is a component of the state: x, ω3
    #[arg(long, value_name = "NAME=A..B", allow_hyphen_values = true)]
    pub x: String,
    /// Vertical axis, in the same form
    #[arg(long, value_name = "NAME=A..B", allow_hyphen_values = true)]
    pub y: String,
    /// Number of motions across and upwards
    #[arg(long, value_name = "NXxNY", default_value = "64x40", value_parser = parse_size)]
    pub size: [usize; 2],
    /// State that gives the components that do not vary: 'x=0 y=0 z=1/2', or components in order,
    /// 0,0,1/2. Starts are moved to the level
    #[arg(long, value_name = "STATE", allow_hyphen_values = true)]
    pub start: Option<String>,
    /// Energy of all starts; by default each has that of its state
    #[arg(long, value_parser = parse_number)]
    pub energy: Option<Rational>,
    /// Value of an integral that the case claims and that is proved, or of the energy, for all motions:
    /// --fix J=3.1. The option may be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub fix: Vec<String>,
    /// Time of each motion; negative: backwards. Its later half shows where it ends
    #[arg(long, default_value = "400", allow_hyphen_values = true, value_parser = parse_float)]
    pub time: f64,
    /// Values by which attractors are told apart: --by 'cos(φ), sin(φ), p'. By default the components
    /// of the state
    #[arg(long, value_name = "FORMULAS", allow_hyphen_values = true)]
    pub by: Option<String>,
    #[command(flatten)]
    pub ink: Ink,
    #[command(flatten)]
    pub threads: Threads,
}

/// Finds the basins, until a limit or Ctrl-C ends that early.
pub fn run(options: &BasinArgs) -> Result<CommandOutput, String> {
    watched(options.subject.limits, None, || answer(options))
}

/// Finds the basins and writes their file; returns the report, and whether motions were stopped.
fn answer(options: &BasinArgs) -> Result<(String, bool), String> {
    let out = options.ink.output(Ending::CHARTS, &[&options.subject.case])?;
    check_time(options.time)?;
    let count = options.size[0] * options.size[1];
    if count > MOST_MOTIONS {
        return Err(format!(
            "error: --size: {count} motions are more than {MOST_MOTIONS}\nhelp: give a smaller --size"
        ));
    }
    let case = options.subject.open()?;
    if case.model.system.has_arbitrary_function() {
        return Err(options.subject.told(&FlowError::Arbitrary));
    }
    let axes = [
        axis(&case, "--x", &options.x, options.size[0])?,
        axis(&case, "--y", &options.y, options.size[1])?,
    ];
    if axes[0].component == axes[1].component {
        let name = &axes[1].name;
        return Err(format!("error: --y: `{name}` already varies along --x\nhelp: name another"));
    }
    let base = base(&case, options.start.as_deref())?;
    let columns = columns(&case, options.by.as_deref())?;
    let fixed = super::fixing::fixed(&case, options.energy.as_ref(), &options.fix)?;
    let request = BasinRequest {
        axes: &axes,
        base: &base,
        fixed: &fixed,
        columns: &columns,
        time: options.time,
        seed: options.subject.seed,
    };
    let bar = Progress::of(count as u64, "motions");
    let found = basins(&case, &request, options.threads.count(), &|share| bar.add(share));
    bar.finish();
    let found = found.map_err(|error| options.subject.told(&error))?;
    let report = BasinReport {
        case: &case,
        request: &request,
        has_values: options.by.is_some(),
        found: &found,
    };
    options.ink.save(
        out.as_ref(),
        &Sheet {
            title: &case.title,
            csv: &|| report.csv(),
            json: &|| report.json(),
            picture: &|| (report.caption(), vec![report.plot()]),
        },
    )?;
    let text = if options.subject.json { report.json()? } else { report.text() };
    let is_stopped = |end: &Destiny| *end == Destiny::Ended(FlowError::Stopped);
    Ok((text, found.ends.iter().any(is_stopped)))
}

fn axis(case: &Case, option: &str, text: &str, count: usize) -> Result<StateAxis, String> {
    StateAxis::read(case, text, count).map_err(|mistake| {
        format!("error: {option} {text}: {}\nhelp: {}", mistake.message, mistake.help)
    })
}

/// State that gives the components that do not vary; it is not needed where all others vary.
fn base(case: &Case, text: Option<&str>) -> Result<Vec<Rational>, String> {
    let dimension = case.model.dimension();
    let Some(text) = text else {
        return match dimension {
            2 => Ok(vec![Rational::from(0); dimension]),
            _ => Err(format!(
                "error: nothing gives the components of the state that do not vary\n\
                 help: give a state, --start {}",
                example(case)
            )),
        };
    };
    match given(case, text).map_err(|error| format!("error: --start: {error}"))? {
        GivenStart::State(state) => Ok(state),
        GivenStart::Values(values) => Err(misfit(case, values.len(), None)),
    }
}

/// Values by which attractors are told apart; by default the state without the time.
fn columns(case: &Case, text: Option<&str>) -> Result<Columns, String> {
    let names = case.model.state.iter().map(|variable| variable.name.as_str());
    let state = names.filter(|name| *name != TIME).collect::<Vec<_>>().join(", ");
    let text = text.unwrap_or(&state);
    let read = Columns::read(Lexicon::new(case), text);
    let columns = read.map_err(|mistake| wrong_formula("--by", text, &mistake))?;
    match columns.varies() {
        true => Ok(columns),
        false => Err(format!(
            "error: --by: `{text}` is the same at all states, and tells no motions apart\n\
             help: name components of the state, or functions of them"
        )),
    }
}
