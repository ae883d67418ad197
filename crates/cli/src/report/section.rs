//! Report of `section`: the crossings as JSON, a summary as text, and the plot.

pub mod drawing;
pub mod sphere;

use serde_json::{Value, json};

use liouville::case::{Case, Direction};
use liouville_flow::{AreaForm, Character, SectionOrbit, SectionRequest};

use super::counted;
use super::exponents::{MotionRow, classes};

/// Says that crossings in the other direction are left out.
pub fn left_out(others: usize) -> String {
    let are = if others == 1 { "is" } else { "are" };
    format!("{} in the other direction {are} left out", counted(others, "crossing"))
}

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
    pub classes: Option<&'r [MotionRow]>,
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
            "{}\nsection g = {}, energy {}: {}, {}, {}\n\
             largest drift of the energy {worst:.1e}\n",
            self.case.title,
            request.g0,
            request.energy,
            counted(self.orbits.len(), "orbit"),
            counted(crossings, "crossing"),
            counted(steps as usize, "step")
        );
        let falling = self.count(|orbit| orbit.crossings.iter().filter(|c| !c.rising).count());
        let others = self.count(|orbit| orbit.others);
        let tangencies = self.count(|orbit| orbit.tangencies);
        match request.direction {
            Direction::Both if falling > 0 && falling < crossings => out.push_str(&format!(
                "{falling} of the crossings {} g' < 0: the section is not crossed one way only\n",
                if falling == 1 { "has" } else { "have" }
            )),
            Direction::Up | Direction::Down if others > 0 => {
                out.push_str(&format!("{}\n", left_out(others)));
            }
            _ => {}
        }
        if tangencies > 0 {
            let times = counted(tangencies, "time");
            out.push_str(&format!("{times} the section was touched, not crossed\n"));
        }
        let mut problems: Vec<(String, usize)> = Vec::new();
        for problem in self.orbits.iter().filter_map(|orbit| orbit.problem.as_ref()) {
            match problems.last_mut() {
                Some((_, count)) => *count += 1,
                None => problems.push((problem.to_string(), 1)),
            }
        }
        for (problem, count) in problems {
            let orbits = counted(count, "orbit");
            out.push_str(&format!("{orbits} ended early; the first: {problem}\n"));
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
