//! Covering relations of rectangles in the plane.
//!
//! A rectangle has an unstable and a stable side. A map of one rectangle covers another if it puts
//! the images of the two unstable edges beyond the other on opposite sides, and the whole image
//! between its stable edges.

use super::super::enclosure::{Enclosure, raised};

/// Rectangle |z₀ - c₀| ≤ h₀ in the unstable, |z₁ - c₁| ≤ h₁ in the stable direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Middle c.
    pub middle: [f64; 2],
    /// Half the sides, h.
    pub half: [f64; 2],
}

/// Map of a rectangle into the plane: image of its middle, and derivative over it.
#[derive(Clone, Copy, Debug)]
pub struct PlaneMap {
    pub middle: [Enclosure; 2],
    /// Derivative, row by row.
    pub slopes: [[Enclosure; 2]; 2],
}

/// Room that a covering relation leaves; above 1 in both numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margin {
    /// Distance of the images of the unstable edges from the middle, over the half side.
    pub unstable: f64,
    /// Half stable side over the extent of the image.
    pub stable: f64,
}

/// Lower bound of a difference of two non-negative numbers.
fn below(a: f64, b: f64) -> f64 {
    let gap = a - b;
    gap - f64::EPSILON * gap.abs() - f64::MIN_POSITIVE
}

/// Bound of a sum of non-negative products.
fn above(x: f64) -> f64 {
    raised(x, 4)
}

impl PlaneMap {
    /// Bounds how far the unstable edges of a rectangle with these half sides go at least from the
    /// image of the middle. Not positive where nothing is known.
    pub fn reach(&self, half: [f64; 2]) -> f64 {
        let [stretch, shear] = self.slopes[0];
        let least = below(stretch.mid.abs(), stretch.rad);
        let known = stretch.is_finite() && shear.is_finite() && least > 0.0;
        if !known {
            return f64::NEG_INFINITY;
        }
        let sides = least * half[0];
        below(sides - f64::EPSILON * sides, above(shear.magnitude() * half[1]))
    }

    /// Bounds the stable extent of the image, about that of the middle.
    pub fn extent(&self, half: [f64; 2]) -> f64 {
        let [shear, squeeze] = self.slopes[1];
        above(shear.magnitude() * half[0] + squeeze.magnitude() * half[1])
    }

    /// Bounds the distance of the image of the middle from a point, in each direction.
    pub fn off(&self, point: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| (self.middle[k] - Enclosure::exact(point[k])).magnitude())
    }

    /// Room of the covering relation between the rectangle with these half sides, over which the
    /// map is known, and another. `None` where it is not proved.
    pub fn covers(&self, half: [f64; 2], other: &Rectangle) -> Option<Margin> {
        let off = self.off(other.middle);
        let reach = below(self.reach(half), off[0]);
        let extent = above(self.extent(half) + off[1]);
        let is_proved = reach > other.half[0] && extent < other.half[1];
        is_proved
            .then(|| Margin { unstable: reach / other.half[0], stable: other.half[1] / extent })
    }
}

/// Product of two enclosed matrices.
pub fn product(a: &[[Enclosure; 2]; 2], b: &[[Enclosure; 2]; 2]) -> [[Enclosure; 2]; 2] {
    [0, 1].map(|i| [0, 1].map(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
}

/// Whether any two motions that repeat a map with a derivative in this enclosure for ever, on one
/// rectangle, approach each other.
///
/// With |Δ₀| ≥ |Δ₁| differences grow for ever, by more than a factor above 1, and stay so.
/// Otherwise |Δ₀| < |Δ₁| for ever, and |Δ₁| shrinks by a factor below 1.
pub fn is_hyperbolic(slopes: &[[Enclosure; 2]; 2]) -> bool {
    let [[stretch, shear], [other, squeeze]] = slopes;
    if !slopes.iter().flatten().all(|x| x.is_finite()) {
        return false;
    }
    let grows = below(below(stretch.mid.abs(), stretch.rad), shear.magnitude());
    let shrinks = above(other.magnitude() + squeeze.magnitude());
    grows > 1.0 && shrinks < 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(slopes: [[f64; 2]; 2], rad: f64, middle: [f64; 2]) -> PlaneMap {
        PlaneMap {
            middle: middle.map(Enclosure::exact),
            slopes: slopes.map(|row| row.map(|x| Enclosure::about(x, rad))),
        }
    }

    const UNIT: Rectangle = Rectangle { middle: [0.0, 0.0], half: [1.0, 1.0] };

    #[test]
    fn a_saddle_covers_its_rectangle() {
        let saddle = map([[3.0, 0.1], [0.1, 0.25]], 0.01, [0.0, 0.0]);
        let margin = saddle.covers(UNIT.half, &UNIT).expect("covered");
        // 3 - 0.01 - 0.1 - 0.01 and 1/(0.1 + 0.25 + 0.02)
        assert!((margin.unstable - 2.88).abs() < 1e-12, "{margin:?}");
        assert!((margin.stable - 1.0 / 0.37).abs() < 1e-12, "{margin:?}");
        let turned = map([[-3.0, 0.1], [0.1, -0.25]], 0.01, [0.0, 0.0]);
        assert_eq!(turned.covers(UNIT.half, &UNIT), Some(margin), "edges may change sides");
    }

    #[test]
    fn no_relation_without_room() {
        let cases = [
            ("the inverse", map([[0.25, 0.1], [0.1, 3.0]], 0.01, [0.0; 2])),
            ("too little stretch", map([[1.11, 0.1], [0.1, 0.25]], 0.01, [0.0; 2])),
            ("too much shear", map([[3.0, 1.99], [0.1, 0.25]], 0.01, [0.0; 2])),
            ("too wide", map([[3.0, 0.1], [0.8, 0.25]], 0.01, [0.0; 2])),
            ("beside in the unstable direction", map([[3.0, 0.1], [0.1, 0.25]], 0.0, [1.95, 0.0])),
            ("beside in the stable direction", map([[3.0, 0.1], [0.1, 0.25]], 0.0, [0.0, 0.7])),
            ("a fold", map([[0.0, 0.1], [0.1, 0.25]], 3.0, [0.0; 2])),
            ("unknown", map([[3.0, f64::NAN], [0.1, 0.25]], 0.01, [0.0; 2])),
            ("unknown radius", map([[3.0, 0.1], [0.1, 0.25]], f64::NAN, [0.0; 2])),
            ("infinite", map([[f64::INFINITY, 0.1], [0.1, 0.25]], 0.0, [0.0; 2])),
        ];
        for (name, map) in cases {
            assert_eq!(map.covers(UNIT.half, &UNIT), None, "{name}");
        }
        let just = map([[1.13, 0.1], [0.1, 0.25]], 0.01, [0.0; 2]);
        assert!(just.covers(UNIT.half, &UNIT).is_some(), "1.13 - 0.12 is above 1");
    }

    #[test]
    fn images_of_edges_lie_beyond() {
        // corners and edges of random members of a map, by brute force
        let map = map([[2.0, 0.3], [0.2, 0.4]], 0.1, [0.2, -0.1]);
        let source = [0.5, 0.25];
        let target = Rectangle { middle: [0.1, 0.0], half: [0.7, 0.4] };
        let margin = map.covers(source, &target).expect("covered");
        for number in 0..16 {
            let [a, b, c, d] = [0, 1, 2, 3].map(|bit| f64::from((number >> bit & 1) * 2 - 1));
            for (u, s) in [(-0.5_f64, -0.25), (-0.5, 0.25), (0.5, -0.25), (0.5, 0.25)] {
                let across = 0.2 + (2.0 + 0.1 * a) * u + (0.3 + 0.1 * b) * s;
                let along = -0.1 + (0.2 + 0.1 * c) * u + (0.4 + 0.1 * d) * s;
                let past = (across - 0.1) * u.signum();
                assert!(past >= margin.unstable * 0.7 - 1e-12, "{past}");
                assert!(along.abs() * margin.stable <= 0.4 + 1e-12, "{along}");
            }
        }
    }

    #[test]
    fn hyperbolic_matrices() {
        let of = |slopes| map(slopes, 0.01, [0.0; 2]).slopes;
        assert!(is_hyperbolic(&of([[3.0, 0.5], [0.2, 0.5]])));
        assert!(!is_hyperbolic(&of([[3.0, 2.0], [0.2, 0.5]])), "shear");
        assert!(!is_hyperbolic(&of([[3.0, 0.5], [0.6, 0.5]])), "no contraction");
        assert!(!is_hyperbolic(&of([[0.5, 0.2], [0.5, 3.0]])), "exchanged");
        assert!(!is_hyperbolic(&of([[f64::NAN, 0.2], [0.1, 0.3]])), "unknown");
    }
}
