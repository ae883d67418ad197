//! Rows of quotients that have limits where their divisors are 0.
//!
//! With s = 1 near such a place and 0 elsewhere the quotient is (1 − s) A/(B - s B + s) + s P(s v), P
//! its series in v: neither part is ever without a value.

use super::Compiler;
use crate::taylor::form::{BilinearForm, Row};
use crate::taylor::program::Rule;
use crate::taylor::removable::Removable;
use liouville::number::rational::Rational;

/// Part of the largest term below which the last terms of a series are left out.
const LEFT_OUT: f64 = 1e-35;

impl Compiler {
    /// Row of a quotient.
    pub(super) fn limit(&mut self, own: &Removable) -> Row {
        let v = self.variable(own);
        let v = self.emit(Rule::Sum, v);
        let near = self.emit(Rule::Near(v, own.reach), BilinearForm::default());
        let far = self.quotient(own, |compiler, factor, row| {
            let minus = BilinearForm::of_product(-&factor, row, near);
            let divisor = BilinearForm::of_row(factor, row).plus(minus);
            compiler.emit(Rule::Sum, divisor.plus(BilinearForm::of_row(Self::one(), near)))
        });
        let x = self.emit(Rule::Sum, Self::product(near, v));
        let square = self.emit(Rule::Sum, Self::product(x, x));
        let mut sum = BilinearForm::default();
        for (monomial, series) in &own.series {
            let polynomial = self.polynomial(series, own.reach, [x, square]);
            let mut rows = vec![polynomial];
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
        let polynomial = self.emit(Rule::Sum, sum);
        let minus = BilinearForm::of_product(Rational::from(-1), near, far);
        let own = BilinearForm::of_row(Self::one(), far).plus(minus);
        self.emit(Rule::Sum, own.plus(Self::product(near, polynomial)))
    }

    /// Form of the variable of a series.
    pub(super) fn variable(&mut self, own: &Removable) -> BilinearForm {
        let mut v = BilinearForm::of_constant(&own.variable.constant);
        for (place, weight) in &own.variable.terms {
            let (factor, row) = self.factor(*place);
            v = v.plus(BilinearForm::of_row(&factor * weight, row));
        }
        v
    }

    /// Row of the quotient as written, with the divisors that `divisor` makes of a factor and a row: 1 near the place
    /// where these are 0.
    pub(super) fn quotient(
        &mut self,
        own: &Removable,
        divisor: impl Fn(&mut Self, Rational, Row) -> Row,
    ) -> Row {
        let (mut coefficient, mut rows) = (Self::one(), Vec::new());
        for (place, power) in &own.factors {
            let (factor, row) = self.factor(*place);
            if *power > 0 {
                for _ in 0..*power {
                    coefficient = &coefficient * &factor;
                    rows.push(row);
                }
                continue;
            }
            let divisor = divisor(self, factor, row);
            let out = self.next;
            let inverse = self.emit(Rule::Recip(divisor), Self::product(divisor, out));
            rows.extend((0..power.unsigned_abs()).map(|_| inverse));
        }
        let form = self.product_of(coefficient, rows);
        self.emit(Rule::Sum, form)
    }

    /// Row of a polynomial in x, as one in x² and x times another.
    fn polynomial(&mut self, series: &[Rational], reach: f64, [x, square]: [Row; 2]) -> Row {
        let size = |n: usize| series[n].to_f64().0.abs() * libm::pow(reach, n as f64);
        let largest = (0..series.len()).map(size).fold(0.0, f64::max);
        let count = (0..series.len()).rev().find(|n| size(*n) > LEFT_OUT * largest);
        let series = &series[..count.map_or(0, |last| last + 1)];
        let half =
            |first: usize| -> Vec<&Rational> { series.iter().skip(first).step_by(2).collect() };
        let even = self.horner(&half(0), square);
        let odd = self.horner(&half(1), square);
        let odd = match (odd.as_constant(), odd.as_row()) {
            (Some(constant), _) => BilinearForm::of_row(constant, x),
            (_, Some((factor, row))) => BilinearForm::of_product(factor.clone(), row, x),
            _ => {
                let row = self.emit(Rule::Sum, odd);
                Self::product(row, x)
            }
        };
        self.emit(Rule::Sum, even.plus(odd))
    }

    /// Form of Σ c_k w^k.
    fn horner(&mut self, coefficients: &[&Rational], w: Row) -> BilinearForm {
        let zero = BilinearForm::of_constant(&Rational::from(0));
        coefficients.iter().rev().fold(zero, |inner, coefficient| {
            let times = match inner.as_constant() {
                Some(constant) => BilinearForm::of_row(constant, w),
                None => {
                    let row = self.emit(Rule::Sum, inner);
                    Self::product(row, w)
                }
            };
            BilinearForm::of_constant(coefficient).plus(times)
        })
    }
}
