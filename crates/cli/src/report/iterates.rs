//! Report on orbits of a map, as text, JSON or a plot of dots.

use serde_json::{Value, json};

use super::orbit::{drift_lines, followed_json, named, precision_name, state_json};
use liouville::case::Case;
use liouville::number::double_double::DoubleDouble;
use liouville_draw::{
    Axis, CATEGORIES, Layer, LegendEntry, MarkShape, Paint, Plot, Text, math, plain,
};
use liouville_flow::{IterateError, MapOrbit, Precision, QuantityRole};

/// An orbit, or why it ended early.
type Ended = Result<MapOrbit, IterateError>;

/// Largest number of orbits of which each has a place in the legend.
const MOST_NAMED: usize = 8;

/// Renders an orbit as text.
pub fn text(case: &Case, orbit: &MapOrbit, precision: Precision) -> String {
    let mut out =
        format!("{}\n{} iterates in {}\n", case.title, orbit.iterates, precision_name(precision));
    for (index, state) in [(0, &orbit.start.state), (orbit.iterates, &orbit.end)] {
        out.push_str(&format!("at n = {index}\n"));
        for (name, values) in named(&case.model.state, state, precision) {
            out.push_str(&format!("  {name:<16} {}\n", values.join(", ")));
        }
    }
    if orbit.start.moved > 0.0 {
        let moved = orbit.start.moved;
        out.push_str(&format!("the start was moved to the level set, by {moved:.1e}\n"));
    }
    out + &drift_lines(&orbit.followed, precision)
}

/// Renders a line for each of several orbits.
pub fn text_of_several<'o>(
    case: &Case,
    orbits: impl Iterator<Item = (&'o String, &'o Ended)>,
) -> String {
    let mut out = format!("{}\n", case.title);
    for (index, (name, orbit)) in orbits.enumerate() {
        let words = match orbit {
            Err(problem) => format!("ended early: {problem}"),
            Ok(orbit) => {
                let kept = orbit.followed.iter().filter(|own| own.role != QuantityRole::Decoy);
                let worst = kept.map(|own| own.drift);
                let worst = worst.reduce(|a, b| if b > a || b.is_nan() { b } else { a });
                let drift = worst.map_or(String::new(), |worst| {
                    format!(", what is kept drifts by {worst:.1e} at most")
                });
                format!("{} iterates{drift}", orbit.iterates)
            }
        };
        out.push_str(&format!("{index} ({name}): {words}\n"));
    }
    out
}

/// Renders orbits as JSON, a single one as an object of its own.
pub fn json<'o>(
    case: &Case,
    orbits: impl Iterator<Item = (&'o String, &'o Ended)>,
    precision: Precision,
    is_single: bool,
) -> Result<String, serde_json::Error> {
    let entry = |(name, orbit): (&String, &Ended)| match orbit {
        Err(problem) => json!({ "name": name, "problem": problem.to_string() }),
        Ok(orbit) => json!({
            "title": case.title,
            "name": name,
            "precision": precision_name(precision),
            "iterates": orbit.iterates,
            "moved": orbit.start.moved,
            "start": state_json(case, &orbit.start.state, precision),
            "end": state_json(case, &orbit.end, precision),
            "followed": followed_json(&orbit.followed, precision),
        }),
    };
    let mut entries: Vec<Value> = orbits.map(entry).collect();
    let root = match is_single.then(|| entries.pop()).flatten() {
        Some(single) => single,
        None => json!({ "title": case.title, "orbits": entries }),
    };
    Ok(serde_json::to_string_pretty(&root)? + "\n")
}

/// Draws the columns of orbits after the first over the first as dots, a colour for each orbit: all of
/// them where the first is the number of iterates, and otherwise the second alone. `None` without two
/// columns.
pub fn plot(columns: &[String], names: &[String], orbits: &[&[Vec<DoubleDouble>]]) -> Option<Plot> {
    let [first, others @ ..] = columns else { return None };
    let others = if first == "n" { others } else { &others[..others.len().min(1)] };
    let last = others.last()?;
    let value = |row: &Vec<DoubleDouble>, place: usize| row.get(place).map_or(f64::NAN, |x| x.hi);
    let all = || orbits.iter().flat_map(|rows| rows.iter());
    let name = if others.len() == 1 { math(last) } else { Text::default() };
    let heights = all().flat_map(|row| (1..=others.len()).map(move |place| value(row, place)));
    let across = Axis::over(math(first), all().map(|row| value(row, 0)));
    let mut plot = Plot::new(across, Axis::over(name, heights));
    for (index, rows) in orbits.iter().enumerate() {
        for (place, title) in others.iter().enumerate() {
            let points = rows.iter().map(|row| [value(row, 0), value(row, place + 1)]).collect();
            // One orbit is ink; several have the colours in turn.
            let paint = match orbits.len() * others.len() {
                1 => Paint::Ink,
                _ => CATEGORIES[plot.layers.len() % CATEGORIES.len()],
            };
            plot.layers.push(Layer::Dots(points, paint));
            let mut text = if others.len() > 1 { math(title) } else { Text::default() };
            if orbits.len() > 1 && orbits.len() <= MOST_NAMED {
                let start = names.get(index).map_or("", String::as_str).replace('-', "−");
                let comma = if text.is_empty() { "start " } else { ", start " };
                text = text.then(plain(&format!("{comma}{start}")));
            }
            if !text.is_empty() && orbits.len() <= MOST_NAMED {
                plot.legend.push(LegendEntry { mark: MarkShape::Disc, paint, text });
            }
        }
    }
    Some(plot)
}
