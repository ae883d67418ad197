//! The command `liouville motion periodic`.

use crate::report::cycle::{self, FoundOrbit};
use clap::Args;
use liouville::case::Case;
use liouville::number::rational::Rational;
use liouville_flow::{
    Begin, CrossingSurface, FlowError, Launches, SectionMap, closed_orbit, crossing_time,
};
use serde_json::json;

use super::CommandOutput;
use super::motion::{MotionArgs, SectionPlaneArgs};
use super::starts::{GivenStart, Starts, misfit};
use super::surface::read_surface;

#[derive(Debug, Args)]
pub struct Periodic {
    #[command(flatten)]
    pub subject: MotionArgs,
    #[command(flatten)]
    pub plane: SectionPlaneArgs,
    #[command(flatten)]
    pub starts: Starts,
    /// Surface whose crossings count, for a start by its state: --section 'z = 27'
    #[arg(long, value_name = "EQUATION", conflicts_with = "g0", allow_hyphen_values = true)]
    pub section: Option<String>,
    /// Crossings of --section that count: up, down, both
    #[arg(long, requires = "section")]
    pub direction: Option<liouville::case::Direction>,
    /// Period of the point, in crossings
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub period: u32,
    /// Approximate period in time, for a start by its state, instead of counting crossings
    #[arg(long, value_name = "TIME", conflicts_with = "period")]
    pub time: Option<Rational>,
}

pub fn run(options: &Periodic) -> Result<CommandOutput, String> {
    let case = options.subject.open()?;
    let told = |error: FlowError| options.subject.told(&error);
    if case.model.system.has_arbitrary_function() {
        return Err(told(FlowError::Arbitrary));
    }
    let given = options.starts.read(&case)?;
    if given.is_empty() {
        return Err("error: there is no start\n\
                    help: give --start with a state near the orbit, or with l,L/G on the section of \
                    a rolling body"
            .to_string());
    }
    let surface = options.section.as_deref().map(|text| read_surface(&case, text)).transpose()?;
    let mut found = Vec::new();
    for (_, given) in given {
        found.push(match given {
            GivenStart::State(state) => near_state(&case, options, surface.as_ref(), state)?,
            GivenStart::Values(values) => near_point(&case, options, &values)?,
        });
    }
    let text = match options.subject.json {
        true => {
            let points: Vec<_> = found.iter().map(cycle::entry).collect();
            let root = json!({ "title": case.title, "points": points });
            serde_json::to_string_pretty(&root).map_err(|error| format!("error: {error}"))? + "\n"
        }
        false => found.iter().map(|found| cycle::text(&case, found)).collect(),
    };
    Ok(CommandOutput { text, code: 0 })
}

/// Finds the orbit through a periodic point (l, L/G) of a rolling body.
fn near_point(case: &Case, options: &Periodic, values: &[Rational]) -> Result<FoundOrbit, String> {
    let told = |error: FlowError| options.subject.told(&error);
    let (has_section, is_ours) =
        (liouville_flow::has_andoyer_section(&case.model), options.section.is_none());
    let [l, z] = values else {
        let otherwise = has_section.then_some("l,L/G on the section");
        return Err(misfit(case, values.len(), otherwise));
    };
    if !(has_section && is_ours && options.time.is_none()) {
        return Err(misfit(case, values.len(), None));
    }
    let (g0, energy) = options.plane.of(case)?;
    let map = SectionMap::new(case, &g0, &energy, options.subject.seed).map_err(told)?;
    let near = [l.to_f64().0, z.to_f64().0];
    let (point, cycle) = map.cycle(near, options.period as usize).map_err(told)?;
    Ok(FoundOrbit { point: Some(point), crossings: Some(point.period), cycle })
}

/// Finds the orbit near a state.
fn near_state(
    case: &Case,
    options: &Periodic,
    surface: Option<&CrossingSurface>,
    state: Vec<Rational>,
) -> Result<FoundOrbit, String> {
    let told = |error: FlowError| options.subject.told(&error);
    let energy = options.plane.energy.as_ref();
    let seed = options.subject.seed;
    let launches = Launches { case, energy, pad: None, seed, index: 0 };
    let start = launches.start(&Begin::State(state)).map_err(told)?;
    let count = options.period as usize;
    let (start, time, crossings) = match (surface, &options.time) {
        (_, Some(time)) if time.to_f64().0 > 0.0 => (start, time.to_f64().0, None),
        (_, Some(_)) => return Err("error: --time: write a period above 0".to_string()),
        (Some(surface), None) => {
            let direction = options.direction.unwrap_or(liouville::case::Direction::Up);
            let (start, time) = crossing_time(&start, surface, direction, count).map_err(told)?;
            (start, time, Some(count))
        }
        (None, None) => {
            return Err("error: the period of the orbit is not known\n\
                        help: give --section 'x = 0', whose crossings are counted, or --time with \
                        the approximate period"
                .to_string());
        }
    };
    let surface = surface.filter(|_| crossings.is_some());
    let cycle = closed_orbit(case, &start, time, surface).map_err(told)?;
    Ok(FoundOrbit { point: None, crossings, cycle })
}
