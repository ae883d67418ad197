//! Bounds of the remainder of a Taylor polynomial, in the norm ‖a‖ = Σ |a_k| ρ^k.
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

#![allow(clippy::needless_range_loop, reason = "loops over lanes become vectors")]

mod crosses;

use super::coefficients::{BOXES, Block, Coefficients, Lane, add};
use super::enclosure::{Enclosure, raised};
use super::plan::{EnclosedSum, RowRule};
use crate::taylor::form::Row;
use liouville::graph::{Kernel, with_widest_vectors};
use liouville::number::ball::Balls;

/// Factor that covers the rounding of any bound here, a sum of at most 10⁴ non-negative terms.
const ALLOWANCE: f64 = 1.0 + 1e-11;
/// Ratio of the first radius tried to the step, and of the least.
pub const FIRST: f64 = 9.0;
const LEAST: f64 = 1.5;
/// Factor by which the radius shrinks where it was too large.
const SHRINK: f64 = 0.87;
/// Number of rounds for tails to settle.
const ROUNDS: usize = 40;
/// Growth of tails from round to round, and their first size against the last coefficient.
const GROWTH: f64 = 1.1;
const FIRST_SIZE: f64 = 1.5;
/// Factor above the radius found last at which the next search begins.
const HOPE: f64 = 1.2;

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
    /// Bounds of ‖a_N‖, row by row.
    norms: Vec<Lane>,
    tails: Vec<Lane>,
}

impl<'c, 'p> Tails<'c, 'p> {
    fn new(coefficients: &'c Coefficients<'p>) -> Self {
        let order = coefficients.order;
        let zeros = vec![[0.0; BOXES]; coefficients.plan.rows * (order + 1)];
        Self {
            coefficients,
            order,
            radius: [0.0; BOXES],
            terms: zeros.clone(),
            sums: zeros.clone(),
            weighted_sums: zeros,
            norms: vec![[0.0; BOXES]; coefficients.plan.rows],
            tails: vec![[0.0; BOXES]; coefficients.plan.rows],
        }
    }

    /// Computes the norms of all rows for the present radii.
    #[inline(always)]
    fn measure(&mut self) {
        let (order, stride) = (self.order, self.order + 1);
        let mut powers = vec![[1.0; BOXES]; order];
        for k in 1..order {
            for lane in 0..BOXES {
                powers[k][lane] = powers[k - 1][lane] * self.radius[lane];
            }
        }
        for row in 0..self.coefficients.plan.rows {
            let place = row * stride;
            let magnitudes = self.coefficients.magnitudes(row);
            for k in (0..order).rev() {
                for lane in 0..BOXES {
                    let term = above(magnitudes[k][lane] * powers[k][lane]);
                    self.terms[place + k][lane] = term;
                    self.sums[place + k][lane] = self.sums[place + k + 1][lane] + term;
                    self.weighted_sums[place + k][lane] =
                        self.weighted_sums[place + k + 1][lane] + k as f64 * term;
                }
            }
            self.norms[row] = self.sums[place].map(above);
        }
    }

    /// Bounds ‖a_N‖.
    fn norm(&self, row: Row, lane: usize) -> f64 {
        self.norms[row][lane]
    }

    /// Bounds ‖θa_N‖.
    fn weighted_norm(&self, row: Row, lane: usize) -> f64 {
        above(self.weighted_sums[row * (self.order + 1)][lane])
    }

    /// Bounds ‖1/b‖ for b with this tail, given the row of its reciprocal and ‖[q_N b_N]‖.
    fn reciprocal(&self, inverse: Row, cross: f64, tail: f64, lane: usize) -> f64 {
        let norm = self.norm(inverse, lane);
        over_rest(norm, cross + norm * tail)
    }

    /// Bounds the tail of a row from those of its arguments; `crosses` are those of the operation.
    fn tail(&self, out: Row, operation: &RowRule, crosses: &[Lane], lane: usize) -> f64 {
        let n = self.order as f64;
        let cross = |number: usize| crosses[number][lane];
        let tail = |row: &Row| self.tails[*row][lane];
        let found = match operation {
            // Sums have their own rule; a derivative is read by rules that do without its tail.
            RowRule::Sum(_) | RowRule::Theta(_) => f64::INFINITY,
            RowRule::Near(..) => 0.0,
            RowRule::Choice { near, close, far } => {
                tail(if self.coefficients.is_near(*near, lane) { close } else { far })
            }
            // All of Σ a_k x^k is at most this.
            RowRule::Bounded { x, radius, bound } => {
                over_rest(*bound, (self.norm(*x, lane) + tail(x)) / radius)
            }
            RowRule::Recip(x) => {
                let norm = self.norm(out, lane);
                let defect = above(cross(0) + norm * tail(x));
                over_rest(defect * norm, defect)
            }
            RowRule::Power { x, inverse, exponent } => {
                let q = exponent.value.magnitude();
                // x_N^q = z_N + τ with x_N θτ = q τ θx_N + [q z_N θx_N - x_N θz_N].
                let bound = self.reciprocal(*inverse, cross(0), 0.0, lane);
                let rest = q * cross(1) + cross(2);
                let slope = q * bound * self.weighted_norm(*x, lane) / n;
                let own = over_rest(bound * rest / n, slope);
                // (1 + w)^q - 1 has the majorant (1 - w)^(-|q|) - 1 ≤ e^(|q| w/(1 - w)) - 1.
                let share = above(bound * tail(x));
                let moved = growth(over_rest(q * share, share));
                own + (self.norm(out, lane) + own) * moved
            }
            RowRule::Exp(x) => {
                let rest = cross(0) / n;
                let own = over_rest(rest, self.weighted_norm(*x, lane) / n);
                own + (self.norm(out, lane) + own) * growth(tail(x))
            }
            RowRule::Ln { x, inverse } => {
                // ln x_N = l_N + τ with x_N θτ = -[x_N θl_N].
                let bound = self.reciprocal(*inverse, cross(0), 0.0, lane);
                let own = bound * cross(1) / n;
                let share = above(bound * tail(x));
                own + over_rest(share, share)
            }
            RowRule::Sin { x, cosine: other } | RowRule::Cos { x, sine: other } => {
                let rest = cross(0).max(cross(1)) / n;
                let own = over_rest(rest, self.weighted_norm(*x, lane) / n);
                // |cos α - 1| and |sin α| are below e^|α| - 1.
                let moved = growth(tail(x));
                own + (self.norm(out, lane) + self.norm(*other, lane) + 2.0 * own) * moved
            }
            RowRule::Atan { x, inverse, .. } => {
                // atan x_N = y_N + τ with (1 + x_N²) θτ = -[(1 + x_N²) θy_N].
                let beyond = cross(0);
                let bound = self.reciprocal(*inverse, cross(1), beyond, lane);
                let rest = cross(2) + beyond * self.weighted_norm(out, lane);
                let own = bound * rest / n;
                let (norm, moved) = (self.norm(*x, lane), tail(x));
                let beyond = above(beyond + 2.0 * norm * moved + moved * moved);
                own + moved * self.reciprocal(*inverse, cross(1), beyond, lane)
            }
        };
        above(found)
    }

    #[inline(always)]
    fn tail_of_sum(&self, sum: &EnclosedSum, crosses: &[Lane]) -> Lane {
        let mut total = [0.0; BOXES];
        for (weight, x) in &sum.linear {
            let (weight, tail) = (weight.magnitude(), &self.tails[*x]);
            for lane in 0..BOXES {
                total[lane] += weight * tail[lane];
            }
        }
        for ((weight, x, y), cross) in sum.products.iter().zip(crosses) {
            let weight = weight.magnitude();
            let (a, b) = (&self.tails[*x], &self.tails[*y]);
            let (norm, other) = (&self.norms[*x], &self.norms[*y]);
            for lane in 0..BOXES {
                let moved = norm[lane] * b[lane] + other[lane] * a[lane] + a[lane] * b[lane];
                total[lane] += weight * (cross[lane] + moved);
            }
        }
        total.map(above)
    }

    /// Computes the tails of all rows from those of the state.
    #[inline(always)]
    fn spread(&mut self, crosses: &[Lane]) {
        let mut rest = crosses;
        for (out, operation) in &self.coefficients.plan.operations {
            let (own, others) = rest.split_at(Self::cross_count(operation));
            rest = others;
            self.tails[*out] = match operation {
                RowRule::Sum(sum) => self.tail_of_sum(sum, own),
                _ => std::array::from_fn(|lane| self.tail(*out, operation, own, lane)),
            };
        }
    }

    /// Looks for tails that Picard's operator maps to themselves, for the present radii. Returns in
    /// which lanes; there the tails of all rows belong to those of the state.
    #[inline(always)]
    fn settle(&mut self) -> [bool; BOXES] {
        self.measure();
        let (plan, order) = (self.coefficients.plan, self.order);
        let last: Vec<Lane> = (0..plan.dimension)
            .map(|row| {
                let last = self.coefficients.magnitudes(row)[order];
                let power = |lane: usize| (0..order).fold(1.0, |p, _| p * self.radius[lane]);
                std::array::from_fn(|lane| above(last[lane] * power(lane)))
            })
            .collect();
        let crosses = self.crosses();
        for (row, last) in last.iter().enumerate() {
            self.tails[row] = last.map(|x| above(FIRST_SIZE * x));
        }
        let largest = |tails: &[Lane], lane: usize| {
            tails[..plan.dimension].iter().fold(0.0, |a: f64, tail| a.max(tail[lane]))
        };
        // A tail above all that is known of the state is useless.
        let known = &self.norms[..plan.dimension];
        let limit: Lane = std::array::from_fn(|lane| 1.0 + largest(known, lane));
        let (mut settled, mut hopeless) = ([false; BOXES], [false; BOXES]);
        for _ in 0..ROUNDS {
            // Where the state's tails are settled this changes nothing.
            self.spread(&crosses);
            for lane in 0..BOXES {
                if settled[lane] || hopeless[lane] {
                    continue;
                }
                let is_finite = |(row, operation): &(Row, RowRule)| {
                    matches!(operation, RowRule::Theta(_)) || self.tails[*row][lane].is_finite()
                };
                if !plan.operations.iter().all(is_finite) {
                    hopeless[lane] = true;
                    continue;
                }
                let next = |row: usize| above(last[row][lane] + self.integrated(row, lane));
                let next: Vec<f64> = (0..plan.dimension).map(next).collect();
                settled[lane] = next.iter().zip(&self.tails).all(|(new, old)| *new <= old[lane]);
                if settled[lane] {
                    continue;
                }
                for (row, new) in next.iter().enumerate() {
                    let old = self.tails[row][lane];
                    self.tails[row][lane] = old.max(above(GROWTH * new));
                }
                let is_near = largest(&self.tails, lane) <= limit[lane];
                hopeless[lane] = !is_near;
            }
            if (0..BOXES).all(|lane| settled[lane] || hopeless[lane]) {
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
    /// Bounds of the remainders of the polynomials of the components.
    pub rest: Vec<f64>,
    /// Radius ρ of the norm.
    pub radius: f64,
}

/// Work of settling tails, and the lanes where they are.
struct Settling<'t, 'c, 'p>(&'t mut Tails<'c, 'p>, &'t mut [bool; BOXES]);

impl Kernel for Settling<'_, '_, '_> {
    #[inline(always)]
    fn run(self) {
        *self.1 = self.0.settle();
    }
}

/// Encloses the states after the times `h` > 0, one in each lane. `None` in a lane where no tail is
/// found. `hope` is the ratio of radii to steps at which the search begins, and becomes that of the
/// next.
pub fn states(coefficients: &Coefficients<'_>, h: &Block, hope: &mut f64) -> [Option<End>; BOXES] {
    let (plan, order) = (coefficients.plan, coefficients.order);
    let mut tails = Tails::new(coefficients);
    let longest: Lane = std::array::from_fn(|lane| raised(h.mid[lane] + h.rad[lane], 1));
    tails.radius = longest.map(|h| hope.min(FIRST) * h);
    let mut settled = [false; BOXES];
    loop {
        with_widest_vectors(Settling(&mut tails, &mut settled));
        let mut shrinks = false;
        for lane in 0..BOXES {
            let next = tails.radius[lane] * SHRINK;
            if !settled[lane] && next >= LEAST * longest[lane] {
                tails.radius[lane] = next;
                shrinks = true;
            }
        }
        if !shrinks {
            break;
        }
    }
    let ratios = tails.radius.iter().zip(&longest).map(|(radius, h)| radius / h);
    *hope = HOPE * ratios.fold(LEAST, f64::max);
    let remainder = |row: usize, lane: usize| {
        let ratio = above(longest[lane] / tails.radius[lane]);
        above((0..=order).fold(tails.integrated(row, lane), |p, _| p * ratio))
    };
    let rests: Vec<Lane> =
        (0..plan.dimension).map(|row| std::array::from_fn(|lane| remainder(row, lane))).collect();
    let ends: Vec<Block> = rests
        .iter()
        .enumerate()
        .map(|(row, rest)| add(&coefficients.polynomial(row, h), &Balls::new([0.0; BOXES], *rest)))
        .collect();
    std::array::from_fn(|lane| {
        let end = |block: &Block| Enclosure { mid: block.mid[lane], rad: block.rad[lane] };
        let state: Vec<Enclosure> = ends.iter().map(end).collect();
        let rest = rests.iter().map(|rest| rest[lane]).collect();
        let radius = tails.radius[lane];
        (settled[lane] && state.iter().all(|x| x.is_finite())).then_some(End {
            state,
            rest,
            radius,
        })
    })
}
