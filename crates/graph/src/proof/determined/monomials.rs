//! Monomials in several values.

use crate::graph::Expr;
use crate::number::prime::Modulus;

/// Indices of the factors in order, each as often as its exponent says.
pub type Monomial = Vec<u16>;

/// Lists all monomials up to a degree, by degree; `None` if there are more than `most`.
pub fn monomials(symbols: usize, degree: usize, most: usize) -> Option<Vec<Monomial>> {
    let mut all: Vec<Monomial> = vec![Vec::new()];
    let mut start = 0;
    for _ in 0..degree {
        let end = all.len();
        for k in start..end {
            let first = all[k].last().copied().map_or(0, usize::from);
            for symbol in first..symbols {
                let mut next = all[k].clone();
                next.push(u16::try_from(symbol).ok()?);
                all.push(next);
                if all.len() > most {
                    return None;
                }
            }
        }
        start = end;
    }
    Some(all)
}

/// Records the product of the values.
pub fn product(monomial: &Monomial, values: &[Expr]) -> Expr {
    monomial.iter().fold(Expr::from(1.0), |product, factor| product * values[usize::from(*factor)])
}

/// Computes the product of the values modulo a prime.
pub fn product_modulo(monomial: &Monomial, values: &[u64], modulus: &Modulus) -> u64 {
    monomial
        .iter()
        .fold(modulus.one(), |product, factor| modulus.mul(product, values[usize::from(*factor)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn monomials_are_counted_by_binomials() {
        assert_eq!(monomials(2, 2, 99).map(|all| all.len()), Some(6), "1, x, y, x², xy, y²");
        assert_eq!(monomials(3, 3, 99).map(|all| all.len()), Some(20));
        assert_eq!(monomials(3, 3, 19), None, "one too many");
        assert_eq!(monomials(0, 3, 9), Some(vec![Vec::new()]), "1 alone");
    }
}
