//! Lines of a section whose images are drawn: the fixed points of reversing involutions (A.1.9),
//! (A.1.10) of Bizyaev, Borisov, Mamaev (2013).

use std::f64::consts::PI;

/// Line of fixed points of a reversor of the section map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FixedLine {
    /// The line L = 0.
    Equator,
    /// The lines l = 0 and l = π.
    Meridian,
    /// The lines l = π/2 and l = 3π/2.
    QuarterMeridian,
}

impl std::str::FromStr for FixedLine {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let plain: String = text.split_whitespace().collect();
        match plain.replace("pi", "π").as_str() {
            "L=0" => Ok(FixedLine::Equator),
            "l=0" => Ok(FixedLine::Meridian),
            "l=π/2" => Ok(FixedLine::QuarterMeridian),
            _ => Err(format!(
                "`{text}` is not a line of a rolling body's section; write L=0, l=0 or l=π/2"
            )),
        }
    }
}

impl FixedLine {
    /// Returns `count` points of the line.
    pub fn points(self, count: usize) -> Vec<[f64; 2]> {
        let along = |k: usize, count: usize| (k as f64 + 0.5) / count.max(1) as f64;
        let meridians = |first: f64| {
            let half = count / 2;
            let at = |k: usize| {
                let (l, place) = if k < half { (first, k) } else { (first + PI, k - half) };
                // Equal angles from pole to pole.
                [l, libm::cos(PI * along(place, count - half))]
            };
            (0..count).map(at).collect()
        };
        match self {
            FixedLine::Equator => (0..count).map(|k| [2.0 * PI * along(k, count), 0.0]).collect(),
            FixedLine::Meridian => meridians(0.0),
            FixedLine::QuarterMeridian => meridians(PI / 2.0),
        }
    }
}
