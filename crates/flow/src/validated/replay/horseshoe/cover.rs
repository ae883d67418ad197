//! Covering relations in balls of many bits.

use crate::validated::replay::number::{ReplayNumber, Wide};

/// Map of a rectangle into the plane: image of its middle, and derivative over it.
pub struct ReplayedMap {
    pub middle: [Wide; 2],
    /// Derivative, row by row.
    pub slopes: [[Wide; 2]; 2],
}

/// Magnitude of all numbers of a ball without 0, unknown for other balls.
fn least(x: &Wide) -> Wide {
    match (x.is_positive(), x.neg().is_positive()) {
        (true, _) => x.clone(),
        (_, true) => x.neg(),
        _ => Wide::unknown(),
    }
}

impl ReplayedMap {
    /// Checks that the rectangle with these half sides covers another, about a middle.
    pub fn covers(
        &self,
        half: [f64; 2],
        middle: [f64; 2],
        other: [f64; 2],
    ) -> Result<(), &'static str> {
        let [[stretch, shear], [bend, squeeze]] = &self.slopes;
        let [unstable, stable] = half.map(Wide::exact);
        let off = |k: usize| self.middle[k].minus(&Wide::exact(middle[k])).magnitude();
        let needed = shear.magnitude().mul(&stable).add(&off(0)).add(&Wide::exact(other[0]));
        if !needed.is_below(&least(stretch).times(&unstable)) {
            return Err("the images of the unstable edges are not beyond the set on both sides");
        }
        let extent = bend.magnitude().mul(&unstable).add(&squeeze.magnitude().mul(&stable));
        match extent.add(&off(1)).is_below(&Wide::exact(other[1])) {
            true => Ok(()),
            false => Err("the image is not between the stable edges"),
        }
    }
}

/// Product of two enclosed matrices.
pub fn product(a: &[[Wide; 2]; 2], b: &[[Wide; 2]; 2]) -> [[Wide; 2]; 2] {
    let entry = |i: usize, j: usize| a[i][0].times(&b[0][j]).plus(&a[i][1].times(&b[1][j]));
    [0, 1].map(|i| [0, 1].map(|j| entry(i, j)))
}

/// Whether any two motions that repeat a map with a derivative in this enclosure for ever, on one
/// rectangle, approach each other: differences that are more unstable than stable grow for ever, and
/// others shrink.
pub fn is_hyperbolic(slopes: &[[Wide; 2]; 2]) -> bool {
    let [[stretch, shear], [bend, squeeze]] = slopes;
    let one = Wide::exact(1.0);
    shear.magnitude().add(&one).is_below(&least(stretch))
        && bend.magnitude().add(&squeeze.magnitude()).is_below(&one)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(slopes: [[f64; 2]; 2], rad: f64, middle: [f64; 2]) -> ReplayedMap {
        let entry = |x: f64| Wide::about(x, rad);
        ReplayedMap { middle: middle.map(Wide::exact), slopes: slopes.map(|row| row.map(entry)) }
    }

    fn covers(slopes: [[f64; 2]; 2], rad: f64, middle: [f64; 2]) -> bool {
        map(slopes, rad, middle).covers([1.0; 2], [0.0; 2], [1.0; 2]).is_ok()
    }

    #[test]
    fn relations_with_room_and_without() {
        assert!(covers([[3.0, 0.1], [0.1, 0.25]], 0.01, [0.0; 2]), "a saddle");
        assert!(covers([[-3.0, 0.1], [0.1, -0.25]], 0.01, [0.0; 2]), "edges may change sides");
        assert!(covers([[1.13, 0.1], [0.1, 0.25]], 0.01, [0.0; 2]), "1.13 - 0.12 is above 1");
        let without = [
            ("the inverse", [[0.25, 0.1], [0.1, 3.0]], 0.01, [0.0; 2]),
            ("too little stretch", [[1.11, 0.1], [0.1, 0.25]], 0.01, [0.0; 2]),
            ("too much shear", [[3.0, 1.99], [0.1, 0.25]], 0.01, [0.0; 2]),
            ("too wide", [[3.0, 0.1], [0.8, 0.25]], 0.01, [0.0; 2]),
            ("beside, unstable", [[3.0, 0.1], [0.1, 0.25]], 0.0, [1.95, 0.0]),
            ("beside, stable", [[3.0, 0.1], [0.1, 0.25]], 0.0, [0.0, 0.7]),
            ("a fold", [[0.0, 0.1], [0.1, 0.25]], 3.0, [0.0; 2]),
            ("unknown", [[3.0, f64::NAN], [0.1, 0.25]], 0.01, [0.0; 2]),
            ("unknown stretch", [[f64::NAN, 0.1], [0.1, 0.25]], 0.01, [0.0; 2]),
            ("unknown radius", [[3.0, 0.1], [0.1, 0.25]], f64::NAN, [0.0; 2]),
            ("unknown image", [[3.0, 0.1], [0.1, 0.25]], 0.01, [f64::NAN, 0.0]),
        ];
        for (name, slopes, rad, middle) in without {
            assert!(!covers(slopes, rad, middle), "{name}");
        }
    }

    #[test]
    fn hyperbolic_matrices() {
        let is = |slopes| is_hyperbolic(&map(slopes, 0.01, [0.0; 2]).slopes);
        assert!(is([[3.0, 0.5], [0.2, 0.5]]) && is([[-3.0, 0.5], [0.2, -0.5]]));
        assert!(!is([[3.0, 2.0], [0.2, 0.5]]), "shear");
        assert!(!is([[3.0, 0.5], [0.6, 0.5]]), "no contraction");
        assert!(!is([[0.5, 0.2], [0.5, 3.0]]), "exchanged");
        assert!(!is([[f64::NAN, 0.2], [0.1, 0.3]]), "unknown");
    }
}
