//! Leading forms of polynomials in the variables of a field.
//!
//! If the leading forms of polynomials F₁, …, F_k of degrees d_i are algebraically independent, the
//! leading form of a polynomial Σ c_a F^a is that of its products with the largest Σ a_i d_i: it does
//! not cancel. So a polynomial of degree n in the variables is a polynomial in the F_i only if it is a
//! combination of products with Σ a_i d_i ≤ n.

use liouville::case::Case;
use liouville::formula::Formula;
use liouville::number::prime::Modulus;

use super::super::SearchError;
use super::super::products::DEGREE_PRIMES;
use super::gradients::{Gradients, Points, SCALES, Slopes};
use crate::echelon::Echelon;

/// Highest degree of a gradient that is recognised.
const MOST_DEGREE: usize = SCALES - 8;

/// Whether the leading forms of some formulas, as polynomials in the state, are proved algebraically
/// independent for generic parameters.
///
/// The gradient of F at s x is a polynomial in s whose leading coefficient is the gradient of the leading
/// form at x. If these are independent modulo primes that agree on the degrees, a minor of them is not 0.
/// Along a line that misses the origin the gradient of a fraction, a root or a modulus is no polynomial, as
/// that of y²/x is along the multiples of a point.
pub fn are_independent(case: &Case, formulas: &[Formula], seed: u64) -> Result<bool, SearchError> {
    let Some(mut gradients) = Gradients::of(case, formulas, seed)? else { return Ok(false) };
    let Some((slopes, modulus)) = gradients.next(Points::Line) else { return Ok(false) };
    let is_polynomial = |own: &[u64; SCALES]| {
        coefficients(own, &modulus).iter().skip(MOST_DEGREE + 1).all(|own| *own == 0)
    };
    if !slopes.iter().flatten().all(is_polynomial) {
        return Ok(false);
    }
    let mut degrees = None;
    for _ in 0..DEGREE_PRIMES {
        let Some((slopes, modulus)) = gradients.next(Points::Multiples) else { return Ok(false) };
        let Some(own) = leading(&slopes, &modulus) else { return Ok(false) };
        if degrees.as_ref().is_some_and(|degrees| *degrees != own) {
            return Ok(false);
        }
        degrees = Some(own);
    }
    Ok(true)
}

/// Degrees of the gradients, if they are polynomials whose leading coefficients are independent.
fn leading(slopes: &Slopes, m: &Modulus) -> Option<Vec<usize>> {
    let mut echelon = Echelon::new(slopes.first().map_or(0, Vec::len), *m);
    let mut degrees = Vec::new();
    for function in slopes {
        let along: Vec<Vec<u64>> = function.iter().map(|own| coefficients(own, m)).collect();
        let degree = (0..SCALES).rev().find(|n| along.iter().any(|own| own[*n] != 0))?;
        let is_new = echelon.push(along.iter().map(|own| own[degree]).collect());
        if degree > MOST_DEGREE || !is_new {
            return None;
        }
        degrees.push(degree);
    }
    Some(degrees)
}

/// Coefficients of the polynomial that has these values at 1, 2, 3, …, in Newton's form: the last that is
/// not 0 is the leading one.
fn coefficients(values: &[u64; SCALES], m: &Modulus) -> Vec<u64> {
    let mut differences = values.to_vec();
    for order in 1..SCALES {
        let inverse = m.inverse(m.integer(order as u64));
        for k in (order..SCALES).rev() {
            differences[k] = m.mul(m.sub(differences[k], differences[k - 1]), inverse);
        }
    }
    differences
}

#[cfg(test)]
mod tests {
    use super::super::gradients::tests::Turn;
    use super::*;

    #[test]
    fn only_independent_leading_forms_are_accepted() {
        let turn = Turn::with("1..2");
        let holds =
            |texts: &[&str]| are_independent(&turn.0, &turn.read(texts), 1).expect("an answer");
        assert!(holds(&["x^2 + y^2"]));
        assert!(holds(&["x^2 + y^2", "a*z + 1"]));
        assert!(holds(&["x^2 + y^2", "(x^2 + y^2)*z + x"]));
        assert!(!holds(&["x^2 + y^2", "(x^2 + y^2)^2 + z"]), "the square leads the second");
        assert!(!holds(&["x^2 + y^2 + z", "x^2 + y^2"]));
        assert!(!holds(&["x^2 + y^2", "a"]), "a constant");
        assert!(!holds(&["1/x"]), "no polynomial");
        assert!(!holds(&["y^2/x"]), "no polynomial, but one along the multiples of a point");
        assert!(!holds(&["sqrt(x^2 + y^2)"]), "its square is a polynomial");
        assert!(!holds(&["abs(x^2 + y^2)"]));
        assert!(!holds(&["z^30"]), "more than is recognised");
        assert!(holds(&[]), "nothing cancels");
    }
}
