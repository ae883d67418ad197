//! Places in the hierarchy for single listed values of parameters.
//!
//! A proof about a case covers all values of a list, a refutation one of them, and a find of the search
//! may hold for one alone. So each combination of values has its own place.

use serde::Serialize;

use super::description::Description;
use super::hierarchy::{HierarchyClass, HierarchyPlace, Integrals, MeasureStatus};
use super::{Survey, words};
use crate::lists;
use liouville::case::Case;
use liouville::verdict::JudgeError;

/// Largest number of combinations of listed values that are surveyed one by one.
const MOST: usize = 8;

/// Place of a case in the hierarchy for one combination of listed values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ValuePlace {
    /// The values, as `a = 1 and b = 2`.
    pub values: String,
    /// The place.
    pub hierarchy: HierarchyPlace,
}

/// A survey of a case; the text names the value of each list, if it has one value each.
type OneSurvey<'s> = &'s mut dyn FnMut(&Case, Option<&str>) -> Result<Survey, JudgeError>;

/// Surveys a case, without the listed values for which there is no motion, and finds its places for single values; `survey`
/// takes a case with the one value of each list that it has, in words.
pub fn of_each(case: &Case, survey: OneSurvey<'_>) -> Result<Survey, JudgeError> {
    let moving = lists::with_motion(case);
    let own = moving.as_ref().map_or(case, |(own, _)| own);
    let mut found = survey(own, None)?;
    let places = places(own, &mut |own, values| Ok(survey(own, Some(values))?.hierarchy))?;
    if let Some(places) = places {
        found.hierarchy.by_value(&places);
        found.by_value = places;
    }
    if let Some((_, remark)) = moving {
        found.description = Description::of(case);
        found.parameters = words::parameters(case);
        found.remarks.insert(0, remark);
    }
    Ok(found)
}

/// Finds the places for all combinations of listed values; `None` if no parameter has a list of
/// several, and none of them if there are many.
fn places(
    case: &Case,
    place: &mut dyn FnMut(&Case, &str) -> Result<HierarchyPlace, JudgeError>,
) -> Result<Option<Vec<ValuePlace>>, JudgeError> {
    if lists::first_values(case).is_none() {
        return Ok(None);
    }
    let all = lists::combinations(case).filter(|all| all.len() <= MOST).unwrap_or_default();
    let one = |own: lists::ListedCase| {
        let hierarchy = place(&own.case, &own.values)?;
        Ok(ValuePlace { values: own.values, hierarchy })
    };
    all.into_iter().map(one).collect::<Result<_, _>>().map(Some)
}

impl HierarchyPlace {
    /// Replaces what is known for all values together by what is known for each.
    pub fn by_value(&mut self, places: &[ValuePlace]) {
        let Some(first) = places.first().map(|one| &one.hierarchy) else {
            self.for_many_values();
            return;
        };
        let all = || places.iter().map(|one| &one.hierarchy);
        if all().all(|one| one == first) {
            *self = first.clone();
            return;
        }
        if all().any(|one| one.class != first.class) {
            self.class = HierarchyClass::ByValue;
        } else {
            self.class = first.class;
        }
        self.measure = match all().all(|one| one.measure == first.measure) {
            true => first.measure,
            false => MeasureStatus::NotKnown,
        };
        self.integrals = match all().all(|one| one.integrals == first.integrals) {
            true => first.integrals,
            false => Integrals::NotKnown,
        };
        let words = |one: &ValuePlace| {
            let (values, place) = (&one.values, &one.hierarchy);
            format!("for {values}: {}; {}", place.class.words(), place.grounds.join("; "))
        };
        self.grounds = places.iter().map(words).collect();
        self.typical.retain(|line| all().all(|one| one.typical.contains(line)));
    }

    /// Keeps what holds for all of many listed values, and says that single ones may have more.
    fn for_many_values(&mut self) {
        let has_measure =
            matches!(self.measure, MeasureStatus::ClosedForm | MeasureStatus::ByQuadrature);
        if !has_measure {
            self.measure = MeasureStatus::NotKnown;
        }
        if self.class != HierarchyClass::IntegralAndMeasure {
            self.class = HierarchyClass::ByValue;
            self.typical.clear();
        }
        self.grounds.push(
            "this is what holds for all listed values of the parameters, and single values may have \
             more: `--set` reports on one of them"
                .to_string(),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::super::hierarchy::KnownFeatures;
    use super::*;

    fn place(measure: MeasureStatus, integrals: Integrals) -> HierarchyPlace {
        let features = KnownFeatures { dimension: Some(3), ..KnownFeatures::default() };
        HierarchyPlace::of(measure, integrals, features)
    }

    fn joined(own: &HierarchyPlace, places: &[HierarchyPlace]) -> HierarchyPlace {
        let one = |(k, place): (usize, &HierarchyPlace)| ValuePlace {
            values: format!("a = {k}"),
            hierarchy: place.clone(),
        };
        let places: Vec<ValuePlace> = places.iter().enumerate().map(one).collect();
        let mut own = own.clone();
        own.by_value(&places);
        own
    }

    #[test]
    fn a_place_that_differs_by_value_is_told_by_value() {
        let excluded = place(MeasureStatus::Excluded, Integrals::Some);
        let both = place(MeasureStatus::ClosedForm, Integrals::Enough);
        let found = joined(&excluded, &[both.clone(), excluded.clone()]);
        assert_eq!(found.class, HierarchyClass::ByValue);
        assert_eq!(found.measure, MeasureStatus::NotKnown);
        assert!(found.grounds[0].starts_with("for a = 0: integral and measure; "), "{found:?}");
        assert!(found.grounds[1].starts_with("for a = 1: integral only; "), "{found:?}");
        assert!(found.typical.is_empty(), "nothing is typical of both");
        assert_eq!(joined(&excluded, &[both.clone(), both.clone()]), both, "one for all values");
    }

    #[test]
    fn nothing_is_excluded_for_many_values_together() {
        let excluded = place(MeasureStatus::Excluded, Integrals::Some);
        let found = joined(&excluded, &[]);
        assert_eq!(
            (found.class, found.measure),
            (HierarchyClass::ByValue, MeasureStatus::NotKnown)
        );
        let both = place(MeasureStatus::ClosedForm, Integrals::Enough);
        assert_eq!(joined(&both, &[]).class, HierarchyClass::IntegralAndMeasure);
    }
}
