//! Conditions of several equations on the parameters of a field that belong to none of codimension one.

use std::cell::Cell;

use super::equations::ParametricEquations;
use super::hypersurface::{Hypersurface, PrimeTerms};
use super::several::{ConditionSearch, GROUNDS, SEARCH};
use super::split::SplitCase;
use super::values::integrals_with;
use super::{ParameterCondition, ideal, isolated, solved};
use crate::SearchError;
use crate::budget::STEPS;
use crate::report::Found;
use crate::streams::SearchStream;

impl ConditionSearch<'_> {
    /// Finds conditions of several equations that belong to none of codimension one, and says how far
    /// conditions of several equations are sought; `simple` are words for where they are sought besides.
    pub fn isolated(&mut self, simple: &str) -> Result<(), SearchError> {
        let mut last = 0;
        for degree in 1..=self.effort.degree {
            (self.progress)(&format!("conditions of several equations, degree {degree}"));
            let equations = ParametricEquations::new(&self.whole.case, degree, self.effort)?;
            let Some(equations) = equations else { break };
            let before = self.left.min(isolated::SHARE * self.effort.seconds * STEPS);
            let left = Cell::new(before);
            let own = isolated::of_integrals(&equations, self.whole, &left)?;
            self.left -= before - left.get();
            let Some(own) = own else { break };
            let mut found = Vec::new();
            for own in own.written {
                if !self.is_known(&own)? && is_special(&equations, self.whole, &own)? {
                    found.push(self.tell_isolated(&own)?);
                }
            }
            let of = format!(
                "more polynomial integrals of degree at most {degree}, by several equations"
            );
            let open = match own.unwritten {
                0 => String::new(),
                n => format!("; {n} further sets of equations have no short coefficients"),
            };
            if !found.is_empty() || own.unwritten > 0 {
                match self.report.conditions.iter_mut().find(|own| own.of == of) {
                    Some(own) => {
                        own.equations.extend(found);
                        own.grounds.push_str(&open);
                    }
                    None => {
                        let grounds = format!("{GROUNDS}{}{open}", self.whole.reservation());
                        let own = ParameterCondition { of, equations: found, grounds };
                        self.report.conditions.push(own);
                    }
                }
            }
            last = degree;
        }
        self.report.remark(match last {
            0 => format!("conditions of several equations are sought {simple}"),
            last => format!(
                "where none of the single equations holds that are told or counted, modulo a prime of \
                 61 bits no other real values of the parameters give more integrals of degree at most {last}; \
                 where one holds, and for higher degrees, conditions of several equations are sought \
                 {simple}"
            ),
        });
        Ok(())
    }

    /// Whether a condition that is known holds where some equations do.
    fn is_known(&self, own: &[Hypersurface]) -> Result<bool, SearchError> {
        let count = self.whole.scalars.len();
        let m = SearchStream::Lines.under(self.effort.options.seed).prime(&[], &[]);
        let images = |own: &Hypersurface| own.images(&m).unwrap_or_default();
        let generators: Vec<PrimeTerms> = own.iter().map(images).collect();
        if self.isolated.iter().any(|known| known == own) {
            return Ok(true);
        }
        for known in &self.found {
            let simple = known.simple.equations().into_iter();
            let simple = simple.map(|own| Hypersurface::from(own, count));
            let mut all = simple.chain(known.further.iter().cloned()).map(|own| images(&own));
            let is_outside = |own: &PrimeTerms| {
                let inside = ideal::contains(&generators, own, count, &m, &self.effort.halt);
                inside.map(|inside| !inside)
            };
            let outside = all.find_map(|own| match is_outside(&own) {
                Ok(false) => None,
                other => Some(other),
            });
            if outside.transpose()?.is_none() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Searches for the integrals where equations hold, and writes these.
    fn tell_isolated(&mut self, own: &[Hypersurface]) -> Result<String, SearchError> {
        let texts: Vec<String> = own.iter().map(|own| own.equation(&self.whole.scalars)).collect();
        let text = texts.join(" and ");
        let known = |found: &Found| found.with.iter().any(|(_, with)| *with == text);
        let cases = solved::with_equations(self.whole, own).unwrap_or_default();
        if !self.report.found.iter().any(known) && self.left > 0.0 {
            for fixed in &cases {
                let with = ("condition", text.clone());
                integrals_with(&fixed.case, with, self.effort, self.report)?;
                self.left -= SEARCH;
            }
        }
        self.isolated.push(own.to_vec());
        Ok(text)
    }
}

/// Whether there are more integrals modulo a second prime where some equations hold, if they give all
/// parameters values.
fn is_special(
    equations: &ParametricEquations<'_>,
    whole: &SplitCase,
    own: &[Hypersurface],
) -> Result<bool, SearchError> {
    let Some(mut at) = equations.system.at(1, 1) else { return Ok(true) };
    let Some(general) = equations.nullity(&at)? else { return Ok(true) };
    for (place, scalar) in whole.scalars.iter().enumerate() {
        let value = own.iter().find_map(|own| own.value(place));
        match value.and_then(|value| at.modulus.rational(&value)) {
            Some(value) => at.parameters[scalar.draw] = value,
            None => return Ok(true),
        }
    }
    Ok(equations.nullity(&at)?.is_some_and(|own| own > general))
}
