//! `liouville exponents`

use std::path::PathBuf;

use clap::Args;
use liouville::flow::{self, Start};
use liouville::number::rational::Rational;
use liouville::report::exponents;
use liouville::verdict;
use rayon::prelude::*;

use super::Answer;
use super::eval::open;
use super::orbit::told;

#[derive(Debug, Args)]
pub struct Exponents {
    /// A case file
    pub case: PathBuf,
    /// How long to follow each motion; negative: backwards. Transients last long: a short time
    /// shows chaos where there is none
    #[arg(long, default_value = "2000", allow_hyphen_values = true)]
    pub time: f64,
    /// A start l,L/G on the section of the case; may be repeated. By default those of the case
    #[arg(long, value_name = "L,Z", value_parser = super::section::parse_start, allow_hyphen_values = true)]
    pub start: Vec<[f64; 2]>,
    /// A start by exact numbers instead: --state 'ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]'
    #[arg(long, value_name = "STATE", conflicts_with = "start")]
    pub state: Option<String>,
    /// Give a parameter a value: --set a_g=1.4; others are drawn
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<String>,
    /// The energy of starts on the section
    #[arg(long)]
    pub energy: Option<Rational>,
    /// Seed of what is drawn
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// How many threads to use; all cores by default. Results do not depend on it
    #[arg(long)]
    pub threads: Option<usize>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

pub fn run(options: &Exponents) -> Result<Answer, String> {
    let case = open(&options.case, &options.settings)?;
    let told = |error: flow::FlowError| told(&options.case, &error);
    if options.time == 0.0 || !options.time.is_finite() {
        return Err("error: --time: write a number that is not 0".to_string());
    }
    let plan = case.section.as_ref();
    let on_section = match &options.start[..] {
        [] => plan.map(|plan| plan.starts.clone()).unwrap_or_default(),
        given => given.to_vec(),
    };
    let starts: Vec<(String, Start)> = if options.state.is_none() && !on_section.is_empty() {
        let plan = plan.ok_or("error: --start: the case has no [section]\nhelp: give --state")?;
        let energy = options.energy.as_ref().unwrap_or(&plan.energy);
        let starts = flow::section_starts(&case, &plan.g0, energy, &on_section, options.seed);
        let named = |(at, start): (&[f64; 2], Result<Start, flow::FlowError>)| {
            Ok((format!("({}, {})", at[0], at[1]), start.map_err(told)?))
        };
        on_section.iter().zip(starts.map_err(told)?).map(named).collect::<Result<_, String>>()?
    } else {
        let state = match &options.state {
            None => None,
            Some(text) => Some(
                verdict::read_state(&case, text)
                    .map_err(|error| format!("error: --state: {error}"))?,
            ),
        };
        let start = Start::new(&case, state.as_deref(), options.seed, 0).map_err(told)?;
        vec![("state".to_string(), start)]
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads.unwrap_or(0))
        .build()
        .map_err(|error| format!("error: cannot start threads: {error}"))?;
    let model = &case.model;
    let found: Vec<_> = pool.install(|| {
        // A model holds parts that threads cannot share: the programs are made before.
        let motions: Vec<_> =
            starts.iter().map(|(_, start)| flow::Variational::new(model, start)).collect();
        motions
            .into_par_iter()
            .map(|motion| motion.and_then(|motion| motion.exponents(options.time)))
            .collect()
    });
    let mut rows = Vec::new();
    for ((name, _), exponents) in starts.into_iter().zip(found) {
        rows.push((name, exponents.map_err(told)?));
    }
    let text = match options.json {
        true => {
            exponents::json(&case.title, &rows).map_err(|error| format!("error: {error}"))? + "\n"
        }
        false => exponents::text(&case.title, &rows),
    };
    Ok(Answer { text, code: 0 })
}
