//! States on a level without parametrisation, inside the declared ranges.

use super::ranges::inside;
use super::unmet::LevelFactors;
use crate::case::Case;
use crate::graph::{Evaluator, Fault, Tape, record};
use crate::level::{self, Newton};
use crate::number::ball::{Ball, Balls};

/// Newton's method for a level, with the ranges of the coordinates.
#[derive(Clone)]
pub(super) struct NumericalLevel {
    newton: Newton,
    factors: LevelFactors,
    /// Number of components of the parameters, which come before the state.
    parameters: usize,
    /// Range of each coordinate of the state that has one.
    ranges: Vec<Option<(f64, f64)>>,
    /// Values that are positive on the halves of the level that the file chooses.
    signs: Option<Tape>,
}

impl NumericalLevel {
    pub(super) fn new(case: &Case, kept: &[bool]) -> Result<Self, Fault> {
        let model = &case.model;
        let free = model.free_components();
        let (graph, signs) = record(free + model.dimension(), |inputs| {
            level::signs(model, kept, &inputs[free..], &[])
        })?;
        Ok(Self {
            signs: (!signs.is_empty()).then(|| Tape::new(&graph, &signs)),
            newton: Newton::new(&case.model, kept)?,
            factors: LevelFactors::new(case, kept)?,
            parameters: case.model.free_components(),
            ranges: case.free_draws.iter().map(inside).collect(),
        })
    }

    /// Moves states to the level; lanes where that fails, or that may leave a range, become undefined.
    pub(super) fn project<const N: usize>(&self, values: &mut [Balls<N>]) {
        self.newton.project(values);
        let on_halves = self.on_halves(values);
        for (lane, is_on_halves) in on_halves.into_iter().enumerate() {
            if self.position(values, lane) != Position::Inside || !is_on_halves {
                for block in &mut values[self.parameters..] {
                    (block.mid[lane], block.rad[lane]) = (f64::NAN, f64::NAN);
                }
            }
        }
    }

    /// Whether the box of each state lies in the halves of the level that the file chooses.
    fn on_halves<const N: usize>(&self, values: &[Balls<N>]) -> [bool; N] {
        let Some(tape) = &self.signs else { return [true; N] };
        let mut evaluator = Evaluator::new(tape, Ball::<N>);
        evaluator.run(values);
        let outputs: Vec<&Balls<N>> = evaluator.outputs().collect();
        std::array::from_fn(|lane| {
            outputs.iter().all(|own| own.excludes_zero(lane) && own.mid[lane] > 0.0)
        })
    }

    /// Whether one of these states moves to a point that may be an end of a range.
    pub(super) fn meets_ends<const N: usize>(&self, mut values: Vec<Balls<N>>) -> bool {
        self.newton.project(&mut values);
        (0..N).any(|lane| self.position(&values, lane) == Position::AtEnd)
    }

    /// Whether an equation of the level has corners, between which Newton's method rarely changes.
    pub(super) fn has_corners(&self) -> bool {
        self.newton.has_corners()
    }

    /// Whether an equation of the level has a factor whose zeros Newton's method does not find.
    pub(super) fn has_flat_factors(&self) -> bool {
        self.newton.has_flat_factors()
    }

    /// Returns the factors of the equations.
    pub(super) fn factors(&self) -> &LevelFactors {
        &self.factors
    }

    /// Compares the box of a state with the ranges.
    fn position<const N: usize>(&self, values: &[Balls<N>], lane: usize) -> Position {
        let of_state = values[self.parameters..].iter().zip(&self.ranges);
        let of_coordinate = |(block, range): (&Balls<N>, &Option<(f64, f64)>)| {
            let (mid, rad) = (block.mid[lane], block.rad[lane]);
            let (from, to) = ((mid - rad).next_down(), (mid + rad).next_up());
            let (low, high) = range.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
            match () {
                () if from >= low && to <= high => Position::Inside,
                () if to >= low && from <= high => Position::AtEnd,
                // An undefined coordinate, too.
                () => Position::Outside,
            }
        };
        of_state.map(of_coordinate).max().unwrap_or(Position::Inside)
    }
}

/// Position of a box with respect to ranges; the worst coordinate decides.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Position {
    Inside,
    /// Some ends of ranges lie in it.
    AtEnd,
    Outside,
}
