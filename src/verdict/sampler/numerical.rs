//! States on a level without parametrisation, inside the declared ranges.

use super::ranges::inside;
use crate::case::Case;
use crate::graph::Fault;
use crate::level::Newton;
use crate::number::ball::Balls;

/// Newton's method for a level, with the ranges of the coordinates.
#[derive(Clone)]
pub(super) struct NumericalLevel {
    newton: Newton,
    /// Number of components of the parameters, which come before the state.
    parameters: usize,
    /// Range of each coordinate of the state that has one.
    ranges: Vec<Option<(f64, f64)>>,
}

impl NumericalLevel {
    pub(super) fn new(case: &Case, kept: &[bool]) -> Result<Self, Fault> {
        Ok(Self {
            newton: Newton::new(&case.model, kept)?,
            parameters: case.model.free_components(),
            ranges: case.free_draws.iter().map(inside).collect(),
        })
    }

    /// Moves states to the level; lanes where that fails, or that may leave a range, become undefined.
    pub(super) fn project<const N: usize>(&self, values: &mut [Balls<N>]) {
        self.newton.project(values);
        let state = &mut values[self.parameters..];
        for lane in 0..N {
            let is_inside = |block: &Balls<N>, range: &Option<(f64, f64)>| {
                let (mid, rad) = (block.mid[lane], block.rad[lane]);
                range.is_none_or(|(low, high)| {
                    (mid - rad).next_down() >= low && (mid + rad).next_up() <= high
                })
            };
            if !state.iter().zip(&self.ranges).all(|(block, range)| is_inside(block, range)) {
                for block in &mut *state {
                    (block.mid[lane], block.rad[lane]) = (f64::NAN, f64::NAN);
                }
            }
        }
    }
}
