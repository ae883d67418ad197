//! The command `liouville motion section --section`: crossings of a surface by any system.

use crate::report::data::DataTable;
use crate::report::facts;
use crate::report::sha256;
use crate::report::surface::{SurfaceReport, plot};
use liouville::case::{Case, Direction};
use liouville::number::double_double::DoubleDouble;
use liouville::part::Part;
use liouville_flow::{
    Begin, Columns, CrossingSurface, Fixed, FlowError, Launches, Launchpad, Lexicon, Precision,
    SurfaceOrbit, SurfaceRequest,
};

use super::Progress;
use super::motion::{MotionArgs, whole, wrong_formula};
use super::section::{Drawn, SectionArgs, Unit, Wish};
use super::starts::{GivenStart, misfit};

/// Default numbers of orbits and of crossings.
const ORBITS: usize = 12;
const CROSSINGS: usize = 500;

/// Follows the motions of a part through the surface of `--section`.
pub fn compute(
    case: &Case,
    subject: &MotionArgs,
    options: &SectionArgs,
    wish: Wish,
    (part, threads): (Part, usize),
) -> Result<Vec<Unit>, String> {
    let told = |error: FlowError| subject.told(&error);
    if case.model.system.has_arbitrary_function() {
        return Err(told(FlowError::Arbitrary));
    }
    let plan = Plan::read(case, options)?;
    if wish.is_picture() && plan.axes.titles().len() < 2 {
        return Err("error: a picture needs two axes\nhelp: write --axes 'y, z'".to_string());
    }
    let begins = plan.begins(case, options)?;
    let fixed = options.crossing.plane.fixed(case)?;
    let launches = plan.launches(case, (&fixed, options));
    let own = part.of(&begins);
    let starts: Vec<_> = own.iter().map(|(_, begin)| launches.start(begin)).collect();
    let names = own.iter().map(|(name, _)| name.clone());
    if starts.iter().all(Result::is_err) && part != Part::WHOLE {
        // other parts may have starts: the whole decides whether that is a failure
        let ended = starts.into_iter().map(|start| SurfaceOrbit {
            crossings: Vec::new(),
            others: 0,
            tangencies: 0,
            steps: 0,
            drift: None,
            problem: start.err(),
        });
        return Ok(names.zip(ended).map(|(start, orbit)| Unit::Surface { start, orbit }).collect());
    }
    let bar = Progress::of(starts.len() as u64, "orbits");
    let request = plan.request(options);
    let orbits =
        liouville_flow::surface_section(case, &request, &starts, threads, &|share| bar.add(share));
    bar.finish();
    let orbits = orbits.map_err(told)?;
    Ok(names.zip(orbits).map(|(start, orbit)| Unit::Surface { start, orbit }).collect())
}

/// Section of one case by the surface of `--section`.
pub fn drawn(
    case: &Case,
    subject: &MotionArgs,
    options: &SectionArgs,
    wish: Wish,
    units: Vec<Unit>,
) -> Result<Drawn, String> {
    let plan = Plan::read(case, options)?;
    let (axes, request) = (&plan.axes, plan.request(options));
    let motion = |unit| match unit {
        Unit::Surface { start, orbit } => Some((start, orbit)),
        Unit::Andoyer { .. } => None,
    };
    let (names, orbits): (Vec<String>, Vec<SurfaceOrbit>) =
        units.into_iter().filter_map(motion).unzip();
    if orbits.iter().all(|orbit| orbit.crossings.is_empty())
        && let Some(problem) = orbits.iter().find_map(|orbit| orbit.problem.as_ref())
    {
        return Err(subject.told(problem));
    }
    let cells = options.shade.then(|| options.ink.cells(wish.columns, 0.62));
    let report = SurfaceReport { case, request: &request, names: &names, orbits: &orbits };
    let fixed = options.crossing.plane.fixed(case)?;
    let fixed =
        fixed.iter().map(|own| facts::equation(own.function.name(), &own.value.to_string()));
    let section = facts::section(Some(request.surface.text()));
    Ok(Drawn {
        title: case.title.clone(),
        facts: facts::listed(
            [section].into_iter().chain(fixed).chain(facts::parameters(case, &[])),
        ),
        text: match options.subject.json {
            true => report.json().map_err(|error| format!("error: {error}"))?,
            false => report.text(),
        },
        plot: wish.is_picture().then(|| plot(axes.titles(), &orbits, cells)),
        data: wish.is_data().then(|| data(axes, &orbits)),
    })
}

/// Titles of the axes.
pub fn axes(case: &Case, options: &SectionArgs) -> Result<Vec<String>, String> {
    Ok(Plan::read(case, options)?.axes.titles().to_vec())
}

/// Number of the motions, and what is asked for.
pub fn request_text(case: &Case, options: &SectionArgs) -> Result<(usize, String), String> {
    let plan = Plan::read(case, options)?;
    let begins = plan.begins(case, options)?;
    let SurfaceRequest { direction, crossings, skip, backwards, .. } = plan.request(options);
    let (surface, axes) = (plan.surface.text(), plan.axes.titles());
    let starts = sha256(&format!("{begins:?}"));
    let request = format!(
        "surface {surface:?} axes {axes:?} {direction:?} crossings {crossings} skip {skip} \
         backwards {backwards} {:?} starts sha256:{starts}",
        options.crossing.plane
    );
    Ok((begins.len(), request))
}

/// Surface of a section with its axes.
struct Plan {
    surface: CrossingSurface,
    axes: Columns,
    direction: Direction,
}

impl Plan {
    fn read(case: &Case, options: &SectionArgs) -> Result<Self, String> {
        refuse_others(options)?;
        let surface = read_surface(case, options.crossing.section.as_deref().unwrap_or_default())?;
        let axes = read_axes(case, &surface, options.crossing.axes.as_deref())?;
        Ok(Self { surface, axes, direction: options.crossing.direction.unwrap_or_default() })
    }

    fn request(&self, options: &SectionArgs) -> SurfaceRequest<'_> {
        SurfaceRequest {
            surface: &self.surface,
            axes: &self.axes,
            direction: self.direction,
            crossings: options.crossing.crossings.unwrap_or(CROSSINGS),
            skip: options.crossing.skip.unwrap_or(0),
            backwards: options.backwards,
        }
    }

    fn launches<'p>(
        &'p self,
        case: &'p Case,
        (fixed, options): (&'p [Fixed], &SectionArgs),
    ) -> Launches<'p> {
        let Self { surface, axes, direction } = self;
        Launches {
            case,
            fixed,
            pad: Some(Launchpad { surface, axes, direction: *direction }),
            seed: options.subject.seed,
            index: 0,
        }
    }

    /// Beginnings of the motions, with their names.
    fn begins(&self, case: &Case, options: &SectionArgs) -> Result<Vec<(String, Begin)>, String> {
        let mut begins = Vec::new();
        for (name, given) in options.starts.read(case)? {
            begins.push((name, begin(case, &self.axes, given)?));
        }
        let drawn = options.orbits.unwrap_or(if begins.is_empty() { ORBITS } else { 0 });
        let drawn = (0..drawn as u64).map(|index| (format!("drawn {index}"), Begin::Drawn(index)));
        begins.extend(drawn);
        match begins.is_empty() {
            true => Err(
                "error: there is no motion to follow\nhelp: give --start, or --orbits 1 or more"
                    .to_string(),
            ),
            false => Ok(begins),
        }
    }
}

/// Refuses options of the Andoyer-like variables.
fn refuse_others(options: &SectionArgs) -> Result<(), String> {
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
pub fn read_surface(case: &Case, text: &str) -> Result<CrossingSurface, String> {
    let read = CrossingSurface::read(Lexicon::new(case), text);
    read.map_err(|mistake| wrong_formula("--section", text, &mistake))
}

pub fn read_axes(
    case: &Case,
    surface: &CrossingSurface,
    text: Option<&str>,
) -> Result<Columns, String> {
    let free = surface.default_axes();
    let text = text.unwrap_or(&free);
    let read = Columns::read(Lexicon::new(case), text);
    read.map_err(|mistake| wrong_formula("--axes", text, &mistake))
}

/// A whole state, or values of the axes.
pub fn begin(case: &Case, axes: &Columns, given: GivenStart) -> Result<Begin, String> {
    match given {
        GivenStart::State(state) => Ok(Begin::State(state)),
        GivenStart::Values(values) if values.len() == axes.titles().len() => {
            Ok(Begin::Axes(values))
        }
        GivenStart::Values(values) => {
            let otherwise = format!("the values of {}", axes.titles().join(", "));
            Err(misfit(case, values.len(), Some(&otherwise)))
        }
    }
}

/// Crossings as data.
fn data(axes: &Columns, orbits: &[SurfaceOrbit]) -> DataTable<'static> {
    let rows = orbits.iter().enumerate().flat_map(|(index, orbit)| {
        orbit.crossings.iter().map(move |crossing| {
            let direction = if crossing.rising { 1.0 } else { -1.0 };
            let numbers = [direction, crossing.time].into_iter().chain(crossing.at.clone());
            [whole(index)].into_iter().chain(numbers.map(DoubleDouble::from_f64)).collect()
        })
    });
    let first = ["start", "direction", "t"].map(str::to_string).into_iter();
    DataTable {
        columns: first.chain(axes.titles().iter().cloned()).collect(),
        whole: 2,
        rows: rows.collect(),
        precision: Precision::Float,
    }
}
