//! Roots of rational numbers in terms of roots of a few independent integers.
//!
//! Pairwise coprime integers above 1, none of them a square, have roots that are independent over
//! the rationals. Such integers are obtained from the constants under roots by common divisors
//! alone, without factoring.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use crate::number::rational::Rational;
use crate::order::StableOrder;

/// Largest number of integers that are refined against each other.
const MOST_INTEGERS: usize = 64;
/// Largest size in bits of a constant whose root is taken.
const MOST_BITS: u64 = 4096;

/// Pairwise coprime integers, none a square, such that some constants are products of their powers.
#[derive(Clone, Debug, Default)]
pub struct Numbers {
    base: Vec<BigInt>,
}

impl Numbers {
    /// Refines the constants; negative and too long ones are left out.
    pub fn of<'c>(constants: impl Iterator<Item = &'c Rational>) -> Self {
        let mut base: Vec<BigInt> = Vec::new();
        let mut open: Vec<BigInt> = constants.filter_map(parts).flatten().collect();
        open.order();
        open.dedup();
        while let Some(n) = open.pop() {
            if n.is_one() || base.contains(&n) {
                continue;
            }
            if base.len() >= MOST_INTEGERS {
                return Self::default();
            }
            match base.iter().position(|known| !known.gcd(&n).is_one()) {
                None => base.push(n),
                Some(index) => {
                    let known = base.swap_remove(index);
                    let common = known.gcd(&n);
                    open.extend([known / &common, n / &common, common]);
                }
            }
        }
        for n in &mut base {
            while let Some(root) = exact_root(n) {
                *n = root;
            }
        }
        base.order();
        Self { base }
    }

    /// Returns one of the integers.
    pub fn integer(&self, index: usize) -> Rational {
        Rational::from_parts(self.base[index].clone(), BigInt::one())
    }

    /// Writes a positive constant as a product of powers: indices of integers with exponents;
    /// `None` for a constant that was not refined.
    pub fn powers(&self, constant: &Rational) -> Option<Vec<(usize, i64)>> {
        let [mut above, mut below] = parts(constant)?;
        let mut powers = Vec::new();
        for (index, n) in self.base.iter().enumerate() {
            let exponent = take(&mut above, n) - take(&mut below, n);
            if exponent != 0 {
                powers.push((index, exponent));
            }
        }
        (above.is_one() && below.is_one()).then_some(powers)
    }
}

/// Divides by n as often as possible and returns the number of divisions.
fn take(value: &mut BigInt, n: &BigInt) -> i64 {
    let mut count = 0;
    loop {
        let (quotient, remainder) = value.div_rem(n);
        if !remainder.is_zero() {
            return count;
        }
        *value = quotient;
        count += 1;
    }
}

fn parts(constant: &Rational) -> Option<[BigInt; 2]> {
    let (above, below) = constant.parts();
    (above.is_positive() && constant.bits() <= MOST_BITS).then_some([above, below])
}

fn exact_root(n: &BigInt) -> Option<BigInt> {
    let root = n.sqrt();
    (!n.is_one() && &root * &root == *n).then_some(root)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn powers(constants: &[&str], of: &str) -> Option<Vec<(String, i64)>> {
        let read = |text: &&str| -> Rational { text.parse().expect("a number") };
        let constants: Vec<Rational> = constants.iter().map(read).collect();
        let numbers = Numbers::of(constants.iter());
        let found = numbers.powers(&read(&of))?;
        Some(found.iter().map(|(k, e)| (numbers.integer(*k).to_string(), *e)).collect())
    }

    #[test]
    fn constants_are_products_of_coprime_integers() {
        let shown = |powers: &[(&str, i64)]| {
            Some(powers.iter().map(|(n, e)| (n.to_string(), *e)).collect::<Vec<_>>())
        };
        assert_eq!(powers(&["12/5", "3/5"], "12/5"), shown(&[("2", 2), ("3", 1), ("5", -1)]));
        assert_eq!(powers(&["6", "2", "3"], "6"), shown(&[("2", 1), ("3", 1)]));
        assert_eq!(powers(&["8", "2"], "8"), shown(&[("2", 3)]));
        assert_eq!(powers(&["4/9"], "4/9"), shown(&[("2", 2), ("3", -2)]));
        assert_eq!(powers(&["16", "36"], "36"), shown(&[("2", 2), ("3", 2)]));
        let large = "1000000000000000000000000000057";
        assert_eq!(powers(&[large], large), shown(&[(large, 1)]), "no factor has to be known");
        assert_eq!(powers(&["2"], "-2"), None, "-2 is a product of none");
        assert_eq!(powers(&["2"], "3"), None, "3 was not asked about");
    }

    #[test]
    fn no_integer_is_a_square() {
        let constants: Vec<Rational> = (1..200).map(Rational::from).collect();
        let numbers = Numbers::of(constants[..40].iter());
        assert!(numbers.base.iter().all(|n| exact_root(n).is_none() && !n.is_one()));
        for constant in &constants[..40] {
            let powers = numbers.powers(constant).expect("refined");
            let power = |(k, e): (usize, i64)| numbers.integer(k).powi(e as i32).expect("not 0");
            let product = powers.into_iter().map(power).fold(Rational::from(1), |a, b| &a * &b);
            assert_eq!(product, *constant);
        }
    }
}
