//! States by the numbers from which they are drawn.

/// A state by the numbers from which it is drawn.
#[derive(Clone, Debug)]
pub struct Point {
    pub branch: usize,
    pub picks: Vec<usize>,
    /// Position of each symbol in its range, from 0 to 1.
    pub cube: Vec<f64>,
}

impl Point {
    /// Returns the midpoint of two points of the same branch and choice of lists.
    pub fn between(&self, other: &Self) -> Option<Self> {
        let same = self.branch == other.branch && self.picks == other.picks;
        let middle = self.cube.iter().zip(&other.cube).map(|(a, b)| f64::midpoint(*a, *b));
        same.then(|| Self { cube: middle.collect(), ..self.clone() })
    }

    /// Returns the point with one coordinate changed, inside the range.
    pub fn moved(&self, place: usize, by: f64) -> Self {
        let mut point = self.clone();
        point.cube[place] = (point.cube[place] + by).clamp(0.0, 1.0);
        point
    }

    /// Returns the point with one coordinate changed by a step of this size, in the direction that
    /// stays inside the range.
    pub fn beside(&self, place: usize, by: f64) -> Self {
        let mut point = self.clone();
        let there = point.cube[place] + by;
        point.cube[place] = if (0.0..=1.0).contains(&there) { there } else { there - 2.0 * by };
        point
    }
}
