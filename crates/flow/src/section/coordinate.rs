//! Axes of planes, diagrams and branches of motions, and the starts that these leave open.

use crate::motion::recorded::Loose;
use liouville::case::Angle;
use liouville::mechanics::Model;
use liouville::number::rational::Rational;

/// Quantity that varies along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// Component of a parameter of the case.
    Parameter {
        /// Index of the parameter in the model.
        index: usize,
        /// Index of its component, row by row.
        component: usize,
    },
    /// Coordinate l of the start on the section.
    L,
    /// Coordinate L/G of the start on the section.
    Z,
    /// Energy of the start on the section.
    Energy,
    /// Value of the integral of the claim with this index.
    Integral(usize),
}

impl Coordinate {
    /// Index of the parameter and of its component, if it is one.
    pub fn parameter(self) -> Option<(usize, usize)> {
        match self {
            Coordinate::Parameter { index, component } => Some((index, component)),
            _ => None,
        }
    }
}

/// One axis of the plane.
#[derive(Clone, Debug)]
pub struct ChartAxis {
    /// Quantity along the axis.
    pub coordinate: Coordinate,
    /// Lower end.
    pub from: Rational,
    /// Upper end.
    pub to: Rational,
    /// Number of points; the first and the last are half a step inside.
    pub count: usize,
}

impl ChartAxis {
    /// Position of a point, between -1 and 1.
    pub(crate) fn place(&self, index: usize) -> Rational {
        Rational::new(2 * index as i64 + 1 - self.count as i64, self.count as i64)
    }

    /// Component of the free parameters that varies along the axis, given the offset of each
    /// parameter.
    pub(crate) fn loose(&self, model: &Model, places: &[usize]) -> Option<Loose> {
        let (index, component) = self.coordinate.parameter()?;
        Some(Loose::within(model, [index, component], places[index], [&self.from, &self.to]))
    }

    /// Value at a point of the axis.
    pub fn value(&self, index: usize) -> Rational {
        let share = Rational::new(2 * index as i64 + 1, 2 * self.count as i64);
        &self.from + &(&(&self.to - &self.from) * &share)
    }
}

/// Starts of the motions of a plane, as far as the axes leave them open.
#[derive(Clone, Debug)]
pub enum Launch {
    /// On the section g = g₀.
    Section {
        /// Angle g₀ of the section.
        g0: Angle,
        /// Energy of the motions.
        energy: Rational,
        /// Coordinates l and L/G.
        at: [f64; 2],
    },
    /// At a given state moved to the level set, or at a drawn one.
    State(Option<Vec<Rational>>),
}
