//! Finite sets of common zeros, divided over the rational numbers.
//!
//! A linear form takes different values at different points, and its minimal polynomial on the algebra of the
//! set has these as roots. Its factors over the rational numbers belong to sets that are not divided further
//! where the form separates all points.

use liouville::number::prime::{Modulus, Polynomial, PrimePolynomials};
use liouville::proof::ProofRng;

use super::bounded_ideal::BoundedIdeal;
use super::factors::irreducible;
use super::hypersurface::PrimeTerms;
use super::joined::joined;

/// Weights of the variables in the linear forms that are tried: powers of these.
const RATIOS: [i64; 4] = [1, 2, -2, 3];
/// Largest number of factors modulo the prime.
const FACTORS: usize = 12;

/// Finds polynomials each of which gives a part of a set that is finite in the variables in use, without
/// multiple points; `None` if it is not divided.
pub fn parts(
    ideal: &BoundedIdeal,
    used: &[bool],
    (m, rng): (&Modulus, &mut ProofRng),
) -> Option<Vec<PrimeTerms>> {
    let ring = PrimePolynomials(*m);
    RATIOS.iter().find_map(|ratio| {
        let powers = ideal.powers_of_form(*ratio, used)?;
        let minimal = ring.monic(&powers.minimal);
        // A double point is not divided, nor is a single one.
        if minimal.len() < 3 || ring.square_free(&minimal).len() < minimal.len() {
            return None;
        }
        let images = irreducible(&ring, &minimal, rng);
        if images.len() > FACTORS {
            return None;
        }
        let one_variable = |own: &Polynomial| -> PrimeTerms {
            own.iter().enumerate().map(|(power, image)| (vec![power as u32], *image)).collect()
        };
        let mut rest = minimal;
        let mut factors: Vec<Polynomial> = Vec::new();
        for own in joined(images.iter().map(one_variable).collect(), m) {
            let mut factor = vec![0; own.degree() + 1];
            own.images(m)?.into_iter().for_each(|(power, image)| factor[power[0] as usize] = image);
            rest = ring.divided(&rest, &factor).0;
            factors.push(factor);
        }
        factors.extend(Some(rest).filter(|rest| rest.len() > 1));
        (factors.len() > 1).then(|| factors.iter().map(|own| powers.value(own)).collect())
    })
}
