//! Darboux polynomials: f with v(f) = K f for a polynomial K.

use num_bigint::BigInt;
use rustc_hash::FxHashMap;

use liouville::formula::{Formula, FormulaError};
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::proof::reconstruct;

use super::super::ansatz::monomials::power_product;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::super::terms::sum;
use super::super::{FoundKind, Given, SearchError, SearchReport};
use super::adjoin;
use super::angle::ConjugatePair;
use super::claims::{self, OrbitStatement};
use super::factor::RatedPolynomial;
use super::images::{self, Images};
use super::known::IndependentIntegrals;
use super::line::RandomLine;
use super::monomials::{self, value};
use super::setting::{ExtendedCase, OrbitSetting, PrimePhasePoint, SPARE_ORDERS};

/// Number of primes tried until all special places of a line lie in the field, for polynomials of
/// degree up to 2, and of higher degree.
const PRIMES: [u64; 2] = [4, 4];
/// Largest number of conjugate factors that are multiplied.
pub const CONJUGATES: usize = 4;
/// Largest number of ways to choose points of rest, one on each line.
const MOST_WAYS: f64 = 4096.0;
/// Largest number of candidates of one degree.
pub const MOST_CANDIDATES: usize = 40;

/// The search for Darboux polynomials in some variables.
pub struct DarbouxSearch<'s, 'c> {
    /// Case with its points.
    pub setting: &'s OrbitSetting<'c>,
    /// Variables of the polynomials.
    pub variables: &'s [usize],
    /// Degree of the field in the state.
    pub degree: usize,
}

/// Coefficients of a polynomial modulo a prime by monomials.
pub type Terms = Vec<(Vec<u32>, u64)>;

impl DarbouxSearch<'_, '_> {
    /// Searches the polynomials of one degree; new ones are added to the factors.
    pub fn of_degree(
        &self,
        degree: u32,
        factors: &mut Vec<RatedPolynomial>,
        pairs: &mut Vec<ConjugatePair>,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let setting = self.setting;
        let all = monomials::up_to(self.variables, setting.dimension(), degree);
        let all = setting.independent(all, self.variables);
        let mut seen: Vec<Vec<Vec<u32>>> = Vec::new();
        for prime in 0..PRIMES[usize::from(degree > 2)] {
            let Some(at) = self.setting.split(prime, 0) else { return Ok(()) };
            let (candidates, is_whole) = self.candidates(&at, &all, factors)?;
            let mut open: Vec<Terms> = Vec::new();
            for terms in candidates {
                match self.rational(&terms, &at.modulus)? {
                    Some(formula) => self.tell(&formula, degree, factors, report)?,
                    None => open.push(terms),
                }
            }
            for terms in &open {
                let support: Vec<Vec<u32>> = terms.iter().map(|(own, _)| own.clone()).collect();
                if seen.contains(&support) || !setting.steps.takes(0.0) {
                    continue;
                }
                let same = |other: &&Terms| other.iter().map(|(own, _)| own).eq(support.iter());
                let mut count = open.iter().filter(same).count();
                seen.push(support.clone());
                for formula in self.separate(&support, count, factors)? {
                    let before = factors.len();
                    self.tell(&formula, degree, factors, report)?;
                    count = count.saturating_sub(factors.len() - before);
                }
                if count == 0 || !self.is_factor_together(&at, &open, &support)? {
                    continue;
                }
                if count <= CONJUGATES
                    && let Some(formula) = self.conjugates(&support, count, factors)?
                {
                    let before = factors.len();
                    self.tell(&formula, degree * count as u32, factors, report)?;
                    // On a level the product may be one of known factors.
                    if count == 2 && (factors.len() > before || setting.shape.is_some()) {
                        pairs.extend(self.pair(&support, degree, &factors[..before])?);
                    }
                    // The product of two pairs may have a factor for each.
                    if count > 2 && factors.len() > before + 1 {
                        for index in before..factors.len() {
                            let mut others = factors.clone();
                            others.remove(index);
                            pairs.extend(self.pair(&support, degree, &others)?);
                        }
                    }
                }
            }
            if is_whole {
                break;
            }
        }
        Ok(())
    }

    /// Candidates in these monomials for one choice of the parameters, and whether they are all.
    pub fn candidates(
        &self,
        at: &PrimePoint,
        all: &[Vec<u32>],
        factors: &[RatedPolynomial],
    ) -> Result<(Vec<Terms>, bool), SearchError> {
        let Some(line) = RandomLine::draw(self.setting, at, 0) else {
            return Ok((Vec::new(), true));
        };
        let degree = all.iter().map(|own| own.iter().sum()).max().unwrap_or(0);
        self.setting.steps.takes(monomials::steps_of(all.len(), degree, self.degree));
        let special = line.special(all, self.degree, factors)?;
        let is_whole = special.is_whole;
        let mut vectors: Vec<Vec<u64>> = Vec::new();
        let (mut open, mut is_at_rest) = (Vec::new(), false);
        for own in special.all {
            // The orbit of a point of rest is this point, and its relations say no more.
            if own.is_at_rest && own.excess > 1 {
                is_at_rest = true;
                continue;
            }
            // Where the motion on f = 0 has integrals of its own, there are further relations.
            match (own.excess, own.echelon.null_space().as_mut_slice()) {
                (1, [only]) => vectors.push(std::mem::take(only)),
                _ => open.push(own),
            }
        }
        if is_at_rest {
            vectors.extend(self.rests(at, all, factors)?);
        }
        if !open.is_empty() && open.len() <= MOST_CANDIDATES {
            let own = open.into_iter().map(|own| own.echelon).collect();
            let Some(shared) = self.shared(at, all, factors, own)? else {
                return Ok((Vec::new(), true));
            };
            vectors.extend(shared);
        }
        vectors.order();
        vectors.dedup();
        vectors.truncate(MOST_CANDIDATES);
        let terms = |vector: Vec<u64>| {
            let own = all.iter().cloned().zip(vector).filter(|(_, entry)| *entry != 0);
            own.collect::<Terms>()
        };
        let mut found = Vec::new();
        for own in vectors.into_iter().map(terms) {
            // On a conic there are relations on levels of known integrals as well.
            if self.setting.conic.is_none() || self.has_cofactor(at, &own)? {
                found.push(own);
            }
        }
        Ok((found, is_whole))
    }

    /// Polynomials in these monomials on whose zeros the variables do not change, if they are unique.
    fn rests(
        &self,
        at: &PrimePoint,
        all: &[Vec<u32>],
        factors: &[RatedPolynomial],
    ) -> Result<Vec<Vec<u64>>, SearchError> {
        let m = at.modulus;
        let mut lines: Vec<Vec<Vec<u64>>> = Vec::new();
        for number in 0..(all.len() + SPARE_ORDERS) as u64 {
            let Some(line) = RandomLine::draw(self.setting, at, number) else { break };
            let places = line.rests(self.variables, self.degree, factors)?;
            let row = |point: &PrimePhasePoint| {
                all.iter().map(|own| value(&m, &point.state, own)).collect::<Vec<u64>>()
            };
            lines.push(places.iter().map(row).collect());
        }
        lines.retain(|rows| !rows.is_empty());
        if lines.len() < all.len() {
            return Ok(Vec::new());
        }
        // One point of each line, in all ways if there are few.
        let (chosen, others) = lines.split_at(all.len() - 1);
        let ways: f64 = chosen.iter().map(|rows| rows.len() as f64).product();
        let mut found: Vec<Vec<u64>> = Vec::new();
        let mut take = |rows: &mut dyn Iterator<Item = &Vec<u64>>| {
            let mut echelon = Echelon::new(all.len(), m);
            rows.for_each(|row| {
                echelon.push(row.clone());
            });
            let vanishes = |vector: &[u64], row: &[u64]| {
                let terms = vector.iter().zip(row).map(|(a, b)| m.mul(*a, *b));
                terms.fold(0, |sum, term| m.add(sum, term)) == 0
            };
            if let [vector] = &echelon.null_space()[..]
                && others.iter().all(|rows| rows.iter().any(|row| vanishes(vector, row)))
                && !found.contains(vector)
            {
                found.push(vector.clone());
            }
        };
        if ways > MOST_WAYS {
            take(&mut lines.iter().flatten());
            return Ok(found);
        }
        for way in 0..ways as usize {
            self.setting.effort.halt.check()?;
            let mut rest = way;
            take(&mut chosen.iter().map(|rows| {
                let row = &rows[rest % rows.len()];
                rest /= rows.len();
                row
            }));
        }
        Ok(found)
    }

    /// Polynomial whose coefficients are small fractions.
    fn rational(&self, terms: &Terms, m: &Modulus) -> Result<Option<Formula>, FormulaError> {
        let numbers: Option<Vec<Rational>> =
            terms.iter().map(|(_, image)| reconstruct(*image, m)).collect();
        let names = &self.setting.terms;
        let monomials: Vec<Formula> =
            terms.iter().map(|(own, _)| power_product(names, own)).collect::<Result<_, _>>()?;
        let Some(numbers) = numbers else { return Ok(None) };
        // Each residue has some fraction of this size by chance once in 2¹⁸.
        let small = |value: &Rational| value.parts().1 <= BigInt::from(1 << 16);
        numbers.iter().all(small).then(|| sum(&numbers, &monomials)).transpose()
    }

    /// Writes the product of all candidates with this support, which are conjugate, or one whose
    /// coefficients depend on the parameters.
    fn conjugates(
        &self,
        support: &[Vec<u32>],
        count: usize,
        factors: &[RatedPolynomial],
    ) -> Result<Option<Formula>, SearchError> {
        let one: Terms = support.iter().map(|own| (own.clone(), 1)).collect();
        let mut monomials = vec![vec![0; self.setting.dimension()]];
        for _ in 0..count {
            let mut next: Vec<Vec<u32>> = Vec::new();
            for (own, other) in monomials.iter().flat_map(|own| one.iter().map(move |o| (own, o))) {
                let added: Vec<u32> = own.iter().zip(&other.0).map(|(a, b)| a + b).collect();
                if !next.contains(&added) {
                    next.push(added);
                }
            }
            monomials = next;
        }
        monomials.order_by_key(|own| (own.iter().sum::<u32>(), std::cmp::Reverse(own.clone())));
        let make = |at: &PrimePoint| {
            let candidates = self.candidates(at, support, factors).ok()?.0;
            let full: Vec<Terms> =
                candidates.into_iter().filter(|own| own.len() == support.len()).collect();
            (full.len() == count).then_some(())?;
            let all = product(&at.modulus, &full, self.setting.dimension());
            Some(monomials.iter().map(|own| all.get(own).copied().unwrap_or(0)).collect())
        };
        let images = Images { setting: self.setting, width: monomials.len(), is_split: true, make };
        let Some(coefficients) = images::coefficients(&images)? else { return Ok(None) };
        let functions = self.setting.functions(&monomials)?;
        Ok(coefficients.sum(&(0..monomials.len()).collect::<Vec<_>>(), &functions)?)
    }

    /// The two candidates with this support, as conjugates.
    fn pair(
        &self,
        support: &[Vec<u32>],
        degree: u32,
        factors: &[RatedPolynomial],
    ) -> Result<Option<ConjugatePair>, SearchError> {
        ConjugatePair::of(self.setting, support, degree, |at| {
            let candidates = self.candidates(at, support, factors).ok()?.0;
            let own = candidates.into_iter().filter(|own| own.len() == support.len());
            let own = own.map(|own| own.into_iter().map(|(_, entry)| entry).collect());
            own.collect::<Vec<Vec<u64>>>().try_into().ok()
        })
    }

    /// Judges the factors of a polynomial, each together with its cofactor. One whose cofactor is 0, an
    /// integral, is kept but not reported.
    pub fn tell(
        &self,
        formula: &Formula,
        degree: u32,
        factors: &mut Vec<RatedPolynomial>,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let divided = adjoin::polynomial_factors(self.setting.case, formula)?;
        if divided.is_empty() {
            return self.tell_factor(formula, degree, factors, report);
        }
        for (own, degree) in divided {
            self.tell_factor(&own, degree, factors, report)?;
        }
        Ok(())
    }

    fn tell_factor(
        &self,
        formula: &Formula,
        degree: u32,
        factors: &mut Vec<RatedPolynomial>,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let known = factors.iter().any(|factor| factor.formula.text() == formula.text());
        let Some(factor) = RatedPolynomial::of(self.setting, formula, degree)?.filter(|_| !known)
        else {
            return Ok(());
        };
        // A product of known factors is not new.
        let Some(at) = self.setting.split(0, 0) else { return Ok(()) };
        let line = RandomLine::draw(self.setting, &at, 0);
        let Some(line) = line else { return Ok(()) };
        if !line.has_more(&factor, factors)? {
            return Ok(());
        }
        let Some(cofactor) = factor.cofactor(self.setting, self.variables, self.degree)? else {
            return Ok(());
        };
        if !cofactor.constant().is_some_and(|value| value.is_zero()) {
            let rate = (cofactor.bracketed() * &formula.bracketed())?;
            let statement = OrbitStatement::Rate { function: formula.clone(), rate };
            let is_adjoined =
                |origin: ExtendedCase<'_>| origin.extension.exponent(formula).is_some();
            let with = Some(Given::Cofactor(cofactor.clone()));
            if !self.setting.origin.is_some_and(is_adjoined)
                && !claims::other(
                    self.setting,
                    FoundKind::DarbouxPolynomial,
                    formula,
                    &statement,
                    with,
                    report,
                )?
            {
                return Ok(());
            }
        }
        factors.push(factor);
        Ok(())
    }

    /// Takes up numerators and denominators of rational integrals, without the factors that are known and
    /// polynomial integrals.
    pub fn parts(
        &self,
        known: &IndependentIntegrals,
        factors: &mut Vec<RatedPolynomial>,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        for (formula, degree) in &known.parts {
            self.setting.effort.halt.check()?;
            let own = factors.iter().map(|own| &own.formula);
            let others = own.chain(known.formulas());
            let others: Vec<Formula> =
                others.filter(|own| own.text() != formula.text()).cloned().collect();
            let reduced = adjoin::reduced(self.setting.case, formula, &others)?;
            let own = reduced.as_ref().unwrap_or(formula);
            if own.constant().is_none() {
                self.tell(own, *degree, factors, report)?;
            }
        }
        Ok(())
    }
}

/// Product of polynomials modulo a prime.
pub fn product(m: &Modulus, all: &[Terms], dimension: usize) -> FxHashMap<Vec<u32>, u64> {
    let mut made = FxHashMap::default();
    made.insert(vec![0; dimension], m.one());
    for terms in all {
        let mut next: FxHashMap<Vec<u32>, u64> = FxHashMap::default();
        for (own, value) in &made {
            for (other, factor) in terms {
                let added: Vec<u32> = own.iter().zip(other).map(|(a, b)| a + b).collect();
                let entry = next.entry(added).or_insert(0);
                *entry = m.add(*entry, m.mul(*value, *factor));
            }
        }
        made = next;
    }
    made
}
