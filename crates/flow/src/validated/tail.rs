//! Bounds of what a Taylor polynomial leaves out, in the norm ‖a‖ = Σ |a_k| ρ^k.
//!
//! Each row a of a plan is a known polynomial a_N of degree N - 1 and a tail of order ≥ N with norm
//! at most ε_a. With [·] the part of order ≥ N, and θ = t d/dt:
//!
//! ```text
//! a b      ε = ‖[a_N b_N]‖ + ‖a_N‖ ε_b + ‖b_N‖ ε_a + ε_a ε_b
//! q = 1/b  1 - q_N b = [..], E = ‖[q_N b_N]‖ + ‖q_N‖ ε_b:  ‖1/b‖ ≤ ‖q_N‖/(1 - E),  ε = E ‖1/b‖
//! e^a      e^(a_N) = e_N + τ, N ‖τ‖ ≤ ‖τ‖ ‖θa_N‖ + ‖[e_N θa_N]‖;  e^a = e^(a_N) e^(a - a_N)
//! ```
//!
//! and in the same way for the other functions. A state has the tail of ∫ f. If the tails that come
//! out of the rates are not above those put in, Picard's operator maps a ball of tails to itself; it
//! is compact, so that a fixed point exists (Schauder), and it is the solution, whose coefficients
//! are unique: analytic in |t| < ρ, with the remainder after order N at most
//! ρ ε_f/(N + 1) (h/ρ)^(N+1).

use super::coefficients::{Block, Coefficients, LANES, Lane, add};
use super::enclosure::{Enclosure, raised};
use super::plan::{Operation, Sum};
use crate::form::Row;
use liouville::number::ball::Balls;

/// Factor above the rounding of any bound here: sums of at most 10⁴ terms of either sign of none.
const ALLOWANCE: f64 = 1.0 + 1e-11;
/// Ratio of the first radius tried to the step, and of the least.
const FIRST: f64 = 9.0;
const LEAST: f64 = 1.5;
/// Factor by which the radius shrinks where it was too large.
const SHRINK: f64 = 0.87;
/// Number of rounds for tails to settle.
const ROUNDS: usize = 40;
/// Growth of tails from round to round, and their first size against the last coefficient.
const GROWTH: f64 = 1.1;
const FIRST_SIZE: f64 = 1.5;

/// Bounds a number computed by few operations on non-negative numbers.
#[inline(always)]
fn above(x: f64) -> f64 {
    x * ALLOWANCE + f64::MIN_POSITIVE
}

/// Bounds e^x - 1 from above for 0 ≤ x < 1.
fn growth(x: f64) -> f64 {
    if x < 1.0 { above(x + x * x) } else { f64::INFINITY }
}

/// Returns numerator/(1 - x), or infinity where x is not below 1.
fn over_rest(numerator: f64, x: f64) -> f64 {
    let rest = 1.0 - above(x);
    if rest > 0.0 { above(numerator / rest) } else { f64::INFINITY }
}

/// Tails of an expansion, one for each lane.
pub struct Tails<'c, 'p> {
    coefficients: &'c Coefficients<'p>,
    order: usize,
    /// Radii ρ.
    radius: Lane,
    /// |a_k| ρ^k and their sums from k on, row by row.
    terms: Vec<Lane>,
    sums: Vec<Lane>,
    /// The same for k |a_k| ρ^k, of the rows whose derivative is read.
    weighted_sums: Vec<Lane>,
    tails: Vec<Lane>,
}

impl<'c, 'p> Tails<'c, 'p> {
    fn new(coefficients: &'c Coefficients<'p>) -> Self {
        let order = coefficients.order;
        let zeros = vec![[0.0; LANES]; coefficients.plan.rows * (order + 1)];
        Self {
            coefficients,
            order,
            radius: [0.0; LANES],
            terms: zeros.clone(),
            sums: zeros.clone(),
            weighted_sums: zeros,
            tails: vec![[0.0; LANES]; coefficients.plan.rows],
        }
    }

    /// Computes the norms of all rows for the present radii.
    fn measure(&mut self) {
        let (order, stride) = (self.order, self.order + 1);
        let mut powers = vec![[1.0; LANES]; order];
        for k in 1..order {
            for lane in 0..LANES {
                powers[k][lane] = powers[k - 1][lane] * self.radius[lane];
            }
        }
        for row in 0..self.coefficients.plan.rows {
            let place = row * stride;
            let magnitudes = self.coefficients.magnitudes(row);
            for k in (0..order).rev() {
                for lane in 0..LANES {
                    let term = above(magnitudes[k][lane] * powers[k][lane]);
                    self.terms[place + k][lane] = term;
                    self.sums[place + k][lane] = self.sums[place + k + 1][lane] + term;
                    self.weighted_sums[place + k][lane] =
                        self.weighted_sums[place + k + 1][lane] + k as f64 * term;
                }
            }
        }
    }

    /// Bounds ‖a_N‖.
    fn norm(&self, row: Row, lane: usize) -> f64 {
        above(self.sums[row * (self.order + 1)][lane])
    }

    /// Bounds ‖θa_N‖.
    fn weighted_norm(&self, row: Row, lane: usize) -> f64 {
        above(self.weighted_sums[row * (self.order + 1)][lane])
    }

    /// Bounds ‖[a_N b_N]‖, given the sums of b or those of θb.
    #[inline(always)]
    fn crossed(&self, a: Row, b: Row, sums: &[Lane], lane: usize) -> f64 {
        let stride = self.order + 1;
        let (a, b) = (a * stride, b * stride);
        let mut sum = 0.0;
        for k in 1..self.order {
            sum += self.terms[a + k][lane] * sums[b + self.order - k][lane];
        }
        above(sum)
    }

    fn cross(&self, a: Row, b: Row, lane: usize) -> f64 {
        self.crossed(a, b, &self.sums, lane)
    }

    /// Bounds ‖[a_N θb_N]‖.
    fn cross_weighted(&self, a: Row, b: Row, lane: usize) -> f64 {
        self.crossed(a, b, &self.weighted_sums, lane)
    }

    /// Bounds ‖1/b‖ for b with this tail, given the row of its reciprocal.
    fn reciprocal(&self, inverse: Row, b: Row, tail: f64, lane: usize) -> f64 {
        let norm = self.norm(inverse, lane);
        over_rest(norm, self.cross(inverse, b, lane) + norm * tail)
    }

    /// Bounds the tail of a row from those of its arguments.
    fn tail(&self, out: Row, operation: &Operation, crosses: &[Lane], lane: usize) -> f64 {
        let n = self.order as f64;
        let tail = |row: &Row| self.tails[*row][lane];
        let found = match operation {
            Operation::Sum(sum) => self.tail_of_sum(sum, crosses, lane),
            // Read by rules that do without.
            Operation::Theta(_) => f64::INFINITY,
            Operation::Recip(x) => {
                let norm = self.norm(out, lane);
                let defect = above(self.cross(out, *x, lane) + norm * tail(x));
                over_rest(defect * norm, defect)
            }
            Operation::Power { x, inverse, exponent } => {
                let q = exponent.value.magnitude();
                // x_N^q = z_N + τ with x_N θτ = q τ θx_N + [q z_N θx_N - x_N θz_N].
                let bound = self.reciprocal(*inverse, *x, 0.0, lane);
                let rest =
                    q * self.cross_weighted(out, *x, lane) + self.cross_weighted(*x, out, lane);
                let slope = q * bound * self.weighted_norm(*x, lane) / n;
                let own = over_rest(bound * rest / n, slope);
                // (1 + w)^q - 1 has the majorant (1 - w)^(-|q|) - 1 ≤ e^(|q| w/(1 - w)) - 1.
                let share = above(bound * tail(x));
                let moved = growth(over_rest(q * share, share));
                own + (self.norm(out, lane) + own) * moved
            }
            Operation::Exp(x) => {
                let rest = self.cross_weighted(out, *x, lane) / n;
                let own = over_rest(rest, self.weighted_norm(*x, lane) / n);
                own + (self.norm(out, lane) + own) * growth(tail(x))
            }
            Operation::Ln { x, inverse } => {
                // ln x_N = l_N + τ with x_N θτ = -[x_N θl_N].
                let bound = self.reciprocal(*inverse, *x, 0.0, lane);
                let own = bound * self.cross_weighted(*x, out, lane) / n;
                let share = above(bound * tail(x));
                own + over_rest(share, share)
            }
            Operation::Sin { x, cosine: other } | Operation::Cos { x, sine: other } => {
                let rest = self.cross_weighted(out, *x, lane);
                let rest = rest.max(self.cross_weighted(*other, *x, lane)) / n;
                let own = over_rest(rest, self.weighted_norm(*x, lane) / n);
                // |cos α - 1| and |sin α| are below e^|α| - 1.
                let moved = growth(tail(x));
                own + (self.norm(out, lane) + self.norm(*other, lane) + 2.0 * own) * moved
            }
            Operation::Atan { x, square, inverse } => {
                // atan x_N = y_N + τ with (1 + x_N²) θτ = -[(1 + x_N²) θy_N].
                let beyond = self.cross(*x, *x, lane);
                let bound = self.reciprocal(*inverse, *square, beyond, lane);
                let rest = self.cross_weighted(*square, out, lane)
                    + beyond * self.weighted_norm(out, lane);
                let own = bound * rest / n;
                let (norm, moved) = (self.norm(*x, lane), tail(x));
                let beyond = above(beyond + 2.0 * norm * moved + moved * moved);
                own + moved * self.reciprocal(*inverse, *square, beyond, lane)
            }
        };
        above(found)
    }

    fn tail_of_sum(&self, sum: &Sum, crosses: &[Lane], lane: usize) -> f64 {
        let tail = |row: &Row| self.tails[*row][lane];
        let mut total = 0.0;
        for (weight, x) in &sum.linear {
            total += weight.magnitude() * tail(x);
        }
        for ((weight, x, y), cross) in sum.products.iter().zip(crosses) {
            let (a, b) = (tail(x), tail(y));
            let moved = self.norm(*x, lane) * b + self.norm(*y, lane) * a + a * b;
            total += weight.magnitude() * (cross[lane] + moved);
        }
        total
    }

    /// Bounds ‖[x_N y_N]‖ of all products of sums, in order.
    fn crosses(&self) -> Vec<Vec<Lane>> {
        let of_sum = |sum: &Sum| {
            let products = sum.products.iter();
            let cross = |x, y| std::array::from_fn(|lane| self.cross(x, y, lane));
            products.map(|(_, x, y)| cross(*x, *y)).collect()
        };
        let operations = self.coefficients.plan.operations.iter();
        operations
            .map(|(_, operation)| match operation {
                Operation::Sum(sum) => of_sum(sum),
                _ => Vec::new(),
            })
            .collect()
    }

    /// Looks for tails that Picard's operator maps to themselves. Returns in which lanes.
    fn settle(&mut self, last: &[Lane]) -> [bool; LANES] {
        let plan = self.coefficients.plan;
        let crosses = self.crosses();
        for (row, last) in last.iter().enumerate() {
            self.tails[row] = last.map(|x| above(FIRST_SIZE * x));
        }
        let mut settled = [false; LANES];
        for _ in 0..ROUNDS {
            for ((out, operation), crosses) in plan.operations.iter().zip(&crosses) {
                for lane in (0..LANES).filter(|lane| !settled[*lane]) {
                    self.tails[*out][lane] = self.tail(*out, operation, crosses, lane);
                }
            }
            for lane in 0..LANES {
                if settled[lane] {
                    continue;
                }
                let next: Vec<f64> = (0..plan.dimension)
                    .map(|row| above(last[row][lane] + self.integrated(row, lane)))
                    .collect();
                let is_finite = |(row, operation): &(Row, Operation)| {
                    matches!(operation, Operation::Theta(_)) || self.tails[*row][lane].is_finite()
                };
                if !plan.operations.iter().all(is_finite) {
                    continue;
                }
                settled[lane] = next.iter().zip(&self.tails).all(|(new, old)| *new <= old[lane]);
                if !settled[lane] {
                    for (row, new) in next.iter().enumerate() {
                        let old = self.tails[row][lane];
                        self.tails[row][lane] = old.max(above(GROWTH * new));
                    }
                }
            }
            if settled == [true; LANES] {
                break;
            }
        }
        settled
    }

    /// Bounds the norm of ∫ of the tail of a component's rate.
    fn integrated(&self, component: usize, lane: usize) -> f64 {
        let rate = self.tails[self.coefficients.plan.rates[component]][lane];
        above(self.radius[lane] * rate / (self.order + 1) as f64)
    }
}

/// End of a step.
pub struct End {
    /// Enclosed state.
    pub state: Vec<Enclosure>,
    /// Bounds of what the polynomials of the components leave out.
    pub rest: Vec<f64>,
}

/// Encloses the states after the times `h` > 0, one in each lane. `None` in a lane where no tail is
/// found.
pub fn states(coefficients: &Coefficients<'_>, h: &Block) -> [Option<End>; LANES] {
    let (plan, order) = (coefficients.plan, coefficients.order);
    let mut tails = Tails::new(coefficients);
    let longest: Lane = std::array::from_fn(|lane| raised(h.mid[lane] + h.rad[lane], 1));
    tails.radius = longest.map(|h| FIRST * h);
    let settled = loop {
        tails.measure();
        let last: Vec<Lane> = (0..plan.dimension)
            .map(|row| {
                let last = coefficients.magnitudes(row)[order];
                let power = |lane: usize| (0..order).fold(1.0, |p, _| p * tails.radius[lane]);
                std::array::from_fn(|lane| above(last[lane] * power(lane)))
            })
            .collect();
        let settled = tails.settle(&last);
        let mut shrinks = false;
        for lane in 0..LANES {
            let next = tails.radius[lane] * SHRINK;
            if !settled[lane] && next >= LEAST * longest[lane] {
                tails.radius[lane] = next;
                shrinks = true;
            }
        }
        if !shrinks {
            break settled;
        }
    };
    let remainder = |row: usize, lane: usize| {
        let ratio = above(longest[lane] / tails.radius[lane]);
        above((0..=order).fold(tails.integrated(row, lane), |p, _| p * ratio))
    };
    let rests: Vec<Lane> =
        (0..plan.dimension).map(|row| std::array::from_fn(|lane| remainder(row, lane))).collect();
    let ends: Vec<Block> = rests
        .iter()
        .enumerate()
        .map(|(row, rest)| add(&coefficients.polynomial(row, h), &Balls::new([0.0; LANES], *rest)))
        .collect();
    std::array::from_fn(|lane| {
        let end = |block: &Block| Enclosure { mid: block.mid[lane], rad: block.rad[lane] };
        let state: Vec<Enclosure> = ends.iter().map(end).collect();
        let rest = rests.iter().map(|rest| rest[lane]).collect();
        (settled[lane] && state.iter().all(|x| x.is_finite())).then_some(End { state, rest })
    })
}
