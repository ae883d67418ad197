//! The command `liouville motion periodic` of a map: its periodic points.

use crate::report::map_points::{BoxReport, json, text};
use liouville::case::Case;
use liouville::mechanics::Draw;
use liouville_flow::{
    FlowError, MapBox, MapPoint, PointDoubt, StateAxis, fixed_parameters, map_point, map_points,
};

use super::CommandOutput;
use super::periodic::Periodic;
use super::starts::{GivenStart, misfit};

pub fn run(options: &Periodic) -> Result<CommandOutput, String> {
    check(options)?;
    let search = &options.search;
    let subject = &search.subject;
    let case = subject.open_with_maps()?;
    if case.model.system.has_arbitrary_function() {
        return Err(subject.told(&FlowError::Arbitrary));
    }
    if !case.model.level.is_empty() {
        return Err(format!(
            "error: {}: periodic points of a map on a level are not searched for\n\
             help: write the map in coordinates of the level, without [level]",
            subject.case.display()
        ));
    }
    let told = |doubt: PointDoubt| match doubt {
        PointDoubt::Map(error) => subject.told(&error),
        other => format!(
            "error: {}: {other}\nhelp: start nearer to it, or find all in a box: --box NAME=a..b",
            subject.case.display()
        ),
    };
    let parameters =
        fixed_parameters(&case, subject.seed, 0).map_err(|error| subject.told(&error))?;
    let period = search.period as usize;
    let starts = search.starts.read(&case)?;
    if starts.is_empty() {
        let of = MapBox { ends: ends(&case, &options.ranges)?, period };
        let found = map_points(&case.model, &parameters, &of).map_err(told)?;
        let report = BoxReport { case: &case, of: &of, found: &found };
        let text = if subject.json { report.json()? } else { report.text() };
        return Ok(CommandOutput { text, code: 0 });
    }
    let point = |(_, given): &(String, GivenStart)| -> Result<MapPoint, String> {
        match given {
            GivenStart::State(state) => {
                let state: Vec<f64> = state.iter().map(|x| x.to_f64().0).collect();
                map_point(&case.model, &parameters, &state, period).map_err(told)
            }
            GivenStart::Values(values) => Err(misfit(&case, values.len(), None)),
        }
    };
    let found: Vec<MapPoint> = starts.iter().map(point).collect::<Result<_, _>>()?;
    let text = match subject.json {
        true => json(&case, &found)?,
        false => found.iter().map(|one| text(&case, one, period)).collect(),
    };
    Ok(CommandOutput { text, code: 0 })
}

/// Refuses what maps do not have.
fn check(options: &Periodic) -> Result<(), String> {
    let search = &options.search;
    let wrong = [
        ("--time", options.time.is_some()),
        ("--section", search.section.is_some()),
        ("--symmetric", !options.symmetric.is_empty()),
        ("--energy", search.plane.energy.is_some()),
        ("--fix", !search.plane.fix.is_empty()),
        ("--g0", search.plane.g0.is_some()),
        ("--numerical", options.numerical),
        ("--prove", options.prove),
    ];
    match wrong.iter().find(|(_, is_given)| *is_given) {
        Some((name, _)) => Err(format!(
            "error: {name}: the case is a map, whose points of --period n are back after n iterates\n\
             help: leave it out"
        )),
        None => Ok(()),
    }
}

/// Ends of a box: those of the options, and of the case for other components.
fn ends(case: &Case, ranges: &[String]) -> Result<Vec<[f64; 2]>, String> {
    let mut ends: Vec<Option<[f64; 2]>> = case
        .free_draws
        .iter()
        .map(|draw| match draw {
            Draw::Within(range) => Some([range.low.to_f64().0, range.high.to_f64().0]),
            _ => None,
        })
        .collect();
    ends.resize(case.model.dimension(), None);
    for text in ranges {
        let axis = StateAxis::read(case, text, 1).map_err(|mistake| {
            format!("error: --box {text}: {}\nhelp: {}", mistake.message, mistake.help)
        })?;
        let [from, to] = [&axis.from, &axis.to].map(|end| end.to_f64().0);
        ends[axis.component] = Some([from.min(to), from.max(to)]);
    }
    let named = |(place, ends): (usize, Option<[f64; 2]>)| {
        ends.ok_or_else(|| {
            let name = case.model.component_name(place);
            format!(
                "error: there is neither a start nor a box: `{name}` has no range\n\
                 help: write --box {name}=-2..2, or --start with a state near a periodic point"
            )
        })
    };
    ends.into_iter().enumerate().map(named).collect()
}
