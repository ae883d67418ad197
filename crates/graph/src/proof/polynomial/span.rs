//! Linear dependence of polynomials over the rational numbers.

use super::{Monomial, Polynomial};
use crate::number::rational::Rational;

/// Polynomials of which each has a leading monomial that the later ones do not contain.
#[derive(Clone, Debug, Default)]
pub struct Span {
    rows: Vec<(Monomial, Polynomial)>,
}

impl Span {
    /// Returns a polynomial less a combination of those of the span; 0 if it is one of them.
    pub fn rest(&self, polynomial: &Polynomial) -> Polynomial {
        let mut rest = polynomial.clone();
        for (head, row) in &self.rows {
            if let Some(value) = rest.terms.get(head).cloned() {
                rest = rest.plus(&row.scaled(&(&Rational::from(-1) * &value)));
            }
        }
        rest
    }

    /// Adds a polynomial.
    pub fn add(&mut self, polynomial: &Polynomial) {
        let rest = self.rest(polynomial);
        let row = rest
            .leading()
            .and_then(|(head, value)| Some((head.clone(), rest.scaled(&value.recip()?))));
        self.rows.extend(row);
    }
}
