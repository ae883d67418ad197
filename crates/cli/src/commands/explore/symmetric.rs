//! The command `liouville motion periodic --symmetric`.

use crate::report::cycle::{self, FoundOrbit};
use liouville::case::Case;
use liouville_flow::{FlowError, SymmetricOrbits, SymmetricRequest, line_name, symmetric_orbits};
use serde_json::{Value, json};

use super::CommandOutput;
use super::periodic::Periodic;

/// Finds the symmetric periodic orbits that meet the lines of the options.
pub fn run(options: &Periodic, case: &Case) -> Result<CommandOutput, String> {
    let search = &options.search;
    let told = |error: FlowError| search.subject.told(&error);
    if !liouville_flow::has_andoyer_section(&case.model) {
        return Err(told(FlowError::NoAndoyer));
    }
    let (g0, energy) = search.plane.of(case)?;
    let request = SymmetricRequest {
        case,
        g0: &g0,
        energy: &energy,
        lines: &options.symmetric,
        longest: search.period as usize,
        points: options.points as usize,
        seed: search.subject.seed,
        threads: options.threads.count(),
    };
    let found = symmetric_orbits(&request).map_err(told)?;
    let orbits = orbits(&found).map(|(orbit, lines)| Ok((options.proved(case, orbit)?, lines)));
    let orbits: Vec<ListedOrbit> = orbits.collect::<Result<_, String>>()?;
    let text = match search.subject.json {
        true => json_of(case, &found, &orbits)?,
        false => text_of(case, options, &found, &orbits),
    };
    Ok(CommandOutput { text, code: 0 })
}

/// An orbit, and the lines of the reversors that keep it.
type ListedOrbit = (FoundOrbit, Vec<&'static str>);

fn orbits(found: &SymmetricOrbits) -> impl Iterator<Item = ListedOrbit> {
    found.orbits.iter().map(|orbit| {
        let (point, cycle) = (Some(orbit.point), orbit.cycle.clone());
        let lines = orbit.lines.iter().map(|line| line_name(*line)).collect();
        (FoundOrbit { point, crossings: Some(orbit.point.period), cycle, proof: None }, lines)
    })
}

fn text_of(
    case: &Case,
    options: &Periodic,
    found: &SymmetricOrbits,
    orbits: &[ListedOrbit],
) -> String {
    let lines: Vec<&str> = options.symmetric.iter().map(|line| line_name(*line)).collect();
    let mut out = format!(
        "{} symmetric orbits of periods up to {} meet {}\n",
        found.orbits.len(),
        options.search.period,
        lines.join(", ")
    );
    for (orbit, lines) in orbits {
        out.push_str(&cycle::text(case, orbit));
        out.push_str(&format!("  symmetric to {}\n", lines.join(", ")));
    }
    if found.unconfirmed > 0 {
        out.push_str(&format!(
            "{} places on the lines were not confirmed by Newton's method: orbits come in families \
             there, or motions touch the section\n",
            found.unconfirmed
        ));
    }
    if found.lost > 0 {
        let lost = found.lost;
        out.push_str(&format!("{lost} points of the lines have no motion that comes back\n"));
    }
    out
}

fn json_of(case: &Case, found: &SymmetricOrbits, orbits: &[ListedOrbit]) -> Result<String, String> {
    let points: Vec<Value> = orbits
        .iter()
        .map(|(orbit, lines)| {
            let mut entry = cycle::entry(orbit);
            entry["symmetric"] = json!(lines);
            entry
        })
        .collect();
    let root = json!({
        "title": case.title,
        "points": points,
        "unconfirmed": found.unconfirmed,
        "lost": found.lost,
    });
    Ok(serde_json::to_string_pretty(&root).map_err(|error| format!("error: {error}"))? + "\n")
}
