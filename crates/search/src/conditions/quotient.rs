//! Common divisors and quotients of polynomials in the parameters modulo a prime.

use std::collections::BTreeMap;

use liouville::number::prime::{Modulus, Polynomial, PrimePolynomials};
use liouville::proof::ProofRng;

use super::hypersurface::PrimeTerms;
use super::ideal::degree;
use super::variety::power;
use crate::echelon::Echelon;
use crate::series::exponents;

/// Largest number of coefficients of the two cofactors of a common divisor.
const COFACTORS: usize = 640;

/// Value of a polynomial.
pub fn value(m: &Modulus, own: &PrimeTerms, point: &[u64]) -> u64 {
    own.iter().fold(0, |sum, (e, image)| m.add(sum, m.mul(*image, power(point, e, m))))
}

/// A combination of polynomials.
fn combined(m: &Modulus, all: &[PrimeTerms], weights: &[u64]) -> PrimeTerms {
    let mut sums: BTreeMap<&[u32], u64> = BTreeMap::new();
    for (own, weight) in all.iter().zip(weights) {
        for (exponents, image) in own {
            let sum = sums.entry(exponents).or_insert(0);
            *sum = m.add(*sum, m.mul(*image, *weight));
        }
    }
    let used = sums.into_iter().filter(|(_, image)| *image != 0);
    used.map(|(exponents, image)| (exponents.to_vec(), image)).collect()
}

/// Divides polynomials by their greatest common divisor; returns the quotients and the divisor. `None`
/// if the degrees are too high.
///
/// With f₁ = g h₁ and f₂ = g h₂ for two random combinations of them, (h₁, h₂) is the only solution of
/// f₁ h₂ = f₂ h₁ of its degree, up to a factor. That degree is known from a random line.
pub fn without_common(
    all: &[PrimeTerms],
    m: &Modulus,
    rng: &mut ProofRng,
) -> Option<(Vec<PrimeTerms>, PrimeTerms)> {
    let variables = all.first()?.first()?.0.len();
    let draw = |rng: &mut ProofRng, count: usize| -> Vec<u64> {
        (0..count).map(|_| rng.element(m)).collect()
    };
    let weights = [draw(rng, all.len()), draw(rng, all.len())];
    let [first, second] = weights.each_ref().map(|own| combined(m, all, own));
    let highest = degree(&first);
    let (origin, slope) = (draw(rng, variables), draw(rng, variables));
    let [one, other] = [&first, &second].map(|own| on_line(m, own, &origin, &slope));
    let common = PrimePolynomials(*m).common(&one, &other).len().saturating_sub(1);
    let constant = vec![(vec![0; variables], m.one())];
    if common == 0 {
        return Some((all.to_vec(), constant));
    }
    let rest = highest.checked_sub(common as u32)?;
    let monomials: Vec<Vec<u32>> =
        (0..=rest).rev().flat_map(|total| exponents(variables, total)).collect();
    let width = 2 * monomials.len();
    if width > COFACTORS {
        return None;
    }
    let mut echelon = Echelon::new(width, *m);
    for _ in 0..width + SPARE {
        let point = draw(rng, variables);
        let (one, other) = (value(m, &first, &point), value(m, &second, &point));
        let values: Vec<u64> = monomials.iter().map(|own| power(&point, own, m)).collect();
        let lower = values.iter().map(|own| m.mul(*own, other));
        let upper = values.iter().map(|own| m.sub(0, m.mul(*own, one)));
        echelon.push(lower.chain(upper).collect());
    }
    let mut vectors = echelon.null_space();
    let vector = vectors.pop().filter(|_| vectors.is_empty())?;
    let cofactor: PrimeTerms = monomials
        .into_iter()
        .zip(vector.into_iter().take(width / 2))
        .filter(|(_, image)| *image != 0)
        .collect();
    let divisor = divided(m, &first, &cofactor)?;
    let quotients = all.iter().map(|own| divided(m, own, &divisor)).collect::<Option<_>>()?;
    Some((quotients, divisor))
}

/// Number of points beyond the unknowns.
const SPARE: usize = 8;

/// Restricts a polynomial to a line.
fn on_line(m: &Modulus, own: &PrimeTerms, origin: &[u64], slope: &[u64]) -> Polynomial {
    let values = (0..=u64::from(degree(own))).map(|t| {
        let t = m.integer(t);
        let point = m.along(origin, slope, t);
        (t, value(m, own, &point))
    });
    PrimePolynomials(*m).through(&values.collect::<Vec<_>>()).0
}

/// Divides a polynomial by another, without a rest; `None` if there is one.
pub fn divided(m: &Modulus, above: &PrimeTerms, below: &PrimeTerms) -> Option<PrimeTerms> {
    let key = |own: &[u32]| (own.iter().sum::<u32>(), own.to_vec());
    let used = below.iter().filter(|(_, image)| *image != 0);
    let (lead, image) = used.clone().max_by_key(|(own, _)| key(own))?;
    let inverse = m.inverse(*image);
    let mut rest: BTreeMap<(u32, Vec<u32>), u64> = BTreeMap::new();
    above.iter().for_each(|(own, image)| _ = rest.insert(key(own), *image));
    let mut quotient = PrimeTerms::new();
    while let Some(((_, own), image)) = rest.pop_last() {
        if image == 0 {
            continue;
        }
        let shift: Option<Vec<u32>> =
            own.iter().zip(lead).map(|(a, b)| a.checked_sub(*b)).collect();
        let shift = shift?;
        let factor = m.mul(image, inverse);
        for (other, image) in used.clone().filter(|(other, _)| other != lead) {
            let sum: Vec<u32> = other.iter().zip(&shift).map(|(a, b)| a + b).collect();
            let entry = rest.entry(key(&sum)).or_insert(0);
            *entry = m.sub(*entry, m.mul(factor, *image));
        }
        quotient.push((shift, factor));
    }
    Some(quotient)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_divisors_are_removed() {
        let mut rng = ProofRng::new(7, 0);
        let m = rng.prime(&[], &[]);
        let n = |x: u64| m.integer(x);
        let product = |a: &PrimeTerms, b: &PrimeTerms| -> PrimeTerms {
            let shifted = b.iter().map(|(own, image)| -> PrimeTerms {
                let sum = |e: &Vec<u32>| e.iter().zip(own).map(|(x, y)| x + y).collect();
                a.iter().map(|(e, x)| (sum(e), m.mul(*x, *image))).collect()
            });
            let all: Vec<PrimeTerms> = shifted.collect();
            combined(&m, &all, &vec![m.one(); all.len()])
        };
        // g = (a² + b)², f = g (a − 1), g (b a − 2), g.
        let square = vec![(vec![2, 0], n(1)), (vec![0, 1], n(1))];
        let divisor = product(&square, &square);
        let rests: [PrimeTerms; 3] = [
            vec![(vec![0, 0], m.sub(0, n(1))), (vec![1, 0], n(1))],
            vec![(vec![0, 0], m.sub(0, n(2))), (vec![1, 1], n(1))],
            vec![(vec![0, 0], n(1))],
        ];
        let all: Vec<PrimeTerms> = rests.iter().map(|own| product(&divisor, own)).collect();
        let (quotients, found) = without_common(&all, &m, &mut rng).expect("a divisor");
        assert_eq!(degree(&found), 4);
        let point = [n(5), n(9)];
        let scale = m.mul(value(&m, &divisor, &point), m.inverse(value(&m, &found, &point)));
        for (own, rest) in quotients.iter().zip(&rests) {
            assert_eq!(value(&m, own, &point), m.mul(scale, value(&m, rest, &point)));
        }
        let (same, one) = without_common(&rests, &m, &mut rng).expect("a constant");
        assert_eq!((same.as_slice(), degree(&one)), (rests.as_slice(), 0));
    }
}
