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

/// The relations between all variables.
#[derive(Clone, Debug)]
pub enum ConicShape {
    /// Circles and hyperbolas of functions.
    Functions(Vec<ConicRole>),
    /// A sphere of some variables.
    Sphere(Vec<usize>),
}

/// A conic.
pub struct Conic {
    /// Coefficients of the variables' numerators.
    above: Vec<[u64; 3]>,
    /// Zeros α and β of the denominator.
    pub poles: [u64; 2],
}

impl ConicShape {
    /// Makes a conic from two lists of random numbers, of a sphere from two of its points; `None` in a field
    /// without a root of −1.
    pub fn draw(&self, m: &Modulus, first: &[u64], second: &[u64]) -> Option<Conic> {
        match self {
            ConicShape::Functions(roles) => of_functions(roles, m, first, second),
            ConicShape::Sphere(block) => on_sphere(block, m, first, second),
        }
    }
}

/// A conic on circles and hyperbolas.
fn of_functions(roles: &[ConicRole], m: &Modulus, first: &[u64], second: &[u64]) -> Option<Conic> {
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
            ConicRole::Free => [first[k], second[k], m.add(first[k], m.mul(second[k], scale(k)))],
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
    let above = roles.iter().enumerate().map(above).collect::<Option<_>>()?;
    Some(Conic { above, poles })
}

/// The conic a (t − α)/(t − β) + b + c (t − β)/(t − α) on a sphere, with a, b, c orthogonal, (a, a) = (c, c) = 0 and
/// (b, b) + 2 (a, c) the square of the radius.
fn on_sphere(block: &[usize], m: &Modulus, first: &[u64], second: &[u64]) -> Option<Conic> {
    let root = m.root(m.sub(0, m.one()))?;
    let double = |x: u64| m.add(x, x);
    let product =
        |x: &[u64], y: &[u64]| x.iter().zip(y).fold(0, |sum, (a, b)| m.add(sum, m.mul(*a, *b)));
    let sum = |x: &[u64], y: &[u64], factor: u64| -> Vec<u64> {
        x.iter().zip(y).map(|(a, b)| m.add(*a, m.mul(factor, *b))).collect()
    };
    let of = |all: &[u64]| -> Vec<u64> { block.iter().map(|k| all[*k]).collect() };
    let (own, other) = (of(first), of(second));
    // (2u, (u, u) − 1, i ((u, u) + 1)) for any u.
    let isotropic = |all: &[u64], root: u64| -> Vec<u64> {
        let free = &all[..all.len() - 2];
        let square = product(free, free);
        let last = [m.sub(square, m.one()), m.mul(root, m.add(square, m.one()))];
        free.iter().map(|x| double(*x)).chain(last).collect()
    };
    let (a, c) = (isotropic(&own, root), isotropic(&other, m.sub(0, root)));
    let both = product(&a, &c);
    let scale = (both != 0).then(|| m.inverse(both))?;
    let across = sum(&sum(&own, &a, m.sub(0, m.mul(scale, product(&own, &c)))), &c, {
        m.sub(0, m.mul(scale, product(&own, &a)))
    });
    let rest = m.sub(product(&own, &own), product(&across, &across));
    let c = sum(&vec![0; c.len()], &c, m.mul(rest, m.mul(scale, m.inverse(m.integer(2)))));
    let poles = [first.first()?, second.first()?].map(|own| m.add(*own, m.integer(3)));
    if poles[0] == poles[1] {
        return None;
    }
    let [upper, lower] = poles.map(|pole| [m.mul(pole, pole), m.sub(0, double(pole)), m.one()]);
    let middle = [m.mul(poles[0], poles[1]), m.sub(0, m.add(poles[0], poles[1])), m.one()];
    let above = |k: usize| match block.iter().position(|own| *own == k) {
        Some(place) => [0, 1, 2].map(|power: usize| {
            let parts = [(a[place], upper), (across[place], middle), (c[place], lower)];
            parts.iter().fold(0, |sum, (x, own)| m.add(sum, m.mul(*x, own[power])))
        }),
        None => [first[k], second[k], m.add(first[k], m.mul(second[k], second[k]))],
    };
    Some(Conic { above: (0..first.len()).map(above).collect(), poles })
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
        let roles = vec![Free, Sine, Cosine, Exponential, InverseOf(3), Free];
        let shape = ConicShape::Functions(roles);
        let conic = shape.draw(&m, &first, &second).expect("a conic");
        for place in 0..5 {
            let x = conic.state(&m, m.integer(place));
            assert_eq!(m.add(m.mul(x[1], x[1]), m.mul(x[2], x[2])), m.one(), "sin² + cos²");
            assert_eq!(m.mul(x[3], x[4]), m.one(), "e^u e^(−u)");
            assert_ne!(x[0], x[5]);
        }
    }

    #[test]
    fn states_on_a_conic_are_on_the_sphere() {
        let m = super::super::primes::split(1, 1, &[])[0];
        for block in [vec![0, 1], vec![1, 2, 4], vec![0, 1, 2, 3, 4]] {
            let point =
                |step: u64| -> Vec<u64> { (1..6).map(|k| m.integer(k * k + step)).collect() };
            let (first, second) = (point(3), point(20));
            let square =
                |x: &[u64]| block.iter().fold(0, |sum, k: &usize| m.add(sum, m.mul(x[*k], x[*k])));
            let conic =
                ConicShape::Sphere(block.clone()).draw(&m, &first, &second).expect("a conic");
            let states: Vec<Vec<u64>> = (0..4).map(|t| conic.state(&m, m.integer(t))).collect();
            assert!(states.iter().all(|x| square(x) == square(&first)), "{block:?}");
            assert!(block.iter().all(|k| states[0][*k] != states[1][*k]), "{block:?} moves");
        }
    }
}
