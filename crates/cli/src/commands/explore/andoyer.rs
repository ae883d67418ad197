//! Sections g = g₀ of rolling bodies, in the Andoyer-like variables.

use crate::report::data::DataTable;
use crate::report::exponents;
use crate::report::facts;
use crate::report::section::SectionReport;
use crate::report::section::drawing::{self, Colouring};
use crate::report::sha256;
use liouville::case::{Case, Direction, Expect, FixedLine};
use liouville::claim::motion::MotionKind;
use liouville::number::double_double::DoubleDouble;
use liouville::part::Part;
use liouville_draw::{Plot, Text};
use liouville_flow::{FlowError, Precision, SectionChoice, SectionOrbit, SectionRequest};

use super::Progress;
use super::motion::{MotionArgs, whole, wrong_choice};
use super::section::{Drawn, SectionArgs, Unit, Wish};
use super::starts::GivenStart;

/// Number of points of a line whose images are drawn, and default number of images.
const LINE_POINTS: usize = 800;
const IMAGES: usize = 10;
/// Word of --colour for one colour.
const ONE: &str = "one";

/// Message that a section has no motions.
fn nothing() -> String {
    "error: there is no motion to follow\nhelp: give --start l,L/G, or --orbits 1 or more"
        .to_string()
}

/// Follows the motions of a part through g = g₀.
pub fn compute(
    case: &Case,
    subject: &MotionArgs,
    options: &SectionArgs,
    (part, threads): (Part, usize),
) -> Result<Vec<Unit>, String> {
    let told = |error: FlowError| subject.told(&error);
    if !liouville_flow::has_andoyer_section(&case.model) {
        return Err(told(FlowError::NoAndoyer));
    }
    let whole = request(case, options, given(case, options)?)?;
    let request = SectionRequest { starts: part.of(&whole.starts).to_vec(), ..whole };
    if request.starts.is_empty() && part != Part::WHOLE {
        return Ok(Vec::new());
    }
    let draws_curves = !options.lines.is_empty() || !options.separatrices.is_empty();
    let plans_lines = case.section.as_ref().is_some_and(|plan| !plan.lines.is_empty());
    if request.starts.is_empty() && !draws_curves && !plans_lines {
        return Err(nothing());
    }
    let follow = |request: &SectionRequest| {
        let bar = Progress::of(request.starts.len() as u64, "orbits");
        let found =
            liouville_flow::section(case, request, threads, &|share| bar.add(share)).map_err(told);
        bar.finish();
        found
    };
    let orbits = follow(&request)?;
    let mut others = match options.both_ways {
        true => follow(&SectionRequest { backwards: !request.backwards, ..request.clone() })?,
        false => Vec::new(),
    }
    .into_iter();
    let mut classes = match options.classes {
        None => Vec::new(),
        Some(time) => classes(case, &request, time, threads).map_err(told)?,
    }
    .into_iter();
    let unit = |orbit| {
        let (other, class) = (others.next().map(Box::new), classes.next().map(Box::new));
        Unit::Andoyer { orbit, other, class }
    };
    Ok(orbits.into_iter().map(unit).collect())
}

/// Number of the motions, and what is asked for.
pub fn request_text(case: &Case, options: &SectionArgs) -> Result<(usize, String), String> {
    let request = request(case, options, given(case, options)?)?;
    let starts = sha256(&format!("{:?}", request.starts));
    let count = request.starts.len();
    let request = SectionRequest { starts: Vec::new(), ..request };
    let (both_ways, classes) = (options.both_ways, options.classes);
    let text = format!("{request:?} {both_ways} {classes:?} starts sha256:{starts}");
    Ok((count, text))
}

/// Section g = g₀ of one case.
pub fn drawn(
    case: &Case,
    subject: &MotionArgs,
    options: &SectionArgs,
    wish: Wish,
    units: Vec<Unit>,
) -> Result<Drawn, String> {
    let told = |error: FlowError| subject.told(&error);
    let threads = options.threads.count();
    let (mut orbits, mut other, mut classes) = (Vec::new(), Vec::new(), Vec::new());
    for unit in units {
        if let Unit::Andoyer { orbit, other: back, class } = unit {
            orbits.push(orbit);
            other.extend(back.map(|own| *own));
            classes.extend(class.map(|own| *own));
        }
    }
    let other = options.both_ways.then_some(other);
    let classes = options.classes.is_some().then_some(classes);
    let starts = orbits.iter().map(|orbit| orbit.start).collect();
    let request = SectionRequest { starts, ..request(case, options, Vec::new())? };
    let colour =
        options.colour.clone().or(case.section.as_ref().and_then(|plan| plan.colour.clone()));
    let colour = colour.filter(|_| !options.both_ways && !options.shade);
    let shades = match &colour {
        Some(name) if name != ONE => {
            Some(liouville_flow::values_at_starts(case, &request, name).map_err(told)?)
        }
        _ => None,
    };
    let mut plot = None;
    if wish.is_picture() {
        let mut drawn = drawing::plane();
        match (&other, colour.as_deref(), &shades) {
            (Some(other), ..) => drawing::draw_both(&mut drawn, &orbits, other),
            (_, Some(name), Some(values)) => {
                drawing::draw_orbits(&mut drawn, &orbits, Colouring::Values(name, values));
            }
            (_, Some(_), None) => drawing::draw_orbits(&mut drawn, &orbits, Colouring::One),
            _ if options.shade => {
                let cells = options.ink.cells(wish.columns, drawn.aspect);
                drawing::shade_density(&mut drawn, &orbits, cells);
            }
            _ => drawing::draw_orbits(&mut drawn, &orbits, Colouring::Orbits),
        }
        drawing::draw_lines(&mut drawn, &images(case, &request, options, threads).map_err(told)?);
        let near = options.separatrices.iter();
        let curves: Result<Vec<_>, FlowError> = near
            .map(|(near, period)| {
                liouville_flow::separatrices(case, &request, *near, *period, threads)
            })
            .collect();
        drawing::draw_separatrices(&mut drawn, &curves.map_err(told)?);
        if !options.no_marks && options.subject.settings.is_empty() {
            mark_claimed(&mut drawn, case, &request).map_err(told)?;
        }
        plot = Some(drawn);
    }
    let areas = liouville_flow::area_forms(case, &request).map_err(told)?;
    // A picture without any crossing is a failure; single orbits may fail.
    let empty = orbits.iter().all(|orbit| orbit.crossings.is_empty());
    // Of several starts below the potential, the lowest potential shows how much energy is missing.
    let missing = |problem: &&FlowError| match problem {
        FlowError::BelowPotential { potential, .. } => *potential,
        _ => f64::NEG_INFINITY,
    };
    let problems = orbits.iter().filter_map(|orbit| orbit.problem.as_ref());
    if let Some(problem) = problems.min_by(|a, b| missing(a).total_cmp(&missing(b)))
        && empty
    {
        return Err(subject.told(problem));
    }
    let report = SectionReport {
        case,
        request: &request,
        orbits: &orbits,
        areas: &areas,
        classes: classes.as_deref(),
    };
    let text = match options.subject.json {
        true => report.json().map_err(|error| format!("error: {error}"))?,
        false => report.text() + &other.map_or(String::new(), |other| backwards_line(&other)),
    };
    let data = wish.is_data().then(|| data(&orbits));
    Ok(Drawn { title: case.title.clone(), facts: caption(case, &request), text, plot, data })
}

/// Caption with the subject and the parameters.
fn caption(case: &Case, request: &SectionRequest) -> Text {
    let first = [
        facts::equation("g_0", &request.g0.to_string()),
        facts::equation("h", &request.energy.to_string()),
    ];
    facts::listed(first.into_iter().chain(facts::parameters(case, &[])))
}

fn backwards_line(orbits: &[SectionOrbit]) -> String {
    let crossings: usize = orbits.iter().map(|orbit| orbit.crossings.len()).sum();
    let worst = orbits.iter().map(|orbit| orbit.drift).fold(0.0, f64::max);
    format!(
        "the other way in time: {crossings} crossings, largest drift of the energy {worst:.1e}\n"
    )
}

/// Marks the periodic points that the case claims on its own section.
fn mark_claimed(plot: &mut Plot, case: &Case, request: &SectionRequest) -> Result<(), FlowError> {
    let is_own = case.section.as_ref().is_some_and(|plan| {
        plan.g0.to_string() == request.g0.to_string() && plan.energy == request.energy
    });
    for claim in case.motions.iter().filter(|claim| is_own && claim.expect == Expect::Holds) {
        let MotionKind::PeriodicPoint(point) = &claim.kind else { continue };
        let Some(stability) = point.stability else { continue };
        let at = [point.at[0].value, point.at[1].value];
        let mut all = vec![at];
        if point.period > 1 {
            let (starts, crossings, skip) = (vec![at], point.period - 1, 0);
            let request =
                SectionRequest { starts, crossings, skip, backwards: false, ..request.clone() };
            let images = liouville_flow::section(case, &request, 1, &|_| ())?;
            all.extend(images.iter().flat_map(|orbit| &orbit.crossings).map(|met| met.at));
        }
        drawing::mark(plot, stability, &all);
    }
    Ok(())
}

/// Classifies the orbits by their exponents, followed in both directions of time.
fn classes(
    case: &Case,
    request: &SectionRequest,
    time: f64,
    threads: usize,
) -> Result<Vec<exponents::MotionRow>, FlowError> {
    let starts = liouville_flow::section_starts(
        case,
        &request.g0,
        &request.energy,
        &request.starts,
        request.seed,
    )?;
    let parameters = liouville_flow::fixed_parameters(case, request.seed, request.index)?;
    let motions = liouville_flow::Variational::all(&case.model, &parameters, &starts)?;
    let time = if request.backwards { -time } else { time };
    let bar = Progress::of(2 * starts.len() as u64, "motions");
    let follow = |time| motions.all_exponents(time, threads, &|share| bar.add(share));
    let (forward, backward) = (follow(time), follow(-time));
    bar.finish();
    let names = request.starts.iter().map(|[l, z]| format!("({l}, {z})")).collect();
    Ok(exponents::rows(names, forward, Some(backward)))
}

/// Computes the images of the requested lines, forwards and backwards.
fn images(
    case: &Case,
    request: &SectionRequest,
    options: &SectionArgs,
    threads: usize,
) -> Result<Vec<(FixedLine, Vec<SectionOrbit>)>, FlowError> {
    let plan = case.section.as_ref();
    let lines = match &options.lines[..] {
        [] => plan.map(|plan| plan.lines.clone()).unwrap_or_default(),
        given => given.to_vec(),
    };
    let crossings = options.images.or(plan.map(|plan| plan.images)).unwrap_or(IMAGES);
    let image = |line: &FixedLine| {
        let mut both = Vec::new();
        for backwards in [false, true] {
            let starts = line.points(LINE_POINTS);
            let (skip, direction) = (0, Direction::Both);
            let request =
                SectionRequest { starts, crossings, skip, direction, backwards, ..request.clone() };
            both.extend(liouville_flow::section(case, &request, threads, &|_| ())?);
        }
        Ok((*line, both))
    };
    lines.iter().map(image).collect()
}

/// Request of the command line with these starts, completed from the case.
fn request(
    case: &Case,
    options: &SectionArgs,
    starts: Vec<[f64; 2]>,
) -> Result<SectionRequest, String> {
    let choice = SectionChoice {
        direction: options.crossing.direction,
        orbits: options.orbits,
        crossings: options.crossing.crossings,
        skip: options.crossing.skip,
        starts,
        backwards: options.backwards,
        seed: options.subject.seed,
        ..options.crossing.plane.choice()?
    };
    choice.request(case).map_err(|error| wrong_choice(&error))
}

/// Points (l, L/G) of the options.
fn given(case: &Case, options: &SectionArgs) -> Result<Vec<[f64; 2]>, String> {
    let point = |(name, given): (String, GivenStart)| match given {
        GivenStart::Values(values) if values.len() == 2 => {
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
fn data(orbits: &[SectionOrbit]) -> DataTable<'static> {
    let rows = orbits.iter().enumerate().flat_map(|(index, orbit)| {
        orbit.crossings.iter().map(move |crossing| {
            let direction = if crossing.rising { 1.0 } else { -1.0 };
            let numbers = [direction, crossing.time, crossing.at[0], crossing.at[1]];
            [&[whole(index)], &numbers.map(DoubleDouble::from_f64)[..]].concat().into()
        })
    });
    DataTable {
        columns: ["start", "direction", "t", "l", "L/G"].map(str::to_string).to_vec(),
        whole: 2,
        rows: rows.collect(),
        precision: Precision::Float,
    }
}
