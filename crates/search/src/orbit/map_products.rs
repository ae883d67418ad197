//! Densities Π f^α e^g of maps, and integrals Σ c m + Σ α ln |f|, with functions in the map or without.
//!
//! |ρ∘Φ det DΦ| = |ρ| for ρ = Π f^α e^g gives Σ α ∇(ln f∘Φ − ln f) + ∇(g∘Φ − g) + ∇ln det DΦ = 0, which is
//! linear in the exponents and in the coefficients of g; without the last term the sum of the others is an
//! integral up to a constant. Exponentials, sines and other functions without values modulo a prime are
//! independent numbers there. A find is judged with the functions themselves.

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError, FormulaResult};
use liouville::graph::Expr;
use liouville::mechanics::System;
use liouville::mechanics::calculus::DualPoint;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use liouville::verdict::Verdict;
use num_dual::DualNum;

use super::super::ansatz::monomials::power_product;
use super::super::ask::judged_alone;
use super::super::integrals::tell_if_proved;
use super::super::linear::SampledFunctions;
use super::super::origin::RemarkOrigin;
use super::super::terms::{Power, multiplied, one, powers, recorded, sum};
use super::super::{Effort, Found, FoundKind, SearchError, SearchReport};
use super::known::has_told_all;
use super::map_densities::note_unproved;
use super::{factors, magnitude, monomials};

/// Largest number of monomials of g.
const MONOMIALS: usize = 40;
/// Largest degree of g.
const DEGREE: u32 = 4;
/// Largest number of factors.
const FACTORS: usize = 40;

/// Searches a map for a density, if none is known, and for integrals of this form.
pub fn search(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let System::Map(images) = &case.model.system else { return Ok(()) };
    let has_density = report.formulas(FoundKind::Density).next().is_some();
    let is_complete = has_told_all(case, report);
    if !case.model.level.is_empty() || (has_density && is_complete) {
        return Ok(());
    }
    progress("products of factors of the map");
    let state = case.model.state_formulas()?;
    let factors = offered(case, images, &state, effort)?;
    let terms = terms(&state)?;
    let (graph, rows) = recorded(case, |jet| slopes(jet, &factors, &terms))?;
    let Some(rows) = rows else { return Ok(()) };
    let mut functions = SampledFunctions::with_symbols(case, &graph, &rows, effort)?;
    let defined = functions.defined();
    functions.restrict(&defined);
    let vectors = match functions.relations() {
        Err(SearchError::NoPoints) => return Ok(()),
        other => other?.rational()?.0,
    };
    let target = rows.len() - 1;
    for vector in vectors {
        effort.halt.check()?;
        let mut own = vec![Rational::from(0); rows.len()];
        defined.iter().zip(vector).for_each(|(place, value)| own[*place] = value);
        let of_density = own.pop().is_some_and(|last| !last.is_zero());
        let (exponents, coefficients) = own.split_at(factors.len());
        let found = ProductFind { case, effort, factors: &factors, terms: &terms };
        match of_density {
            true if defined.last() == Some(&target) && !has_density => {
                found.tell_density(exponents, coefficients, report)?;
            }
            true => {}
            false => found.tell_integral(exponents, coefficients, report)?,
        }
    }
    Ok(())
}

/// Lists factors: components of the state, their sums and differences, those of small numbers, and the
/// denominators, radicands and other functions of the map.
fn offered(
    case: &Case,
    images: &[Formula],
    state: &[Formula],
    effort: &Effort,
) -> Result<Vec<Formula>, SearchError> {
    let mut field = case.clone();
    field.model.system = System::Field(images.to_vec());
    let mut found = state.to_vec();
    found.extend(factors(&field, effort, &[])?);
    for own in state {
        found.push((own + &one())?);
        found.push((own - &one())?);
        found.push((&one() + &own.power(&Formula::number(2))?)?);
    }
    for (place, own) in state.iter().enumerate() {
        for other in &state[..place] {
            found.push((other + own)?);
            found.push((other - own)?);
        }
    }
    let mut texts: Vec<String> = Vec::new();
    found.retain(|own| {
        let is_new = own.constant().is_none() && !texts.contains(&own.text().to_string());
        texts.push(own.text().to_string());
        is_new
    });
    found.truncate(FACTORS);
    Ok(found)
}

/// Monomials of g without the constant.
fn terms(state: &[Formula]) -> Result<Vec<Formula>, FormulaError> {
    let count = |degree: &u32| monomials::count(state.len(), *degree) <= MONOMIALS;
    let degree = (1..=DEGREE).take_while(count).last().unwrap_or(1);
    let variables: Vec<usize> = (0..state.len()).collect();
    let all = monomials::up_to(&variables, state.len(), degree);
    all.iter().skip(1).map(|own| power_product(state, own)).collect()
}

/// Gradients of ln f∘Φ − ln f, of m∘Φ − m, and of ln det DΦ; `None` where values have no gradients.
fn slopes(
    jet: &DualPoint<'_, Expr>,
    factors: &[Formula],
    terms: &[Formula],
) -> Option<Vec<Vec<Expr>>> {
    let image = jet.image();
    let state = jet.phase.state();
    let values = |own: &Formula| [image.scalar(own), jet.phase.scalar(own)];
    let pairs: Vec<[Expr; 2]> = factors.iter().chain(terms).map(values).collect();
    let growth = jet.expansion(&[]);
    let all: Vec<Expr> = pairs.iter().flatten().copied().chain([growth]).collect();
    let gradients = Expr::gradients_of(&all, &state)?;
    let zero = Expr::rational(&Rational::from(0));
    let dense: Vec<Vec<Expr>> = gradients
        .iter()
        .map(|row| {
            let mut own = vec![zero; state.len()];
            row.iter().for_each(|(place, value)| own[*place] = *value);
            own
        })
        .collect();
    let scaled = |place: usize| -> Vec<Expr> {
        let inverse = all[place].recip();
        dense[place].iter().map(|own| *own * inverse).collect()
    };
    let difference = |there: Vec<Expr>, here: Vec<Expr>| -> Vec<Expr> {
        there.into_iter().zip(here).map(|(a, b)| a - b).collect()
    };
    let logarithmic = (0..factors.len()).map(|k| difference(scaled(2 * k), scaled(2 * k + 1)));
    let plain = (factors.len()..pairs.len())
        .map(|k| difference(dense[2 * k].clone(), dense[2 * k + 1].clone()));
    Some(logarithmic.chain(plain).chain([scaled(all.len() - 1)]).collect())
}

/// Quantities that the coefficients of a find belong to.
struct ProductFind<'f> {
    case: &'f Case,
    effort: &'f Effort,
    factors: &'f [Formula],
    terms: &'f [Formula],
}

impl ProductFind<'_> {
    /// Factors with exponents; those with broken ones are moduli where they may be negative.
    fn product(&self, exponents: &[Rational]) -> Result<Vec<Power>, SearchError> {
        let mut bases = Vec::new();
        for (factor, exponent) in self.factors.iter().zip(exponents) {
            let is_whole = exponent.parts().1 == 1.into();
            bases.push(match is_whole {
                true => factor.clone(),
                false => magnitude::of_case(self.case, self.effort, factor)?,
            });
        }
        Ok(powers(exponents, &bases, &[one()])?)
    }

    fn tell_density(
        &self,
        exponents: &[Rational],
        coefficients: &[Rational],
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let mut all = self.product(exponents)?;
        if !coefficients.iter().all(Rational::is_zero) {
            let exponential = Formula::call("exp", &[&exact_sum(coefficients, self.terms)?])?;
            all.push((exponential, one()));
        }
        let density = multiplied(&all)?;
        let Some(found) = judged_alone(self.case, Claim::density(&density), self.effort)? else {
            return Ok(());
        };
        match found.verdict {
            Verdict::Proved => {
                report.remarks.retain(|own| own.origin != RemarkOrigin::UnwrittenDensity);
                let own = Found::new(FoundKind::Density, &density, None, found, &self.case.model);
                report.found.push(own);
            }
            _ => note_unproved(&density, &found, report),
        }
        Ok(())
    }

    fn tell_integral(
        &self,
        exponents: &[Rational],
        coefficients: &[Rational],
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let is_product = coefficients.iter().all(Rational::is_zero)
            && exponents.iter().all(|own| own.parts().1 == 1.into());
        let integral = if is_product {
            multiplied(&self.product(exponents)?)?
        } else {
            let (mut numbers, mut terms) = (coefficients.to_vec(), self.terms.to_vec());
            for (factor, exponent) in self.factors.iter().zip(exponents) {
                if !exponent.is_zero() {
                    let own = magnitude::of_case(self.case, self.effort, factor)?;
                    numbers.push(exponent.clone());
                    terms.push(Formula::call("ln", &[&own])?);
                }
            }
            sum(&numbers, &terms)?
        };
        tell_if_proved(self.case, &integral, self.effort, report)
    }
}

/// Σ a_j T_j itself, not a multiple.
fn exact_sum(coefficients: &[Rational], terms: &[Formula]) -> FormulaResult {
    let mut total: Option<Formula> = None;
    for (value, term) in coefficients.iter().zip(terms).filter(|(value, _)| !value.is_zero()) {
        let own = match value.is_one() {
            true => term.clone(),
            false => (&Formula::number(value.clone()) * term)?,
        };
        total = Some(match total {
            None => own,
            Some(before) => (&before + &own)?,
        });
    }
    Ok(total.unwrap_or_else(|| Formula::number(0)))
}
