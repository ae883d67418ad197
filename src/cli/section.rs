//! `liouville section`

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use liouville::case::{Angle, Case, Direction, Line};
use liouville::flow::{self, FlowError, SectionOrbit, SectionRequest};
use liouville::number::rational::Rational;
use liouville::report::picture;
use liouville::report::section::{SectionReport, draw_lines, picture};

use super::Answer;
use super::eval::open;
use super::orbit::told;

/// Orbits and crossings where neither the case nor the command line says how many.
const ORBITS: usize = 40;
const CROSSINGS: usize = 500;
/// Points of a line whose images are drawn, and how many images.
const POINTS: usize = 800;
const IMAGES: usize = 10;

#[derive(Debug, Args)]
pub struct Section {
    /// A case file of a rolling body; its [section] gives the defaults
    pub case: PathBuf,
    /// How many orbits to start, spread over the sphere
    #[arg(long)]
    pub orbits: Option<usize>,
    /// How many crossings of each orbit to draw
    #[arg(long)]
    pub crossings: Option<usize>,
    /// How many crossings to leave out at the beginning of each orbit
    #[arg(long)]
    pub skip: Option<usize>,
    /// A start l,L/G in place of those of the case; may be repeated
    #[arg(long, value_name = "L,Z", value_parser = parse_start, allow_hyphen_values = true)]
    pub start: Vec<[f64; 2]>,
    /// The energy
    #[arg(long)]
    pub energy: Option<Rational>,
    /// The angle of the section: 0, pi/2, pi, 3pi/2, or radians
    #[arg(long)]
    pub g0: Option<Angle>,
    /// Which crossings to draw: up (g grows), down, both
    #[arg(long)]
    pub direction: Option<Direction>,
    /// Follow the motion backwards in time
    #[arg(long)]
    pub backwards: bool,
    /// Colour the orbits by the value of this claim's formula, instead of one by one
    #[arg(long, value_name = "CLAIM")]
    pub colour: Option<String>,
    /// Draw the images of these lines of fixed points of reversors: L=0, l=0 (and π), l=π/2 (and 3π/2)
    #[arg(long, value_delimiter = ',')]
    pub lines: Vec<Line>,
    /// How many images of the lines, forwards and backwards
    #[arg(long)]
    pub images: Option<usize>,
    /// Draw to this file, .svg or .png
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// The width of the picture in pixels
    #[arg(long, default_value_t = 900, value_parser = clap::value_parser!(u32).range(120..=8000))]
    pub width: u32,
    /// Give a parameter a value: --set a_g=1.4; others are drawn
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<String>,
    /// Seed of parameters that are drawn
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// How many threads to use; all cores by default. Results do not depend on it
    #[arg(long)]
    pub threads: Option<usize>,
    /// Print all points as JSON
    #[arg(long)]
    pub json: bool,
}

pub(super) fn parse_start(text: &str) -> Result<[f64; 2], String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|x| x.trim().parse().ok()).collect();
    let pair = numbers.and_then(|numbers| <[f64; 2]>::try_from(numbers).ok());
    pair.ok_or("write l and L/G with a comma between, such as 1.2,-0.04".to_string())
}

pub fn run(options: &Section) -> Result<Answer, String> {
    let case = open(&options.case, &options.settings)?;
    let request = request(&case, options)?;
    let bar = progress(request.starts.len() as u64);
    let threads = options
        .threads
        .unwrap_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get));
    let orbits = flow::section(&case, &request, threads, &|| bar.inc(1))
        .map_err(|error| told(&options.case, &error))?;
    bar.finish_and_clear();
    let colour =
        options.colour.clone().or(case.section.as_ref().and_then(|plan| plan.colour.clone()));
    let shades = match &colour {
        None => None,
        Some(name) => Some(
            flow::values_at_starts(&case, &request, name)
                .map_err(|error| told(&options.case, &error))?,
        ),
    };
    if let Some(path) = &options.out {
        let mut drawn = picture(&case.title, &orbits, shades.as_deref(), options.width);
        let images = images(&case, &request, options, threads);
        draw_lines(&mut drawn, &images.map_err(|error| told(&options.case, &error))?);
        write(path, &drawn)?;
    }
    let report = SectionReport { case: &case, request: &request, orbits: &orbits };
    let text = match options.json {
        true => report.json().map_err(|error| format!("error: {error}"))? + "\n",
        false => report.text(),
    };
    // Nothing at all to draw is a failure; single orbits may fail.
    let empty = orbits.iter().all(|orbit| orbit.crossings.is_empty());
    match orbits.iter().find_map(|orbit| orbit.problem.as_ref()) {
        Some(problem) if empty => Err(told(&options.case, problem)),
        _ => Ok(Answer { text, code: 0 }),
    }
}

/// The images of the lines that are asked for, forwards and backwards.
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
            both.extend(flow::section(case, &request, threads, &|| ())?);
        }
        Ok(both)
    };
    lines.iter().map(image).collect()
}

/// What the command line asks for, and the case where it does not say.
fn request(case: &Case, options: &Section) -> Result<SectionRequest, String> {
    let plan = case.section.as_ref();
    let missing = |what: &str, key: &str| {
        format!(
            "error: the case has no [section], so that its {what} is not known\n\
             help: give --{key}, or add a [section] to the case: docs/writing-a-case.md"
        )
    };
    let g0 = options.g0.clone().or(plan.map(|plan| plan.g0.clone()));
    let energy = options.energy.clone().or(plan.map(|plan| plan.energy.clone()));
    let spread = match (options.orbits, plan) {
        (Some(count), _) => count,
        (None, _) if !options.start.is_empty() => 0,
        (None, Some(plan)) => {
            plan.orbits.unwrap_or(if plan.starts.is_empty() { ORBITS } else { 0 })
        }
        (None, None) => ORBITS,
    };
    let mut starts = match plan {
        Some(plan) if options.start.is_empty() => plan.starts.clone(),
        _ => options.start.clone(),
    };
    starts.extend(flow::spread(spread));
    Ok(SectionRequest {
        g0: g0.ok_or_else(|| missing("angle", "g0"))?,
        energy: energy.ok_or_else(|| missing("energy", "energy"))?,
        direction: options.direction.or(plan.map(|plan| plan.direction)).unwrap_or_default(),
        crossings: options.crossings.or(plan.and_then(|plan| plan.crossings)).unwrap_or(CROSSINGS),
        skip: options.skip.or(plan.map(|plan| plan.skip)).unwrap_or(0),
        starts,
        backwards: options.backwards || plan.is_some_and(|plan| plan.backwards),
        seed: options.seed,
        index: 0,
    })
}

/// A bar on a terminal, and nothing elsewhere.
fn progress(orbits: u64) -> ProgressBar {
    let target = match std::io::stderr().is_terminal() {
        true => ProgressDrawTarget::stderr(),
        false => ProgressDrawTarget::hidden(),
    };
    let bar = ProgressBar::with_draw_target(Some(orbits), target);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} orbits, {eta} left") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

fn write(path: &Path, drawn: &picture::Picture) -> Result<(), String> {
    let extension = path.extension().and_then(|extension| extension.to_str());
    let bytes = match extension {
        Some("svg") => picture::svg(drawn).into_bytes(),
        Some("png") => picture::png(drawn).map_err(|error| format!("error: {error}"))?,
        _ => {
            return Err(format!(
                "error: {} is neither .svg nor .png\nhelp: the ending says how to draw",
                path.display()
            ));
        }
    };
    std::fs::write(path, bytes).map_err(|error| {
        format!(
            "error: cannot write {}: {error}\nhelp: give --out a file in a folder that exists",
            path.display()
        )
    })
}
