//! Bounds of remainders in the norm ‖a‖ = Σ |a_k| ρ^k, for a given ρ.
//!
//! The rules are those of docs/closed-orbits.md. An unknown bound bounds nothing.

use super::number::ReplayNumber;
use super::series::{BallSeries, Weights};
use crate::taylor::form::Row;
use crate::validated::plan::RowRule;

/// Rounds in which tails may settle.
const ROUNDS: usize = 60;
/// Factor from one radius to the next, their largest number, and the ratio of the least to the step.
const SHRINK: f64 = 0.87;
const MOST_RADII: usize = 20;
const LEAST: f64 = 1.5;

/// Tails of an expansion.
struct ReplayedTails<'s, X> {
    order: usize,
    /// |a_k| ρ^k of each row, their sums from k on, and those of k |a_k| ρ^k.
    terms: Vec<Vec<X>>,
    sums: Vec<Vec<X>>,
    weighted: Vec<Vec<X>>,
    /// Bounds of the tails.
    tails: Vec<X>,
    series: &'s BallSeries<'s, 's, X>,
}

/// Encloses e^x - 1 from above for 0 ≤ x < 1.
fn growth<X: ReplayNumber>(x: &X) -> X {
    match x.is_below(&X::exact(1.0)) {
        true => x.add(&x.mul(x)),
        false => X::unknown(),
    }
}

/// Encloses a/(1 - x) for x < 1.
fn over_rest<X: ReplayNumber>(a: &X, x: &X) -> X {
    let rest = X::exact(1.0).minus(x);
    match rest.is_positive() {
        true => a.mul(&rest.recip()),
        false => X::unknown(),
    }
}

impl<X: ReplayNumber> ReplayedTails<'_, X> {
    fn norm(&self, row: Row) -> &X {
        &self.sums[row][0]
    }

    /// Bounds ‖[a_N b_N]‖, given the sums of b or those of θb.
    fn crossed(&self, a: Row, sums: &[X]) -> X {
        (1..self.order)
            .fold(X::zero(), |total, k| total.add(&self.terms[a][k].mul(&sums[self.order - k])))
    }

    fn cross(&self, a: Row, b: Row) -> X {
        self.crossed(a, &self.sums[b])
    }

    fn cross_weighted(&self, a: Row, b: Row) -> X {
        self.crossed(a, &self.weighted[b])
    }

    /// Bounds ‖1/b‖ for b with this tail, given the row of its reciprocal.
    fn reciprocal(&self, inverse: Row, b: Row, tail: &X) -> X {
        let norm = self.norm(inverse);
        over_rest(norm, &self.cross(inverse, b).add(&norm.mul(tail)))
    }

    fn of_sum(&self, sum: &Weights<X>, crosses: &[X]) -> X {
        let mut total = X::zero();
        for (weight, x) in &sum.linear {
            total = total.add(&weight.magnitude().mul(&self.tails[*x]));
        }
        for ((weight, x, y), cross) in sum.products.iter().zip(crosses) {
            let (a, b) = (&self.tails[*x], &self.tails[*y]);
            let moved = self.norm(*x).mul(b).add(&self.norm(*y).mul(a)).add(&a.mul(b));
            total = total.add(&weight.magnitude().mul(&cross.add(&moved)));
        }
        total
    }

    /// Bounds the tail of a row from those of its arguments.
    fn tail(&self, out: Row, operation: &RowRule) -> X {
        let share = X::exact(self.order as f64).recip();
        let tail = |row: &Row| &self.tails[*row];
        match operation {
            RowRule::Sum(_) | RowRule::Theta(_) => X::unknown(),
            RowRule::Near(..) => X::zero(),
            RowRule::Choice { near, close, far } => {
                tail(if self.series.is_near(*near) { close } else { far }).clone()
            }
            RowRule::Bounded { x, radius, bound } => {
                let size = self.norm(*x).add(tail(x));
                over_rest(&X::exact(*bound), &size.mul(&X::exact(*radius).recip()))
            }
            RowRule::Recip(x) => {
                let norm = self.norm(out);
                let defect = self.cross(out, *x).add(&norm.mul(tail(x)));
                over_rest(&defect.mul(norm), &defect)
            }
            RowRule::Power { x, inverse, exponent } => {
                let q = X::of(&exponent.exact).magnitude();
                let bound = self.reciprocal(*inverse, *x, &X::zero());
                let rest = q.mul(&self.cross_weighted(out, *x)).add(&self.cross_weighted(*x, out));
                let slope = q.mul(&bound).mul(&self.weighted[*x][0]).mul(&share);
                let own = over_rest(&bound.mul(&rest).mul(&share), &slope);
                let part = bound.mul(tail(x));
                let moved = growth(&over_rest(&q.mul(&part), &part));
                own.add(&self.norm(out).add(&own).mul(&moved))
            }
            RowRule::Exp(x) => {
                let rest = self.cross_weighted(out, *x).mul(&share);
                let own = over_rest(&rest, &self.weighted[*x][0].mul(&share));
                own.add(&self.norm(out).add(&own).mul(&growth(tail(x))))
            }
            RowRule::Ln { x, inverse } => {
                let bound = self.reciprocal(*inverse, *x, &X::zero());
                let own = bound.mul(&self.cross_weighted(*x, out)).mul(&share);
                let part = bound.mul(tail(x));
                own.add(&over_rest(&part, &part))
            }
            RowRule::Sin { x, cosine: other } | RowRule::Cos { x, sine: other } => {
                let both = self.cross_weighted(out, *x).larger(&self.cross_weighted(*other, *x));
                let own = over_rest(&both.mul(&share), &self.weighted[*x][0].mul(&share));
                let moved = growth(tail(x));
                let size = self.norm(out).add(self.norm(*other)).add(&own).add(&own);
                own.add(&size.mul(&moved))
            }
            RowRule::Atan { x, square, inverse } => {
                let beyond = self.cross(*x, *x);
                let bound = self.reciprocal(*inverse, *square, &beyond);
                let rest =
                    self.cross_weighted(*square, out).add(&beyond.mul(&self.weighted[out][0]));
                let own = bound.mul(&rest).mul(&share);
                let (norm, moved) = (self.norm(*x), tail(x));
                let twice = norm.mul(moved).mul(&X::exact(2.0));
                let beyond = beyond.add(&twice).add(&moved.mul(moved));
                own.add(&moved.mul(&self.reciprocal(*inverse, *square, &beyond)))
            }
        }
    }

    /// Computes the tails of all rows from those of the state.
    fn spread(&mut self, crosses: &[Vec<X>]) {
        let script = self.series.script;
        for (index, (out, operation)) in script.plan.operations.iter().enumerate() {
            self.tails[*out] = match operation {
                RowRule::Sum(_) => self.of_sum(&script.sums[index], &crosses[index]),
                _ => self.tail(*out, operation),
            };
        }
    }
}

/// Bounds the remainders of the components of the state after the time `h` ≥ 0, by tails that
/// Picard's operator maps to themselves, in the norm of the radius given or of a smaller one. `None`
/// where there are none.
pub fn remainders<X: ReplayNumber>(
    series: &BallSeries<'_, '_, X>,
    h: &X,
    radius: f64,
) -> Option<Vec<X>> {
    let least = LEAST * h.magnitude().mid();
    let radii = std::iter::successors(Some(radius), |radius| Some(radius * SHRINK));
    let mut radii = radii.take_while(|own| *own == radius || *own >= least).take(MOST_RADII);
    radii.find_map(|radius| settled(series, h, radius))
}

/// Bounds the remainders by tails in the norm of one radius.
pub(super) fn settled<X: ReplayNumber>(
    series: &BallSeries<'_, '_, X>,
    h: &X,
    radius: f64,
) -> Option<Vec<X>> {
    let script = series.script;
    let (plan, order) = (script.plan, script.order);
    let (h, rho) = (h.magnitude(), X::exact(radius));
    if !h.is_below(&rho) {
        return None;
    }
    let mut powers = vec![X::exact(1.0)];
    for k in 0..order {
        powers.push(powers[k].mul(&rho));
    }
    let term = |row: &Vec<X>, k: usize| row[k].magnitude().mul(&powers[k]);
    let terms: Vec<Vec<X>> =
        series.rows.iter().map(|row| (0..order).map(|k| term(row, k)).collect()).collect();
    let suffix = |row: &Vec<X>, weight: &dyn Fn(usize) -> f64| {
        let mut sums = vec![X::zero(); order + 1];
        for k in (0..order).rev() {
            sums[k] = sums[k + 1].add(&row[k].mul(&X::exact(weight(k))));
        }
        sums
    };
    let sums = terms.iter().map(|row| suffix(row, &|_| 1.0)).collect();
    let weighted = terms.iter().map(|row| suffix(row, &|k| k as f64)).collect();
    let last: Vec<X> = (0..plan.dimension).map(|row| term(&series.rows[row], order)).collect();
    let mut tails: Vec<X> = vec![X::zero(); plan.rows];
    for (tail, last) in tails.iter_mut().zip(&last) {
        *tail = last.mul(&X::exact(1.5));
    }
    let mut own = ReplayedTails { order, terms, sums, weighted, tails, series };
    let crosses: Vec<Vec<X>> = script
        .sums
        .iter()
        .map(|sum| sum.products.iter().map(|(_, x, y)| own.cross(*x, *y)).collect())
        .collect();
    let known = &own.sums[..plan.dimension];
    let largest = known.iter().fold(X::zero(), |largest, row| largest.larger(&row[0]));
    let limit = largest.add(&X::exact(1.0));
    let share = rho.mul(&X::exact(order as f64 + 1.0).recip());
    for _ in 0..ROUNDS {
        own.spread(&crosses);
        let integrated: Vec<X> =
            plan.rates.iter().map(|rate| share.mul(&own.tails[*rate])).collect();
        let next: Vec<X> = last.iter().zip(&integrated).map(|(a, b)| a.add(b)).collect();
        if !next.iter().all(X::is_known) {
            return None;
        }
        let holds = |(new, old): (&X, &X)| new.is_below(old) || new.is_zero();
        let is_defined = |(row, operation): &(Row, RowRule)| {
            matches!(operation, RowRule::Theta(_)) || own.tails[*row].is_known()
        };
        if next.iter().zip(&own.tails).all(holds) && plan.operations.iter().all(is_defined) {
            let ratio = h.mul(&rho.recip());
            let power = (0..=order).fold(X::exact(1.0), |p, _| p.mul(&ratio));
            return Some(integrated.iter().map(|bound| bound.mul(&power)).collect());
        }
        for (tail, new) in own.tails.iter_mut().zip(&next) {
            *tail = tail.larger(&new.mul(&X::exact(1.1)));
        }
        // Tails above all that is known of the state lead nowhere.
        if !own.tails[..plan.dimension].iter().all(|tail| tail.is_below(&limit)) {
            return None;
        }
    }
    None
}
