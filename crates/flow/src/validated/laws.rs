//! Equations of a motion as they enter a proof: parameters, some of them loose, and the functions
//! that the motion conserves.

use crate::motion::presence::as_written;
use crate::motion::recorded::{Loose, filled};
use liouville::formula::Formula;
use liouville::graph::Expr;
use liouville::mechanics::{LevelFunction, Model, Phase};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use num_dual::Dual;

/// Model with its parameters and the functions that are proved to be conserved.
#[derive(Clone, Copy)]
pub struct Laws<'l> {
    /// Model of the case.
    pub model: &'l Model,
    /// Values of the free parameters, at the centres of their ranges where they are loose.
    pub parameters: &'l [Rational],
    /// Free parameters that vary within ranges.
    pub loose: &'l [Loose],
    /// Whether the energy is conserved.
    pub energy: bool,
    /// Further functions that are conserved.
    pub integrals: &'l [&'l Formula],
}

impl<'l> Laws<'l> {
    /// Records all formulas as written, those of conserved functions too: one that jumps, or has no value, is not kept
    /// where it does, though its rate may be 0 on both sides.
    pub fn as_written(&self, phase: &Phase<'_, Expr>) -> Vec<Expr> {
        let level = self.model.level.iter().filter_map(|own| match &own.function {
            LevelFunction::Formula(formula) => Some(formula),
            _ => None,
        });
        let mut written = as_written(phase);
        written.extend(phase.literal_values(level.chain(self.integrals.iter().copied())));
        written
    }

    /// Point over recorded scalars, the loose parameters given by variables between -1 and 1.
    pub fn point(&self, state: &[Expr], loose: &[Expr]) -> Phase<'l, Expr> {
        Phase::new(self.model, &filled(self.parameters, self.loose, loose), state)
    }

    /// Point with a derivative part along a loose parameter, and this one of the state.
    pub fn lifted(
        &self,
        state: &[Expr],
        loose: &[Expr],
        direction: &[Expr],
        along: usize,
    ) -> Phase<'l, Dual<Expr>> {
        let filled = filled(self.parameters, self.loose, loose);
        let mut parameters: Vec<Dual<Expr>> = filled.into_iter().map(Dual::from_re).collect();
        if let Some(one) = self.loose.get(along) {
            let slope = Expr::rational(&one.half);
            parameters[one.component].eps = slope;
            for (component, is_negative) in &one.tied {
                parameters[*component].eps = if *is_negative { -slope } else { slope };
            }
        }
        let pairs = state.iter().zip(direction);
        let state: Vec<Dual<Expr>> = pairs.map(|(x, dx)| Dual::new(*x, *dx)).collect();
        Phase::new(self.model, &parameters, &state)
    }
}
