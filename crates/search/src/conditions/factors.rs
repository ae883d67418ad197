//! Factors of polynomials in one variable and in two, modulo a prime.
//!
//! In one variable by Cantor and Zassenhaus. In two, G(t, s) monic in t and of total degree deg G(t, 0):
//! the factors of G(t, 0) are lifted to powers of s (Hensel), and products of them are factors of G if
//! they and their complements have no terms beyond their degrees.

use liouville::number::prime::{Polynomial, PrimePolynomials};
use liouville::proof::ProofRng;

/// A polynomial in t and s: coefficients of the powers of s, each a polynomial in t.
pub type Bivariate = Vec<Polynomial>;

/// Largest number of univariate factors whose products are tried.
const MOST_FACTORS: usize = 16;

/// Finds the monic irreducible factors of a monic polynomial without repeated factors.
pub fn irreducible(ring: &PrimePolynomials, a: &[u64], rng: &mut ProofRng) -> Vec<Polynomial> {
    let mut found = Vec::new();
    let mut rest = a.to_vec();
    let x = vec![0, ring.0.one()];
    let mut frobenius = x.clone();
    let mut degree = 0;
    while rest.len() > 2 * degree + 2 {
        degree += 1;
        frobenius = ring.power_modulo(&frobenius, ring.0.prime(), &rest);
        let part = ring.common(&rest, &ring.difference(&frobenius, &x));
        if part.len() > 1 {
            rest = ring.divided(&rest, &part).0;
            frobenius = ring.divided(&frobenius, &rest).1;
            split_equal(ring, &part, degree, rng, &mut found);
        }
    }
    if rest.len() > 1 {
        found.push(ring.monic(&rest));
    }
    found
}

/// Splits a product of distinct irreducible polynomials of one degree.
fn split_equal(
    ring: &PrimePolynomials,
    a: &[u64],
    degree: usize,
    rng: &mut ProofRng,
    found: &mut Vec<Polynomial>,
) {
    if a.len() == degree + 1 {
        found.push(ring.monic(a));
        return;
    }
    loop {
        let base: Polynomial = (1..a.len()).map(|_| rng.element(&ring.0)).collect();
        // The norm of an element to the prime field, and its quadratic character.
        let mut image = ring.divided(&PrimePolynomials::trimmed(base), a).1;
        let mut norm = vec![ring.0.one()];
        for _ in 0..degree {
            norm = ring.divided(&ring.product(&norm, &image), a).1;
            image = ring.power_modulo(&image, ring.0.prime(), a);
        }
        let power = ring.power_modulo(&norm, (ring.0.prime() - 1) / 2, a);
        let part = ring.common(a, &ring.difference(&power, &[ring.0.one()]));
        if part.len() > 1 && part.len() < a.len() {
            let other = ring.divided(a, &part).0;
            split_equal(ring, &part, degree, rng, found);
            split_equal(ring, &other, degree, rng, found);
            return;
        }
    }
}

/// Inverts a modulo b, which have no common factor.
fn inverse_modulo(ring: &PrimePolynomials, a: &[u64], b: &[u64]) -> Polynomial {
    let mut r = (b.to_vec(), ring.divided(a, b).1);
    let mut t = (Vec::new(), vec![ring.0.one()]);
    while r.1.len() > 1 {
        let (quotient, rest) = ring.divided(&r.0, &r.1);
        let next = ring.difference(&t.0, &ring.product(&quotient, &t.1));
        r = (r.1, rest);
        t = (t.1, next);
    }
    let scale = r.1.first().map_or(0, |lead| ring.0.inverse(*lead));
    let scaled = t.1.iter().map(|c| ring.0.mul(*c, scale)).collect();
    ring.divided(&PrimePolynomials::trimmed(scaled), b).1
}

/// Multiplies modulo s^length.
pub fn bivariate_product(
    ring: &PrimePolynomials,
    a: &Bivariate,
    b: &Bivariate,
    length: usize,
) -> Bivariate {
    let mut product: Bivariate = vec![Vec::new(); length];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate().take_while(|(j, _)| i + j < length) {
            product[i + j] = sum(ring, &product[i + j], &ring.product(x, y));
        }
    }
    product
}

fn sum(ring: &PrimePolynomials, a: &[u64], b: &[u64]) -> Polynomial {
    let minus: Polynomial = b.iter().map(|c| ring.0.sub(0, *c)).collect();
    ring.difference(a, &minus)
}

/// Lifts coprime monic factors of G(t, 0) to factors of G modulo the powers of s that G has.
pub fn lifted(
    ring: &PrimePolynomials,
    whole: &Bivariate,
    factors: &[Polynomial],
) -> Vec<Bivariate> {
    let length = whole.len();
    let one = vec![ring.0.one()];
    let cofactors: Vec<Polynomial> = (0..factors.len())
        .map(|i| {
            let others = factors.iter().enumerate().filter(|(j, _)| *j != i);
            let product = others.fold(one.clone(), |all, (_, own)| ring.product(&all, own));
            inverse_modulo(ring, &product, &factors[i])
        })
        .collect();
    let mut lifted: Vec<Bivariate> = factors.iter().map(|own| vec![own.clone()]).collect();
    for order in 1..length {
        let start: Bivariate = vec![one.clone()];
        let product =
            lifted.iter().fold(start, |all, own| bivariate_product(ring, &all, own, order + 1));
        let error = ring.difference(&whole[order], &product[order]);
        for (i, own) in lifted.iter_mut().enumerate() {
            let correction = ring.product(&error, &cofactors[i]);
            own.push(ring.divided(&correction, &factors[i]).1);
        }
    }
    lifted
}

/// Finds the factors of G(t, s) from those of G(t, 0), as sets of the latter; all are in one set if
/// there are too many.
pub fn bivariate_factors(
    ring: &PrimePolynomials,
    whole: &Bivariate,
    factors: &[Polynomial],
) -> Vec<Vec<usize>> {
    let all: Vec<usize> = (0..factors.len()).collect();
    if factors.len() > MOST_FACTORS {
        return vec![all];
    }
    let lifted = lifted(ring, whole, factors);
    let product = |places: &[usize]| {
        let start: Bivariate = vec![vec![ring.0.one()]];
        let fold = |all, place: &usize| bivariate_product(ring, &all, &lifted[*place], whole.len());
        places.iter().fold(start, fold)
    };
    let mut found: Vec<Vec<usize>> = Vec::new();
    let mut rest = all;
    let mut size = 1;
    while 2 * size <= rest.len() {
        let next = subsets(&rest, size).into_iter().find(|own| {
            let others: Vec<usize> =
                rest.iter().copied().filter(|place| !own.contains(place)).collect();
            has_own_degree(&product(own)) && has_own_degree(&product(&others))
        });
        match next {
            Some(own) => {
                rest.retain(|place| !own.contains(place));
                found.push(own);
            }
            None => size += 1,
        }
    }
    if !rest.is_empty() {
        found.push(rest);
    }
    found
}

/// Whether the total degree is that of the coefficient of s⁰.
fn has_own_degree(own: &Bivariate) -> bool {
    let degree = own.first().map_or(0, Vec::len);
    own.iter().enumerate().all(|(power, a)| a.is_empty() || a.len() + power <= degree)
}

/// Lists the subsets of a size.
fn subsets(all: &[usize], size: usize) -> Vec<Vec<usize>> {
    match (size, all.split_first()) {
        (0, _) => vec![Vec::new()],
        (_, None) => Vec::new(),
        (_, Some((first, rest))) => {
            let with = subsets(rest, size - 1).into_iter().map(|own| [vec![*first], own].concat());
            with.chain(subsets(rest, size)).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_in_one_variable_are_factored() {
        let mut rng = ProofRng::new(6, 0);
        let ring = PrimePolynomials(rng.prime(&[], &[]));
        for degrees in [vec![1], vec![1, 1, 2], vec![2, 2, 3, 3], vec![5, 5, 1, 1, 1]] {
            let random = |degree: usize, rng: &mut ProofRng| loop {
                let mut own: Polynomial = (0..degree).map(|_| rng.element(&ring.0)).collect();
                own.push(ring.0.one());
                if irreducible(&ring, &own, rng).len() == 1 {
                    return own;
                }
            };
            let mut factors: Vec<Polynomial> =
                degrees.iter().map(|degree| random(*degree, &mut rng)).collect();
            let one = vec![ring.0.one()];
            let whole = factors.iter().fold(one, |all, own| ring.product(&all, own));
            let mut found = irreducible(&ring, &whole, &mut rng);
            found.sort();
            factors.sort();
            assert_eq!(found, factors);
        }
        // An irreducible polynomial has no root.
        let square = vec![ring.0.sub(0, ring.0.integer(4)), 0, ring.0.one()];
        assert_eq!(irreducible(&ring, &square, &mut rng).len(), 2, "x² − 4");
    }

    #[test]
    fn polynomials_in_two_variables_are_factored() {
        let mut rng = ProofRng::new(7, 0);
        let ring = PrimePolynomials(rng.prime(&[], &[]));
        for degrees in [vec![1, 1], vec![3], vec![1, 2, 2], vec![4, 1, 3]] {
            let length = degrees.iter().sum::<usize>() + 1;
            let random = |degree: usize, rng: &mut ProofRng| -> Bivariate {
                let row = |k: usize, rng: &mut ProofRng| -> Polynomial {
                    let mut own: Polynomial =
                        (0..(degree + 1 - k)).map(|_| rng.element(&ring.0)).collect();
                    if k == 0 {
                        own[degree] = ring.0.one();
                    }
                    own
                };
                (0..=degree).map(|k| row(k, rng)).collect()
            };
            let own: Vec<Bivariate> =
                degrees.iter().map(|degree| random(*degree, &mut rng)).collect();
            let one: Bivariate = vec![vec![ring.0.one()]];
            let whole =
                own.iter().fold(one, |all, own| bivariate_product(&ring, &all, own, length));
            let factors = irreducible(&ring, &whole[0], &mut rng);
            let sets = bivariate_factors(&ring, &whole, &factors);
            let degree = |set: &Vec<usize>| -> usize {
                set.iter().map(|place| factors[*place].len() - 1).sum()
            };
            let mut found: Vec<usize> = sets.iter().map(degree).collect();
            let mut expected = degrees.clone();
            found.sort_unstable();
            expected.sort_unstable();
            assert_eq!(found, expected);
        }
    }
}
