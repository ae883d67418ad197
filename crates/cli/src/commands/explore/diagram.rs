//! The command `liouville motion diagram`.

use clap::Args;
use liouville::case::Case;
use liouville_flow::{
    Begin, ChartAxis, Columns, Coordinate, CrossingSurface, DiagramRequest, DiagramSection,
    FlowError, SectionChoice, SurfaceRequest, diagram,
};

use super::CommandOutput;
use super::Progress;
use super::ink::{Ink, Sheet};
use super::motion::{CrossingArgs, MotionArgs, Threads, parse_count, wrong_choice};
use super::output::Ending;
use super::starts::{GivenStart, Starts, misfit};
use super::surface::{begin, read_axes, read_surface};
use crate::report::bifurcations::{DiagramReport, OrbitsAtValue};

/// Largest number of crossings of a diagram.
const MOST_CROSSINGS: usize = 20_000_000;
/// Default numbers of crossings, and of those left out.
const CROSSINGS: usize = 100;
const SKIP: usize = 300;

#[derive(Clone, Debug, Args)]
pub struct DiagramArgs {
    #[command(flatten)]
    pub subject: MotionArgs,
    /// Quantity that varies, NAME=a..b: a parameter (a_g), a component of one (c3, I12), the energy,
    /// or l, L/G of the start of a rolling body
    #[arg(long, value_name = "NAME=A..B", allow_hyphen_values = true)]
    pub over: String,
    /// Number of values, each in the middle of its part of the range
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub count: u32,
    #[command(flatten)]
    pub crossing: CrossingArgs,
    #[command(flatten)]
    pub starts: Starts,
    /// Number of motions at each value, from starts spread over the sphere; with --section, from
    /// states drawn. By default the first start of the case, or one drawn
    #[arg(long, value_parser = parse_count)]
    pub orbits: Option<usize>,
    /// Integrate backwards in time
    #[arg(long)]
    pub backwards: bool,
    #[command(flatten)]
    pub ink: Ink,
    #[command(flatten)]
    pub threads: Threads,
}

pub fn run(options: &DiagramArgs) -> Result<CommandOutput, String> {
    let inputs: Vec<_> =
        [options.subject.case.as_path()].into_iter().chain(options.starts.inputs()).collect();
    let out = options.ink.output(Ending::CHARTS, &inputs)?;
    let case = options.subject.open()?;
    if case.model.system.has_arbitrary_function() {
        return Err(options.subject.told(&FlowError::Arbitrary));
    }
    let (name, axis) =
        ChartAxis::read(&case, &options.over, options.count as usize).map_err(|mistake| {
            format!("error: --over {}: {}\nhelp: {}", options.over, mistake.message, mistake.help)
        })?;
    let found = match options.crossing.section.as_deref() {
        None => through_angle(options, &case, &axis)?,
        Some(text) => through_surface(options, &case, &axis, text)?,
    };
    let report = DiagramReport {
        case: &case,
        name: &name,
        axis: &axis,
        surface: found.surface.as_deref(),
        titles: &found.titles,
        starts: &found.starts,
        values: &found.values,
    };
    if report.is_empty()
        && let Some(problem) = report.first_problem()
    {
        return Err(options.subject.told(problem));
    }
    options.ink.save(
        out.as_ref(),
        &Sheet {
            title: &case.title,
            csv: &|| report.csv(),
            json: &|| report.json(),
            picture: &|| (report.caption(), report.plots()),
        },
    )?;
    let text = if options.subject.json { report.json()? } else { report.text() };
    Ok(CommandOutput { text, code: 0 })
}

impl DiagramArgs {
    fn crossings(&self) -> usize {
        self.crossing.crossings.unwrap_or(CROSSINGS)
    }

    fn skip(&self) -> usize {
        self.crossing.skip.unwrap_or(SKIP)
    }
}

/// Crossings at all values, with what they are crossings of.
struct Found {
    surface: Option<String>,
    titles: Vec<String>,
    starts: Vec<String>,
    values: Vec<OrbitsAtValue>,
}

fn through_angle(options: &DiagramArgs, case: &Case, axis: &ChartAxis) -> Result<Found, String> {
    let mut starts = Vec::new();
    for (_, given) in options.starts.read(case)? {
        match given {
            GivenStart::Values(values) if values.len() == 2 => {
                starts.push([0, 1].map(|place: usize| values[place].to_f64().0));
            }
            GivenStart::Values(values) | GivenStart::State(values) => {
                return Err(misfit(case, values.len(), Some("l,L/G on the section")));
            }
        }
    }
    let is_given = !starts.is_empty() || options.orbits.is_some();
    // The energy of the request is replaced where it varies.
    let middle = axis.value(axis.count / 2);
    let choice = SectionChoice {
        energy: match axis.coordinate {
            Coordinate::Energy => Some(middle),
            _ => options.crossing.plane.energy.clone(),
        },
        direction: options.crossing.direction,
        orbits: if is_given { options.orbits } else { Some(usize::from(!has_starts(case))) },
        crossings: Some(options.crossings()),
        skip: Some(options.skip()),
        starts,
        backwards: options.backwards,
        seed: options.subject.seed,
        ..options.crossing.plane.choice()?
    };
    let mut request = choice.request(case).map_err(|error| wrong_choice(&error))?;
    if !is_given {
        request.starts.truncate(1);
    }
    if request.starts.is_empty() {
        return Err(nothing());
    }
    let name = |at: &[f64; 2]| format!("{},{}", at[0], at[1]);
    let starts = request.starts.iter().map(name).collect();
    let values = follow(options, case, axis, DiagramSection::Andoyer(&request))?;
    let titles = ["l", "L/G"].map(str::to_string).to_vec();
    Ok(Found { surface: None, titles, starts, values })
}

/// Message that a diagram has no motions.
fn nothing() -> String {
    "error: there is no motion to follow\nhelp: give --start, or --orbits 1 or more".to_string()
}

fn has_starts(case: &Case) -> bool {
    case.section.as_ref().is_some_and(|plan| !plan.starts.is_empty())
}

fn through_surface(
    options: &DiagramArgs,
    case: &Case,
    axis: &ChartAxis,
    text: &str,
) -> Result<Found, String> {
    if matches!(axis.coordinate, Coordinate::L | Coordinate::Z) {
        return Err("error: --over: l and L/G are coordinates of the section g = g₀\n\
                    help: leave out --section, or vary a parameter or the energy"
            .to_string());
    }
    let surface: CrossingSurface = read_surface(case, text)?;
    let axes: Columns = read_axes(case, &surface, options.crossing.axes.as_deref())?;
    let mut starts = Vec::new();
    for (name, given) in options.starts.read(case)? {
        starts.push((name, begin(case, &axes, given)?));
    }
    let drawn = options.orbits.unwrap_or(usize::from(starts.is_empty())) as u64;
    starts.extend((0..drawn).map(|index| (format!("drawn {index}"), Begin::Drawn(index))));
    if starts.is_empty() {
        return Err(nothing());
    }
    let (starts, begins): (Vec<String>, Vec<Begin>) = starts.into_iter().unzip();
    let request = SurfaceRequest {
        surface: &surface,
        axes: &axes,
        direction: options.crossing.direction.unwrap_or_default(),
        crossings: options.crossings(),
        skip: options.skip(),
        backwards: options.backwards,
    };
    let fixed = options.crossing.plane.fixed(case)?;
    let section = DiagramSection::Surface { request: &request, begins: &begins, fixed: &fixed };
    let values = follow(options, case, axis, section)?;
    let (surface, titles) = (Some(surface.text().to_string()), axes.titles().to_vec());
    Ok(Found { surface, titles, starts, values })
}

/// Follows the motions at all values.
fn follow(
    options: &DiagramArgs,
    case: &Case,
    axis: &ChartAxis,
    section: DiagramSection<'_>,
) -> Result<Vec<OrbitsAtValue>, String> {
    let request = DiagramRequest { axis, section, seed: options.subject.seed };
    let each = request.count().saturating_mul(options.crossings());
    if each.saturating_mul(axis.count) > MOST_CROSSINGS {
        return Err(format!(
            "error: {} values of {each} crossings are more than {MOST_CROSSINGS}\n\
             help: give a smaller --count, --orbits or --crossings",
            axis.count
        ));
    }
    let bar = Progress::of(axis.count as u64, "values");
    let found = diagram(case, &request, options.threads.count(), &|share| bar.add(share));
    bar.finish();
    found.map_err(|error| options.subject.told(&error))
}
