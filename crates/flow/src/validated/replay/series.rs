//! Taylor coefficients of a plan in balls, one box at a time.

use super::number::ReplayNumber;
use crate::taylor::form::Row;
use crate::validated::plan::{Plan, PowerExponent, RowRule};
use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

/// Sum of products with enclosed coefficients.
pub struct Weights<X> {
    pub constant: Option<X>,
    pub linear: Vec<(X, Row)>,
    pub products: Vec<(X, Row, Row)>,
}

/// Plan with its coefficients as balls.
pub struct Script<'p, X> {
    pub plan: &'p Plan,
    /// Sums of the operations, one for each; empty where the operation is none.
    pub sums: Vec<Weights<X>>,
    pub order: usize,
    /// The numbers n and 1/n.
    whole: Vec<X>,
    shares: Vec<X>,
}

impl<'p, X: ReplayNumber> Script<'p, X> {
    /// Prepares expansions to this order.
    pub fn new(plan: &'p Plan, order: usize) -> Self {
        let weights = |(_, operation): &(Row, RowRule)| match operation {
            RowRule::Sum(sum) => Weights {
                constant: sum.form.constant.as_ref().map(X::of),
                linear: sum.form.linear.iter().map(|(c, x)| (X::of(c), *x)).collect(),
                products: sum.form.products.iter().map(|(c, x, y)| (X::of(c), *x, *y)).collect(),
            },
            _ => Weights { constant: None, linear: Vec::new(), products: Vec::new() },
        };
        let sums = plan.operations.iter().map(weights).collect();
        let whole: Vec<X> = (0..=order + 1).map(|n| X::exact(n as f64)).collect();
        let shares = whole.iter().map(X::recip).collect();
        Self { plan, sums, order, whole, shares }
    }

    /// Computes all coefficients at a box of states.
    pub fn expand(&self, state: &[X]) -> BallSeries<'_, 'p, X> {
        let mut series = BallSeries { script: self, rows: vec![Vec::new(); self.plan.rows] };
        for (row, value) in state.iter().enumerate() {
            series.rows[row].push(value.clone());
        }
        for n in 0..self.order {
            for (index, (out, operation)) in self.plan.operations.iter().enumerate() {
                let value = series.coefficient(*out, operation, &self.sums[index], n);
                series.rows[*out].push(value);
            }
            for (component, rate) in self.plan.rates.iter().enumerate() {
                let next = series.at(*rate, n).times(&self.shares[n + 1]);
                series.rows[component].push(next);
            }
        }
        series
    }
}

/// Coefficients of all rows, orders 0 to `order` of the state and to `order` - 1 of other rows.
pub struct BallSeries<'s, 'p, X> {
    pub script: &'s Script<'p, X>,
    pub rows: Vec<Vec<X>>,
}

impl<X: ReplayNumber> BallSeries<'_, '_, X> {
    fn at(&self, row: Row, n: usize) -> &X {
        &self.rows[row][n]
    }

    /// Encloses Σ x_k y_{n-k} over k from `first` to `last`.
    fn convolved(&self, x: Row, y: Row, n: usize, first: usize, last: usize) -> X {
        let mut sum = X::zero();
        for k in first..=last {
            let (a, b) = (self.at(x, k), self.at(y, n - k));
            if !(a.is_zero() && b.is_known() || b.is_zero() && a.is_known()) {
                sum = sum.plus(&a.times(b));
            }
        }
        sum
    }

    /// Encloses Σ k x_k y_{n-k} over k from 1 to `last`.
    fn weighted(&self, x: Row, y: Row, n: usize, last: usize) -> X {
        (1..=last).fold(X::zero(), |sum, k| {
            let product = self.at(x, k).times(self.at(y, n - k));
            sum.plus(&self.script.whole[k].times(&product))
        })
    }

    /// Computes one coefficient of a row from those of lower orders and of rows before it.
    fn coefficient(&self, out: Row, operation: &RowRule, sum: &Weights<X>, n: usize) -> X {
        let of = |function, x: &Row| self.at(*x, 0).apply(function);
        let number = &self.script.whole[n];
        let share = &self.script.shares[n];
        let per = |x: &Row| number.times(self.at(*x, 0)).recip();
        match operation {
            RowRule::Sum(_) => self.sum(sum, n),
            RowRule::Theta(x) => number.times(self.at(*x, n)),
            RowRule::Recip(x) if n == 0 => of(UnaryFunction::Recip, x),
            RowRule::Recip(x) => self.at(out, 0).times(&self.convolved(*x, out, n, 1, n)).neg(),
            RowRule::Power { x, exponent, .. } if n == 0 => power(self.at(*x, 0), exponent),
            RowRule::Power { x, exponent, .. } => {
                let moved = X::of(&exponent.exact).times(&self.weighted(*x, out, n, n));
                moved.minus(&self.weighted(out, *x, n, n - 1)).times(&per(x))
            }
            RowRule::Exp(x) if n == 0 => of(UnaryFunction::Exp, x),
            RowRule::Exp(x) => self.weighted(*x, out, n, n).times(share),
            RowRule::Ln { x, .. } if n == 0 => of(UnaryFunction::Ln, x),
            RowRule::Ln { x, .. } => {
                let own = self.weighted(out, *x, n, n - 1);
                number.times(self.at(*x, n)).minus(&own).times(&per(x))
            }
            RowRule::Sin { x, .. } if n == 0 => of(UnaryFunction::Sin, x),
            RowRule::Sin { x, cosine } => self.weighted(*x, *cosine, n, n).times(share),
            RowRule::Cos { x, .. } if n == 0 => of(UnaryFunction::Cos, x),
            RowRule::Cos { x, sine } => self.weighted(*x, *sine, n, n).times(share).neg(),
            RowRule::Atan { x, .. } if n == 0 => of(UnaryFunction::Atan, x),
            RowRule::Atan { x, square, .. } => {
                let own = self.weighted(out, *square, n, n - 1);
                number.times(self.at(*x, n)).minus(&own).times(&per(square))
            }
            RowRule::Near(x, reach) => {
                let half = X::exact(0.5 * reach);
                let is_near = n == 0 && self.at(*x, 0).magnitude().is_below(&half);
                X::exact(if is_near { 1.0 } else { 0.0 })
            }
            RowRule::Choice { near, close, far } => {
                self.at(if self.is_near(*near) { *close } else { *far }, n).clone()
            }
            RowRule::Bounded { x, radius, bound } => {
                let size = |k: usize| self.at(*x, k).magnitude();
                let rest = X::exact(*radius).minus(&size(0));
                let own = |k: usize| size(k).mul(&self.at(out, n - k).magnitude());
                let sum = match n {
                    0 => X::exact(*bound).mul(&X::exact(*radius)),
                    _ => (1..=n).fold(X::zero(), |sum, k| sum.add(&own(k))),
                };
                match rest.is_positive() {
                    true => X::within(&sum.mul(&rest.recip())),
                    false => X::unknown(),
                }
            }
        }
    }

    /// Whether a row that says where a box is near a place is 1 there.
    pub fn is_near(&self, near: Row) -> bool {
        !self.at(near, 0).is_zero()
    }

    fn sum(&self, sum: &Weights<X>, n: usize) -> X {
        let mut total = match &sum.constant {
            Some(value) if n == 0 => value.clone(),
            _ => X::zero(),
        };
        for (weight, x) in &sum.linear {
            total = total.plus(&weight.times(self.at(*x, n)));
        }
        for (weight, x, y) in &sum.products {
            total = total.plus(&weight.times(&self.convolved(*x, *y, n, 0, n)));
        }
        total
    }

    /// Encloses Σ x_k h^k of a component of the state, k from 0 to `order`.
    pub fn polynomial(&self, component: usize, h: &X) -> X {
        let own = &self.rows[component];
        own.iter().rev().fold(X::zero(), |sum, coefficient| sum.times(h).plus(coefficient))
    }
}

fn power<X: ReplayNumber>(x: &X, exponent: &PowerExponent) -> X {
    match exponent.exact == Rational::new(1, 2) {
        true => x.apply(UnaryFunction::Sqrt),
        false => x.power(&exponent.exact),
    }
}
