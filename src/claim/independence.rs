//! Functional independence, by the gradients of some functions and of the level functions.

use super::boxes::Boxes;
use super::{Reader, Statement, ValueShape};
use crate::formula::{Formula, Layout};
use crate::mechanics::Model;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::gram_determinant;
use crate::scalar::Scalar;

/// The claim that the gradients of these functions and of the level functions are linearly
/// independent.
#[derive(Clone, Debug)]
pub struct Independent(Vec<Formula>);

impl Independent {
    /// Makes the claim about these functions.
    pub fn of(functions: Vec<Formula>) -> Self {
        Self(functions)
    }
}

/// Largest number of functions, those of the level included; the work on the Gram determinant grows
/// with its fourth power.
pub const MOST_FUNCTIONS: usize = 24;

impl Statement for Independent {
    const NAME: &'static str = "independent";
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::List)];
    const OF_MAPS: bool = true;
    const NEGATED: bool = true;
    const WIDENS: bool = false;

    fn text(&self) -> Option<String> {
        Some(self.0.iter().map(|own| own.text().trim()).collect::<Vec<_>>().join(", "))
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        Some(boxes.listed(&self.0))
    }

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let formulas = from.list(Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let most = MOST_FUNCTIONS.saturating_sub(from.model().level.len());
        if formulas.is_empty() || formulas.len() > most {
            let message = match formulas.len() {
                0 => "no functions are listed".to_string(),
                count => format!("{count} functions are too many"),
            };
            let remedy = format!("list between 1 and {most} functions");
            return Err(from.complaint(Self::NAME, message, &remedy));
        }
        Ok(Self(formulas))
    }

    fn formulas(&self) -> Vec<&Formula> {
        self.0.iter().collect()
    }

    /// Computes the Gram determinant of the gradients, zero exactly where they are dependent.
    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        let mut gradients = jet.level_gradients(kept);
        for formula in &self.0 {
            gradients.extend(jet.gradients(formula));
        }
        vec![gram_determinant(&gradients)]
    }

    /// Remarks on the theorem of Euler and Jacobi: with an invariant density, n - 2 independent
    /// integrals on an n-dimensional level integrate the system by quadratures.
    fn remark(&self, model: &Model, kept: &[bool]) -> Option<String> {
        if model.system.is_map() {
            return None;
        }
        let functions: usize = self.0.iter().map(|f| f.value_type().size()).sum();
        let equations = kept.iter().filter(|kept| **kept).count();
        let dimension = model.dimension().checked_sub(equations)?;
        let needed = dimension.checked_sub(2)?;
        let noun = if functions == 1 { "function" } else { "functions" };
        let place = match equations {
            0 if model.level.is_empty() => format!("on a level of dimension {dimension}"),
            0 => format!("in all {dimension} dimensions"),
            _ => format!("on a level of dimension {dimension}"),
        };
        Some(format!(
            "{functions} independent {noun} {place}; if they are integrals and there is a density, the \
             Euler–Jacobi theorem needs {needed}"
        ))
    }
}
