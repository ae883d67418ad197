//! Polynomials in the parameters' coordinates, fitted modulo a prime.

use liouville::number::prime::Modulus;

/// A polynomial modulo the prime.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Coefficients that are not 0, by exponents.
    pub images: Vec<(Vec<u32>, u64)>,
    /// Degree.
    pub degree: u32,
}

impl Fitted {
    /// Makes a polynomial from coefficients.
    pub fn new(monomials: &[Vec<u32>], images: &[u64]) -> Self {
        let used = monomials.iter().zip(images).filter(|(_, image)| **image != 0);
        let images: Vec<(Vec<u32>, u64)> = used.map(|(a, image)| (a.clone(), *image)).collect();
        let degree = images.iter().map(|(a, _)| a.iter().sum()).max().unwrap_or(0);
        Self { images, degree }
    }

    /// Evaluates it at a point.
    pub fn evaluate(&self, m: &Modulus, point: &PointPowers) -> u64 {
        let terms = self.images.iter().map(|(a, image)| m.mul(*image, point.monomial(m, a)));
        terms.fold(0, |sum, term| m.add(sum, term))
    }

    /// Multiplies by another.
    pub fn times(&self, m: &Modulus, other: &Self) -> Self {
        let mut images: Vec<(Vec<u32>, u64)> = Vec::new();
        for (a, x) in &self.images {
            for (b, y) in &other.images {
                let exponents: Vec<u32> = a.iter().zip(b).map(|(a, b)| a + b).collect();
                let product = m.mul(*x, *y);
                match images.iter_mut().find(|(own, _)| *own == exponents) {
                    Some((_, image)) => *image = m.add(*image, product),
                    None => images.push((exponents, product)),
                }
            }
        }
        images.retain(|(_, image)| *image != 0);
        Self { images, degree: self.degree + other.degree }
    }

    /// Multiplies by a number.
    pub fn scaled(mut self, m: &Modulus, factor: u64) -> Self {
        self.images.iter_mut().for_each(|(_, image)| *image = m.mul(*image, factor));
        self
    }
}

/// Powers of the coordinates of a point, from the first power on.
pub struct PointPowers(Vec<Vec<u64>>);

impl PointPowers {
    /// Computes the powers up to the highest.
    pub fn of(m: &Modulus, point: &[u64], highest: u32) -> Self {
        let powers = |x: &u64| {
            let next = |last: &u64| Some(m.mul(*last, *x));
            std::iter::successors(Some(*x), next).take(highest as usize).collect()
        };
        Self(point.iter().map(powers).collect())
    }

    /// Evaluates a monomial, whose exponents are not above the highest.
    pub fn monomial(&self, m: &Modulus, exponents: &[u32]) -> u64 {
        let used = self.0.iter().zip(exponents).filter(|(_, exponent)| **exponent > 0);
        used.fold(m.one(), |product, (own, exponent)| m.mul(product, own[*exponent as usize - 1]))
    }
}
