//! The command `liouville motion chart`.

use crate::parts::{Form, Identity, Job, json_line, json_unit};
use crate::report::chart::{self, ChartReport, Colours};
use crate::report::facts;
use clap::Args;
use liouville::case::Case;
use liouville::mechanics::ParameterOrigin;
use liouville::part::Part;
use liouville::verdict;
use liouville_draw::{Text, math, plain};
use liouville_flow::{
    ChartAxis, Coordinate, Exponents, FlowError, Launch, PlaneRequest, SectionChoice,
};

use super::CommandOutput;
use super::Progress;
use super::eval::Opened;
use super::ink::{Ink, Sheet};
use super::motion::{
    MotionArgs, SectionPlaneArgs, Threads, check_time, parse_float, parse_start, wrong_choice,
};
use super::output::{Ending, Output};
use super::share::{Share, Target, carry_out};

#[derive(Clone, Debug, Args)]
pub struct ChartArgs {
    #[command(flatten)]
    pub subject: MotionArgs,
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
    /// Time of each motion; negative: backwards. An exponent below (ln t)/t is not detected
    #[arg(long, default_value = "200", allow_hyphen_values = true, value_parser = parse_float)]
    pub time: f64,
    #[command(flatten)]
    pub plane: SectionPlaneArgs,
    /// Start l,L/G on the section; by default the first one of the case
    #[arg(long, value_name = "L,Z", value_parser = parse_point, allow_hyphen_values = true)]
    pub start: Option<[f64; 2]>,
    /// Start by exact numbers instead: --state 'ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]'
    #[arg(long, value_name = "STATE", conflicts_with = "start")]
    pub state: Option<String>,
    /// Colours of the picture: classes, or values with a colour bar
    #[arg(long, value_enum, default_value_t = Colours::Class)]
    pub colour: Colours,
    #[command(flatten)]
    pub ink: Ink,
    #[command(flatten)]
    pub share: Share,
    #[command(flatten)]
    pub threads: Threads,
}

/// Limit on the motions along an axis.
const MAX_SIZE: usize = 4000;

/// Reads a point l,L/G of a section.
fn parse_point(text: &str) -> Result<[f64; 2], String> {
    parse_start(text).map_err(|error| {
        format!(
            "{error}, for a rolling body with a section; other starts are given by --state 'x=1 …'"
        )
    })
}

/// Reads two numbers, across and up.
pub fn parse_size(text: &str) -> Result<[usize; 2], String> {
    let both = text.split_once(['x', '×', ',']).unwrap_or((text, text));
    let read = |part: &str| part.trim().parse().ok().filter(|n| (1..=MAX_SIZE).contains(n));
    let size = read(both.0).zip(read(both.1)).map(|(across, up)| [across, up]);
    size.ok_or(format!("write two numbers up to {MAX_SIZE}, such as 64x40"))
}

pub fn run(options: &ChartArgs) -> Result<CommandOutput, String> {
    let opened = options.subject.opened()?;
    carry_out(&ChartJob::new(options.clone(), opened)?, &options.share, options.target())
}

/// Cell of a chart.
pub type Cell = Result<Exponents, FlowError>;

/// A chart with its case.
#[derive(Debug)]
pub struct ChartJob {
    options: ChartArgs,
    opened: Opened,
    names: [String; 2],
    request: PlaneRequest,
    out: Option<Output>,
}

impl ChartArgs {
    fn target(&self) -> Target<'_> {
        Target { out: self.ink.out.as_deref(), threads: self.threads.count() }
    }
}

impl ChartJob {
    pub(in crate::commands) fn new(options: ChartArgs, opened: Opened) -> Result<Self, String> {
        let case = &opened.case;
        check_time(options.time)?;
        let out = match options.share.part {
            Some(_) => None,
            None => options.ink.output(Ending::CHARTS, &[&options.subject.case])?,
        };
        let (x_name, x) = axis(case, "--x", &options.x, options.size[0])?;
        let (y_name, y) = axis(case, "--y", &options.y, options.size[1])?;
        if x.coordinate == y.coordinate {
            return Err(format!(
                "error: --y: `{y_name}` already varies along --x\nhelp: name another"
            ));
        }
        let axes = [x, y];
        let launch = launch(case, &options, &axes)?;
        let request = PlaneRequest { axes, launch, time: options.time, seed: options.subject.seed };
        Ok(Self { options, opened, names: [x_name, y_name], request, out })
    }

    /// Request of the plane.
    pub fn request(&self) -> &PlaneRequest {
        &self.request
    }

    /// Names of the axes.
    pub fn names(&self) -> &[String; 2] {
        &self.names
    }

    fn count(&self) -> usize {
        self.request.axes.iter().map(|axis| axis.count).product()
    }
}

impl Job for ChartJob {
    type Unit = Cell;

    fn identity(&self) -> Result<Identity, String> {
        let [x, y] = &self.names;
        let request = format!("{x} {y} {:?}", self.request);
        let (subject, share) = (&self.options.subject, &self.options.share);
        Ok(subject.identity("chart", &self.opened.text, (self.count() as u64, request), share))
    }

    fn form(&self) -> Form {
        Form::Csv(chart::titles(["x", "y"]))
    }

    fn compute(&self, part: Part, threads: usize) -> Result<Vec<Cell>, String> {
        let range = part.range(self.count() as u64);
        let bar = Progress::of(range.end - range.start, "motions");
        let (case, request) = (&self.opened.case, &self.request);
        let cells =
            liouville_flow::plane_part(case, request, part, threads, &|share| bar.add(share));
        bar.finish();
        cells.map_err(|error| self.options.subject.told(&error))
    }

    fn line(&self, place: u64, cell: &Cell) -> Result<String, String> {
        let problem = match cell {
            Ok(_) => String::new(),
            Err(problem) => json_line(problem)?,
        };
        Ok(chart::row(&self.request.axes, place as usize, cell, &problem))
    }

    fn unit(&self, line: &str) -> Result<Cell, String> {
        match chart::read_row(line, self.request.time) {
            Some(Ok(found)) => Ok(Ok(found)),
            Some(Err(problem)) => json_unit(&problem).map(Err),
            None => Err(format!("error: a part has a wrong line: {line}")),
        }
    }

    fn report(&self, cells: Vec<Cell>) -> Result<CommandOutput, String> {
        let Self { options, opened: Opened { case, .. }, names, request, out } = self;
        let subject = &options.subject;
        let names = [names[0].as_str(), names[1].as_str()];
        let (axes, time, cells) = (&request.axes, request.time, &cells[..]);
        let report = ChartReport { title: &case.title, names, axes, time, cells };
        let json =
            || report.json().map(|text| text + "\n").map_err(|error| format!("error: {error}"));
        let picture = || {
            let own = [own(case, request, 0), own(case, request, 1)];
            (caption(case, request, names), vec![report.plot(options.colour, own)])
        };
        options.ink.save(
            out.as_ref(),
            &Sheet { title: &case.title, csv: &|| report.csv(), json: &json, picture: &picture },
        )?;
        let text = if subject.json { json()? } else { report.text() };
        // A picture without any motion is a failure; single motions may fail.
        match cells.iter().find_map(|found| found.as_ref().err()) {
            Some(problem) if cells.iter().all(Result::is_err) => Err(subject.told(problem)),
            _ => Ok(CommandOutput { text, code: 0 }),
        }
    }
}

/// Value of the case itself on an axis.
fn own(case: &Case, request: &PlaneRequest, place: usize) -> Option<f64> {
    match (&request.axes[place].coordinate, &request.launch) {
        (Coordinate::Parameter { index, component }, _) => {
            match &case.model.parameters.get(*index)?.origin {
                ParameterOrigin::Fixed(values) => {
                    values.get(*component).map(|value| value.to_f64().0)
                }
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
    if let Launch::State(Some(state)) = &request.launch {
        found.extend(facts::start(case, state, &names));
    }
    found.extend(facts::parameters(case, &names));
    facts::listed(found)
}

/// Reads `NAME=a..b`.
fn axis(
    case: &Case,
    option: &str,
    text: &str,
    count: usize,
) -> Result<(String, ChartAxis), String> {
    ChartAxis::read(case, text, count).map_err(|mistake| {
        format!("error: {option} {text}: {}\nhelp: {}", mistake.message, mistake.help)
    })
}

/// Launch of the motions: on the section, if the case or the command line defines one.
fn launch(case: &Case, options: &ChartArgs, axes: &[ChartAxis; 2]) -> Result<Launch, String> {
    let state = options.state.as_deref().map(|text| verdict::read_state(case, text));
    let state = state.transpose().map_err(|error| format!("error: --state: {error}"))?;
    let choice =
        SectionChoice { starts: options.start.into_iter().collect(), ..options.plane.choice()? };
    choice.launch(case, axes, state).map_err(|error| wrong_choice(&error))
}
