//! Values of single parameters for which there are more integrals polynomial in the velocities.

use std::cell::Cell;

use liouville::case::Case;

use super::relation::{self, ScalarParameter};
use super::{MOST_LISTED, ParameterCondition, minors};
use crate::budget::STEPS;
use crate::counts::size;
use crate::jets::VelocityPolynomials;
use crate::lists::{self, ListedCase};
use crate::local::{Coordinates, Local};
use crate::origin::ConditionOrigin;
use crate::{Effort, SearchError, SearchReport};

const GROUNDS: &str = "minors of the equations for Taylor coefficients";
/// Grounds where no value has more.
const NO_VALUE: &str = "modulo a prime of 61 bits no value has more";
/// Share of the time of a count that the values may take.
const SHARE: f64 = 0.25;

/// Finds the values of single parameters for which there are more integrals of the degrees of the
/// search, for each combination of listed values; a remark says which degrees are left out.
pub fn conditions(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    match Local::of(case) {
        // Those of fields are sought elsewhere.
        Err(SearchError::Unsplit(_)) if !Coordinates::are_expected(&case.model.system) => {
            return Ok(());
        }
        Err(error @ SearchError::Unsplit(_)) => {
            report.remark(format!(
                "no values of the parameters with more integrals are sought: {error}"
            ));
            return Ok(());
        }
        Err(error) => return Err(error),
        Ok(_) => {}
    }
    if effort.degree == 0 {
        return Ok(());
    }
    if minors::scalars(case).is_empty() {
        report.remark(
            "no values of the parameters with more integrals are sought: none is a scalar from a range"
                .to_string(),
        );
        return Ok(());
    }
    let all = lists::each_or_first(case, MOST_LISTED);
    let left = Cell::new(SHARE * effort.seconds * STEPS / all.len() as f64);
    for ListedCase { case, values } in &all {
        let reservation = match values.as_str() {
            "" => String::new(),
            values => format!(", for {values}"),
        };
        let own = ValueSearch { case, effort, reservation, left: left.clone() };
        own.search(report, progress)?;
    }
    Ok(())
}

/// The search for one combination of listed values.
struct ValueSearch<'s> {
    case: &'s Case,
    effort: &'s Effort,
    /// Values of parameters with a list, in words.
    reservation: String,
    /// Number of elementary steps that may still be taken.
    left: Cell<f64>,
}

impl ValueSearch<'_> {
    fn search(
        &self,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        let local = Local::of(self.case)?;
        let (turned, all): (Vec<_>, Vec<_>) =
            minors::scalars(self.case).into_iter().partition(|own| {
                local.coordinates.is_turned(own.draw) || local.functions.depend_on(own.draw)
            });
        for own in turned {
            report.remark(format!(
                "values of {} with more integrals are not sought: it is in an exponent or an angle",
                own.name
            ));
        }
        let mut told: Vec<ToldValues> = all.iter().map(|_| ToldValues::default()).collect();
        let mut last = 0;
        'degrees: for degree in 1..=self.effort.degree {
            for (parameter, told) in all.iter().zip(&mut told) {
                progress(&format!("more integrals of degree {degree}, by {}", parameter.name));
                let Some(own) = self.of_degree(&local, degree, parameter, all.len())? else {
                    report.remark(format!(
                        "values of {} with more integrals of degree {degree}, and what comes after, \
                         are not sought{}: the bound is {} s, see --count-seconds",
                        parameter.name,
                        self.reservation,
                        SHARE * self.effort.seconds
                    ));
                    break 'degrees;
                };
                if let Some(own) =
                    own.and_then(|own| told.add(own, degree, report.conditions.len()))
                {
                    report.conditions.push(own.condition(degree, parameter, &self.reservation));
                }
            }
            last = degree;
        }
        self.conclude(&told, last, &all, report);
        Ok(())
    }

    /// Finds the values of one parameter, if any; `None` if that takes too long.
    fn of_degree(
        &self,
        local: &Local,
        degree: u32,
        parameter: &ScalarParameter,
        count: usize,
    ) -> Result<Option<Option<FoundValues>>, SearchError> {
        let mixed = self.case.model.system.energy_is_inhomogeneous();
        let asked = VelocityPolynomials { degree, mixed };
        let rounds = if count > 1 { minors::ROUNDS } else { 1 };
        let least = size(&local.coordinates, degree, mixed).1 * minors::least_values(rounds) as f64;
        if least * STEPS > self.left.get() {
            return Ok(None);
        }
        let found = minors::relations(
            self.case,
            local,
            asked,
            parameter,
            (rounds, &self.left),
            self.effort,
        );
        Ok(Some(match found {
            Ok(found) => {
                let relations = found.explained.relations.iter().map(ToString::to_string);
                Some(FoundValues {
                    equations: relations.chain(found.equation).collect(),
                    unexplained: found.explained.unexplained,
                    complex: found.complex,
                    open: found.open,
                    reason: None,
                })
            }
            Err(error @ SearchError::NoFraction) => {
                Some(FoundValues { reason: Some(error.to_string()), ..FoundValues::default() })
            }
            Err(SearchError::Long { .. } | SearchError::Large { .. }) => return Ok(None),
            Err(error) => return Err(error),
        }))
    }

    /// Says of which parameters no value has more, up to the last degree.
    fn conclude(
        &self,
        told: &[ToldValues],
        last: u32,
        all: &[ScalarParameter],
        report: &mut SearchReport,
    ) {
        for (degree, place) in told.iter().filter_map(|own| own.last) {
            if degree < last && told.iter().all(|own| own.open == 0) {
                let grounds = &mut report.conditions[place].grounds;
                grounds.push_str(&format!("; none is added up to degree {last}"));
            }
        }
        let silent = all.iter().zip(told).filter(|(_, told)| told.last.is_none() && told.open == 0);
        let (complex, silent): (Vec<_>, Vec<_>) = silent.partition(|(_, told)| told.complex > 0);
        for (own, _) in complex {
            report.conditions.push(ParameterCondition {
                of: format!(
                    "more integrals of degree at most {last}, by the value of {}{}",
                    own.name, self.reservation
                ),
                equations: Vec::new(),
                grounds: format!("{GROUNDS}; the values that have more are not real"),
                origin: ConditionOrigin::Counts,
            });
        }
        for (own, told) in all.iter().zip(told).filter(|(_, told)| told.open > 0) {
            let values = if told.open == 1 { "a value" } else { "values" };
            report.remark(format!(
                "{values} of {} with more integrals of degree at most {last} may be missing{}: minors have \
                 {} that no prime field tried contains",
                own.name,
                self.reservation,
                if told.open == 1 { "a root".to_string() } else { format!("{} roots", told.open) },
            ));
        }
        let silent: Vec<&str> = silent.into_iter().map(|(own, _)| own.name.as_str()).collect();
        if last > 0 && !silent.is_empty() {
            report.conditions.push(ParameterCondition {
                of: format!(
                    "more integrals of degree at most {last}, by the value of {}{}",
                    silent.join(", or of "),
                    self.reservation
                ),
                equations: Vec::new(),
                grounds: format!("{GROUNDS}; {NO_VALUE}"),
                origin: ConditionOrigin::Counts,
            });
        }
    }
}

/// Values of a parameter with more integrals of a degree.
#[derive(Default)]
struct FoundValues {
    equations: Vec<String>,
    /// Number of values that no equation describes.
    unexplained: usize,
    /// Number of values that are not real.
    complex: usize,
    /// Number of roots at which nothing is counted.
    open: usize,
    /// Reason why none are found.
    reason: Option<String>,
}

impl FoundValues {
    fn condition(
        self,
        degree: u32,
        parameter: &ScalarParameter,
        reservation: &str,
    ) -> ParameterCondition {
        let grounds = match (self.reason, self.unexplained) {
            (Some(reason), _) => reason,
            (None, 0) => GROUNDS.to_string(),
            (None, n) => format!("{GROUNDS}; {}", relation::unexplained(n, parameter)),
        };
        let name = &parameter.name;
        ParameterCondition {
            of: format!("more integrals of degree {degree}, by the value of {name}{reservation}"),
            equations: self.equations,
            grounds,
            origin: ConditionOrigin::Counts,
        }
    }
}

/// Values of a parameter that are told already.
#[derive(Default)]
struct ToldValues {
    equations: Vec<String>,
    unexplained: usize,
    complex: usize,
    open: usize,
    /// Last degree with a condition, and its place in the report.
    last: Option<(u32, usize)>,
}

impl ToldValues {
    /// Leaves out the values told at lower degrees; `None` if there are no others.
    fn add(&mut self, mut found: FoundValues, degree: u32, place: usize) -> Option<FoundValues> {
        self.complex = self.complex.max(found.complex);
        self.open = self.open.max(found.open);
        found.equations.retain(|own| !self.equations.contains(own));
        let is_new = !found.equations.is_empty()
            || found.unexplained > self.unexplained
            || found.reason.is_some();
        if !is_new {
            return None;
        }
        self.equations.extend(found.equations.iter().cloned());
        self.unexplained = self.unexplained.max(found.unexplained);
        self.last = Some((degree, place));
        Some(found)
    }
}
