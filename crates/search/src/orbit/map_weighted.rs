//! Integrals P ρ of maps, with a polynomial P and the density ρ of a preserved measure.
//!
//! (P ρ)∘Φ = P ρ is linear in the coefficients of P: one row for each random point modulo a prime. So the
//! integrals of Lyness' and Todd's maps are found over x y and x y z.

use crate::echelon::nonzero;
use liouville::formula::Formula;
use liouville::graph::Tape;

use super::super::ansatz::note_unwritten;
use super::super::ansatz::system::PrimePoint;
use super::super::terms::recorded;
use super::super::{FoundKind, SearchError, SearchReport};
use super::claims;
use super::known::IndependentIntegrals;
use super::map_rows::MapRows;
use super::monomials::{self, value};
use super::relations::combined_gradient;
use super::setting::{OrbitSetting, PrimePhasePoint, run};
use super::sparse::sparse;

/// Highest degree of P.
const DEGREE: u32 = 6;
/// Largest number of monomials of P.
const MONOMIALS: usize = 220;

/// Searches for integrals P ρ of a map with each density ρ of a report, low degrees of P first, until
/// `wanted` integrals are known.
pub fn search(
    setting: &OrbitSetting<'_>,
    wanted: usize,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let densities: Vec<Formula> = report.functions(FoundKind::Density).cloned().collect();
    let variables: Vec<usize> = (0..setting.dimension()).collect();
    if setting.is_on_level() || setting.has_lists() {
        return Ok(());
    }
    for density in densities.iter().filter(|own| own.constant().is_none()) {
        let (graph, tape) = recorded(setting.case, |jet| {
            let value = jet.phase.scalar(density);
            let slopes = jet.along_axes().iter().map(|own| own.scalar(density).eps);
            let mut outputs = jet.phase.field().to_vec();
            outputs.push(value);
            outputs.extend(slopes.collect::<Vec<_>>());
            outputs
        })?;
        let search = WeightedSearch { setting, density, tape: &Tape::new(&graph, &tape) };
        for degree in 1..=DEGREE {
            let all = monomials::up_to(&variables, setting.dimension(), degree);
            if all.len() > MONOMIALS || report.functions(FoundKind::Integral).count() >= wanted {
                break;
            }
            search.of_degree(&all, report)?;
        }
    }
    Ok(())
}

/// The search with one density.
struct WeightedSearch<'s, 'c> {
    setting: &'s OrbitSetting<'c>,
    density: &'s Formula,
    /// Images of the state, the density, and its slopes.
    tape: &'s Tape,
}

impl WeightedSearch<'_, '_> {
    fn of_degree(&self, all: &[Vec<u32>], report: &mut SearchReport) -> Result<(), SearchError> {
        let setting = self.setting;
        let Some(at) = setting.at(0, 0) else { return Ok(()) };
        let rows = MapRows { setting, tape: self.tape, has_density: true };
        let Some(echelon) = rows.echelon(&at, all)? else { return Ok(()) };
        let vectors = sparse(&at.modulus, echelon.null_space());
        let known = IndependentIntegrals::of(setting, report)?;
        let Some((point, mut gradients)) = known.gradients(setting, &at)? else { return Ok(()) };
        for vector in vectors {
            setting.effort.halt.check()?;
            let support = nonzero(&vector);
            let picked: Vec<Vec<u32>> = support.iter().map(|k| all[*k].clone()).collect();
            let values: Vec<u64> = support.iter().map(|k| vector[*k]).collect();
            let Some(gradient) = self.gradient(&at, &picked, &values, &point) else { continue };
            if !gradients.push(&at, gradient) {
                continue;
            }
            match rows.solution(&picked)? {
                Some(polynomial) => {
                    claims::integral(setting, &self.written(&polynomial)?, report)?;
                }
                None => {
                    let what = format!("an integral with {} terms over a density", support.len());
                    note_unwritten(setting.case, &what, report);
                }
            }
        }
        Ok(())
    }

    /// P ρ, as P/Q where ρ = 1/Q is written so.
    fn written(&self, polynomial: &Formula) -> Result<Formula, SearchError> {
        let below = self.density.text().strip_prefix("1/");
        let below = below.and_then(|text| self.setting.case.formula(text).ok());
        Ok(match below {
            Some(below) => (&polynomial.bracketed() / &below.bracketed())?,
            None => (&polynomial.bracketed() * self.density)?,
        })
    }

    /// Gradient of P ρ at a point.
    fn gradient(
        &self,
        at: &PrimePoint,
        monomials: &[Vec<u32>],
        vector: &[u64],
        point: &PrimePhasePoint,
    ) -> Option<Vec<u64>> {
        let (m, dimension) = (at.modulus, self.setting.dimension());
        let inputs = [point.parameters.as_slice(), &point.state].concat();
        let made = run(self.tape, m, &inputs)?;
        let (density, slopes) = (made[dimension], &made[dimension + 1..]);
        let terms = monomials.iter().zip(vector);
        let polynomial = terms
            .fold(0, |sum, (own, factor)| m.add(sum, m.mul(*factor, value(&m, &point.state, own))));
        let own = combined_gradient(at, monomials, vector, point);
        let both = own.iter().zip(slopes);
        Some(both.map(|(a, b)| m.add(m.mul(*a, density), m.mul(polynomial, *b))).collect())
    }
}
