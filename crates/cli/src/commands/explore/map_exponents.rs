//! The command `liouville motion exponents` of a map.

use liouville::case::Case;
use liouville_flow::{Begin, FlowError, IterateError, Launches, map_exponents};

use super::exponents::ExponentsArgs;
use super::starts::{GivenStart, misfit};
use super::{Progress, write};
use crate::report::exponents::{map_json, map_text};
use liouville::verdict;

/// Number of iterates where none is given, and the least one: ten blocks of ten.
const ITERATES: u64 = 10_000;
const LEAST: u64 = 100;

/// Measures the exponents of the orbits of a map; returns the report, and whether some were stopped.
pub fn answer(options: &ExponentsArgs) -> Result<(String, bool), String> {
    let subject = &options.subject;
    let case = subject.open_with_maps()?;
    check(options)?;
    if case.model.system.has_arbitrary_function() {
        return Err(subject.told(&FlowError::Arbitrary));
    }
    let out = options.output()?;
    let count = options.iterates.unwrap_or(ITERATES);
    let (names, starts): (Vec<String>, Vec<_>) = begins(&case, options)?.into_iter().unzip();
    let fixed = options.plane.fixed(&case)?;
    let launches = Launches { case: &case, fixed: &fixed, pad: None, seed: subject.seed, index: 0 };
    let starts: Vec<_> = starts.iter().map(|begin| launches.start(begin)).collect();
    let bar = Progress::of(starts.len() as u64, "orbits");
    let found =
        map_exponents(&case, &starts, count, options.threads.count(), &|share| bar.add(share));
    bar.finish();
    // Single orbits may end early, but not all.
    if let Some(Err(first)) = found.first()
        && found.iter().all(Result::is_err)
    {
        return Err(options.subject.of_iterates(first));
    }
    let json = map_json(&case.title, &names, &found, options.spectrum);
    let json = json.map_err(|error| format!("error: {error}"))? + "\n";
    if let Some(out) = out {
        write(&out.path, "--out", &json)?;
    }
    let text = match subject.json {
        true => json,
        false => map_text(&case.title, &names, &found, options.spectrum),
    };
    let is_stopped = |one: &Result<_, _>| matches!(one, Err(IterateError::Stopped { .. }));
    Ok((text, found.iter().any(is_stopped)))
}

/// Refuses what maps do not have.
fn check(options: &ExponentsArgs) -> Result<(), String> {
    if options.time.is_some() {
        return Err("error: --time: the case is a map, which has iterates and no time\n\
                    help: give the number of iterates: --iterates 10000"
            .to_string());
    }
    if options.share.part.is_some() {
        return Err("error: --part: exponents of a map are computed at once\n\
                    help: leave it out, and give fewer starts"
            .to_string());
    }
    match options.iterates {
        Some(count) if count < LEAST => Err(format!(
            "error: --iterates: {count} iterates are too few for an error of the exponents\n\
             help: write {LEAST} or more"
        )),
        _ => Ok(()),
    }
}

/// Beginnings of the orbits, with their names.
fn begins(case: &Case, options: &ExponentsArgs) -> Result<Vec<(String, Begin)>, String> {
    if let Some(text) = &options.state {
        let state = verdict::read_state(case, text);
        let state = state.map_err(|error| format!("error: --state: {error}"))?;
        return Ok(vec![("state".to_string(), Begin::State(state))]);
    }
    let begin = |(name, given): (String, GivenStart)| match given {
        GivenStart::State(state) => Ok((name, Begin::State(state))),
        GivenStart::Values(values) => Err(misfit(case, values.len(), None)),
    };
    let given: Vec<_> =
        options.starts.read(case)?.into_iter().map(begin).collect::<Result<_, _>>()?;
    match given.is_empty() {
        true => Ok(vec![("drawn".to_string(), Begin::Drawn(0))]),
        false => Ok(given),
    }
}
