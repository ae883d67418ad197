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
use super::{Effort, Found, FoundFormula, FoundKind, Given, SearchError, SearchReport};
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
        let after = report.found[place].text();
        for own in &mut report.excluded {
            own.theorem = replaced(&own.theorem, before.text(), after);
            own.ansatz = replaced(&own.ansatz, before.text(), after);
        }
        if !after.contains(before.text()) && before.kind == FoundKind::Integral {
            spoiled.push(before.text().to_string());
        }
    }
    // P is one of P + cQ, of which another has the factors.
    let is_spoiled = |own: &Found| {
        own.kind == FoundKind::DarbouxPolynomial
            && spoiled.iter().any(|text| text.starts_with(&format!("({})/", own.text())))
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
    let own = report
        .found
        .iter()
        .filter(|own| own.kind == FoundKind::DarbouxPolynomial && own.abbreviations.is_empty());
    own.filter(|own| own.text().len() <= LONGEST)
        .filter_map(|own| reader.read(own.text()))
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
    let [Given::Rate(rate)] = own.with.as_slice() else { return Ok(None) };
    let is_plain = own.kind == FoundKind::ConstantRate && own.abbreviations.is_empty();
    if !is_plain || own.text().len() > LONGEST {
        return Ok(None);
    }
    let (Some(function), Some(rate)) = (reader.read(own.text()), reader.read(rate.text().trim()))
    else {
        return Ok(None);
    };
    let integrals =
        report.found.iter().filter(|found| found.is_integral() && found.abbreviations.is_empty());
    for integral in integrals.filter(|found| found.text().len() <= LONGEST) {
        let Some(divisor) = reader.read(integral.text()) else { continue };
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
            let with = vec![Given::Rate(rate)];
            let found = Found::new(FoundKind::ConstantRate, &function, None, judged, &case.model);
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
    let kind = own.kind;
    let constants = match kind {
        FoundKind::Integral
        | FoundKind::FurtherIntegral
        | FoundKind::DarbouxPolynomial
        | FoundKind::ConstantRate => Constants::Left,
        FoundKind::Density => Constants::Sign,
        _ => return Ok(None),
    };
    let Some(function) = own.function() else { return Ok(None) };
    let is_plain = own.abbreviations.is_empty() && function.value_type() == Type::Scalar;
    if !is_plain || own.verdict != Verdict::Proved || own.text().len() > LONGEST {
        return Ok(None);
    }
    let is_rate = |own: &Given| matches!(own, Given::Rate(_) | Given::Cofactor(_));
    let rate = own.with.iter().position(is_rate);
    let Some(read) = reader.read(own.text()) else { return Ok(None) };
    let is_shifted = matches!(
        own.kind,
        FoundKind::Integral | FoundKind::FurtherIntegral | FoundKind::ConstantRate
    );
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
    let mut rate_text = None;
    if let Some(rate) = rate {
        let Some(read) = reader.read(own.with[rate].text()) else { return Ok(None) };
        let scaled = match (own.kind, &made) {
            (FoundKind::ConstantRate, Some(made)) => {
                read.over(&made.constant).and_then(|own| reader.simplified(own))
            }
            _ => Some(read),
        };
        let written = scaled.and_then(|own| writer::written(reader, &own, Constants::Kept));
        match written {
            Some(written) => rate_text = Some(written.text),
            // The function keeps the factor that its rate has.
            None if own.kind == FoundKind::ConstantRate => (made, shift) = (None, None),
            None => {}
        }
    }
    let made = made.unwrap_or_else(|| Written {
        text: own.text().to_string(),
        constant: Fraction::one(),
        constant_text: "1".to_string(),
    });
    let letters = |text: &str| text.chars().count();
    let old_rate = rate.map_or(0, |rate| letters(own.with[rate].text()));
    let new_rate = rate_text.as_deref().map_or(old_rate, letters);
    let (new, old) = (letters(&made.text) + new_rate, letters(own.text()) + old_rate);
    // A factor belongs to the rate.
    let is_simpler =
        own.kind == FoundKind::ConstantRate && letters(&made.text) < letters(own.text());
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
    let mut with = own.with.clone();
    if let Some(Given::Rate(own) | Given::Cofactor(own)) = rate.map(|rate| &mut with[rate]) {
        let before = own.clone();
        if let Some(text) = &rate_text {
            let Ok(after) = case.formula(text) else { return Ok(None) };
            *own = after;
        }
        let after = match kind {
            FoundKind::ConstantRate => (&scale.bracketed() * &own.bracketed())?,
            _ => own.clone(),
        };
        claims.push(Claim::identity(&before, &after));
    }
    for claim in claims {
        if !is_proved(case, claim, effort)? {
            return Ok(None);
        }
    }
    let text = formula.text().trim();
    let is_told = report.found.iter().enumerate().any(|(at, other)| {
        at != place && other.kind == own.kind && other.text() == text && other.with == with
    });
    if is_told && own.kind != FoundKind::ConstantRate {
        return Ok(None);
    }
    Ok(Some(Found { formula: FoundFormula::Function(formula), with, ..own.clone() }))
}

fn is_proved(case: &Case, claim: Claim, effort: &Effort) -> Result<bool, SearchError> {
    let judged = judged_alone(case, claim, effort)?;
    Ok(judged.is_some_and(|own| own.verdict == Verdict::Proved))
}
