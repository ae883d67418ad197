//! Frames: vectors of which all products with each other are given numbers, as the columns of an
//! orthogonal matrix. They are made by reflections, without roots of what is drawn.

use num_dual::DualNum;
use num_traits::{One, Zero};

use super::derivatives::{EquationDerivatives, members};
use super::equation::Equation;
use super::quadric::Quadric;
use crate::graph::Expr;
use crate::mechanics::{Half, Model};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Vectors of ℝⁿ, at most n, whose Gram matrix is a given definite one.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Equations of the products, in any order.
    pub equations: Vec<Equation>,
    /// Components of the state that each vector consists of.
    pub vectors: Vec<Vec<usize>>,
    /// Rows of a lower triangular matrix L up to the diagonal, which is 1.
    lower: Vec<Vec<Rational>>,
    /// Positive numbers D: the Gram matrix is L D Lᵀ.
    squares: Vec<Rational>,
    /// Half of the level in which a basis lies, if the file chooses one.
    pub half: Option<Half>,
}

/// An equation (x,x) = c or (x,y) = c.
enum Product {
    Square { vector: Vec<usize>, value: Rational },
    Pair { places: Vec<(usize, usize)>, value: Rational },
}

impl Product {
    fn of(derivatives: &EquationDerivatives) -> Option<Self> {
        let components = members(derivatives.contained());
        let Quadric { constant, slopes, bends } = derivatives.quadric(&components)?;
        if !slopes.iter().all(Rational::is_zero) {
            return None;
        }
        let partner = |row: &Vec<Rational>| {
            let mut found = (0..row.len()).filter(|k| !row[*k].is_zero());
            found.next().filter(|_| found.next().is_none())
        };
        let partners: Vec<usize> = bends.iter().map(partner).collect::<Option<_>>()?;
        let entries = || bends.iter().zip(&partners).map(|(row, k)| &row[*k]);
        let factor = entries().next().filter(|first| entries().all(|entry| entry == *first))?;
        let ratio = -&(&constant * &factor.recip()?);
        if partners.iter().enumerate().all(|(k, partner)| k == *partner) {
            return Some(Product::Square {
                vector: components,
                value: &ratio * &Rational::from(2),
            });
        }
        if partners.iter().enumerate().any(|(k, partner)| k == *partner) {
            return None;
        }
        let both = partners.iter().enumerate().filter(|(k, partner)| k < partner);
        let places = both.map(|(k, partner)| (components[k], components[*partner])).collect();
        Some(Product::Pair { places, value: ratio })
    }
}

/// A vector with the equation of its square.
struct Leg {
    vector: Vec<usize>,
    value: Rational,
    equation: Equation,
}

impl Frame {
    /// Finds frames of two vectors or more among equations.
    pub fn all(equations: &[EquationDerivatives]) -> Vec<Self> {
        let (mut legs, mut pairs): (Vec<Leg>, Vec<_>) = (Vec::new(), Vec::new());
        for derivatives in equations {
            let equation = derivatives.equation;
            match Product::of(derivatives) {
                Some(Product::Square { vector, value }) => {
                    legs.push(Leg { vector, value, equation });
                }
                Some(Product::Pair { places, value }) => pairs.push((places, value, equation)),
                None => {}
            }
        }
        let mut frames = Vec::new();
        while !legs.is_empty() {
            let first = legs.remove(0);
            let start = first.vector.clone();
            let mut own = vec![first];
            // The order of components in the first vector is that in all.
            let products = |own: &[Leg], next: &[usize]| {
                let product = |leg: &Leg| {
                    pairs.iter().find(|(places, _, _)| are_partners(places, &leg.vector, next))
                };
                let found = own.iter().map(product).collect::<Option<Vec<_>>>()?;
                Some(found.into_iter().map(|(_, value, equation)| (value.clone(), *equation)))
            };
            let (mut rows, mut taken) = (vec![vec![own[0].value.clone()]], vec![own[0].equation]);
            legs.retain(|leg| {
                let order = pairs.iter().find_map(|(places, _, _)| ordered(places, &start, leg));
                let Some(vector) = order else { return true };
                let Some(found) = products(&own, &vector) else { return true };
                let (values, equations): (Vec<Rational>, Vec<Equation>) = found.unzip();
                rows.push([values, vec![leg.value.clone()]].concat());
                taken.extend(equations.into_iter().chain([leg.equation]));
                own.push(Leg { vector, value: leg.value.clone(), equation: leg.equation });
                false
            });
            let vectors: Vec<Vec<usize>> = own.into_iter().map(|leg| leg.vector).collect();
            if vectors.len() > 1
                && vectors.len() <= start.len()
                && let Some((lower, squares)) = factors(&rows)
            {
                frames.push(Frame { equations: taken, vectors, lower, squares, half: None });
            }
        }
        frames
    }

    /// Whether the vectors are a basis: the last one is then one of two.
    pub fn is_basis(&self) -> bool {
        self.vectors.len() == self.vectors[0].len()
    }

    /// Whether the last vector may be either of two.
    pub fn has_sign(&self) -> bool {
        self.is_basis() && self.half.is_none()
    }

    /// Chooses the half of the level that a file asks for.
    pub fn oriented(self, model: &Model) -> Self {
        let half = model
            .orientations
            .iter()
            .map(|own| &own.half)
            .find(|half| half.vectors == self.vectors);
        Self { half: half.cloned(), ..self }
    }

    /// Returns the sign by which a basis has a determinant of this sign.
    ///
    /// The unit vectors e_n, …, e₁ and n - 1 reflections make it ±1.
    pub fn sign_of(&self, is_positive: bool) -> Expr {
        let size = self.vectors.len();
        let is_odd = (size * size.saturating_sub(1) / 2 + size.saturating_sub(1)) % 2 == 1;
        if is_positive == is_odd { -Expr::one() } else { Expr::one() }
    }

    /// Returns the components from whose draws the vectors are made.
    pub fn drawn(&self) -> impl Iterator<Item = usize> {
        let own = self.vectors.iter().enumerate();
        own.flat_map(|(k, vector)| vector[..vector.len() - k - 1].iter().copied())
    }

    /// Puts the vectors in the place of what was drawn; `sign` chooses the last one of a basis.
    ///
    /// The reflection H of d = (u, 1, 0, …, 0), with u drawn, takes the last unit vector e of
    /// the space that is left to any vector but itself, and what is orthogonal to e to what is
    /// orthogonal to He.
    pub fn make(&self, state: &mut [Expr], sign: Option<Expr>) {
        let size = self.vectors[0].len();
        let mut reflections: Vec<(Vec<Expr>, Expr)> = Vec::new();
        let mut orthonormal: Vec<Vec<Expr>> = Vec::new();
        for (k, vector) in self.vectors.iter().enumerate() {
            let last = size - k - 1;
            let mut own = vec![Expr::zero(); size];
            own[last] = match last {
                0 => match &self.half {
                    Some(half) => self.sign_of(half.is_positive),
                    None => sign.unwrap_or_else(Expr::one),
                },
                _ => Expr::one(),
            };
            if last > 0 {
                let mut along: Vec<Expr> =
                    vector[..last].iter().map(|component| state[*component]).collect();
                along.push(Expr::one());
                let square = along.iter().fold(Expr::zero(), |sum, x| sum + *x * *x);
                reflections.push((along, Expr::from(2.0) / square));
            }
            for (along, factor) in reflections.iter().rev() {
                let products = along.iter().zip(&own).map(|(a, b)| *a * *b);
                let length = *factor * products.fold(Expr::zero(), |sum, x| sum + x);
                own.iter_mut().zip(along).for_each(|(x, d)| *x -= length * *d);
            }
            orthonormal.push(own);
        }
        let lengths: Vec<Expr> =
            self.squares.iter().map(|square| Expr::rational(square).sqrt()).collect();
        for (vector, row) in self.vectors.iter().zip(&self.lower) {
            for (place, component) in vector.iter().enumerate() {
                let terms = row.iter().zip(&lengths).zip(&orthonormal);
                state[*component] = terms.fold(Expr::zero(), |sum, ((factor, length), own)| {
                    sum + Expr::rational(factor) * *length * own[place]
                });
            }
        }
    }
}

/// Orders a vector like another one by the places of their product.
fn ordered(places: &[(usize, usize)], first: &[usize], leg: &Leg) -> Option<Vec<usize>> {
    let partner = |component: &usize| {
        let mut own = places.iter().filter_map(|(a, b)| match component {
            c if c == a => Some(*b),
            c if c == b => Some(*a),
            _ => None,
        });
        own.next().filter(|partner| leg.vector.contains(partner))
    };
    let found: Vec<usize> = first.iter().map(partner).collect::<Option<_>>()?;
    (places.len() == first.len() && leg.vector.len() == first.len()).then_some(found)
}

/// Whether a product pairs components at the same places of two vectors.
fn are_partners(places: &[(usize, usize)], one: &[usize], other: &[usize]) -> bool {
    places.len() == one.len()
        && one.iter().zip(other).all(|(a, b)| places.contains(&(*a.min(b), *a.max(b))))
}

/// Writes a Gram matrix, given by its rows up to the diagonal, as L D Lᵀ; `None` unless it is
/// definite.
fn factors(gram: &[Vec<Rational>]) -> Option<(Vec<Vec<Rational>>, Vec<Rational>)> {
    let (mut lower, mut squares): (Vec<Vec<Rational>>, Vec<Rational>) = (Vec::new(), Vec::new());
    for given in gram {
        let mut row: Vec<Rational> = Vec::new();
        let rest = |row: &[Rational], other: &[Rational], value: &Rational| {
            let terms = row.iter().zip(other).zip(&squares);
            terms.fold(value.clone(), |rest, ((a, b), square)| &rest - &(&(a * b) * square))
        };
        for (k, value) in given[..given.len() - 1].iter().enumerate() {
            let entry = rest(&row, &lower[k][..k], value);
            row.push(&entry * &squares[k].recip()?);
        }
        let square = rest(&row, &row, given.last()?);
        if square.is_zero() || square.is_negative() {
            return None;
        }
        squares.push(square);
        row.push(Rational::from(1));
        lower.push(row);
    }
    Some((lower, squares))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(given: &[&[i64]]) -> Vec<Vec<Rational>> {
        let row = |row: &&[i64]| row.iter().map(|n| Rational::from(*n)).collect();
        given.iter().map(row).collect()
    }

    #[test]
    fn definite_matrices_have_factors() {
        let (lower, squares) = factors(&rows(&[&[4], &[2, 5], &[0, 4, 9]])).expect("definite");
        let half = Rational::new(1, 2);
        assert_eq!(lower[1], [half.clone(), Rational::from(1)]);
        assert_eq!(squares, rows(&[&[4, 4, 5]])[0]);
        assert_eq!(lower[2], [Rational::from(0), Rational::from(1), Rational::from(1)]);
        assert!(factors(&rows(&[&[1], &[1, 1]])).is_none(), "one vector twice");
        assert!(factors(&rows(&[&[1], &[2, 1]])).is_none(), "no angle has the cosine 2");
        assert!(factors(&rows(&[&[-1], &[0, 1]])).is_none(), "no vector has the square -1");
    }
}
