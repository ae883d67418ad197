//! The command `liouville motion chart`.

use clap::{Args, ValueEnum};
use liouville::case::Case;
use liouville::formula::{Type, canonical_name};
use liouville::mechanics::Origin;
use liouville::number::rational::Rational;
use liouville::verdict;
use liouville_cli::report::chart::{ChartReport, Colours};
use liouville_cli::report::facts;
use liouville_draw::{Text, math, plain};
use liouville_flow::{Axis, Coordinate, Launch, PlaneRequest};

use super::ink::Ink;
use super::motion::{Plane, Subject, Threads, number_with_pi, parse_start};
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

/// Reads `NAME=a..b`.
fn axis(case: &Case, option: &str, text: &str, count: usize) -> Result<(String, Axis), String> {
    let wrong = |what: &str, help: &str| format!("error: {option} {text}: {what}\nhelp: {help}");
    let form = "write NAME=a..b, such as a_g=0..14 or l=0..2pi";
    let (name, range) = text.split_once('=').ok_or_else(|| wrong("there is no `=`", form))?;
    let (from, to) = range.split_once("..").ok_or_else(|| wrong("there is no `..`", form))?;
    let read = |part: &str| number_with_pi(part).ok_or_else(|| wrong("is no range", form));
    let (from, to): (Rational, Rational) = (read(from)?, read(to)?);
    if from == to {
        return Err(wrong("the range is empty", form));
    }
    let name = canonical_name(name.trim()).unwrap_or_else(|| name.trim().to_string());
    let coordinate = match coordinate(case, &name) {
        Some(coordinate) => coordinate,
        None => return Err(wrong(&format!("there is no `{name}` to vary"), &known(case))),
    };
    if let Coordinate::Parameter { index, .. } = coordinate
        && matches!(case.model.parameters[index].origin, Origin::Formula(_))
    {
        let what = format!("`{name}` is computed from other parameters");
        return Err(wrong(&what, "vary those that it is computed from"));
    }
    if let Coordinate::Parameter { index, .. } = coordinate
        && case.model.is_rigid(index, &[])
    {
        let what = format!("`{name}` is a size, or stands in an index");
        return Err(wrong(&what, "vary another parameter"));
    }
    Ok((name, Axis { coordinate, from, to, count }))
}

/// Coordinate of a name: a parameter, a component of one, or a coordinate of the start.
fn coordinate(case: &Case, name: &str) -> Option<Coordinate> {
    let find = |name: &str| case.model.parameters.iter().position(|known| known.name == name);
    if let Some(index) = find(name)
        && case.model.parameters[index].kind == Type::Scalar
    {
        return Some(Coordinate::Parameter { index, component: 0 });
    }
    match name {
        "l" => return Some(Coordinate::L),
        "L/G" => return Some(Coordinate::Z),
        "energy" => return Some(Coordinate::Energy),
        _ => {}
    }
    let digits = name.trim_start_matches(|letter: char| !letter.is_ascii_digit());
    let index = find(name.strip_suffix(digits)?)?;
    let places: Vec<usize> =
        digits.bytes().map(|digit| usize::from(digit).wrapping_sub(usize::from(b'1'))).collect();
    let component = match (case.model.parameters[index].kind, &places[..]) {
        (Type::Vector(length), _) => {
            digits.parse::<usize>().ok()?.checked_sub(1).filter(|k| *k < length)?
        }
        (Type::Matrix(rows, columns), [k]) if *k < rows.min(columns) => (columns + 1) * k,
        (Type::Matrix(rows, columns), [i, j]) if *i < rows && *j < columns => columns * i + j,
        _ => return None,
    };
    Some(Coordinate::Parameter { index, component })
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

/// Help that lists the possible axes of a case.
fn known(case: &Case) -> String {
    let names = case.model.parameters.iter().map(|parameter| match parameter.kind {
        Type::Scalar => parameter.name.clone(),
        _ => format!("{0}1, {0}2, {0}3", parameter.name),
    });
    let names: Vec<String> = names.collect();
    format!("vary {}, or l, L/G, energy of the start on a section", names.join(", "))
}

/// Launch of the motions: on the section, if the case or the command line defines one.
fn launch(case: &Case, options: &Chart, axes: &[Axis; 2]) -> Result<Launch, String> {
    let is_start = |axis: &Axis| !matches!(axis.coordinate, Coordinate::Parameter { .. });
    let plan = case.section.as_ref();
    let on_section = options.start.is_some() || axes.iter().any(is_start);
    if options.state.is_none() && (on_section || plan.is_some()) {
        let (g0, energy) = options.plane.of(case)?;
        let planned = plan.and_then(|plan| plan.starts.first().copied());
        let both =
            axes.iter().filter(|axis| matches!(axis.coordinate, Coordinate::L | Coordinate::Z));
        let at = match options.start.or(planned) {
            Some(at) => at,
            None if both.count() == 2 => [0.0, 0.0],
            None => {
                return Err(
                    "error: where the motions start is not known\nhelp: give --start l,L/G"
                        .to_string(),
                );
            }
        };
        return Ok(Launch::Section { g0, energy, at });
    }
    if options.state.is_some() && axes.iter().any(is_start) {
        return Err("error: --state says where the motions start, and an axis too\n\
                    help: leave one of them out"
            .to_string());
    }
    match &options.state {
        None => Ok(Launch::State(None)),
        Some(text) => verdict::read_state(case, text)
            .map(|state| Launch::State(Some(state)))
            .map_err(|error| format!("error: --state: {error}")),
    }
}
