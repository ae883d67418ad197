//! States by the numbers from which they are drawn.

/// A state by the numbers from which it is drawn.
#[derive(Clone, Debug)]
pub struct Point {
    pub branch: usize,
    pub picks: Vec<usize>,
    /// Position of each symbol in its range, from 0 to 1.
    pub cube: Vec<f64>,
    /// Addition to each position, far below its last digit.
    pub fine: Vec<f64>,
}

/// Steps below this size are added to the fine part of a position.
const FINE: f64 = 1e-14;

impl Point {
    /// Returns the midpoint of two points of the same branch and choice of lists.
    pub fn between(&self, other: &Self) -> Option<Self> {
        let same = self.branch == other.branch && self.picks == other.picks;
        let middle = self.cube.iter().zip(&other.cube).map(|(a, b)| f64::midpoint(*a, *b));
        same.then(|| Self { cube: middle.collect(), ..self.clone() })
    }

    /// Returns the point with one coordinate changed by a step of this size, in the direction that
    /// stays inside the range.
    pub fn beside(&self, place: usize, by: f64) -> Self {
        let mut point = self.clone();
        if by.abs() < FINE {
            point.fine[place] += match point.cube[place] {
                0.0 => by.abs(),
                1.0 => -by.abs(),
                _ => by,
            };
            return point;
        }
        let there = point.cube[place] + by;
        point.cube[place] = if (0.0..=1.0).contains(&there) { there } else { there - 2.0 * by };
        point
    }

    /// Returns the point with another position of one symbol, in two parts.
    pub fn at(&self, place: usize, (cube, fine): (f64, f64)) -> Self {
        let mut point = self.clone();
        (point.cube[place], point.fine[place]) = (cube, fine);
        point
    }
}
