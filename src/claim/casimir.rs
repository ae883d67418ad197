//! Casimir functions of a bracket.

use super::Reader;
use super::of_bracket::{OfBracket, bracket_of, scalar_in, slope, turned};
use crate::formula::Formula;
use crate::mechanics::NewVariables;
use crate::mechanics::calculus::DualPoint;
use crate::scalar::Scalar;

/// The claim P ∂C/∂y = 0 and P + Pᵀ = 0.
#[derive(Clone, Debug)]
pub struct Casimir {
    function: Formula,
    /// Index of the bracket.
    bracket: usize,
}

impl Casimir {
    /// Returns the function, in the names of the bracket's variables.
    pub fn function(&self) -> &Formula {
        &self.function
    }
}

impl OfBracket for Casimir {
    const NAME: &'static str = "casimir";

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let bracket = bracket_of(from, Self::NAME)?;
        Ok(Self { function: scalar_in(from, Self::NAME)?, bracket })
    }

    fn at<T: Scalar>(&self, variables: &NewVariables, there: &DualPoint<'_, T>) -> Vec<T> {
        let tensor = variables.tensor(self.bracket, &there.phase);
        let mut residual = turned(&tensor, &slope(there, &self.function));
        residual.extend(variables.symmetric_part(&tensor));
        residual
    }

    fn brackets(&self) -> Vec<usize> {
        vec![self.bracket]
    }

    fn functions(&self) -> Vec<&Formula> {
        vec![&self.function]
    }

    fn constant_if(&self) -> Option<&Formula> {
        Some(&self.function)
    }
}
