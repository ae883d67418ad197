//! Absence of fractions of polynomials in the state and in functions of it: exponentials, sines,
//! cosines and roots that occur in the field.
//!
//! An integral P/Q gives a relation along each orbit. If the relations along the orbit of a random
//! point modulo a prime are those that the known integrals imply, it is a function of these.

use super::super::orbit::fractions::Degree;
use super::super::orbit::{self, fractions};
use super::super::{Effort, SearchError, SearchReport};
use super::{AbsenceCase, AbsenceOutcome};
use liouville::formula::Formula;
use liouville::verdict::Verdict;

/// Largest number of monomials that are compared: their relations take some seconds.
const MONOMIALS: usize = 1500;

/// Judges the claim that all integrals up to a degree are functions of the known ones.
pub fn no_integral(asked: &AbsenceCase<'_>, degree: u32) -> Result<AbsenceOutcome, SearchError> {
    let (case, effort) = (asked.case, &asked.effort);
    let mut known = asked.known.formulas();
    let compared = |known: &[Formula]| {
        fractions::compared(case, effort, known, Degree::AsWritten(degree), MONOMIALS)
    };
    let mut made = compared(known)?;
    // Functions of others say nothing more, and may contain functions that cannot be read.
    let basis = match &made {
        Ok(_) => None,
        Err(_) => asked.known.basis(case, effort)?,
    };
    let basis: Option<Vec<Formula>> =
        basis.map(|own| asked.known.energy().cloned().into_iter().chain(own).collect());
    if let Some(basis) = basis.as_deref().filter(|basis| basis.len() < known.len()) {
        known = basis;
        made = compared(known)?;
    }
    let compared = match made {
        Ok(compared) => compared,
        Err(reason) => return Ok(AbsenceOutcome::Open(reason)),
    };
    let statement = compared.statement(case, effort, known)?;
    let fractions::Compared { class, degree: counted, monomials, relations, implied, .. } =
        compared;
    let mut higher = None;
    if let Some(statement) = statement {
        let counted = match relations {
            0 => format!("no relation between {monomials} monomials along an orbit"),
            _ => format!(
                "{} between {monomials} monomials along an orbit, as known integrals imply",
                several(relations)
            ),
        };
        return Ok(AbsenceOutcome::Excluded { theorem: asked.theorem(&statement), counted });
    }
    if relations < implied {
        return Ok(AbsenceOutcome::Open(format!(
            "{} along an orbit, fewer than the {implied} that known integrals imply",
            several(relations)
        )));
    }
    // Most are polynomials, which take a small part of the time.
    for by_factors in [false, true] {
        let effort = Effort { by_factors, ..effort.clone() };
        let mut report = SearchReport::default();
        match orbit::search(case, &effort, false, &mut report, &mut |_| {}) {
            Err(SearchError::Stopped) => {}
            other => other?,
        }
        for found in &report.found {
            let Some(function) = found.function() else { continue };
            let own = found.is_integral();
            if own && found.verdict == Verdict::Proved && asked.is_new(function)? {
                if fractions::is_within(case, &effort, known, function, (&class, counted, degree))?
                {
                    let exhibit = format!("integral, proved: {}", found.text());
                    return Ok(AbsenceOutcome::Exhibited(exhibit));
                }
                higher.get_or_insert_with(|| found.text().to_string());
            }
        }
    }
    let found = match higher {
        Some(formula) => {
            format!("{formula} is an integral, and it is open whether one of degree {degree} is")
        }
        None => "no other integral was found in closed form".to_string(),
    };
    Ok(AbsenceOutcome::Open(format!(
        "{} between {monomials} monomials along an orbit, and known integrals imply {implied}; {found}",
        several(relations)
    )))
}

/// Number of relations, in words.
fn several(relations: usize) -> String {
    match relations {
        1 => "one relation".to_string(),
        _ => format!("{relations} relations"),
    }
}
