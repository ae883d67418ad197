//! Conditions on the parameters of a field for each combination of listed values of the others.

use liouville::case::Case;

use super::{MOST_LISTED, ParameterCondition, several};
use crate::lists::{self, ListedCase};
use crate::origin::Remark;
use crate::{Effort, Found, Given, SearchError, SearchReport};

/// Words for what holds for all values.
const EACH: &str = "each of the listed values";

/// Finds the conditions for more polynomial integrals for each combination of listed values, if they are
/// few; what is the same for several of them is told once.
pub fn conditions(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let all = lists::each_or_first(case, MOST_LISTED);
    if all.len() == 1 {
        return several::conditions(case, effort, report, progress);
    }
    let effort = Effort { seconds: effort.seconds / all.len() as f64, ..effort.clone() };
    let mut conditions: Told<ParameterCondition> = Told::new();
    let (mut found, mut remarks): (Told<Found>, Told<Remark>) = (Told::new(), Told::new());
    for ListedCase { case, values } in &all {
        let mut own = SearchReport { found: report.found.clone(), ..SearchReport::default() };
        let known = own.found.len();
        several::conditions(case, &effort, &mut own, &mut |part| {
            progress(&format!("{part}, for {values}"));
        })?;
        for own in own.conditions {
            add(&mut conditions, own, values, |one, other| {
                (&one.of, &one.equations, &one.grounds)
                    == (&other.of, &other.equations, &other.grounds)
            });
        }
        for own in own.found.into_iter().skip(known) {
            add(&mut found, own, values, |one, other| one.says(other));
        }
        for own in own.remarks {
            add(&mut remarks, own, values, |one, other| one == other);
        }
    }
    for (own, values) in conditions {
        let of = format!("{}, for {}", own.of, joined(&values, all.len()));
        report.conditions.push(ParameterCondition { of, ..own });
    }
    for (mut own, values) in found {
        if values.len() < all.len() {
            own.with.push(Given::Value(values.join(", or ")));
        }
        report.found.push(own);
    }
    for (own, values) in remarks {
        report.remark(match values.len() == all.len() {
            true => own,
            false => {
                let text = format!("for {}: {own}", values.join(", or "));
                Remark { text, ..own }
            }
        });
    }
    Ok(())
}

/// Findings of a report, with the values for which they hold.
type Told<'v, T> = Vec<(T, Vec<&'v str>)>;

fn add<'v, T>(told: &mut Told<'v, T>, own: T, values: &'v str, is_same: impl Fn(&T, &T) -> bool) {
    match told.iter_mut().find(|(known, _)| is_same(known, &own)) {
        Some((_, known)) => known.push(values),
        None => told.push((own, vec![values])),
    }
}

fn joined(values: &[&str], all: usize) -> String {
    match values.len() == all {
        true => EACH.to_string(),
        false => values.join(", or "),
    }
}
