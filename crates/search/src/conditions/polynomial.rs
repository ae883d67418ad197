//! Polynomials in one variable modulo a prime: interpolation by fractions, common factors, roots.

use liouville::number::prime::Modulus;
use liouville::proof::ProofRng;

/// Coefficients as residues from low to high degree; the last one is not 0.
pub type Polynomial = Vec<u64>;

/// The polynomial ring F_p[x].
#[derive(Clone, Copy)]
pub struct PrimePolynomials(pub Modulus);

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
        let mut product = vec![0; (a.len() + b.len()).saturating_sub(1)];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                product[i + j] = self.0.add(product[i + j], self.0.mul(*x, *y));
            }
        }
        Self::trimmed(product)
    }

    /// Computes a − b.
    pub fn difference(&self, a: &[u64], b: &[u64]) -> Polynomial {
        let at = |a: &[u64], i: usize| a.get(i).copied().unwrap_or(0);
        Self::trimmed((0..a.len().max(b.len())).map(|i| self.0.sub(at(a, i), at(b, i))).collect())
    }

    /// Divides a by b ≠ 0; returns quotient and remainder.
    pub fn divided(&self, a: &[u64], b: &[u64]) -> (Polynomial, Polynomial) {
        let mut rest = a.to_vec();
        let mut quotient = vec![0; (a.len() + 1).saturating_sub(b.len())];
        let inverse = b.last().map_or(0, |lead| self.0.inverse(*lead));
        for place in (0..quotient.len()).rev() {
            let factor = self.0.mul(rest[place + b.len() - 1], inverse);
            quotient[place] = factor;
            for (entry, coefficient) in rest[place..].iter_mut().zip(b) {
                *entry = self.0.sub(*entry, self.0.mul(factor, *coefficient));
            }
        }
        (Self::trimmed(quotient), Self::trimmed(rest))
    }

    /// Divides by the leading coefficient.
    pub fn monic(&self, a: &[u64]) -> Polynomial {
        let inverse = a.last().map_or(0, |lead| self.0.inverse(*lead));
        a.iter().map(|c| self.0.mul(*c, inverse)).collect()
    }

    /// Computes the monic greatest common divisor; 0 if both are 0.
    pub fn common(&self, a: &[u64], b: &[u64]) -> Polynomial {
        let (mut a, mut b) = (a.to_vec(), b.to_vec());
        while !b.is_empty() {
            let rest = self.divided(&a, &b).1;
            (a, b) = (b, rest);
        }
        self.monic(&a)
    }

    /// Removes repeated factors.
    pub fn square_free(&self, a: &[u64]) -> Polynomial {
        let slope = |(k, c): (usize, &u64)| self.0.mul(self.0.integer(k as u64), *c);
        let slopes = a.iter().enumerate().skip(1).map(slope).collect();
        let repeated = self.common(a, &Self::trimmed(slopes));
        if repeated.len() < 2 { a.to_vec() } else { self.divided(a, &repeated).0 }
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

    /// Finds the distinct roots in the field.
    pub fn roots(&self, a: &[u64], rng: &mut ProofRng) -> Vec<u64> {
        if a.len() < 2 {
            return Vec::new();
        }
        // Π (x - root) = gcd(a, x^p - x)
        let x = [0, self.0.one()];
        let frobenius = self.power_modulo(&x, self.0.prime(), a);
        let mut found = Vec::new();
        self.split(&self.common(a, &self.difference(&frobenius, &x)), rng, &mut found);
        found.sort_unstable();
        found
    }

    /// Splits a product of distinct linear factors by the squares among root + shift.
    fn split(&self, a: &[u64], rng: &mut ProofRng, found: &mut Vec<u64>) {
        match a {
            [] | [_] => {}
            [constant, slope] => {
                found.push(self.0.mul(self.0.sub(0, *constant), self.0.inverse(*slope)));
            }
            _ => loop {
                let shifted = [rng.element(&self.0), self.0.one()];
                let power = self.power_modulo(&shifted, (self.0.prime() - 1) / 2, a);
                let part = self.common(a, &self.difference(&power, &[self.0.one()]));
                if part.len() > 1 && part.len() < a.len() {
                    let other = self.divided(a, &part).0;
                    self.split(&part, rng, found);
                    self.split(&other, rng, found);
                    return;
                }
            },
        }
    }

    /// Computes a power modulo a polynomial.
    pub fn power_modulo(&self, base: &[u64], exponent: u64, modulus: &[u64]) -> Polynomial {
        let mut result = self.divided(&[self.0.one()], modulus).1;
        for bit in (0..64 - exponent.leading_zeros()).rev() {
            result = self.divided(&self.product(&result, &result), modulus).1;
            if exponent >> bit & 1 == 1 {
                result = self.divided(&self.product(&result, base), modulus).1;
            }
        }
        result
    }
}

/// Number of points at which a fraction is checked: a false one survives each with probability d/p.
const CHECKS: usize = 3;

#[cfg(test)]
mod tests {
    use super::*;

    fn ring() -> (PrimePolynomials, ProofRng) {
        let mut rng = ProofRng::new(5, 0);
        (PrimePolynomials(rng.prime(&[], &[])), rng)
    }

    #[test]
    fn fractions_come_from_values() {
        let (ring, mut rng) = ring();
        let m = ring.0;
        let n = |x: u64| m.integer(x);
        // (x² + 3)/(x³ + 2x + 7)
        let (above, below) = (vec![n(3), 0, n(1)], vec![n(7), n(2), 0, n(1)]);
        let points: Vec<(u64, u64)> = (0..16)
            .map(|_| {
                let x = rng.element(&m);
                let inverse = m.inverse(ring.evaluate(&below, x));
                (x, m.mul(ring.evaluate(&above, x), inverse))
            })
            .collect();
        assert_eq!(ring.fraction(&points), Some((above, below)));
        assert_eq!(ring.fraction(&points[..8]), None, "eight points do not determine it");
    }

    #[test]
    fn roots_are_all_found() {
        let (ring, mut rng) = ring();
        let m = ring.0;
        let linear = |x: u64| vec![m.sub(0, m.integer(x)), m.one()];
        // (x - 4)(x - 9)²(x² + 1), where -1 is not a square.
        let irreducible = vec![m.one(), 0, m.one()];
        let factors = [linear(4), linear(9), linear(9), irreducible];
        let product = factors.iter().fold(vec![m.one()], |a, b| ring.product(&a, b));
        let mut expected = vec![m.integer(4), m.integer(9)];
        expected.sort_unstable();
        assert_eq!(ring.roots(&product, &mut rng), expected);
        let common = ring.common(&product, &ring.product(&linear(9), &linear(5)));
        assert_eq!(common, linear(9), "the greatest common divisor");
    }
}
