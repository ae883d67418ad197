//! The command `liouville motion exponents`.

use clap::Args;
use liouville::case::Case;
use liouville::verdict;
use liouville_cli::report::exponents;
use liouville_flow::{FlowError, Start};

use super::Answer;
use super::motion::{Plane, Subject, Threads, parse_start};
use super::progress::progress;

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
    /// Start l,L/G on the section of the case; may be repeated. By default those of the case
    #[arg(long, value_name = "L,Z", value_parser = parse_start, allow_hyphen_values = true)]
    pub start: Vec<[f64; 2]>,
    /// Start by exact numbers instead: --state 'ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]'
    #[arg(long, value_name = "STATE", conflicts_with = "start")]
    pub state: Option<String>,
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

/// Names and starts of the motions requested.
type Starts = (Vec<String>, Vec<Result<Start, FlowError>>);

fn starts(case: &Case, options: &Exponents) -> Result<Starts, String> {
    let subject = &options.subject;
    let told = |error: FlowError| subject.told(&error);
    let plan = case.section.as_ref();
    let on_section = match &options.start[..] {
        [] => plan.map(|plan| plan.starts.clone()).unwrap_or_default(),
        given => given.to_vec(),
    };
    if options.state.is_none() && !on_section.is_empty() {
        let (g0, energy) = options.plane.of(case)?;
        let starts = liouville_flow::section_starts(case, &g0, &energy, &on_section, subject.seed);
        let starts: Result<Vec<_>, _> = starts.map_err(told)?.into_iter().collect();
        let name = |at: &[f64; 2]| format!("({}, {})", at[0], at[1]);
        let starts = starts.map_err(told)?.into_iter().map(Ok).collect();
        return Ok((on_section.iter().map(name).collect(), starts));
    }
    let state = match &options.state {
        None => None,
        Some(text) => Some(
            verdict::read_state(case, text).map_err(|error| format!("error: --state: {error}"))?,
        ),
    };
    let start = Start::new(case, state.as_deref(), subject.seed, 0).map_err(told)?;
    Ok((vec!["state".to_string()], vec![Ok(start)]))
}
