//! Labels next to points, without overlap: each takes the first free place of a fixed list.

use crate::font::width;
use crate::palette::Paint;
use crate::scene::{Anchor, Point, SceneItem};
use crate::text::plain;

/// Left, top, right and bottom of a rectangle.
type Rectangle = [f64; 4];

/// Places already taken in a plot.
pub struct Labels {
    frame: Rectangle,
    taken: Vec<Rectangle>,
    size: f64,
}

impl Labels {
    /// A plot with its signs, and labels in type of a size.
    pub fn new(frame: Rectangle, points: &[Point], size: f64) -> Self {
        let reach = 0.55 * size;
        let sign = |[x, y]: &Point| [x - reach, y - reach, x + reach, y + reach];
        Self { frame, taken: points.iter().map(sign).collect(), size }
    }

    /// Writes a label near a point, if there is room; without one, the legend suffices.
    pub fn put(&mut self, out: &mut Vec<SceneItem>, [x, y]: Point, words: &str) {
        let (width, step) = (width(words, self.size), 0.65 * self.size);
        for shift in (0..12).flat_map(|k| [f64::from(k) * -step, f64::from(k) * step]) {
            let beside = 0.85 * self.size + shift.abs() * 0.6;
            for left in [x + beside, x - beside - width] {
                if self.try_at(out, [x, y], [left, y + shift], words) {
                    return;
                }
            }
            // Above and below, as far to the right as the frame allows.
            if shift.abs() > 1.5 * step && shift.abs() < 2.5 * step {
                let left = (x - width / 2.0).min(self.frame[2] - 0.4 * self.size - width);
                if self.try_at(out, [x, y], [left, y + shift], words) {
                    return;
                }
            }
        }
    }

    /// Writes the label with this left end and middle height, if the place is free.
    fn try_at(
        &mut self,
        out: &mut Vec<SceneItem>,
        [x, y]: Point,
        [left, middle]: Point,
        words: &str,
    ) -> bool {
        let right = left + width(words, self.size);
        let place = [left, middle - 0.6 * self.size, right, middle + 0.6 * self.size];
        if !self.is_free(&place) {
            return false;
        }
        let over = left < x && x < right;
        if middle != y && !over {
            let end = if left > x { left - 0.2 * self.size } else { right + 0.2 * self.size };
            out.push(SceneItem::Lines {
                lines: vec![vec![[x, y], [end, middle]]],
                width: 0.06 * self.size,
                paint: Paint::Soft,
                opacity: 1.0,
            });
        }
        out.push(SceneItem::Words {
            at: [left, middle + 0.36 * self.size],
            text: plain(words),
            size: self.size,
            anchor: Anchor::Start,
            turned: false,
            paint: Paint::Ink,
        });
        self.taken.push(place);
        true
    }

    fn is_free(&self, place: &Rectangle) -> bool {
        let [left, top, right, bottom] = *place;
        let rim = 0.2 * self.size;
        let inside = left >= self.frame[0] + rim
            && top >= self.frame[1] + rim
            && right <= self.frame[2] - rim
            && bottom <= self.frame[3] - rim;
        let apart = |other: &Rectangle| {
            right < other[0] || other[2] < left || bottom < other[1] || other[3] < top
        };
        inside && self.taken.iter().all(apart)
    }
}
