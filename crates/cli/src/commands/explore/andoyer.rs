//! Sections g = g₀ of rolling bodies, in the Andoyer-like variables.

use crate::report::data::Data;
use crate::report::exponents;
use crate::report::facts;
use crate::report::section::SectionReport;
use crate::report::section::drawing::{self, Colouring};
use liouville::case::{Case, Direction, Expect, Line};
use liouville::claim::motion::Motion;
use liouville::number::pair::Pair;
use liouville_draw::{Plot, Text};
use liouville_flow::{FlowError, Precision, SectionChoice, SectionOrbit, SectionRequest};

use super::motion::{Subject, whole, wrong_choice};
use super::progress::progress;
use super::section::{Drawn, Section, Wish};
use super::starts::Given;

/// Number of points of a line whose images are drawn, and default number of images.
const POINTS: usize = 800;
const IMAGES: usize = 10;
/// Word of --colour for one colour.
const ONE: &str = "one";

/// Section g = g₀ of one case.
pub fn drawn(
    case: &Case,
    subject: &Subject,
    options: &Section,
    wish: Wish,
) -> Result<Drawn, String> {
    let told = |error: FlowError| subject.told(&error);
    if !liouville_flow::has_andoyer_section(&case.model) {
        return Err(told(FlowError::NoAndoyer));
    }
    let request = request(case, options)?;
    let threads = options.threads.count();
    let follow = |request: &SectionRequest| {
        let bar = progress(request.starts.len() as u64, "orbits");
        let found = liouville_flow::section(case, request, threads, &|| bar.inc(1)).map_err(told);
        bar.finish_and_clear();
        found
    };
    let orbits = follow(&request)?;
    let other = match options.both_ways {
        true => Some(follow(&SectionRequest { backwards: !request.backwards, ..request.clone() })?),
        false => None,
    };
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
    let classes = match options.classes {
        None => None,
        Some(time) => Some(classes(case, &request, time, threads).map_err(told)?),
    };
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
        let Motion::PeriodicPoint(point) = &claim.kind else { continue };
        let Some(stability) = point.stability else { continue };
        let at = [point.at[0].value, point.at[1].value];
        let mut all = vec![at];
        if point.period > 1 {
            let (starts, crossings, skip) = (vec![at], point.period - 1, 0);
            let request =
                SectionRequest { starts, crossings, skip, backwards: false, ..request.clone() };
            let images = liouville_flow::section(case, &request, 1, &|| ())?;
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
) -> Result<Vec<(Line, Vec<SectionOrbit>)>, FlowError> {
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
        Ok((*line, both))
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
