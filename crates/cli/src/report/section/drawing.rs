//! Plot of a section: crossings, images of lines, separatrices, and the periodic points that the case
//! claims.

use liouville::case::FixedLine;
use liouville::claim::motion::Stability;
use liouville_draw::{
    Axis, Bar, CATEGORIES, CountGrid, Layer, LegendEntry, MarkShape, MarkedPoint, Paint, Plot,
    gradient, math, plain,
};
use liouville_flow::{SectionOrbit, Separatrices};

/// Rule by which orbits are coloured.
#[derive(Clone, Copy, Debug)]
pub enum Colouring<'v> {
    /// A colour for each orbit.
    Orbits,
    /// One colour for all.
    One,
    /// Rank of a value: its name, and the values of the orbits.
    Values(&'v str, &'v [f64]),
}

/// Plane of l and L/G: the sphere in Lambert's cylindrical projection, which preserves areas.
pub fn plane() -> Plot {
    Plot::new(Axis::turn(math("l")), Axis::new(math("L/G"), -1.0, 1.0))
}

fn points<'o>(orbits: impl IntoIterator<Item = &'o SectionOrbit>) -> Vec<[f64; 2]> {
    orbits.into_iter().flat_map(|orbit| &orbit.crossings).map(|crossing| crossing.at).collect()
}

fn entry(mark: MarkShape, paint: Paint, words: &str) -> LegendEntry {
    LegendEntry { mark, paint, text: plain(words) }
}

/// Adds the crossings of orbits.
pub fn draw_orbits(plot: &mut Plot, orbits: &[SectionOrbit], colouring: Colouring<'_>) {
    let shares = match colouring {
        Colouring::One => {
            plot.layers.push(Layer::Dots(points(orbits), Paint::Ink));
            return;
        }
        Colouring::Orbits => (0..orbits.len()).map(shade).collect(),
        Colouring::Values(name, values) => {
            plot.bar = Some(ranking(name, values));
            ranks(values)
        }
    };
    let layers = orbits.iter().zip(shares);
    plot.layers.extend(layers.map(|(orbit, share)| Layer::Dots(points([orbit]), gradient(share))));
}

/// Adds orbits followed forwards and backwards in time, in two colours.
pub fn draw_both(plot: &mut Plot, forwards: &[SectionOrbit], backwards: &[SectionOrbit]) {
    for (orbits, paint, words) in [
        (backwards, CATEGORIES[1], "backwards in time"),
        (forwards, CATEGORIES[0], "forwards in time"),
    ] {
        plot.layers.push(Layer::Dots(points(orbits), paint));
        plot.legend.insert(0, entry(MarkShape::Disc, paint, words));
    }
}

/// Shades the density of crossings.
pub fn shade_density(plot: &mut Plot, orbits: &[SectionOrbit], cells: [usize; 2]) {
    let density = CountGrid::of(points(orbits).into_iter(), &plot.across, &plot.up, cells);
    plot.bar = Some(density.bar());
    plot.layers.push(Layer::Density(density));
}

/// Position on the colour scale of the orbit with this index: neighbours are far apart.
pub fn shade(index: usize) -> f64 {
    (index as f64 * 0.618_033_988_75).fract()
}

/// Adds the images of lines, a colour for each.
pub fn draw_lines(plot: &mut Plot, lines: &[(FixedLine, Vec<SectionOrbit>)]) {
    for (index, (line, orbits)) in lines.iter().enumerate() {
        let mut dots = points(orbits);
        dots.extend(orbits.iter().map(|orbit| orbit.start));
        let paint = CATEGORIES[index % CATEGORIES.len()];
        plot.layers.push(Layer::Dots(dots, paint));
        let text = plain("images of ").then(math(equation(*line)));
        plot.legend.push(LegendEntry { mark: MarkShape::Disc, paint, text });
    }
}

fn equation(line: FixedLine) -> &'static str {
    match line {
        FixedLine::Equator => "L = 0",
        FixedLine::Meridian => "l = 0, π",
        FixedLine::QuarterMeridian => "l = π/2, 3π/2",
    }
}

/// Draws separatrices over a section, whose points become pale.
pub fn draw_separatrices(plot: &mut Plot, all: &[Separatrices]) {
    if all.is_empty() {
        return;
    }
    for layer in &mut plot.layers {
        if let Layer::Dots(_, paint) = layer {
            *paint = Paint::Soft;
        }
    }
    plot.bar = None;
    for (paint, words) in [(CATEGORIES[0], "stable curves"), (CATEGORIES[1], "unstable curves")] {
        plot.legend.push(entry(MarkShape::Disc, paint, words));
    }
    for found in all {
        plot.layers.push(Layer::Dots(points(&found.stable), CATEGORIES[0]));
        plot.layers.push(Layer::Dots(points(&found.unstable), CATEGORIES[1]));
        mark(plot, Stability::Hyperbolic, &[found.point.at]);
    }
}

/// Marks the points of a periodic orbit by their stability.
pub fn mark(plot: &mut Plot, stability: Stability, at: &[[f64; 2]]) {
    let (mark, words) = match stability {
        Stability::Elliptic => (MarkShape::Ring, "elliptic point"),
        Stability::Hyperbolic => (MarkShape::Cross, "hyperbolic point"),
        Stability::Sink => (MarkShape::Down, "sink"),
        Stability::Source => (MarkShape::Up, "source"),
    };
    let sign = |at: &[f64; 2]| MarkedPoint {
        at: *at,
        mark,
        paint: Paint::Ink,
        label: None,
        has_rim: true,
    };
    plot.marks.extend(at.iter().map(sign));
    let entry = entry(mark, Paint::Ink, words);
    if !plot.legend.contains(&entry) {
        plot.legend.push(entry);
    }
}

/// Colour bar of ranks, with the values of some.
fn ranking(name: &str, values: &[f64]) -> Bar {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().saturating_sub(1);
    let tick = |share: f64| {
        let value = sorted.get((share * last as f64).round() as usize).copied().unwrap_or(0.0);
        (share, figures(value))
    };
    let ticks = [0.0, 0.25, 0.5, 0.75, 1.0].map(tick).to_vec();
    Bar {
        axis: Axis::with_ticks(plain(name), [0.0, 1.0], ticks),
        paints: (0..64).map(|k| gradient((f64::from(k) + 0.5) / 64.0)).collect(),
    }
}

/// A number with three figures.
fn figures(value: f64) -> String {
    let size = if value == 0.0 { 0.0 } else { libm::floor(libm::log10(value.abs())) };
    let text = match (-3.0..5.0).contains(&size) {
        true => format!("{value:.*}", (2.0 - size).max(0.0) as usize),
        false => format!("{value:.2e}"),
    };
    text.replace('-', "−")
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_show_values_with_three_figures() {
        assert_eq!(
            [0.0, -1.5, 1234.0, 0.012_34, 2e9].map(figures),
            ["0.00", "−1.50", "1234", "0.0123", "2.00e9"]
        );
        let bar = ranking("F2", &[5.0, 1.0, 3.0]);
        assert_eq!(bar, ranking("F2", &[1.0, 3.0, 5.0]), "sorted");
        assert_eq!(ranks(&[5.0, 1.0, 3.0]), [1.0, 0.0, 0.5]);
    }
}
