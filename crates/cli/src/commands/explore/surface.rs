//! The command `liouville motion section --section`: crossings of a surface by any system.

use crate::report::data::Data;
use crate::report::facts;
use crate::report::surface::{SurfaceReport, plot};
use liouville::case::{Case, Direction};
use liouville::number::pair::Pair;
use liouville_draw::{math, plain};
use liouville_flow::{
    Begin, Columns, FlowError, Launches, Launchpad, Lexicon, Precision, Surface, SurfaceOrbit,
    SurfaceRequest,
};

use super::motion::{Subject, whole, wrong_formula};
use super::progress::progress;
use super::section::{Drawn, Section, Wish};
use super::starts::{Given, Named, misfit};

/// Default numbers of orbits and of crossings.
const ORBITS: usize = 12;
const CROSSINGS: usize = 500;

/// Section of one case by the surface of `--section`.
pub fn drawn(
    case: &Case,
    subject: &Subject,
    options: &Section,
    wish: Wish,
) -> Result<Drawn, String> {
    let told = |error: FlowError| subject.told(&error);
    if case.model.system.has_arbitrary_function() {
        return Err(told(FlowError::Arbitrary));
    }
    refuse_others(options)?;
    let surface = read_surface(case, options.section.as_deref().unwrap_or_default())?;
    let axes = read_axes(case, &surface, options.axes.as_deref())?;
    if wish.is_picture() && axes.titles().len() < 2 {
        return Err("error: a picture needs two axes\nhelp: write --axes 'y, z'".to_string());
    }
    let direction = options.direction.unwrap_or_default();
    let (names, starts): (Vec<_>, Vec<_>) =
        starts(case, options, &surface, &axes, direction)?.into_iter().unzip();
    let request = SurfaceRequest {
        surface: &surface,
        axes: &axes,
        direction,
        crossings: options.crossings.unwrap_or(CROSSINGS),
        skip: options.skip.unwrap_or(0),
        backwards: options.backwards,
    };
    let bar = progress(starts.len() as u64, "orbits");
    let threads = options.threads.count();
    let orbits = liouville_flow::surface_section(case, &request, &starts, threads, &|| bar.inc(1));
    bar.finish_and_clear();
    let orbits = orbits.map_err(told)?;
    if orbits.iter().all(|orbit| orbit.crossings.is_empty())
        && let Some(problem) = orbits.iter().find_map(|orbit| orbit.problem.as_ref())
    {
        return Err(told(problem.clone()));
    }
    let cells = options.shade.then(|| options.ink.cells(wish.columns, 0.62));
    let report = SurfaceReport { case, request: &request, names: &names, orbits: &orbits };
    let section = plain("section ").then(math(request.surface.text()));
    Ok(Drawn {
        title: case.title.clone(),
        facts: facts::listed([section].into_iter().chain(facts::parameters(case, &[]))),
        text: match options.subject.json {
            true => report.json().map_err(|error| format!("error: {error}"))?,
            false => report.text(),
        },
        plot: wish.is_picture().then(|| plot(axes.titles(), &orbits, cells)),
        data: wish.is_data().then(|| data(&axes, &orbits)),
    })
}

/// Refuses options of the Andoyer-like variables.
fn refuse_others(options: &Section) -> Result<(), String> {
    let given = [
        ("--colour", options.colour.is_some()),
        ("--lines", !options.lines.is_empty()),
        ("--images", options.images.is_some()),
        ("--separatrices", !options.separatrices.is_empty()),
        ("--classes", options.classes.is_some()),
        ("--both-ways", options.both_ways),
    ];
    match given.iter().find(|(_, given)| *given) {
        Some((name, _)) => Err(format!(
            "error: {name} is for the section g = g₀ of a rolling body\nhelp: leave out --section, or {name}"
        )),
        None => Ok(()),
    }
}

/// Reads the surface of `--section`.
pub fn read_surface(case: &Case, text: &str) -> Result<Surface, String> {
    let read = Surface::read(Lexicon::new(case), text);
    read.map_err(|mistake| wrong_formula("--section", text, &mistake))
}

fn read_axes(case: &Case, surface: &Surface, text: Option<&str>) -> Result<Columns, String> {
    let free = surface.default_axes();
    let text = text.unwrap_or(&free);
    let read = Columns::read(Lexicon::new(case), text);
    read.map_err(|mistake| wrong_formula("--axes", text, &mistake))
}

/// Starts with their names.
fn starts(
    case: &Case,
    options: &Section,
    surface: &Surface,
    axes: &Columns,
    direction: Direction,
) -> Result<Named, String> {
    let launches = Launches {
        case,
        energy: options.plane.energy.as_ref(),
        pad: Some(Launchpad { surface, axes, direction }),
        seed: options.subject.seed,
        index: 0,
    };
    let mut begins = Vec::new();
    for (name, given) in options.starts.read(case)? {
        begins.push((name, begin(case, axes, given)?));
    }
    let drawn = options.orbits.unwrap_or(if begins.is_empty() { ORBITS } else { 0 });
    begins.extend((0..drawn as u64).map(|index| (format!("drawn {index}"), Begin::Drawn(index))));
    Ok(begins.into_iter().map(|(name, begin)| (name, launches.start(&begin))).collect())
}

/// A whole state, or values of the axes.
fn begin(case: &Case, axes: &Columns, given: Given) -> Result<Begin, String> {
    match given {
        Given::State(state) => Ok(Begin::State(state)),
        Given::Values(values) if values.len() == axes.titles().len() => Ok(Begin::Axes(values)),
        Given::Values(values) => {
            let otherwise = format!("the values of {}", axes.titles().join(", "));
            Err(misfit(case, values.len(), Some(&otherwise)))
        }
    }
}

/// Crossings as data.
fn data(axes: &Columns, orbits: &[SurfaceOrbit]) -> Data {
    let rows = orbits.iter().enumerate().flat_map(|(index, orbit)| {
        orbit.crossings.iter().map(move |crossing| {
            let direction = if crossing.rising { 1.0 } else { -1.0 };
            let numbers = [direction, crossing.time].into_iter().chain(crossing.at.clone());
            [whole(index)].into_iter().chain(numbers.map(Pair::from_f64)).collect()
        })
    });
    let first = ["start", "direction", "t"].map(str::to_string).into_iter();
    Data {
        columns: first.chain(axes.titles().iter().cloned()).collect(),
        whole: 2,
        rows: rows.collect(),
        precision: Precision::Float,
    }
}
