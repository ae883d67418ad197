//! Polynomials with their rates along the motion, as tapes.

use num_dual::Dual;

use liouville::formula::{Formula, Type};
use liouville::graph::{Expr, Tape};

use super::super::SearchError;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::super::terms::{is_one, recorded};
use super::images::{self, Images};
use super::monomials::{self, value};
use super::setting::{OrbitSetting, PrimePhasePoint, SPARE_ORDERS, run};

/// A polynomial of the state with its rate.
#[derive(Clone)]
pub struct RatedPolynomial {
    /// Formula in the names of the case.
    pub formula: Formula,
    /// Bound on its degree in the state.
    pub degree: u32,
    tape: Tape,
}

impl RatedPolynomial {
    /// Reads a formula; `None` if it is not a scalar of the case.
    pub fn of(
        setting: &OrbitSetting<'_>,
        formula: &Formula,
        degree: u32,
    ) -> Result<Option<Self>, SearchError> {
        if formula.value_type() != Type::Scalar {
            return Ok(None);
        }
        let (graph, outputs) = recorded(setting.case, |jet| {
            let moved: Dual<Expr> = jet.along_field().scalar(formula);
            [moved.re, moved.eps]
        })?;
        let tape = Tape::new(&graph, &outputs);
        Ok(Some(Self { formula: formula.clone(), degree, tape }))
    }

    /// Value and rate at a point.
    pub fn at(&self, at: &PrimePoint, point: &PrimePhasePoint) -> Option<(u64, u64)> {
        let inputs = [point.parameters.as_slice(), &point.state].concat();
        run(&self.tape, at.modulus, &inputs).map(|values| (values[0], values[1]))
    }

    /// Finds the cofactor K of degree below that of the field, for which v(f) = K f, and writes it;
    /// `None` if there is none.
    pub fn cofactor(
        &self,
        setting: &OrbitSetting<'_>,
        variables: &[usize],
        degree: usize,
    ) -> Result<Option<Formula>, SearchError> {
        let highest = degree.saturating_sub(1) as u32;
        let all = monomials::up_to(variables, setting.dimension(), highest);
        let all = setting.independent(all, variables);
        let make = |at: &PrimePoint| {
            let m = at.modulus;
            let mut echelon = Echelon::new(all.len() + 1, m);
            for number in 0..(all.len() + SPARE_ORDERS) as u64 {
                let point = setting.point(at, number)?;
                let (own, rate) = self.at(at, &point)?;
                let row = all.iter().map(|a| m.mul(own, value(&m, &point.state, a)));
                echelon.push(row.chain([m.sub(0, rate)]).collect());
            }
            let mut vectors = echelon.null_space();
            let mut vector = vectors.pop().filter(|_| vectors.is_empty())?;
            vector.pop().filter(|last| *last == m.one())?;
            Some(vector)
        };
        let images = Images { setting, width: all.len(), is_split: false, make };
        let Some(coefficients) = images::coefficients(&images)? else { return Ok(None) };
        let functions = setting.functions(&all)?;
        let above = coefficients.sum(&(0..all.len()).collect::<Vec<_>>(), &functions)?;
        let above = above.unwrap_or_else(|| Formula::number(0));
        let below = coefficients.formula(all.len())?;
        match is_one(&below) {
            true => Ok(Some(above)),
            false => Ok(Some((above / &below)?)),
        }
    }
}
