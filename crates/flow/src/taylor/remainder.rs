//! Bounds of what a series of a germ leaves out, in the norms ‖a‖ = Σ |a_k| R^k of several radii R.
//!
//! With a = a_N + α, b = b_N + β and [·] the part of order ≥ N:
//!
//! ```text
//! a b      α' = [a_N b_N] + a_N β + b_N α + α β
//! q = 1/b  1 - q_N b = -[q_N b_N] - q_N β, of norm E:  ‖1/b - q_N‖ ≤ E ‖q_N‖/(1 - E)
//! e^a      e^(a_N) = e_N + τ, N ‖τ‖ ≤ ‖τ‖ ‖θa_N‖ + ‖[e_N θa_N]‖;  e^a = e^(a_N) e^α
//! ```
//!
//! and in the same way for ln, sin and cos, as for the tails of steps that are proved.

use crate::taylor::germ::LENGTH;
use liouville::number::rational::Rational;

/// Number of radii, and the binary exponent of the first.
pub(super) const RADII: usize = 13;
const FIRST: i32 = -6;
/// Factor that covers the rounding of a bound, a sum of few non-negative terms.
const ALLOWANCE: f64 = 1.0 + 1e-11;

/// Bounds, one for each radius.
pub(super) type Rest = [f64; RADII];

/// Radius of this index.
pub(super) fn radius(index: usize) -> f64 {
    libm::ldexp(1.0, FIRST + index as i32)
}

/// Bounds a number computed by few operations on non-negative numbers.
pub(super) fn above(x: f64) -> f64 {
    x * ALLOWANCE + f64::MIN_POSITIVE
}

/// Bounds numbers that belong to the radii.
pub(super) fn bounds(of: impl Fn(usize) -> f64) -> Rest {
    std::array::from_fn(|index| above(of(index)))
}

/// Bounds a/(1 - x), infinite where x is not below 1.
fn over_rest(a: f64, x: f64) -> f64 {
    let rest = 1.0 - above(x);
    if rest > 0.0 { a / rest } else { f64::INFINITY }
}

/// Bounds e^x - 1 for 0 ≤ x < 1.
fn growth(x: f64) -> f64 {
    if x < 1.0 { x + x * x } else { f64::INFINITY }
}

/// The terms |a_k| R^k of a polynomial, and their sums from k on.
struct Terms {
    terms: [f64; LENGTH],
    sums: [f64; LENGTH + 1],
}

impl Terms {
    fn new(sizes: &[f64], index: usize) -> Self {
        let mut own = Self { terms: [0.0; LENGTH], sums: [0.0; LENGTH + 1] };
        let (radius, mut power) = (radius(index), 1.0);
        for (k, size) in sizes.iter().enumerate() {
            own.terms[k] = above(size * power);
            // a power of two, and exact
            power *= radius;
        }
        for k in (0..LENGTH).rev() {
            own.sums[k] = own.sums[k + 1] + own.terms[k];
        }
        own
    }

    fn norm(&self) -> f64 {
        above(self.sums[0])
    }

    /// Bounds ‖[a b]‖.
    fn crossed(&self, other: &Self) -> f64 {
        above((1..LENGTH).map(|k| self.terms[k] * other.sums[LENGTH - k]).sum())
    }
}

/// Bounds of the magnitudes of coefficients, and of k times these.
fn sizes(series: &[Rational]) -> Vec<f64> {
    series.iter().map(|x| above(x.to_f64().0.abs())).collect()
}

fn weighted(series: &[Rational]) -> Vec<f64> {
    sizes(series).iter().enumerate().map(|(k, x)| k as f64 * x).collect()
}

/// Bounds the norm of a polynomial from an order on.
pub(super) fn norm_from(series: &[Rational], first: usize) -> Rest {
    let mut sizes = sizes(series);
    sizes[..first].fill(0.0);
    bounds(|index| Terms::new(&sizes, index).norm())
}

/// Bounds what is left out of a product.
pub(super) fn of_product(a: (&[Rational], &Rest), b: (&[Rational], &Rest)) -> Rest {
    let (x, y) = (sizes(a.0), sizes(b.0));
    bounds(|index| {
        let (alpha, beta) = (a.1[index], b.1[index]);
        let [x, y] = [&x, &y].map(|own| Terms::new(own, index));
        x.crossed(&y) + x.norm() * beta + y.norm() * alpha + alpha * beta
    })
}

/// Bounds what is left out of 1/b.
pub(super) fn of_reciprocal(own: &[Rational], b: (&[Rational], &Rest)) -> Rest {
    let (q, y) = (sizes(own), sizes(b.0));
    bounds(|index| {
        let [q, y] = [&q, &y].map(|own| Terms::new(own, index));
        let defect = q.crossed(&y) + q.norm() * b.1[index];
        over_rest(defect * q.norm(), defect)
    })
}

/// Bounds what is left out of a function z of a with θz = θa w, w the same function or, of a sine or
/// cosine, the other one.
pub(super) fn of_exponential(both: [&[Rational]; 2], a: (&[Rational], &Rest)) -> Rest {
    let (all, slopes) = (both.map(sizes), weighted(a.0));
    bounds(|index| {
        let slopes = Terms::new(&slopes, index);
        let all = all.each_ref().map(|own| Terms::new(own, index));
        let rest = all[0].crossed(&slopes).max(all[1].crossed(&slopes)) / LENGTH as f64;
        let own = over_rest(rest, slopes.norm() / LENGTH as f64);
        // |cos α - 1| and |sin α| are below e^|α| - 1
        own + (all[0].norm() + all[1].norm() + 2.0 * own) * growth(a.1[index])
    })
}

/// Bounds what is left out of ln a, with the series of 1/a and what that leaves out.
pub(super) fn of_logarithm(
    own: &[Rational],
    inverse: (&[Rational], &Rest),
    a: (&[Rational], &Rest),
) -> Rest {
    let (slopes, x) = (weighted(own), sizes(a.0));
    let q = sizes(inverse.0);
    bounds(|index| {
        let [slopes, x] = [&slopes, &x].map(|own| Terms::new(own, index));
        // 1/a_N is bounded by the same defect as 1/a, without α
        let q = Terms::new(&q, index);
        let bound = over_rest(q.norm(), q.crossed(&x));
        let share = bound * a.1[index];
        bound * x.crossed(&slopes) / LENGTH as f64 + over_rest(share, share)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_out_of_an_exponential_is_held() {
        let mut series = vec![Rational::from(1)];
        (1..LENGTH).for_each(|k| series.push(&series[k - 1] * &Rational::new(1, k as i64)));
        let mut v = vec![Rational::from(0); LENGTH];
        v[1] = Rational::from(1);
        let found = of_exponential([&series, &series], (&v, &[0.0; RADII]));
        for (index, found) in found.iter().enumerate() {
            // the first term left out, and e^R of it
            let radius = radius(index);
            let first = (1..=LENGTH).fold(1.0, |term, k| term * radius / k as f64);
            assert!(*found >= first || !found.is_finite(), "{radius}: {found} < {first}");
            assert!(radius > 8.0 || *found < 4.0 * first + 1e-300, "{radius}: {found} > {first}");
        }
    }

    #[test]
    fn a_reciprocal_is_bounded_up_to_its_pole_alone() {
        // 1/(1 - v) has the rest R^N/(1 - R)
        let ones = vec![Rational::from(1); LENGTH];
        let mut b = vec![Rational::from(0); LENGTH];
        (b[0], b[1]) = (Rational::from(1), Rational::from(-1));
        let found = of_reciprocal(&ones, (&b, &[0.0; RADII]));
        for (index, found) in found.iter().enumerate() {
            let radius = radius(index);
            let truth = libm::pow(radius, LENGTH as f64) / (1.0 - radius);
            match radius < 1.0 {
                true => {
                    assert!(*found >= truth && *found < 2.0 * truth + 1e-300, "{found} {truth}")
                }
                false => assert!(found.is_infinite(), "{radius}: {found}"),
            }
        }
    }
}
