//! Labels next to points, without overlap: each takes the first free place of a fixed list.

use std::fmt::Write;

use super::escape;

/// Upper estimate of the width of a letter in the labels' type.
const LETTER: f64 = 6.4;
const HEIGHT: f64 = 13.0;
/// Distance from a point to its label.
const GAP: f64 = 9.0;
/// Length of the longest title that fits above a panel.
const LONGEST: usize = 96;

/// Left, top, right and bottom of a rectangle.
type Rectangle = [f64; 4];

/// Places already taken in a panel.
pub struct Labels {
    frame: Rectangle,
    taken: Vec<Rectangle>,
}

impl Labels {
    /// A panel with its markers.
    pub fn new(frame: Rectangle, points: &[(f64, f64)]) -> Self {
        let marker = |(x, y): &(f64, f64)| [x - 6.0, y - 6.0, x + 6.0, y + 6.0];
        Self { frame, taken: points.iter().map(marker).collect() }
    }

    /// Writes a label near a point, if there is room; without one, the legend suffices.
    pub fn put(&mut self, out: &mut String, (x, y): (f64, f64), text: &str) {
        let width = width(text);
        for shift in (0..12).flat_map(|step| [f64::from(step) * -7.0, f64::from(step) * 7.0]) {
            let beside = GAP + shift.abs() * 0.6;
            for left in [x + beside, x - beside - width] {
                if self.try_at(out, (x, y), (left, y + shift), text) {
                    return;
                }
            }
            // Above and below, as far to the right as the frame allows.
            if shift.abs() == 14.0 {
                let left = (x - width / 2.0).min(self.frame[2] - 4.0 - width);
                if self.try_at(out, (x, y), (left, y + shift), text) {
                    return;
                }
            }
        }
    }

    /// Writes the label with this left end and middle height, if the place is free.
    fn try_at(
        &mut self,
        out: &mut String,
        (x, y): (f64, f64),
        (left, middle): (f64, f64),
        text: &str,
    ) -> bool {
        let right = left + width(text);
        let place = [left, middle - HEIGHT / 2.0, right, middle + HEIGHT / 2.0];
        if !self.is_free(&place) {
            return false;
        }
        let over = left < x && x < right;
        let after = left > x;
        if middle != y && !over {
            let end = if after { left - 2.0 } else { right + 2.0 };
            let _ = writeln!(
                out,
                "<line class=\"lead\" x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{end:.1}\" y2=\"{middle:.1}\"/>"
            );
        }
        let (edge, anchor) = match (over, after) {
            (true, _) => ((left + right) / 2.0, "middle"),
            (false, true) => (left, "start"),
            (false, false) => (right, "end"),
        };
        let _ = writeln!(
            out,
            "<text class=\"small label\" x=\"{edge:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{}</text>",
            middle + 4.0,
            escape(text)
        );
        self.taken.push(place);
        true
    }

    fn is_free(&self, place: &Rectangle) -> bool {
        let [left, top, right, bottom] = *place;
        let inside = left >= self.frame[0] + 2.0
            && top >= self.frame[1] + 2.0
            && right <= self.frame[2] - 2.0
            && bottom <= self.frame[3] - 2.0;
        let apart = |other: &Rectangle| {
            right < other[0] || other[2] < left || bottom < other[1] || other[3] < top
        };
        inside && self.taken.iter().all(apart)
    }
}

/// Approximate width of a text.
pub fn width(text: &str) -> f64 {
    text.chars().count() as f64 * LETTER
}

/// Shortens a title to the length that fits.
pub fn shortened(text: &str) -> String {
    if text.chars().count() <= LONGEST {
        return text.to_string();
    }
    text.chars().take(LONGEST - 1).chain(['…']).collect()
}
