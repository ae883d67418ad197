//! Directions of the state in which relations along an orbit are compared.
//!
//! Where functions of the state are variables, the gradient of a relation has components along them. Two
//! relations may be independent there, and functions of each other in the state itself: x − y and
//! e^x e^(−y). So gradients are taken along the components of the state, with the functions moving as
//! they do, and without the directions across a level.

use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::formula::Formula;
use liouville::graph::Tape;

use super::super::SearchError;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::super::terms::recorded;
use super::setting::{PrimePhasePoint, run};

/// Slopes of adjoined functions along each component of the state, and of the level functions.
pub struct Tangents {
    directions: Tape,
    level: Tape,
    /// Number of components of the state, adjoined functions included.
    dimension: usize,
    /// Number of components along which gradients are taken.
    axes: usize,
}

/// Gradients at one point along the components of the state.
#[derive(Clone)]
pub struct LocalGradients {
    /// The directions of the components; none where they are those of the variables.
    directions: Vec<Vec<u64>>,
    echelon: Echelon,
}

impl Tangents {
    /// Records the slopes; `axes` has the rates of all variables along each component of the state, and
    /// is empty if no functions are adjoined.
    pub fn of(case: &Case, axes: &[Vec<Formula>]) -> Result<Self, SearchError> {
        let kept = LevelSubset::level(&case.model).kept;
        let (graph, (directions, level)) = recorded(case, |jet| {
            let own = axes.iter().flatten().map(|rate| jet.phase.scalar(rate));
            (own.collect::<Vec<_>>(), jet.level_gradients(&kept).concat())
        })?;
        let (directions, level) = (Tape::new(&graph, &directions), Tape::new(&graph, &level));
        Ok(Self { directions, level, dimension: case.model.dimension(), axes: axes.len() })
    }

    /// Gradients at a point, those of the level functions first if they have values; `None` where an
    /// adjoined function has none.
    pub fn at(&self, at: &PrimePoint, point: &PrimePhasePoint) -> Option<LocalGradients> {
        let inputs = [point.parameters.as_slice(), &point.state].concat();
        let rows = |tape: &Tape| -> Option<Vec<Vec<u64>>> {
            let values = run(tape, at.modulus, &inputs)?;
            Some(values.chunks(self.dimension).map(<[u64]>::to_vec).collect())
        };
        let width = if self.axes == 0 { self.dimension } else { self.axes };
        let echelon = Echelon::new(width, at.modulus);
        let mut own = LocalGradients { directions: rows(&self.directions)?, echelon };
        for gradient in rows(&self.level).unwrap_or_default() {
            own.push(at, gradient);
        }
        Some(own)
    }
}

impl LocalGradients {
    /// Number of independent gradients.
    pub fn rank(&self) -> usize {
        self.echelon.rank()
    }

    /// Adds a gradient by all variables; returns whether it is independent of those before along the
    /// components of the state.
    pub fn push(&mut self, at: &PrimePoint, gradient: Vec<u64>) -> bool {
        let m = at.modulus;
        let along = |direction: &Vec<u64>| {
            let products = direction.iter().zip(&gradient).map(|(a, b)| m.mul(*a, *b));
            products.fold(0, |sum, own| m.add(sum, own))
        };
        let row = match self.directions.is_empty() {
            true => gradient,
            false => self.directions.iter().map(along).collect(),
        };
        self.echelon.push(row)
    }
}
