//! Densities of measures in place of densities that are negative, or have poles or zeros in the ranges.
//!
//! With ρ, −ρ is a density, and so is ρ times any function of integrals.

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError, Type};
use liouville::verdict::{DensitySign, Evidence, Flaw, Verdict};

use super::ask::judged_alone;
use super::leading::{opposite, replaced};
use super::written;
use super::{Effort, Found, FoundKind, SearchError, SearchReport};

/// Largest number of integrals that are tried as factors.
const MOST_INTEGRALS: usize = 6;
/// Longest factor, in letters.
const LONGEST: usize = 200;
/// Number of letters by which a density may grow beyond twice its length: a long one is not at hand.
const MOST_GROWTH: usize = 12;

/// Replaces densities of the report by densities of measures, where one of these is at hand.
pub fn prefer(case: &Case, effort: &Effort, report: &mut SearchReport) -> Result<(), SearchError> {
    for place in 0..report.found.len() {
        let own = &report.found[place];
        let is_density =
            own.kind == FoundKind::Density && own.with.is_empty() && own.abbreviations.is_empty();
        if !is_density || own.verdict != Verdict::Proved {
            continue;
        }
        effort.halt.check()?;
        let Some(density) = own.function().cloned() else { continue };
        let better = match (own.evidence.sign, is_of_measure(&own.evidence)) {
            (Some(DensitySign::Negative), _) => {
                judged(case, effort, &opposite(case, &density)?)?.filter(has_no_minus)
            }
            (_, false) if !written::has_small_poles(case, &density) => {
                with_integrals(case, effort, report, &density)?
            }
            _ => None,
        };
        let Some(better) = better else { continue };
        let before = std::mem::replace(&mut report.found[place], better);
        let after = report.found[place].text().to_string();
        for own in &mut report.excluded {
            own.theorem = replaced(&own.theorem, before.text(), &after);
        }
    }
    Ok(())
}

/// Whether a density has one sign, and no pole that is seen.
fn is_of_measure(evidence: &Evidence) -> bool {
    evidence.sign != Some(DensitySign::Changes) && !evidence.has(Flaw::Infinite)
}

fn has_no_minus(own: &Found) -> bool {
    own.evidence.sign != Some(DensitySign::Negative)
}

/// The shortest density of a measure that is the product with a function of one integral, and does not jump.
fn with_integrals(
    case: &Case,
    effort: &Effort,
    report: &SearchReport,
    density: &Formula,
) -> Result<Option<Found>, SearchError> {
    let is_short =
        |own: &&Formula| own.value_type() == Type::Scalar && own.text().chars().count() <= LONGEST;
    let integrals: Vec<Formula> = report
        .functions(FoundKind::Integral)
        .filter(is_short)
        .take(MOST_INTEGRALS)
        .cloned()
        .collect();
    let mut found: Option<Found> = None;
    for integral in integrals {
        for factor in factors(&integral)? {
            let product = (&density.bracketed() * &factor)?;
            let product = written::shortest(case, &product).unwrap_or(product);
            let Some(own) = judged(case, effort, &product)? else { continue };
            let is_shorter = |other: &Found| own.text().len() < other.text().len();
            let has_one_sign = own.evidence.sign != Some(DensitySign::Changes);
            let is_better = is_of_measure(&own.evidence)
                || has_one_sign && written::has_small_poles(case, &product);
            let is_plain = !own.evidence.has(Flaw::Jumps)
                && own.text().chars().count() <= 2 * density.text().chars().count() + MOST_GROWTH;
            if is_plain && is_better && found.as_ref().is_none_or(is_shorter) {
                found = Some(own);
            }
        }
    }
    let is_negative = |own: &Found| own.evidence.sign == Some(DensitySign::Negative);
    match found.as_ref().filter(|own| is_negative(own)).and_then(|own| own.function().cloned()) {
        Some(negative) => judged(case, effort, &opposite(case, &negative)?),
        None => Ok(found),
    }
}

/// F, 1/F, 1/(1 + F²), F/(1 + F²) and F²/(1 + F²).
fn factors(integral: &Formula) -> Result<[Formula; 5], FormulaError> {
    let own = integral.bracketed();
    let one = Formula::number(1);
    let inverse = (&one / &own)?;
    let square = (&own * &own)?;
    let sum = (&one + &square)?.bracketed();
    let fractions = [(&one / &sum)?, (&own / &sum)?, (&square.bracketed() / &sum)?];
    let [first, second, third] = fractions;
    Ok([own, inverse, first, second, third])
}

/// The density as a find, if it is proved.
fn judged(case: &Case, effort: &Effort, density: &Formula) -> Result<Option<Found>, SearchError> {
    let judged = judged_alone(case, Claim::density(density), effort)?;
    let judged = judged.filter(|own| own.verdict == Verdict::Proved);
    Ok(judged.map(|own| Found::new(FoundKind::Density, density, None, own, &case.model)))
}
