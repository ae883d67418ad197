//! The command `liouville motion periodic`.

use clap::Args;
use liouville_flow::{FlowError, Multipliers, PeriodicPoint, SectionMap};
use serde_json::json;

use super::Answer;
use super::motion::{Plane, Subject, parse_start};

#[derive(Debug, Args)]
pub struct Periodic {
    #[command(flatten)]
    pub subject: Subject,
    #[command(flatten)]
    pub plane: Plane,
    /// Point l,L/G near the periodic point; may be repeated
    #[arg(long, value_name = "L,Z", value_parser = parse_start,
          allow_hyphen_values = true, required = true)]
    pub start: Vec<[f64; 2]>,
    /// Period of the point, in crossings
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub period: u32,
}

pub fn run(options: &Periodic) -> Result<Answer, String> {
    let case = options.subject.open()?;
    let told = |error: FlowError| options.subject.told(&error);
    let (g0, energy) = options.plane.of(&case)?;
    let map = SectionMap::new(&case, &g0, &energy, options.subject.seed).map_err(told)?;
    let mut found = Vec::new();
    for near in &options.start {
        found.push(map.periodic(*near, options.period as usize).map_err(told)?);
    }
    let text = match options.subject.json {
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
