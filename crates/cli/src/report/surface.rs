//! Report of `section` by a surface: the crossings as JSON, a summary as text, and the plot.

use serde_json::{Value, json};

use super::counted;
use super::data::missing;
use super::section::drawing::shade;
use super::section::left_out;
use liouville::case::{Case, Direction};
use liouville_draw::{Axis, CountGrid, Layer, Plot, gradient, math};
use liouville_flow::{SurfaceOrbit, SurfaceRequest};

/// Crossings of a surface with their request.
pub struct SurfaceReport<'r> {
    /// Case of the section.
    pub case: &'r Case,
    /// Request of the section.
    pub request: &'r SurfaceRequest<'r>,
    /// Names of the starts.
    pub names: &'r [String],
    /// Motions, one for each start.
    pub orbits: &'r [SurfaceOrbit],
}

impl SurfaceReport<'_> {
    fn count(&self, of: impl Fn(&SurfaceOrbit) -> usize) -> usize {
        self.orbits.iter().map(of).sum()
    }

    /// Renders a summary of a few lines.
    pub fn text(&self) -> String {
        let crossings = self.count(|orbit| orbit.crossings.len());
        let steps: u64 = self.orbits.iter().map(|orbit| orbit.steps).sum();
        let mut out = format!(
            "{}\nsection {}: {}, {}, {}\n",
            self.case.title,
            self.request.surface.text(),
            counted(self.orbits.len(), "orbit"),
            counted(crossings, "crossing"),
            counted(steps as usize, "step")
        );
        // Of a motion that ended early, as one that escapes, the energy says nothing.
        let whole = self.orbits.iter().filter(|orbit| orbit.problem.is_none());
        let drifts = whole.filter_map(|orbit| orbit.drift);
        if let Some(worst) = drifts.reduce(|a, b| if b > a || b.is_nan() { b } else { a }) {
            out.push_str(&format!("largest change of the energy {worst:.1e}\n"));
        }
        let falling = self.count(|orbit| orbit.crossings.iter().filter(|c| !c.rising).count());
        let (others, tangencies) =
            (self.count(|orbit| orbit.others), self.count(|orbit| orbit.tangencies));
        match self.request.direction {
            Direction::Both if falling > 0 && falling < crossings => {
                let are = if falling == 1 { "is" } else { "are" };
                out.push_str(&format!("{falling} of the crossings {are} downwards\n"));
            }
            Direction::Up | Direction::Down if others > 0 => {
                out.push_str(&format!("{}\n", left_out(others)));
            }
            _ => {}
        }
        if tangencies > 0 {
            let times = counted(tangencies, "time");
            out.push_str(&format!("{times} the surface was touched, not crossed\n"));
        }
        let met = self.orbits.iter().flat_map(|orbit| &orbit.crossings).map(|met| &met.at);
        out.push_str(&missing(self.request.axes.titles(), met));
        for (name, orbit) in self.names.iter().zip(self.orbits) {
            if let Some(problem) = &orbit.problem {
                let after = match orbit.crossings.len() {
                    0 => String::new(),
                    found => format!("ended after {}: ", counted(found, "crossing")),
                };
                out.push_str(&format!("{name}: {after}{problem}\n"));
            }
        }
        out
    }

    /// Renders all crossings as JSON.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        let orbits = self.names.iter().zip(self.orbits).map(|(name, orbit)| {
            let crossing = |met: &liouville_flow::SurfaceCrossing| json!({ "at": met.at, "t": met.time, "rising": met.rising });
            json!({
                "start": name,
                "crossings": orbit.crossings.iter().map(crossing).collect::<Vec<_>>(),
                "others": orbit.others,
                "tangencies": orbit.tangencies,
                "steps": orbit.steps,
                "drift": orbit.drift,
                "problem": orbit.problem.as_ref().map(ToString::to_string),
            })
        });
        serde_json::to_string(&json!({
            "title": self.case.title,
            "section": self.request.surface.text(),
            "axes": self.request.axes.titles(),
            "orbits": orbits.collect::<Vec<Value>>(),
        }))
    }
}

/// Draws the first two axes of crossings, a colour for each motion, or their density in cells.
pub fn plot(axes: &[String], orbits: &[SurfaceOrbit], cells: Option<[usize; 2]>) -> Plot {
    let value = |at: &[f64], place: usize| at.get(place).copied().unwrap_or(f64::NAN);
    let scale = |place: usize| {
        let crossings = orbits.iter().flat_map(|orbit| &orbit.crossings);
        let name = axes.get(place).map_or("", String::as_str);
        Axis::over(math(name), crossings.map(|met| value(&met.at, place)))
    };
    let dots = |orbit: &SurfaceOrbit| {
        let dots = orbit.crossings.iter().map(|met| [value(&met.at, 0), value(&met.at, 1)]);
        dots.filter(|dot| dot.iter().all(|x| x.is_finite())).collect::<Vec<_>>()
    };
    let mut plot = Plot::new(scale(0), scale(1));
    if let Some(cells) = cells {
        let points = orbits.iter().flat_map(dots);
        let density = CountGrid::of(points, &plot.across, &plot.up, cells);
        plot.bar = Some(density.bar());
        plot.layers.push(Layer::Density(density));
        return plot;
    }
    let layers = orbits.iter().enumerate();
    plot.layers
        .extend(layers.map(|(index, orbit)| Layer::Dots(dots(orbit), gradient(shade(index)))));
    plot
}
