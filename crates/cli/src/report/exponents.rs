//! Report of `exponents`: the class of a motion, with the exponents behind it.

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::cycle;
use liouville_flow::{
    Alignment, Character, Estimate, Exponents, FlowError, IterateError, MapExponents,
    MeasuredNumber, Spectrum,
};

/// Error below which a number with five decimals shows nothing.
const SMALL: f64 = 5e-6;

/// A motion that was followed.
#[derive(Debug, Serialize, Deserialize)]
pub struct MotionRow {
    /// Name of its start.
    pub name: String,
    /// Exponents in the direction requested.
    pub forward: Result<Exponents, FlowError>,
    /// Exponents in the other direction, if the motion was followed that way too.
    pub backward: Option<Result<Exponents, FlowError>>,
}

impl MotionRow {
    /// Class of the motion, by both directions where both are known.
    pub fn class(&self) -> Option<Character> {
        let forward = self.forward.as_ref().ok()?;
        Some(match &self.backward {
            Some(Ok(backward)) => forward.class(backward),
            _ => forward.character,
        })
    }
}

/// Combines motions with their names; `backward` is in the same order.
pub fn rows(
    names: Vec<String>,
    forward: Vec<Result<Exponents, FlowError>>,
    backward: Option<Vec<Result<Exponents, FlowError>>>,
) -> Vec<MotionRow> {
    let mut backward = backward.into_iter().flatten();
    let named = names.into_iter().zip(forward);
    named.map(|(name, forward)| MotionRow { name, forward, backward: backward.next() }).collect()
}

/// Counts of the motions in each class, and the class furthest from order among them.
pub fn classes(rows: &[MotionRow]) -> String {
    let Some(furthest) = rows.iter().filter_map(MotionRow::class).max() else {
        return "no orbit has a class\n".to_string();
    };
    let counts = Character::ALL.iter().filter_map(|character| {
        let count = rows.iter().filter(|row| row.class() == Some(*character)).count();
        (count > 0).then(|| format!("{count} {}", character.name()))
    });
    let counts: Vec<String> = counts.collect();
    format!("class: {} ({})\n", furthest.name(), counts.join(", "))
}

/// Renders a few lines for each start.
pub fn text(title: &str, rows: &[MotionRow]) -> String {
    let mut out = format!("{title}\n");
    for row in rows {
        out.push_str(&format!("{}: ", row.name));
        out.push_str(row.class().map_or("no class", Character::name));
        out.push('\n');
        for found in [Some(&row.forward), row.backward.as_ref()].into_iter().flatten() {
            match found {
                Ok(found) => out.push_str(&lines(found)),
                Err(problem) => out.push_str(&format!("  {problem}\n")),
            }
        }
    }
    out
}

/// Formats a mean with its error.
fn shown(Estimate { mean, error, .. }: Estimate) -> String {
    match error {
        _ if mean == 0.0 && error == 0.0 => "0".to_string(),
        // Five decimals would show nothing of it.
        0.0..SMALL if mean.abs() <= error || error > 0.0 => {
            cycle::shown(MeasuredNumber { value: mean, error })
        }
        _ => format!("{mean:+.5} ± {error:.5}"),
    }
}

/// Formats a mean over the later half.
fn later(Estimate { later, error, .. }: Estimate) -> String {
    match later.abs() < SMALL && error < SMALL {
        true => format!("{later:+.1e}"),
        false => format!("{later:+.5}"),
    }
}

fn lines(found: &Exponents) -> String {
    lines_over(found, "t", "mean divergence ")
}

/// Lines with the name of what passes, and of the mean growth of volume.
fn lines_over(found: &Exponents, over: &str, volume: &str) -> String {
    let mut out = format!(
        "  {over} = {}: {}\n  largest exponent {} (later half {})\n  \
         {volume} {} (later half {})\n",
        found.time,
        found.character.name(),
        shown(found.largest),
        later(found.largest),
        shown(found.divergence),
        later(found.divergence),
    );
    if let Some(alignment) = found.alignment {
        out.push_str(&match alignment.index < f64::EPSILON {
            true => format!("  alignment index  below {:.1e}", f64::EPSILON),
            false => format!("  alignment index  {:.1e}", alignment.index),
        });
        if let Some(since) = alignment.since {
            out.push_str(&format!(", parallel from {over} = {since:.0} on"));
        }
        out.push('\n');
    }
    out
}

/// Renders the motions as JSON.
pub fn json(title: &str, rows: &[MotionRow]) -> Result<String, serde_json::Error> {
    let told = |found: &Result<Exponents, FlowError>| match found {
        Ok(found) => numbers(found),
        Err(problem) => json!({ "problem": problem.to_string() }),
    };
    let rows: Vec<Value> = rows
        .iter()
        .map(|row| {
            let mut entry = told(&row.forward);
            entry["start"] = json!(row.name);
            entry["class"] = json!(row.class().map(Character::name));
            entry["backward"] = row.backward.as_ref().map_or(Value::Null, told);
            entry
        })
        .collect();
    serde_json::to_string_pretty(&json!({ "title": title, "motions": rows }))
}

fn numbers(found: &Exponents) -> Value {
    let alignment = |found: Alignment| json!({ "index": found.index, "since": found.since });
    json!({
        "time": found.time,
        "character": found.character.name(),
        "largest": estimated(found.largest),
        "divergence": estimated(found.divergence),
        "alignment": found.alignment.map(alignment),
    })
}

/// Renders the spectra of motions.
pub fn spectra_text(
    title: &str,
    names: &[String],
    spectra: &[Result<Spectrum, FlowError>],
) -> String {
    let mut out = format!("{title}\n");
    for (name, spectrum) in names.iter().zip(spectra) {
        let found = match spectrum {
            Ok(found) => found,
            Err(problem) => {
                out.push_str(&format!("{name}: {problem}\n"));
                continue;
            }
        };
        out.push_str(&format!("{name}, t = {}\n", found.time));
        out.push_str(&spectrum_lines(found, "mean divergence"));
    }
    out
}

fn spectrum_lines(found: &Spectrum, volume: &str) -> String {
    let shown = |own: &Estimate| format!("{} (later half {})", shown(*own), later(*own));
    let mut out = String::new();
    for (index, exponent) in found.exponents.iter().enumerate() {
        out.push_str(&format!("  λ{:<3} {}\n", index + 1, shown(exponent)));
    }
    let sum: f64 = found.exponents.iter().map(|exponent| exponent.mean).sum();
    out.push_str(&format!("  sum  {sum:+.5}; {volume} {}\n", shown(&found.divergence)));
    if let Some(dimension) = found.kaplan_yorke() {
        out.push_str(&format!("  dimension of Kaplan and Yorke {dimension:.3}\n"));
    }
    out
}

/// Name of the mean growth of volume under a map.
const MAP_VOLUME: &str = "mean ln |det DΦ|";

/// Renders the exponents of orbits of a map.
pub fn map_text(
    title: &str,
    names: &[String],
    found: &[Result<MapExponents, IterateError>],
    spectrum: bool,
) -> String {
    let mut out = format!("{title}\n");
    for (name, found) in names.iter().zip(found) {
        match found {
            Err(problem) => out.push_str(&format!("{name}: {problem}\n")),
            Ok(found) if spectrum => {
                out.push_str(&format!("{name}, n = {}\n", found.largest.time));
                out.push_str(&spectrum_lines(&found.spectrum, MAP_VOLUME));
            }
            Ok(found) => {
                out.push_str(&format!("{name}: {}\n", found.largest.character.name()));
                out.push_str(&lines_over(&found.largest, "n", MAP_VOLUME));
            }
        }
    }
    out
}

/// Renders the exponents of orbits of a map as JSON.
pub fn map_json(
    title: &str,
    names: &[String],
    found: &[Result<MapExponents, IterateError>],
    spectrum: bool,
) -> Result<String, serde_json::Error> {
    let entry = |(name, found): (&String, &Result<MapExponents, IterateError>)| {
        let mut entry = match found {
            Ok(found) if spectrum => json!({
                "exponents":
                    found.spectrum.exponents.iter().copied().map(estimated).collect::<Vec<_>>(),
                "volume": estimated(found.spectrum.divergence),
                "kaplan_yorke": found.spectrum.kaplan_yorke(),
            }),
            Ok(found) => json!({
                "class": found.largest.character.name(),
                "largest": estimated(found.largest.largest),
                "volume": estimated(found.largest.divergence),
            }),
            Err(problem) => json!({ "problem": problem.to_string() }),
        };
        entry["start"] = json!(name);
        if let Ok(found) = found {
            entry["iterates"] = json!(found.largest.time);
        }
        entry
    };
    let orbits: Vec<Value> = names.iter().zip(found).map(entry).collect();
    serde_json::to_string_pretty(&json!({ "title": title, "orbits": orbits }))
}

/// Renders the spectra of motions as JSON.
pub fn spectra_json(
    title: &str,
    names: &[String],
    spectra: &[Result<Spectrum, FlowError>],
) -> Result<String, serde_json::Error> {
    let entry = |(name, spectrum): (&String, &Result<Spectrum, FlowError>)| match spectrum {
        Ok(found) => json!({
            "start": name,
            "time": found.time,
            "exponents": found.exponents.iter().copied().map(estimated).collect::<Vec<_>>(),
            "divergence": estimated(found.divergence),
            "kaplan_yorke": found.kaplan_yorke(),
        }),
        Err(problem) => json!({ "start": name, "problem": problem.to_string() }),
    };
    let motions: Vec<Value> = names.iter().zip(spectra).map(entry).collect();
    serde_json::to_string_pretty(&json!({ "title": title, "motions": motions }))
}

fn estimated(estimate: Estimate) -> Value {
    json!({ "mean": estimate.mean, "error": estimate.error, "later": estimate.later })
}
