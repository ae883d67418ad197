//! The command `liouville motion rotation`.

use clap::Args;
use liouville::case::{Case, Direction};
use liouville::number::rational::Rational;
use liouville_flow::{
    Begin, Columns, FlowError, Launches, Launchpad, Lexicon, RotationNumber, SectionChoice,
    SurfaceRequest, number_with_pi, surface_section,
};

use super::CommandOutput;
use super::Progress;
use super::ink::{Ink, Sheet};
use super::motion::{CrossingArgs, MotionArgs, Threads, wrong_choice, wrong_formula};
use super::output::Ending;
use super::starts::{GivenStart, given};
use super::surface::{begin, read_axes, read_surface};
use crate::report::rotation::{RotationReport, RotationRow};

/// Smallest number of crossings of which a rotation number is taken.
const LEAST_CROSSINGS: usize = 32;
/// Default number of crossings.
const CROSSINGS: usize = 2000;
/// Largest number of crossings in all.
const MOST_CROSSINGS: usize = 100_000_000;

#[derive(Clone, Debug, Args)]
pub struct RotationArgs {
    #[command(flatten)]
    pub subject: MotionArgs,
    #[command(flatten)]
    pub crossing: CrossingArgs,
    /// First start of the line: l,L/G, or values of the two axes, or a state 'x=1 y=0'
    #[arg(long, value_name = "START", allow_hyphen_values = true)]
    pub from: String,
    /// Last start of the line, in the same form
    #[arg(long, value_name = "START", allow_hyphen_values = true)]
    pub to: String,
    /// Number of starts, both ends among them
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub count: u32,
    /// Point about which the angle is counted, by its two coordinates. By default the angle is l of a
    /// rolling body
    #[arg(long, value_name = "U,V", conflicts_with = "angle", allow_hyphen_values = true)]
    pub centre: Option<String>,
    /// Angle in radians that is counted instead, by a formula: --angle 'atan2(y, x)'
    #[arg(long, value_name = "FORMULA", requires = "section", allow_hyphen_values = true)]
    pub angle: Option<String>,
    #[command(flatten)]
    pub ink: Ink,
    #[command(flatten)]
    pub threads: Threads,
}

/// Crossings of one motion, as far as it went.
struct Course {
    at: Vec<Vec<f64>>,
    problem: Option<FlowError>,
}

pub fn run(options: &RotationArgs) -> Result<CommandOutput, String> {
    let out = options.ink.output(Ending::CHARTS, &[&options.subject.case])?;
    let case = options.subject.open()?;
    if case.model.system.has_arbitrary_function() {
        return Err(options.subject.told(&FlowError::Arbitrary));
    }
    options.check()?;
    let (line, centre) = (Line::read(&case, options)?, options.centre()?);
    let (titles, surface, courses) = match options.crossing.section.as_deref() {
        None => through_angle(options, &case, &line)?,
        Some(text) => through_surface(options, &case, &line, text)?,
    };
    let rows: Vec<RotationRow> = courses
        .into_iter()
        .enumerate()
        .map(|(place, course)| {
            let angles: Vec<f64> = course.at.iter().map(|at| options.angle(at, centre)).collect();
            RotationRow {
                start: line.at(place).iter().map(|x| x.to_f64().0).collect(),
                crossings: angles.len(),
                // A motion that ends has no mean for long times.
                found: RotationNumber::of(&angles).filter(|_| course.problem.is_none()),
                problem: course.problem,
            }
        })
        .collect();
    if rows.iter().all(|row| row.crossings == 0)
        && let Some(problem) = rows.iter().find_map(|row| row.problem.as_ref())
    {
        return Err(options.subject.told(problem));
    }
    let report = RotationReport {
        case: &case,
        titles: line.titles(&case, &titles),
        surface: surface.as_deref(),
        around: options.around(),
        rows: &rows,
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
    Ok(CommandOutput { text, code: 0 })
}

impl RotationArgs {
    fn crossings(&self) -> usize {
        self.crossing.crossings.unwrap_or(CROSSINGS)
    }

    fn check(&self) -> Result<(), String> {
        if self.crossings() < LEAST_CROSSINGS {
            return Err(format!("error: --crossings: write at least {LEAST_CROSSINGS}"));
        }
        if self.crossings().saturating_mul(self.count as usize) > MOST_CROSSINGS {
            return Err(format!(
                "error: {} motions of {} crossings are more than {MOST_CROSSINGS} crossings\n\
                 help: give a smaller --count or --crossings",
                self.count,
                self.crossings()
            ));
        }
        if self.crossing.section.is_some() && self.centre.is_none() && self.angle.is_none() {
            return Err("error: the angle that is counted is not known\n\
                        help: give --centre U,V with the coordinates of a point of the section, or \
                        --angle 'atan2(y, x)'"
                .to_string());
        }
        Ok(())
    }

    /// Coordinates of the centre.
    fn centre(&self) -> Result<Option<[f64; 2]>, String> {
        let Some(text) = &self.centre else { return Ok(None) };
        let numbers: Option<Vec<f64>> =
            text.split(',').map(|part| number_with_pi(part).map(|x| x.to_f64().0)).collect();
        let centre = numbers.and_then(|numbers| <[f64; 2]>::try_from(numbers).ok());
        centre.map(Some).ok_or_else(|| {
            format!(
                "error: --centre: `{text}` is no point\n\
                 help: write its two coordinates, such as 1.2,-0.04"
            )
        })
    }

    /// The angle as a function of the recorded values: the two coordinates, and a formula behind them.
    fn angle(&self, at: &[f64], centre: Option<[f64; 2]>) -> f64 {
        let value = |place: usize| at.get(place).copied().unwrap_or(f64::NAN);
        let Some([u, v]) = centre else {
            return value(if self.angle.is_some() { 2 } else { 0 });
        };
        let across = match self.crossing.section {
            // l is an angle: the nearest way round.
            None => libm::remainder(value(0) - u, std::f64::consts::TAU),
            Some(_) => value(0) - u,
        };
        libm::atan2(value(1) - v, across)
    }

    /// The angle in words.
    fn around(&self) -> String {
        match (&self.centre, &self.angle) {
            (Some(centre), _) => format!("about ({})", centre.trim().replace(',', ", ")),
            (None, Some(angle)) => format!("of {angle}"),
            (None, None) => "of l".to_string(),
        }
    }
}

/// Line of starts.
struct Line {
    ends: [GivenStart; 2],
    count: usize,
}

fn values(start: &GivenStart) -> &[Rational] {
    match start {
        GivenStart::State(values) | GivenStart::Values(values) => values,
    }
}

impl Line {
    fn read(case: &Case, options: &RotationArgs) -> Result<Self, String> {
        let read = |option: &str, text: &str| {
            given(case, text).map_err(|error| format!("error: {option}: {error}"))
        };
        let ends = [read("--from", &options.from)?, read("--to", &options.to)?];
        let same = match &ends {
            [GivenStart::State(_), GivenStart::State(_)] => true,
            [GivenStart::Values(a), GivenStart::Values(b)] => a.len() == b.len(),
            _ => false,
        };
        if !same {
            return Err("error: --from and --to have different forms\n\
                        help: give both as states, or both by two coordinates"
                .to_string());
        }
        if ends[0] == ends[1] {
            return Err("error: --from and --to are the same start".to_string());
        }
        Ok(Self { ends, count: options.count as usize })
    }

    /// Values of a start.
    fn at(&self, place: usize) -> Vec<Rational> {
        let share = Rational::new(place as i64, self.count as i64 - 1);
        let [from, to] = self.ends.each_ref().map(values);
        from.iter().zip(to).map(|(a, b)| a + &(&(b - a) * &share)).collect()
    }

    fn start(&self, place: usize) -> GivenStart {
        match self.ends[0] {
            GivenStart::State(_) => GivenStart::State(self.at(place)),
            GivenStart::Values(_) => GivenStart::Values(self.at(place)),
        }
    }

    /// Names of the values of a start.
    fn titles(&self, case: &Case, axes: &[String]) -> Vec<String> {
        match self.ends[0] {
            GivenStart::Values(_) => axes.to_vec(),
            GivenStart::State(_) => case.model.state_names(),
        }
    }
}

/// Titles of the coordinates, equation of the surface, and motions.
type Followed = (Vec<String>, Option<String>, Vec<Course>);

fn through_angle(options: &RotationArgs, case: &Case, line: &Line) -> Result<Followed, String> {
    let starts: Option<Vec<[f64; 2]>> = (0..line.count)
        .map(|place| match line.start(place) {
            GivenStart::Values(values) => {
                let numbers: Vec<f64> = values.iter().map(|x| x.to_f64().0).collect();
                numbers.try_into().ok()
            }
            GivenStart::State(_) => None,
        })
        .collect();
    let starts = starts.ok_or_else(|| {
        "error: --from: a start on g = g₀ has two values\n\
         help: write l,L/G, or give --section 'x = 0' with a surface"
            .to_string()
    })?;
    let choice = SectionChoice {
        direction: options.crossing.direction,
        orbits: Some(0),
        crossings: Some(options.crossings()),
        skip: Some(options.crossing.skip.unwrap_or(0)),
        starts,
        seed: options.subject.seed,
        ..options.crossing.plane.choice()?
    };
    let request = choice.request(case).map_err(|error| wrong_choice(&error))?;
    let bar = Progress::of(line.count as u64, "motions");
    let orbits =
        liouville_flow::section(case, &request, options.threads.count(), &|share| bar.add(share));
    bar.finish();
    let orbits = orbits.map_err(|error| options.subject.told(&error))?.into_iter();
    let course = |orbit: liouville_flow::SectionOrbit| Course {
        at: orbit.crossings.iter().map(|met| met.at.to_vec()).collect(),
        problem: orbit.problem,
    };
    Ok((["l", "L/G"].map(str::to_string).to_vec(), None, orbits.map(course).collect()))
}

fn through_surface(
    options: &RotationArgs,
    case: &Case,
    line: &Line,
    text: &str,
) -> Result<Followed, String> {
    let surface = read_surface(case, text)?;
    let axes = read_axes(case, &surface, options.crossing.axes.as_deref())?;
    if axes.titles().len() != 2 {
        return Err("error: --axes: the section of a rotation has two coordinates\n\
                    help: write --axes 'y, py'"
            .to_string());
    }
    let recorded = match &options.angle {
        None => None,
        Some(angle) => {
            let wrong = |mistake| wrong_formula("--angle", angle, &mistake);
            let own = Columns::read(Lexicon::new(case), angle).map_err(wrong)?;
            if own.titles().len() != 1 {
                return Err("error: --angle is one scalar".to_string());
            }
            let all = format!("{}, {angle}", axes.titles().join(", "));
            let read = Columns::read(Lexicon::new(case), &all);
            Some(read.map_err(|mistake| wrong_formula("--angle", &all, &mistake))?)
        }
    };
    let direction = options.crossing.direction.unwrap_or(Direction::Up);
    let fixed = options.crossing.plane.fixed(case)?;
    let launches = Launches {
        case,
        fixed: &fixed,
        pad: Some(Launchpad { surface: &surface, axes: &axes, direction }),
        seed: options.subject.seed,
        index: 0,
    };
    let begins: Vec<Begin> = (0..line.count)
        .map(|place| begin(case, &axes, line.start(place)))
        .collect::<Result<_, _>>()?;
    let starts: Vec<_> = begins.iter().map(|begin| launches.start(begin)).collect();
    let request = SurfaceRequest {
        surface: &surface,
        axes: recorded.as_ref().unwrap_or(&axes),
        direction,
        crossings: options.crossings(),
        skip: options.crossing.skip.unwrap_or(0),
        backwards: false,
    };
    let bar = Progress::of(line.count as u64, "motions");
    let orbits =
        surface_section(case, &request, &starts, options.threads.count(), &|share| bar.add(share));
    bar.finish();
    let orbits = orbits.map_err(|error| options.subject.told(&error))?.into_iter();
    let course = |orbit: liouville_flow::SurfaceOrbit| Course {
        at: orbit.crossings.into_iter().map(|met| met.at).collect(),
        problem: orbit.problem,
    };
    let found = orbits.map(course).collect();
    Ok((axes.titles().to_vec(), Some(surface.text().to_string()), found))
}
