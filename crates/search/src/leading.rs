//! Formulas of finds that begin with a minus sign, written otherwise.
//!
//! −F is an integral where F is, and has the rate −c where F has c. A density keeps its sign: a term that is
//! added goes first.

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::Formula;
use liouville::verdict::Verdict;

use super::ask::judged_alone;
use super::orbit::{joined_terms as joined, signed_terms};
use super::{Effort, Found, FoundFormula, FoundKind, Given, SearchError, SearchReport};

/// Writes the finds of a report without leading minus signs, where that is proved to be the same.
pub fn write_without_minus(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    for place in 0..report.found.len() {
        let own = &report.found[place];
        if !own.text().starts_with(['−', '-']) || !own.abbreviations.is_empty() {
            continue;
        }
        effort.halt.check()?;
        let Some(changed) = changed(case, effort, own)? else { continue };
        let before = std::mem::replace(&mut report.found[place], changed);
        let after = report.found[place].text();
        for own in &mut report.excluded {
            own.theorem = replaced(&own.theorem, before.text(), after);
        }
    }
    Ok(())
}

/// The find with another formula, proved to be the same or its negative.
fn changed(case: &Case, effort: &Effort, own: &Found) -> Result<Option<Found>, SearchError> {
    let Some(function) = own.function() else { return Ok(None) };
    let terms = signed_terms(own.text());
    let has_rate_alone = || own.with.iter().all(|own| matches!(own, Given::Rate(_)));
    let is_falling = || own.with.iter().any(|own| own.text().starts_with('−'));
    let may_turn = match own.kind {
        FoundKind::Integral | FoundKind::FurtherIntegral => true,
        FoundKind::ConstantRate => has_rate_alone() && is_falling(),
        _ => false,
    };
    let text = match may_turn {
        true => joined(terms.iter().map(|(is_negative, text)| (!is_negative, *text))),
        false => match with_a_sum_first(&terms) {
            Some(text) => text,
            None => return Ok(None),
        },
    };
    let Ok(formula) = case.formula(&text) else { return Ok(None) };
    let minus = |own: &Formula| -> Result<Formula, SearchError> { Ok(-&own.bracketed()) };
    let same = if may_turn { minus(function)? } else { function.clone() };
    let judged = judged_alone(case, Claim::identity(&formula, &same), effort)?;
    if judged.is_none_or(|judged| judged.verdict != Verdict::Proved) {
        return Ok(None);
    }
    let turned = |text: &str| {
        let terms = signed_terms(unbracketed_negative(text));
        match text.starts_with('−') && unbracketed_negative(text) != text {
            true => joined(terms),
            false => joined(terms.iter().map(|(is_negative, text)| (!is_negative, *text))),
        }
    };
    let mut with = own.with.clone();
    for own in with.iter_mut().filter(|_| may_turn) {
        if let Given::Rate(rate) = own {
            let Ok(rate) = case.formula(&turned(rate.text())) else { return Ok(None) };
            *own = Given::Rate(rate);
        }
    }
    Ok(Some(Found { formula: FoundFormula::Function(formula), with, ..own.clone() }))
}

/// The opposite of a formula, a term that is added first where there is one.
pub fn opposite(case: &Case, formula: &Formula) -> Result<Formula, SearchError> {
    let terms = signed_terms(formula.text());
    let turned: Vec<_> = terms.into_iter().map(|(is_negative, own)| (!is_negative, own)).collect();
    let text = with_a_sum_first(&turned).unwrap_or_else(|| joined(turned.iter().copied()));
    let turned = case.formula(&text);
    Ok(turned.unwrap_or_else(|_| -&formula.bracketed()))
}

/// Joins terms, the first that is added before the others; `None` if all are subtracted.
fn with_a_sum_first(terms: &[(bool, &str)]) -> Option<String> {
    let first = terms.iter().position(|(is_negative, _)| !is_negative)?;
    let rest = terms.iter().enumerate().filter(|(place, _)| *place != first);
    Some(joined([terms[first]].into_iter().chain(rest.map(|(_, own)| *own))))
}

/// Text in brackets behind a minus sign, where that is all; otherwise the whole text.
fn unbracketed_negative(text: &str) -> &str {
    let inner = text.strip_prefix("−(").and_then(|text| text.strip_suffix(')'));
    let is_all = |inner: &&str| {
        let mut depth = 0i32;
        inner.chars().all(|letter| {
            depth +=
                i32::from(matches!(letter, '(' | '[')) - i32::from(matches!(letter, ')' | ']'));
            depth >= 0
        })
    };
    inner.filter(is_all).unwrap_or(text)
}

/// Replaces a formula where it stands alone: −y*z is no part of −y*z².
pub fn replaced(text: &str, before: &str, after: &str) -> String {
    let goes_on = |rest: &str| {
        // A theorem speaks of integrals F + F₁.
        [" + ", " − "].iter().any(|sign| rest.starts_with(sign)) && !rest.starts_with(" + F₁")
            || rest.starts_with(|next: char| next.is_alphanumeric() || "*/^'[(_".contains(next))
    };
    let mut all = String::new();
    let mut left = text;
    while let Some(place) = left.find(before) {
        let (own, rest) = (&left[..place], &left[place + before.len()..]);
        let is_part = own.ends_with(|letter: char| letter.is_alphanumeric() || letter == ')');
        all.push_str(own);
        all.push_str(if is_part || goes_on(rest) { before } else { after });
        left = rest;
    }
    all + left
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_replaced_where_they_stand_alone() {
        let own = |text: &str| replaced(text, "−y*z", "y*z");
        assert_eq!(own("functions of −y*z, x and −y*z"), "functions of y*z, x and y*z");
        assert_eq!(own("an integral −y*z + F₁ with"), "an integral y*z + F₁ with");
        for text in ["−y*z²", "−y*z + x", "−y*zeta", "x−y*z", "−y*z*x"] {
            assert_eq!(own(text), text);
        }
    }

    #[test]
    fn sums_are_turned_term_by_term() {
        let turned = |text: &str| {
            let terms = signed_terms(text).into_iter();
            joined(terms.map(|(is_negative, text)| (!is_negative, text)))
        };
        assert_eq!(turned("−a*ln(x − y) + b"), "a*ln(x − y) − b");
        assert_eq!(turned("−4*om"), "4*om");
        assert_eq!(unbracketed_negative("−(r − s)"), "r − s");
        assert_eq!(unbracketed_negative("−(r − s)*(a + b)"), "−(r − s)*(a + b)");
    }
}
