//! Determinants and adjugates of small matrices of polynomials.

use liouville::number::rational::Rational;

use super::polynomial::RingPolynomial;
use super::reduction::Reduction;

/// Rows of a matrix.
pub type Rows = Vec<Vec<RingPolynomial>>;

impl Reduction {
    /// The determinant, along the first row.
    pub fn determinant(&self, rows: &Rows) -> Option<RingPolynomial> {
        let Some(first) = rows.first() else {
            return Some(RingPolynomial::constant(Rational::from(1)));
        };
        let mut sum = RingPolynomial::default();
        for (column, entry) in first.iter().enumerate().filter(|(_, entry)| !entry.is_zero()) {
            let minor = self.determinant(&without(rows, 0, column))?;
            let sign = Rational::from(if column % 2 == 0 { 1 } else { -1 });
            sum = sum.plus(&self.product(entry, &minor)?, &sign)?;
        }
        Some(sum)
    }

    /// The matrix of cofactors, transposed: A adj A = det A.
    pub fn adjugate(&self, rows: &Rows) -> Option<Rows> {
        let entry = |i: usize, j: usize| {
            let minor = self.determinant(&without(rows, j, i))?;
            let sign = Rational::from(if (i + j).is_multiple_of(2) { 1 } else { -1 });
            Some(minor.times_number(&sign))
        };
        let size = rows.len();
        (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
    }
}

fn without(rows: &Rows, row: usize, column: usize) -> Rows {
    let others = rows.iter().enumerate().filter(|(i, _)| *i != row);
    let kept = |own: &Vec<RingPolynomial>| -> Vec<RingPolynomial> {
        let entries = own.iter().enumerate().filter(|(j, _)| *j != column);
        entries.map(|(_, entry)| entry.clone()).collect()
    };
    others.map(|(_, own)| kept(own)).collect()
}
