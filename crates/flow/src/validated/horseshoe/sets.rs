//! Sizes of rectangles along a chain of maps, so that each covers the next.
//!
//! Stable sides are found from the first rectangle on, unstable ones from the last relation back.
//! The maps are enclosed over larger rectangles, and hold for all inside.

use super::cover::{Margin, PlaneMap, Rectangle};

/// Room left in each relation.
const ROOM: f64 = 1.0 + 1e-6;

/// Half sides of the rectangles, about their middles, so that each is covered, given the first
/// stable side, and the reach needed about a point of the surface after the last map.
pub fn fitted(
    maps: &[PlaneMap],
    known: &[[f64; 2]],
    first: f64,
    last: &Rectangle,
) -> Vec<[f64; 2]> {
    let origin = [0.0, 0.0];
    let mut stable = vec![first];
    for (map, known) in maps.iter().zip(known).take(maps.len().saturating_sub(1)) {
        let half = [known[0], stable[stable.len() - 1]];
        stable.push(ROOM * (map.extent(half) + map.off(origin)[1]));
    }
    let mut halves = Vec::new();
    let mut need = ROOM * last.half[0];
    let mut target = last.middle;
    for (map, stable) in maps.iter().zip(&stable).rev() {
        let [stretch, shear] = map.slopes[0];
        let side = need + map.off(target)[0] + shear.magnitude() * stable;
        let own = ROOM * side / (stretch.mid.abs() - stretch.rad);
        halves.push([own, *stable]);
        need = ROOM * own;
        target = origin;
    }
    halves.reverse();
    halves
}

/// Least room of the covering relations of consecutive rectangles under their maps; `middles` are
/// those of all but the first. `None` where one is not proved.
pub fn chained(maps: &[PlaneMap], halves: &[[f64; 2]], last: &Rectangle) -> Option<Margin> {
    let mut least: Option<Margin> = None;
    for (index, (map, half)) in maps.iter().zip(halves).enumerate() {
        let next = match halves.get(index + 1) {
            Some(half) => Rectangle { middle: [0.0, 0.0], half: *half },
            None => *last,
        };
        let margin = map.covers(*half, &next)?;
        least = Some(match least {
            None => margin,
            Some(least) => Margin {
                unstable: least.unstable.min(margin.unstable),
                stable: least.stable.min(margin.stable),
            },
        });
    }
    least.filter(|_| maps.len() == halves.len())
}
