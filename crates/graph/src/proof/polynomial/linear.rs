//! Rational zeros of polynomials in one variable.

use num_integer::Integer;

use crate::number::rational::Rational;

use super::{MOST_WORK, Polynomial};

/// Largest outer coefficient whose divisors are tried.
const LARGEST: i64 = 1_000_000;
/// Largest degree.
const MOST_DEGREE: u32 = 32;

impl Polynomial {
    /// Divides a polynomial in one variable by those of its factors that are linear over ℚ; what is
    /// left is the last factor, unless it is a number. Others are returned as they are.
    pub fn linear_factors(&self) -> Vec<Self> {
        let [variable] = self.variables()[..] else { return vec![self.clone()] };
        let Some(coefficients) = self.whole_coefficients(variable) else {
            return vec![self.clone()];
        };
        let (mut rest, mut factors) = (self.clone(), Vec::new());
        for (above, below) in zeros(&coefficients) {
            let slope = Self::variable(variable).scaled(&Rational::from(below));
            let factor = slope.plus(&Self::constant(&Rational::from(-above)));
            if let Some(quotient) = rest.over(&factor, &mut { MOST_WORK }) {
                rest = quotient;
                factors.push(factor);
            }
        }
        if rest.number().is_none() {
            factors.push(rest);
        }
        factors
    }

    /// Returns the coefficients of a multiple with whole ones, the constant term first.
    fn whole_coefficients(&self, variable: u32) -> Option<Vec<i64>> {
        let powers = self.by_powers(variable);
        let degree = powers.last()?.0;
        if degree > MOST_DEGREE {
            return None;
        }
        let parts = powers.iter().map(|(power, own)| Some((*power, own.number()?.small_parts()?)));
        let parts = parts.collect::<Option<Vec<(u32, (i64, i64))>>>()?;
        let common = parts.iter().try_fold(1i64, |common, (_, (_, below))| {
            let common = i128::from(common).lcm(&i128::from(*below));
            i64::try_from(common).ok()
        })?;
        let mut all = vec![0i64; degree as usize + 1];
        for (power, (above, below)) in parts {
            *all.get_mut(power as usize)? = above.checked_mul(common / below)?;
        }
        Some(all)
    }
}

/// Lists the rational zeros p/q, q > 0, of a polynomial with whole coefficients: p divides the first of
/// them that is not 0, and q the last. Those with large outer coefficients are passed over.
fn zeros(coefficients: &[i64]) -> Vec<(i64, i64)> {
    let lowest = coefficients.iter().position(|own| *own != 0);
    let (Some(lowest), Some(last)) = (lowest, coefficients.last()) else { return Vec::new() };
    let mut found = Vec::new();
    if lowest > 0 {
        found.push((0, 1));
    }
    let first = coefficients[lowest].unsigned_abs();
    let last = last.unsigned_abs();
    if first.max(last) > LARGEST.unsigned_abs() {
        return found;
    }
    let (above, below) = (divisors(first), divisors(last));
    for (p, q) in above.iter().flat_map(|p| below.iter().map(move |q| (*p, *q))) {
        if p.gcd(&q) != 1 {
            continue;
        }
        found.extend([p, -p].into_iter().filter(|p| is_zero(coefficients, *p, q)).map(|p| (p, q)));
    }
    found
}

/// Whether Σ c_k p^k q^(n − k) is known to be 0.
fn is_zero(coefficients: &[i64], p: i64, q: i64) -> bool {
    let (p, q) = (i128::from(p), i128::from(q));
    let mut power = 1i128;
    let sum = coefficients.iter().rev().try_fold(0i128, |sum, own| {
        let term = i128::from(*own).checked_mul(power)?;
        power = power.checked_mul(q)?;
        sum.checked_mul(p)?.checked_add(term)
    });
    sum == Some(0)
}

fn divisors(number: u64) -> Vec<i64> {
    let divides = |own: &i64| number.is_multiple_of(own.unsigned_abs());
    let small: Vec<i64> = (1..=1000)
        .take_while(|own: &i64| own.unsigned_abs().pow(2) <= number)
        .filter(divides)
        .collect();
    let large = small.iter().filter_map(|own| i64::try_from(number / own.unsigned_abs()).ok());
    let mut all: Vec<i64> = small.iter().copied().chain(large).collect();
    all.sort_unstable();
    all.dedup();
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rational_zeros_are_found() {
        assert_eq!(zeros(&[-6, 1, 1]), [(2, 1), (-3, 1)], "(x − 2)(x + 3)");
        assert_eq!(zeros(&[1, 0, 1]), [], "x² + 1");
        assert_eq!(zeros(&[-2, 0, 1]), [], "x² − 2");
        assert_eq!(zeros(&[0, 0, -3, 7]), [(0, 1), (3, 7)], "7x³ − 3x²");
        // (2x − 1)(3x + 2)(x² + x + 1)
        assert_eq!(zeros(&[-2, -1, 5, 7, 6]), [(1, 2), (-2, 3)]);
        assert_eq!(zeros(&[1_000_003, 1]), [], "too large");
    }

    #[test]
    fn divisors_are_complete() {
        assert_eq!(divisors(36), [1, 2, 3, 4, 6, 9, 12, 18, 36]);
        assert_eq!(divisors(1), [1]);
        assert_eq!(divisors(999_983), [1, 999_983], "a prime");
        assert_eq!(divisors(1_000_000).len(), 49);
    }
}
