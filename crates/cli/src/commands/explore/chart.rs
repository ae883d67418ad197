//! The command `liouville motion chart`.

use crate::report::chart::{ChartReport, Colours};
use crate::report::facts;
use clap::{Args, ValueEnum};
use liouville::case::Case;
use liouville::mechanics::Origin;
use liouville::verdict;
use liouville_draw::{Text, math, plain};
use liouville_flow::{Axis, Coordinate, Launch, PlaneRequest, SectionChoice};

use super::ink::Ink;
use super::motion::{Plane, Subject, Threads, parse_start, wrong_choice};
use super::output::Ending;
use super::progress::progress;
use super::{Answer, write};

#[derive(Debug, Args)]
pub struct Chart {
    #[command(flatten)]
    pub subject: Subject,
    /// Horizontal axis NAME=a..b, where NAME is a parameter (a_g), a component of one (c3, I12), or
    /// of the start on the section: l, L/G, energy
    #[arg(long, value_name = "NAME=A..B", allow_hyphen_values = true)]
    pub x: String,
    /// Vertical axis, in the same form
    #[arg(long, value_name = "NAME=A..B", allow_hyphen_values = true)]
    pub y: String,
    /// Number of motions across and upwards
    #[arg(long, value_name = "NXxNY", default_value = "64x40", value_parser = parse_size)]
    pub size: [usize; 2],
    /// Time to follow each motion; negative: backwards. An exponent below (ln t)/t is not detected
    #[arg(long, default_value = "200", allow_hyphen_values = true)]
    pub time: f64,
    #[command(flatten)]
    pub plane: Plane,
    /// Start l,L/G on the section; by default the first one of the case
    #[arg(long, value_name = "L,Z", value_parser = parse_start, allow_hyphen_values = true)]
    pub start: Option<[f64; 2]>,
    /// Start by exact numbers instead: --state 'ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]'
    #[arg(long, value_name = "STATE", conflicts_with = "start")]
    pub state: Option<String>,
    /// Colours of the picture: classes, or values with a colour bar
    #[arg(long, value_enum, default_value_t = Colour::Class)]
    pub colour: Colour,
    #[command(flatten)]
    pub ink: Ink,
    #[command(flatten)]
    pub threads: Threads,
}

/// Meaning of the colours of a chart.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Colour {
    /// Class of the motion
    Class,
    /// Largest Lyapunov exponent
    Exponent,
    /// Mean divergence
    Divergence,
}

impl Colour {
    fn of(self) -> Colours {
        match self {
            Self::Class => Colours::Class,
            Self::Exponent => Colours::Exponent,
            Self::Divergence => Colours::Divergence,
        }
    }
}

/// Limit on the motions along an axis.
const MAX_SIZE: usize = 4000;

/// Reads two numbers, across and up.
pub fn parse_size(text: &str) -> Result<[usize; 2], String> {
    let both = text.split_once(['x', '×', ',']).unwrap_or((text, text));
    let read = |part: &str| part.trim().parse().ok().filter(|n| (1..=MAX_SIZE).contains(n));
    let size = read(both.0).zip(read(both.1)).map(|(across, up)| [across, up]);
    size.ok_or(format!("write two numbers up to {MAX_SIZE}, such as 64x40"))
}

pub fn run(options: &Chart) -> Result<Answer, String> {
    let subject = &options.subject;
    let case = subject.open()?;
    if options.time == 0.0 || !options.time.is_finite() {
        return Err("error: --time: write a number that is not 0".to_string());
    }
    let out = options.ink.output(Ending::PICTURES, &[&options.subject.case])?;
    let (x_name, x) = axis(&case, "--x", &options.x, options.size[0])?;
    let (y_name, y) = axis(&case, "--y", &options.y, options.size[1])?;
    if x.coordinate == y.coordinate {
        return Err(format!("error: --y: `{y_name}` already varies along --x\nhelp: name another"));
    }
    let axes = [x, y];
    let launch = launch(&case, options, &axes)?;
    let request = PlaneRequest { axes, launch, time: options.time, seed: subject.seed };
    let [across, up] = &request.axes;
    let bar = progress((across.count * up.count) as u64, "motions");
    let cells = liouville_flow::plane(&case, &request, options.threads.count(), &|| bar.inc(1))
        .map_err(|error| subject.told(&error))?;
    bar.finish_and_clear();
    let report = ChartReport {
        title: &case.title,
        names: [&x_name, &y_name],
        axes: &request.axes,
        time: request.time,
        cells: &cells,
    };
    if let Some(out) = &out {
        let own = [own(&case, &request, 0), own(&case, &request, 1)];
        let plot = report.plot(options.colour.of(), own);
        let caption = caption(&case, &request, [&x_name, &y_name]);
        let bytes =
            options.ink.drawn((case.title.as_str(), vec![caption]), vec![plot], 1, out.ending)?;
        write(&out.path, "--out", bytes)?;
    }
    let text = match subject.json {
        true => report.json().map_err(|error| format!("error: {error}"))? + "\n",
        false => report.text(),
    };
    // A picture without any motion is a failure; single motions may fail.
    match cells.iter().find_map(|found| found.as_ref().err()) {
        Some(problem) if cells.iter().all(Result::is_err) => Err(subject.told(problem)),
        _ => Ok(Answer { text, code: 0 }),
    }
}

/// Value of the case itself on an axis.
fn own(case: &Case, request: &PlaneRequest, place: usize) -> Option<f64> {
    match (&request.axes[place].coordinate, &request.launch) {
        (Coordinate::Parameter { index, component }, _) => {
            match &case.model.parameters.get(*index)?.origin {
                Origin::Fixed(values) => values.get(*component).map(|value| value.to_f64().0),
                _ => None,
            }
        }
        (Coordinate::L, Launch::Section { at, .. }) => Some(at[0]),
        (Coordinate::Z, Launch::Section { at, .. }) => Some(at[1]),
        (Coordinate::Energy, Launch::Section { energy, .. }) => Some(energy.to_f64().0),
        _ => None,
    }
}

/// Words below the picture: the time, the start, and the parameters that do not vary.
fn caption(case: &Case, request: &PlaneRequest, names: [&str; 2]) -> Text {
    let mut found = vec![facts::equation("t", &request.time.to_string())];
    if let Launch::Section { g0, energy, at } = &request.launch {
        let varies = |name: &str| names.contains(&name);
        found.push(facts::equation("g_0", &g0.to_string()));
        if !varies("energy") {
            found.push(facts::equation("h", &energy.to_string()));
        }
        if !varies("l") || !varies("L/G") {
            let start = format!(" = ({}, {})", at[0], at[1]).replace('-', "−");
            found.push(
                plain("start\u{a0}")
                    .then(math("(l,\u{a0}L/G)"))
                    .then(plain(&facts::unbroken(&start))),
            );
        }
    }
    found.extend(facts::parameters(case, &names));
    facts::listed(found)
}

/// Reads `NAME=a..b`.
fn axis(case: &Case, option: &str, text: &str, count: usize) -> Result<(String, Axis), String> {
    Axis::read(case, text, count).map_err(|mistake| {
        format!("error: {option} {text}: {}\nhelp: {}", mistake.message, mistake.help)
    })
}

/// Launch of the motions: on the section, if the case or the command line defines one.
fn launch(case: &Case, options: &Chart, axes: &[Axis; 2]) -> Result<Launch, String> {
    let state = options.state.as_deref().map(|text| verdict::read_state(case, text));
    let state = state.transpose().map_err(|error| format!("error: --state: {error}"))?;
    let choice =
        SectionChoice { starts: options.start.into_iter().collect(), ..options.plane.choice() };
    choice.launch(case, axes, state).map_err(|error| wrong_choice(&error))
}
