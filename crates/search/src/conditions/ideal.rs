//! Common zeros of some polynomials in the parameters, modulo a prime.
//!
//! The polynomials of degree at most E in their ideal are closed under products with variables step by
//! step. A basis in echelon form, high degrees first, is one of Gröbner up to degree E. If twice the
//! degree of its minimal elements is at most E, it is one of the ideal, as all pairs are reduced to 0.
//! A polynomial in one variable among them gives values of this variable, one after the other.

use rustc_hash::FxHashMap;

use liouville::number::prime::Modulus;
use liouville::proof::{ProofRng, reconstruct};

use super::hypersurface::{Hypersurface, PrimeTerms};
use super::polynomial::{Polynomial, PrimePolynomials};
use super::relation::is_short;
use crate::echelon::Echelon;
use crate::orbit::monomials;
use crate::series::exponents;
use crate::{Halt, SearchError};

/// Largest number of monomials.
const MONOMIALS: usize = 560;
/// Largest degree E.
const DEGREE: u32 = 32;
/// Largest number of components.
const COMPONENTS: usize = 64;

/// Common zeros of polynomials, in components.
#[derive(Default)]
pub struct CommonZeros {
    /// Components that are written, each by its equations.
    pub written: Vec<Vec<Hypersurface>>,
    /// Components without short coefficients, each by its images.
    pub unwritten: Vec<Vec<PrimeTerms>>,
}

/// Finds the common zeros of polynomials in some number of variables, over all complex numbers; `None` if
/// the degrees are too high.
pub fn zeros(
    generators: &[PrimeTerms],
    variables: usize,
    m: &Modulus,
    rng: &mut ProofRng,
    halt: &Halt,
) -> Result<Option<CommonZeros>, SearchError> {
    let Some(most) = highest(variables) else { return Ok(None) };
    let mut search =
        ZeroSearch { variables, most, m: *m, rng, halt, found: CommonZeros::default() };
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
    Ok(ideal.reduced(ideal.row(own)).iter().all(|entry| *entry == 0))
}

struct ZeroSearch<'z> {
    variables: usize,
    /// Degree E.
    most: u32,
    m: Modulus,
    rng: &'z mut ProofRng,
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
        for most in [small.min(self.most), self.most] {
            let ideal = BoundedIdeal::of(generators, self.variables, most, self.m, self.halt)?;
            let Some(ideal) = ideal else { return Ok(false) };
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
            let is_last = most == self.most || !ideal.is_finite() || is_settled.iter().all(|x| *x);
            if 2 * highest <= most && is_last {
                match basis.iter().map(|own| Hypersurface::of(own, &self.m)).collect() {
                    Some(own) => self.found.written.push(own),
                    None => self.found.unwritten.push(basis),
                }
                return Ok(self.found.written.len() + self.found.unwritten.len() <= COMPONENTS);
            }
        }
        Ok(false)
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
        for root in ring.roots(&rest, self.rng) {
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

/// Degree of a polynomial.
pub fn degree(own: &PrimeTerms) -> u32 {
    let used = own.iter().filter(|(_, image)| *image != 0);
    used.map(|(exponents, _)| exponents.iter().sum()).max().unwrap_or(0)
}

/// The polynomials of at most a degree that some of them generate within it.
struct BoundedIdeal {
    m: Modulus,
    variables: usize,
    /// Monomials, high degrees first.
    monomials: Vec<Vec<u32>>,
    places: FxHashMap<Vec<u32>, usize>,
    /// Reduced row by pivot.
    rows: Vec<Option<Vec<u64>>>,
}

impl BoundedIdeal {
    /// Closes polynomials under products; `None` if one has a higher degree.
    fn of(
        generators: &[PrimeTerms],
        variables: usize,
        most: u32,
        m: Modulus,
        halt: &Halt,
    ) -> Result<Option<Self>, SearchError> {
        if generators.iter().any(|own| degree(own) > most) {
            return Ok(None);
        }
        let monomials: Vec<Vec<u32>> =
            (0..=most).rev().flat_map(|total| exponents(variables, total)).collect();
        let places: FxHashMap<Vec<u32>, usize> =
            monomials.iter().cloned().enumerate().map(|(place, own)| (own, place)).collect();
        let row_of = |own: &PrimeTerms| {
            let mut row = vec![0; monomials.len()];
            own.iter().filter(|(_, x)| *x != 0).for_each(|(e, image)| row[places[e]] = *image);
            row
        };
        let mut echelon = Echelon::new(monomials.len(), m);
        generators.iter().for_each(|own| _ = echelon.push(row_of(own)));
        let mut is_multiplied = vec![false; monomials.len()];
        loop {
            let total = |own: &[u32]| own.iter().sum::<u32>();
            let pivots: Vec<usize> =
                (0..monomials.len()).filter(|place| echelon.has_pivot(*place)).collect();
            let mut products = Vec::new();
            for (pivot, row) in pivots.into_iter().zip(echelon.rows()) {
                if is_multiplied[pivot] || total(&monomials[pivot]) >= most {
                    continue;
                }
                is_multiplied[pivot] = true;
                for variable in 0..variables {
                    let mut product = vec![0; monomials.len()];
                    for (exponents, image) in monomials.iter().zip(&row).filter(|(_, x)| **x != 0) {
                        let mut raised = exponents.clone();
                        raised[variable] += 1;
                        product[places[&raised]] = *image;
                    }
                    products.push(product);
                }
            }
            let mut is_larger = false;
            for product in products {
                halt.check()?;
                is_larger |= echelon.push(product);
            }
            if !is_larger {
                break;
            }
        }
        let mut rows: Vec<Option<Vec<u64>>> = vec![None; monomials.len()];
        let pivots = (0..monomials.len()).filter(|place| echelon.has_pivot(*place));
        for (pivot, row) in pivots.zip(echelon.rows()) {
            rows[pivot] = Some(row);
        }
        let mut ideal = Self { m, variables, monomials, places, rows };
        // Low degrees come first, so that each is reduced by reduced ones.
        for pivot in (0..ideal.rows.len()).rev() {
            halt.check()?;
            if let Some(row) = ideal.rows[pivot].take() {
                ideal.rows[pivot] = Some(ideal.reduced(row));
            }
        }
        Ok(Some(ideal))
    }

    fn row(&self, own: &PrimeTerms) -> Vec<u64> {
        let mut row = vec![0; self.monomials.len()];
        let used = own.iter().filter(|(_, image)| *image != 0);
        used.for_each(|(exponents, image)| row[self.places[exponents]] = *image);
        row
    }

    /// Subtracts multiples of the rows until no pivot is left.
    fn reduced(&self, mut row: Vec<u64>) -> Vec<u64> {
        for pivot in 0..row.len() {
            let Some(own) = self.rows[pivot].as_ref().filter(|_| row[pivot] != 0) else { continue };
            let factor = row[pivot];
            for (entry, other) in row[pivot..].iter_mut().zip(&own[pivot..]) {
                if *other != 0 {
                    *entry = self.m.sub(*entry, self.m.mul(factor, *other));
                }
            }
        }
        row
    }

    /// Whether 1 is among the polynomials, so that there are no zeros.
    fn is_everything(&self) -> bool {
        self.rows.last().is_some_and(Option::is_some)
    }

    /// Finds the polynomial of least degree in one variable.
    fn univariate(&self, place: usize) -> Option<Polynomial> {
        let most = self.monomials.first()?.iter().sum::<u32>();
        let size = self.monomials.len();
        // Behind each power reduced by the rows stands the power itself.
        let mut echelon = Echelon::new(size + most as usize + 1, self.m);
        for power in 0..=most {
            let exponents: Vec<u32> =
                (0..self.variables).map(|k| if k == place { power } else { 0 }).collect();
            let mut row = vec![0; size];
            row[self.places[&exponents]] = self.m.one();
            let mut row = self.reduced(row);
            row.extend((0..=most).map(|k| if k == power { self.m.one() } else { 0 }));
            let (pivot, _) = echelon.pivot(row)?;
            if pivot >= size {
                let own = echelon.rows().last()?;
                return Some(PrimePolynomials::trimmed(own[size..].to_vec()));
            }
        }
        None
    }

    /// Whether a power of each variable is a leading monomial, so that there are finitely many zeros.
    fn is_finite(&self) -> bool {
        let leading = || {
            let all = self.monomials.iter().zip(&self.rows);
            all.filter(|(_, row)| row.is_some()).map(|(own, _)| own)
        };
        let is_power = |own: &Vec<u32>, place: usize| {
            own.iter().enumerate().all(|(k, x)| k == place || *x == 0)
        };
        (0..self.variables).all(|place| leading().any(|own| is_power(own, place)))
    }

    /// Lists the minimal elements, which generate the others.
    fn basis(&self) -> Vec<PrimeTerms> {
        let divides = |a: &[u32], b: &[u32]| a.iter().zip(b).all(|(x, y)| x <= y);
        let mut found: Vec<usize> = Vec::new();
        for pivot in (0..self.rows.len()).rev().filter(|pivot| self.rows[*pivot].is_some()) {
            let own = &self.monomials[pivot];
            if !found.iter().any(|known| divides(&self.monomials[*known], own)) {
                found.push(pivot);
            }
        }
        let terms = |pivot: &usize| -> PrimeTerms {
            let row = self.rows[*pivot].iter().flatten();
            let all = self.monomials.iter().cloned().zip(row.copied());
            all.filter(|(_, image)| *image != 0).collect()
        };
        let mut basis: Vec<PrimeTerms> = found.iter().map(terms).collect();
        // By the first variable that a leading monomial contains.
        basis.sort_by(|a, b| degree(a).cmp(&degree(b)).then_with(|| b[0].0.cmp(&a[0].0)));
        basis
    }
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
        let own = zeros(&generators, variables, &m, &mut rng, &Halt::default());
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
        let thick: [Given<'_>; 2] = [(&[(&[2, 0], 1)]), (&[(&[0, 2], 1)])];
        assert_eq!(found(&thick, 2).0, ["a = 0 and b = 0"]);
        let none: [Given<'_>; 2] =
            [(&[(&[1, 1], 1), (&[0, 0], -1)]), (&[(&[2, 1], 1), (&[1, 0], -2)])];
        assert!(found(&none, 2).0.is_empty(), "a b = 1 and a² b = 2 a");
        // a² = 2 b², a b = 4.
        let roots: [Given<'_>; 2] =
            [(&[(&[2, 0], 1), (&[0, 2], -2)]), (&[(&[1, 1], 1), (&[0, 0], -4)])];
        assert_eq!(found(&roots, 2).0, ["a² − 2*b² = 0 and a*b − 4 = 0 and b³ − 2*a = 0"]);
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
