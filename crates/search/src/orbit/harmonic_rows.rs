//! Equations for integrals with sines, cosines or exponentials of cyclic coordinates, at random states modulo a
//! prime.

use super::super::SearchError;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::harmonics::HarmonicSearch;
use super::monomials::{self, value};
use super::phase::Phase;
use super::quotients::rate_of_monomial;
use super::setting::SPARE_ORDERS;

/// Largest number of monomials of A.
const MONOMIALS: usize = 220;
/// Largest degree of A.
const DEGREE: u32 = 6;

impl HarmonicSearch<'_, '_> {
    /// Monomials of A up to a degree.
    fn monomials(&self, degree: u32) -> Vec<Vec<u32>> {
        let all = monomials::up_to(&self.variables, self.setting.dimension(), degree);
        self.setting.standard(all)
    }

    /// Values and rates at random states of the monomials of all degrees that are tried, and the rates of the
    /// state there.
    pub fn rows(&self, at: &PrimePoint) -> Result<Option<StateRows>, SearchError> {
        let few = |degree: &u32| {
            monomials::count(self.variables.len(), *degree) <= 4 * MONOMIALS
                && self.monomials(*degree).len() <= MONOMIALS
        };
        let Some(degree) = (1..=DEGREE).take_while(few).last() else { return Ok(None) };
        let all = self.monomials(degree);
        let wanted = all.len() + SPARE_ORDERS;
        let mut rows = StateRows { all, states: Vec::new() };
        for number in 0..4 * wanted as u64 {
            self.setting.effort.halt.check()?;
            if let Some(own) = self.row(at, number, &rows.all)? {
                rows.states.push(own);
            }
            if rows.states.len() == wanted {
                return Ok(Some(rows.independent(at)));
            }
        }
        Ok(None)
    }

    fn row(
        &self,
        at: &PrimePoint,
        number: u64,
        all: &[Vec<u32>],
    ) -> Result<Option<StateRow>, SearchError> {
        let m = at.modulus;
        let Some((point, orbit)) = self.setting.orbit(at, number, 2)? else { return Ok(None) };
        let rates = |k: usize| orbit[k][1];
        Ok(Some(StateRow {
            values: all.iter().map(|own| value(&m, &point.state, own)).collect(),
            rates: all.iter().map(|own| rate_of_monomial(at, &point, &rates, own)).collect(),
            state: (0..self.setting.dimension()).map(rates).collect(),
        }))
    }

    /// Null vectors of the real equations on some columns.
    pub fn real(
        &self,
        at: &PrimePoint,
        phase: &Phase,
        all: &[TermColumn],
    ) -> Result<Vec<Vec<u64>>, SearchError> {
        let m = at.modulus;
        let Some(factor) = phase.factor(at) else { return Ok(Vec::new()) };
        let monomials: Vec<Vec<u32>> = all.iter().map(|own| own.monomial.clone()).collect();
        let mut echelon = Echelon::new(all.len(), m);
        let mut dependent = 0;
        for number in 0..4 * (all.len() + SPARE_ORDERS) as u64 {
            self.setting.effort.halt.check()?;
            let Some(own) = self.row(at, number, &monomials)? else { continue };
            let growth = m.mul(factor, phase.rate(at, &own.state));
            // Of cos mφ and of sin mφ.
            for is_odd in [false, true] {
                if is_odd && !phase.is_circular {
                    continue;
                }
                let entry = |k: usize| {
                    let turned = m.mul(growth, own.values[k]);
                    match (phase.is_circular, all[k].is_odd == is_odd, is_odd) {
                        (false, ..) => m.add(own.rates[k], turned),
                        (true, true, _) => own.rates[k],
                        (true, false, false) => turned,
                        (true, false, true) => m.sub(0, turned),
                    }
                };
                let is_new = echelon.push((0..all.len()).map(entry).collect());
                dependent = if is_new { 0 } else { dependent + 1 };
            }
            if dependent >= SPARE_ORDERS {
                return Ok(echelon.null_space());
            }
        }
        Ok(Vec::new())
    }
}

/// Monomials with their values and rates at random states.
pub struct StateRows {
    /// Monomials.
    pub all: Vec<Vec<u32>>,
    states: Vec<StateRow>,
}

impl StateRows {
    /// The equations v(A) + (growth of the phase) A = 0 for the coefficients of A.
    pub fn equations(&self, at: &PrimePoint, phase: &Phase, factor: u64) -> Echelon {
        let m = at.modulus;
        let mut echelon = Echelon::new(self.all.len(), m);
        for own in &self.states {
            let growth = m.mul(factor, phase.rate(at, &own.state));
            let entries = own.rates.iter().zip(&own.values);
            echelon
                .push(entries.map(|(rate, value)| m.add(*rate, m.mul(growth, *value))).collect());
        }
        echelon
    }

    /// Leaves out monomials whose values are combinations of those before them, as relations between functions
    /// make them.
    fn independent(mut self, at: &PrimePoint) -> Self {
        let mut echelon = Echelon::new(self.all.len(), at.modulus);
        self.states.iter().for_each(|own| {
            echelon.push(own.values.clone());
        });
        let kept: Vec<usize> = (0..self.all.len()).filter(|k| echelon.has_pivot(*k)).collect();
        let of = |own: &[u64]| kept.iter().map(|k| own[*k]).collect::<Vec<u64>>();
        for state in &mut self.states {
            (state.values, state.rates) = (of(&state.values), of(&state.rates));
        }
        self.all = kept.iter().map(|k| self.all[*k].clone()).collect();
        self
    }
}

/// Values and rates of monomials at one state, and the rates of the state.
struct StateRow {
    values: Vec<u64>,
    rates: Vec<u64>,
    state: Vec<u64>,
}

/// A monomial times the sine, or the cosine or exponential, of a phase.
#[derive(Clone, Debug)]
pub struct TermColumn {
    /// Exponents of the monomial.
    pub monomial: Vec<u32>,
    /// Whether it is the sine.
    pub is_odd: bool,
}

/// Columns of the real equations.
pub fn columns(phase: &Phase, monomials: &[Vec<u32>]) -> Vec<TermColumn> {
    let parities: &[bool] = if phase.is_circular { &[false, true] } else { &[false] };
    let of = |is_odd: &bool| {
        let is_odd = *is_odd;
        monomials.iter().map(move |own| TermColumn { monomial: own.clone(), is_odd })
    };
    parities.iter().flat_map(of).collect()
}
