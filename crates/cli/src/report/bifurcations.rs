//! Report of `diagram`: crossings of a section over a parameter or the energy, as text, JSON, CSV and
//! plots.

use serde_json::json;

use super::data::{missing, quoted};
use super::facts;
use liouville::case::Case;
use liouville_draw::{
    Axis, CATEGORIES, Layer, LegendEntry, MarkShape, Paint, Plot, Text, math, plain,
};
use liouville_flow::{ChartAxis, DiagramOrbit, FlowError};

/// Motions at one value, in the order of their starts.
pub type OrbitsAtValue = Vec<DiagramOrbit>;

/// A bifurcation diagram with what it was asked for.
pub struct DiagramReport<'r> {
    /// Case of the motions.
    pub case: &'r Case,
    /// Name of what varies.
    pub name: &'r str,
    /// Its values.
    pub axis: &'r ChartAxis,
    /// Surface that is crossed; `None` for g = g₀ of a rolling body.
    pub surface: Option<&'r str>,
    /// Names of the values at crossings.
    pub titles: &'r [String],
    /// Names of the starts.
    pub starts: &'r [String],
    /// Motions at each value.
    pub values: &'r [OrbitsAtValue],
}

impl DiagramReport<'_> {
    fn orbits(&self) -> impl Iterator<Item = &DiagramOrbit> + Clone {
        self.values.iter().flatten()
    }

    /// Whether there is no crossing at all.
    pub fn is_empty(&self) -> bool {
        self.orbits().all(|orbit| orbit.crossings.is_empty())
    }

    /// Reason why the first failed motion ended.
    pub fn first_problem(&self) -> Option<&FlowError> {
        self.orbits().find_map(|orbit| orbit.problem.as_ref())
    }

    fn value(&self, index: usize) -> f64 {
        self.axis.value(index).to_f64().0
    }

    fn section(&self) -> String {
        self.surface.map_or("section g = g₀".to_string(), |surface| format!("section {surface}"))
    }

    /// Renders a summary of a few lines.
    pub fn text(&self) -> String {
        let crossings: usize = self.orbits().map(|orbit| orbit.crossings.len()).sum();
        let (from, to) = (self.axis.from.to_f64().0, self.axis.to.to_f64().0);
        let count = |count: usize, one: &str| match count {
            1 => format!("1 {one}"),
            _ => format!("{count} {one}s"),
        };
        let mut out = format!(
            "{}\n{} over {} from {from} to {to}: {}, {} at each, {}\n",
            self.case.title,
            self.section(),
            self.name,
            count(self.values.len(), "value"),
            count(self.starts.len(), "motion"),
            count(crossings, "crossing"),
        );
        out.push_str(&missing(self.titles, self.orbits().flat_map(|orbit| &orbit.crossings)));
        let failed = self.orbits().filter(|orbit| orbit.problem.is_some()).count();
        let first = self.values.iter().enumerate().find_map(|(index, orbits)| {
            orbits.iter().find_map(|orbit| Some((index, orbit.problem.as_ref()?)))
        });
        if let Some((index, problem)) = first {
            let (failed, value) = (count(failed, "motion"), self.value(index));
            out.push_str(&format!(
                "{failed} ended early, the first at {} = {value}: {problem}\n",
                self.name
            ));
        }
        out
    }

    /// Renders a line for each crossing with commas, below a line of titles.
    pub fn csv(&self) -> String {
        let titles = [self.name, "start"].into_iter().chain(self.titles.iter().map(String::as_str));
        let mut out = titles.map(quoted).collect::<Vec<_>>().join(",") + "\n";
        for (index, orbits) in self.values.iter().enumerate() {
            let value = self.value(index);
            for (start, orbit) in orbits.iter().enumerate() {
                for at in &orbit.crossings {
                    let at: String = at.iter().map(|x| format!(",{x:?}")).collect();
                    out.push_str(&format!("{value:?},{start}{at}\n"));
                }
            }
        }
        out
    }

    /// Renders all crossings as JSON.
    pub fn json(&self) -> Result<String, String> {
        let orbit = |(orbit, start): (&DiagramOrbit, &String)| {
            json!({
                "start": start,
                "crossings": orbit.crossings,
                "problem": orbit.problem.as_ref().map(ToString::to_string),
            })
        };
        let column = |(index, orbits): (usize, &OrbitsAtValue)| {
            let orbits: Vec<_> = orbits.iter().zip(self.starts).map(orbit).collect();
            json!({ "value": self.value(index), "orbits": orbits })
        };
        let root = json!({
            "title": self.case.title,
            "over": self.name,
            "from": self.axis.from.to_f64().0,
            "to": self.axis.to.to_f64().0,
            "section": self.surface,
            "axes": self.titles,
            "values": self.values.iter().enumerate().map(column).collect::<Vec<_>>(),
        });
        let text = serde_json::to_string(&root).map_err(|error| format!("error: {error}"))?;
        Ok(text + "\n")
    }

    /// Plots of the values at crossings over what varies, a colour for each start.
    pub fn plots(&self) -> Vec<Plot> {
        self.titles.iter().enumerate().map(|(place, title)| self.plot(place, title)).collect()
    }

    fn plot(&self, place: usize, title: &str) -> Plot {
        let dots = |start: usize| -> Vec<[f64; 2]> {
            let columns = self.values.iter().enumerate();
            let of = |(index, orbits): (usize, &OrbitsAtValue)| -> Vec<[f64; 2]> {
                let value = self.value(index);
                let crossings = orbits.get(start).into_iter().flat_map(|orbit| &orbit.crossings);
                let dots = crossings.filter_map(|at| at.get(place).map(|x| [value, *x]));
                dots.filter(|dot| dot[1].is_finite()).collect()
            };
            columns.flat_map(of).collect()
        };
        let layers: Vec<Vec<[f64; 2]>> = (0..self.starts.len()).map(dots).collect();
        let (from, to) = (self.axis.from.to_f64().0, self.axis.to.to_f64().0);
        let up = match self.surface.is_none() && place == 0 {
            true => Axis::turn(math(title)),
            false => Axis::over(math(title), layers.iter().flatten().map(|dot| dot[1])),
        };
        let mut plot = Plot::new(Axis::new(math(self.name), from, to), up);
        let paint = |start: usize| match self.starts.len() {
            1 => Paint::Ink,
            _ => CATEGORIES[start % CATEGORIES.len()],
        };
        if (2..=CATEGORIES.len()).contains(&self.starts.len()) {
            let entry = |(start, name): (usize, &String)| {
                let text = plain(&facts::unbroken(&name.replace('-', "−")));
                LegendEntry { mark: MarkShape::Disc, paint: paint(start), text }
            };
            plot.legend = self.starts.iter().enumerate().map(entry).collect();
        }
        let layers = layers.into_iter().enumerate();
        plot.layers.extend(layers.map(|(start, dots)| Layer::Dots(dots, paint(start))));
        plot
    }

    /// Words below the picture.
    pub fn caption(&self) -> Text {
        let section = facts::section(self.surface);
        facts::listed(std::iter::once(section).chain(facts::parameters(self.case, &[self.name])))
    }
}
