//! Report of `section`: the crossings as JSON, a summary as text, and the picture of both.

use serde_json::{Value, json};

use super::picture::{Dot, Layer, Picture, Scale, Tint};
use liouville::case::{Case, Direction};
use liouville_flow::{AreaForm, Character, SectionOrbit, SectionRequest, Separatrices};

use super::exponents::{Row, classes};

/// A section with its request.
pub struct SectionReport<'r> {
    /// Case of the section.
    pub case: &'r Case,
    /// Request of the section.
    pub request: &'r SectionRequest,
    /// Orbits, one for each start.
    pub orbits: &'r [SectionOrbit],
    /// Tests of the area forms of claimed densities.
    pub areas: &'r [AreaForm],
    /// Orbits with their exponents, if these were requested.
    pub classes: Option<&'r [Row]>,
}

impl SectionReport<'_> {
    fn count(&self, of: impl Fn(&SectionOrbit) -> usize) -> usize {
        self.orbits.iter().map(of).sum()
    }

    /// Renders a summary of a few lines.
    pub fn text(&self) -> String {
        let request = self.request;
        let crossings = self.count(|orbit| orbit.crossings.len());
        let steps: u64 = self.orbits.iter().map(|orbit| orbit.steps).sum();
        let worst = self.orbits.iter().map(|orbit| orbit.drift).fold(0.0, f64::max);
        let mut out = format!(
            "{}\nsection g = {}, energy {}: {} orbits, {crossings} crossings, {steps} steps\n\
             largest drift of the energy {worst:.1e}\n",
            self.case.title,
            request.g0,
            request.energy,
            self.orbits.len()
        );
        let falling = self.count(|orbit| orbit.crossings.iter().filter(|c| !c.rising).count());
        let others = self.count(|orbit| orbit.others);
        let tangencies = self.count(|orbit| orbit.tangencies);
        match request.direction {
            Direction::Both if falling > 0 && falling < crossings => out.push_str(&format!(
                "{falling} of the crossings have g' < 0: the section is not crossed one way only\n"
            )),
            Direction::Up | Direction::Down if others > 0 => {
                out.push_str(&format!("{others} crossings in the other direction are left out\n"));
            }
            _ => {}
        }
        if tangencies > 0 {
            out.push_str(&format!("{tangencies} times the section was touched, not crossed\n"));
        }
        let mut problems: Vec<(String, usize)> = Vec::new();
        for problem in self.orbits.iter().filter_map(|orbit| orbit.problem.as_ref()) {
            match problems.last_mut() {
                Some((_, count)) => *count += 1,
                None => problems.push((problem.to_string(), 1)),
            }
        }
        for (problem, count) in problems {
            out.push_str(&format!("{count} orbits ended early; the first: {problem}\n"));
        }
        for area in self.areas {
            out.push_str(&area_line(area));
        }
        out.extend(self.classes.map(classes));
        out
    }

    /// Renders all crossings as JSON.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        let orbits: Vec<Value> = self
            .orbits
            .iter()
            .map(|orbit| {
                let points: Vec<Value> =
                    orbit.crossings.iter().map(|c| json!([c.at[0], c.at[1], c.time])).collect();
                json!({
                    "start": orbit.start,
                    "crossings": points,
                    "falling": orbit.crossings.iter().filter(|c| !c.rising).count(),
                    "others": orbit.others,
                    "tangencies": orbit.tangencies,
                    "steps": orbit.steps,
                    "drift": orbit.drift,
                    "problem": orbit.problem.as_ref().map(ToString::to_string),
                })
            })
            .collect();
        serde_json::to_string(&json!({
            "title": self.case.title,
            "g0": self.request.g0.to_string(),
            "energy": self.request.energy.to_string(),
            "orbits": orbits,
            "areas": self.areas.iter().map(area_entry).collect::<Vec<_>>(),
            "classes": self.classes.map(|rows| {
                rows.iter().map(|row| row.class().map(Character::name)).collect::<Vec<_>>()
            }),
        }))
    }
}

fn area_line(area: &AreaForm) -> String {
    if area.points == 0 {
        return format!("area form of `{}`: no return was followed\n", area.claim);
    }
    let verdict = match area.broken {
        None => "kept".to_string(),
        Some([l, z]) => format!("NOT kept, first at ({l:.4}, {z:.4})"),
    };
    format!(
        "area form of `{}`: {verdict}; over one return it changes by {:.1e} ± {:.1e} at most ({} points)\n",
        area.claim, area.deviation, area.error, area.points
    )
}

fn area_entry(area: &AreaForm) -> Value {
    json!({
        "claim": area.claim,
        "kept": area.broken.is_none(),
        "points": area.points,
        "deviation": area.deviation,
        "error": area.error,
    })
}

/// Draws the picture of a section. Colours follow `values`, one for each orbit, or else the order
/// of the orbits.
pub fn picture(
    title: &str,
    orbits: &[SectionOrbit],
    values: Option<&[f64]>,
    width: u32,
) -> Picture {
    let shades = match values {
        Some(values) => ranks(values),
        None => (0..orbits.len()).map(shade).collect(),
    };
    let dots = |orbit: &SectionOrbit| {
        orbit.crossings.iter().map(|c| Dot { x: c.at[0], y: c.at[1] }).collect()
    };
    let layers = orbits.iter().zip(shades);
    Picture {
        title: title.to_string(),
        across: Scale::longitude(),
        up: Scale::height(),
        layers: layers
            .map(|(orbit, shade)| Layer {
                tint: Tint::Shade(shade),
                dots: dots(orbit),
                joined: false,
            })
            .collect(),
        overlay: Vec::new(),
        marks: Vec::new(),
        width,
    }
}

/// Position on the colour scale of the orbit with this index: neighbours are far apart.
pub(super) fn shade(index: usize) -> f64 {
    (0.5 + index as f64 * 0.618_033_988_75).fract()
}

/// Adds the images of lines to a picture, each in a different colour.
pub fn draw_lines(picture: &mut Picture, lines: &[Vec<SectionOrbit>]) {
    for (index, orbits) in lines.iter().enumerate() {
        let start = |orbit: &SectionOrbit| Dot { x: orbit.start[0], y: orbit.start[1] };
        let crossings = orbits.iter().flat_map(|orbit| &orbit.crossings);
        let mut dots: Vec<Dot> = crossings.map(|c| Dot { x: c.at[0], y: c.at[1] }).collect();
        dots.extend(orbits.iter().map(start));
        let tint = Tint::Shade(index as f64 / 2.0);
        picture.layers.push(Layer { tint, dots, joined: false });
    }
}

/// Positions of red and blue on the colour scale.
const UNSTABLE: f64 = 0.0;
const STABLE: f64 = 0.7;

/// Draws separatrices over a section, whose points become pale: unstable curves red, stable ones
/// blue.
pub fn draw_separatrices(picture: &mut Picture, all: &[Separatrices]) {
    if all.is_empty() {
        return;
    }
    picture.layers.iter_mut().for_each(|layer| layer.tint = Tint::Faint);
    for found in all {
        for (orbits, shade) in [(&found.stable, STABLE), (&found.unstable, UNSTABLE)] {
            let crossings = orbits.iter().flat_map(|orbit| &orbit.crossings);
            let dots = crossings.map(|c| Dot { x: c.at[0], y: c.at[1] }).collect();
            picture.layers.push(Layer { tint: Tint::Shade(shade), dots, joined: false });
        }
        picture.marks.push(Dot { x: found.point.at[0], y: found.point.at[1] });
    }
}

/// Rank of each value, from 0 for the least to 1 for the largest.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    let last = values.len().saturating_sub(1).max(1) as f64;
    for (rank, index) in order.into_iter().enumerate() {
        ranks[index] = rank as f64 / last;
    }
    ranks
}
