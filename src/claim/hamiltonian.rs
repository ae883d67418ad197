//! Hamiltonian form in the variables of `[variables]` with the bracket of `[poisson]`.

use super::elsewhere::inverse_at;
use super::of_bracket::{
    CHOICE, are_not_zero, bracket_of, defects, images_as_written, of, scalar_in, slope, they_vary,
    turned, variables, written,
};
use super::{Condition, Reader, Statement, difference};
use crate::formula::{Formula, Type};
use crate::graph::Expr;
use crate::mechanics::calculus::DualPoint;
use crate::scalar::Scalar;

/// The claim N⁻¹y' = P ∂H/∂y and P + Pᵀ = 0, with t' = 1 where time is one of the variables and has no bracket.
#[derive(Clone, Debug)]
pub struct Hamiltonian {
    hamiltonian: Formula,
    multiplier: Option<Formula>,
    /// Index of the bracket.
    bracket: usize,
}

impl Statement for Hamiltonian {
    const NAME: &'static str = "hamiltonian";
    const COMPANIONS: &'static [&'static str] = &["multiplier", CHOICE];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let bracket = bracket_of(from, Self::NAME)?;
        let hamiltonian = scalar_in(from, Self::NAME)?;
        let names = &variables(from, Self::NAME)?.model.vocabulary;
        let multiplier = from.formula_in("multiplier", Some(Type::Scalar), names)?;
        Ok(Self { hamiltonian, multiplier, bracket })
    }

    fn particulars(&self) -> Option<String> {
        let factor =
            self.multiplier.as_ref().map(|own| format!("multiplier {}", own.text().trim()));
        let function = format!("H = {}", self.hamiltonian.text().trim());
        Some([Some(function), factor].into_iter().flatten().collect::<Vec<_>>().join("; "))
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        let variables = of(jet.phase.model());
        let there = jet.in_variables(variables);
        let multiplier = self.multiplier.as_ref().map_or_else(T::one, |n| there.phase.scalar(n));
        let gradient = slope(there, &self.hamiltonian);
        let tensor = variables.tensor(self.bracket, &there.phase);
        let claimed = turned(&tensor, &gradient).into_iter().map(|x| x * multiplier).collect();
        let mut residual = difference(variables.rates(jet), claimed);
        if let Some(clock) = variables.clock(self.bracket) {
            residual[clock] = variables.rates(jet)[clock] - T::one();
        }
        residual.extend(variables.symmetric_part(&tensor));
        residual
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let mut conditions = vec![they_vary(jet, "the new variables obey a relation", false)];
        conditions.extend(are_not_zero(jet, &[self.bracket]));
        conditions
    }

    fn written_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        let variables = of(jet.phase.model());
        let there = &jet.in_variables(variables).phase;
        let functions = [&self.hamiltonian].into_iter().chain(&self.multiplier);
        let mut values = images_as_written(variables, &jet.phase);
        values.extend(written(variables, &[self.bracket], functions, there));
        // The statement divides by N.
        values.extend(self.multiplier.iter().flat_map(|own| inverse_at(there, own)));
        values
    }

    fn quadrature_defects_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        defects(jet, &[self.bracket], [&self.hamiltonian].into_iter().chain(&self.multiplier))
    }
}
