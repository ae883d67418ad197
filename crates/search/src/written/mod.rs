//! Formulas of finds as one would publish them: in lowest terms, factored, without constant factors.
//!
//! ```text
//! tokens     names, functions and inner products of a formula as variables
//! fraction   fractions of polynomials in these
//! reader     texts as fractions
//! circular   even powers of sines and cosines as those of the other
//! hyperbolic exponentials e^u and e^(−u) as cosh u and sinh u
//! writer     fractions as texts
//! products   texts of products and quotients
//! named      expressions of the file that occur as factors
//! squares    sums of squares of differences
//! square_sums squares of sums of monomials, and what is left
//! masses     the determinant of the masses on constraints
//! shifts     additive constants that shorten an integral
//! ```
//!
//! A text takes the place of another where it is shorter, and proved to be the same up to a constant.

mod circular;
mod fraction;
mod hyperbolic;
mod masses;
mod named;
mod products;
mod reader;
mod shifts;
mod square_sums;
mod squares;
mod tokens;
mod writer;

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, Type};
use liouville::number::rational::Rational;
use liouville::proof::{MOST_POLYNOMIAL_WORK, Polynomial};
use liouville::verdict::Verdict;

use super::ask::judged_alone;
use super::leading::replaced;
use super::orbit::{CONSTANT_RATE, DARBOUX, FURTHER_INTEGRAL};
use super::{Effort, Found, SearchError, SearchReport};
use fraction::Fraction;
pub use masses::densities as mass_densities;
use reader::Reader;
use writer::{Constants, Written};

/// Longest text that is rewritten, in letters.
const LONGEST: usize = 4000;

/// Writes the finds of a report anew where that makes them shorter.
pub fn shorten(case: &Case, effort: &Effort, report: &mut SearchReport) -> Result<(), SearchError> {
    let mut reader = Reader::new(case);
    let mut spoiled = Vec::new();
    for place in 0..report.found.len() {
        effort.halt.check()?;
        if let Some(freed) = without_integrals(&mut reader, effort, report, place)? {
            report.found[place] = freed;
        }
        let Some(changed) = changed(&mut reader, effort, report, place)? else { continue };
        let before = std::mem::replace(&mut report.found[place], changed);
        let after = report.found[place].formula.clone();
        for own in &mut report.excluded {
            own.theorem = replaced(&own.theorem, &before.formula, &after);
            own.ansatz = replaced(&own.ansatz, &before.formula, &after);
        }
        if !after.contains(&before.formula) && before.kind == "integral" {
            spoiled.push(before.formula);
        }
    }
    // P is one of P + cQ, of which another has the factors.
    let is_spoiled = |own: &Found| {
        own.kind == DARBOUX
            && spoiled.iter().any(|text| text.starts_with(&format!("({})/", own.formula)))
    };
    report.found.retain(|own| !is_spoiled(own));
    Ok(())
}

/// The shortest form of a formula, with its constant factors; `None` where that is not read.
pub fn shortest(case: &Case, formula: &Formula) -> Option<Formula> {
    let text = formula.text();
    let mut reader = Reader::new(case);
    let read = (text.len() <= LONGEST).then(|| reader.read(text))??;
    let own = writer::written(&mut reader, &read, Constants::Kept)?;
    case.formula(&own.text).ok()
}

/// Darboux polynomials of a report, which may be factors.
fn darboux_polynomials(reader: &mut Reader<'_>, report: &SearchReport) -> Vec<Polynomial> {
    let own = report.found.iter().filter(|own| own.kind == DARBOUX && own.abbreviations.is_empty());
    own.filter(|own| own.formula.len() <= LONGEST)
        .filter_map(|own| reader.read(&own.formula))
        .filter(|own| own.is_polynomial() && own.above.number().is_none())
        .map(|own| own.above)
        .collect()
}

/// Whether a fraction is infinite at most where several squares vanish together, as 1/(x² + y²).
pub fn has_small_poles(case: &Case, formula: &Formula) -> bool {
    let text = formula.text();
    let mut reader = Reader::new(case);
    let Some(read) = (text.len() <= LONGEST).then(|| reader.read(text)).flatten() else {
        return false;
    };
    let is_sum = |own: &Polynomial| {
        let is_square = |(value, powers): (&Rational, &[(u32, u32)])| {
            !value.is_negative() && powers.iter().all(|(_, power)| power % 2 == 0)
        };
        own.size() > 1 && own.terms().all(is_square)
    };
    read.below.factors().iter().all(is_sum)
}

/// A function of constant rate over an integral that divides it: that is simpler, and has a constant rate as well.
fn without_integrals(
    reader: &mut Reader<'_>,
    effort: &Effort,
    report: &SearchReport,
    place: usize,
) -> Result<Option<Found>, SearchError> {
    let own = &report.found[place];
    let [("rate", rate)] = own.with.as_slice() else { return Ok(None) };
    let is_plain = own.kind == CONSTANT_RATE && own.abbreviations.is_empty();
    if !is_plain || own.formula.len() > LONGEST {
        return Ok(None);
    }
    let (Some(function), Some(rate)) = (reader.read(&own.formula), reader.read(rate)) else {
        return Ok(None);
    };
    let integrals = report.found.iter().filter(|found| {
        found.kind == "integral" && found.with.is_empty() && found.abbreviations.is_empty()
    });
    for integral in integrals.filter(|found| found.formula.len() <= LONGEST) {
        let Some(divisor) = reader.read(&integral.formula) else { continue };
        let work = &mut { MOST_POLYNOMIAL_WORK };
        let divides = function.above.over(&divisor.above, work).is_some();
        if !divides || !divisor.is_polynomial() || divisor.above.number().is_some() {
            continue;
        }
        let quotients = function.over(&divisor).zip(rate.over(&divisor));
        let Some((function, rate)) = quotients.filter(|(own, _)| own.above.number().is_none())
        else {
            continue;
        };
        let texts = [function, rate].map(|own| writer::written(reader, &own, Constants::Kept));
        let [Some(function), Some(rate)] = texts else { continue };
        let case = reader.case();
        let formulas = case.formula(&function.text).ok().zip(case.formula(&rate.text).ok());
        let Some((function, rate)) = formulas else { continue };
        let judged = judged_alone(case, Claim::rate(&function, &rate), effort)?;
        if let Some(judged) = judged.filter(|own| own.verdict == Verdict::Proved) {
            let with = vec![("rate", rate.to_string())];
            let found = Found::new(CONSTANT_RATE, &function, None, judged, &case.model);
            return Ok(Some(Found { with, ..found }));
        }
    }
    Ok(None)
}

/// A find written anew; `None` if that is no shorter, or not proved to be the same.
fn changed(
    reader: &mut Reader<'_>,
    effort: &Effort,
    report: &SearchReport,
    place: usize,
) -> Result<Option<Found>, SearchError> {
    let own = &report.found[place];
    let constants = match own.kind {
        "integral" | FURTHER_INTEGRAL | DARBOUX | CONSTANT_RATE => Constants::Left,
        "density" => Constants::Sign,
        _ => return Ok(None),
    };
    let Some(function) = own.function.as_ref() else { return Ok(None) };
    let is_plain = own.abbreviations.is_empty() && function.value_type() == Type::Scalar;
    if !is_plain || own.verdict != Verdict::Proved || own.formula.len() > LONGEST {
        return Ok(None);
    }
    let rate = own.with.iter().position(|(what, _)| matches!(*what, "rate" | "cofactor"));
    let read = reader.read(&own.formula);
    let Some(read) = read else { return Ok(None) };
    let is_shifted = matches!(own.kind, "integral" | FURTHER_INTEGRAL | CONSTANT_RATE);
    let mut shifts = Vec::new();
    if is_shifted {
        let turned = hyperbolic::turned(reader, &read);
        let divisors = darboux_polynomials(reader, report);
        for own in std::iter::once(&read).chain(&turned) {
            shifts.extend(shifts::shifts(reader, own, &divisors));
        }
    }
    let mut made = writer::written(reader, &read, constants);
    let mut shift = None;
    for (rest, constant) in shifts {
        let own = writer::written(reader, &rest, constants);
        let is_shorter = |own: &Written| {
            made.as_ref().is_none_or(|made| own.text.chars().count() < made.text.chars().count())
        };
        if own.as_ref().is_some_and(is_shorter) {
            (made, shift) = (own, Some(constant));
        }
    }
    let mut with = own.with.clone();
    if let Some(rate) = rate {
        let text = &own.with[rate].1;
        let Some(read) = reader.read(text) else { return Ok(None) };
        let scaled = match (own.kind, &made) {
            (CONSTANT_RATE, Some(made)) => {
                read.over(&made.constant).and_then(|own| reader.simplified(own))
            }
            _ => Some(read),
        };
        let written = scaled.and_then(|own| writer::written(reader, &own, Constants::Kept));
        match written {
            Some(written) => with[rate].1 = written.text,
            // The function keeps the factor that its rate has.
            None if own.kind == CONSTANT_RATE => (made, shift) = (None, None),
            None => {}
        }
    }
    let made = made.unwrap_or_else(|| Written {
        text: own.formula.clone(),
        constant: Fraction::one(),
        constant_text: "1".to_string(),
    });
    let letters = |formula: &str, with: &[(&'static str, String)]| {
        formula.chars().count() + with.iter().map(|(_, own)| own.chars().count()).sum::<usize>()
    };
    let (new, old) = (letters(&made.text, &with), letters(&own.formula, &own.with));
    // A factor belongs to the rate.
    let is_simpler =
        own.kind == CONSTANT_RATE && letters(&made.text, &[]) < letters(&own.formula, &[]);
    if new > old || new == old && !is_simpler {
        return Ok(None);
    }
    let case = reader.case();
    let (Ok(formula), Ok(scale)) = (case.formula(&made.text), case.formula(&made.constant_text))
    else {
        return Ok(None);
    };
    let mut same = (&scale.bracketed() * &formula.bracketed())?;
    if let Some(shift) = shift {
        let text = writer::written(reader, &shift, Constants::Kept).map(|own| own.text);
        let Some(Ok(shift)) = text.map(|text| case.formula(&text)) else { return Ok(None) };
        same = (&same + &shift.bracketed())?;
    }
    let mut claims = vec![Claim::identity(function, &same)];
    if let Some(rate) = rate {
        let (Ok(before), Ok(after)) =
            (case.formula(&own.with[rate].1), case.formula(&with[rate].1))
        else {
            return Ok(None);
        };
        let after = match own.kind {
            CONSTANT_RATE => (&scale.bracketed() * &after.bracketed())?,
            _ => after,
        };
        claims.push(Claim::identity(&before, &after));
    }
    for claim in claims {
        if !is_proved(case, claim, effort)? {
            return Ok(None);
        }
    }
    let text = formula.to_string();
    let is_told = report.found.iter().enumerate().any(|(at, other)| {
        at != place && other.kind == own.kind && other.formula == text && other.with == with
    });
    if is_told && own.kind != CONSTANT_RATE {
        return Ok(None);
    }
    Ok(Some(Found { formula: text, function: Some(formula), with, ..own.clone() }))
}

fn is_proved(case: &Case, claim: Claim, effort: &Effort) -> Result<bool, SearchError> {
    let judged = judged_alone(case, claim, effort)?;
    Ok(judged.is_some_and(|own| own.verdict == Verdict::Proved))
}
