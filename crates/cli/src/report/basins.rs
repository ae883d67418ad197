//! Report of `basins`: the attractors with their shares, and the plot.

use serde_json::json;

use super::data::quoted;
use super::facts;
use liouville::case::Case;
use liouville_draw::{
    Axis, CATEGORIES, Layer, LegendEntry, MarkShape, MarkedPoint, Paint, Plot, Text, math, plain,
};
use liouville_flow::{Attractor, BasinRequest, Basins, Character, Conserved, Destiny, StateAxis};

/// Colours of motions without an attractor.
const UNSETTLED: Paint = Paint::Same([0xd4, 0xd4, 0xd4]);
const ENDED: Paint = Paint::Same([0x4d, 0x4d, 0x4d]);

/// Largest number of attractors that the text lists.
const MOST_LINES: usize = 12;

/// Multiple of the width of the starts from which on a component counts as running away from them.
const FAR: f64 = 10.0;

/// Basins with their request.
pub struct BasinReport<'r> {
    /// Case of the motions.
    pub case: &'r Case,
    /// Request of the basins.
    pub request: &'r BasinRequest<'r>,
    /// Whether motions were told apart by values other than their states.
    pub has_values: bool,
    /// Basins found.
    pub found: &'r Basins,
}

impl BasinReport<'_> {
    fn count(&self, fits: impl Fn(&Destiny) -> bool) -> usize {
        self.found.ends.iter().filter(|end| fits(end)).count()
    }

    fn share(&self, count: usize) -> String {
        let share = 100.0 * count as f64 / self.found.ends.len() as f64;
        format!("{count:>8}  {share:5.1} %")
    }

    fn axis_words(axis: &StateAxis) -> String {
        format!("{} from {} to {}", axis.name, axis.from.to_f64().0, axis.to.to_f64().0)
    }

    /// Renders the attractors, a line each, and the motions that have none.
    pub fn text(&self) -> String {
        let [across, up] = self.request.axes;
        let mut out = format!(
            "{}\n{} by {} motions, t = {}: {}, {}\n",
            self.case.title,
            across.count,
            up.count,
            self.request.time,
            Self::axis_words(across),
            Self::axis_words(up)
        );
        for (index, attractor) in self.found.attractors.iter().enumerate().take(MOST_LINES) {
            let share = self.share(attractor.count);
            out.push_str(&format!("{share}  {}: {}\n", index + 1, self.words(attractor)));
        }
        let mut rest = |count: usize, words: &str| {
            if count > 0 {
                out.push_str(&format!("{}  {words}\n", self.share(count)));
            }
        };
        let others: usize =
            self.found.attractors.iter().skip(MOST_LINES).map(|attractor| attractor.count).sum();
        let sets = self.found.attractors.len().saturating_sub(MOST_LINES);
        rest(others, &format!("in {sets} smaller sets"));
        rest(
            self.count(|end| *end == Destiny::Further),
            "in more sets than are kept apart: nothing seems to attract",
        );
        rest(
            self.count(|end| *end == Destiny::Unsettled),
            "not settled: they drift, leave, or need a longer --time",
        );
        let first = self.found.ends.iter().find_map(|end| match end {
            Destiny::Ended(problem) => Some(problem.to_string()),
            _ => None,
        });
        if let Some(problem) = first {
            let count = self.count(|end| matches!(end, Destiny::Ended(_)));
            rest(count, &format!("ended early; the first: {problem}"));
        }
        let (near, all) = self.borders();
        if self.found.attractors.len() > 1 {
            let share = 100.0 * near as f64 / all.max(1) as f64;
            out.push_str(&format!(
                "{share:.1} % of the motions have a neighbour in another basin\n"
            ));
        }
        out.push_str(&self.running().unwrap_or_default());
        out
    }

    /// Note on components that run far from the starts, as angles do that turn: all sets near the starts
    /// then count as one.
    fn running(&self) -> Option<String> {
        if self.has_values {
            return None;
        }
        let titles = self.request.columns.titles();
        let runs = |title: &String| {
            let axis = self.request.axes.iter().find(|axis| axis.name == *title)?;
            let place = titles.iter().position(|other| other == title)?;
            let (from, to) = (axis.from.to_f64().0, axis.to.to_f64().0);
            let far = FAR * (to - from);
            let is_far = |own: &Attractor| {
                own.ranges
                    .get(place)
                    .is_some_and(|[low, high]| *low < from - far || *high > to + far)
            };
            self.found.attractors.iter().any(is_far).then_some(())
        };
        let names: Vec<&String> = titles.iter().filter(|title| runs(title).is_some()).collect();
        if names.is_empty() {
            return None;
        }
        let value = |title: &String| match names.contains(&title) {
            true => format!("cos({title}), sin({title})"),
            false => title.clone(),
        };
        let values: Vec<String> = titles.iter().map(value).collect();
        let names: Vec<&str> = names.into_iter().map(String::as_str).collect();
        Some(format!(
            "note: {} far from the starts, so that sets near them count as one; for an angle, compare \
             its cosine and sine: --by '{}'\n",
            match names.as_slice() {
                [only] => format!("{only} runs"),
                all => format!("{} run", all.join(" and ")),
            },
            values.join(", ")
        ))
    }

    /// Kind of an attractor, as far as its first motion shows it.
    fn kind(&self, attractor: &Attractor) -> String {
        match (&attractor.exponents, attractor.is_point) {
            // The motion may move where its values do not.
            (_, true) if self.has_values => "constant".to_string(),
            (_, true) => "point".to_string(),
            (Ok(found), false) => match found.character {
                Character::Regular => "cycle or torus".to_string(),
                Character::UnstableRest => "point".to_string(),
                chaos => format!("{}, exponent {:.4}", chaos.name(), found.largest.mean),
            },
            (Err(_), false) => "set".to_string(),
        }
    }

    fn words(&self, attractor: &Attractor) -> String {
        let titles = self.request.columns.titles().iter();
        let ranges = attractor.ranges.iter().zip(&attractor.last);
        let place =
            |(title, ([from, to], last)): (&String, (&[f64; 2], &f64))| match attractor.is_point {
                true => format!("{title} = {}", short(*last)),
                false => format!("{title} from {} to {}", short(*from), short(*to)),
            };
        let places: Vec<String> = titles.zip(ranges).map(place).collect();
        format!("{}, {}", self.kind(attractor), places.join(", "))
    }

    /// Numbers of settled motions with a neighbour across or upwards in another basin, and of all.
    fn borders(&self) -> (usize, usize) {
        let columns = self.request.axes[0].count.max(1);
        let basin = |place: usize| match self.found.ends.get(place) {
            Some(Destiny::Set(index)) => Some(*index),
            _ => None,
        };
        let settled: Vec<usize> =
            (0..self.found.ends.len()).filter(|place| basin(*place).is_some()).collect();
        let is_near = |place: &&usize| {
            let place = **place;
            let left = (!place.is_multiple_of(columns)).then(|| place - 1);
            let right = (!(place + 1).is_multiple_of(columns)).then_some(place + 1);
            let around = [left, right, place.checked_sub(columns), Some(place + columns)];
            let mut around = around.into_iter().flatten().filter_map(basin);
            around.any(|other| Some(other) != basin(place))
        };
        (settled.iter().filter(is_near).count(), settled.len())
    }

    fn name(end: &Destiny) -> String {
        match end {
            Destiny::Set(index) => (index + 1).to_string(),
            Destiny::Further => "further".to_string(),
            Destiny::Unsettled => "not settled".to_string(),
            Destiny::Ended(_) => "ended".to_string(),
        }
    }

    /// Renders a line for each motion with commas, below a line of titles.
    pub fn csv(&self) -> String {
        let [across, up] = self.request.axes;
        let mut out = format!("i,j,{},{},attractor\n", quoted(&across.name), quoted(&up.name));
        for (place, end) in self.found.ends.iter().enumerate() {
            let (i, j) = (place % across.count, place / across.count);
            let [x, y] = [across.value(i), up.value(j)].map(|value| value.to_f64().0);
            out.push_str(&format!("{i},{j},{x:?},{y:?},{}\n", Self::name(end)));
        }
        out
    }

    /// Renders the attractors and all motions as JSON.
    pub fn json(&self) -> Result<String, String> {
        let axis = |axis: &StateAxis| {
            json!({
                "name": axis.name,
                "from": axis.from.to_f64().0,
                "to": axis.to.to_f64().0,
                "count": axis.count,
            })
        };
        let end = |end: &Destiny| match end {
            Destiny::Set(index) => json!(index + 1),
            Destiny::Ended(problem) => json!(problem.to_string()),
            other => json!(Self::name(other)),
        };
        let attractor = |attractor: &Attractor| {
            let exponent = attractor.exponents.as_ref().ok().map(|found| found.largest.mean);
            json!({
                "count": attractor.count,
                "kind": self.kind(attractor),
                "ranges": attractor.ranges,
                "state": attractor.state,
                "exponent": exponent,
            })
        };
        let [across, up] = self.request.axes;
        let rows: Vec<Vec<_>> = self
            .found
            .ends
            .chunks(across.count.max(1))
            .map(|row| row.iter().map(end).collect())
            .collect();
        let root = json!({
            "title": self.case.title,
            "time": self.request.time,
            "x": axis(across),
            "y": axis(up),
            "by": self.request.columns.titles(),
            "attractors": self.found.attractors.iter().map(attractor).collect::<Vec<_>>(),
            "rows": rows,
        });
        let text = serde_json::to_string(&root).map_err(|error| format!("error: {error}"))?;
        Ok(text + "\n")
    }

    /// Draws the basins, a colour each, with the points among the attractors.
    pub fn plot(&self) -> Plot {
        let axes = self.request.axes;
        let scale = |axis: &StateAxis| {
            Axis::new(math(&axis.name), axis.from.to_f64().0, axis.to.to_f64().0)
        };
        let mut plot = Plot::new(scale(&axes[0]), scale(&axes[1]));
        let colour = |index: usize| CATEGORIES[index % CATEGORIES.len()];
        let paint = |end: &Destiny| match end {
            Destiny::Set(index) => colour(*index),
            Destiny::Further | Destiny::Unsettled => UNSETTLED,
            Destiny::Ended(_) => ENDED,
        };
        let columns = axes[0].count.max(1);
        let rows = self.found.ends.chunks(columns).rev();
        let cells = rows.flat_map(|row| row.iter().map(|end| Some(paint(end)))).collect();
        plot.layers.push(Layer::Cells(columns, cells));
        let mut entry = |paint: Paint, words: &str, count: usize| {
            if count > 0 {
                let share = 100.0 * count as f64 / self.found.ends.len() as f64;
                let text = plain(&format!("{words}, {share:.1} %"));
                plot.legend.push(LegendEntry { mark: MarkShape::Box, paint, text });
            }
        };
        for (index, attractor) in self.found.attractors.iter().enumerate().take(CATEGORIES.len()) {
            entry(colour(index), &self.kind(attractor).replace('-', "−"), attractor.count);
        }
        let lost = |end: &Destiny| matches!(end, Destiny::Further | Destiny::Unsettled);
        entry(UNSETTLED, "not settled", self.count(lost));
        entry(ENDED, "ended early", self.count(|end| matches!(end, Destiny::Ended(_))));
        for attractor in self.found.attractors.iter().filter(|attractor| attractor.is_point) {
            let at = [0, 1].map(|k: usize| attractor.state[axes[k].component]);
            let shares = [plot.across.share(at[0]), plot.up.share(at[1])];
            if shares.iter().all(|share| (0.0..=1.0).contains(share)) {
                let (mark, paint) = (MarkShape::Cross, Paint::Ink);
                plot.marks.push(MarkedPoint { at, mark, paint, label: None, has_rim: true });
            }
        }
        plot
    }

    /// Words below the picture.
    pub fn caption(&self) -> Text {
        let mut found = vec![facts::equation("t", &self.request.time.to_string())];
        let varies = |place: usize| self.request.axes.iter().any(|axis| axis.component == place);
        let fixed = (0..self.case.model.dimension()).filter(|place| !varies(*place));
        found.extend(fixed.map(|place| {
            let name = self.case.model.component_name(place);
            facts::equation(&name, &self.request.base[place].to_string())
        }));
        found.extend(self.request.fixed.iter().map(|own| {
            let name = match &own.function {
                Conserved::Energy => "h",
                function => function.name(),
            };
            facts::equation(name, &own.value.to_string())
        }));
        found.extend(facts::parameters(self.case, &[]));
        facts::listed(found)
    }
}

/// A number in six digits.
fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    // What is left of 0 by rounding is none.
    let shown = if rounded.abs() < 1e-12 { 0.0 } else { rounded };
    shown.to_string()
}
