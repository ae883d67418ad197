//! Rows of quotients that have limits where their divisors are 0, for enclosures.
//!
//! In boxes near such a place the quotient is Σ m (P(v) + v^n T(v)), m products of unknowns, P the first n
//! terms of its series and T bounded; elsewhere it is as written, with 1 in place of v.

use super::Compiler;
use crate::taylor::form::{BilinearForm, Row};
use crate::taylor::program::Rule;
use crate::taylor::quotients::Needed;
use crate::taylor::removable::{ProvedSeries, Removable};
use crate::taylor::watch::Domain;
use liouville::graph::{Expr, Graph};
use liouville::number::rational::Rational;

/// Operations that values contain as written, and that an exact program of some rates does without:
/// quotients with limits pass where their divisors are 0, and 0/x as written has no value there.
pub(crate) fn passed(graph: &Graph, rates: &[Expr], written: &[Expr]) -> Vec<Expr> {
    let needed = |values: &[Expr]| {
        let wanted: Vec<usize> = values.iter().map(|value| graph.place(*value)).collect();
        Needed::exactly(graph, &wanted).places
    };
    let (made, all) = (needed(rates), needed(written));
    let lost = (0..graph.len()).filter(|place| all[*place] && !made[*place]);
    let lost = lost.filter(|place| Domain::of(graph.step(*place)).is_some());
    lost.map(|place| graph.at(place)).collect()
}

/// Powers of a variable near the place where it is 0.
pub(super) struct PowersNear {
    variable: BilinearForm,
    reach: f64,
    near: Row,
    /// v, v², …; all 0 elsewhere.
    powers: Vec<Row>,
}

impl Compiler {
    /// Row of a quotient.
    pub(super) fn proved_limit(&mut self, own: &Removable, proved: &ProvedSeries) -> Row {
        let count = own.series.iter().map(|(_, series)| series.len()).max().unwrap_or(0);
        let index = self.powers_near(own, proved.reach, count);
        let near = self.series[index].near;
        let far = self.quotient(own, |compiler, factor, row| {
            let divisor = compiler.emit(Rule::Sum, BilinearForm::of_row(factor, row));
            let one = compiler.constant(1);
            compiler.choice(near, one, divisor)
        });
        let mut sum = BilinearForm::default();
        for ((monomial, series), rest) in own.series.iter().zip(&proved.rests) {
            let powers = self.series[index].powers.clone();
            let bounded = Rule::Bounded(powers[0], [proved.radius, *rest]);
            let bounded = self.emit(bounded, BilinearForm::default());
            let mut form = Self::product(powers[count - 1], bounded);
            form = form.plus(BilinearForm::of_constant(&series[0]));
            for (coefficient, power) in series[1..].iter().zip(&powers) {
                form = form.plus(BilinearForm::of_row(coefficient.clone(), *power));
            }
            let mut rows = vec![self.emit(Rule::Sum, form)];
            let mut coefficient = Self::one();
            for (place, power) in monomial {
                let (factor, row) = self.factor(*place);
                for _ in 0..*power {
                    coefficient = &coefficient * &factor;
                    rows.push(row);
                }
            }
            let term = self.product_of(coefficient, rows);
            sum = sum.plus(term);
        }
        let close = self.emit(Rule::Sum, sum);
        self.choice(near, close, far)
    }

    fn choice(&mut self, near: Row, close: Row, far: Row) -> Row {
        self.emit(Rule::Choice([near, close, far]), BilinearForm::default())
    }

    fn constant(&mut self, value: i64) -> Row {
        self.emit(Rule::Sum, BilinearForm::of_constant(&Rational::from(value)))
    }

    /// Index of the powers of a variable, made where there are none.
    fn powers_near(&mut self, own: &Removable, reach: f64, count: usize) -> usize {
        let variable = self.variable(own);
        let is_known = |own: &PowersNear| {
            own.variable == variable && own.reach == reach && own.powers.len() >= count
        };
        if let Some(index) = self.series.iter().position(is_known) {
            return index;
        }
        let v = self.emit(Rule::Sum, variable.clone());
        let near = self.emit(Rule::Near(v, reach), BilinearForm::default());
        let zero = self.constant(0);
        let mut powers = vec![self.choice(near, v, zero)];
        for n in 2..=count {
            let (low, high) = (powers[n / 2 - 1], powers[n - n / 2 - 1]);
            powers.push(self.emit(Rule::Sum, Self::product(low, high)));
        }
        self.series.push(PowersNear { variable, reach, near, powers });
        self.series.len() - 1
    }
}
