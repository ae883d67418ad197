//! The command `liouville motion orbit`.

use std::borrow::Cow;

use crate::report::data::DataTable;
use crate::report::facts;
use crate::report::orbit;
use clap::{Args, ValueEnum};
use liouville::case::Case;
use liouville::number::rational::Rational;
use liouville::verdict;
use liouville_draw::Plot;
use liouville_flow::{
    Begin, Columns, FlowError, Launches, Lexicon, Precision, SampledOrbit, Sampling, Start,
};

use super::Progress;
use super::eval::wrong_state;
use super::ink::Ink;
use super::iterates;
use super::motion::{MotionArgs, Threads, parse_number, parse_positive, rendered, wrong_formula};
use super::output::{Ending, Output};
use super::starts::{GivenStart, Named, Starts, misfit};
use super::track;
use super::watching::watched;
use super::{CommandOutput, write};

/// Number of intervals between samples where no interval is given.
const INTERVALS: i64 = 1000;
/// Limit on the numbers of a file.
pub const MOST_NUMBERS: f64 = 3e7;
/// Time where none is given.
const TIME: i64 = 100;
/// Limit on the number of iterates of a map.
const MOST_ITERATES: f64 = 1e10;

#[derive(Debug, Args)]
pub struct OrbitArgs {
    #[command(flatten)]
    pub subject: MotionArgs,
    /// Time of the motion, 100 by default; negative: backwards
    #[arg(long, allow_hyphen_values = true, value_parser = parse_number)]
    pub time: Option<Rational>,
    /// Number of iterates of a map, 1000 by default
    #[arg(long, value_name = "N", value_parser = parse_iterates)]
    pub iterates: Option<u64>,
    /// Start by exact numbers: --state 'ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]', moved to the level set if
    /// it is off it; drawn by default
    #[arg(long, value_name = "STATE", conflicts_with_all = ["start", "starts"])]
    pub state: Option<String>,
    #[command(flatten)]
    pub starts: Starts,
    /// Arithmetic: 16 or 32 digits
    #[arg(long, value_enum, default_value_t = Digits::Float)]
    pub precision: Digits,
    /// Number of the state that is drawn
    #[arg(long, default_value_t = 0)]
    pub index: u64,
    /// Number of motions from drawn states, where no start is given
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = parse_positive)]
    pub orbits: usize,
    /// Interval of time between the samples of --out; by default a thousandth of the time. Of a map
    /// the number of iterates from one sample to the next; by default 1
    #[arg(long, value_name = "TIME", requires = "out", value_parser = parse_number)]
    pub every: Option<Rational>,
    /// Columns of --out: t, formulas of the case, and names of its claims: --columns 't, x, energy, F2'.
    /// By default t and the state. A picture shows the others over the first, which may be t. Of a map
    /// n counts the iterates, and a picture shows its first two components by default
    #[arg(
        long,
        visible_alias = "plot",
        value_name = "FORMULAS",
        requires = "out",
        allow_hyphen_values = true
    )]
    pub columns: Option<String>,
    /// Draw the track of the contact point on the plane, from the origin on; as data t, X, Y
    #[arg(long, requires = "out", conflicts_with_all = ["columns", "precision"])]
    pub track: bool,
    #[command(flatten)]
    pub ink: Ink,
    #[command(flatten)]
    pub threads: Threads,
}

/// Arithmetic of a motion.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Digits {
    /// f64 with compensated sums
    Float,
    /// About 32 digits, fifty times slower
    DoubleDouble,
}

impl Digits {
    pub fn precision(self) -> Precision {
        match self {
            Digits::Float => Precision::Float,
            Digits::DoubleDouble => Precision::Pair,
        }
    }
}

/// Reads a number of iterates, also as 1e6.
pub fn parse_iterates(text: &str) -> Result<u64, String> {
    let whole = parse_number(text).ok().filter(|count| count.to_integer().is_some());
    let count = whole.map(|count| count.to_f64().0);
    let count = count.filter(|count| (1.0..=MOST_ITERATES).contains(count));
    count.map(|count| count as u64).ok_or("write a whole number from 1 to 1e10".to_string())
}

/// Follows the motions, until a limit or Ctrl-C ends them early.
pub fn run(options: &OrbitArgs) -> Result<CommandOutput, String> {
    watched(options.subject.limits, None, || answer(options))
}

/// Follows the motions and writes their file; returns the report, and whether some were stopped.
fn answer(options: &OrbitArgs) -> Result<(String, bool), String> {
    let subject = &options.subject;
    let case = subject.open_with_maps()?;
    if case.model.system.is_map() {
        return iterates::run(options, &case);
    }
    if options.iterates.is_some() {
        return Err("error: --iterates: this case is not a map\n\
                    help: give a time: --time 100"
            .to_string());
    }
    let time = options.time.clone().unwrap_or_else(|| Rational::from(TIME));
    if !time.to_f64().0.is_finite() {
        return Err(
            "error: --time: the time is too large for f64\nhelp: give a shorter time".to_string()
        );
    }
    if time.to_f64().0 == 0.0 {
        return Err("error: --time 0: nothing moves in no time\n\
                    help: write a number that is not 0; `liouville eval` shows the state and its rates"
            .to_string());
    }
    let told = |error: FlowError| subject.told(&error);
    if case.model.system.has_arbitrary_function() {
        return Err(told(FlowError::Arbitrary));
    }
    let inputs: Vec<_> =
        [subject.case.as_path()].into_iter().chain(options.starts.inputs()).collect();
    let out = options.ink.output(Ending::ALL, &inputs)?;
    if options.track {
        track::check(&case)?;
    }
    let columns = columns(&case, options)?;
    let (names, starts): (Vec<_>, Vec<_>) = starts(&case, options)?.into_iter().unzip();
    let every = interval(options, &time, starts.len(), columns.titles().len())?;
    let precision = options.precision.precision();
    let bar = Progress::of(starts.len() as u64, "orbits");
    let threads = options.threads.count();
    let (found, tracks): (Vec<SampledOrbit>, _) = match options.track {
        true => {
            let times = (&time, &every);
            let followed = track::follow(&case, &starts, times, threads, &|share| bar.add(share))?;
            let rows = followed.rows(&time, &every);
            let points: Vec<Vec<[f64; 2]>> =
                followed.tracks.into_iter().map(|track| track.points).collect();
            let found = followed.found.into_iter().zip(rows);
            let found = found.map(|(one, rows)| SampledOrbit { rows, ..one }).collect();
            (found, Some(points))
        }
        false => {
            let is_picture = out.as_ref().is_some_and(|out| out.ending.is_picture());
            let with_steps = is_picture && options.every.is_none();
            let sampling = Sampling { columns: &columns, every, with_steps };
            let sampling = out.is_some().then_some(&sampling);
            let followed = (&time, precision);
            let progress = |share| bar.add(share);
            (liouville_flow::orbits(&case, &starts, followed, sampling, threads, &progress), None)
        }
    };
    bar.finish();
    let titles = match options.track {
        true => ["t", "X", "Y"].map(str::to_string).to_vec(),
        false => columns.titles().to_vec(),
    };
    if let Some(out) = &out {
        if out.ending.is_picture() && tracks.is_none() && titles.len() > 2 && titles[0] != "t" {
            anstream::eprintln!(
                "note: the picture shows {} over {}; {} is left out",
                titles[1],
                titles[0],
                titles[2..].join(", ")
            );
        }
        let plot = match &tracks {
            _ if !out.ending.is_picture() => None,
            Some(tracks) => Some(orbit::track_plot(tracks)),
            None => {
                let rows: Vec<_> = found.iter().map(|one| &one.rows[..]).collect();
                orbit::plot(&titles, &names, &rows)
            }
        };
        save(&case, (options, &time), out, (&titles[..], plot), &found)?;
    }
    let ended = found.iter().filter_map(|one| one.orbit.as_ref().err());
    let is_stopped = ended.clone().any(|problem| matches!(problem, FlowError::StoppedAt { .. }));
    // Single motions may end early; if all do, the command fails.
    if let Some(problem) = ended.clone().next()
        && ended.count() == found.len()
        && !is_stopped
    {
        let rows: usize = found.iter().map(|one| one.rows.len()).sum();
        let saved = out.filter(|_| rows > 0);
        let saved =
            saved.map(|out| format!("\nnote: {} has what comes before", out.path.display()));
        return Err(subject.told(problem) + &saved.unwrap_or_default());
    }
    let text = match (subject.json, &found[..]) {
        (true, [SampledOrbit { orbit: Ok(one), .. }]) => {
            orbit::json(&case, one, precision).map_err(|error| format!("error: {error}"))? + "\n"
        }
        (true, all) => {
            let all = all.iter().map(|one| &one.orbit);
            orbit::json_of_several(&case, &names, all, precision)
                .map_err(|error| format!("error: {error}"))?
                + "\n"
        }
        (false, [SampledOrbit { orbit: Ok(one), .. }]) => orbit::text(&case, one, precision),
        (false, all) => orbit::text_of_several(&case, &names, all.iter().map(|one| &one.orbit)),
    };
    let rows: usize = found.iter().map(|one| one.rows.len()).sum();
    let saved = out.filter(|out| !subject.json && !out.ending.is_picture()).map(|out| {
        format!(
            "{}: {rows} rows of {}\n",
            out.path.display(),
            numbered(&titles, found.len()).join(", ")
        )
    });
    Ok((text + &saved.unwrap_or_default(), is_stopped))
}

fn columns(case: &Case, options: &OrbitArgs) -> Result<Columns, String> {
    let text = options.columns.as_deref();
    let read = match text {
        Some(text) => Columns::read(Lexicon::new(case), text),
        None => Columns::whole_state(Lexicon::new(case)),
    };
    read.map_err(|mistake| wrong_formula("--columns", text.unwrap_or_default(), &mistake))
}

/// Starts with their names.
pub fn starts(case: &Case, options: &OrbitArgs) -> Result<Named, String> {
    let subject = &options.subject;
    let launches =
        Launches { case, fixed: &[], pad: None, seed: subject.seed, index: options.index };
    let one = |begin: &Begin| launches.start(begin);
    if let Some(text) = &options.state {
        let state = verdict::read_state(case, text).map_err(|error| wrong_state(&error))?;
        return Ok(vec![("state".to_string(), one(&Begin::State(state)))]);
    }
    let given = options.starts.read(case)?;
    if given.is_empty() {
        let name = |index: u64| match options.orbits {
            1 => "drawn".to_string(),
            _ => format!("drawn, {index}"),
        };
        let Some(end) = options.index.checked_add(options.orbits as u64) else {
            return Err("error: --index: the last state has no number\n\
                        help: give a smaller --index, or fewer --orbits"
                .to_string());
        };
        let all = options.index..end;
        return Ok(all.map(|index| (name(index), one(&Begin::Drawn(index)))).collect());
    }
    let start = |(name, given): (String, GivenStart)| match given {
        GivenStart::State(state) => Ok((name, one(&Begin::State(state)))),
        GivenStart::Values(values) => on_section(case, options, &values).map(|start| (name, start)),
    };
    given.into_iter().map(start).collect()
}

/// Start at a point (l, L/G) of the case's section.
fn on_section(
    case: &Case,
    options: &OrbitArgs,
    values: &[Rational],
) -> Result<Result<Start, FlowError>, String> {
    let plan = case.section.as_ref();
    let (Some(plan), [l, z]) = (plan, values) else {
        let otherwise = plan.map(|_| "l,L/G on the section of the case");
        return Err(misfit(case, values.len(), otherwise));
    };
    let at = [l.to_f64().0, z.to_f64().0];
    let seed = options.subject.seed;
    let found = liouville_flow::section_starts(case, &plan.g0, &plan.energy, &[at], seed);
    let mut found = found.map_err(|error| options.subject.told(&error))?;
    Ok(found.pop().unwrap_or(Err(FlowError::NoStart)))
}

/// Interval between samples.
fn interval(
    options: &OrbitArgs,
    time: &Rational,
    starts: usize,
    columns: usize,
) -> Result<Rational, String> {
    let size = time.abs();
    let every = match &options.every {
        Some(every) => every.clone(),
        None => &size * &Rational::new(1, INTERVALS),
    };
    if options.every.is_some() && every.to_f64().0 <= 0.0 {
        return Err("error: --every: write a number above 0, the time between samples".to_string());
    }
    let rows = size.to_f64().0 / every.to_f64().0;
    let numbers = rows * starts as f64 * columns as f64;
    match options.ink.out.is_some() && numbers > MOST_NUMBERS {
        true => Err(format!(
            "error: {numbers:.1e} numbers are too many for one file, which holds {MOST_NUMBERS:.0e}\n\
             help: give a longer --every, a shorter --time, or fewer --columns"
        )),
        false => Ok(every),
    }
}

/// Titles of the columns; of several motions the first column is the number of the start.
pub fn numbered(titles: &[String], count: usize) -> Vec<String> {
    let start = (count > 1).then(|| "start".to_string());
    start.into_iter().chain(titles.iter().cloned()).collect()
}

fn save(
    case: &Case,
    (options, time): (&OrbitArgs, &Rational),
    out: &Output,
    (titles, plot): (&[String], Option<Plot>),
    found: &[SampledOrbit],
) -> Result<(), String> {
    let bytes = match out.ending.is_picture() {
        true => {
            let plot = plot.ok_or_else(|| {
                "error: a picture needs two columns\nhelp: write --columns 't, x'".to_string()
            })?;
            let time = facts::equation("t", &format!("0 … {time}"));
            let caption = facts::listed([time].into_iter().chain(facts::parameters(case, &[])));
            options.ink.drawn((case.title.as_str(), vec![caption]), vec![plot], 1, out.ending)?
        }
        false => {
            let rows = found.iter().enumerate().flat_map(|(index, one)| {
                one.rows.iter().map(move |row| match found.len() {
                    1 => Cow::Borrowed(&row[..]),
                    _ => Cow::Owned([&[super::motion::whole(index)], &row[..]].concat()),
                })
            });
            let data = DataTable {
                columns: numbered(titles, found.len()),
                whole: usize::from(found.len() > 1),
                rows: rows.collect(),
                precision: options.precision.precision(),
            };
            rendered(&data, out.ending)
        }
    };
    write(&out.path, "--out", bytes)
}
