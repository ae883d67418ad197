//! Points of a random line whose orbits satisfy one more relation than other orbits.
//!
//! Where f is a Darboux polynomial and f(q) = 0, f vanishes along the orbit of q. So the matrix of the
//! Taylor coefficients of the monomials is singular there, for any choice of rows. Its
//! determinants are polynomials in the place t on the line q₀ + t q₁, and the common roots of two
//! of them are places on such f. (In the plane these are Lagutinskii's and Pereira's extactic
//! curves; Chèze, Bostan, Cluzeau and Weil compute with them.)
//!
//! Where states satisfy sin² + cos² = 1, or e^u e^(−u) = 1, a conic (q₀ + t q₁ + t² q₂)/D(t) within these
//! equations takes the place of the line: polynomials of degree n times D^n are polynomials of degree
//! 2n in t.

use liouville::number::prime::PrimePolynomials;

use super::super::SearchError;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::conic::Conic;
use super::determinants::determinants;
use super::factor::RatedPolynomial;
use super::monomials::MonomialSeries;
use super::setting::{OrbitSetting, PrimePhasePoint, SPARE_ORDERS};

/// Largest degree of a field in the state.
const DEGREE: usize = 24;

/// A random line in the space of states, or a conic on their level.
pub struct RandomLine<'s, 'c> {
    /// Case with its points.
    pub setting: &'s OrbitSetting<'c>,
    /// Prime and parameters.
    pub at: &'s PrimePoint,
    start: PrimePhasePoint,
    direction: Vec<u64>,
    conic: Option<Conic>,
}

/// The special places of a line.
#[derive(Default)]
pub struct SpecialPlaces {
    /// Those in the prime field, without the zeros of known polynomials.
    pub all: Vec<Special>,
    /// Whether there are no others in any extension of the field.
    pub is_whole: bool,
    /// Whether other orbits have no relation.
    pub is_full: bool,
}

/// Relations along the orbit of a special point.
pub struct Special {
    /// Rows of Taylor coefficients, reduced.
    pub echelon: Echelon,
    /// Number of relations beyond those of all orbits.
    pub excess: usize,
    /// Whether no monomial changes along the orbit.
    pub is_at_rest: bool,
}

impl<'s, 'c> RandomLine<'s, 'c> {
    /// Draws a line, or a conic where the states lie on one.
    pub fn draw(setting: &'s OrbitSetting<'c>, at: &'s PrimePoint, number: u64) -> Option<Self> {
        let own = Self::straight(setting, at, number)?;
        let conic = match &setting.conic {
            Some(shape) => Some(shape.draw(&at.modulus, &own.start.state, &own.direction)?),
            None => None,
        };
        Some(Self { conic, ..own })
    }

    /// Draws a line, on a level that is an affine space too.
    fn straight(setting: &'s OrbitSetting<'c>, at: &'s PrimePoint, number: u64) -> Option<Self> {
        let start = setting.point(at, (number << 1) | (1 << 40))?;
        let mut direction = setting.point(at, (number << 1) | (1 << 40) | 1)?.state;
        if setting.shape.is_some() && setting.conic.is_none() {
            let pairs = direction.iter().zip(&start.state);
            direction = pairs.map(|(x, own)| at.modulus.sub(*x, *own)).collect();
        }
        Some(Self { setting, at, start, direction, conic: None })
    }

    fn point(&self, place: u64) -> PrimePhasePoint {
        let m = &self.at.modulus;
        let state = match &self.conic {
            Some(conic) => conic.state(m, place),
            None => {
                let state = self.start.state.iter().zip(&self.direction);
                state.map(|(x, u)| m.add(*x, m.mul(place, *u))).collect()
            }
        };
        PrimePhasePoint { parameters: self.start.parameters.clone(), state }
    }

    /// Degree of the states in the place, times their denominator.
    fn order(&self) -> usize {
        if self.conic.is_some() { 2 } else { 1 }
    }

    /// Multiplies a value of a polynomial of some degree by that power of the denominator.
    fn cleared(&self, value: u64, place: u64, degree: usize) -> u64 {
        let m = &self.at.modulus;
        match &self.conic {
            Some(conic) => m.mul(value, m.power(conic.below(m, place), degree as u64)),
            None => value,
        }
    }

    /// Polynomials on the line.
    fn ring(&self) -> PrimePolynomials {
        PrimePolynomials(self.at.modulus)
    }

    /// Removes the zeros of the denominator, at which states are infinite.
    fn without_poles(&self, mut own: Vec<u64>) -> Result<Vec<u64>, SearchError> {
        let m = &self.at.modulus;
        for pole in self.conic.iter().flat_map(|conic| conic.poles) {
            own = self.without(own, &[m.sub(0, pole), m.one()])?;
        }
        Ok(own)
    }

    /// Restriction of a polynomial to the line.
    fn restricted(&self, factor: &RatedPolynomial) -> Result<Option<Vec<u64>>, SearchError> {
        let m = &self.at.modulus;
        let degree = factor.degree as usize;
        let value = |t: u64| {
            let t = m.integer(t);
            let (value, _) = factor.at(self.at, &self.point(t))?;
            Some(self.cleared(value, t, degree))
        };
        let last = (self.order() * degree) as u64;
        let values: Option<Vec<u64>> = (0..=last).map(value).collect();
        let (ring, halt) = (self.ring(), &self.setting.effort.halt);
        values.map(|values| ring.interpolated_unless(&values, &mut || halt.check())).transpose()
    }

    /// Removes all common factors with `other` from a polynomial on the line.
    fn without(&self, own: Vec<u64>, other: &[u64]) -> Result<Vec<u64>, SearchError> {
        // Every place is a zero of 0, which has no factors.
        if other.iter().all(|x| *x == 0) {
            return Ok(own);
        }
        let halt = &self.setting.effort.halt;
        self.ring().without_unless(&own, other, &mut || halt.check())
    }

    /// Whether a polynomial has a factor that none of the others has.
    pub fn has_more(
        &self,
        factor: &RatedPolynomial,
        others: &[RatedPolynomial],
    ) -> Result<bool, SearchError> {
        let Some(rest) = self.restricted(factor)? else { return Ok(false) };
        let mut rest = self.without_poles(rest)?;
        for other in others {
            if let Some(other) = self.restricted(other)? {
                rest = self.without(rest, &other)?;
            }
        }
        Ok(rest.len() > 1)
    }

    /// Degree of the field in the state; `None` if it is not a polynomial of low degree.
    pub fn degree(&self) -> Result<Option<usize>, SearchError> {
        let Some(rates) = self.rates(DEGREE + SPARE_ORDERS, 0)? else { return Ok(None) };
        let degree = rates.iter().map(|own| own.len().saturating_sub(1)).max();
        Ok(degree.filter(|degree| *degree <= DEGREE))
    }

    /// Components of a field of this degree on the line, as polynomials with at most `count` coefficients.
    fn rates(&self, count: usize, degree: usize) -> Result<Option<Vec<Vec<u64>>>, SearchError> {
        let m = &self.at.modulus;
        let mut rates = vec![Vec::new(); self.direction.len()];
        for t in 0..count as u64 {
            let t = m.integer(t);
            let Some(orbit) = self.setting.along(self.at, &self.point(t), 2)? else {
                return Ok(None);
            };
            for (own, series) in rates.iter_mut().zip(orbit) {
                own.push(self.cleared(series[1], t, degree));
            }
        }
        let (ring, halt) = (self.ring(), &self.setting.effort.halt);
        rates
            .iter()
            .map(|own| ring.interpolated_unless(own, &mut || halt.check()))
            .collect::<Result<_, _>>()
            .map(Some)
    }

    /// Points of the line at which some variables of a field of this degree do not change, without the
    /// zeros of known polynomials.
    pub fn rests(
        &self,
        variables: &[usize],
        degree: usize,
        known: &[RatedPolynomial],
    ) -> Result<Vec<PrimePhasePoint>, SearchError> {
        let (ring, halt) = (self.ring(), &self.setting.effort.halt);
        let Some(rates) = self.rates(self.order() * degree + 1, degree)? else {
            return Ok(Vec::new());
        };
        let mut common = Vec::new();
        for own in variables {
            common = ring.common_unless(&common, &rates[*own], &mut || halt.check())?;
        }
        common = self.without_poles(common)?;
        for factor in known {
            if let Some(own) = self.restricted(factor)? {
                common = self.without(common, &own)?;
            }
        }
        let roots = ring.roots_unless(&common, &mut || halt.check())?;
        Ok(roots.into_iter().map(|place| self.point(place)).collect())
    }

    fn rows(
        &self,
        place: u64,
        series: &MonomialSeries,
        orders: usize,
    ) -> Result<Option<Vec<Vec<u64>>>, SearchError> {
        let Some(orbit) = self.setting.along(self.at, &self.point(place), orders)? else {
            return Ok(None);
        };
        series.rows(&self.at.modulus, &orbit, &self.setting.effort.halt).map(Some)
    }

    /// Finds the special places on the line for polynomials in these monomials, without the zeros of
    /// known polynomials; `degree` is that of the field.
    pub fn special(
        &self,
        monomials: &[Vec<u32>],
        degree: usize,
        known: &[RatedPolynomial],
    ) -> Result<SpecialPlaces, SearchError> {
        let (m, ring, halt) = (self.at.modulus, self.ring(), &self.setting.effort.halt);
        let none = SpecialPlaces { is_whole: true, ..SpecialPlaces::default() };
        let all = MonomialSeries::of(monomials);
        let Some(generic) = self.reduced(m.integer(1 << 40), &all)? else { return Ok(none) };
        let columns: Vec<usize> =
            (0..monomials.len()).filter(|column| generic.has_pivot(*column)).collect();
        let own: Vec<Vec<u32>> = columns.iter().map(|column| monomials[*column].clone()).collect();
        let rank = own.len();
        if rank == 0 {
            return Ok(none);
        }
        let total: usize = own.iter().map(|a| a.iter().sum::<u32>() as usize).sum();
        let growth = degree.saturating_sub(1);
        let count = self.order() * (total + growth * (rank * (rank + 1) / 2)) + 2;
        // Degrees in the state of the two determinants.
        let degrees = [0, 1].map(|more| total + growth * (rank * (rank - 1) / 2 + more));
        let (mut first, mut second) = (Vec::new(), Vec::new());
        let series = MonomialSeries::of(&own);
        let steps = count as f64 * self.setting.flow.steps(rank + 1);
        self.setting.steps.takes_series(steps)?;
        self.setting.steps.takes(steps);
        for t in 0..count as u64 {
            halt.check()?;
            let Some(rows) = self.rows(m.integer(t), &series, rank + 1)? else { return Ok(none) };
            let (a, b) = determinants(&m, &rows, halt)?;
            first.push(self.cleared(a, m.integer(t), degrees[0]));
            second.push(self.cleared(b, m.integer(t), degrees[1]));
        }
        let first = ring.interpolated_unless(&first, &mut || halt.check())?;
        let second = ring.interpolated_unless(&second, &mut || halt.check())?;
        let is_full = rank == monomials.len() && !first.is_empty();
        let mut rest =
            self.without_poles(ring.common_unless(&first, &second, &mut || halt.check())?)?;
        for factor in known {
            if let Some(own) = self.restricted(factor)? {
                rest = self.without(rest, &own)?;
            }
        }
        let mut found = Vec::new();
        for place in ring.roots_unless(&rest, &mut || halt.check())? {
            let factor = [m.sub(0, place), m.one()];
            rest = self.without(rest, &factor)?;
            let Some(echelon) = self.reduced(place, &all)? else { continue };
            let pivots = (0..monomials.len()).filter(|column| echelon.has_pivot(*column)).count();
            let excess = rank.saturating_sub(pivots);
            if excess > 0 {
                let first = self.rows(place, &all, 2)?;
                let is_at_rest = first.is_some_and(|rows| rows[1].iter().all(|entry| *entry == 0));
                found.push(Special { echelon, excess, is_at_rest });
            }
        }
        Ok(SpecialPlaces { all: found, is_whole: rest.len() <= 1, is_full })
    }

    /// Taylor coefficients of the monomials at a place, reduced.
    fn reduced(&self, place: u64, series: &MonomialSeries) -> Result<Option<Echelon>, SearchError> {
        let Some(rows) = self.rows(place, series, series.count() + SPARE_ORDERS)? else {
            return Ok(None);
        };
        let mut echelon = Echelon::new(series.count(), self.at.modulus);
        let mut dependent = 0;
        for row in rows {
            self.setting.effort.halt.check()?;
            dependent = if echelon.push(row) { 0 } else { dependent + 1 };
            if dependent == SPARE_ORDERS {
                break;
            }
        }
        Ok(Some(echelon))
    }
}

/// Degree of a field in the state; `None` if it is not a polynomial of low degree.
pub fn degree_of_field(setting: &OrbitSetting<'_>) -> Result<Option<usize>, SearchError> {
    let Some(at) = setting.at(0, 0) else { return Ok(None) };
    // The field is one outside of its level, too.
    match RandomLine::straight(setting, &at, 0) {
        Some(line) => line.degree(),
        None => Ok(None),
    }
}
