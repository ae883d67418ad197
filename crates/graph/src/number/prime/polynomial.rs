//! Polynomials in one variable modulo a prime: common factors, interpolation by fractions, roots.
//!
//! Products and divisions are quadratic in the degree, and sums of products are reduced as late as they
//! can be. What may take long has a form that asks a caller between its steps whether to go on.

use std::convert::Infallible;

use super::Modulus;

/// Coefficients as residues from low to high degree; the last one is not 0.
pub type Polynomial = Vec<u64>;

/// Number of points at which a fraction is checked: a false one survives each with probability d/p.
pub const CHECKS: usize = 3;

/// The polynomial ring F_p\[x\].
#[derive(Clone, Copy, Debug)]
pub struct PrimePolynomials(pub Modulus);

/// The answer of a computation that nothing interrupts.
fn whole<T>(answer: Result<T, Infallible>) -> T {
    match answer {
        Ok(value) => value,
        Err(never) => match never {},
    }
}

impl PrimePolynomials {
    /// Removes leading zeros.
    pub fn trimmed(mut a: Polynomial) -> Polynomial {
        while a.last() == Some(&0) {
            a.pop();
        }
        a
    }

    /// Evaluates a(x).
    pub fn evaluate(&self, a: &[u64], x: u64) -> u64 {
        a.iter().rev().fold(0, |sum, c| self.0.add(self.0.mul(sum, x), *c))
    }

    /// Computes a b.
    pub fn product(&self, a: &[u64], b: &[u64]) -> Polynomial {
        if a.is_empty() || b.is_empty() {
            return Vec::new();
        }
        let coefficient = |k: usize| {
            // a_j b_(k−j) for all j within both.
            let (first, last) = ((k + 1).saturating_sub(b.len()), k.min(a.len() - 1));
            self.0.convolved(&a[first..=last], &b[k - last..=k - first])
        };
        Self::trimmed((0..a.len() + b.len() - 1).map(coefficient).collect())
    }

    /// Computes a − b.
    pub fn difference(&self, a: &[u64], b: &[u64]) -> Polynomial {
        let at = |a: &[u64], i: usize| a.get(i).copied().unwrap_or(0);
        Self::trimmed((0..a.len().max(b.len())).map(|i| self.0.sub(at(a, i), at(b, i))).collect())
    }

    /// Divides a by b ≠ 0, whose last coefficient is not 0; returns quotient and remainder.
    pub fn divided(&self, a: &[u64], b: &[u64]) -> (Polynomial, Polynomial) {
        let m = &self.0;
        let Some((lead, lower)) = b.split_last() else { return (Vec::new(), a.to_vec()) };
        let low = lower.len();
        let inverse = if *lead == m.one() { m.one() } else { m.inverse(*lead) };
        let mut quotient = vec![0; a.len().saturating_sub(low)];
        // Sums of products, which are reduced when they are needed, or when a further one might not fit.
        let mut rest: Vec<u128> = a.iter().map(|entry| m.widened(*entry)).collect();
        let mut pending = 0;
        for place in (low..rest.len()).rev() {
            let factor = m.mul(m.reduced(rest[place]), inverse);
            if factor == 0 {
                continue;
            }
            quotient[place - low] = factor;
            if pending == m.most_products() {
                rest[..place].iter_mut().for_each(|sum| *sum = m.widened(m.reduced(*sum)));
                pending = 0;
            }
            pending += 1;
            let minus = u128::from(m.sub(0, factor));
            for (sum, entry) in rest[place - low..place].iter_mut().zip(lower) {
                *sum = sum.wrapping_add(minus.wrapping_mul(u128::from(*entry)));
            }
        }
        rest.truncate(low);
        let rest = rest.into_iter().map(|sum| m.reduced(sum)).collect();
        (Self::trimmed(quotient), Self::trimmed(rest))
    }

    /// Divides by the leading coefficient.
    pub fn monic(&self, a: &[u64]) -> Polynomial {
        let inverse = a.last().map_or(0, |lead| self.0.inverse(*lead));
        a.iter().map(|c| self.0.mul(*c, inverse)).collect()
    }

    /// Computes the monic greatest common divisor; 0 if both are 0.
    pub fn common(&self, a: &[u64], b: &[u64]) -> Polynomial {
        whole(self.common_unless(a, b, &mut || Ok(())))
    }

    /// Same as `common`, between whose divisions `check` may fail.
    pub fn common_unless<E>(
        &self,
        a: &[u64],
        b: &[u64],
        check: &mut impl FnMut() -> Result<(), E>,
    ) -> Result<Polynomial, E> {
        let (mut a, mut b) = (a.to_vec(), b.to_vec());
        while !b.is_empty() {
            check()?;
            let rest = self.divided(&a, &b).1;
            (a, b) = (b, rest);
        }
        Ok(self.monic(&a))
    }

    /// Removes all common factors with b from a ≠ 0; between divisions `check` may fail.
    pub fn without_unless<E>(
        &self,
        a: &[u64],
        b: &[u64],
        check: &mut impl FnMut() -> Result<(), E>,
    ) -> Result<Polynomial, E> {
        let mut a = a.to_vec();
        loop {
            let common = self.common_unless(&a, b, check)?;
            if common.len() < 2 {
                return Ok(a);
            }
            a = self.divided(&a, &common).0;
        }
    }

    /// Removes repeated factors.
    pub fn square_free(&self, a: &[u64]) -> Polynomial {
        let slope = |(k, c): (usize, &u64)| self.0.mul(self.0.integer(k as u64), *c);
        let slopes = a.iter().enumerate().skip(1).map(slope).collect();
        let repeated = self.common(a, &Self::trimmed(slopes));
        if repeated.len() < 2 { a.to_vec() } else { self.divided(a, &repeated).0 }
    }

    /// Finds the polynomial with given values at 0, 1, 2, …; between orders `check` may fail.
    pub fn interpolated_unless<E>(
        &self,
        values: &[u64],
        check: &mut impl FnMut() -> Result<(), E>,
    ) -> Result<Polynomial, E> {
        let (m, count) = (&self.0, values.len());
        let numbers: Vec<u64> = (0..count as u64).map(|k| m.integer(k)).collect();
        let inverses = m.inverses_up_to(count);
        // Newton's divided differences in place.
        let mut slopes = values.to_vec();
        for (level, inverse) in inverses[..count].iter().enumerate().skip(1) {
            check()?;
            for k in (level..count).rev() {
                slopes[k] = m.mul(m.sub(slopes[k], slopes[k - 1]), *inverse);
            }
        }
        let mut found: Polynomial = Vec::with_capacity(count);
        for k in (0..count).rev() {
            check()?;
            // f ← f (x − k) + slope
            let mut carried = slopes[k];
            for entry in &mut found {
                carried = m.sub(carried, m.mul(numbers[k], *entry));
                std::mem::swap(entry, &mut carried);
            }
            found.push(carried);
        }
        Ok(Self::trimmed(found))
    }

    /// Finds the polynomial through some points, and the product of x - x_i.
    pub fn through(&self, points: &[(u64, u64)]) -> (Polynomial, Polynomial) {
        let mut found: Polynomial = Vec::new();
        let mut node = vec![self.0.one()];
        for (x, y) in points {
            let missing = self.0.sub(*y, self.evaluate(&found, *x));
            let factor = self.0.mul(missing, self.0.inverse(self.evaluate(&node, *x)));
            let minus = self.0.sub(0, factor);
            let correction: Polynomial = node.iter().map(|c| self.0.mul(*c, minus)).collect();
            found = self.difference(&found, &correction);
            node = self.product(&node, &[self.0.sub(0, *x), self.0.one()]);
        }
        (found, node)
    }

    /// Finds the polynomial with these values, if the last points confirm it.
    pub fn polynomial(&self, points: &[(u64, u64)]) -> Option<Polynomial> {
        let (given, checks) = points.split_at(points.len().checked_sub(CHECKS)?);
        let (found, _) = self.through(given);
        checks.iter().all(|(x, y)| self.evaluate(&found, *x) == *y).then_some(found)
    }

    /// Finds numerator and monic denominator of the fraction of low degree with these values, if
    /// the last points confirm it.
    pub fn fraction(&self, points: &[(u64, u64)]) -> Option<(Polynomial, Polynomial)> {
        let (given, checks) = points.split_at(points.len().checked_sub(CHECKS)?);
        let (found, node) = self.through(given);
        // Half of Euclid's algorithm: r_i = t_i · found modulo the node polynomial.
        let (mut r, mut t) = ((node, found), (Vec::new(), vec![self.0.one()]));
        while 2 * r.1.len() > given.len() + 1 {
            let (quotient, rest) = self.divided(&r.0, &r.1);
            let next = self.difference(&t.0, &self.product(&quotient, &t.1));
            r = (r.1, rest);
            t = (t.1, next);
        }
        let confirmed = checks.iter().all(|(x, y)| {
            let below = self.evaluate(&t.1, *x);
            below != 0 && self.evaluate(&r.1, *x) == self.0.mul(*y, below)
        });
        let lead = t.1.last().copied().filter(|_| confirmed)?;
        let inverse = self.0.inverse(lead);
        let scaled = |a: &[u64]| a.iter().map(|c| self.0.mul(*c, inverse)).collect();
        Some((scaled(&r.1), scaled(&t.1)))
    }

    /// Finds the distinct roots in the field, in increasing order of their residues.
    pub fn roots(&self, a: &[u64]) -> Vec<u64> {
        whole(self.roots_unless(a, &mut || Ok(())))
    }

    /// Same as `roots`, between whose products `check` may fail.
    pub fn roots_unless<E>(
        &self,
        a: &[u64],
        check: &mut impl FnMut() -> Result<(), E>,
    ) -> Result<Vec<u64>, E> {
        if a.len() < 2 {
            return Ok(Vec::new());
        }
        let m = &self.0;
        let a = &self.monic(a);
        // Π (x − root) = gcd(a, x^p − x)
        let x = [0, m.one()];
        let frobenius = self.power_modulo_unless(&x, m.prime(), a, check)?;
        let linear = self.common_unless(a, &self.difference(&frobenius, &x), check)?;
        let mut found = Vec::new();
        let mut open = vec![(linear, 1u64)];
        while let Some((own, shift)) = open.pop() {
            match own.len() {
                0 | 1 => {}
                2 => found.push(m.mul(m.sub(0, own[0]), m.inverse(own[1]))),
                // (x + shift)^((p − 1)/2) is 1 at half of the roots.
                _ => {
                    let base = [m.integer(shift), m.one()];
                    let half = self.power_modulo_unless(&base, (m.prime() - 1) / 2, &own, check)?;
                    let part =
                        self.common_unless(&own, &self.difference(&half, &[m.one()]), check)?;
                    if part.len() > 1 && part.len() < own.len() {
                        let rest = self.divided(&own, &part).0;
                        open.extend([(part, shift + 1), (rest, shift + 1)]);
                    } else {
                        open.push((own, shift + 1));
                    }
                }
            }
        }
        found.sort_unstable();
        Ok(found)
    }

    /// Computes a power modulo a polynomial.
    pub fn power_modulo(&self, base: &[u64], exponent: u64, modulus: &[u64]) -> Polynomial {
        whole(self.power_modulo_unless(base, exponent, modulus, &mut || Ok(())))
    }

    fn power_modulo_unless<E>(
        &self,
        base: &[u64],
        exponent: u64,
        modulus: &[u64],
        check: &mut impl FnMut() -> Result<(), E>,
    ) -> Result<Polynomial, E> {
        let mut result = self.divided(&[self.0.one()], modulus).1;
        for bit in (0..64 - exponent.leading_zeros()).rev() {
            check()?;
            result = self.divided(&self.product(&result, &result), modulus).1;
            if exponent >> bit & 1 == 1 {
                result = self.divided(&self.product(&result, base), modulus).1;
            }
        }
        Ok(result)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring() -> PrimePolynomials {
        PrimePolynomials(Modulus::new((1 << 61) - 1))
    }

    /// Product of x − n for some integers n.
    fn with_roots(ring: &PrimePolynomials, roots: &[u64]) -> Polynomial {
        let m = ring.0;
        let linear = |n: &u64| [m.sub(0, m.integer(*n)), m.one()];
        roots.iter().fold(vec![m.one()], |all, n| ring.product(&all, &linear(n)))
    }

    #[test]
    fn fractions_come_from_values() {
        let ring = ring();
        let m = ring.0;
        let n = |x: u64| m.integer(x);
        // (x² + 3)/(x³ + 2x + 7)
        let (above, below) = (vec![n(3), 0, n(1)], vec![n(7), n(2), 0, n(1)]);
        let point = |k: u64| {
            let x = n(1000 + 37 * k);
            let inverse = m.inverse(ring.evaluate(&below, x));
            (x, m.mul(ring.evaluate(&above, x), inverse))
        };
        let points: Vec<(u64, u64)> = (0..16).map(point).collect();
        assert_eq!(ring.fraction(&points[..8]), None, "eight points do not determine it");
        assert_eq!(ring.fraction(&points), Some((above, below)));
    }

    #[test]
    fn roots_are_all_found() {
        let ring = ring();
        let m = ring.0;
        // (x − 4)(x − 9)²(x² + 1), where −1 is not a square.
        let irreducible = [m.one(), 0, m.one()];
        let product = ring.product(&with_roots(&ring, &[4, 9, 9]), &irreducible);
        let mut expected = vec![m.integer(4), m.integer(9)];
        expected.sort_unstable();
        assert_eq!(ring.roots(&product), expected);
        let common = ring.common(&product, &with_roots(&ring, &[9, 5]));
        assert_eq!(common, with_roots(&ring, &[9]), "the greatest common divisor");
        let many: Vec<u64> = (20..60).collect();
        assert_eq!(ring.roots(&with_roots(&ring, &many)).len(), 40);
        let checked = ring.roots_unless(&product, &mut || Err("halt"));
        assert_eq!(checked, Err("halt"), "a check ends the computation");
    }

    #[test]
    fn long_divisions_leave_the_rest() {
        let ring = ring();
        let m = ring.0;
        // More products than a sum may have before it is reduced.
        let length = m.most_products() + 40;
        let entry = |k: u64| m.integer(k * k * 7919 + u64::MAX / (k + 2));
        let divisor: Polynomial = (0..length).map(entry).collect();
        let quotient: Polynomial = (3..2 * length).map(entry).collect();
        let rest: Polynomial = (5..60).map(entry).collect();
        let minus: Polynomial = rest.iter().map(|c| m.sub(0, *c)).collect();
        let whole = ring.difference(&ring.product(&quotient, &divisor), &minus);
        assert_eq!(ring.divided(&whole, &divisor), (quotient, rest));
        assert_eq!(ring.divided(&[], &divisor), (Vec::new(), Vec::new()), "0/b");
    }

    #[test]
    fn values_at_integers_give_the_polynomial() {
        let ring = ring();
        let m = ring.0;
        let own = with_roots(&ring, &[3, 3, 5, 11]);
        let points = (0..9).map(|k| m.integer(k));
        let points: Vec<(u64, u64)> = points.map(|x| (x, ring.evaluate(&own, x))).collect();
        let values: Vec<u64> = points.iter().map(|(_, y)| *y).collect();
        let found = whole(ring.interpolated_unless(&values, &mut || Ok(())));
        assert_eq!(found, own);
        assert_eq!(ring.through(&points).0, own, "the same by products of x − x_i");
        assert_eq!(ring.polynomial(&points[..6]), None, "three values do not determine it");
        let rest = ring.without_unless(&own, &with_roots(&ring, &[3]), &mut || Ok(()));
        assert_eq!(whole(rest), with_roots(&ring, &[5, 11]), "the double root is gone");
        assert_eq!(ring.square_free(&own), with_roots(&ring, &[3, 5, 11]));
    }
}
