//! The command `liouville motion section`.

use crate::report::data::Data;
use crate::report::exponents;
use crate::report::section::{SectionReport, draw_lines, draw_separatrices, picture};
use clap::Args;
use liouville::case::{Case, Direction, Line};
use liouville::number::pair::Pair;
use liouville_flow::{FlowError, Precision, SectionChoice, SectionOrbit, SectionRequest};

use super::motion::{
    Ink, Plane, Subject, Threads, parse_count, parse_start, rendered, whole, wrong_choice,
};
use super::output::{Ending, Output};
use super::progress::progress;
use super::starts::{Given, Starts};
use super::{Answer, surface, write};

/// Number of points of a line whose images are drawn, and default number of images.
const POINTS: usize = 800;
const IMAGES: usize = 10;

#[derive(Debug, Args)]
pub struct Section {
    #[command(flatten)]
    pub subject: Subject,
    #[command(flatten)]
    pub plane: Plane,
    /// Surface of the section, by formulas of the case: --section 'x = 0'. By default g = g₀ of a
    /// rolling body
    #[arg(long, value_name = "EQUATION", conflicts_with = "g0", allow_hyphen_values = true)]
    pub section: Option<String>,
    /// Values recorded at crossings of --section, by formulas: --axes 'y, z'. By default the first
    /// two components of the state that the surface leaves free
    #[arg(long, value_name = "FORMULAS", requires = "section", allow_hyphen_values = true)]
    pub axes: Option<String>,
    /// Number of orbits to start, spread over the sphere; with --section, of states drawn
    #[arg(long, value_parser = parse_count)]
    pub orbits: Option<usize>,
    /// Number of crossings of each orbit to draw
    #[arg(long, value_parser = parse_count)]
    pub crossings: Option<usize>,
    /// Number of crossings to leave out at the beginning of each orbit
    #[arg(long, value_parser = parse_count)]
    pub skip: Option<usize>,
    #[command(flatten)]
    pub starts: Starts,
    /// Crossings to draw: up (g or the surface's left side less its right one grows), down, both
    #[arg(long)]
    pub direction: Option<Direction>,
    /// Follow the motion backwards in time
    #[arg(long)]
    pub backwards: bool,
    /// Colour the orbits by the value of this claim's formula, instead of one by one
    #[arg(long, value_name = "CLAIM")]
    pub colour: Option<String>,
    /// Draw the images of these lines of fixed points of reversors: L=0, l=0 (and π), l=π/2 (and
    /// 3π/2)
    #[arg(long, value_delimiter = ',')]
    pub lines: Vec<Line>,
    /// Number of images of the lines, forwards and backwards
    #[arg(long, value_parser = parse_count)]
    pub images: Option<usize>,
    /// Draw the stable and unstable curves of the hyperbolic point near l,L/G (of period n: l,L/G,n);
    /// may be repeated
    #[arg(long, value_name = "L,Z[,N]", value_parser = parse_point, allow_hyphen_values = true)]
    pub separatrices: Vec<([f64; 2], usize)>,
    /// Classify each orbit by its exponents over this time and back: --classes, --classes=5000
    #[arg(long, value_name = "TIME", num_args = 0..=1, require_equals = true, default_missing_value = "2000")]
    pub classes: Option<f64>,
    #[command(flatten)]
    pub ink: Ink,
    #[command(flatten)]
    pub threads: Threads,
}

/// Reads a point of a section with its period.
fn parse_point(text: &str) -> Result<([f64; 2], usize), String> {
    match text.match_indices(',').nth(1) {
        None => Ok((parse_start(text)?, 1)),
        Some((comma, _)) => {
            let period = text[comma + 1..].trim().parse().ok().filter(|n| (1..=1000).contains(n));
            let period = period.ok_or("the period is a number from 1 to 1000".to_string())?;
            Ok((parse_start(&text[..comma])?, period))
        }
    }
}

pub fn run(options: &Section) -> Result<Answer, String> {
    let subject = &options.subject;
    let case = subject.open()?;
    if options.section.is_some() {
        return surface::run(&case, options);
    }
    let told = |error: FlowError| subject.told(&error);
    let out = options.output()?;
    if !liouville_flow::has_andoyer_section(&case.model) {
        return Err(told(FlowError::NoAndoyer));
    }
    let request = request(&case, options)?;
    let bar = progress(request.starts.len() as u64, "orbits");
    let threads = options.threads.count();
    let orbits = liouville_flow::section(&case, &request, threads, &|| bar.inc(1)).map_err(told)?;
    bar.finish_and_clear();
    let colour =
        options.colour.clone().or(case.section.as_ref().and_then(|plan| plan.colour.clone()));
    let shades = match &colour {
        None => None,
        Some(name) => Some(liouville_flow::values_at_starts(&case, &request, name).map_err(told)?),
    };
    if let Some(out) = &out {
        let bytes = match out.ending.is_picture() {
            false => rendered(&data(&orbits), out.ending),
            true => {
                let mut drawn = picture(&case.title, &orbits, shades.as_deref(), options.ink.width);
                draw_lines(&mut drawn, &images(&case, &request, options, threads).map_err(told)?);
                let near = options.separatrices.iter();
                let curves: Result<Vec<_>, FlowError> = near
                    .map(|(near, period)| {
                        liouville_flow::separatrices(&case, &request, *near, *period, threads)
                    })
                    .collect();
                draw_separatrices(&mut drawn, &curves.map_err(told)?);
                options.ink.drawn(&drawn, out.ending)?
            }
        };
        write(&out.path, "--out", bytes)?;
    }
    let areas = liouville_flow::area_forms(&case, &request).map_err(told)?;
    let classes = match options.classes {
        None => None,
        Some(time) => Some(classes(&case, &request, time, threads).map_err(told)?),
    };
    let report = SectionReport {
        case: &case,
        request: &request,
        orbits: &orbits,
        areas: &areas,
        classes: classes.as_deref(),
    };
    let text = match subject.json {
        true => report.json().map_err(|error| format!("error: {error}"))? + "\n",
        false => report.text(),
    };
    // A picture without any crossing is a failure; single orbits may fail.
    let empty = orbits.iter().all(|orbit| orbit.crossings.is_empty());
    // Of several starts below the potential, the lowest potential shows how much energy is missing.
    let missing = |problem: &&FlowError| match problem {
        FlowError::BelowPotential { potential, .. } => *potential,
        _ => f64::NEG_INFINITY,
    };
    let problems = orbits.iter().filter_map(|orbit| orbit.problem.as_ref());
    match problems.min_by(|a, b| missing(a).total_cmp(&missing(b))) {
        Some(problem) if empty => Err(subject.told(problem)),
        _ => Ok(Answer { text, code: 0 }),
    }
}

/// Classifies the orbits by their exponents, followed in both directions of time.
fn classes(
    case: &Case,
    request: &SectionRequest,
    time: f64,
    threads: usize,
) -> Result<Vec<exponents::Row>, FlowError> {
    let starts = liouville_flow::section_starts(
        case,
        &request.g0,
        &request.energy,
        &request.starts,
        request.seed,
    )?;
    let parameters = starts.iter().flatten().next().map(|start| start.parameters.clone());
    let parameters = parameters.unwrap_or_default();
    let motions = liouville_flow::Variational::all(&case.model, &parameters, &starts)?;
    let time = if request.backwards { -time } else { time };
    let bar = progress(2 * starts.len() as u64, "motions");
    let follow = |time| motions.all_exponents(time, threads, &|| bar.inc(1));
    let (forward, backward) = (follow(time), follow(-time));
    bar.finish_and_clear();
    let names = request.starts.iter().map(|[l, z]| format!("({l}, {z})")).collect();
    Ok(exponents::rows(names, forward, Some(backward)))
}

/// Computes the images of the requested lines, forwards and backwards.
fn images(
    case: &Case,
    request: &SectionRequest,
    options: &Section,
    threads: usize,
) -> Result<Vec<Vec<SectionOrbit>>, FlowError> {
    let plan = case.section.as_ref();
    let lines = match &options.lines[..] {
        [] => plan.map(|plan| plan.lines.clone()).unwrap_or_default(),
        given => given.to_vec(),
    };
    let crossings = options.images.or(plan.map(|plan| plan.images)).unwrap_or(IMAGES);
    let image = |line: &Line| {
        let mut both = Vec::new();
        for backwards in [false, true] {
            let starts = line.points(POINTS);
            let (skip, direction) = (0, Direction::Both);
            let request =
                SectionRequest { starts, crossings, skip, direction, backwards, ..request.clone() };
            both.extend(liouville_flow::section(case, &request, threads, &|| ())?);
        }
        Ok(both)
    };
    lines.iter().map(image).collect()
}

/// Request of the command line, completed from the case.
fn request(case: &Case, options: &Section) -> Result<SectionRequest, String> {
    let choice = SectionChoice {
        direction: options.direction,
        orbits: options.orbits,
        crossings: options.crossings,
        skip: options.skip,
        starts: given(case, options)?,
        backwards: options.backwards,
        seed: options.subject.seed,
        ..options.plane.choice()
    };
    choice.request(case).map_err(|error| wrong_choice(&error))
}

/// Points (l, L/G) of the options.
fn given(case: &Case, options: &Section) -> Result<Vec<[f64; 2]>, String> {
    let point = |(name, given): (String, Given)| match given {
        Given::Values(values) if values.len() == 2 => {
            Ok([values[0].to_f64().0, values[1].to_f64().0])
        }
        _ => Err(format!(
            "error: `{name}` is no point of the section\n\
             help: write l and L/G with a comma between, such as 1.2,-0.04, or give a surface by \
             --section"
        )),
    };
    options.starts.read(case)?.into_iter().map(point).collect()
}

/// Crossings as data.
fn data(orbits: &[SectionOrbit]) -> Data {
    let rows = orbits.iter().enumerate().flat_map(|(index, orbit)| {
        orbit.crossings.iter().map(move |crossing| {
            let direction = if crossing.rising { 1.0 } else { -1.0 };
            let numbers = [direction, crossing.time, crossing.at[0], crossing.at[1]];
            [&[whole(index)], &numbers.map(Pair::from_f64)[..]].concat()
        })
    });
    Data {
        columns: ["start", "direction", "t", "l", "L/G"].map(str::to_string).to_vec(),
        whole: 2,
        rows: rows.collect(),
        precision: Precision::Float,
    }
}

impl Section {
    /// File to write.
    pub fn output(&self) -> Result<Option<Output>, String> {
        let inputs: Vec<_> =
            [self.subject.case.as_path()].into_iter().chain(self.starts.inputs()).collect();
        self.ink.output(Ending::ALL, &inputs)
    }
}
