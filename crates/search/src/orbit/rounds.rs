//! Search of the parts of a field, within growing limits.

use super::super::{SearchError, SearchReport};
use super::fractions;
use super::known::IndependentIntegrals;
use super::limits::RoundLimits;
use super::part::VariableSet;
use super::setting::OrbitSetting;

/// Degree up to which all sets of variables are searched before any is searched further.
const LOW: u32 = 2;

/// Searches all parts within limits, and then within each of the next ones until the time is spent.
pub fn search(
    setting: &OrbitSetting<'_>,
    parts: &mut [VariableSet],
    (limits, next): (RoundLimits, &[RoundLimits]),
    known: &mut IndependentIntegrals,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    // An integral of low degree in all variables comes before one of high degree in some of them.
    if parts.len() > 1 {
        let low = RoundLimits { degree: LOW, ..limits };
        for part in parts.iter_mut() {
            part.relations(setting, low, known, report, progress)?;
        }
    }
    let mut run = |parts: &mut [VariableSet], limits: RoundLimits, report: &mut SearchReport| {
        for place in 0..parts.len() {
            let (before, rest) = parts.split_at_mut(place);
            let Some(part) = rest.first_mut() else { continue };
            part.inherit(before);
            part.round(setting, limits, known, report, progress)?;
        }
        match parts.last() {
            Some(whole) => whole.conclude_factors(setting, limits.steps, report),
            None => Ok(()),
        }
    };
    run(parts, limits, report)?;
    if setting.origin.is_none() && !setting.is_on_level() && !setting.flow.is_map {
        let known = super::found(setting.case, setting.effort, report)?;
        fractions::conclude(setting.case, setting.effort, &known, false, report)?;
    }
    for limits in next {
        setting.steps.lift();
        match run(parts, *limits, report) {
            // The time limit of the user is reached.
            Err(SearchError::Stopped) => break,
            other => other?,
        }
    }
    Ok(())
}
