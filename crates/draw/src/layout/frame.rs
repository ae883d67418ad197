//! Drawing of one plot in its frame.

use std::collections::BTreeMap;

use super::Layout;
use crate::axis::Axis;
use crate::figure::{Figure, words};
use crate::labels::Labels;
use crate::palette::Paint;
use crate::plot::{Bar, Layer, MarkedPoint, Plot};
use crate::scene::{Anchor, Outline, Point, SceneItem};
use crate::text::{Text, plain};

/// Widths of lines in millimetres.
const HAIR: f64 = 0.15;
const STROKE: f64 = 0.28;
/// Lengths of a dash and of the gap behind it, in millimetres.
const DASH: [f64; 2] = [1.1, 0.8];

fn lines(lines: Vec<Vec<Point>>, width: f64, paint: Paint) -> SceneItem {
    SceneItem::Lines { lines, width, paint, opacity: 1.0 }
}

fn turned(at: Point, text: &Text, size: f64) -> SceneItem {
    let (text, anchor) = (text.clone(), Anchor::Middle);
    SceneItem::Words { at, text, size, anchor, turned: true, paint: Paint::Ink }
}

impl Layout {
    /// Draws a plot with its axes and its letter.
    pub fn draw(&self, out: &mut Vec<SceneItem>, figure: &Figure, plot: &Plot, place: usize) {
        let Some(frame) = self.frames.get(place).copied() else { return };
        let [left, top, wide, high] = frame;
        let at = |[x, y]: [f64; 2]| {
            [left + plot.across.share(x) * wide, top + (1.0 - plot.up.share(y)) * high]
        };
        if plot.grid {
            self.grid(out, plot, frame);
        }
        for layer in &plot.layers {
            self.layer(out, figure, layer, frame, &at);
        }
        if let (None, Some(letter)) = (&plot.title, figure.letter(place)) {
            self.letter(out, &letter, frame);
        }
        self.outline(out, frame);
        self.signs(out, plot, frame, &at);
        let column = place % self.columns;
        let has_below = place + self.columns < self.frames.len();
        self.across_axis(out, &plot.across, frame, !(self.shares[0] && has_below));
        let is_first = column == 0 || !self.shares[1];
        self.up_axis(
            out,
            &plot.up,
            frame,
            is_first,
            self.lefts.get(column).copied().unwrap_or(0.0),
        );
        if let Some(title) = &plot.title {
            let title = title.wrapped(self.type_size, wide);
            let first =
                top - 0.45 * self.type_size - 1.35 * self.type_size * (title.len() as f64 - 1.0);
            for (k, line) in title.iter().enumerate() {
                let baseline = first + 1.35 * self.type_size * k as f64;
                out.push(words([left, baseline], line, self.type_size, Anchor::Start));
            }
        }
        if let (Some(bar), None) = (&plot.bar, &self.common_bar) {
            self.draw_bar(out, bar, frame);
        }
    }

    fn outline(&self, out: &mut Vec<SceneItem>, [left, top, wide, high]: [f64; 4]) {
        let corners =
            vec![[left, top], [left + wide, top], [left + wide, top + high], [left, top + high]];
        out.push(SceneItem::Shape {
            outline: Outline::Polygon(corners),
            fill: None,
            stroke: Some((Paint::Soft, HAIR)),
            opacity: 1.0,
        });
    }

    fn letter(&self, out: &mut Vec<SceneItem>, letter: &Text, [left, top, ..]: [f64; 4]) {
        let size = self.type_size;
        let (width, rim) = (letter.width(size), 0.3 * size);
        let (right, bottom) = (left + width + 2.0 * rim, top + 1.45 * size);
        out.push(SceneItem::Shape {
            outline: Outline::Polygon(vec![
                [left, top],
                [right, top],
                [right, bottom],
                [left, bottom],
            ]),
            fill: Some(Paint::Paper),
            stroke: None,
            opacity: 0.85,
        });
        out.push(words([left + rim, top + 1.05 * size], letter, size, Anchor::Start));
    }

    fn grid(&self, out: &mut Vec<SceneItem>, plot: &Plot, [left, top, wide, high]: [f64; 4]) {
        let across =
            plot.across.ticks.iter().map(|(value, _)| left + plot.across.share(*value) * wide);
        let up = plot.up.ticks.iter().map(|(value, _)| top + (1.0 - plot.up.share(*value)) * high);
        let all = across
            .map(|x| vec![[x, top], [x, top + high]])
            .chain(up.map(|y| vec![[left, y], [left + wide, y]]));
        out.push(lines(all.collect(), HAIR, Paint::Grid));
    }

    fn layer(
        &self,
        out: &mut Vec<SceneItem>,
        figure: &Figure,
        layer: &Layer,
        [left, top, wide, high]: [f64; 4],
        at: &impl Fn([f64; 2]) -> Point,
    ) {
        let rim = 1e-6;
        let is_inside = |[x, y]: &Point| {
            (left - rim..=left + wide + rim).contains(x)
                && (top - rim..=top + high + rim).contains(y)
        };
        let (diameter, opacity) = (figure.size.dot, figure.size.opacity);
        match layer {
            Layer::Dots(points, paint) => {
                let at = points.iter().map(|point| at(*point)).filter(is_inside).collect();
                out.push(SceneItem::Dots { at, diameter, paint: *paint, opacity });
            }
            Layer::Line(points, paint) | Layer::Dashes(points, paint) => {
                let placed: Vec<Point> = points.iter().map(|point| at(*point)).collect();
                let pieces = placed.split(|point| !is_inside(point));
                let pieces = pieces.filter(|piece| piece.len() > 1);
                let lines = match layer {
                    Layer::Dashes(..) => pieces.flat_map(dashes).collect(),
                    _ => pieces.map(<[Point]>::to_vec).collect(),
                };
                out.push(SceneItem::Lines { lines, width: STROKE, paint: *paint, opacity });
            }
            Layer::Cells(columns, paints) => {
                cells(out, *columns, paints, [left, top, wide, high]);
            }
            Layer::Density(density) => out.push(SceneItem::Image {
                place: [left, top, wide, high],
                columns: density.columns(),
                pixels: density.paints(),
            }),
        }
    }

    fn signs(
        &self,
        out: &mut Vec<SceneItem>,
        plot: &Plot,
        [left, top, wide, high]: [f64; 4],
        at: &impl Fn([f64; 2]) -> Point,
    ) {
        let size = 0.36 * self.type_size;
        let points: Vec<Point> = plot.marks.iter().map(|sign| at(sign.at)).collect();
        let both = || plot.marks.iter().zip(&points);
        out.extend(
            both()
                .filter(|(sign, _)| sign.has_rim)
                .filter_map(|(sign, at)| sign.mark.halo(*at, size)),
        );
        both().for_each(|(sign, at)| out.extend(sign.mark.items(*at, size, sign.paint)));
        let mut labels =
            Labels::new([left, top, left + wide, top + high], &points, 0.86 * self.type_size);
        // From the right: points there have the fewest places for a label.
        let mut order: Vec<(&MarkedPoint, &Point)> = both().collect();
        order.sort_by(|a, b| b.1[0].total_cmp(&a.1[0]));
        for (sign, at) in order {
            if let Some(label) = &sign.label {
                labels.put(out, *at, label);
            }
        }
    }

    fn across_axis(
        &self,
        out: &mut Vec<SceneItem>,
        axis: &Axis,
        [left, top, wide, high]: [f64; 4],
        named: bool,
    ) {
        let (size, bottom) = (self.type_size, top + high);
        let place = |value: f64| left + axis.share(value) * wide;
        let ticks = axis.ticks.iter().map(|(value, _)| {
            let x = place(*value);
            vec![[x, bottom], [x, bottom + 0.3 * size]]
        });
        out.push(lines(ticks.collect(), HAIR, Paint::Soft));
        if !named {
            return;
        }
        let every = spacing(axis, wide, size);
        let shown = axis.ticks.iter().filter(|(value, _)| is_shown(axis, *value, every));
        for (value, word) in shown {
            out.push(words(
                [place(*value), bottom + 1.35 * size],
                &plain(word),
                size,
                Anchor::Middle,
            ));
        }
        if !axis.name.is_empty() {
            out.push(words(
                [left + wide / 2.0, bottom + 2.85 * size],
                &axis.name,
                size,
                Anchor::Middle,
            ));
        }
    }

    fn up_axis(
        &self,
        out: &mut Vec<SceneItem>,
        axis: &Axis,
        [left, top, _, high]: [f64; 4],
        named: bool,
        room: f64,
    ) {
        let size = self.type_size;
        let place = |value: f64| top + (1.0 - axis.share(value)) * high;
        let ticks = axis.ticks.iter().map(|(value, _)| {
            let y = place(*value);
            vec![[left, y], [left - 0.3 * size, y]]
        });
        out.push(lines(ticks.collect(), HAIR, Paint::Soft));
        if !named {
            return;
        }
        for (value, word) in &axis.ticks {
            out.push(words(
                [left - 0.55 * size, place(*value) + 0.36 * size],
                &plain(word),
                size,
                Anchor::End,
            ));
        }
        if !axis.name.is_empty() {
            let name = left - self.left(axis).min(room) + 0.95 * size;
            out.push(turned([name, top + high / 2.0], &axis.name, size));
        }
    }

    /// Frame beside which the bar of all plots stands: from the first row to the last.
    pub fn bar_frame(&self) -> [f64; 4] {
        let last = self.frames.get(self.columns.saturating_sub(1)).or(self.frames.last());
        let [left, top, wide, _] = last.copied().unwrap_or_default();
        let bottom = self.frames.iter().map(|frame| frame[1] + frame[3]).fold(top, f64::max);
        [left, top, wide, bottom - top]
    }

    /// Draws a colour bar to the right of a frame.
    pub fn draw_bar(&self, out: &mut Vec<SceneItem>, bar: &Bar, [left, top, wide, high]: [f64; 4]) {
        let size = self.type_size;
        // As tall as a single plot would be, in the middle.
        let height = high.min(32.0 * size);
        let top = top + (high - height) / 2.0;
        let (x, width) = (left + wide + 0.9 * size, 1.2 * size);
        let paints: Vec<Option<Paint>> =
            bar.paints.iter().rev().map(|paint| Some(*paint)).collect();
        cells(out, 1, &paints, [x, top, width, height]);
        self.outline(out, [x, top, width, height]);
        let place = |value: f64| top + (1.0 - bar.axis.share(value)) * height;
        let right = x + width;
        let ticks = bar.axis.ticks.iter().map(|(value, _)| {
            let y = place(*value);
            vec![[right, y], [right + 0.3 * size, y]]
        });
        out.push(lines(ticks.collect(), HAIR, Paint::Soft));
        let mut widest: f64 = 0.0;
        for (value, word) in &bar.axis.ticks {
            widest = widest.max(plain(word).width(size));
            let at = [right + 0.55 * size, place(*value) + 0.36 * size];
            out.push(words(at, &plain(word), size, Anchor::Start));
        }
        if !bar.axis.name.is_empty() {
            let at = [right + widest + 1.75 * size, top + height / 2.0];
            out.push(turned(at, &bar.axis.name, size));
        }
    }
}

/// Cuts a line into dashes.
fn dashes(line: &[Point]) -> Vec<Vec<Point>> {
    let mut found: Vec<Vec<Point>> =
        line.first().map(|first| vec![vec![*first]]).unwrap_or_default();
    let (mut draws, mut left) = (true, DASH[0]);
    for (from, to) in line.iter().zip(line.iter().skip(1)) {
        let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
        let mut gone = 0.0;
        while length - gone > left {
            gone += left;
            let share = gone / length;
            let at = [0, 1].map(|k| from[k] + share * (to[k] - from[k]));
            match draws {
                true => found.last_mut().into_iter().for_each(|dash| dash.push(at)),
                false => found.push(vec![at]),
            }
            draws = !draws;
            left = DASH[usize::from(!draws)];
        }
        left -= length - gone;
        if draws && let Some(dash) = found.last_mut() {
            dash.push(*to);
        }
    }
    found.retain(|dash| dash.len() > 1);
    found
}

/// Smallest number of ticks from one label to the next at which labels keep apart.
fn spacing(axis: &Axis, wide: f64, size: f64) -> usize {
    let fits = |every: &usize| {
        let shown = axis.ticks.iter().filter(|(value, _)| is_shown(axis, *value, *every));
        let mut end = f64::NEG_INFINITY;
        shown.fold(true, |fits, (value, word)| {
            let (middle, half) = (axis.share(*value) * wide, plain(word).width(size) / 2.0);
            let apart = middle - half > end + 0.5 * size;
            end = middle + half;
            fits && apart
        })
    };
    (1..).find(|every| fits(every) || *every > axis.ticks.len()).unwrap_or(1)
}

/// Whether the tick at a value has a label, if one in `every` has; zero has one always.
fn is_shown(axis: &Axis, value: f64, every: usize) -> bool {
    let place = |value: f64| axis.ticks.iter().position(|(tick, _)| *tick == value).unwrap_or(0);
    place(value) % every == place(0.0) % every
}

/// Draws cells, each run of one colour as one rectangle.
fn cells(
    out: &mut Vec<SceneItem>,
    columns: usize,
    paints: &[Option<Paint>],
    [left, top, wide, high]: [f64; 4],
) {
    let columns = columns.max(1);
    let rows = paints.len().div_ceil(columns).max(1);
    let (width, height) = (wide / columns as f64, high / rows as f64);
    let mut found: BTreeMap<Paint, Vec<[f64; 4]>> = BTreeMap::new();
    for (row, line) in paints.chunks(columns).enumerate() {
        let mut column = 0;
        while let Some(paint) = line.get(column) {
            let run = line[column..].iter().take_while(|other| *other == paint).count();
            if let Some(paint) = paint {
                let place = [
                    left + width * column as f64,
                    top + height * row as f64,
                    width * run as f64,
                    height,
                ];
                found.entry(*paint).or_default().push(place);
            }
            column += run;
        }
    }
    out.extend(found.into_iter().map(|(paint, boxes)| SceneItem::Boxes { boxes, paint }));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_do_not_depend_on_the_points_of_a_line() {
        let length = |dashes: &[Vec<Point>]| -> f64 {
            let pieces = dashes.iter().flat_map(|dash| dash.windows(2));
            pieces.map(|pair| libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1])).sum()
        };
        // Ten dashes and gaps, in one piece and in many.
        let total = 10.0 * (DASH[0] + DASH[1]);
        let whole = dashes(&[[0.0, 0.0], [total, 0.0]]);
        let cut: Vec<Point> = (0..=400).map(|k| [total * f64::from(k) / 400.0, 0.0]).collect();
        let cut = dashes(&cut);
        assert_eq!((whole.len(), cut.len()), (10, 10));
        for found in [whole, cut] {
            assert!((length(&found) - 10.0 * DASH[0]).abs() < 1e-9, "{found:?}");
        }
        assert!(dashes(&[]).is_empty() && dashes(&[[1.0, 1.0]]).is_empty(), "nothing to draw");
    }
}
