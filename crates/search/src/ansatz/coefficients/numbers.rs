//! Coefficients as numbers: fractions, and sums of multiples of roots in the field and of their products.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::super::Coordinates;
use super::super::surd::surd;
use super::super::system::PrimePoint;
use super::{BARREN, PRIMES, PrimitiveVector, Vectors};
use liouville::formula::Formula;

/// Largest number of roots whose products are taken as well.
const MOST_MULTIPLIED: usize = 4;

/// Whether so many roots have products that are taken.
pub fn has_products(roots: usize) -> bool {
    (2..=MOST_MULTIPLIED).contains(&roots)
}

/// A number a/d, or (a + Σ b √n)/d with the places of the roots whose product √n is among those of a
/// field.
#[derive(Clone, Debug)]
pub struct Number {
    above: BigInt,
    below: BigInt,
    roots: Vec<(Vec<usize>, BigInt)>,
}

impl Number {
    /// Makes a fraction.
    pub fn fraction(above: BigInt, below: BigInt) -> Self {
        Self { above, below, roots: Vec::new() }
    }

    fn is_zero(&self) -> bool {
        self.above.is_zero() && self.roots.is_empty()
    }

    /// Whether a number has this image.
    fn has_image(&self, roots: &Roots, at: &PrimePoint, image: u64) -> bool {
        let prime = BigInt::from(at.modulus.prime());
        let value = BigInt::from(at.modulus.to_integer(image));
        let mut rest = &self.above - &self.below * value;
        for (product, multiple) in &self.roots {
            rest += multiple * roots.value(at, product);
        }
        rest.mod_floor(&prime).is_zero()
    }
}

/// Square roots of numbers and parameters among the coordinates.
pub struct Roots {
    places: Vec<usize>,
    names: Vec<Formula>,
    /// Products of different roots, single ones first.
    products: Vec<Vec<usize>>,
}

impl Roots {
    /// Selects the roots among the coordinates, with their products if wanted.
    pub fn of(names: &[Formula], with_products: bool) -> Self {
        let is_root = |k: &usize| Coordinates::is_root(&names[*k]);
        let places: Vec<usize> = (0..names.len()).filter(is_root).collect();
        let count = places.len();
        let mut products: Vec<Vec<usize>> = (0..count).map(|root| vec![root]).collect();
        if with_products && has_products(count) {
            // Without these the sums of multiples of several roots are no field.
            let all = 1usize..1 << count;
            let chosen = all.map(|set| (0..count).filter(|k| set >> k & 1 == 1).collect());
            products.extend(chosen.filter(|own: &Vec<usize>| own.len() > 1));
        }
        Self { names: places.iter().map(|k| names[*k].clone()).collect(), places, products }
    }

    /// Value of a product of roots.
    fn value(&self, at: &PrimePoint, product: &[usize]) -> BigInt {
        let m = at.modulus;
        let own = product.iter().map(|root| at.coordinates[self.places[*root]]);
        BigInt::from(m.to_integer(own.fold(m.one(), |made, root| m.mul(made, root))))
    }

    /// Finds a number with these images modulo different primes: of one root if there is one.
    pub fn number(&self, images: &[(&PrimePoint, u64)]) -> Option<Number> {
        let mut single = (0..self.places.len()).map(|root| vec![vec![root]]);
        single.find_map(|own| self.combination(images, &own)).or_else(|| {
            let has_several = self.products.len() > 1;
            has_several.then(|| self.combination(images, &self.products)).flatten()
        })
    }

    /// Finds a sum of multiples of 1 and of some products of roots with these images.
    fn combination(
        &self,
        images: &[(&PrimePoint, u64)],
        products: &[Vec<usize>],
    ) -> Option<Number> {
        let mut residue = Residue::default();
        let mut squares: Vec<Residue> = products.iter().map(|_| Residue::default()).collect();
        for (at, image) in images {
            let prime = BigInt::from(at.modulus.prime());
            residue.add(&BigInt::from(at.modulus.to_integer(*image)), &prime)?;
            for (square, product) in squares.iter_mut().zip(products) {
                square.add(&self.value(at, product), &prime)?;
            }
        }
        let squares: Vec<BigInt> = squares.into_iter().map(|own| own.value).collect();
        let mut found = surd(&residue.value, &squares, &residue.modulus)?.into_iter();
        let above = found.next()?;
        let roots = products.iter().cloned().zip(found.by_ref().take(products.len()));
        let roots = roots.filter(|(_, multiple)| !multiple.is_zero()).collect();
        Some(Number { above, roots, below: found.next()? })
    }

    /// Coefficients over a common denominator.
    pub fn coefficients(
        &self,
        mut names: Vec<Formula>,
        numbers: &[Vec<(Vec<u32>, Number)>],
    ) -> PrimitiveVector {
        let all = || numbers.iter().flatten().map(|(_, own)| own);
        let below = all().fold(BigInt::one(), |lcm, own| lcm.lcm(&own.below));
        let is_used =
            |root: &usize| all().any(|own| own.roots.iter().any(|(used, _)| used.contains(root)));
        let used: Vec<usize> = (0..self.names.len()).filter(is_used).collect();
        names.extend(used.iter().map(|root| self.names[*root].clone()));
        let part = |(monomial, own): &(Vec<u32>, Number)| {
            let scale = &below / &own.below;
            let powers = |of: &[usize]| -> Vec<u32> {
                let extra = used.iter().map(|root| u32::from(of.contains(root)));
                monomial.iter().copied().chain(extra).collect()
            };
            let mut terms = vec![(powers(&[]), &own.above * &scale)];
            let roots = own.roots.iter();
            terms.extend(roots.map(|(product, multiple)| (powers(product), multiple * &scale)));
            terms.retain(|(_, value)| !value.is_zero());
            terms
        };
        let polynomials = numbers.iter().map(|own| own.iter().flat_map(part).collect()).collect();
        PrimitiveVector { names, polynomials }
    }
}

/// A number modulo the product of some primes.
struct Residue {
    value: BigInt,
    modulus: BigInt,
}

impl Default for Residue {
    fn default() -> Self {
        Self { value: BigInt::ZERO, modulus: BigInt::one() }
    }
}

impl Residue {
    /// Takes up the image modulo a further prime.
    fn add(&mut self, image: &BigInt, prime: &BigInt) -> Option<()> {
        let inverse = self.modulus.modinv(prime)?;
        let missing = ((image - &self.value) * inverse).mod_floor(prime);
        self.value += &self.modulus * missing;
        self.modulus *= prime;
        Some(())
    }
}

/// Whether coefficients with roots are looked for with this number of primes, 1, 2, 3, 4, 6, 8, 12, …:
/// the reduction of a lattice takes a time that grows with its third power.
fn is_tried(primes: usize) -> bool {
    primes.is_power_of_two() || (primes.is_multiple_of(3) && (primes / 3).is_power_of_two())
}

/// Finds coefficients that are numbers, confirmed modulo one further prime.
pub fn numbers(source: &dyn Vectors) -> Option<PrimitiveVector> {
    let roots = Roots::of(source.names(), source.multiplies_roots());
    let mut seen: Vec<(PrimePoint, Vec<u64>)> = Vec::new();
    for prime in 0..PRIMES {
        let found = (0..BARREN).find_map(|index| source.image(prime, index));
        let Some((at, vector)) = found else { continue };
        if seen.iter().any(|(other, _)| other.modulus.prime() == at.modulus.prime()) {
            continue;
        }
        if !seen.is_empty() {
            let tries_roots = is_tried(seen.len());
            let number = |column: usize| {
                let images: Vec<(&PrimePoint, u64)> =
                    seen.iter().map(|(at, own)| (at, own[column])).collect();
                let agrees = |own: &Number| own.has_image(&roots, &at, vector[column]);
                let plain = rational(&images).filter(agrees);
                let with_roots = || roots.number(&images).filter(agrees);
                plain.or_else(|| if tries_roots { with_roots() } else { None })
            };
            let columns: Option<Vec<Number>> = (0..source.width()).map(number).collect();
            if let Some(columns) = columns {
                let polynomial = |own: Number| match own.is_zero() {
                    true => Vec::new(),
                    false => vec![(Vec::new(), own)],
                };
                let numbers: Vec<Vec<_>> = columns.into_iter().map(polynomial).collect();
                return Some(roots.coefficients(Vec::new(), &numbers).reduced());
            }
        }
        seen.push((at, vector));
    }
    None
}

/// Finds the fraction with these images modulo different primes.
fn rational(images: &[(&PrimePoint, u64)]) -> Option<Number> {
    let mut residue = Residue::default();
    for (at, image) in images {
        let own = BigInt::from(at.modulus.to_integer(*image));
        residue.add(&own, &BigInt::from(at.modulus.prime()))?;
    }
    let (above, below) = fraction(&residue.value, &residue.modulus)?;
    Some(Number::fraction(above, below))
}

/// Finds the fraction with numerator and denominator below √(M/2) and this residue.
pub fn fraction(residue: &BigInt, modulus: &BigInt) -> Option<(BigInt, BigInt)> {
    let bound = (modulus / 2u32).sqrt();
    let mut previous = (modulus.clone(), BigInt::ZERO);
    let mut current = (residue.clone(), BigInt::one());
    while current.0 > bound {
        let quotient = &previous.0 / &current.0;
        let next = (&previous.0 - &quotient * &current.0, &previous.1 - &quotient * &current.1);
        (previous, current) = (current, next);
    }
    let (above, below) = if current.1.is_negative() { (-current.0, -current.1) } else { current };
    (!below.is_zero() && below <= bound).then_some((above, below))
}
