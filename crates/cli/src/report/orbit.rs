//! Report of `orbit`: a single motion, as text or JSON.

use serde_json::{Map, Value, json};

use super::counted;
use liouville::case::Case;
use liouville::mechanics::Variable;
use liouville::number::arb::Approximation;
use liouville::number::double_double::DoubleDouble;
use liouville_draw::{
    Axis, CATEGORIES, Layer, LegendEntry, MarkShape, MarkedPoint, Paint, Plot, Text, math, plain,
};
use liouville_flow::{Contact, FlowError, Followed, Orbit, Precision, QuantityRole};

/// Number of digits printed of a double-double.
const PAIR_DIGITS: usize = 31;

/// Formats a number with all digits of its precision.
pub(super) fn written(value: DoubleDouble, precision: Precision) -> String {
    let long = || Approximation::from_double_double(value.hi, value.lo, 0.0)?.decimal(PAIR_DIGITS);
    match precision {
        Precision::Float => format!("{:?}", value.hi),
        Precision::Pair => long().unwrap_or_else(|| format!("{:?}", value.hi)),
    }
}

fn role(role: QuantityRole) -> &'static str {
    match role {
        QuantityRole::Level => "level",
        QuantityRole::Energy => "energy",
        QuantityRole::Integral => "integral",
        QuantityRole::Decoy => "decoy",
    }
}

fn contact(kind: Contact) -> &'static str {
    match kind {
        Contact::Arrives => "contact",
        Contact::Leaves => "leaves",
        Contact::Grazes => "grazes",
    }
}

pub(super) fn precision_name(precision: Precision) -> &'static str {
    match precision {
        Precision::Float => "f64",
        Precision::Pair => "double-double",
    }
}

/// Components of a state with the names of its variables.
pub(super) fn named<'s>(
    variables: &'s [Variable],
    state: &'s [DoubleDouble],
    precision: Precision,
) -> impl Iterator<Item = (&'s str, Vec<String>)> {
    let mut rest = state;
    variables.iter().map(move |variable| {
        let (own, others) = rest.split_at(variable.len());
        rest = others;
        (variable.name.as_str(), own.iter().map(|x| written(*x, precision)).collect())
    })
}

/// Renders the motion as text.
pub fn text(case: &Case, orbit: &Orbit, precision: Precision) -> String {
    let mut out = String::new();
    let mut line = |text: String| {
        out.push_str(text.trim_end());
        out.push('\n');
    };
    line(case.title.clone());
    line(format!(
        "Taylor series of order {} in {}, {}",
        orbit.order,
        precision_name(precision),
        counted(orbit.steps as usize, "step")
    ));
    for (time, state) in
        [("0".to_string(), &orbit.start.state), (written(orbit.time, precision), &orbit.end)]
    {
        line(format!("at t = {time}"));
        for (name, values) in named(&case.model.state, state, precision) {
            line(format!("  {name:<16} {}", values.join(", ")));
        }
    }
    if orbit.start.moved > 0.0 {
        line(format!("the start was moved to the level set, by {:.1e}", orbit.start.moved));
    }
    for event in &orbit.events {
        let time = written(event.time, precision);
        let values: Vec<String> = event.state.iter().map(|x| written(*x, precision)).collect();
        line(format!("{:<8} at t = {time}", contact(event.kind)));
        line(format!("  {:<16} {}", "state", values.join(", ")));
    }
    out + &drift_lines(&orbit.followed, precision)
}

/// Renders the drift of followed quantities, a line for each.
pub(super) fn drift_lines(all: &[Followed], precision: Precision) -> String {
    let mut out = format!("{:<44} {:<9} {:>10} {:>10}\n", "drift", "", "largest", "at the end");
    for followed in all {
        out.push_str(&format!(
            "  {:<42} {:<9} {:>10} {:>10}\n",
            followed.name,
            role(followed.role),
            shown_drift(followed.drift, precision),
            shown_drift(followed.drift_at_end, precision)
        ));
    }
    out
}

/// A drift; below the rounding of the numbers that were followed nothing is known of it.
fn shown_drift(drift: f64, precision: Precision) -> String {
    let rounding = match precision {
        Precision::Float => f64::EPSILON,
        Precision::Pair => f64::EPSILON * f64::EPSILON,
    };
    match drift < rounding {
        true => format!("< {rounding:.0e}"),
        false => format!("{drift:.1e}"),
    }
}

/// A state as JSON, by the names of its variables.
pub(super) fn state_json(case: &Case, state: &[DoubleDouble], precision: Precision) -> Value {
    let entries = named(&case.model.state, state, precision);
    Value::Object(entries.map(|(name, values)| (name.to_string(), json!(values))).collect())
}

/// Followed quantities as JSON.
pub(super) fn followed_json(all: &[Followed], precision: Precision) -> Value {
    let one = |followed: &Followed| {
        let values: Vec<String> = followed.value.iter().map(|x| written(*x, precision)).collect();
        json!({
            "name": followed.name,
            "role": role(followed.role),
            "value": values,
            "drift": followed.drift,
            "drift_at_end": followed.drift_at_end,
        })
    };
    all.iter().map(one).collect()
}

/// Renders the motion as JSON; states are decimal strings.
pub fn json(case: &Case, orbit: &Orbit, precision: Precision) -> Result<String, serde_json::Error> {
    let state = |state: &[DoubleDouble]| state_json(case, state, precision);
    let events: Vec<Value> = orbit
        .events
        .iter()
        .map(|event| {
            let time = written(event.time, precision);
            json!({ "event": contact(event.kind), "time": time, "state": state(&event.state) })
        })
        .collect();
    let mut root = Map::new();
    root.insert("title".into(), case.title.clone().into());
    root.insert("precision".into(), precision_name(precision).into());
    root.insert("order".into(), orbit.order.into());
    root.insert("steps".into(), orbit.steps.into());
    root.insert("time".into(), written(orbit.time, precision).into());
    root.insert("moved".into(), orbit.start.moved.into());
    root.insert("start".into(), state(&orbit.start.state));
    root.insert("end".into(), state(&orbit.end));
    if !events.is_empty() {
        root.insert("events".into(), events.into());
    }
    root.insert("followed".into(), followed_json(&orbit.followed, precision));
    serde_json::to_string_pretty(&Value::Object(root))
}

/// Renders a line for each of several motions.
pub fn text_of_several<'o>(
    case: &Case,
    names: &[String],
    orbits: impl Iterator<Item = &'o Result<Orbit, FlowError>>,
) -> String {
    let mut out = format!("{}\n", case.title);
    for (index, (name, orbit)) in names.iter().zip(orbits).enumerate() {
        let words = match orbit {
            Err(problem) => format!("ended early: {problem}"),
            Ok(orbit) => {
                let kept =
                    orbit.followed.iter().filter(|followed| followed.role != QuantityRole::Decoy);
                let drifts = kept.map(|followed| followed.drift);
                let worst = drifts.reduce(|a, b| if b > a || b.is_nan() { b } else { a });
                let drift = worst.map_or(String::new(), |worst| {
                    format!(", what is kept drifts by {worst:.1e} at most")
                });
                format!("{} steps{drift}", orbit.steps)
            }
        };
        out.push_str(&format!("{index} ({name}): {words}\n"));
    }
    out
}

/// Renders several motions as JSON.
pub fn json_of_several<'o>(
    case: &Case,
    names: &[String],
    orbits: impl Iterator<Item = &'o Result<Orbit, FlowError>>,
    precision: Precision,
) -> Result<String, serde_json::Error> {
    let mut entries = Vec::new();
    for (name, orbit) in names.iter().zip(orbits) {
        let mut entry = match orbit {
            Ok(orbit) => serde_json::from_str::<Value>(&json(case, orbit, precision)?)?,
            Err(problem) => json!({ "problem": problem.to_string() }),
        };
        entry["name"] = json!(name);
        entries.push(entry);
    }
    serde_json::to_string_pretty(&json!({ "title": case.title, "orbits": entries }))
}

/// Draws the columns of motions after the first over the first: one line each where the first is
/// the time, and otherwise the second alone. `None` without two columns.
pub fn plot(columns: &[String], names: &[String], orbits: &[&[Vec<DoubleDouble>]]) -> Option<Plot> {
    let [first, others @ ..] = columns else { return None };
    let others = if first == "t" { others } else { &others[..others.len().min(1)] };
    let count = others.len();
    let last = others.last()?;
    let value = |row: &Vec<DoubleDouble>, place: usize| row.get(place).map_or(f64::NAN, |x| x.hi);
    let all = || orbits.iter().flat_map(|rows| rows.iter());
    let name = if count == 1 { math(last) } else { Text::default() };
    let heights = all().flat_map(|row| (1..=count).map(move |place| value(row, place)));
    let across = Axis::over(math(first), all().map(|row| value(row, 0)));
    let mut plot = Plot::new(across, Axis::over(name, heights));
    let mut entries = Vec::new();
    for (index, rows) in orbits.iter().enumerate() {
        for place in 1..=count {
            let points = rows.iter().map(|row| [value(row, 0), value(row, place)]).collect();
            // Beyond the colours come dashes, and then all of them again.
            let own = plot.layers.len();
            let (paint, is_dashed) =
                (CATEGORIES[own % CATEGORIES.len()], own / CATEGORIES.len() % 2 == 1);
            let (layer, mark) = match is_dashed {
                true => (Layer::Dashes(points, paint), MarkShape::Dashes),
                false => (Layer::Line(points, paint), MarkShape::Line),
            };
            plot.layers.push(layer);
            let mut text = if count > 1 { math(&others[place - 1]) } else { Text::default() };
            if orbits.len() > 1 {
                let start = names.get(index).map_or("", String::as_str).replace('-', "−");
                let comma = if text.is_empty() { "start " } else { ", start " };
                text = text.then(plain(&format!("{comma}{start}")));
            }
            if !text.is_empty() {
                entries.push(LegendEntry { mark, paint, text });
            }
        }
    }
    let told = 2 * CATEGORIES.len();
    if entries.len() > told {
        let text = plain(&format!("and {} more", entries.len() - told));
        entries.truncate(told);
        entries.push(LegendEntry { mark: MarkShape::Line, paint: Paint::Paper, text });
    }
    plot.legend.extend(entries);
    Some(plot)
}

/// Draws tracks on a plane with one scale, from marked starts.
pub fn track_plot(tracks: &[Vec<[f64; 2]>]) -> Plot {
    let all = |k: usize| tracks.iter().flatten().map(move |point| point[k]);
    let mut plot =
        Plot::new(Axis::over(math("X"), all(0)), Axis::over(math("Y"), all(1))).with_equal_scales();
    for (index, track) in tracks.iter().enumerate() {
        let paint = CATEGORIES[index % CATEGORIES.len()];
        plot.layers.push(Layer::Line(track.clone(), paint));
        let sign = |at: &[f64; 2]| MarkedPoint {
            at: *at,
            mark: MarkShape::Ring,
            paint: Paint::Ink,
            label: None,
            has_rim: false,
        };
        plot.marks.extend(track.first().map(sign));
    }
    plot.legend.push(LegendEntry {
        mark: MarkShape::Ring,
        paint: Paint::Ink,
        text: plain("start"),
    });
    plot
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_beyond_the_colours_are_dashed_and_named() {
        let row = |t: f64| (0..13).map(|k| DoubleDouble::from_f64(t + f64::from(k))).collect();
        let rows: Vec<Vec<DoubleDouble>> = vec![row(0.0), row(1.0)];
        let columns: Vec<String> =
            ["t".to_string()].into_iter().chain((1..=12).map(|k| format!("x{k}"))).collect();
        let plot = plot(&columns, &[String::new()], &[&rows[..]]).expect("columns");
        let dashed = plot.layers.iter().filter(|own| matches!(own, Layer::Dashes(..))).count();
        assert_eq!((plot.layers.len(), dashed, plot.legend.len()), (12, 4, 12));
        let (first, ninth) = (&plot.legend[0], &plot.legend[8]);
        assert!(first.paint == ninth.paint && first.mark != ninth.mark, "told by their strokes");
    }

    #[test]
    fn drifts_below_rounding_are_not_numbers() {
        assert_eq!(shown_drift(6.2e-17, Precision::Float), "< 2e-16");
        assert_eq!(shown_drift(6.2e-17, Precision::Pair), "6.2e-17");
    }
}
