//! Report of `periodic` of a map: periodic points with their multipliers, and all of them in a box.

use liouville::case::Case;
use liouville_flow::{CycleKind, MapBox, MapPoint, MapPoints};
use serde_json::{Value, json};

use super::counted;
use super::cycle::{kind, multiplier, shown, written};

/// Number of parts of a box that are named where nothing is known.
const NAMED: usize = 3;

/// Points in a box.
pub struct BoxReport<'r> {
    /// Case of the map.
    pub case: &'r Case,
    /// Box and period.
    pub of: &'r MapBox,
    /// Points, and what is open.
    pub found: &'r MapPoints,
}

impl BoxReport<'_> {
    /// Renders the points as text.
    pub fn text(&self) -> String {
        let Self { case, of, found } = self;
        let ranges: Vec<String> = (0..of.ends.len())
            .map(|k| {
                let [low, high] = of.ends[k];
                format!("{} in {low:?}..{high:?}", case.model.component_name(k))
            })
            .collect();
        let count = match found.points.len() {
            0 => "no point".to_string(),
            count => counted(count, "point"),
        };
        let grounds = match self.is_complete() {
            true => "proved: these are all",
            false => "there may be more",
        };
        let boxes = match found.looked_at {
            1 => "1 box".to_string(),
            count => format!("{count} boxes"),
        };
        let mut out = format!(
            "{count} of period {} for {} ({grounds}, by {boxes})\n",
            of.period,
            ranges.join(", "),
        );
        let mut seen: Vec<&MapPoint> = Vec::new();
        for point in &found.points {
            if seen.iter().any(|own| self.is_on(own, point)) {
                continue;
            }
            seen.push(point);
            out.push_str(&text(case, point, of.period));
        }
        for (middle, radii) in found.open.iter().take(NAMED) {
            let wide = raised(radii.iter().copied().fold(0.0, f64::max));
            out.push_str(&format!("not decided: within {wide} of {}\n", state(case, middle)));
        }
        if found.open.len() > NAMED {
            let rest = found.open.len() - NAMED;
            let parts = counted(rest, "part");
            out.push_str(&format!("not decided: {parts} more; give a smaller box\n"));
        }
        out
    }

    /// Renders the points as JSON.
    pub fn json(&self) -> Result<String, String> {
        let open =
            |(middle, radii): &(Vec<f64>, Vec<f64>)| json!({ "middle": middle, "radii": radii });
        let root = json!({
            "title": self.case.title,
            "period": self.of.period,
            "box": self.of.ends,
            "complete": self.is_complete(),
            "points": self.found.points.iter().map(entry).collect::<Vec<_>>(),
            "open": self.found.open.iter().map(open).collect::<Vec<_>>(),
        });
        rendered(&root)
    }

    /// Whether a point is the one of those in the box that is next to some point of a cycle.
    fn is_on(&self, cycle: &MapPoint, point: &MapPoint) -> bool {
        let distance = |own: &MapPoint, at: &[f64]| {
            let apart = own.cycle[0].iter().zip(at).map(|(x, y)| (x - y).abs());
            apart.fold(0.0, f64::max)
        };
        let is_inside = |at: &&Vec<f64>| {
            at.iter().zip(&self.of.ends).all(|(x, [low, high])| low <= x && x <= high)
        };
        let is_next = |at: &Vec<f64>| {
            let own = distance(point, at);
            self.found.points.iter().all(|other| own <= distance(other, at))
        };
        cycle.period == point.period && cycle.cycle.iter().filter(is_inside).any(is_next)
    }

    /// Whether all points of the period in the box are known, and proved.
    fn is_complete(&self) -> bool {
        self.found.open.is_empty() && self.found.points.iter().all(|point| point.proof.is_ok())
    }
}

/// Renders a point in a few lines; `asked` is the period that was asked for.
pub fn text(case: &Case, point: &MapPoint, asked: usize) -> String {
    let what = match point.period {
        1 => "fixed point".to_string(),
        period => format!("cycle of {period} points"),
    };
    let word = match point.kind {
        Some(CycleKind::Elliptic) => "elliptic: the moduli are 1 within their errors",
        Some(own) => kind(Some(own)),
        None => "kind undecided: a multiplier has the modulus 1 within its error",
    };
    let mut out = format!("{what}: {word}\n");
    for at in &point.cycle {
        out.push_str(&format!("  {}\n", state(case, at)));
    }
    for one in point.multipliers.iter().filter(|one| one.im >= 0.0) {
        out.push_str(&format!("  multiplier{}\n", written(one)));
    }
    if let Some(determinant) = point.determinant.filter(|_| point.multipliers.len() > 1) {
        out.push_str(&format!("  product {}\n", shown(determinant)));
    }
    if asked > point.period {
        out.push_str(&format!("  its period divides {asked}\n"));
    }
    match &point.proof {
        Ok(radii) => {
            let wide = raised(radii.iter().copied().fold(0.0, f64::max));
            let least = match point.is_least {
                true => format!("least period {}", point.period),
                false => format!("period {}, which is not proved to be the least,", point.period),
            };
            out.push_str(&format!(
                "  proved: one point of {least} lies within {wide} of the first, and no other of this \
                 period\n"
            ));
        }
        Err(reason) => out.push_str(&format!("  numerical, not proved: {reason}\n")),
    }
    out
}

/// Renders points as JSON.
pub fn json(case: &Case, points: &[MapPoint]) -> Result<String, String> {
    rendered(&json!({
        "title": case.title,
        "points": points.iter().map(entry).collect::<Vec<_>>(),
    }))
}

fn rendered(root: &Value) -> Result<String, String> {
    Ok(serde_json::to_string_pretty(root).map_err(|error| format!("error: {error}"))? + "\n")
}

fn entry(point: &MapPoint) -> Value {
    json!({
        "period": point.period,
        "cycle": point.cycle,
        "proved": point.proof.is_ok(),
        "radii": point.proof.as_ref().ok(),
        "least": point.is_least,
        "kind": kind(point.kind),
        "multipliers": point.multipliers.iter().map(multiplier).collect::<Vec<_>>(),
    })
}

/// Prints a bound with one digit, rounded up.
fn raised(bound: f64) -> String {
    let power = libm::pow(10.0, libm::floor(libm::log10(bound)));
    // A part of a digit above, against the rounding of the quotient.
    let digit = libm::ceil(bound / power * (1.0 + 1e-9));
    format!("{:.0e}", digit * power)
}

fn state(case: &Case, state: &[f64]) -> String {
    let part = |(k, x): (usize, &f64)| format!("{} = {:?}", case.model.component_name(k), x + 0.0);
    state.iter().enumerate().map(part).collect::<Vec<_>>().join(", ")
}
