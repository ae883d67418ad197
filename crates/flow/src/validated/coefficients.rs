//! Taylor coefficients as balls, over all starts in a box, several boxes at once.

#![allow(clippy::needless_range_loop, reason = "loops over lanes become vectors")]

use liouville::graph::{Kernel, with_widest_vectors};
use liouville::number::ball::{Ball, Balls};
use liouville::number::{BinaryOperation as Binary, Domain, UnaryFunction};

use super::enclosure::{Enclosure, raised};
use super::plan::{EnclosedSum, Plan, PowerExponent, RowRule};
use crate::taylor::form::Row;

/// Number of boxes expanded at once.
pub const BOXES: usize = 8;
/// One f64 for each box.
pub type Lane = [f64; BOXES];
/// One ball for each box.
pub type Block = Balls<BOXES>;

const BALL: Ball<BOXES> = Ball;

/// Plan with the coefficients of its rows, orders 0 to `order`.
///
/// Rows other than the state end at `order` - 1. With each coefficient x there is a bound of |x|.
pub struct Coefficients<'p> {
    pub plan: &'p Plan,
    pub order: usize,
    stride: usize,
    mid: Vec<Lane>,
    rad: Vec<Lane>,
    magnitude: Vec<Lane>,
}

impl<'p> Coefficients<'p> {
    /// Prepares expansions to this order.
    pub fn new(plan: &'p Plan, order: usize) -> Self {
        let stride = order + 1;
        let zeros = vec![[0.0; BOXES]; plan.rows * stride];
        Self { plan, order, stride, mid: zeros.clone(), rad: zeros.clone(), magnitude: zeros }
    }

    /// Computes all coefficients at boxes of states, one in each lane.
    pub fn expand(&mut self, state: &[Block]) {
        self.begin(state);
        with_widest_vectors(BoxExpansion(self, self.order));
    }

    /// Computes order 0 of all rows.
    pub fn values(&mut self, state: &[Block]) {
        self.begin(state);
        with_widest_vectors(BoxExpansion(self, 1));
    }

    fn begin(&mut self, state: &[Block]) {
        for (row, value) in state.iter().enumerate() {
            self.put(row, 0, value);
        }
    }

    /// One coefficient.
    #[inline(always)]
    pub fn get(&self, row: Row, n: usize) -> Block {
        let place = row * self.stride + n;
        Balls::new(self.mid[place], self.rad[place])
    }

    /// Bounds of the magnitudes of a row's coefficients.
    pub fn magnitudes(&self, row: Row) -> &[Lane] {
        &self.magnitude[row * self.stride..(row + 1) * self.stride]
    }

    #[inline(always)]
    fn put(&mut self, row: Row, n: usize, value: &Block) {
        let place = row * self.stride + n;
        for lane in 0..BOXES {
            let (mid, rad) = (value.mid[lane], value.rad[lane]);
            self.mid[place][lane] = mid;
            self.rad[place][lane] = rad;
            self.magnitude[place][lane] = raised(mid.abs() + rad, 1);
        }
    }

    /// Encloses Σ x_k y_{n-k} over k from `first` to `last`.
    #[inline(always)]
    fn convolved(&self, x: Row, y: Row, n: usize, first: usize, last: usize) -> Block {
        let (mut mid, mut rad, mut size) = ([0.0; BOXES], [0.0; BOXES], [0.0; BOXES]);
        let (x, y) = (x * self.stride, y * self.stride + n);
        for k in first..=last {
            let (xm, ym) = (&self.mid[x + k], &self.mid[y - k]);
            let (xr, yr) = (&self.rad[x + k], &self.rad[y - k]);
            let (xa, ya) = (&self.magnitude[x + k], &self.magnitude[y - k]);
            for lane in 0..BOXES {
                mid[lane] += xm[lane] * ym[lane];
                rad[lane] += xr[lane] * ya[lane] + xa[lane] * yr[lane];
                size[lane] += xa[lane] * ya[lane];
            }
        }
        // The error of a sum of n products is at most γ_n times the sum of their magnitudes.
        let share = (n as f64 + 4.0) * f64::EPSILON / 2.0;
        let rad = std::array::from_fn(|lane| raised(rad[lane] + share * size[lane], 2 * n + 4));
        Balls::new(mid, rad)
    }

    /// Encloses Σ k x_k y_{n-k} over k from 1 to `last`.
    #[inline(always)]
    fn weighted(&self, x: Row, y: Row, n: usize, last: usize) -> Block {
        let mut sum = constant(Enclosure::ZERO);
        for k in 1..=last {
            let weight = constant(Enclosure::exact(k as f64));
            sum = add(&sum, &mul(&weight, &mul(&self.get(x, k), &self.get(y, n - k))));
        }
        sum
    }

    /// Computes one coefficient of a row from those of lower orders and of rows before it.
    #[inline(always)]
    fn coefficient(&self, out: Row, operation: &RowRule, n: usize) -> Block {
        let at = |row: &Row, n: usize| self.get(*row, n);
        let number = |k: usize| constant(Enclosure::exact(k as f64));
        match operation {
            RowRule::Sum(sum) => self.sum(sum, n),
            RowRule::Theta(x) => mul(&number(n), &at(x, n)),
            RowRule::Recip(x) if n == 0 => apply(UnaryFunction::Recip, &at(x, 0)),
            RowRule::Recip(x) => {
                let inner = self.convolved(*x, out, n, 1, n);
                apply(UnaryFunction::Neg, &mul(&at(&out, 0), &inner))
            }
            RowRule::Power { x, exponent, .. } if n == 0 => power(&at(x, 0), exponent),
            RowRule::Power { x, exponent, .. } => {
                let moved = mul(&constant(exponent.value), &self.weighted(*x, out, n, n));
                let own = self.weighted(out, *x, n, n - 1);
                let divisor = apply(UnaryFunction::Recip, &mul(&number(n), &at(x, 0)));
                mul(&sub(&moved, &own), &divisor)
            }
            RowRule::Exp(x) if n == 0 => apply(UnaryFunction::Exp, &at(x, 0)),
            RowRule::Exp(x) => divided(&self.weighted(*x, out, n, n), n),
            RowRule::Ln { x, .. } if n == 0 => apply(UnaryFunction::Ln, &at(x, 0)),
            RowRule::Ln { x, .. } => {
                let own = self.weighted(out, *x, n, n - 1);
                let rest = sub(&mul(&number(n), &at(x, n)), &own);
                mul(&rest, &apply(UnaryFunction::Recip, &mul(&number(n), &at(x, 0))))
            }
            RowRule::Sin { x, .. } if n == 0 => apply(UnaryFunction::Sin, &at(x, 0)),
            RowRule::Sin { x, cosine } => divided(&self.weighted(*x, *cosine, n, n), n),
            RowRule::Cos { x, .. } if n == 0 => apply(UnaryFunction::Cos, &at(x, 0)),
            RowRule::Cos { x, sine } => {
                divided(&apply(UnaryFunction::Neg, &self.weighted(*x, *sine, n, n)), n)
            }
            RowRule::Atan { x, .. } if n == 0 => apply(UnaryFunction::Atan, &at(x, 0)),
            RowRule::Atan { x, square, .. } => {
                let own = self.weighted(out, *square, n, n - 1);
                let rest = sub(&mul(&number(n), &at(x, n)), &own);
                mul(&rest, &apply(UnaryFunction::Recip, &mul(&number(n), &at(square, 0))))
            }
            RowRule::Near(x, reach) => {
                let size = self.magnitudes(*x)[0];
                let is_near = |lane: usize| n == 0 && size[lane] < 0.5 * reach;
                let mid = std::array::from_fn(|lane| if is_near(lane) { 1.0 } else { 0.0 });
                Balls::new(mid, [0.0; BOXES])
            }
            RowRule::Choice { near, close, far } => {
                let (close, far) = (at(close, n), at(far, n));
                let chosen = |close: f64, far: f64, lane: usize| {
                    if self.is_near(*near, lane) { close } else { far }
                };
                let mid = |lane: usize| chosen(close.mid[lane], far.mid[lane], lane);
                let rad = |lane: usize| chosen(close.rad[lane], far.rad[lane], lane);
                Balls::new(std::array::from_fn(mid), std::array::from_fn(rad))
            }
            RowRule::Bounded { x, radius, bound } => {
                let rad =
                    std::array::from_fn(|lane| self.bounded(out, *x, n, [*radius, *bound], lane));
                Balls::new([0.0; BOXES], rad)
            }
        }
    }

    /// Whether a row that says where a box is near a place is 1 there.
    #[inline(always)]
    pub fn is_near(&self, near: Row, lane: usize) -> bool {
        self.mid[near * self.stride][lane] == 1.0
    }

    /// Bounds a coefficient of Σ a_k x^k with Σ |a_k| R^k ≤ c: it is at most that of c/(1 - X/R), X the
    /// series of the magnitudes of x.
    #[inline(always)]
    fn bounded(&self, out: Row, x: Row, n: usize, [radius, bound]: [f64; 2], lane: usize) -> f64 {
        let (x, own) = (self.magnitudes(x), self.magnitudes(out));
        let rest = radius - x[0][lane];
        if rest <= 0.0 {
            return f64::INFINITY;
        }
        let sum = match n {
            0 => bound * radius,
            _ => (1..=n).map(|k| x[k][lane] * own[n - k][lane]).sum(),
        };
        // The difference is rounded too, by a unit of R.
        raised(sum / (rest - radius * f64::EPSILON).max(0.0), n + 4)
    }

    #[inline(always)]
    fn sum(&self, sum: &EnclosedSum, n: usize) -> Block {
        let mut total = constant(match sum.constant {
            Some(value) if n == 0 => value,
            _ => Enclosure::ZERO,
        });
        for (weight, x) in &sum.linear {
            total = plus(&total, *weight, &self.get(*x, n));
        }
        for (weight, x, y) in &sum.products {
            total = plus(&total, *weight, &self.convolved(*x, *y, n, 0, n));
        }
        total
    }

    /// Encloses Σ x_k h^k of a component of the state, k from 0 to `order`.
    pub fn polynomial(&self, component: usize, h: &Block) -> Block {
        let mut sum = self.get(component, self.order);
        for n in (0..self.order).rev() {
            sum = add(&mul(&sum, h), &self.get(component, n));
        }
        sum
    }
}

/// Work of an expansion, up to an order.
struct BoxExpansion<'c, 'p>(&'c mut Coefficients<'p>, usize);

impl Kernel for BoxExpansion<'_, '_> {
    #[inline(always)]
    fn run(self) {
        let Self(own, order) = self;
        let plan = own.plan;
        for n in 0..order {
            for (out, operation) in &plan.operations {
                let value = own.coefficient(*out, operation, n);
                own.put(*out, n, &value);
            }
            for (component, rate) in plan.rates.iter().enumerate() {
                let next = divided(&own.get(*rate, n), n + 1);
                own.put(component, n + 1, &next);
            }
        }
    }
}

/// The same ball in every lane.
#[inline(always)]
pub fn constant(value: Enclosure) -> Block {
    Balls::new([value.mid; BOXES], [value.rad; BOXES])
}

/// Encloses x + y.
#[inline(always)]
pub fn add(x: &Block, y: &Block) -> Block {
    let mut out = constant(Enclosure::ZERO);
    BALL.binary(Binary::Add, x, y, &mut out);
    out
}

#[inline(always)]
fn sub(x: &Block, y: &Block) -> Block {
    let mut out = constant(Enclosure::ZERO);
    BALL.binary(Binary::Sub, x, y, &mut out);
    out
}

#[inline(always)]
fn mul(x: &Block, y: &Block) -> Block {
    let mut out = constant(Enclosure::ZERO);
    BALL.binary(Binary::Mul, x, y, &mut out);
    out
}

#[inline(always)]
fn apply(function: UnaryFunction, x: &Block) -> Block {
    let mut out = constant(Enclosure::ZERO);
    BALL.unary(function, x, &mut out);
    out
}

/// Encloses x/n.
#[inline(always)]
fn divided(x: &Block, n: usize) -> Block {
    mul(x, &apply(UnaryFunction::Recip, &constant(Enclosure::exact(n as f64))))
}

/// Encloses x + weight y; weights ±1 are exact.
#[inline(always)]
fn plus(x: &Block, weight: Enclosure, y: &Block) -> Block {
    match weight {
        Enclosure { mid: 1.0, rad: 0.0 } => add(x, y),
        Enclosure { mid: -1.0, rad: 0.0 } => sub(x, y),
        _ => add(x, &mul(&constant(weight), y)),
    }
}

fn power(x: &Block, exponent: &PowerExponent) -> Block {
    if exponent.is_root {
        return apply(UnaryFunction::Sqrt, x);
    }
    let mut out = constant(Enclosure::ZERO);
    BALL.power(x, &exponent.exact, &mut out);
    out
}
