//! Report of `chart`: counts of motions in each class over a plane, and the plot.

use serde_json::{Value, json};

use liouville_draw::{
    Axis as Scale, Bar, Entry, Layer, Mark, Paint, Plot, Sign, gradient, math, plain,
};
use liouville_flow::{Axis, Character, Exponents, FlowError};

/// A plane of motions with its request.
pub struct ChartReport<'r> {
    /// Title of the case.
    pub title: &'r str,
    /// Names of the axes.
    pub names: [&'r str; 2],
    /// Axes of the plane.
    pub axes: &'r [Axis; 2],
    /// Time for which each motion was followed.
    pub time: f64,
    /// Motions, row by row from below.
    pub cells: &'r [Result<Exponents, FlowError>],
}

/// Kind of a point of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cell {
    Motion(Character),
    NoState,
    Broken,
}

/// All kinds of points, with colours that the colour-blind tell apart, and that differ in grey.
const CELLS: [(Cell, Paint); 7] = [
    (Cell::Motion(Character::Regular), Paint::Same([0xc6, 0xdf, 0xf2])),
    (Cell::Motion(Character::ConservativeChaos), Paint::Same([0xd5, 0x5e, 0x00])),
    (Cell::Motion(Character::DissipativeChaos), Paint::Same([0xf0, 0xc4, 0x3f])),
    (Cell::Motion(Character::StrangeRepeller), Paint::Same([0xa2, 0x4b, 0x84])),
    (Cell::Motion(Character::StrangeAttractor), Paint::Same([0x0b, 0x4f, 0x8a])),
    (Cell::NoState, Paint::Same([0xd4, 0xd4, 0xd4])),
    (Cell::Broken, Paint::Same([0x4d, 0x4d, 0x4d])),
];

/// Meaning of the colours of a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colours {
    /// Class of the motion.
    Class,
    /// Largest Lyapunov exponent.
    Exponent,
    /// Mean divergence.
    Divergence,
}

impl Cell {
    fn of(found: &Result<Exponents, FlowError>) -> Self {
        use FlowError::{BelowPotential, NoStart, OffSphere};
        match found {
            Ok(found) => Cell::Motion(found.character),
            Err(BelowPotential { .. } | OffSphere { .. } | NoStart) => Cell::NoState,
            Err(_) => Cell::Broken,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Cell::Motion(character) => character.name(),
            Cell::NoState => "no state",
            Cell::Broken => "singular",
        }
    }

    fn place(self) -> usize {
        CELLS.iter().position(|(cell, _)| *cell == self).unwrap_or(CELLS.len() - 1)
    }
}

impl ChartReport<'_> {
    fn counts(&self) -> [usize; CELLS.len()] {
        let mut counts = [0; CELLS.len()];
        self.cells.iter().for_each(|found| counts[Cell::of(found).place()] += 1);
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
            let is_same = |found: &&Result<Exponents, FlowError>| Cell::of(found) == *cell;
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
            let axis: &Axis = &self.axes[index];
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
            Err(_) => json!([Cell::of(found).name()]),
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

    /// Draws the plane; its legend lists only the kinds that occur. The values of the case itself are
    /// marked where they are known and within the axes.
    pub fn plot(&self, colours: Colours, own: [Option<f64>; 2]) -> Plot {
        let mut plot = Plot::new(self.scale(0), self.scale(1));
        let columns = self.axes[0].count.max(1);
        let kind = |found: &Result<Exponents, FlowError>| {
            let place = Cell::of(found).place();
            (CELLS[place].1, place)
        };
        let mut paints: Vec<Option<Paint>> = Vec::new();
        let shown = |place: usize| match colours {
            Colours::Class => true,
            _ => !matches!(CELLS[place].0, Cell::Motion(_)),
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
                plot.legend.push(Entry { mark: Mark::Box, paint: *paint, text });
            }
        }
        if let [Some(x), Some(y)] = own
            && [plot.across.share(x), plot.up.share(y)]
                .iter()
                .all(|share| (0.0..=1.0).contains(share))
        {
            let (mark, paint) = (Mark::Cross, Paint::Ink);
            plot.marks.push(Sign { at: [x, y], mark, paint, label: None, has_rim: false });
            plot.legend.push(Entry { mark, paint, text: plain("the case itself") });
        }
        plot
    }

    fn scale(&self, index: usize) -> Scale {
        let (axis, name): (&Axis, &str) = (&self.axes[index], self.names[index]);
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
