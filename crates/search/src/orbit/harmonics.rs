//! Integrals with sines and cosines, or exponentials, of coordinates on which no rate depends.
//!
//! Let no rate contain φ, and A and B be functions of the other variables. A cos mφ + B sin mφ is an integral
//! if v(A) = −m φ' B and v(B) = m φ' A, that is if v(A − iB) = −i m φ' (A − iB), and A e^(mφ) if v(A) = −m φ' A:
//! Darboux functions whose cofactor is known. The equations are linear in the coefficients of polynomials A and
//! B, and solved at random states modulo a prime in whose field i is.

use liouville::case::Case;
use liouville::formula::{Formula, FormulaError};
use liouville::number::rational::Rational;

use super::super::ansatz::coefficients::Ratio;
use super::super::ansatz::monomials::power_product;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::super::terms::{is_one, recorded};
use super::super::{Effort, SearchError, SearchReport};
use super::images::{self, Images};
use super::monomials::{self, value};
use super::phase::{Multiple, Phase};
use super::quotients::rate_of_monomial;
use super::setting::{OrbitSetting, SPARE_ORDERS};
use super::{adjoin, claims, degree_of_field, found};

/// Largest number of monomials of A.
const MONOMIALS: usize = 220;
/// Largest degree of A.
const DEGREE: u32 = 6;
/// Largest number of coordinates.
const COORDINATES: usize = 3;
/// Largest number of parameters that are tried as multiples.
const PARAMETERS: usize = 2;
/// Largest number of null vectors that are judged.
const VECTORS: usize = 4;

/// Searches for such integrals if some may be missing; proved ones go into the report.
pub fn search(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let known = found(case, effort, report)?;
    let coordinates = cyclic(case)?;
    if !effort.by_factors
        || coordinates.is_empty()
        || coordinates.len() > COORDINATES
        || known.len() + case.model.level.len() + 1 >= case.model.dimension()
    {
        return Ok(());
    }
    progress("sines and exponentials of cyclic coordinates");
    let extension = adjoin::extended(case, effort, &[], &[], Vec::new())?;
    let made = match &extension {
        Some(extension) => OrbitSetting::extended(case, extension, effort)?,
        None => OrbitSetting::of(case, effort)?,
    };
    match made {
        // Of a linear field there are others.
        Ok(setting)
            if extension.is_none() && degree_of_field(&setting)?.is_some_and(|own| own < 2) =>
        {
            Ok(())
        }
        Ok(setting) if !setting.flow.is_map => {
            HarmonicSearch::of(&setting, coordinates)?.search(known.len(), report)
        }
        _ => Ok(()),
    }
}

/// Components of the state on which no rate depends, and whose own rates are no numbers.
fn cyclic(case: &Case) -> Result<Vec<usize>, SearchError> {
    let (graph, field) = recorded(case, |jet| jet.phase.field().to_vec())?;
    let first = case.model.free_components();
    let is_cyclic = |k: &usize| {
        graph.inputs_of(field[*k]).iter().any(|input| *input >= first)
            && field.iter().all(|rate| !graph.depends_on(*rate, first + k))
    };
    Ok((0..case.model.dimension()).filter(is_cyclic).collect())
}

/// The search in the variables of one field.
struct HarmonicSearch<'s, 'c> {
    setting: &'s OrbitSetting<'c>,
    coordinates: Vec<usize>,
    /// Variables that A and B may contain.
    variables: Vec<usize>,
}

impl<'s, 'c> HarmonicSearch<'s, 'c> {
    fn of(setting: &'s OrbitSetting<'c>, coordinates: Vec<usize>) -> Result<Self, SearchError> {
        let (graph, field) = recorded(setting.case, |jet| jet.phase.field().to_vec())?;
        let first = setting.case.model.free_components();
        let occurs = |k: &usize| field.iter().any(|rate| graph.depends_on(*rate, first + k));
        let variables = (0..setting.dimension()).filter(occurs).collect();
        Ok(Self { setting, coordinates, variables })
    }

    /// Tries the phases, simple ones first, until enough integrals are found.
    fn search(&self, known: usize, report: &mut SearchReport) -> Result<(), SearchError> {
        let Some(at) = self.setting.split(0, 0) else { return Ok(()) };
        let m = at.modulus;
        let Some(root) = m.root(m.sub(0, m.one())) else { return Ok(()) };
        let Some(rows) = self.rows(&at)? else { return Ok(()) };
        let before = report.functions("integral").count();
        let case = claims::judged_case(self.setting);
        let most = case.model.dimension() - case.model.level.len();
        for phase in self.phases() {
            self.setting.effort.halt.check()?;
            let Some(factor) = phase.factor(&at) else { continue };
            let factor = if phase.is_circular { m.mul(root, factor) } else { factor };
            self.try_phase(&at, &phase, &rows, factor, report)?;
            let found = report.functions("integral").count() - before;
            if known + found + 1 >= most {
                break;
            }
        }
        Ok(())
    }

    /// Phases, simple ones first.
    fn phases(&self) -> Vec<Phase> {
        let numbers = [(1, 1), (2, 1), (1, 2)].map(|(a, b)| Multiple::Number(Rational::new(a, b)));
        let parameters = self.setting.coordinates().len().min(PARAMETERS);
        let named = (0..parameters).flat_map(|place| {
            [false, true].map(|is_below| Multiple::Parameter { place, is_below })
        });
        let multiples: Vec<Multiple> = numbers.into_iter().chain(named).collect();
        let single = self.coordinates.iter().map(|k| vec![(*k, false)]);
        let mut all: Vec<Vec<(usize, bool)>> = single.collect();
        for (place, k) in self.coordinates.iter().enumerate() {
            for other in &self.coordinates[..place] {
                all.extend([false, true].map(|sign| vec![(*other, false), (*k, sign)]));
            }
        }
        let mut phases = Vec::new();
        for (place, multiple) in multiples.into_iter().enumerate() {
            for parts in all.iter().filter(|own| own.len() == 1 || place == 0) {
                let (parts, multiple) = (parts.clone(), multiple.clone());
                let turned = parts.iter().map(|(k, sign)| (*k, !sign)).collect();
                phases.push(Phase {
                    is_circular: true,
                    parts: parts.clone(),
                    multiple: multiple.clone(),
                });
                for parts in [parts, turned] {
                    phases.push(Phase { is_circular: false, parts, multiple: multiple.clone() });
                }
            }
        }
        phases
    }

    /// Monomials of A up to a degree.
    fn monomials(&self, degree: u32) -> Vec<Vec<u32>> {
        let all = monomials::up_to(&self.variables, self.setting.dimension(), degree);
        self.setting.standard(all)
    }

    /// Values and rates at random states of the monomials of all degrees that are tried, and the rates of the
    /// state there.
    fn rows(&self, at: &PrimePoint) -> Result<Option<StateRows>, SearchError> {
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

    /// Looks for the integrals of one phase of the lowest degree.
    fn try_phase(
        &self,
        at: &PrimePoint,
        phase: &Phase,
        rows: &StateRows,
        factor: u64,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let m = at.modulus;
        let mut echelon = Echelon::new(rows.all.len(), m);
        for own in &rows.states {
            let growth = m.mul(factor, phase.rate(at, &own.state));
            let entries = own.rates.iter().zip(&own.values);
            echelon
                .push(entries.map(|(rate, value)| m.add(*rate, m.mul(growth, *value))).collect());
        }
        self.setting.steps.takes(echelon.steps() as f64);
        // Monomials of low degree come first, so that the last one of a vector is of its degree.
        let degree = |column: &usize| rows.all[*column].iter().sum::<u32>();
        let free = echelon.free();
        let Some(lowest) = free.iter().map(degree).min() else { return Ok(()) };
        let mut own: Vec<usize> = free.into_iter().filter(|k| degree(k) == lowest).collect();
        own.truncate(VECTORS);
        let mut support: Vec<usize> = Vec::new();
        for column in own {
            let vector = echelon.null_vector(column);
            support.extend((0..vector.len()).filter(|k| vector[*k] != 0));
        }
        support.sort_unstable();
        support.dedup();
        let monomials: Vec<Vec<u32>> = support.iter().map(|k| rows.all[*k].clone()).collect();
        for vector in self.real(at, phase, &columns(phase, &monomials))?.into_iter().take(VECTORS) {
            self.setting.effort.halt.check()?;
            let all = columns(phase, &monomials);
            let own = all.into_iter().zip(&vector).filter(|(_, entry)| **entry != 0);
            let own: Vec<TermColumn> = own.map(|(column, _)| column).collect();
            if let Some(formula) = self.formula(phase, &own)? {
                claims::integral(self.setting, &formula, report)?;
            }
        }
        Ok(())
    }

    /// Null vectors of the real equations on some columns.
    fn real(
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

    /// The integral with these columns, for all values of the parameters.
    fn formula(
        &self,
        phase: &Phase,
        support: &[TermColumn],
    ) -> Result<Option<Formula>, SearchError> {
        let make = |at: &PrimePoint| self.real(at, phase, support).ok()?.pop();
        let images = Images { setting: self.setting, width: support.len(), is_split: false, make };
        let Some(coefficients) = images::coefficients(&images)? else { return Ok(None) };
        let argument = phase.argument(self.setting)?;
        let term = |own: &TermColumn| -> Result<Ratio, FormulaError> {
            let name = match (phase.is_circular, own.is_odd) {
                (true, true) => "sin",
                (true, false) => "cos",
                (false, _) => "exp",
            };
            let function = Formula::call(name, &[&argument])?;
            let product = power_product(&self.setting.terms, &own.monomial)?;
            Ok(Ratio::of(match is_one(&product) {
                true => function,
                false => (&product * &function)?,
            }))
        };
        let functions: Vec<Ratio> = support.iter().map(term).collect::<Result<_, _>>()?;
        let places: Vec<usize> = (0..support.len()).collect();
        Ok(coefficients.sum(&places, &functions)?)
    }
}

/// Monomials with their values and rates at random states.
struct StateRows {
    all: Vec<Vec<u32>>,
    states: Vec<StateRow>,
}

impl StateRows {
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
struct TermColumn {
    monomial: Vec<u32>,
    is_odd: bool,
}

/// Columns of the real equations.
fn columns(phase: &Phase, monomials: &[Vec<u32>]) -> Vec<TermColumn> {
    let parities: &[bool] = if phase.is_circular { &[false, true] } else { &[false] };
    let of = |is_odd: &bool| {
        let is_odd = *is_odd;
        monomials.iter().map(move |own| TermColumn { monomial: own.clone(), is_odd })
    };
    parities.iter().flat_map(of).collect()
}
