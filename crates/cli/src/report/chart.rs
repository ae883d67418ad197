//! Report of `chart`: counts of motions in each class over a plane, and the plot.

use clap::ValueEnum;
use serde_json::{Value, json};

use liouville_draw::{
    Axis as Scale, Bar, Layer, LegendEntry, MarkShape, MarkedPoint, Paint, Plot, gradient, math,
    plain,
};
use liouville_flow::{Character, ChartAxis, Estimate, Exponents, FlowError};

use super::data::quoted;

/// A plane of motions with its request.
pub struct ChartReport<'r> {
    /// Title of the case.
    pub title: &'r str,
    /// Names of the axes.
    pub names: [&'r str; 2],
    /// Axes of the plane.
    pub axes: &'r [ChartAxis; 2],
    /// Time for which each motion was followed.
    pub time: f64,
    /// Motions, row by row from below.
    pub cells: &'r [Result<Exponents, FlowError>],
}

/// Kind of a point of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PlanePoint {
    Motion(Character),
    NoState,
    Broken,
}

/// All kinds of points, with colours that the colour-blind tell apart, and that differ in grey.
const CELLS: [(PlanePoint, Paint); 9] = [
    (PlanePoint::Motion(Character::Regular), Paint::Same([0xc6, 0xdf, 0xf2])),
    (PlanePoint::Motion(Character::UnstableRest), Paint::Same([0xe9, 0xf3, 0xde])),
    (PlanePoint::Motion(Character::Escape), Paint::Same([0x8c, 0xb3, 0x6a])),
    (PlanePoint::Motion(Character::ConservativeChaos), Paint::Same([0xd5, 0x5e, 0x00])),
    (PlanePoint::Motion(Character::DissipativeChaos), Paint::Same([0xf0, 0xc4, 0x3f])),
    (PlanePoint::Motion(Character::StrangeRepeller), Paint::Same([0xa2, 0x4b, 0x84])),
    (PlanePoint::Motion(Character::StrangeAttractor), Paint::Same([0x0b, 0x4f, 0x8a])),
    (PlanePoint::NoState, Paint::Same([0xd4, 0xd4, 0xd4])),
    (PlanePoint::Broken, Paint::Same([0x4d, 0x4d, 0x4d])),
];

/// Meaning of the colours of a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Colours {
    /// Class of the motion
    Class,
    /// Largest Lyapunov exponent
    Exponent,
    /// Mean divergence
    Divergence,
}

impl PlanePoint {
    fn of(found: &Result<Exponents, FlowError>) -> Self {
        use FlowError::{BelowPotential, NoStart, OffSphere};
        match found {
            Ok(found) => PlanePoint::Motion(found.character),
            Err(BelowPotential { .. } | OffSphere { .. } | NoStart) => PlanePoint::NoState,
            Err(_) => PlanePoint::Broken,
        }
    }

    fn name(self) -> &'static str {
        match self {
            PlanePoint::Motion(character) => character.name(),
            PlanePoint::NoState => "no state",
            PlanePoint::Broken => "singular",
        }
    }

    fn place(self) -> usize {
        CELLS.iter().position(|(cell, _)| *cell == self).unwrap_or(CELLS.len() - 1)
    }
}

impl ChartReport<'_> {
    fn counts(&self) -> [usize; CELLS.len()] {
        let mut counts = [0; CELLS.len()];
        self.cells.iter().for_each(|found| counts[PlanePoint::of(found).place()] += 1);
        counts
    }

    /// Renders a summary of a few lines.
    pub fn text(&self) -> String {
        let [across, up] = self.axes;
        let mut out = format!(
            "{}\n{} by {} motions, t = {}: {} from {} to {}, {} from {} to {}\n",
            self.title,
            across.count,
            up.count,
            self.time,
            self.names[0],
            across.from.to_f64().0,
            across.to.to_f64().0,
            self.names[1],
            up.from.to_f64().0,
            up.to.to_f64().0
        );
        for ((cell, _), count) in CELLS.iter().zip(self.counts()).filter(|(_, count)| *count > 0) {
            let share = 100.0 * count as f64 / self.cells.len() as f64;
            out.push_str(&format!("{count:>8}  {share:5.1} %  {}", cell.name()));
            let is_same = |found: &&Result<Exponents, FlowError>| PlanePoint::of(found) == *cell;
            if let Some(Err(problem)) = self.cells.iter().find(is_same) {
                out.push_str(&format!("; the first: {problem}"));
            }
            out.push('\n');
        }
        out
    }

    /// Renders all motions as JSON.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        let axis = |index: usize| {
            let axis: &ChartAxis = &self.axes[index];
            json!({
                "name": self.names[index],
                "from": axis.from.to_f64().0,
                "to": axis.to.to_f64().0,
                "count": axis.count,
            })
        };
        let cell = |found: &Result<Exponents, FlowError>| match found {
            Ok(found) => {
                json!([found.character.name(), found.largest.mean, found.divergence.mean])
            }
            Err(_) => json!([PlanePoint::of(found).name()]),
        };
        let columns = self.axes[0].count.max(1);
        let rows: Vec<Vec<Value>> =
            self.cells.chunks(columns).map(|row| row.iter().map(cell).collect()).collect();
        serde_json::to_string(&json!({
            "title": self.title,
            "time": self.time,
            "x": axis(0),
            "y": axis(1),
            "rows": rows,
        }))
    }

    /// Renders all motions as CSV, a line each below a line of titles.
    pub fn csv(&self) -> String {
        let mut out = titles(self.names) + "\n";
        for (place, cell) in self.cells.iter().enumerate() {
            let problem = cell.as_ref().err().map_or(String::new(), ToString::to_string);
            out.push_str(&row(self.axes, place, cell, &problem));
            out.push('\n');
        }
        out
    }

    /// Draws the plane; its legend lists only the kinds that occur. The values of the case itself are
    /// marked where they are known and within the axes.
    pub fn plot(&self, colours: Colours, own: [Option<f64>; 2]) -> Plot {
        let mut plot = Plot::new(self.scale(0), self.scale(1));
        let columns = self.axes[0].count.max(1);
        let kind = |found: &Result<Exponents, FlowError>| {
            let place = PlanePoint::of(found).place();
            (CELLS[place].1, place)
        };
        let mut paints: Vec<Option<Paint>> = Vec::new();
        let shown = |place: usize| match colours {
            Colours::Class => true,
            _ => !matches!(CELLS[place].0, PlanePoint::Motion(_)),
        };
        let bar = self.bar(colours);
        for row in self.cells.chunks(columns).rev() {
            paints.extend(row.iter().map(|found| match (&bar, value(found, colours)) {
                (Some(bar), Some(value)) => Some(gradient(bar.axis.share(value))),
                _ => Some(kind(found).0),
            }));
        }
        plot.layers.push(Layer::Cells(columns, paints));
        plot.bar = bar;
        let counts = self.counts();
        for (place, (cell, paint)) in CELLS.iter().enumerate() {
            if counts[place] > 0 && shown(place) {
                let share = 100.0 * counts[place] as f64 / self.cells.len() as f64;
                let text = plain(&format!("{}, {share:.1} %", cell.name()));
                plot.legend.push(LegendEntry { mark: MarkShape::Box, paint: *paint, text });
            }
        }
        if let [Some(x), Some(y)] = own
            && [plot.across.share(x), plot.up.share(y)]
                .iter()
                .all(|share| (0.0..=1.0).contains(share))
        {
            let (mark, paint) = (MarkShape::Cross, Paint::Ink);
            plot.marks.push(MarkedPoint { at: [x, y], mark, paint, label: None, has_rim: false });
            plot.legend.push(LegendEntry { mark, paint, text: plain("the case itself") });
        }
        plot
    }

    fn scale(&self, index: usize) -> Scale {
        let (axis, name): (&ChartAxis, &str) = (&self.axes[index], self.names[index]);
        let (from, to) = (axis.from.to_f64().0, axis.to.to_f64().0);
        let is_turn = name == "l" && from == 0.0 && (to - std::f64::consts::TAU).abs() < 1e-9;
        if is_turn { Scale::turn(math(name)) } else { Scale::new(math(name), from, to) }
    }

    /// Colour bar of the values that occur.
    fn bar(&self, colours: Colours) -> Option<Bar> {
        let values = || self.cells.iter().filter_map(|found| value(found, colours));
        let (low, high) = values()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let words = match colours {
            Colours::Class => return None,
            Colours::Exponent => "largest exponent",
            Colours::Divergence => "mean divergence",
        };
        let high = if high > low { high } else { low + 1e-3 };
        low.is_finite().then(|| Bar {
            axis: Scale::new(plain(words), low, high),
            paints: (0..64).map(|k| gradient((f64::from(k) + 0.5) / 64.0)).collect(),
        })
    }
}

/// Titles of the columns of a chart as CSV, with these names of the axes.
pub fn titles([x, y]: [&str; 2]) -> String {
    let [x, y] = [x, y].map(quoted);
    format!(
        "i,j,{x},{y},class,exponent,error,later,divergence,divergence_error,divergence_later,problem"
    )
}

/// Line of a motion as CSV: its place and its numbers, with all digits, or its problem.
pub fn row(
    axes: &[ChartAxis; 2],
    place: usize,
    cell: &Result<Exponents, FlowError>,
    problem: &str,
) -> String {
    let across = axes[0].count.max(1);
    let (i, j) = (place % across, place / across);
    let [x, y] = [axes[0].value(i), axes[1].value(j)].map(|value| value.to_f64().0);
    let class = PlanePoint::of(cell).name();
    let numbers = match cell {
        Ok(found) => {
            let estimates = [found.largest, found.divergence];
            let numbers =
                estimates.map(|own| format!("{:?},{:?},{:?}", own.mean, own.error, own.later));
            numbers.join(",")
        }
        Err(_) => ",,,,,".to_string(),
    };
    format!("{i},{j},{x:?},{y:?},{class},{numbers},{}", quoted(problem))
}

/// Numbers of a line that was followed for this time, or the text of its problem.
pub fn read_row(line: &str, time: f64) -> Option<Result<Exponents, String>> {
    let fields: Vec<&str> = line.splitn(12, ',').collect();
    let [_, _, _, _, class, numbers @ .., problem] = &fields[..] else { return None };
    if !problem.is_empty() {
        let inner = problem.strip_prefix('"').and_then(|text| text.strip_suffix('"'));
        return Some(Err(inner.map_or(problem.to_string(), |text| text.replace("\"\"", "\""))));
    }
    let numbers: Vec<f64> = numbers.iter().map(|text| text.parse().ok()).collect::<Option<_>>()?;
    let estimate = |from: usize| {
        let [mean, error, later] = *numbers.get(from..from + 3)? else { return None };
        Some(Estimate { mean, error, later })
    };
    let character = *Character::ALL.iter().find(|own| own.name() == *class)?;
    let means = [estimate(0)?, estimate(3)?];
    Some(Ok(Exponents::written(time, means, None, character)))
}

/// Value that a motion is coloured by.
fn value(found: &Result<Exponents, FlowError>, colours: Colours) -> Option<f64> {
    let found = found.as_ref().ok()?;
    let value = match colours {
        Colours::Class => return None,
        Colours::Exponent => found.largest.mean,
        Colours::Divergence => found.divergence.mean,
    };
    value.is_finite().then_some(value)
}
