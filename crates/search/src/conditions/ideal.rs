//! Common zeros of some polynomials in the parameters, modulo a prime.
//!
//! The polynomials of degree at most E in their ideal are closed under products with variables step by
//! step. A basis in echelon form, high degrees first, is one of Gröbner up to degree E. If twice the
//! degree of its minimal elements is at most E, it is one of the ideal, as all pairs are reduced to 0.
//! A polynomial in one variable among them gives values of this variable, one after the other.

use std::cell::Cell;

use liouville::number::prime::{Modulus, Polynomial, PrimePolynomials};
use liouville::proof::{ProofRng, reconstruct};

use super::bounded_ideal::BoundedIdeal;
use super::decomposition;
use super::hypersurface::{Hypersurface, PrimeTerms};
use super::real::has_real_root;
use super::relation::is_short;
use crate::orbit::monomials;
use crate::{Halt, SearchError};

/// Largest number of monomials.
const MONOMIALS: usize = 560;
/// Largest degree E.
const DEGREE: u32 = 32;
/// Largest number of components.
const COMPONENTS: usize = 64;

/// Common zeros of polynomials, in components; some without real points are left out.
#[derive(Default)]
pub struct CommonZeros {
    /// Components that are written, each by its equations.
    pub written: Vec<Vec<Hypersurface>>,
    /// Components without short coefficients, each by its images.
    pub unwritten: Vec<Vec<PrimeTerms>>,
}

/// Finds the common zeros of polynomials in some number of variables, over all complex numbers; `None` if
/// the degrees are too high, or the steps that are left are spent.
pub fn zeros(
    generators: &[PrimeTerms],
    variables: usize,
    (m, rng): (&Modulus, &mut ProofRng),
    left: &Cell<f64>,
    halt: &Halt,
) -> Result<Option<CommonZeros>, SearchError> {
    let Some(most) = highest(variables) else { return Ok(None) };
    let mut search =
        ZeroSearch { variables, most, m: *m, rng, left, halt, found: CommonZeros::default() };
    let is_done = search.split(generators, &vec![false; variables])?;
    Ok(is_done.then_some(search.found))
}

/// Largest degree E in some number of variables.
pub fn highest(variables: usize) -> Option<u32> {
    (1..=DEGREE).take_while(|own| monomials::count(variables, *own) <= MONOMIALS).last()
}

/// Whether a polynomial is in the ideal of others, as far as that is seen at low degrees.
pub fn contains(
    generators: &[PrimeTerms],
    own: &PrimeTerms,
    variables: usize,
    m: &Modulus,
    halt: &Halt,
) -> Result<bool, SearchError> {
    let all = generators.iter().chain([own]).map(degree).max().unwrap_or(0);
    let most = highest(variables).unwrap_or(0).min(2 * all);
    let Some(ideal) = BoundedIdeal::of(generators, variables, most, *m, halt)? else {
        return Ok(false);
    };
    if degree(own) > most {
        return Ok(false);
    }
    Ok(ideal.contains(own))
}

struct ZeroSearch<'z> {
    variables: usize,
    /// Degree E.
    most: u32,
    m: Modulus,
    rng: &'z mut ProofRng,
    /// Number of elementary steps that may still be taken.
    left: &'z Cell<f64>,
    halt: &'z Halt,
    found: CommonZeros,
}

impl ZeroSearch<'_> {
    /// Divides the zeros by the values of one variable after the other; `false` if there are too many, or
    /// the degrees are too high.
    fn split(
        &mut self,
        generators: &[PrimeTerms],
        is_settled: &[bool],
    ) -> Result<bool, SearchError> {
        let own = generators.iter().map(degree).max().unwrap_or(0);
        let small = (2 * own).max(own + 2);
        let used = used(generators, self.variables);
        for most in [small.min(self.most), self.most] {
            let ideal = BoundedIdeal::of(generators, self.variables, most, self.m, self.halt)?;
            let Some(ideal) = ideal else { return Ok(false) };
            self.left.set(self.left.get() - ideal.steps);
            if self.left.get() < 0.0 {
                return Ok(false);
            }
            if ideal.is_everything() {
                return Ok(true);
            }
            let basis = ideal.basis();
            let mut open = (0..self.variables).filter(|place| !is_settled[*place]);
            if let Some((place, own)) =
                open.find_map(|place| Some((place, ideal.univariate(place)?)))
            {
                return self.split_by(&basis, place, &own, is_settled);
            }
            let highest = basis.iter().map(degree).max().unwrap_or(0);
            let is_last =
                most == self.most || !ideal.is_finite(&used) || is_settled.iter().all(|x| *x);
            if 2 * highest <= most && is_last {
                if let Some(equal) = self.equal(&ideal, &basis) {
                    return self.split(&[basis, vec![equal]].concat(), is_settled);
                }
                if ideal.is_finite(&used)
                    && let Some(parts) =
                        decomposition::parts(&ideal, &used, (&self.m, &mut *self.rng))
                {
                    for part in parts {
                        if !self.split(&[basis.clone(), vec![part]].concat(), is_settled)? {
                            return Ok(false);
                        }
                    }
                    return Ok(true);
                }
                self.tell(basis);
                return Ok(self.found.written.len() + self.found.unwritten.len() <= COMPONENTS);
            }
        }
        Ok(false)
    }

    /// Finds a difference of two variables a power of which is in an ideal, and not it itself.
    fn equal(&self, ideal: &BoundedIdeal, basis: &[PrimeTerms]) -> Option<PrimeTerms> {
        let m = &self.m;
        let highest = basis.iter().map(degree).max().unwrap_or(0).min(ideal.most());
        let pairs = (0..self.variables).flat_map(|i| (0..i).map(move |j| (j, i)));
        let power = |(first, second): (usize, usize), order: u32| -> PrimeTerms {
            let mut all = PrimeTerms::new();
            let mut image = m.one();
            for k in 0..=order {
                let exponents = (0..self.variables).map(|place| match place {
                    place if place == first => order - k,
                    place if place == second => k,
                    _ => 0,
                });
                all.push((exponents.collect(), image));
                // The next binomial coefficient, with the other sign.
                let above = m.mul(image, m.integer(u64::from(order - k)));
                image = m.sub(0, m.mul(above, m.inverse(m.integer(u64::from(k + 1)))));
            }
            all
        };
        let holds = |pair, order| ideal.contains(&power(pair, order));
        let mut thick =
            pairs.filter(|pair| !holds(*pair, 1) && (2..=highest).any(|order| holds(*pair, order)));
        thick.next().map(|pair| power(pair, 1))
    }

    /// Notes a component, unless an equation shows that it has no real points.
    fn tell(&mut self, basis: Vec<PrimeTerms>) {
        let written: Option<Vec<Hypersurface>> =
            basis.iter().map(|own| Hypersurface::of(own, &self.m)).collect();
        let is_real = |own: &Hypersurface| match own.univariate() {
            Some((_, coefficients)) => has_real_root(&coefficients),
            None => true,
        };
        match written {
            Some(own) if own.iter().all(is_real) => self.found.written.push(own),
            Some(_) => {}
            None => self.found.unwritten.push(basis),
        }
    }

    /// Divides the zeros by the values of a variable: each short one, and the roots of the rest.
    fn split_by(
        &mut self,
        basis: &[PrimeTerms],
        place: usize,
        own: &Polynomial,
        is_settled: &[bool],
    ) -> Result<bool, SearchError> {
        let ring = PrimePolynomials(self.m);
        let mut rest = ring.square_free(own);
        let mut settled = is_settled.to_vec();
        settled[place] = true;
        let mut parts: Vec<Polynomial> = Vec::new();
        for root in ring.roots(&rest) {
            if reconstruct(root, &self.m).filter(is_short).is_some() {
                let factor = vec![self.m.sub(0, root), self.m.one()];
                rest = ring.divided(&rest, &factor).0;
                parts.push(factor);
            }
        }
        parts.extend(Some(rest).filter(|rest| rest.len() > 1));
        for part in parts {
            let factor = self.in_variable(place, &part);
            if !self.split(&[basis, &[factor]].concat(), &settled)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn in_variable(&self, place: usize, own: &Polynomial) -> PrimeTerms {
        let term = |(power, image): (usize, &u64)| {
            let exponents = (0..self.variables).map(|k| if k == place { power as u32 } else { 0 });
            (exponents.collect(), *image)
        };
        own.iter().enumerate().map(term).collect()
    }
}

/// Tells which variables occur.
pub fn used(generators: &[PrimeTerms], variables: usize) -> Vec<bool> {
    let terms = || generators.iter().flatten().filter(|(_, image)| *image != 0);
    (0..variables).map(|place| terms().any(|(exponents, _)| exponents[place] > 0)).collect()
}

/// Degree of a polynomial.
pub fn degree(own: &PrimeTerms) -> u32 {
    let used = own.iter().filter(|(_, image)| *image != 0);
    used.map(|(exponents, _)| exponents.iter().sum()).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::super::relation::ScalarParameter;
    use super::*;

    type Given<'t> = &'t [(&'t [u32], i64)];

    fn found(generators: &[Given<'_>], variables: usize) -> (Vec<String>, usize) {
        let mut rng = ProofRng::new(3, 0);
        let m = rng.prime(&[], &[]);
        let image = |own: i64| match own < 0 {
            true => m.sub(0, m.integer(own.unsigned_abs())),
            false => m.integer(own.unsigned_abs()),
        };
        let terms = |own: &Given<'_>| own.iter().map(|(e, c)| (e.to_vec(), image(*c))).collect();
        let generators: Vec<PrimeTerms> = generators.iter().map(terms).collect();
        let left = Cell::new(1e9);
        let own = zeros(&generators, variables, (&m, &mut rng), &left, &Halt::default());
        let own = own.expect("not stopped").expect("low degrees");
        let names: Vec<ScalarParameter> = ["a", "b", "c"]
            .iter()
            .enumerate()
            .map(|(draw, name)| ScalarParameter { name: name.to_string(), draw })
            .collect();
        let text = |own: &Vec<Hypersurface>| {
            own.iter().map(|own| own.equation(&names)).collect::<Vec<_>>().join(" and ")
        };
        (own.written.iter().map(text).collect(), own.unwritten.len())
    }

    #[test]
    fn zeros_are_divided_into_points_and_curves() {
        // a² = 1, b (a − 1) = 0, b² = 4 b: two points and (−1, 0).
        let points: [Given<'_>; 3] = [
            (&[(&[2, 0], 1), (&[0, 0], -1)]),
            (&[(&[1, 1], 1), (&[0, 1], -1)]),
            (&[(&[0, 2], 1), (&[0, 1], -4)]),
        ];
        let mut texts = found(&points, 2).0;
        texts.sort();
        assert_eq!(texts, ["a = -1 and b = 0", "a = 1 and b = 0", "a = 1 and b = 4"]);
        // A point of multiplicity four, and no point.
        // a = b = c, as a line of multiplicity above one.
        let equal: [Given<'_>; 3] = [
            (&[(&[1, 1, 0], 1), (&[1, 0, 1], -1), (&[0, 2, 0], -1), (&[0, 1, 1], 1)]),
            (&[(&[0, 1, 1], 1), (&[1, 1, 0], -1), (&[0, 0, 2], -1), (&[1, 0, 1], 1)]),
            (&[(&[1, 0, 1], 1), (&[2, 0, 0], -1), (&[0, 1, 1], -1), (&[1, 1, 0], 1)]),
        ];
        assert_eq!(found(&equal, 3).0, ["a = c and b = c"]);
        // a² = 1 and b² + b + 1 = 0 has no real points.
        let complex: [Given<'_>; 2] =
            [(&[(&[2, 0], 1), (&[0, 0], -1)]), (&[(&[0, 2], 1), (&[0, 1], 1), (&[0, 0], 1)])];
        assert!(found(&complex, 2).0.is_empty());
        let thick: [Given<'_>; 2] = [(&[(&[2, 0], 1)]), (&[(&[0, 2], 1)])];
        assert_eq!(found(&thick, 2).0, ["a = 0 and b = 0"]);
        let none: [Given<'_>; 2] =
            [(&[(&[1, 1], 1), (&[0, 0], -1)]), (&[(&[2, 1], 1), (&[1, 0], -2)])];
        assert!(found(&none, 2).0.is_empty(), "a b = 1 and a² b = 2 a");
        // a² = 2 b², a b = 4.
        let roots: [Given<'_>; 2] =
            [(&[(&[2, 0], 1), (&[0, 2], -2)]), (&[(&[1, 1], 1), (&[0, 0], -4)])];
        assert_eq!(found(&roots, 2).0, ["a² − 2*b² = 0 and a*b − 4 = 0 and b³ − 2*a = 0"]);
        // a² = 2 and b² = 2: a = ±b are two sets.
        let equal: [Given<'_>; 2] =
            [(&[(&[2, 0], 1), (&[0, 0], -2)]), (&[(&[0, 2], 1), (&[0, 0], -2)])];
        let mut texts = found(&equal, 2).0;
        texts.sort();
        assert_eq!(texts, ["a + b = 0 and b² − 2 = 0", "a = b and b² − 2 = 0"]);
        // a line in space and a curve: c = 1 and a = b², or c = 2 and a = b.
        let curves: [Given<'_>; 2] = [
            (&[(&[0, 0, 2], 1), (&[0, 0, 1], -3), (&[0, 0, 0], 2)]),
            (&[
                (&[1, 0, 0], 1),
                (&[0, 2, 1], 1),
                (&[0, 2, 0], -2),
                (&[0, 1, 1], -1),
                (&[0, 1, 0], 1),
            ]),
        ];
        let mut texts = found(&curves, 3).0;
        texts.sort();
        assert_eq!(texts, ["a = b and c = 2", "c = 1 and b² − a = 0"]);
    }
}
