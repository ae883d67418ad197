//! The linear equations for a bracket with a known Hamiltonian, and the proof that they are complete.

use super::super::SearchError;
use super::super::ask::judged;
use super::super::linear::SampledFunctions;
use super::super::terms::{integers, recorded};
use super::bracket_family::BracketUnknown;
use super::poisson::BracketSearch;
use super::scales::Scale;
use liouville::claim::Claim;
use liouville::formula::Formula;
use liouville::graph::{Expr, Graph};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use liouville::verdict::{ClaimReport, Verdict};

/// Solutions of v = N P ∂H in a family, P ∂F = 0 included.
pub(super) struct Solutions {
    /// One of them, if there is one.
    pub(super) solution: Option<Vec<Rational>>,
    /// Solutions of P ∂H = 0.
    pub(super) beside: Vec<Vec<Rational>>,
    /// Number of further ones, without small rational coefficients.
    pub(super) irrational: usize,
}

impl BracketSearch<'_> {
    /// Solves v = N P ∂H and P ∂F = 0 modulo a prime.
    pub(super) fn solved(&self, multiplier: &Scale) -> Result<Solutions, SearchError> {
        let (graph, columns) = self.recorded(multiplier)?;
        let mut functions = SampledFunctions::new(self.case, &graph, &columns, self.of.effort)?;
        let (vectors, irrational) = functions.relations()?.rational()?;
        // The field is the last column: 1 in the solution, 0 in those of P ∂H = 0.
        let is_solution = |vector: &Vec<Rational>| vector.last().is_some_and(|c| !c.is_zero());
        let (solutions, beside): (Vec<_>, Vec<_>) = vectors.into_iter().partition(is_solution);
        Ok(Solutions { solution: solutions.into_iter().next(), beside, irrational })
    }

    /// Records the contribution of each unknown to N P ∂H and to P ∂F as a column; the last column is
    /// v and 0.
    fn recorded(&self, multiplier: &Scale) -> Result<(Graph, Vec<Vec<Expr>>), SearchError> {
        let dimension = self.family.names.len();
        let zero = || Expr::rational(&Rational::from(0));
        let mut weights = Vec::new();
        for weight in &self.family.weights {
            weights.push(weight.formula()?);
        }
        let multiplier = match multiplier.is_one() {
            true => None,
            false => Some(self.of.scales.formula(multiplier)?),
        };
        Ok(recorded(self.case, |jet| {
            let state = jet.phase.state().to_vec();
            let factor = multiplier.as_ref().map(|own| jet.phase.scalar(own));
            let slopes = jet.gradient(|at| at.scalar(&self.of.hamiltonian));
            let slopes = match factor {
                None => slopes,
                Some(factor) => slopes.into_iter().map(|slope| factor * slope).collect(),
            };
            let level = self.case.model.level.iter();
            let level = level.map(|own| jet.gradient(|at| at.level_function(&own.function)));
            let all: Vec<Vec<Expr>> = [slopes].into_iter().chain(level).collect();
            let weights: Vec<Expr> =
                weights.iter().map(|weight| jet.phase.scalar(weight)).collect();
            let column = |unknown: &BracketUnknown| {
                let (i, j) = unknown.pair;
                let powers = state.iter().zip(&unknown.exponents);
                let factors = powers.flat_map(|(x, a)| (0..*a).map(move |_| *x));
                let size = factors.fold(weights[unknown.weight], |product, x| product * x);
                let mut column = vec![zero(); dimension * all.len()];
                for (block, slopes) in all.iter().enumerate() {
                    column[block * dimension + i] = size * slopes[j];
                    column[block * dimension + j] = -(size * slopes[i]);
                }
                column
            };
            let mut field = jet.phase.field().to_vec();
            field.resize(dimension * all.len(), zero());
            let columns = self.family.unknowns.iter().map(column);
            columns.chain([field]).collect()
        })?)
    }

    /// Whether all solutions of P ∂H = 0 modulo the prime are proved to be solutions, and the
    /// functions left out to depend on others: then the rank of the unknowns' columns is that modulo
    /// the prime, and the rank with v is not below that.
    pub(super) fn are_proved(&self, beside: &[Vec<Rational>]) -> Result<bool, SearchError> {
        let Some(vanishing) = &self.family.vanishing else { return Ok(false) };
        let zero = Formula::number(0);
        let claims: Vec<Claim> = vanishing.iter().map(|sum| Claim::identity(sum, &zero)).collect();
        let is_proved = |own: &ClaimReport| own.verdict == Verdict::Proved;
        if !judged(self.case, &claims, self.of.effort)?.iter().all(is_proved) {
            return Ok(false);
        }
        for vector in beside {
            self.of.effort.halt.check()?;
            let asked = self.with_bracket(&self.entries(&integers(vector))?)?;
            for function in [&self.of.hamiltonian].into_iter().chain(self.of.level) {
                if !self.is_casimir(&asked, function)? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }
}
