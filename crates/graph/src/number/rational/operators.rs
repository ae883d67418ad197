//! Sums, products and order of rational numbers, in machine words where both have small parts.

use std::cmp::Ordering;

use num_rational::BigRational;
use num_traits::One;

use super::divisor::common_divisor;
use super::{Rational, Repr};

macro_rules! operators {
    ($($trait:ident $method:ident $checked:expr, $large:expr;)*) => {$(
        impl std::ops::$trait for &Rational {
            type Output = Rational;
            fn $method(self, other: &Rational) -> Rational {
                if let (Repr::Small(a, b), Repr::Small(c, d)) = (&self.0, &other.0) {
                    let [a, b, c, d] = [*a, *b, *c, *d].map(i128::from);
                    // Products of 64-bit parts fit 127 bits; only a sum of two may overflow.
                    if let Some((n, d)) = $checked(a, b, c, d) {
                        return Rational::reduced(n, d);
                    }
                }
                Rational::from_big($large(&self.to_big(), &other.to_big()))
            }
        }
    )*};
}

operators! {
    Add add |a: i128, b: i128, c: i128, d: i128| {
        (a * d).checked_add(c * b).map(|n| (n, b * d))
    }, sum;
    Sub sub |a: i128, b: i128, c: i128, d: i128| {
        (a * d).checked_sub(c * b).map(|n| (n, b * d))
    }, |a, b: &BigRational| sum(a, &-b);
    Mul mul |a: i128, b: i128, c: i128, d: i128| Some((a * c, b * d)), product;
}

/// Adds in lowest terms: above and below only divisors of both denominators can be left
/// (Knuth, The Art of Computer Programming 2, 4.5.1).
fn sum(a: &BigRational, b: &BigRational) -> BigRational {
    let common = common_divisor(a.denom(), b.denom());
    if common.is_one() {
        let above = a.numer() * b.denom() + b.numer() * a.denom();
        return BigRational::new_raw(above, a.denom() * b.denom());
    }
    let (own, other) = (a.denom() / &common, b.denom() / &common);
    let above = a.numer() * other + b.numer() * &own;
    let left = common_divisor(&above, &common);
    BigRational::new_raw(above / &left, own * (b.denom() / left))
}

/// Multiplies in lowest terms, by the divisors that one numerator shares with the other denominator.
fn product(a: &BigRational, b: &BigRational) -> BigRational {
    let left = common_divisor(a.numer(), b.denom());
    let right = common_divisor(b.numer(), a.denom());
    let above = (a.numer() / &left) * (b.numer() / &right);
    BigRational::new_raw(above, (a.denom() / right) * (b.denom() / left))
}

impl std::ops::Neg for &Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        match &self.0 {
            Repr::Small(n, d) => Rational::reduced(-i128::from(*n), i128::from(*d)),
            Repr::Big(value) => Rational::from_big(-&**value),
        }
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        match (&self.0, &other.0) {
            (Repr::Small(a, b), Repr::Small(c, d)) => {
                (i128::from(*a) * i128::from(*d)).cmp(&(i128::from(*c) * i128::from(*b)))
            }
            _ => self.to_big().cmp(&other.to_big()),
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
