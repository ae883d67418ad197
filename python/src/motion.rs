//! Motions: orbits, sections, charts, exponents.

use std::sync::Arc;

use liouville::case::{Case as Inner, Direction};
use liouville::number::rational::Rational;
use liouville_cli::report::{exponents as written, orbit};
use liouville_flow::{
    Begin, Character, ChartAxis, Columns, CrossingSurface, Exponents, Fixed, FlowError, Launches,
    Launchpad, Lexicon, PlaneRequest, Precision, Sampling, SectionChoice, SectionOrbit, Start,
    SurfaceOrbit, SurfaceRequest, Variational,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyByteArray;

use super::case::Case;
use super::errors;
use super::start::{self, Given};
use super::work::Work;

/// Index of a motion that did not end well, with the message and the remedy.
type Problem = (usize, String, String);

/// Names of columns, and the rows of a table as bytes.
type Data<'py> = (Vec<String>, Bound<'py, PyByteArray>);

/// Class of a cell of a chart in which no motion starts, and of one that ends early.
const NO_START: f64 = -1.0;
const BROKEN: f64 = -2.0;

/// Numbers as bytes, in the order of the machine.
fn bytes<'py>(py: Python<'py>, values: impl Iterator<Item = f64>) -> Bound<'py, PyByteArray> {
    let bytes: Vec<u8> = values.flat_map(f64::to_ne_bytes).collect();
    PyByteArray::new(py, &bytes)
}

fn problem(index: usize, error: &FlowError) -> Problem {
    (index, error.to_string(), error.help().to_string())
}

/// Checks that a case has motions.
fn moving(py: Python<'_>, case: &Inner) -> PyResult<()> {
    let system = &case.model.system;
    match (system.is_map(), system.has_arbitrary_function()) {
        (true, _) => Err(errors::of_flow(py, &FlowError::Discrete)),
        (_, true) => Err(errors::of_flow(py, &FlowError::Arbitrary)),
        _ => Ok(()),
    }
}

/// Columns by their text; all of the state without one.
fn columns(py: Python<'_>, case: &Inner, text: Option<&str>) -> PyResult<Columns> {
    let read = match text {
        Some(text) => Columns::read(Lexicon::new(case), text),
        None => Columns::whole_state(Lexicon::new(case)),
    };
    read.map_err(|mistake| errors::of_mistake(py, "columns", text.unwrap_or_default(), &mistake))
}

/// Finds the starts of motions.
fn starts(
    py: Python<'_>,
    case: &Inner,
    given: &[Option<Given>],
    (seed, index): (u64, u64),
) -> PyResult<Vec<Result<Start, FlowError>>> {
    let launches = Launches { case, fixed: &[], pad: None, seed, index };
    given.iter().map(|one| start::find(py, &launches, one.as_ref())).collect()
}

/// Follows motions. Returns for each the samples, what `orbit --json` prints, and a problem.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "a list of triples for Python")]
pub fn orbits<'py>(
    py: Python<'py>,
    case: &Case,
    given: Vec<Option<Given>>,
    samples: (&str, &str, Option<String>),
    double_double: bool,
    draw: (u64, u64),
    threads: Option<usize>,
) -> PyResult<(Vec<String>, Vec<(Bound<'py, PyByteArray>, Option<String>, Option<Problem>)>)> {
    let (time, every, text) = samples;
    let inner = Arc::clone(&case.inner);
    moving(py, &inner)?;
    let (time, every) = (start::number(time)?, start::number(every)?);
    let columns = columns(py, &inner, text.as_deref())?;
    let titles = columns.titles().to_vec();
    let starts = starts(py, &inner, &given, draw)?;
    let precision = if double_double { Precision::Pair } else { Precision::Float };
    let work = Work::on(threads);
    let count = work.threads();
    let found = work.alone(py, move || {
        let sampling = Sampling { columns: &columns, every, with_steps: false };
        let followed = (&time, precision);
        let sampling = Some(&sampling);
        liouville_flow::orbits(&inner, &starts, followed, sampling, count, &|_| ())
    })?;
    let mut all = Vec::new();
    for (index, one) in found.into_iter().enumerate() {
        let rows = bytes(py, one.rows.iter().flatten().map(|x| x.hi));
        let (told, wrong) = match &one.orbit {
            Ok(found) => {
                let told = orbit::json(&case.inner, found, precision);
                (Some(told.map_err(|error| errors::of_output(&error))?), None)
            }
            Err(error) => (None, Some(problem(index, error))),
        };
        all.push((rows, told, wrong));
    }
    Ok((titles, all))
}

fn direction(text: Option<&str>) -> PyResult<Option<Direction>> {
    text.map(str::parse).transpose().map_err(PyValueError::new_err)
}

/// Choices for a section as Python gives them: angle, energy, starts.
type Place = (Option<String>, Option<String>, Vec<Given>);

fn choice((g0, energy, given): Place, seed: u64) -> PyResult<SectionChoice> {
    Ok(SectionChoice {
        g0: g0.map(|text| text.parse()).transpose().map_err(PyValueError::new_err)?,
        energy: energy.as_deref().map(start::number).transpose()?,
        starts: given.iter().map(start::point).collect::<PyResult<_>>()?,
        seed,
        ..SectionChoice::default()
    })
}

/// Crossings of the section g = g₀ of a rolling body.
#[pyfunction]
pub fn section<'py>(
    py: Python<'py>,
    case: &Case,
    place: Place,
    counts: (Option<usize>, Option<usize>, Option<usize>),
    course: (Option<&str>, bool),
    seed: u64,
    threads: Option<usize>,
) -> PyResult<(Data<'py>, Vec<Problem>)> {
    let (orbits, crossings, skip) = counts;
    let (way, backwards) = course;
    let inner = Arc::clone(&case.inner);
    moving(py, &inner)?;
    let direction = direction(way)?;
    let choice =
        SectionChoice { orbits, crossings, skip, direction, backwards, ..choice(place, seed)? };
    let request = choice.request(&inner).map_err(|error| errors::of_choice(py, &error))?;
    let work = Work::on(threads);
    let count = work.threads();
    let found =
        work.alone(py, move || liouville_flow::section(&inner, &request, count, &|_| ()))?;
    let found = found.map_err(|error| errors::of_flow(py, &error))?;
    Ok(of_section(py, &found))
}

/// Crossings of a section as data, with the problems of its motions.
pub type Crossings<'py> = (Data<'py>, Vec<Problem>);

/// Crossings of the section g = g₀ as data.
pub fn of_section<'py>(py: Python<'py>, orbits: &[SectionOrbit]) -> Crossings<'py> {
    let rows = orbits.iter().enumerate().flat_map(|(index, orbit)| {
        orbit.crossings.iter().flat_map(move |met| {
            let direction = if met.rising { 1.0 } else { -1.0 };
            [index as f64, direction, met.time, met.at[0], met.at[1]]
        })
    });
    let names = ["start", "direction", "t", "l", "L/G"].map(str::to_string).to_vec();
    let problems = orbits
        .iter()
        .enumerate()
        .filter_map(|(index, orbit)| orbit.problem.as_ref().map(|error| problem(index, error)));
    ((names, bytes(py, rows)), problems.collect())
}

/// Crossings of a surface by the motions of any system.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "each is an argument of the Python function")]
pub fn surface<'py>(
    py: Python<'py>,
    case: &Case,
    texts: (String, Option<String>),
    launch: (Option<String>, Vec<Option<Given>>),
    counts: (usize, usize),
    course: (Option<&str>, bool),
    seed: u64,
    threads: Option<usize>,
) -> PyResult<(Data<'py>, Vec<Problem>)> {
    let (way, backwards) = course;
    let (surface, axes) = texts;
    let (energy, given) = launch;
    let (crossings, skip) = counts;
    let inner = Arc::clone(&case.inner);
    moving(py, &inner)?;
    let read = CrossingSurface::read(Lexicon::new(&inner), &surface);
    let surface = read.map_err(|mistake| errors::of_mistake(py, "surface", &surface, &mistake))?;
    let axes = axes.unwrap_or_else(|| surface.default_axes());
    let axes = columns(py, &inner, Some(&axes))?;
    let direction = direction(way)?.unwrap_or_default();
    let energy = energy.as_deref().map(start::number).transpose()?;
    let pad = Some(Launchpad { surface: &surface, axes: &axes, direction });
    let fixed: Vec<Fixed> = energy.into_iter().map(Fixed::energy).collect();
    let launches = Launches { case: &inner, fixed: &fixed, pad, seed, index: 0 };
    let mut starts = Vec::new();
    for (place, one) in given.iter().enumerate() {
        let begin = match one {
            None => Begin::Drawn(place as u64),
            Some(Given::Named(text)) => Begin::State(start::state(&inner, text)?),
            Some(Given::Listed(texts)) if texts.len() == inner.model.dimension() => {
                Begin::State(start::numbers(texts)?)
            }
            Some(Given::Listed(texts)) if texts.len() == axes.titles().len() => {
                Begin::Axes(start::numbers(texts)?)
            }
            Some(Given::Listed(texts)) => return Err(start::misfit(&inner, texts.len())),
        };
        starts.push(launches.start(&begin));
    }
    let titles = axes.titles().to_vec();
    let work = Work::on(threads);
    let count = work.threads();
    let found = work.alone(py, move || {
        let request = SurfaceRequest {
            surface: &surface,
            axes: &axes,
            direction,
            crossings,
            skip,
            backwards,
        };
        liouville_flow::surface_section(&inner, &request, &starts, count, &|_| ())
    })?;
    let found = found.map_err(|error| errors::of_flow(py, &error))?;
    Ok(of_surface(py, titles, &found))
}

/// Crossings of a surface as data, with these titles of the axes.
pub fn of_surface<'py>(
    py: Python<'py>,
    titles: Vec<String>,
    orbits: &[SurfaceOrbit],
) -> Crossings<'py> {
    let rows = orbits.iter().enumerate().flat_map(|(index, orbit)| {
        orbit.crossings.iter().flat_map(move |met| {
            let direction = if met.rising { 1.0 } else { -1.0 };
            [index as f64, direction, met.time].into_iter().chain(met.at.iter().copied())
        })
    });
    let problems = orbits
        .iter()
        .enumerate()
        .filter_map(|(index, orbit)| orbit.problem.as_ref().map(|error| problem(index, error)));
    let first = ["start", "direction", "t"].map(str::to_string).into_iter();
    ((first.chain(titles).collect(), bytes(py, rows)), problems.collect())
}

/// Names and values of the axes of a chart, and its cells: class, exponent, error, divergence.
pub type Chart<'py> =
    ([(String, Bound<'py, PyByteArray>); 2], Bound<'py, PyByteArray>, Vec<Problem>);

/// Classifies the motions of a plane.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "each is an argument of the Python function")]
pub fn chart<'py>(
    py: Python<'py>,
    case: &Case,
    texts: (&str, &str),
    size: [usize; 2],
    time: f64,
    place: Place,
    state: Option<&str>,
    seed: u64,
    threads: Option<usize>,
) -> PyResult<Chart<'py>> {
    let (x, y) = texts;
    let inner = Arc::clone(&case.inner);
    moving(py, &inner)?;
    let axis = |argument: &str, text: &str, count: usize| {
        ChartAxis::read(&inner, text, count)
            .map_err(|mistake| errors::of_axis(py, argument, text, &mistake))
    };
    let ((x_name, x), (y_name, y)) = (axis("x", x, size[0])?, axis("y", y, size[1])?);
    if x.coordinate == y.coordinate {
        let message = format!("`{y_name}` varies along both axes: name another");
        return Err(PyValueError::new_err(message));
    }
    let state = state.map(|text| start::state(&inner, text)).transpose()?;
    let axes = [x, y];
    let launch = choice(place, seed)?.launch(&inner, &axes, state);
    let launch = launch.map_err(|error| errors::of_choice(py, &error))?;
    let request = PlaneRequest { axes: axes.clone(), launch, time, seed };
    let work = Work::on(threads);
    let count = work.threads();
    let cells = work.alone(py, move || liouville_flow::plane(&inner, &request, count, &|_| ()))?;
    let cells = cells.map_err(|error| errors::of_flow(py, &error))?;
    Ok(of_chart(py, [x_name, y_name], &axes, &cells))
}

/// Cells of a chart as data.
pub fn of_chart<'py>(
    py: Python<'py>,
    [x_name, y_name]: [String; 2],
    axes: &[ChartAxis; 2],
    cells: &[Result<Exponents, FlowError>],
) -> Chart<'py> {
    let [x, y] = axes.each_ref().map(|axis| {
        let at = |index: usize| axis.value(index).to_f64().0;
        bytes(py, (0..axis.count).map(at))
    });
    let numbers = cells.iter().flat_map(|cell| match cell {
        Ok(found) => {
            let class = Character::ALL.iter().position(|own| *own == found.character);
            let class = class.map_or(f64::NAN, |class| class as f64);
            [class, found.largest.mean, found.largest.error, found.divergence.mean]
        }
        Err(
            FlowError::Singular { .. }
            | FlowError::RunsAway { .. }
            | FlowError::Slides { .. }
            | FlowError::TooShort { .. }
            | FlowError::Overflow(_)
            | FlowError::Shrinking { .. }
            | FlowError::Endless { .. },
        ) => [BROKEN, f64::NAN, f64::NAN, f64::NAN],
        Err(_) => [NO_START, f64::NAN, f64::NAN, f64::NAN],
    });
    let numbers = bytes(py, numbers);
    let problems = cells.iter().enumerate();
    let problems = problems.filter_map(|(index, cell)| Some(problem(index, cell.as_ref().err()?)));
    ([(x_name, x), (y_name, y)], numbers, problems.collect())
}

/// Lyapunov exponents of motions with the same parameters; returns what `exponents --json` prints.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "each is an argument of the Python function")]
pub fn exponents(
    py: Python<'_>,
    case: &Case,
    given: Vec<Option<Given>>,
    names: Vec<String>,
    time: f64,
    modes: (bool, bool),
    draw: (u64, u64),
    threads: Option<usize>,
) -> PyResult<String> {
    let (spectrum, both_ways) = modes;
    let inner = Arc::clone(&case.inner);
    moving(py, &inner)?;
    let starts = starts(py, &inner, &given, draw)?;
    let work = Work::on(threads);
    let count = work.threads();
    let found = work.alone(py, move || {
        let title = &inner.title;
        if spectrum {
            let found = liouville_flow::spectra(&inner.model, &starts, time, count, &|_| ())?;
            return Ok(written::spectra_json(title, &names, &found));
        }
        let parameters = starts.iter().flatten().next().map(|start| start.parameters.clone());
        let parameters: Vec<Rational> = parameters.unwrap_or_default();
        let motions = Variational::all(&inner.model, &parameters, &starts)?;
        let forward = motions.all_exponents(time, count, &|_| ());
        let backward = both_ways.then(|| motions.all_exponents(-time, count, &|_| ()));
        Ok(written::json(title, &written::rows(names, forward, backward)))
    })?;
    let found = found.map_err(|error: FlowError| errors::of_flow(py, &error))?;
    found.map_err(|error| errors::of_output(&error))
}
