//! Cells that bounds by squares exclude.
//!
//! Where m² − Σ q² is not negative, it is not if some q² are left out, and |q| ≤ |m|. So m + q > 0 fails nowhere inside, and −(m + q) > 0
//! everywhere, for a monomial m that is not negative. Intervals do not see it: m + q comes near 0 on
//! the way to the end, where all boxes contain it.

use crate::graph::{Graph, Step};
use crate::number::UnaryFunction;
use crate::number::exact::square_root;
use crate::number::rational::Rational;

use super::domain::Region;
use super::fact::SignFact;
use super::nested::variable;
use super::polynomial::{Polynomial, fraction};

/// Largest number of values that are known not to be negative, and of positive ones.
const MOST_VALUES: usize = 64;

impl Region<'_> {
    /// Whether the facts contradict a bound of a monomial by another.
    pub fn is_beyond_bounds(&self) -> bool {
        let read = |place: usize| polynomial(self.graph, place);
        let positive: Vec<Polynomial> = self
            .facts
            .iter()
            .filter(|(_, fact)| *fact == SignFact::Positive)
            .filter_map(|(place, _)| read(*place))
            .take(MOST_VALUES)
            .collect();
        if positive.is_empty() {
            return false;
        }
        let bounds = self.facts.iter().filter_map(|(place, _)| Some((*place, read(*place)?)));
        bounds.take(MOST_VALUES).any(|(place, value)| {
            let bounds = self.bounds_of(place, &value);
            // X > 0 and X = −t F for F ≥ 0 and t ≥ 0.
            let excludes = |bound: &Polynomial, x: &Polynomial| {
                x.term_over(bound).is_some_and(|term| self.sign_of_term(&term) == Some(false))
            };
            bounds.iter().any(|bound| positive.iter().any(|x| excludes(bound, x)))
        })
    }

    /// Lists values m² − Σ q² and m ± q that are not negative where the value at a place is not.
    fn bounds_of(&self, place: usize, value: &Polynomial) -> Vec<Polynomial> {
        let Some(bound) = value.square_bound() else { return Vec::new() };
        let mut all = bound.differences();
        let (scale, whole) = bound.whole;
        let Some(is_positive) = self.sign_of_term(&whole) else { return all };
        let whole = whole.scaled(&Rational::from(if is_positive { 1 } else { -1 }));
        // √c m ± √c_k m_k, divided by √c.
        let ratio = |own: &Rational| square_root(&(own * &scale.recip()?));
        let mut parts: Vec<(Rational, Polynomial)> = bound.parts;
        let is_root = |(_, step): &(usize, Step<'_>)| matches!(step, Step::Unary(UnaryFunction::Sqrt, a) if *a == place);
        if let Some((root, _)) = self.graph.steps().enumerate().find(is_root) {
            parts.push((Rational::from(1), Polynomial::variable(root as u32)));
        }
        let both = |(own, part): (Rational, Polynomial)| {
            let part = part.scaled(&ratio(&own)?);
            Some([1, -1].map(|sign| whole.plus(&part.scaled(&Rational::from(sign)))))
        };
        all.extend(parts.into_iter().filter_map(both).flatten());
        all
    }

    /// Finds the sign of a term by those of its variables, where 0 counts as either.
    fn sign_of_term(&self, term: &Polynomial) -> Option<bool> {
        let (coefficient, exponents) = term.as_term()?;
        let odd = exponents.iter().filter(|(_, exponent)| exponent % 2 == 1);
        odd.into_iter().try_fold(!coefficient.is_negative(), |sign, (variable, _)| {
            Some(sign == self.sign(*variable as usize)?)
        })
    }
}

/// Reads the value at a place as a polynomial in inputs, roots and functions.
fn polynomial(graph: &Graph, place: usize) -> Option<Polynomial> {
    let given = |at: usize, step: Step<'_>| match step {
        Step::Input(_) => Some(Polynomial::variable(at as u32)),
        step => variable(at, step),
    };
    fraction(graph, place, &given)?.polynomial()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Expr, record};
    use crate::proof::classes::Classes;
    use crate::proof::extent::Extent;

    /// Whether facts contradict each other; the first input is positive, the others are any numbers.
    fn contradicts(build: impl FnOnce(&[Expr]) -> (Vec<Expr>, Vec<Expr>)) -> bool {
        let (graph, (bounds, positive)) = record(3, build).expect("records");
        let of = |values: Vec<Expr>, fact: SignFact| {
            values.into_iter().map(|value| (graph.place(value), fact)).collect::<Vec<_>>()
        };
        let facts = [of(bounds, SignFact::NotNegative), of(positive, SignFact::Positive)].concat();
        let inputs = [Extent::between(&Rational::from(1), &Rational::from(2))];
        let classes = &Classes::default();
        Region { graph: &graph, inputs: &inputs, facts: &facts, classes }.is_beyond_bounds()
    }

    #[test]
    fn coordinates_are_at_most_the_radius() {
        let disc = |x: &[Expr]| x[0] * x[0] - x[1] * x[1] - x[2] * x[2];
        assert!(contradicts(|x| (vec![disc(x)], vec![-x[0] - x[1]])), "−l − x > 0");
        assert!(contradicts(|x| (vec![disc(x)], vec![x[2] - x[0]])), "y − l > 0");
        assert!(contradicts(|x| (vec![disc(x)], vec![x[0] * x[2] * 2.0 - x[0] * x[0] * 2.0])));
        assert!(contradicts(|x| (vec![disc(x)], vec![disc(x).apply(UnaryFunction::Sqrt) - x[0]])));
        assert!(contradicts(|x| (vec![disc(x)], vec![x[2] * x[2] - x[0] * x[0]])), "y² > l²");
        assert!(!contradicts(|x| (
            vec![disc(x)],
            vec![x[2] * x[2] + x[1] * x[1] * 2.0 - x[0] * x[0]]
        )));
        assert!(!contradicts(|x| (vec![disc(x)], vec![x[0] - x[1]])), "l − x > 0");
        assert!(!contradicts(|x| (vec![disc(x)], vec![x[1] + x[2] - x[0]])), "x + y is larger");
        assert!(!contradicts(|x| (vec![-disc(x)], vec![-x[0] - x[1]])), "outside");
        assert!(!contradicts(|x| (vec![x[1] * x[1] - x[2] * x[2]], vec![-x[1] - x[2]])), "a sign");
        let double = |x: &[Expr]| x[0] * x[0] * 4.0 - x[1] * x[1];
        assert!(!contradicts(|x| (vec![double(x)], vec![-x[0] - x[1]])), "x may be −2l");
        assert!(contradicts(|x| (vec![double(x)], vec![-x[0] * 2.0 - x[1]])), "and no less");
    }
}
