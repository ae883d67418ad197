//! Quadrics with rational coefficients that meet an axis at a rational point.

use crate::number::exact::square_root;
use crate::number::rational::Rational;

/// F(x) = c + (b,x) + (x,Ax) with rational coefficients.
pub struct Quadric {
    /// Constant term c.
    pub constant: Rational,
    /// Linear coefficients b.
    pub slopes: Vec<Rational>,
    /// Matrix 2A of second derivatives.
    pub bends: Vec<Vec<Rational>>,
}

impl Quadric {
    /// Whether the quadric is irreducible: its matrix in homogeneous coordinates is regular, and
    /// larger than that of a pair of points.
    pub fn is_irreducible(&self) -> bool {
        let n = self.slopes.len();
        let two = Rational::from(2);
        let mut rows: Vec<Vec<Rational>> = Vec::new();
        for (row, slope) in self.bends.iter().zip(&self.slopes) {
            rows.push(row.iter().cloned().chain([slope.clone()]).collect());
        }
        let last = self.slopes.iter().cloned().chain([&self.constant * &two]);
        rows.push(last.collect());
        n >= 2 && !determinant_vanishes(rows)
    }

    /// Whether the quadric is bounded: its quadratic form is definite.
    pub fn is_bounded(&self) -> bool {
        let mut rows = self.bends.clone();
        let mut signs: Vec<bool> = Vec::new();
        for column in 0..rows.len() {
            signs.push(rows[column][column].is_negative());
            if clear_below(&mut rows, column).is_none() {
                return false;
            }
        }
        signs.windows(2).all(|pair| pair[0] == pair[1])
    }

    /// Finds the lower intersection with an axis, if it is rational and the slope there is not 0.
    pub fn on_axis(&self, axis: usize) -> Option<Rational> {
        let (a, b) = (&self.bends[axis][axis], &self.slopes[axis]);
        // a x²/2 + b x + c = 0
        let two = Rational::from(2);
        let discriminant = &(b * b) - &(&(a * &two) * &self.constant);
        let root = square_root(&discriminant).filter(|root| !root.is_zero())?;
        let below = a.recip()?;
        let sign = if a.is_negative() { Rational::from(-1) } else { Rational::from(1) };
        Some(&(&-b - &(&root * &sign)) * &below)
    }
}

/// Whether a square matrix is singular, tested by elimination.
fn determinant_vanishes(mut rows: Vec<Vec<Rational>>) -> bool {
    let n = rows.len();
    for column in 0..n {
        let Some(found) = (column..n).find(|row| !rows[*row][column].is_zero()) else {
            return true;
        };
        rows.swap(column, found);
        if clear_below(&mut rows, column).is_none() {
            return true;
        }
    }
    false
}

/// Subtracts multiples of a row from those below it, so that their entries in its column become 0;
/// `None` if its own entry there is 0.
fn clear_below(rows: &mut [Vec<Rational>], column: usize) -> Option<()> {
    let (above, below) = rows.split_at_mut(column + 1);
    let pivot = &above[column];
    let inverse = pivot[column].recip()?;
    for row in below {
        let factor = &row[column] * &inverse;
        for (entry, above) in row.iter_mut().zip(pivot).skip(column) {
            *entry = &*entry - &(&factor * above);
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quadric(constant: i64, slopes: &[i64], bends: &[&[i64]]) -> Quadric {
        let number = |n: &i64| Rational::from(*n);
        Quadric {
            constant: Rational::from(constant),
            slopes: slopes.iter().map(number).collect(),
            bends: bends.iter().map(|row| row.iter().map(number).collect()).collect(),
        }
    }

    #[test]
    fn spheres_and_hyperbolas_are_irreducible() {
        let sphere = quadric(-4, &[0, 0, 0], &[&[2, 0, 0], &[0, 2, 0], &[0, 0, 2]]);
        assert!(sphere.is_irreducible(), "x² + y² + z² = 4");
        assert!(sphere.is_bounded(), "x² + y² + z² = 4");
        assert_eq!(sphere.on_axis(2), Some(Rational::from(-2)), "the lower pole");
        let hyperbola = quadric(-1, &[0, 0], &[&[2, 0], &[0, -2]]);
        assert!(hyperbola.is_irreducible(), "x² − y² = 1");
        assert!(!hyperbola.is_bounded(), "x² − y² = 1");
        let crossed = quadric(-1, &[0, 0], &[&[2, 3], &[3, 2]]);
        assert!(!crossed.is_bounded(), "x² + 3xy + y² = 1 is a hyperbola");
        assert_eq!(hyperbola.on_axis(0), Some(Rational::from(-1)));
        assert_eq!(hyperbola.on_axis(1), None, "−y² = 1 has no real root");
        let lines = quadric(0, &[0, 0], &[&[2, 0], &[0, -2]]);
        assert!(!lines.is_irreducible(), "x² = y² are two lines");
        let points = quadric(-1, &[0], &[&[2]]);
        assert!(!points.is_irreducible(), "x² = 1 are two points");
        let shifted = quadric(0, &[-2, 0], &[&[2, 0], &[0, 2]]);
        assert_eq!(shifted.on_axis(0), Some(Rational::from(0)), "x² − 2x + y² = 0");
        let surd = quadric(-2, &[0, 0], &[&[2, 0], &[0, 2]]);
        assert_eq!(surd.on_axis(0), None, "x² + y² = 2 meets no axis in a rational point");
    }
}
