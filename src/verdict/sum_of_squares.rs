//! Polynomials with rational coefficients as sums of squares Σ d (m + Σ c m')² of polynomials, d > 0.
//!
//! f = zᵀQz for monomials z, where the symmetric matrices Q with this property are an affine space. In f64 the one of
//! largest determinant is found by Newton's method, then it is rounded to short fractions in that space, and
//! Q = LDLᵀ is computed exactly: D > 0 proves the sum. A. Papachristodoulou, S. Prajna, On the construction of Lyapunov
//! functions using the sum of squares decomposition (2002), found Lyapunov functions in this way.

use std::collections::BTreeMap;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::number::rational::Rational;

/// Exponents of a monomial.
pub type Exponents = Vec<u32>;
/// A polynomial by its terms.
pub type Terms = Vec<(Rational, Exponents)>;

/// Largest number of monomials whose products are the terms.
const MOST_MONOMIALS: usize = 24;
/// Largest number of numbers that are chosen.
const MOST_FREE: usize = 160;
/// Largest number of steps of Newton's method.
const STEPS: usize = 80;
/// Largest pressure on the multiple of the unit matrix.
const MOST_PRESSURE: f64 = 1e9;
/// Denominators of the fractions to which numbers are rounded.
const DENOMINATORS: [i64; 10] = [1, 2, 3, 4, 6, 12, 60, 120, 1 << 10, 1 << 20];

/// A factor d > 0 and the polynomial whose square it multiplies.
pub type ScaledSquare = (Rational, Terms);

/// Finds a sum of squares; `None` if there is none inside the cone of all, or if it is too large.
pub fn sum_of_squares(terms: &[(Rational, Exponents)]) -> Option<Vec<ScaledSquare>> {
    let space = GramSpace::of(terms)?;
    let choice = space.center()?;
    let monomials = &space.monomials;
    DENOMINATORS.iter().find_map(|below| {
        let rounded = choice.iter().map(|x| {
            let above = (x * *below as f64).round();
            (above.abs() < 1e15).then(|| Rational::new(above as i64, *below))
        });
        let squares = decomposed(space.at(&rounded.collect::<Option<Vec<_>>>()?))?;
        let written = squares.into_iter().map(|(factor, row)| {
            let all = row.into_iter().zip(monomials);
            let own = all.filter(|(value, _)| !value.is_zero());
            (factor, own.map(|(value, monomial)| (value, monomial.clone())).collect())
        });
        Some(written.collect())
    })
}

/// Matrices Q with zᵀQz = f: one of them, and the directions in which the others are.
struct GramSpace {
    monomials: Vec<Exponents>,
    origin: Vec<Vec<Rational>>,
    /// Pairs of places: 1 is added at the first and its share is taken from the second.
    free: Vec<[(usize, usize); 2]>,
}

impl GramSpace {
    fn of(terms: &[(Rational, Exponents)]) -> Option<Self> {
        let given: BTreeMap<&Exponents, &Rational> =
            terms.iter().map(|(value, own)| (own, value)).collect();
        let mut monomials = halves(terms)?;
        // A square that no other product cancels has the coefficient of its term: not below 0, and 0 leaves it out.
        loop {
            let products = products(&monomials);
            let lone = |own: &Exponents| {
                let square: Exponents = own.iter().map(|power| 2 * power).collect();
                let is_given = given.contains_key(&square);
                !is_given && products.get(&square).is_some_and(|pairs| pairs.len() == 1)
            };
            let before = monomials.len();
            monomials.retain(|own| !lone(own));
            if monomials.len() == before {
                break;
            }
        }
        let products = products(&monomials);
        if monomials.is_empty() || given.keys().any(|own| !products.contains_key(*own)) {
            return None;
        }
        let size = monomials.len();
        let mut origin = vec![vec![Rational::from(0); size]; size];
        let mut free = Vec::new();
        for (product, pairs) in &products {
            let count: i64 = pairs.iter().map(|(i, j)| if i == j { 1 } else { 2 }).sum();
            if let Some(value) = given.get(product) {
                let share = *value * &Rational::new(1, count);
                for (i, j) in pairs {
                    origin[*i][*j] = share.clone();
                    origin[*j][*i] = share.clone();
                }
            }
            free.extend(pairs[1..].iter().map(|pair| [*pair, pairs[0]]));
        }
        (free.len() <= MOST_FREE).then_some(Self { monomials, origin, free })
    }

    /// The change of the second entry of a direction, where the first changes by 1.
    fn opposite([(i, j), (k, l)]: [(usize, usize); 2]) -> Rational {
        let weight = |a: usize, b: usize| if a == b { 1 } else { 2 };
        Rational::new(-weight(i, j), weight(k, l))
    }

    fn at(&self, choice: &[Rational]) -> Vec<Vec<Rational>> {
        let mut matrix = self.origin.clone();
        for (value, direction) in choice.iter().zip(&self.free) {
            let changes = [value.clone(), value * &Self::opposite(*direction)];
            for ((i, j), change) in direction.iter().zip(changes) {
                matrix[*i][*j] = &matrix[*i][*j] + &change;
                if i != j {
                    matrix[*j][*i] = matrix[*i][*j].clone();
                }
            }
        }
        matrix
    }

    /// The positive definite matrix of largest determinant, by its coordinates.
    fn center(&self) -> Option<Vec<f64>> {
        let size = self.monomials.len();
        let number = |value: &Rational| value.to_f64().0;
        let origin = DMatrix::from_fn(size, size, |i, j| number(&self.origin[i][j]));
        let mut directions: Vec<Direction> = self
            .free
            .iter()
            .map(|direction| {
                let changes = [1.0, number(&Self::opposite(*direction))];
                let pairs = direction.iter().zip(changes);
                let both = |((i, j), change): (&(usize, usize), f64)| {
                    let own = [(*i, *j, change), (*j, *i, change)];
                    own.into_iter().take(if i == j { 1 } else { 2 })
                };
                pairs.flat_map(both).collect()
            })
            .collect();
        // With a multiple of the unit matrix added there is a beginning; its factor is pressed below 0.
        let lowest = origin.clone().symmetric_eigenvalues().min();
        let mut point = vec![0.0; directions.len()];
        if lowest <= 0.0 {
            directions.push((0..size).map(|k| (k, k, 1.0)).collect());
            point.push(1.0 - 2.0 * lowest);
            let mut pressure = 1.0;
            loop {
                point = maximal(&origin, &directions, point, pressure)?;
                let factor = *point.last()?;
                if factor < 0.0 {
                    break;
                }
                // The least factor is at most this much smaller.
                if factor > size as f64 / pressure || pressure > MOST_PRESSURE {
                    return None;
                }
                pressure *= 8.0;
            }
            directions.pop();
            point.pop();
        }
        maximal(&origin, &directions, point, 0.0)
    }
}

/// Entries of a symmetric matrix that are not 0.
type Direction = Vec<(usize, usize, f64)>;

/// Maximizes ln det(Q + Σ x_k N_k) − p x_last by Newton's method.
fn maximal(
    origin: &DMatrix<f64>,
    directions: &[Direction],
    mut point: Vec<f64>,
    pressure: f64,
) -> Option<Vec<f64>> {
    let at = |point: &[f64]| {
        let mut sum = origin.clone();
        for (x, direction) in point.iter().zip(directions) {
            direction.iter().for_each(|(i, j, value)| sum[(*i, *j)] += value * x);
        }
        sum
    };
    let value = |own: &Cholesky<f64, Dyn>, point: &[f64]| {
        2.0 * own.l_dirty().diagonal().iter().map(|x| libm::log(*x)).sum::<f64>()
            - pressure * point.last().copied().unwrap_or_default()
    };
    let count = directions.len();
    let mut factored = Cholesky::new(at(&point))?;
    for _ in 0..STEPS {
        let inverse = factored.inverse();
        let mut slope = DVector::from_fn(count, |k, _| {
            directions[k].iter().map(|(i, j, value)| inverse[(*j, *i)] * value).sum::<f64>()
        });
        if let Some(last) = count.checked_sub(1) {
            slope[last] -= pressure;
        }
        // tr(Q⁻¹N Q⁻¹M)
        let product = |left: &Direction, right: &Direction| -> f64 {
            let of = |(i, j, a): &(usize, usize, f64)| {
                let terms = right.iter().map(|(k, l, b)| inverse[(*l, *i)] * inverse[(*j, *k)] * b);
                a * terms.sum::<f64>()
            };
            left.iter().map(of).sum()
        };
        let curvature =
            DMatrix::from_fn(count, count, |k, l| product(&directions[k], &directions[l]));
        let step = Cholesky::new(curvature)?.solve(&slope);
        if step.dot(&slope) < 1e-12 {
            break;
        }
        let before = value(&factored, &point);
        let mut length = 1.0;
        loop {
            let next: Vec<f64> = point.iter().zip(&step).map(|(x, own)| x + length * own).collect();
            if let Some(own) = Cholesky::new(at(&next)).filter(|own| value(own, &next) > before) {
                (point, factored) = (next, own);
                break;
            }
            length /= 2.0;
            if length < 1e-9 {
                return Some(point);
            }
        }
    }
    Some(point)
}

/// Monomials whose squares may be between the terms.
fn halves(terms: &[(Rational, Exponents)]) -> Option<Vec<Exponents>> {
    let variables = terms.first()?.1.len();
    let degree = |own: &Exponents| own.iter().sum::<u32>();
    let degrees = || terms.iter().map(|(_, own)| degree(own));
    let (least, most) = (degrees().min()?.div_ceil(2), degrees().max()? / 2);
    let highest = |k: usize| terms.iter().map(|(_, own)| own[k] / 2).max().unwrap_or(0);
    let lowest = |k: usize| terms.iter().map(|(_, own)| own[k].div_ceil(2)).min().unwrap_or(0);
    let mut all: Vec<Exponents> = vec![Vec::new()];
    for k in 0..variables {
        let longer = |own: Exponents| {
            (lowest(k)..=highest(k)).map(move |power| [own.clone(), vec![power]].concat())
        };
        all = all.into_iter().flat_map(longer).filter(|own| degree(own) <= most).collect();
        if all.len() > 40 * MOST_MONOMIALS {
            return None;
        }
    }
    all.retain(|own| degree(own) >= least);
    (all.len() <= MOST_MONOMIALS).then_some(all)
}

/// Pairs of monomials by their products.
fn products(monomials: &[Exponents]) -> BTreeMap<Exponents, Vec<(usize, usize)>> {
    let mut all: BTreeMap<Exponents, Vec<(usize, usize)>> = BTreeMap::new();
    for (i, a) in monomials.iter().enumerate() {
        for (j, b) in monomials.iter().enumerate().skip(i) {
            let product = a.iter().zip(b).map(|(x, y)| x + y).collect();
            all.entry(product).or_default().push((i, j));
        }
    }
    all
}

/// Q = Σ d l lᵀ with d > 0; `None` unless Q is positive definite.
fn decomposed(mut matrix: Vec<Vec<Rational>>) -> Option<Vec<(Rational, Vec<Rational>)>> {
    let size = matrix.len();
    let mut all = Vec::new();
    for k in 0..size {
        let pivot = matrix[k][k].clone();
        if pivot.is_negative() || pivot.is_zero() {
            return None;
        }
        let inverse = pivot.recip()?;
        let row: Vec<Rational> = (0..size)
            .map(|j| if j < k { Rational::from(0) } else { &matrix[k][j] * &inverse })
            .collect();
        for other in &mut matrix[k + 1..] {
            let factor = other[k].clone();
            for (entry, value) in other.iter_mut().zip(&row).skip(k + 1) {
                *entry = &*entry - &(&factor * value);
            }
        }
        all.push((pivot, row));
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn terms(own: &[(i64, [u32; 2])]) -> Terms {
        own.iter().map(|(value, powers)| (Rational::from(*value), powers.to_vec())).collect()
    }

    /// Multiplies a sum of squares out.
    fn multiplied_out(squares: &[ScaledSquare]) -> BTreeMap<Exponents, Rational> {
        let mut sum: BTreeMap<Exponents, Rational> = BTreeMap::new();
        for (factor, own) in squares {
            assert!(!factor.is_negative() && !factor.is_zero());
            for (a, left) in own {
                for (b, right) in own {
                    let powers: Exponents = left.iter().zip(right).map(|(x, y)| x + y).collect();
                    let value = sum.entry(powers).or_insert_with(|| Rational::from(0));
                    *value = &*value + &(&(a * b) * factor);
                }
            }
        }
        sum.retain(|_, value| !value.is_zero());
        sum
    }

    #[test]
    fn sums_of_squares_are_found_and_exact() {
        let positive = [
            terms(&[(1, [4, 0]), (1, [3, 1]), (1, [0, 4])]),
            terms(&[(1, [2, 0]), (1, [1, 1]), (1, [0, 2])]),
            terms(&[(2, [6, 0]), (-1, [3, 2]), (1, [0, 4]), (1, [2, 2])]),
            terms(&[(1, [0, 0]), (-1, [1, 0]), (1, [2, 0]), (1, [0, 2])]),
            terms(&[(5, [4, 0]), (2, [3, 1]), (-1, [2, 2]), (2, [0, 4])]),
        ];
        for own in positive {
            let found =
                sum_of_squares(&own).unwrap_or_else(|| panic!("{own:?} is a sum of squares"));
            let expected: BTreeMap<Exponents, Rational> =
                own.iter().map(|(value, powers)| (powers.clone(), value.clone())).collect();
            assert_eq!(multiplied_out(&found), expected, "{own:?}");
        }
    }

    #[test]
    fn what_is_negative_somewhere_is_no_sum_of_squares() {
        let others = [
            terms(&[(1, [4, 0]), (3, [3, 1]), (1, [0, 4])]),
            terms(&[(1, [2, 0]), (-3, [1, 1]), (1, [0, 2])]),
            terms(&[(1, [2, 0]), (1, [0, 3])]),
            terms(&[(-1, [2, 0])]),
            // Motzkin's polynomial is not negative, and no sum of squares.
            terms(&[(1, [4, 2]), (1, [2, 4]), (-3, [2, 2]), (1, [0, 0])]),
        ];
        for own in others {
            assert!(sum_of_squares(&own).is_none(), "{own:?}");
        }
    }
}
