//! Integrals with sines and cosines, or exponentials, of coordinates on which no rate depends.
//!
//! Let no rate contain φ, and A and B be functions of the other variables. A cos mφ + B sin mφ is an integral
//! if v(A) = −m φ' B and v(B) = m φ' A, that is if v(A − iB) = −i m φ' (A − iB), and A e^(mφ) if v(A) = −m φ' A:
//! Darboux functions whose cofactor is known. The equations are linear in the coefficients of polynomials A and
//! B, and solved at random states modulo a prime in whose field i is.

use crate::echelon::nonzero;
use liouville::case::Case;
use liouville::formula::{Formula, FormulaError};
use liouville::number::rational::Rational;

use super::super::ansatz::coefficients::Ratio;
use super::super::ansatz::monomials::power_product;
use super::super::ansatz::system::PrimePoint;
use super::super::terms::{is_one, recorded};
use super::super::{Effort, FoundKind, SearchError, SearchReport};
use super::harmonic_rows::{StateRows, TermColumn, columns};
use super::images::{self, Images};
use super::known::has_all;
use super::phase::{Multiple, Phase};
use super::setting::OrbitSetting;
use super::{adjoin, claims, degree_of_field, found};

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
    if !effort.by_factors || has_all(case, known.len() + case.model.level.len()) {
        return Ok(());
    }
    let coordinates = cyclic(case)?;
    if coordinates.is_empty() || coordinates.len() > COORDINATES {
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
pub struct HarmonicSearch<'s, 'c> {
    /// Case with its points.
    pub setting: &'s OrbitSetting<'c>,
    coordinates: Vec<usize>,
    /// Variables that A and B may contain.
    pub variables: Vec<usize>,
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
        let before = report.functions(FoundKind::Integral).count();
        let case = claims::judged_case(self.setting);
        let most = case.model.dimension() - case.model.level.len();
        for phase in self.phases() {
            self.setting.effort.halt.check()?;
            let Some(factor) = phase.factor(&at) else { continue };
            let factor = if phase.is_circular { m.mul(root, factor) } else { factor };
            self.try_phase(&at, &phase, &rows, factor, report)?;
            let found = report.functions(FoundKind::Integral).count() - before;
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

    /// Looks for the integrals of one phase of the lowest degree.
    fn try_phase(
        &self,
        at: &PrimePoint,
        phase: &Phase,
        rows: &StateRows,
        factor: u64,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let echelon = rows.equations(at, phase, factor);
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
            support.extend(nonzero(&vector));
        }
        support.sort_unstable();
        support.dedup();
        let monomials: Vec<Vec<u32>> = support.iter().map(|k| rows.all[*k].clone()).collect();
        let all = columns(phase, &monomials);
        for vector in self.real(at, phase, &all)?.into_iter().take(VECTORS) {
            self.setting.effort.halt.check()?;
            let own = all.iter().zip(&vector).filter(|(_, entry)| **entry != 0);
            let own: Vec<TermColumn> = own.map(|(column, _)| column.clone()).collect();
            if let Some(formula) = self.formula(phase, &own)? {
                claims::integral(self.setting, &formula, report)?;
            }
        }
        Ok(())
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
