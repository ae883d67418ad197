//! Polynomials that are 0 only where some others all are: sums of squares with factors of one sign.

use crate::number::rational::Rational;

use super::{MOST_WORK, Polynomial, Span};

impl Polynomial {
    /// Returns several polynomials of degree 1 that are all 0 at exactly the real points at which this one is, a sum of
    /// squares with factors of one sign; their slopes along the coordinates, which are some of the variables, are
    /// independent. `None` if it is none.
    pub fn independent_squares(&self, is_coordinate: impl Fn(u32) -> bool) -> Option<Vec<Self>> {
        let mut slopes = Span::default();
        let once = |own: Self| {
            let [only] = <[Self; 1]>::try_from(own.factors()).ok()?;
            let mut slope = Self::default();
            for (value, powers) in only.terms() {
                match powers {
                    [] => {}
                    [(variable, 1)] if is_coordinate(*variable) => {
                        slope = slope.plus(&Self::variable(*variable).scaled(value));
                    }
                    [(_, 1)] => {}
                    _ => return None,
                }
            }
            let is_independent = !slopes.rest(&slope).is_zero();
            slopes.add(&slope);
            is_independent.then_some(only)
        };
        self.squares()?.into_iter().map(once).collect()
    }

    /// Returns several polynomials l with p = Σ d l², where all numbers d have one sign: p is 0 at exactly the real
    /// points at which all of them are. One that is a number says that there are none. `None` if no such sum is
    /// found by completing squares, one variable after another.
    pub fn squares(&self) -> Option<Vec<Self>> {
        let (mut rest, mut squares) = (self.clone(), Vec::new());
        let mut is_negative = None;
        let mut has_sign = |value: &Rational| {
            *is_negative.get_or_insert(value.is_negative()) == value.is_negative()
        };
        let mut work = MOST_WORK;
        while !rest.is_zero() {
            let found = rest.variables().into_iter().find_map(|variable| {
                let powers = rest.by_powers(variable);
                let (2, head) = powers.last()? else { return None };
                let head = head.number()?;
                let slope =
                    powers.iter().find(|(power, _)| *power == 1).map(|(_, own)| own.clone());
                let slope = slope.unwrap_or_default();
                Some((Self::variable(variable), head, slope))
            });
            match found {
                // a v² + b v + c = a (v + b/2a)² + c − b²/4a
                Some((variable, head, slope)) => {
                    if !has_sign(&head) {
                        return None;
                    }
                    let half = Rational::new(1, 2);
                    let root = variable.plus(&slope.scaled(&(&half * &head.recip()?)));
                    let square = root.times(&root, &mut work)?.scaled(&-&head);
                    rest = rest.plus(&square).checked()?;
                    squares.push(root);
                }
                None => {
                    if let Some((scale, root)) = rest.square() {
                        if !has_sign(&scale) {
                            return None;
                        }
                        squares.push(root);
                    } else {
                        for (value, exponents) in rest.terms() {
                            if !has_sign(value) || exponents.iter().any(|(_, power)| power % 2 == 1)
                            {
                                return None;
                            }
                            let halved =
                                exponents.iter().map(|(variable, power)| (*variable, power / 2));
                            squares.push(Self::of_term(&Rational::from(1), halved));
                        }
                    }
                    break;
                }
            }
        }
        (squares.len() > 1).then_some(squares)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(of: &Polynomial) -> Polynomial {
        of.times(of, &mut { MOST_WORK }).expect("small")
    }

    /// Adds squares with factors; all numbers of a row belong to one polynomial of degree 1.
    fn sum(rows: &[(i64, [i64; 4])]) -> Polynomial {
        let [x, y, z] = [0, 1, 2].map(Polynomial::variable);
        rows.iter().fold(Polynomial::default(), |sum, (factor, [a, b, c, d])| {
            let one = |p: &Polynomial, k: &i64| p.scaled(&Rational::from(*k));
            let own = one(&x, a).plus(&one(&y, b)).plus(&one(&z, c));
            let own = own.plus(&Polynomial::constant(&Rational::from(*d)));
            sum.plus(&square(&own).scaled(&Rational::from(*factor)))
        })
    }

    #[test]
    fn sums_of_independent_squares_are_told_from_others() {
        let count = |p: &Polynomial| p.independent_squares(|_| true).map(|all| all.len());
        assert_eq!(count(&sum(&[(1, [1, 0, 0, -1]), (4, [1, 2, 0, 3])])), Some(2));
        let cyclic = sum(&[(1, [1, -1, 0, 0]), (1, [0, 1, -1, 0]), (1, [1, 0, -1, 0])]);
        assert_eq!(count(&cyclic), Some(2), "x = y = z");
        assert_eq!(count(&sum(&[(1, [1, 0, 0, 0]), (1, [0, 0, 0, 3])])), None, "x² + 9");
        let [x, y] = [0, 1].map(Polynomial::variable);
        assert_eq!(count(&square(&square(&x)).plus(&square(&y))), Some(2), "x⁴ + y²");
        let product = x.times(&y, &mut { MOST_WORK }).expect("small");
        assert_eq!(count(&square(&x).plus(&square(&product))), None, "x = 0, xy = 0");
        let of_one = square(&x).plus(&square(&y)).independent_squares(|own| own == 0);
        assert_eq!(of_one, None, "y has no slope along x");
    }

    #[test]
    fn definite_sums_are_told_from_others() {
        // x² + y² + z² − xy − yz − zx
        let cyclic = sum(&[(1, [1, -1, 0, 0]), (1, [0, 1, -1, 0]), (1, [1, 0, -1, 0])]);
        let found = cyclic.squares().expect("a sum of two squares");
        assert_eq!(found.len(), 2);
        let at = |p: &Polynomial, x: [i64; 3]| {
            p.terms().fold(Rational::from(0), |sum, (value, exponents)| {
                let term = exponents.iter().fold(value.clone(), |all, (k, power)| {
                    let own = Rational::from(x[*k as usize].pow(*power));
                    &all * &own
                });
                &sum + &term
            })
        };
        assert!(found.iter().all(|own| at(own, [5, 5, 5]).is_zero()), "on the line x = y = z");
        assert!(found.iter().any(|own| !at(own, [5, 5, 4]).is_zero()), "nowhere else");
        let signs = |rows: &[(i64, [i64; 4])]| sum(rows).squares().map(|all| all.len());
        assert_eq!(signs(&[(-1, [1, 2, 0, 1]), (-2, [0, 1, 1, 0])]), Some(2), "of both negative");
        assert_eq!(signs(&[(1, [1, 2, 0, 1]), (-2, [0, 1, 1, 0])]), None, "of both signs");
        assert_eq!(signs(&[(1, [1, 0, 0, 0]), (-1, [0, 0, 0, 3])]), None, "x² = 9");
        let never = sum(&[(1, [1, 0, 0, 0]), (1, [0, 0, 0, 3])]).squares().expect("x² + 9");
        assert!(never.iter().any(|own| own.number().is_some()), "no real zero");
        assert_eq!(signs(&[(3, [1, 2, 3, 4])]), None, "one square");
        let [x, y] = [0, 1].map(Polynomial::variable);
        let quartic = square(&square(&x)).plus(&square(&square(&y)));
        assert_eq!(quartic.squares().map(|all| all.len()), Some(2), "x⁴ + y⁴");
        assert_eq!(square(&square(&x)).plus(&y).squares(), None);
    }
}
