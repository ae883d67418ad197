//! Section of a rolling body on the sphere of (l, L/G), as two discs.
//!
//! Each hemisphere is drawn in Lambert's azimuthal projection about its pole, which preserves areas:
//! (√(1 − |z|) cos l, √(1 − |z|) sin l) with z = L/G. The lower disc is seen from below, through a
//! mirror, so that a point of the equator is at one place in both.

use liouville_draw::{Axis, Layer, MarkedPoint, Paint, Plot, math};

/// Number of points of the circle that is the equator.
const ROUND: usize = 180;

/// Position in the disc of the hemisphere z ≥ 0 or z ≤ 0.
fn place([l, z]: [f64; 2]) -> [f64; 2] {
    let radius = (1.0 - z.abs()).max(0.0).sqrt();
    [radius * libm::cos(l), radius * libm::sin(l)]
}

/// Draws a plane of (l, L/G) as the discs L > 0 and L < 0.
///
/// Shaded densities are left out: they have cells of the plane.
pub fn discs(plot: &Plot) -> [Plot; 2] {
    let hemisphere = |sign: f64, words: &str| {
        let holds = |at: &[f64; 2]| at[1] * sign >= 0.0;
        let dots = |points: &[[f64; 2]]| points.iter().copied().filter(holds).map(place).collect();
        // A line ends where it goes to the other disc.
        let line = |points: &[[f64; 2]]| {
            let own = |at: &[f64; 2]| if holds(at) { place(*at) } else { [f64::NAN; 2] };
            points.iter().map(own).collect()
        };
        let layer = |layer: &Layer| match layer {
            Layer::Dots(points, paint) => Some(Layer::Dots(dots(points), *paint)),
            Layer::Line(points, paint) => Some(Layer::Line(line(points), *paint)),
            Layer::Dashes(points, paint) => Some(Layer::Dashes(line(points), *paint)),
            Layer::Cells(..) | Layer::Density(_) => None,
        };
        let angle = |ticks: [(f64, &str); 2]| {
            let ticks = ticks.map(|(at, word)| (at, word.to_string())).to_vec();
            Axis::with_ticks(math("l"), [-1.06, 1.06], ticks)
        };
        let mut own =
            Plot::new(angle([(-1.0, "π"), (1.0, "0")]), angle([(-1.0, "3π/2"), (1.0, "π/2")]));
        own.title = Some(math(words));
        own.aspect = 1.0;
        own.layers = graticule();
        own.layers.extend(plot.layers.iter().filter_map(layer));
        let marks = plot.marks.iter().filter(|mark| holds(&mark.at));
        own.marks = marks.map(|mark| MarkedPoint { at: place(mark.at), ..mark.clone() }).collect();
        own.legend.clone_from(&plot.legend);
        own.bar.clone_from(&plot.bar);
        own
    };
    [hemisphere(1.0, "L > 0"), hemisphere(-1.0, "L < 0")]
}

/// Equator, the parallel |L/G| = ½, and the meridians of the axes.
fn graticule() -> Vec<Layer> {
    let parallel = |z: f64| {
        let step = std::f64::consts::TAU / ROUND as f64;
        (0..=ROUND).map(|k| place([step * k as f64, z])).collect()
    };
    vec![
        Layer::Line(parallel(0.0), Paint::Ink),
        Layer::Dashes(parallel(0.5), Paint::Soft),
        Layer::Dashes(vec![[-1.0, 0.0], [1.0, 0.0]], Paint::Soft),
        Layer::Dashes(vec![[0.0, -1.0], [0.0, 1.0]], Paint::Soft),
    ]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn areas_are_kept_and_the_equator_is_one_circle() {
        // the area of a cap z ≥ h is 2π(1 − h) on the sphere, and half of that in the disc
        for h in [0.0, 0.25, 0.9] {
            let [x, y] = place([0.7, h]);
            assert!((PI * (x * x + y * y) - PI * (1.0 - h)).abs() < 1e-15, "{h}");
        }
        let plot = {
            let mut plot = super::super::drawing::plane();
            plot.layers.push(Layer::Dots(vec![[0.3, 0.0], [0.3, 0.5], [2.0, -0.5]], Paint::Ink));
            plot
        };
        let [upper, lower] = discs(&plot).map(|disc| match disc.layers.last() {
            Some(Layer::Dots(points, _)) => points.clone(),
            other => panic!("dots, not {other:?}"),
        });
        assert_eq!((upper.len(), lower.len()), (2, 2), "the equator is in both");
        assert_eq!(upper[0], lower[0], "at one place");
    }
}
