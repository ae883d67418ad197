//! Densities that are products of powers of factors offered by the geometry, and integrals that are
//! such products with a factor linear in the velocities.
//!
//! v(ln ρ) + div v is linear in the exponents of ρ = Π f^α, and so is v(ln F) for F = P Π f^α.

use super::ask::{holds, judged_alone};
use super::integrals::tell;
use super::library;
use super::linear::SampledFunctions;
use super::orbit::merged;
use super::terms::{Power, multiplied, one, powers, recorded};
use super::written::mass_densities;
use super::{Effort, Found, FoundKind, SearchError, SearchReport};
use liouville::case::Case;
use liouville::claim::{Claim, LevelSubset};
use liouville::formula::Formula;
use liouville::graph::{Expr, Graph};
use liouville::number::rational::Rational;
use liouville::verdict::Verdict;

/// Factors, exponents, and their rates along the motion.
struct Logarithms {
    factors: Vec<Formula>,
    exponents: Vec<Formula>,
    graph: Graph,
    /// Products of v(ln f) with each exponent, factor by factor.
    rates: Vec<Vec<Expr>>,
}

/// Searches for densities and integrals of this form.
pub fn densities(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let model = &case.model;
    let factors = library::factors(model);
    let exponents = library::exponents(model);
    let forms = library::linear_factors(model);
    let kept = LevelSubset::level(model).kept;
    let (graph, (divergence, rates, moving)) = recorded(case, |jet| {
        let moved = jet.along_field();
        let growth =
            |term: &Formula| term.logarithmic_derivative(&mut |symbol| moved.value(symbol));
        let mut rates = Vec::new();
        for factor in &factors {
            let rate = growth(factor);
            rates.extend(exponents.iter().map(|t| vec![rate * jet.phase.scalar(t)]));
        }
        let moving: Vec<Vec<Expr>> = forms.iter().map(|form| vec![growth(form)]).collect();
        (vec![jet.divergence() - jet.level_cofactor(&kept)], rates, moving)
    })?;
    let logarithms = Logarithms { factors, exponents, graph, rates };
    match logarithms.solve(case, divergence, effort)? {
        Exponents::Found(product) => {
            let formula = multiplied(&product)?;
            let judged = judged_alone(case, Claim::density(&formula), effort)?;
            if let Some(found) = judged.filter(holds) {
                report.found.push(Found::new(FoundKind::Density, &formula, None, found, model));
            }
        }
        Exponents::Unknown => tell_volume(case, effort, report)?,
        Exponents::None => masses(case, effort, report)?,
    }
    for (form, rate) in forms.into_iter().zip(moving) {
        let Exponents::Found(product) = logarithms.solve(case, rate, effort)? else { continue };
        let formula = multiplied(&[vec![(form, one())], product].concat())?;
        let formula = case.formula(&merged(formula.text())).unwrap_or(formula);
        let judged = judged_alone(case, Claim::integral(&formula), effort)?;
        if let Some(found) = judged.filter(holds) {
            tell(case, &formula, found, effort, report)?;
        }
    }
    Ok(())
}

/// Adds the determinant of the masses on constraints to the report if it is proved to be a density.
fn masses(case: &Case, effort: &Effort, report: &mut SearchReport) -> Result<(), SearchError> {
    for density in mass_densities(case) {
        let judged = judged_alone(case, Claim::density(&density), effort)?;
        if let Some(found) = judged.filter(|own| own.verdict == Verdict::Proved) {
            report.found.push(Found::new(FoundKind::Density, &density, None, found, &case.model));
            break;
        }
    }
    Ok(())
}

/// Adds the density 1 to the report if it is proved.
pub fn tell_volume(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let judged = judged_alone(case, Claim::density(one()), effort)?;
    if let Some(found) = judged.filter(|own| own.verdict == Verdict::Proved) {
        report.found.push(Found::new(FoundKind::Density, &one(), None, found, &case.model));
    }
    Ok(())
}

/// Exponents for which rates add up to 0.
enum Exponents {
    /// The factors with their exponents.
    Found(Vec<Power>),
    /// There are none.
    None,
    /// The target has no values modulo a prime.
    Unknown,
}

impl Logarithms {
    /// Finds exponents of the factors for which the target and their rates add up to 0.
    fn solve(
        &self,
        case: &Case,
        target: Vec<Expr>,
        effort: &Effort,
    ) -> Result<Exponents, SearchError> {
        let columns: Vec<Vec<Expr>> = self.rates.iter().cloned().chain([target]).collect();
        let mut functions = SampledFunctions::new(case, &self.graph, &columns, effort)?;
        let defined = functions.defined();
        if defined.last() != Some(&self.rates.len()) {
            return Ok(Exponents::Unknown);
        }
        functions.restrict(&defined);
        let relations = match functions.relations() {
            Err(SearchError::NoPoints) => return Ok(Exponents::Unknown),
            other => other?,
        };
        // The target is the last column: if it depends on the others, one vector has 1 there.
        let one = Rational::from(1);
        let vectors = relations.rational()?.0;
        let Some(vector) = vectors.iter().find(|vector| vector.last() == Some(&one)) else {
            return Ok(Exponents::None);
        };
        let mut exponents = vec![Rational::from(0); self.rates.len()];
        for (place, value) in defined.iter().zip(&vector[..vector.len() - 1]) {
            exponents[*place] = value.clone();
        }
        Ok(Exponents::Found(powers(&exponents, &self.factors, &self.exponents)?))
    }
}
