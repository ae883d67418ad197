//! Polynomials of two terms that are powers: c Aⁿ + d Bⁿ with monomials A and B.

use num_integer::Integer;

use crate::number::rational::Rational;

use super::Polynomial;

/// Monomials A and B, and numbers with Aⁿ = ratio · Bⁿ where a polynomial is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Binomial {
    /// Monomial A.
    pub above: Polynomial,
    /// Monomial B.
    pub below: Polynomial,
    /// Number n.
    pub exponent: u32,
    /// Number ratio, positive for even n.
    pub ratio: Rational,
}

impl Polynomial {
    /// Reads a polynomial of two terms without a common factor as c Aⁿ + d Bⁿ with the largest n; `None` for n < 3, as quadratic
    /// equations are solved by rules of their own, and where all zeros are common zeros of A and B.
    pub fn binomial(&self) -> Option<Binomial> {
        let mut terms = self.terms();
        let (Some((first, one)), Some((second, two)), None) =
            (terms.next_back(), terms.next_back(), terms.next())
        else {
            return None;
        };
        let powers = one.iter().chain(two).map(|(_, power)| *power);
        let exponent = powers.fold(0, |common: u32, power| common.gcd(&power));
        let ratio = -&(second * &first.recip()?);
        let is_coprime = self.common_term().number().is_some();
        if exponent < 3 || !is_coprime || exponent.is_even() && ratio.is_negative() {
            return None;
        }
        let root = |of: &[(u32, u32)]| {
            let all = of.iter().map(|(variable, power)| (*variable, power / exponent));
            Self::of_term(&Rational::from(1), all)
        };
        Some(Binomial { above: root(one), below: root(two), exponent, ratio })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_that_are_powers_are_read_as_such() {
        let of = |terms: &[(i64, &[(u32, u32)])]| {
            terms.iter().fold(Polynomial::default(), |sum, (factor, powers)| {
                sum.plus(&Polynomial::of_term(&Rational::from(*factor), powers.iter().copied()))
            })
        };
        let read = |terms: &[(i64, &[(u32, u32)])]| {
            of(terms).binomial().map(|own| (own.exponent, own.ratio))
        };
        let cube: &[(u32, u32)] = &[(0, 3)];
        assert_eq!(read(&[(1, cube), (-2, &[(1, 3)])]).map(|own| own.0), Some(3), "x³ = 2y³");
        assert_eq!(read(&[(1, cube), (5, &[])]), Some((3, Rational::from(-5))), "x³ = −5");
        let six: &[(u32, u32)] = &[(0, 6)];
        let nine: &[(u32, u32)] = &[(1, 9), (2, 3)];
        let found = of(&[(1, nine), (-7, six)]).binomial().expect("y⁹z³ = 7x⁶");
        let sides = [of(&[(1, &[(1, 3), (2, 1)])]), of(&[(1, &[(0, 2)])])];
        assert!(sides.contains(&found.above) && sides.contains(&found.below), "{found:?}");
        assert_eq!(read(&[(1, &[(0, 4)]), (2, &[(1, 4)])]), None, "0 where x and y are");
        assert_eq!(read(&[(1, &[(0, 2)]), (-2, &[(1, 2)])]), None, "a quadratic equation");
        assert_eq!(read(&[(1, cube), (-2, &[(1, 2)])]), None, "a cusp");
        assert_eq!(read(&[(1, cube), (-2, &[(0, 6)])]), None, "with a common factor");
        assert_eq!(read(&[(1, cube), (1, &[(1, 3)]), (1, &[])]), None, "three terms");
    }
}
