//! Ideals of polynomials modulo a prime up to a degree.

use rustc_hash::FxHashMap;

use liouville::number::prime::{Modulus, Polynomial, PrimePolynomials};
use liouville::order::StableOrder;

use super::hypersurface::PrimeTerms;
use super::ideal::degree;
use crate::echelon::Echelon;
use crate::series::exponents;
use crate::{Halt, SearchError};

/// The polynomials of at most a degree that some of them generate within it.
pub struct BoundedIdeal {
    m: Modulus,
    variables: usize,
    /// Monomials, high degrees first.
    monomials: Vec<Vec<u32>>,
    places: FxHashMap<Vec<u32>, usize>,
    /// Reduced row by pivot.
    rows: Vec<Option<Vec<u64>>>,
    /// Number of elementary steps that were taken.
    pub steps: f64,
}

impl BoundedIdeal {
    /// Closes polynomials under products; `None` if one has a higher degree.
    pub fn of(
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
        let reduction = (echelon.rank() * echelon.rank() * monomials.len()) as f64;
        let steps = echelon.steps() as f64 + reduction;
        let mut ideal = Self { m, variables, monomials, places, rows, steps };
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

    /// The highest degree.
    pub fn most(&self) -> u32 {
        self.monomials.first().map_or(0, |own| own.iter().sum())
    }

    /// Whether a polynomial of at most the degree is among them.
    pub fn contains(&self, own: &PrimeTerms) -> bool {
        self.reduced(self.row(own)).iter().all(|entry| *entry == 0)
    }

    /// Whether 1 is among the polynomials, so that there are no zeros.
    pub fn is_everything(&self) -> bool {
        self.rows.last().is_some_and(Option::is_some)
    }

    /// Finds the polynomial of least degree in one variable.
    pub fn univariate(&self, place: usize) -> Option<Polynomial> {
        let most = self.most();
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

    /// Powers of the linear form Σ rᵏ x_k of some variables, reduced, up to the first one that depends on those
    /// before it. `None` if there is none, or their degrees are too high.
    pub fn powers_of_form(&self, ratio: i64, used: &[bool]) -> Option<FormPowers<'_>> {
        let m = &self.m;
        let size = self.monomials.len();
        let mut weight = m.one();
        let step = m.rational(&ratio.into())?;
        let mut form = Vec::new();
        for place in (0..self.variables).filter(|place| used[*place]) {
            form.push((place, weight));
            weight = m.mul(weight, step);
        }
        let mut row = vec![0; size];
        *row.last_mut()? = m.one();
        let mut powers = vec![self.reduced(row)];
        let mut echelon = Echelon::new(2 * size + 2, self.m);
        loop {
            let number = powers.len() - 1;
            let own = powers.last()?;
            let mut tagged = own.clone();
            tagged.extend((0..size + 2).map(|k| if k == number { m.one() } else { 0 }));
            let (pivot, _) = echelon.pivot(tagged)?;
            if pivot >= size {
                let minimal = echelon.rows().last()?;
                let minimal = PrimePolynomials::trimmed(minimal[size..].to_vec());
                return Some(FormPowers { ideal: self, powers, minimal });
            }
            let mut next = vec![0; size];
            for (exponents, image) in self.monomials.iter().zip(own).filter(|(_, x)| **x != 0) {
                for (place, weight) in &form {
                    let mut raised = exponents.clone();
                    raised[*place] += 1;
                    let entry = &mut next[*self.places.get(&raised)?];
                    *entry = m.add(*entry, m.mul(*image, *weight));
                }
            }
            powers.push(self.reduced(next));
        }
    }

    /// Whether a power of each of some variables is a leading monomial: if no others occur, there are finitely
    /// many zeros in these.
    pub fn is_finite(&self, used: &[bool]) -> bool {
        (0..self.variables).all(|place| !used[place] || self.has_power(place))
    }

    /// Whether a power of a variable is a leading monomial.
    fn has_power(&self, place: usize) -> bool {
        let all = self.monomials.iter().zip(&self.rows);
        let mut leading = all.filter(|(_, row)| row.is_some()).map(|(own, _)| own);
        leading.any(|own| own.iter().enumerate().all(|(k, x)| k == place || *x == 0))
    }

    /// Lists the minimal elements, which generate the others.
    pub fn basis(&self) -> Vec<PrimeTerms> {
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
        basis.order_by(|a, b| degree(a).cmp(&degree(b)).then_with(|| b[0].0.cmp(&a[0].0)));
        basis
    }
}

/// Powers of a linear form modulo an ideal.
pub struct FormPowers<'i> {
    ideal: &'i BoundedIdeal,
    powers: Vec<Vec<u64>>,
    /// The polynomial of least degree that vanishes at the form.
    pub minimal: Polynomial,
}

impl FormPowers<'_> {
    /// Value of a polynomial of lower degree at the form.
    pub fn value(&self, own: &[u64]) -> PrimeTerms {
        let m = &self.ideal.m;
        let mut sum = vec![0; self.ideal.monomials.len()];
        for (power, factor) in self.powers.iter().zip(own) {
            let terms = sum.iter_mut().zip(power);
            terms.for_each(|(s, x)| *s = m.add(*s, m.mul(*x, *factor)));
        }
        let all = self.ideal.monomials.iter().cloned().zip(sum);
        all.filter(|(_, image)| *image != 0).collect()
    }
}
