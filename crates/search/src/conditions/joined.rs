//! Factors modulo a prime that belong to polynomials with rational coefficients.

use liouville::number::prime::Modulus;

use super::hypersurface::{Hypersurface, PrimeTerms};

/// Largest number of factors modulo the prime whose product is one over the rational numbers.
const CONJUGATES: usize = 4;

/// Writes factors with rational coefficients; those without are multiplied with others.
pub fn joined(mut images: Vec<PrimeTerms>, m: &Modulus) -> Vec<Hypersurface> {
    let mut found = Vec::new();
    for size in 1..=CONJUGATES {
        let mut places: Vec<usize> = (0..size).collect();
        while places.last().is_some_and(|last| *last < images.len()) {
            let product = places
                .iter()
                .skip(1)
                .fold(images[places[0]].clone(), |all, place| multiplied(&all, &images[*place], m));
            match Hypersurface::of(&product, m) {
                Some(own) => {
                    found.push(own);
                    places.iter().rev().for_each(|place| drop(images.remove(*place)));
                    places = (0..size).collect();
                }
                None => advance(&mut places, images.len()),
            }
        }
    }
    found
}

/// Moves to the next subset of 0, …, count − 1 of the same size; the last one is followed by one that is
/// out of range.
fn advance(places: &mut [usize], count: usize) {
    let size = places.len();
    for k in (0..size).rev() {
        if places[k] + (size - k) < count || k == 0 {
            let first = places[k] + 1;
            places[k..].iter_mut().enumerate().for_each(|(j, place)| *place = first + j);
            return;
        }
    }
}

fn multiplied(a: &PrimeTerms, b: &PrimeTerms, m: &Modulus) -> PrimeTerms {
    let mut product = PrimeTerms::new();
    for (x, u) in a {
        for (y, v) in b {
            let exponents: Vec<u32> = x.iter().zip(y).map(|(x, y)| x + y).collect();
            let image = m.mul(*u, *v);
            match product.iter_mut().find(|(own, _)| *own == exponents) {
                Some((_, sum)) => *sum = m.add(*sum, image),
                None => product.push((exponents, image)),
            }
        }
    }
    product
}
