//! Values of single parameters for which there are more integrals polynomial in the velocities.

use std::cell::Cell;

use liouville::case::Case;
use liouville::mechanics::System;

use super::relation::{self, ScalarParameter};
use super::{MOST_LISTED, ParameterCondition, minors};
use crate::budget::STEPS;
use crate::counts::size;
use crate::jets::VelocityPolynomials;
use crate::lists::{self, ListedCase};
use crate::local::Local;
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
    match Local::of(case, &[]) {
        // Those of fields are sought elsewhere.
        Err(SearchError::Unsplit(_))
            if matches!(case.model.system, System::Field(_) | System::Hamiltonian(_)) =>
        {
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
        let local = Local::of(self.case, &[])?;
        let all = minors::scalars(self.case);
        let before = report.conditions.len();
        let mut last = 0;
        for degree in 1..=self.effort.degree {
            for parameter in &all {
                progress(&format!("more integrals of degree {degree}, by {}", parameter.name));
                match self.of_degree(&local, degree, parameter, all.len())? {
                    Some(own) => report.conditions.extend(own),
                    None => {
                        report.remark(format!(
                            "values of {} with more integrals of degree {degree}, and what comes after, \
                             are not sought{}: the bound is {} s, see --seconds",
                            parameter.name,
                            self.reservation,
                            SHARE * self.effort.seconds
                        ));
                        self.conclude(before, last, &all, report);
                        return Ok(());
                    }
                }
            }
            last = degree;
        }
        self.conclude(before, last, &all, report);
        Ok(())
    }

    /// Finds the values of one parameter, if any; `None` if that takes too long.
    fn of_degree(
        &self,
        local: &Local,
        degree: u32,
        parameter: &ScalarParameter,
        count: usize,
    ) -> Result<Option<Option<ParameterCondition>>, SearchError> {
        let mixed = self.case.model.system.energy_is_inhomogeneous();
        let asked = VelocityPolynomials { degree, mixed };
        let rounds = if count > 1 { minors::ROUNDS } else { 1 };
        let least = size(local, degree, mixed).1 * minors::least_values(rounds) as f64;
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
        let (equations, grounds) = match found {
            Ok(None) => return Ok(Some(None)),
            Ok(Some(found)) => {
                let grounds = match found.unexplained {
                    0 => GROUNDS.to_string(),
                    n => format!("{GROUNDS}; {}", relation::unexplained(n, parameter)),
                };
                (found.relations.iter().map(ToString::to_string).collect(), grounds)
            }
            Err(error @ SearchError::NoFraction) => (Vec::new(), error.to_string()),
            Err(SearchError::Long { .. } | SearchError::Large { .. }) => return Ok(None),
            Err(error) => return Err(error),
        };
        let of = format!(
            "more integrals of degree {degree}, by the value of {}{}",
            parameter.name, self.reservation
        );
        Ok(Some(Some(ParameterCondition { of, equations, grounds })))
    }

    /// Says of which parameters no value has more, up to the last degree.
    fn conclude(
        &self,
        before: usize,
        last: u32,
        all: &[ScalarParameter],
        report: &mut SearchReport,
    ) {
        let own = &report.conditions[before..];
        let ends = |name: &str| format!("by the value of {name}{}", self.reservation);
        let is_told = |name: &str| own.iter().any(|known| known.of.ends_with(&ends(name)));
        let silent: Vec<&str> =
            all.iter().map(|own| own.name.as_str()).filter(|name| !is_told(name)).collect();
        if last == 0 || silent.is_empty() {
            return;
        }
        report.conditions.push(ParameterCondition {
            of: format!(
                "more integrals of degree at most {last}, {}",
                ends(&silent.join(", or of "))
            ),
            equations: Vec::new(),
            grounds: format!("{GROUNDS}; {NO_VALUE}"),
        });
    }
}
