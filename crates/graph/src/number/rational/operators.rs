//! Sums, products and order of rational numbers, in machine words where both have small parts.

use std::cmp::Ordering;

use super::{Rational, Repr};

macro_rules! operators {
    ($($trait:ident $method:ident $checked:expr;)*) => {$(
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
                Rational::from_big(std::ops::$trait::$method(self.to_big(), other.to_big()))
            }
        }
    )*};
}

operators! {
    Add add |a: i128, b: i128, c: i128, d: i128| {
        (a * d).checked_add(c * b).map(|n| (n, b * d))
    };
    Sub sub |a: i128, b: i128, c: i128, d: i128| {
        (a * d).checked_sub(c * b).map(|n| (n, b * d))
    };
    Mul mul |a: i128, b: i128, c: i128, d: i128| Some((a * c, b * d));
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
