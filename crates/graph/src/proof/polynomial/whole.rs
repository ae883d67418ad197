//! Irreducible factors of polynomials in one variable with whole coefficients.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::modular::{Coefficients, Residues, trimmed};
use crate::number::rational::common_divisor;

/// Largest degree that is divided.
const MOST_DEGREE: usize = 12;
/// Exponents of Mersenne's primes.
const EXPONENTS: [u32; 7] = [61, 89, 107, 127, 521, 607, 1279];
/// Largest number of factors modulo a prime.
const MOST_FACTORS: usize = 10;

/// Divides by the common divisor of the coefficients, and makes the leading one positive.
pub fn primitive(of: Coefficients) -> Coefficients {
    let common = of.iter().fold(BigInt::zero(), |common, value| common_divisor(&common, value));
    let Some(head) = of.last().filter(|_| !common.is_zero()) else { return of };
    let common = if head.is_negative() { -common } else { common };
    of.iter().map(|value| value / &common).collect()
}

/// Divides exactly; `None` if a remainder or a broken coefficient is left.
fn over(of: &[BigInt], divisor: &[BigInt]) -> Option<Coefficients> {
    let head = divisor.last()?;
    let mut rest = of.to_vec();
    let count = (of.len() + 1).checked_sub(divisor.len())?;
    let mut quotient = vec![BigInt::zero(); count];
    for place in (0..count).rev() {
        let (value, left) = rest[place + divisor.len() - 1].div_rem(head);
        if !left.is_zero() {
            return None;
        }
        for (k, own) in divisor.iter().enumerate() {
            rest[place + k] -= &value * own;
        }
        quotient[place] = value;
    }
    rest.iter().all(Zero::is_zero).then(|| trimmed(quotient))
}

/// Lists the irreducible factors over ℚ of a polynomial with whole coefficients, without common divisor and with a
/// positive leading one; `None` if it has a repeated factor, or is too large.
pub fn irreducible_factors(of: &[BigInt]) -> Option<Vec<Coefficients>> {
    let degree = of.len().checked_sub(1)?;
    if degree > MOST_DEGREE {
        return None;
    }
    if degree <= 1 {
        return Some(if degree == 1 { vec![of.to_vec()] } else { Vec::new() });
    }
    // Mignotte: a factor with the leading coefficient of the whole has coefficients below this.
    let sum: BigInt = of.iter().map(Signed::abs).sum();
    let bound = (of.last()?.abs() * sum) << (degree + 1);
    let exponents = EXPONENTS.iter().filter(|bits| u64::from(**bits) > bound.bits());
    let slope: Coefficients =
        of.iter().enumerate().skip(1).map(|(power, value)| value * BigInt::from(power)).collect();
    for bits in exponents.take(2) {
        let residues = Residues::below_power(*bits);
        let (reduced, slope) = (residues.reduced(of), residues.reduced(&slope));
        if reduced.len() != of.len() || residues.common_divisor(&reduced, &slope).len() != 1 {
            continue;
        }
        let factors = residues.irreducible(&residues.monic(&reduced))?;
        return combined(of, factors, &residues);
    }
    None
}

/// Multiplies factors modulo a prime until products divide the whole.
fn combined(
    of: &[BigInt],
    mut factors: Vec<Coefficients>,
    residues: &Residues,
) -> Option<Vec<Coefficients>> {
    if factors.len() > MOST_FACTORS {
        return None;
    }
    let (mut rest, mut found) = (of.to_vec(), Vec::new());
    let mut size = 1;
    while 2 * size <= factors.len() {
        let sets = (1u32..1 << factors.len()).filter(|set| set.count_ones() as usize == size);
        let mut divided = None;
        for set in sets {
            let chosen = factors.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1);
            let head = residues.reduced(&rest[rest.len() - 1..]);
            let product = chosen.fold(head, |all, (_, own)| residues.times(&all, own));
            let factor = primitive(residues.symmetric(&product));
            if let Some(quotient) = over(&rest, &factor) {
                divided = Some((set, factor, quotient));
                break;
            }
        }
        match divided {
            Some((set, factor, quotient)) => {
                found.push(factor);
                rest = quotient;
                let mut index = 0;
                factors.retain(|_| {
                    index += 1;
                    set >> (index - 1) & 1 == 0
                });
            }
            None => size += 1,
        }
    }
    if rest.len() > 1 || !rest.first().is_some_and(One::is_one) {
        found.push(rest);
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::polynomial::modular::product;
    use crate::proof::rng::ProofRng;

    fn whole(of: &[i64]) -> Coefficients {
        of.iter().map(|value| BigInt::from(*value)).collect()
    }

    fn degrees(of: &[i64]) -> Option<Vec<usize>> {
        let whole = whole(of);
        let factors = irreducible_factors(&whole)?;
        let whole_again = factors.iter().fold(vec![BigInt::one()], |all, own| product(&all, own));
        assert_eq!(whole_again, whole, "the product of the factors");
        let mut degrees: Vec<usize> = factors.iter().map(|own| own.len() - 1).collect();
        degrees.sort_unstable();
        Some(degrees)
    }

    #[test]
    fn polynomials_with_known_factors_fall_apart() {
        assert_eq!(degrees(&[-1, 0, 0, 1]), Some(vec![1, 2]), "x³ − 1");
        assert_eq!(
            degrees(&[1, 0, 0, 0, 1]),
            Some(vec![4]),
            "x⁴ + 1, which falls apart modulo each prime"
        );
        assert_eq!(degrees(&[4, 0, 0, 0, 1]), Some(vec![2, 2]), "x⁴ + 4");
        assert_eq!(degrees(&[4, 0, -5, 0, 1]), Some(vec![1, 1, 1, 1]), "(x² − 1)(x² − 4)");
        assert_eq!(degrees(&[1, 0, -10, 0, 1]), Some(vec![4]), "the conjugates of √2 + √3");
        assert_eq!(
            degrees(&[-2, -1, 5, 7, 6]),
            Some(vec![1, 1, 2]),
            "(2x − 1)(3x + 2)(x² + x + 1)"
        );
        assert_eq!(degrees(&[1, 2, 1]), None, "(x + 1)²");
        assert_eq!(
            degrees(&[-1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]),
            Some(vec![1, 1, 2, 2, 2, 4]),
            "x¹² − 1"
        );
    }

    #[test]
    fn random_products_have_their_factors() {
        let mut rng = ProofRng::new(7, 0);
        let mut digit = move || i64::try_from(rng.below(19)).expect("small") - 9;
        for _ in 0..60 {
            // p ≡ 3 modulo 9 with constant term 3: irreducible by Eisenstein's criterion at 3.
            let mut eisenstein = |degree: usize, constant: i64| -> Coefficients {
                let mut all: Vec<i64> = (0..=degree).map(|_| 3 * digit()).collect();
                (all[0], all[degree]) = (constant, 1);
                whole(&all)
            };
            let parts = [eisenstein(2, 3), eisenstein(3, 6), eisenstein(4, -3)];
            let all = parts.iter().fold(vec![BigInt::one()], |all, own| product(&all, own));
            let mut found = irreducible_factors(&all).expect("no repeated factor");
            found.sort_by_key(Vec::len);
            assert_eq!(found, parts);
        }
    }
}
