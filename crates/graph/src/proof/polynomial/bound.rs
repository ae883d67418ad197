//! Polynomials that bound monomials by others.

use crate::number::rational::Rational;

use super::Polynomial;

/// The form c m² − Σ c_k m_k² of a polynomial, with positive numbers c and monomials m.
pub struct SquareBound {
    /// c and m.
    pub whole: (Rational, Polynomial),
    /// All c_k and m_k.
    pub parts: Vec<(Rational, Polynomial)>,
}

/// Largest number of squares of which all choices are left out.
const MOST_SQUARES: usize = 4;

impl SquareBound {
    /// Lists the polynomials c m² − Σ c_k m_k² with some squares, but not all, left out.
    pub fn differences(&self) -> Vec<Polynomial> {
        let square = |(value, root): &(Rational, Polynomial)| {
            Some(root.times(root, &mut { super::MOST_WORK })?.scaled(value))
        };
        let (Some(whole), Some(parts)) =
            (square(&self.whole), self.parts.iter().map(square).collect::<Option<Vec<_>>>())
        else {
            return Vec::new();
        };
        let kept = parts.len().min(MOST_SQUARES);
        let sets = 1u32..1 << kept;
        let difference = |set: u32| {
            let chosen = parts.iter().take(kept).enumerate().filter(|(k, _)| set >> k & 1 == 1);
            chosen.fold(whole.clone(), |rest, (_, part)| rest.plus(&part.negated()))
        };
        sets.map(difference).collect()
    }
}

impl Polynomial {
    /// Returns the polynomial in this form; `None` if it has another.
    pub fn square_bound(&self) -> Option<SquareBound> {
        let (mut whole, mut parts) = (None, Vec::new());
        for (monomial, value) in &self.terms {
            let root = Self { terms: [(monomial.root()?, Rational::from(1))].into() };
            if value.is_negative() {
                parts.push((-value, root));
            } else if whole.replace((value.clone(), root)).is_some() {
                return None;
            }
        }
        Some(SquareBound { whole: whole?, parts })
    }

    /// Returns the term t with p = t q.
    pub fn term_over(&self, other: &Self) -> Option<Self> {
        let ((own, value), (divisor, scale)) = (self.leading()?, other.leading()?);
        let factor = value * &scale.recip()?;
        let term = Self { terms: [(own.over(divisor)?, factor)].into() };
        let product = term.times(other, &mut { super::MOST_WORK })?;
        (product == *self).then_some(term)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_bound_squares() {
        let [x, y, z] = [0, 1, 2].map(Polynomial::variable);
        let square = |p: &Polynomial| p.times(p, &mut { 1000 }).expect("small");
        let minus = |p: &Polynomial| p.scaled(&Rational::from(-1));
        let bound = square(&x).plus(&minus(&square(&y))).plus(&minus(&square(&z)));
        let found = bound.square_bound().expect("x² − y² − z²");
        assert_eq!(found.whole, (Rational::from(1), x.clone()));
        assert_eq!(found.parts.len(), 2);
        assert!(square(&x).plus(&square(&y)).square_bound().is_none(), "two squares");
        assert!(minus(&square(&x)).square_bound().is_none(), "none");
        assert!(square(&x).plus(&minus(&y)).square_bound().is_none(), "y is no square");
        let sum = x.plus(&y);
        let product = minus(&z).times(&sum, &mut { 1000 }).expect("small");
        assert_eq!(product.term_over(&sum), Some(minus(&z)));
        assert_eq!(sum.term_over(&product), None);
    }
}
