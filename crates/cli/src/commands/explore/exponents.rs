//! The command `liouville motion exponents`.

use crate::report::exponents;
use clap::Args;
use liouville::case::Case;
use liouville::number::rational::Rational;
use liouville::verdict;
use liouville_flow::{Begin, FlowError, Launches, Start};

use super::Answer;
use super::motion::{Plane, Subject, Threads};
use super::progress::progress;
use super::starts::{Given, Starts, misfit};

#[derive(Debug, Args)]
pub struct Exponents {
    #[command(flatten)]
    pub subject: Subject,
    #[command(flatten)]
    pub plane: Plane,
    /// Time to follow each motion; negative: backwards. Transients last long: after a short time a
    /// regular motion may look chaotic
    #[arg(long, default_value = "2000", allow_hyphen_values = true)]
    pub time: f64,
    #[command(flatten)]
    pub starts: Starts,
    /// Start by exact numbers instead: --state 'ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]'
    #[arg(long, value_name = "STATE", conflicts_with_all = ["start", "starts"])]
    pub state: Option<String>,
    /// Measure all exponents, one for each dimension of the level, forwards in time
    #[arg(long)]
    pub spectrum: bool,
    /// Follow the motion in one direction of time only: half the work, and a coarser class
    #[arg(long)]
    pub one_way: bool,
    #[command(flatten)]
    pub threads: Threads,
}

pub fn run(options: &Exponents) -> Result<Answer, String> {
    let subject = &options.subject;
    let case = subject.open()?;
    let told = |error: FlowError| subject.told(&error);
    if options.time == 0.0 || !options.time.is_finite() {
        return Err("error: --time: write a number that is not 0".to_string());
    }
    let (names, starts) = starts(&case, options)?;
    let parameters = match starts.iter().flatten().next() {
        Some(start) => start.parameters.clone(),
        None => Vec::new(),
    };
    if case.model.system.has_arbitrary_function() {
        return Err(told(FlowError::Arbitrary));
    }
    if options.spectrum {
        return spectrum(&case, options, &names, &starts);
    }
    let ways = if options.one_way { 1 } else { 2 };
    let bar = progress((ways * starts.len()) as u64, "motions");
    let motions =
        liouville_flow::Variational::all(&case.model, &parameters, &starts).map_err(told)?;
    let follow = |time| motions.all_exponents(time, options.threads.count(), &|| bar.inc(1));
    let forward = follow(options.time);
    let backward = (!options.one_way).then(|| follow(-options.time));
    bar.finish_and_clear();
    // A single motion that fails is a failure; of several, the others are reported.
    if let [Err(problem)] = &forward[..] {
        return Err(subject.told(problem));
    }
    let rows = exponents::rows(names, forward, backward);
    let text = match subject.json {
        true => {
            exponents::json(&case.title, &rows).map_err(|error| format!("error: {error}"))? + "\n"
        }
        false => exponents::text(&case.title, &rows),
    };
    Ok(Answer { text, code: 0 })
}

/// Measures the spectra of the motions.
fn spectrum(
    case: &Case,
    options: &Exponents,
    names: &[String],
    starts: &[Result<Start, FlowError>],
) -> Result<Answer, String> {
    let subject = &options.subject;
    let bar = progress(starts.len() as u64, "motions");
    let threads = options.threads.count();
    let found = liouville_flow::spectra(&case.model, starts, options.time, threads, &|| bar.inc(1));
    bar.finish_and_clear();
    let found = found.map_err(|error| subject.told(&error))?;
    if let [Err(problem)] = &found[..] {
        return Err(subject.told(problem));
    }
    let text = match subject.json {
        true => {
            let json = exponents::spectra_json(&case.title, names, &found);
            json.map_err(|error| format!("error: {error}"))? + "\n"
        }
        false => exponents::spectra_text(&case.title, names, &found),
    };
    Ok(Answer { text, code: 0 })
}

/// Names and starts of the motions requested.
type Named = (Vec<String>, Vec<Result<Start, FlowError>>);

fn starts(case: &Case, options: &Exponents) -> Result<Named, String> {
    let subject = &options.subject;
    let told = |error: FlowError| subject.told(&error);
    let mut given = options.starts.read(case)?;
    if given.is_empty() && options.state.is_none() {
        for at in case.section.iter().flat_map(|plan| &plan.starts) {
            let [Some(l), Some(z)] = at.map(Rational::from_f64) else {
                return Err("error: a start of [section] is not finite".to_string());
            };
            let name = format!("({}, {})", at[0], at[1]);
            given.push((name, Given::Values(vec![l, z])));
        }
    }
    let launches = Launches { case, energy: None, pad: None, seed: subject.seed, index: 0 };
    if given.is_empty() {
        let begin = match &options.state {
            None => Begin::Drawn(0),
            Some(text) => Begin::State(
                verdict::read_state(case, text)
                    .map_err(|error| format!("error: --state: {error}"))?,
            ),
        };
        let start = launches.start(&begin).map_err(told)?;
        return Ok((vec!["state".to_string()], vec![Ok(start)]));
    }
    let (mut names, mut starts) = (Vec::new(), Vec::new());
    for (name, given) in given {
        let start = match given {
            Given::State(state) => launches.start(&Begin::State(state)).map_err(told)?,
            Given::Values(values) => {
                let [l, z] = &values[..] else {
                    return Err(misfit(case, values.len(), None));
                };
                if !liouville_flow::has_andoyer_section(&case.model) {
                    return Err(misfit(case, values.len(), None));
                }
                let (g0, energy) = options.plane.of(case)?;
                let at = [l.to_f64().0, z.to_f64().0];
                let found = liouville_flow::section_starts(case, &g0, &energy, &[at], subject.seed);
                let mut found = found.map_err(told)?;
                found.pop().unwrap_or(Err(FlowError::NoStart)).map_err(told)?
            }
        };
        names.push(name);
        starts.push(Ok(start));
    }
    Ok((names, starts))
}
