//! `liouville periodic`

use std::path::PathBuf;

use clap::Args;
use liouville::case::Angle;
use liouville::flow::{Multipliers, PeriodicPoint, SectionMap};
use liouville::number::rational::Rational;
use serde_json::json;

use super::Answer;
use super::eval::open;
use super::orbit::told;

#[derive(Debug, Args)]
pub struct Periodic {
    /// A case file with a [section]
    pub case: PathBuf,
    /// A point l,L/G near the one that is looked for; may be repeated
    #[arg(long, value_name = "L,Z", value_parser = super::section::parse_start,
          allow_hyphen_values = true, required = true)]
    pub start: Vec<[f64; 2]>,
    /// After how many crossings it comes back
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub period: u32,
    /// The energy
    #[arg(long)]
    pub energy: Option<Rational>,
    /// The angle of the section: 0, pi/2, pi, 3pi/2, or radians
    #[arg(long)]
    pub g0: Option<Angle>,
    /// Give a parameter a value: --set a_g=1.4; others are drawn
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<String>,
    /// Seed of parameters that are drawn
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

pub fn run(options: &Periodic) -> Result<Answer, String> {
    let case = open(&options.case, &options.settings)?;
    let plan = case.section.as_ref();
    let missing = |key: &str| format!("error: the case has no [section]\nhelp: give --{key}");
    let g0 = options.g0.clone().or(plan.map(|plan| plan.g0.clone()));
    let energy = options.energy.clone().or(plan.map(|plan| plan.energy.clone()));
    let told = |error| told(&options.case, &error);
    let g0 = g0.ok_or_else(|| missing("g0"))?;
    let energy = energy.ok_or_else(|| missing("energy"))?;
    let map = SectionMap::new(&case, &g0, &energy, options.seed).map_err(told)?;
    let mut found = Vec::new();
    for near in &options.start {
        found.push(map.periodic(*near, options.period as usize).map_err(told)?);
    }
    let text = match options.json {
        true => {
            let points: Vec<_> = found.iter().map(entry).collect();
            let root = json!({ "title": case.title, "points": points });
            serde_json::to_string_pretty(&root).map_err(|error| format!("error: {error}"))? + "\n"
        }
        false => found.iter().map(line).collect(),
    };
    Ok(Answer { text, code: 0 })
}

fn line(point: &PeriodicPoint) -> String {
    let multipliers = match point.multipliers() {
        Multipliers::Complex { modulus, argument } => {
            format!("modulus {modulus:.8}, argument {argument:.6}")
        }
        Multipliers::Real(a, b) => format!("{a:.8} and {b:.8}"),
    };
    format!(
        "({:.12}, {:.12}) of period {}: {}\n  returns after t = {:.9}, to {:.1e}\n  \
         multipliers: {multipliers}; product {:.8}\n",
        point.at[0],
        point.at[1],
        point.period,
        point.kind(),
        point.time,
        point.residual,
        point.determinant
    )
}

fn entry(point: &PeriodicPoint) -> serde_json::Value {
    let multipliers = match point.multipliers() {
        Multipliers::Complex { modulus, argument } => {
            json!({ "modulus": modulus, "argument": argument })
        }
        Multipliers::Real(a, b) => json!({ "real": [a, b] }),
    };
    json!({
        "at": point.at,
        "period": point.period,
        "kind": point.kind(),
        "time": point.time,
        "residual": point.residual,
        "multipliers": multipliers,
        "product": point.determinant,
    })
}
