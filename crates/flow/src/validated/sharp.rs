//! Residuals in double-double at nodes that are accurate to the last digit of f64.

use super::coefficients::BOXES;
use super::enclosure::{Enclosure, raised};
use super::motion::Boxed;
use super::plan::{Plan, PowerExponent, RowRule};
use crate::taylor::form::{BilinearForm, Row};
use liouville::number::double_double::two_product;
use liouville::number::double_double_ball::{DoubleDoubleBall, DoubleDoubleBalls};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation as Binary, Domain, Enclosing, UnaryFunction};

type Block = DoubleDoubleBalls<BOXES>;

const BALL: DoubleDoubleBall<BOXES> = DoubleDoubleBall;

/// Encloses a value less an exact number.
pub fn difference(value: &DoubleDoubleBalls<1>, less: &Rational) -> Enclosure {
    let ball = DoubleDoubleBall::<1>;
    let mut out = value.clone();
    ball.binary(Binary::Sub, value, &ball.constant(less), &mut out);
    enclosure::<1>(&out, 0)
}

fn enclosure<const N: usize>(block: &DoubleDoubleBalls<N>, lane: usize) -> Enclosure {
    let undefined = (f64::NAN, f64::NAN);
    let (mid, rad) = DoubleDoubleBall::<N>::enclosure(block, lane).unwrap_or(undefined);
    Enclosure { mid, rad }
}

/// Encloses Σ x_k h^k, k up to `order`, less the targets, for each start, with h = share · period.
/// The remainders of the polynomials are not included.
pub fn gaps(
    plan: &Plan,
    order: usize,
    starts: &[Vec<f64>],
    shares: &[f64],
    period: f64,
    targets: &[&[f64]],
) -> Vec<Boxed> {
    let mut coefficients = PointCoefficients::new(plan, order);
    let mut found = Vec::new();
    for ((starts, shares), targets) in
        starts.chunks(BOXES).zip(shares.chunks(BOXES)).zip(targets.chunks(BOXES))
    {
        let last = starts.len() - 1;
        let of = |values: &dyn Fn(usize) -> f64| Block {
            hi: std::array::from_fn(|lane| values(lane.min(last))),
            lo: [0.0; BOXES],
            rad: [0.0; BOXES],
        };
        let state: Vec<Block> =
            (0..plan.dimension).map(|row| of(&|lane| starts[lane][row])).collect();
        coefficients.expand(&state);
        let products: [(f64, f64); BOXES] =
            std::array::from_fn(|lane| two_product(shares[lane.min(last)], period));
        // The error of a product is exact unless it underflows.
        let (hi, lo) = (products.map(|x| x.0), products.map(|x| x.1));
        let h = Block { hi, lo, rad: [f64::MIN_POSITIVE; BOXES] };
        let ends: Vec<Block> = (0..plan.dimension)
            .map(|row| {
                let end = coefficients.polynomial(row, &h);
                combined(Binary::Sub, &end, &of(&|lane| targets[lane][row]))
            })
            .collect();
        found.extend((0..=last).map(|lane| ends.iter().map(|end| enclosure(end, lane)).collect()));
    }
    found
}

/// Taylor coefficients of points.
struct PointCoefficients<'p> {
    plan: &'p Plan,
    order: usize,
    rows: Vec<Block>,
}

impl<'p> PointCoefficients<'p> {
    fn new(plan: &'p Plan, order: usize) -> Self {
        let zero = BALL.constant(&Rational::from(0));
        Self { plan, order, rows: vec![zero; plan.rows * (order + 1)] }
    }

    fn at(&self, row: Row, n: usize) -> &Block {
        &self.rows[row * (self.order + 1) + n]
    }

    fn put(&mut self, row: Row, n: usize, value: Block) {
        let place = row * (self.order + 1) + n;
        self.rows[place] = value;
    }

    fn expand(&mut self, state: &[Block]) {
        for (row, value) in state.iter().enumerate() {
            self.put(row, 0, value.clone());
        }
        let plan = self.plan;
        for n in 0..self.order {
            for (out, operation) in &plan.operations {
                let value = self.coefficient(*out, operation, n);
                self.put(*out, n, value);
            }
            let by = share(n + 1);
            for (component, rate) in plan.rates.iter().enumerate() {
                let next = multiply(self.at(*rate, n), &by);
                self.put(component, n + 1, next);
            }
        }
    }

    /// Encloses Σ x_k y_{n-k} over k from `first` to `last`.
    fn convolved(&self, x: Row, y: Row, n: usize, first: usize, last: usize) -> Block {
        let mut sum = number(0);
        for k in first..=last {
            sum = combined(Binary::Add, &sum, &multiply(self.at(x, k), self.at(y, n - k)));
        }
        sum
    }

    /// Encloses Σ k x_k y_{n-k} over k from 1 to `last`.
    fn weighted(&self, x: Row, y: Row, n: usize, last: usize) -> Block {
        let mut sum = number(0);
        for k in 1..=last {
            let product = multiply(self.at(x, k), self.at(y, n - k));
            sum = combined(Binary::Add, &sum, &multiply(&number(k), &product));
        }
        sum
    }

    /// Computes one coefficient of a row from those of lower orders and of rows before it.
    fn coefficient(&self, out: Row, operation: &RowRule, n: usize) -> Block {
        let value = |function, x: &Row| apply(function, self.at(*x, 0));
        let per = |x: &Row| apply(UnaryFunction::Recip, &multiply(&number(n), self.at(*x, 0)));
        match operation {
            RowRule::Sum(sum) => self.sum(&sum.form, n),
            RowRule::Theta(x) => multiply(&number(n), self.at(*x, n)),
            RowRule::Recip(x) if n == 0 => value(UnaryFunction::Recip, x),
            RowRule::Recip(x) => {
                let inner = self.convolved(*x, out, n, 1, n);
                apply(UnaryFunction::Neg, &multiply(self.at(out, 0), &inner))
            }
            RowRule::Power { x, exponent, .. } if n == 0 => power(self.at(*x, 0), exponent),
            RowRule::Power { x, exponent, .. } => {
                let moved =
                    multiply(&BALL.constant(&exponent.exact), &self.weighted(*x, out, n, n));
                let rest = combined(Binary::Sub, &moved, &self.weighted(out, *x, n, n - 1));
                multiply(&rest, &per(x))
            }
            RowRule::Exp(x) if n == 0 => value(UnaryFunction::Exp, x),
            RowRule::Exp(x) => multiply(&self.weighted(*x, out, n, n), &share(n)),
            RowRule::Ln { x, .. } if n == 0 => value(UnaryFunction::Ln, x),
            RowRule::Ln { x, .. } => {
                let moved = multiply(&number(n), self.at(*x, n));
                let rest = combined(Binary::Sub, &moved, &self.weighted(out, *x, n, n - 1));
                multiply(&rest, &per(x))
            }
            RowRule::Sin { x, .. } if n == 0 => value(UnaryFunction::Sin, x),
            RowRule::Sin { x, cosine } => multiply(&self.weighted(*x, *cosine, n, n), &share(n)),
            RowRule::Cos { x, .. } if n == 0 => value(UnaryFunction::Cos, x),
            RowRule::Cos { x, sine } => {
                let moved = self.weighted(*x, *sine, n, n);
                apply(UnaryFunction::Neg, &multiply(&moved, &share(n)))
            }
            RowRule::Atan { x, .. } if n == 0 => value(UnaryFunction::Atan, x),
            RowRule::Atan { x, square, .. } => {
                let moved = multiply(&number(n), self.at(*x, n));
                let rest = combined(Binary::Sub, &moved, &self.weighted(out, *square, n, n - 1));
                multiply(&rest, &per(square))
            }
            RowRule::Near(x, reach) => {
                let is_near = |lane: usize| n == 0 && size(self.at(*x, 0), lane) < 0.5 * reach;
                let hi = std::array::from_fn(|lane| if is_near(lane) { 1.0 } else { 0.0 });
                Block { hi, lo: [0.0; BOXES], rad: [0.0; BOXES] }
            }
            RowRule::Choice { near, close, far } => {
                let (near, close, far) = (self.at(*near, 0), self.at(*close, n), self.at(*far, n));
                let of = |part: &dyn Fn(&Block, usize) -> f64| {
                    std::array::from_fn(|lane| {
                        part(if near.hi[lane] == 1.0 { close } else { far }, lane)
                    })
                };
                Block {
                    hi: of(&|block, lane| block.hi[lane]),
                    lo: of(&|block, lane| block.lo[lane]),
                    rad: of(&|block, lane| block.rad[lane]),
                }
            }
            RowRule::Bounded { x, radius, bound } => {
                let rad = |lane: usize| {
                    let rest = radius - size(self.at(*x, 0), lane);
                    if rest <= 0.0 {
                        return f64::INFINITY;
                    }
                    let own = |k: usize| size(self.at(*x, k), lane) * self.at(out, n - k).rad[lane];
                    let sum = if n == 0 { bound * radius } else { (1..=n).map(own).sum() };
                    raised(sum / (rest - radius * f64::EPSILON).max(0.0), n + 4)
                };
                let rad = std::array::from_fn(rad);
                Block { hi: [0.0; BOXES], lo: [0.0; BOXES], rad }
            }
        }
    }

    fn sum(&self, form: &BilinearForm, n: usize) -> Block {
        let mut total = match &form.constant {
            Some(value) if n == 0 => BALL.constant(value),
            _ => number(0),
        };
        for (weight, x) in &form.linear {
            total = plus(&total, weight, self.at(*x, n));
        }
        for (weight, x, y) in &form.products {
            total = plus(&total, weight, &self.convolved(*x, *y, n, 0, n));
        }
        total
    }

    fn polynomial(&self, component: usize, h: &Block) -> Block {
        let mut sum = self.at(component, self.order).clone();
        for n in (0..self.order).rev() {
            sum = combined(Binary::Add, &multiply(&sum, h), self.at(component, n));
        }
        sum
    }
}

/// Bounds the magnitude of a ball.
fn size(block: &Block, lane: usize) -> f64 {
    raised(block.hi[lane].abs() + block.lo[lane].abs() + block.rad[lane], 2)
}

fn number(value: usize) -> Block {
    let exact = [value as f64; BOXES];
    Block { hi: exact, lo: [0.0; BOXES], rad: [0.0; BOXES] }
}

/// The number 1/n.
fn share(n: usize) -> Block {
    apply(UnaryFunction::Recip, &number(n))
}

fn combined(operation: Binary, x: &Block, y: &Block) -> Block {
    let mut out = number(0);
    BALL.binary(operation, x, y, &mut out);
    out
}

fn multiply(x: &Block, y: &Block) -> Block {
    combined(Binary::Mul, x, y)
}

fn apply(function: UnaryFunction, x: &Block) -> Block {
    let mut out = number(0);
    BALL.unary(function, x, &mut out);
    out
}

fn plus(x: &Block, weight: &Rational, y: &Block) -> Block {
    match weight {
        weight if weight.is_one() => combined(Binary::Add, x, y),
        weight if (-weight).is_one() => combined(Binary::Sub, x, y),
        weight => combined(Binary::Add, x, &multiply(&BALL.constant(weight), y)),
    }
}

fn power(x: &Block, exponent: &PowerExponent) -> Block {
    if exponent.is_root {
        return apply(UnaryFunction::Sqrt, x);
    }
    let mut out = number(0);
    BALL.power(x, &exponent.exact, &mut out);
    out
}
