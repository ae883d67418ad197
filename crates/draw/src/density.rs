//! Density of points in a plane: counts in cells, shaded by their logarithm.

use crate::axis::{Axis, power_of_ten};
use crate::palette::{Paint, gradient};
use crate::plot::Bar;
use crate::text::plain;

/// Counts of points in the cells of a rectangle.
#[derive(Clone, Debug)]
pub struct CountGrid {
    columns: usize,
    /// Counts row by row from above.
    counts: Vec<u32>,
}

impl CountGrid {
    /// Counts points over the ranges of two axes.
    pub fn of(
        points: impl Iterator<Item = [f64; 2]>,
        across: &Axis,
        up: &Axis,
        [columns, rows]: [usize; 2],
    ) -> Self {
        let mut counts = vec![0; columns * rows];
        for [x, y] in points {
            let (x, y) = (across.share(x) * columns as f64, (1.0 - up.share(y)) * rows as f64);
            if x >= 0.0 && y >= 0.0 && (x as usize) < columns && (y as usize) < rows {
                counts[y as usize * columns + x as usize] += 1;
            }
        }
        Self { columns, counts }
    }

    /// Number of columns.
    pub(crate) fn columns(&self) -> usize {
        self.columns
    }

    fn most(&self) -> u32 {
        self.counts.iter().copied().max().unwrap_or(0).max(1)
    }

    /// Colours of the cells, row by row from above; empty cells have none.
    pub(crate) fn paints(&self) -> Vec<Option<Paint>> {
        let top = libm::log(f64::from(self.most()));
        let shade = |count: u32| match (count, top > 0.0) {
            (0, _) => None,
            (_, false) => Some(gradient(0.0)),
            (count, true) => Some(gradient(libm::log(f64::from(count)) / top)),
        };
        self.counts.iter().map(|count| shade(*count)).collect()
    }

    /// Colour bar of the counts.
    pub fn bar(&self) -> Bar {
        let top = libm::log10(f64::from(self.most())).max(0.30);
        let decades = (0..=top as i64).map(|k| {
            (k as f64, if k < 2 { ["1", "10"][k as usize].to_string() } else { power_of_ten(k) })
        });
        let mut ticks: Vec<(f64, String)> = decades.collect();
        if ticks.len() < 3 {
            let between = [2.0, 5.0, 20.0, 50.0].map(|k: f64| (libm::log10(k), format!("{k}")));
            ticks.extend(between.into_iter().filter(|(place, _)| *place <= top));
        }
        Bar {
            axis: Axis::with_ticks(plain("crossings a cell"), [0.0, top], ticks),
            paints: (0..64).map(|k| gradient((f64::from(k) + 0.5) / 64.0)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_counted_once_and_outsiders_are_not() {
        let axis = |from, to| Axis::new(plain("x"), from, to);
        let points = [[0.1, 0.1], [0.1, 0.1], [0.9, 0.9], [2.0, 0.5], [f64::NAN, 0.0]];
        let found = CountGrid::of(points.into_iter(), &axis(0.0, 1.0), &axis(0.0, 1.0), [2, 2]);
        assert_eq!(found.counts, [0, 1, 2, 0], "above is first");
        let paints = found.paints();
        assert!(paints[0].is_none() && paints[1] == Some(gradient(0.0)), "{paints:?}");
        assert_eq!(paints[2], Some(gradient(1.0)));
    }
}
