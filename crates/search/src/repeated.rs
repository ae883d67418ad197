//! Removal of finds that are functions of shorter ones of their kind.

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::order::StableOrder;
use liouville::verdict::Verdict;

use super::ask::judged_alone;
use super::{Effort, Found, FoundKind, SearchError, SearchReport};

/// Removes functions of constant rate, further integrals, and Darboux polynomials with one cofactor, that are
/// functions of others of their kind; short ones are kept.
pub fn remove(case: &Case, effort: &Effort, report: &mut SearchReport) -> Result<(), SearchError> {
    let has_kind = |own: &Found| {
        matches!(
            own.kind,
            FoundKind::FurtherIntegral | FoundKind::ConstantRate | FoundKind::DarbouxPolynomial
        )
    };
    let mut open: Vec<usize> =
        (0..report.found.len()).filter(|place| has_kind(&report.found[*place])).collect();
    open.order_by_key(|place| report.found[*place].text().chars().count());
    let (mut kept, mut repeated): (Vec<&Found>, Vec<usize>) = (Vec::new(), Vec::new());
    for place in open {
        let own = &report.found[place];
        let mut is_repeated = false;
        for other in kept.iter().filter(|other| are_alike(own, other)) {
            is_repeated |= are_dependent(case, own, other, effort)?;
            if is_repeated {
                break;
            }
        }
        match is_repeated {
            true => repeated.push(place),
            false => kept.push(own),
        }
    }
    let mut place = 0;
    report.found.retain(|_| {
        place += 1;
        !repeated.contains(&(place - 1))
    });
    Ok(())
}

/// Whether two finds say the same where one is a function of the other.
fn are_alike(own: &Found, other: &Found) -> bool {
    own.kind == other.kind
        && match own.kind {
            FoundKind::ConstantRate => own.with.len() == other.with.len(),
            FoundKind::DarbouxPolynomial => own.with == other.with,
            _ => true,
        }
}

/// Whether one of two functions is a function of the other, as far as it is proved.
fn are_dependent(
    case: &Case,
    own: &Found,
    other: &Found,
    effort: &Effort,
) -> Result<bool, SearchError> {
    let Some((a, b)) = own.function().zip(other.function()) else { return Ok(false) };
    let judged = judged_alone(case, Claim::independent(vec![a.clone(), b.clone()]), effort)?;
    Ok(judged.is_some_and(|judged| judged.verdict == Verdict::Refuted))
}
