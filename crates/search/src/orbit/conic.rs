//! Conics in the space of states with sines and cosines, or with exponentials and their inverses.
//!
//! On c² + s² = 1 and on e f = 1 lie the curves with c + i s, or e, equal to a (t − α)/(t − β). With
//! other variables (x₀ + x₁ t + x₂ t²)/D, D = (t − α)(t − β), all are fractions over D.

use liouville::number::prime::Modulus;

/// The part of a variable in the relations between functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConicRole {
    /// A variable that no relation binds.
    Free,
    /// A sine, whose cosine is the next variable.
    Sine,
    /// The cosine of the sine before.
    Cosine,
    /// An exponential.
    Exponential,
    /// The inverse of the exponential with this number.
    InverseOf(usize),
}

/// The relations between all variables, each circles or hyperbolas.
#[derive(Clone, Debug)]
pub struct ConicShape(pub Vec<ConicRole>);

/// A conic.
pub struct Conic {
    /// Coefficients of the variables' numerators.
    above: Vec<[u64; 3]>,
    /// Zeros α and β of the denominator.
    pub poles: [u64; 2],
}

impl ConicShape {
    /// Makes a conic from two lists of random numbers; `None` in a field without a root of −1.
    pub fn draw(&self, m: &Modulus, first: &[u64], second: &[u64]) -> Option<Conic> {
        let poles = [first.first()?, second.first()?].map(|own| *own);
        if poles[0] == poles[1] {
            return None;
        }
        let root = m.root(m.sub(0, m.one()))?;
        let half = m.inverse(m.integer(2));
        // (t − α)²
        let square = |pole: u64| {
            let double = m.mul(m.integer(2), pole);
            [m.mul(pole, pole), m.sub(0, double), m.one()]
        };
        let [upper, lower] = poles.map(square);
        let scaled = |own: [u64; 3], factor: u64| own.map(|entry| m.mul(entry, factor));
        let sum = |a: [u64; 3], b: [u64; 3]| [0, 1, 2].map(|k: usize| m.add(a[k], b[k]));
        let scale = |k: usize| m.add(m.mul(first[k], first[k]), m.integer(3));
        let above = |(k, role): (usize, &ConicRole)| {
            let sides = |k: usize| {
                let own = scale(k);
                (own != 0).then(|| (scaled(upper, own), scaled(lower, m.inverse(own))))
            };
            Some(match role {
                ConicRole::Free => {
                    [first[k], second[k], m.add(first[k], m.mul(second[k], scale(k)))]
                }
                ConicRole::Cosine => {
                    let (plus, minus) = sides(k.checked_sub(1)?)?;
                    scaled(sum(plus, minus), half)
                }
                ConicRole::Sine => {
                    let (plus, minus) = sides(k)?;
                    let turned = m.mul(half, m.inverse(root));
                    scaled(sum(plus, scaled(minus, m.sub(0, m.one()))), turned)
                }
                ConicRole::Exponential => sides(k)?.0,
                ConicRole::InverseOf(other) => sides(*other)?.1,
            })
        };
        let above = self.0.iter().enumerate().map(above).collect::<Option<_>>()?;
        Some(Conic { above, poles })
    }
}

impl Conic {
    /// Denominator at a place.
    pub fn below(&self, m: &Modulus, place: u64) -> u64 {
        let [first, second] = self.poles.map(|pole| m.sub(place, pole));
        m.mul(first, second)
    }

    /// State at a place that is no pole.
    pub fn state(&self, m: &Modulus, place: u64) -> Vec<u64> {
        let below = m.inverse(self.below(m, place));
        let value = |[a, b, c]: &[u64; 3]| {
            m.mul(below, m.add(*a, m.mul(place, m.add(*b, m.mul(place, *c)))))
        };
        self.above.iter().map(value).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_on_a_conic_satisfy_the_relations() {
        let m = super::super::primes::split(1, 1, &[])[0];
        let number = |k: u64| m.integer(k * k + 17);
        let (first, second): (Vec<u64>, Vec<u64>) =
            (0..6).map(|k| (number(k), number(k + 40))).unzip();
        use ConicRole::{Cosine, Exponential, Free, InverseOf, Sine};
        let shape = ConicShape(vec![Free, Sine, Cosine, Exponential, InverseOf(3), Free]);
        let conic = shape.draw(&m, &first, &second).expect("a conic");
        for place in 0..5 {
            let x = conic.state(&m, m.integer(place));
            assert_eq!(m.add(m.mul(x[1], x[1]), m.mul(x[2], x[2])), m.one(), "sin² + cos²");
            assert_eq!(m.mul(x[3], x[4]), m.one(), "e^u e^(−u)");
            assert_ne!(x[0], x[5]);
        }
    }
}
