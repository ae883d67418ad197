//! Report of `chart`: counts of motions in each class over a plane, and the picture.

use serde_json::{Value, json};

use super::picture::{Map, Scale, Swatch};
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

/// All kinds of points, with colours that differ in light and dark, and in grey.
const CELLS: [(Cell, [u8; 3]); 7] = [
    (Cell::Motion(Character::Regular), [0x9c, 0xc3, 0xe6]),
    (Cell::Motion(Character::ConservativeChaos), [0xc9, 0x3b, 0x4f]),
    (Cell::Motion(Character::DissipativeChaos), [0xe6, 0xa1, 0x2d]),
    (Cell::Motion(Character::StrangeRepeller), [0x7a, 0x4f, 0xa8]),
    (Cell::Motion(Character::StrangeAttractor), [0x23, 0x7a, 0x57]),
    (Cell::NoState, [0xc4, 0xc4, 0xc4]),
    (Cell::Broken, [0x55, 0x55, 0x55]),
];

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

    /// Draws the picture; its legend lists only the kinds that occur.
    pub fn map(&self, width: u32) -> Map {
        let counts = self.counts();
        let occurs: Vec<usize> = (0..CELLS.len()).filter(|place| counts[*place] > 0).collect();
        let swatch = |place: &usize| {
            let (cell, colour) = CELLS[*place];
            Swatch { colour, name: format!("{} {}", cell.name(), counts[*place]) }
        };
        let index = |found: &Result<Exponents, FlowError>| {
            let place = Cell::of(found).place();
            occurs.iter().position(|other| *other == place).unwrap_or(0)
        };
        let scale = |index: usize| {
            let (axis, name): (&Axis, &str) = (&self.axes[index], self.names[index]);
            let (from, to) = (axis.from.to_f64().0, axis.to.to_f64().0);
            let is_turn = name == "l" && from == 0.0 && (to - std::f64::consts::TAU).abs() < 1e-9;
            if is_turn { Scale::longitude() } else { Scale::new(name, from, to) }
        };
        let columns = self.axes[0].count.max(1);
        Map {
            title: self.title.to_string(),
            across: scale(0),
            up: scale(1),
            swatches: occurs.iter().map(swatch).collect(),
            rows: self.cells.chunks(columns).map(|row| row.iter().map(index).collect()).collect(),
            width,
        }
    }
}
