//! The command `liouville motion orbit` of a map: its iterates.

use std::borrow::Cow;

use crate::report::data::DataTable;
use crate::report::{facts, iterates};
use liouville::case::Case;
use liouville::number::rational::Rational;
use liouville_flow::{Columns, FlowError, IterateError, Lexicon, MapSampling, SampledMapOrbit};

use super::Progress;
use super::motion::{rendered, whole, wrong_formula};
use super::orbit::{MOST_NUMBERS, OrbitArgs, numbered, starts};
use super::output::Ending;
use super::write;

/// Number of iterates where none is given.
const ITERATES: u64 = 1000;

/// Follows the orbits of a map; returns the report, and whether some were stopped.
pub fn run(options: &OrbitArgs, case: &Case) -> Result<(String, bool), String> {
    check_options(options)?;
    let subject = &options.subject;
    if case.model.system.has_arbitrary_function() {
        return Err(subject.told(&FlowError::Arbitrary));
    }
    let inputs: Vec<_> =
        [subject.case.as_path()].into_iter().chain(options.starts.inputs()).collect();
    let out = options.ink.output(Ending::ALL, &inputs)?;
    let is_picture = out.as_ref().is_some_and(|out| out.ending.is_picture());
    let columns = columns(case, options, is_picture)?;
    let (names, starts): (Vec<_>, Vec<_>) = starts(case, options)?.into_iter().unzip();
    let count = options.iterates.unwrap_or(ITERATES);
    let every = interval(options)?;
    let numbers = (count / every) as f64 * starts.len() as f64 * columns.titles().len() as f64;
    if out.is_some() && numbers > MOST_NUMBERS {
        return Err(format!(
            "error: {numbers:.1e} numbers are too many for one file, which holds {MOST_NUMBERS:.0e}\n\
             help: give a longer --every, fewer --iterates, or fewer --columns"
        ));
    }
    let precision = options.precision.precision();
    let bar = Progress::of(starts.len() as u64, "orbits");
    let sampling = MapSampling { columns: &columns, every };
    let sampling = out.is_some().then_some(&sampling);
    let found = liouville_flow::iterates(
        case,
        &starts,
        (count, precision),
        sampling,
        options.threads.count(),
        &|share| bar.add(share),
    );
    bar.finish();
    let titles = columns.titles();
    if let Some(out) = &out {
        let bytes = match is_picture {
            true => picture(case, options, (titles, &names), &found, out.ending)?,
            false => {
                let count = found.len();
                let rows = found.iter().enumerate().flat_map(|(index, one)| {
                    one.rows.iter().map(move |row| match count {
                        1 => Cow::Borrowed(&row[..]),
                        _ => Cow::Owned([&[whole(index)], &row[..]].concat()),
                    })
                });
                let data = DataTable {
                    columns: numbered(titles, count),
                    whole: usize::from(count > 1),
                    rows: rows.collect(),
                    precision,
                };
                rendered(&data, out.ending)
            }
        };
        write(&out.path, "--out", bytes)?;
    }
    // Single orbits may end early; if all do, the command fails.
    let mut ended = found.iter().filter_map(|one| one.orbit.as_ref().err());
    let ends = ended.clone().count();
    let is_stopped = ended.clone().any(|own| matches!(own, IterateError::Stopped { .. }));
    let problem = ended.next();
    if let Some(problem) = problem.filter(|_| ends == found.len() && !is_stopped) {
        let rows: usize = found.iter().map(|one| one.rows.len()).sum();
        let saved = out.filter(|_| rows > 0);
        let saved =
            saved.map(|out| format!("\nnote: {} has what comes before", out.path.display()));
        return Err(options.subject.of_iterates(problem) + &saved.unwrap_or_default());
    }
    let orbits = || names.iter().zip(found.iter().map(|one| &one.orbit));
    let text = match (subject.json, &found[..]) {
        (true, all) => iterates::json(case, orbits(), precision, all.len() == 1)
            .map_err(|error| format!("error: {error}"))?,
        (false, [SampledMapOrbit { orbit: Ok(one), .. }]) => iterates::text(case, one, precision),
        (false, _) => iterates::text_of_several(case, orbits()),
    };
    let rows: usize = found.iter().map(|one| one.rows.len()).sum();
    let saved = out.filter(|out| !subject.json && !out.ending.is_picture()).map(|out| {
        let titles = numbered(titles, found.len()).join(", ");
        format!("{}: {rows} rows of {titles}\n", out.path.display())
    });
    Ok((text + &saved.unwrap_or_default(), is_stopped))
}

/// Refuses what maps do not have.
fn check_options(options: &OrbitArgs) -> Result<(), String> {
    if options.time.is_some() {
        return Err("error: --time: the case is a map, which has iterates and no time\n\
                    help: give the number of iterates: --iterates 1000"
            .to_string());
    }
    if options.track {
        return Err("error: --track: a map has no contact point\n\
                    help: leave it out; a picture shows the iterates: --out FILE.png"
            .to_string());
    }
    Ok(())
}

/// Columns of samples: n and the state, and in a picture the first two components of it.
fn columns(case: &Case, options: &OrbitArgs, is_picture: bool) -> Result<Columns, String> {
    let text = options.columns.as_deref();
    let lexicon = Lexicon::new(case);
    let read = match text {
        Some(text) => Columns::read(lexicon, text),
        None if is_picture && case.model.dimension() > 1 => {
            let names = [0, 1].map(|k| case.model.component_name(k));
            Columns::read(lexicon, &names.join(", "))
        }
        None => Columns::whole_state(lexicon),
    };
    read.map_err(|mistake| wrong_formula("--columns", text.unwrap_or_default(), &mistake))
}

/// Number of iterates from one sample to the next.
fn interval(options: &OrbitArgs) -> Result<u64, String> {
    let whole = |every: &Rational| every.to_integer().and_then(|every| u64::try_from(every).ok());
    match options.every.as_ref().map(whole) {
        None => Ok(1),
        Some(Some(every)) if every > 0 => Ok(every),
        _ => Err("error: --every: samples of a map are iterates\n\
                  help: write a whole number from 1 on: every how many iterates one is taken"
            .to_string()),
    }
}

fn picture(
    case: &Case,
    options: &OrbitArgs,
    (titles, names): (&[String], &[String]),
    found: &[SampledMapOrbit],
    ending: Ending,
) -> Result<Vec<u8>, String> {
    if titles.len() > 2 && titles[0] != "n" {
        anstream::eprintln!(
            "note: the picture shows {} over {}; {} is left out",
            titles[1],
            titles[0],
            titles[2..].join(", ")
        );
    }
    let rows: Vec<_> = found.iter().map(|one| &one.rows[..]).collect();
    let plot = iterates::plot(titles, names, &rows).ok_or_else(|| {
        "error: a picture needs two columns\nhelp: write --columns 'n, x'".to_string()
    })?;
    let count = options.iterates.unwrap_or(ITERATES);
    let range = facts::equation("n", &format!("0 … {count}"));
    let caption = facts::listed([range].into_iter().chain(facts::parameters(case, &[])));
    options.ink.drawn((case.title.as_str(), vec![caption]), vec![plot], 1, ending)
}
