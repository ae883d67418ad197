//! Numbers of real points of finite sets of common zeros.
//!
//! A Gröbner basis G with finitely many monomials b outside its leading ones gives the algebra A = Q\[x\]/(G).
//! The signature of Hermite's form (f, g) ↦ Tr(h f g) is Σ sign h(x) over the real zeros x, and that for h = 1 is
//! their number. That the b are independent in A is not taken for granted: it is so if the matrices of the
//! products with the variables, read off the basis, commute.

use std::collections::BTreeMap;

use liouville::number::rational::Rational;
use liouville::order::StableOrder;

use super::arithmetic::{Terms, contains};
use super::signature::signature;

/// Largest number of zeros, with their multiplicities.
const ZEROS: usize = 40;

/// Number of real common zeros of polynomials in the variables that they contain; `None` if it is not known:
/// if they are no Gröbner basis, or there are too many zeros.
pub fn real_zeros(basis: &[Terms]) -> Option<usize> {
    let count = basis.first()?.first()?.0.len();
    let used: Vec<usize> =
        (0..count).filter(|k| basis.iter().any(|own| contains(own, *k))).collect();
    let algebra = Algebra::of(basis, &used)?;
    let (positive, negative) = signature(algebra.hermite());
    positive.checked_sub(negative)
}

type Vector = Vec<Rational>;

/// The algebra of polynomials modulo some of them.
struct Algebra {
    /// Monomials that are a basis; 1 is the first.
    monomials: Vec<Vec<u32>>,
    /// For each variable in use the products with the monomials.
    products: Vec<Vec<Vector>>,
    used: Vec<usize>,
}

/// Whether a monomial comes before another one: by degree, then by the exponents.
fn order(own: &[u32]) -> (u32, &[u32]) {
    (own.iter().sum(), own)
}

fn divides(a: &[u32], b: &[u32]) -> bool {
    a.iter().zip(b).all(|(x, y)| x <= y)
}

impl Algebra {
    /// Reads the algebra off a basis; `None` if it is no Gröbner basis, or too large.
    fn of(basis: &[Terms], used: &[usize]) -> Option<Self> {
        let led: Option<Vec<(&Vec<u32>, &Terms)>> = basis
            .iter()
            .map(|own| Some((&own.iter().max_by(|a, b| order(&a.0).cmp(&order(&b.0)))?.0, own)))
            .collect();
        let led = led?;
        let width = basis.first()?.first()?.0.len();
        let is_outside = |own: &Vec<u32>| !led.iter().any(|(lead, _)| divides(lead, own));
        let mut monomials = Some(vec![0; width]).filter(is_outside).into_iter().collect::<Vec<_>>();
        let mut next = 0;
        while next < monomials.len() {
            for place in used {
                let raised = raised(&monomials[next], *place);
                if is_outside(&raised) && !monomials.contains(&raised) {
                    monomials.push(raised);
                }
            }
            next += 1;
            if monomials.len() > ZEROS {
                return None;
            }
        }
        let places: BTreeMap<Vec<u32>, usize> =
            monomials.iter().cloned().enumerate().map(|(k, own)| (own, k)).collect();
        let size = monomials.len();
        let mut products: Vec<Vec<Option<Vector>>> = vec![vec![None; size]; used.len()];
        // Smaller products are known before larger ones need them.
        let mut all: Vec<(usize, usize)> =
            (0..used.len()).flat_map(|k| (0..size).map(move |j| (k, j))).collect();
        let target = |(k, j): &(usize, usize)| raised(&monomials[*j], used[*k]);
        all.order_by(|a, b| order(&target(a)).cmp(&order(&target(b))));
        let mut reduced: BTreeMap<Vec<u32>, Vector> = BTreeMap::new();
        for (k, j) in all {
            let own = target(&(k, j));
            let vector = match (places.get(&own), reduced.get(&own)) {
                (Some(place), _) => unit(size, *place),
                (None, Some(known)) => known.clone(),
                (None, None) => {
                    let known = (&reduced, &places, size);
                    match led.iter().find(|(lead, _)| **lead == own) {
                        Some((lead, terms)) => minus_rest(lead, terms, known)?,
                        // own = x_l b' x_k with x_l b' x_k/x_l reduced before.
                        None => product_of_reduced(&own, used, &products, known)?,
                    }
                }
            };
            reduced.insert(own, vector.clone());
            products[k][j] = Some(vector);
        }
        let products: Option<Vec<Vec<Vector>>> =
            products.into_iter().map(|own| own.into_iter().collect()).collect();
        let algebra = Self { monomials, products: products?, used: used.to_vec() };
        (algebra.commutes() && basis.iter().all(|own| algebra.vanishes(own))).then_some(algebra)
    }

    fn size(&self) -> usize {
        self.monomials.len()
    }

    /// Product of an element with a variable in use.
    fn times(&self, variable: usize, own: &Vector) -> Vector {
        let mut sum = vec![Rational::from(0); self.size()];
        for (value, column) in own.iter().zip(&self.products[variable]) {
            if !value.is_zero() {
                sum.iter_mut().zip(column).for_each(|(s, x)| *s = &*s + &(value * x));
            }
        }
        sum
    }

    fn times_monomial(&self, exponents: &[u32], own: &Vector) -> Vector {
        let powers = self.used.iter().enumerate();
        powers.fold(own.clone(), |own, (variable, place)| {
            (0..exponents[*place]).fold(own, |own, _| self.times(variable, &own))
        })
    }

    fn commutes(&self) -> bool {
        let count = self.used.len();
        (0..count).all(|k| {
            (0..k).all(|l| {
                (0..self.size()).all(|j| {
                    self.times(k, &self.products[l][j]) == self.times(l, &self.products[k][j])
                })
            })
        })
    }

    /// Whether a polynomial is 0.
    fn vanishes(&self, own: &Terms) -> bool {
        let one = unit(self.size(), 0);
        let mut sum = vec![Rational::from(0); self.size()];
        for (exponents, value) in own {
            let image = self.times_monomial(exponents, &one);
            sum.iter_mut().zip(&image).for_each(|(s, x)| *s = &*s + &(value * x));
        }
        sum.iter().all(Rational::is_zero)
    }

    /// Hermite's form, Tr(b c) for the monomials b and c.
    fn hermite(&self) -> Vec<Vector> {
        let size = self.size();
        let zero = || Rational::from(0);
        let mut table: Vec<Vec<Vector>> = Vec::with_capacity(size);
        for own in &self.monomials {
            // Each but 1 is a product of a variable and one before it.
            let row = self.used.iter().enumerate().find_map(|(variable, place)| {
                let mut lower = own.clone();
                lower[*place] = lower[*place].checked_sub(1)?;
                let before = self.monomials.iter().position(|own| *own == lower)?;
                let known = table.get(before)?;
                Some(known.iter().map(|own| self.times(variable, own)).collect())
            });
            table.push(row.unwrap_or_else(|| (0..size).map(|j| unit(size, j)).collect()));
        }
        let trace = |own: &Vec<Vector>| (0..size).fold(zero(), |sum, j| &sum + &own[j][j]);
        let traces: Vec<Rational> = table.iter().map(trace).collect();
        let entry = |own: &Vector| {
            own.iter().zip(&traces).fold(zero(), |sum, (x, trace)| &sum + &(x * trace))
        };
        table.iter().map(|row| row.iter().map(entry).collect()).collect()
    }
}

fn raised(own: &[u32], place: usize) -> Vec<u32> {
    let mut own = own.to_vec();
    own[place] += 1;
    own
}

fn unit(size: usize, place: usize) -> Vector {
    (0..size).map(|k| Rational::from(i64::from(k == place))).collect()
}

/// Reduced monomials, places of those of the basis, and their number.
type Known<'k> = (&'k BTreeMap<Vec<u32>, Vector>, &'k BTreeMap<Vec<u32>, usize>, usize);

/// A leading monomial by the other terms; `None` if one of them is not known.
fn minus_rest(lead: &[u32], terms: &Terms, (reduced, places, size): Known<'_>) -> Option<Vector> {
    let scale = terms.iter().find(|(own, _)| own == lead)?.1.recip()?;
    let mut sum = vec![Rational::from(0); size];
    for (own, value) in terms.iter().filter(|(own, _)| own != lead) {
        let factor = value * &scale;
        match (places.get(own), reduced.get(own)) {
            (Some(place), _) => sum[*place] = &sum[*place] - &factor,
            (None, Some(known)) => {
                sum.iter_mut().zip(known).for_each(|(s, x)| *s = &*s - &(&factor * x));
            }
            (None, None) => return None,
        }
    }
    Some(sum)
}

/// A monomial as a product of a variable and a smaller one that is reduced already.
fn product_of_reduced(
    own: &[u32],
    used: &[usize],
    products: &[Vec<Option<Vector>>],
    (reduced, places, size): Known<'_>,
) -> Option<Vector> {
    for (variable, place) in used.iter().enumerate().filter(|(_, place)| own[**place] > 0) {
        let mut lower = own.to_vec();
        lower[*place] -= 1;
        // One of the basis gives the product that is asked for.
        let known = reduced.get(&lower).filter(|_| !places.contains_key(&lower));
        let Some(known) = known else { continue };
        let mut sum = vec![Rational::from(0); size];
        let terms = known.iter().zip(&products[variable]).filter(|(value, _)| !value.is_zero());
        for (value, column) in terms {
            let column = column.as_ref()?;
            sum.iter_mut().zip(column).for_each(|(s, x)| *s = &*s + &(value * x));
        }
        return Some(sum);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    type Given<'t> = &'t [(&'t [u32], i64)];

    fn of(basis: &[Given<'_>]) -> Option<usize> {
        let terms = |own: &Given<'_>| {
            own.iter().map(|(e, value)| (e.to_vec(), Rational::from(*value))).collect::<Terms>()
        };
        real_zeros(&basis.iter().map(terms).collect::<Vec<_>>())
    }

    #[test]
    fn real_zeros_are_counted_once_each() {
        assert_eq!(of(&[&[(&[2], 1), (&[0], -2)]]), Some(2));
        assert_eq!(of(&[&[(&[2], 1), (&[0], 2)]]), Some(0));
        assert_eq!(of(&[&[(&[4], 1), (&[3], -2), (&[2], 2), (&[1], -2), (&[0], 1)]]), Some(1));
        // a³ = b, b³ = a: 0 and ±1 among nine; without these none is real.
        let cubes: [Given<'_>; 2] =
            [&[(&[3, 0], 1), (&[0, 1], -1)], &[(&[0, 3], 1), (&[1, 0], -1)]];
        assert_eq!(of(&cubes), Some(3));
        let rest: [Given<'_>; 2] = [
            &[(&[2, 0], 1), (&[1, 1], 1), (&[0, 2], 1), (&[0, 0], 1)],
            &[(&[0, 3], 1), (&[1, 0], -1)],
        ];
        assert_eq!(of(&rest), Some(0));
        // a² = 2 b², a b = 4, b³ = 2 a: b⁴ = 8 has two real roots.
        let roots: [Given<'_>; 3] = [
            &[(&[2, 0], 1), (&[0, 2], -2)],
            &[(&[1, 1], 1), (&[0, 0], -4)],
            &[(&[0, 3], 1), (&[1, 0], -2)],
        ];
        assert_eq!(of(&roots), Some(2));
        // Variables that do not occur are free.
        assert_eq!(of(&[&[(&[0, 2, 0], 1), (&[0, 0, 0], -3)]]), Some(2));
    }

    #[test]
    fn nothing_is_counted_without_a_basis() {
        // a² = 2 b² and a b = 4 alone lack b³ = 2 a.
        let part: [Given<'_>; 2] = [&[(&[2, 0], 1), (&[0, 2], -2)], &[(&[1, 1], 1), (&[0, 0], -4)]];
        assert_eq!(of(&part), None);
        // The last equation is not one of the ideal of the others.
        let wrong: [Given<'_>; 3] = [
            &[(&[2, 0], 1), (&[0, 0], -1)],
            &[(&[0, 2], 1), (&[0, 0], -1)],
            &[(&[2, 1], 1), (&[0, 0], 5)],
        ];
        assert_eq!(of(&wrong), None);
        let inconsistent: [Given<'_>; 3] = [
            &[(&[2, 0], 1), (&[0, 1], -1)],
            &[(&[1, 1], 1), (&[0, 0], -1)],
            &[(&[0, 2], 1), (&[0, 0], -7)],
        ];
        assert_eq!(of(&inconsistent), None);
        // A curve.
        assert_eq!(of(&[&[(&[2, 0], 1), (&[0, 1], -1)]]), None);
    }
}
